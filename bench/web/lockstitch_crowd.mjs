// The crowd in Lockstitch, by the functions of falling_crowd.cpp; what the crowd is comes from there too.
import { hexHash, loadModule, readNumbers } from './lockstitch_module.mjs';

const radians = Math.PI / 180;
const boneNumbers = 27;

function frame([x, y, z, ...rotation]) {
    return { position: [x, y, z], rotation };
}

function rows(numbers, width) {
    return Array.from({ length: numbers.length / width },
        (_, i) => [...numbers.subarray(width * i, width * (i + 1))]);
}

function bone(row) {
    const [parent, hinge, box, radius, halfLength, x, y, z, mass, friction, swing, twistMin, twistMax] = row;
    return {
        parent,
        hinge: hinge !== 0,
        box: box !== 0,
        radius,
        halfLength,
        halfExtents: [x, y, z],
        mass,
        friction,
        swing: swing * radians,
        twistMin: twistMin * radians,
        twistMax: twistMax * radians,
        body: frame(row.slice(13, 20)),
        joint: frame(row.slice(20, 27)),
    };
}

export class LockstitchCrowds {
    static async load(path, pile) {
        return new LockstitchCrowds(await loadModule(path), pile);
    }

    constructor(module, pile) {
        this.module = module;
        this.address = module._crowd_create(pile ? 1 : 0);
        const read = (count, width, fill) =>
            rows(readNumbers(module, count * width, (memory) => fill(this.address, memory)), width);
        this.crowd = {
            bones: read(module._crowd_bone_count(this.address), boneNumbers, module._crowd_bones).map(bone),
            places: read(module._crowd_place_count(this.address), 7, module._crowd_places).map(frame),
            walls: read(module._crowd_wall_count(this.address), 6, module._crowd_walls)
                .map((row) => ({ position: row.slice(0, 3), halfExtents: row.slice(3) })),
        };
    }

    create(substeps) {
        return new LockstitchCrowd(this.module, this.address, this.crowd, substeps);
    }
}

class LockstitchCrowd {
    constructor(module, address, { bones, places }, substeps) {
        this.module = module;
        this.ours = module._our_crowd_create(address, substeps);
        this.bodyCount = bones.length * places.length;
        this.jointCount = (bones.length - 1) * places.length;
    }

    step() {
        this.module._our_crowd_step(this.ours);
    }

    states() {
        return readNumbers(this.module, this.bodyCount * 13,
            (memory) => this.module._our_crowd_states(this.ours, memory));
    }

    // What the SDK itself says, for a check of our measure: metres and radians a joint.
    joints() {
        const numbers = readNumbers(this.module, this.jointCount * 3,
            (memory) => this.module._our_crowd_joints(this.ours, memory));
        return rows(numbers, 3)
            .map(([apart, swing, twist]) => ({ apart, swing: swing * radians, twist: twist * radians }));
    }

    energy() {
        return this.module._our_crowd_energy(this.ours);
    }

    hash() {
        const { module, ours } = this;
        return hexHash(module._our_crowd_hash_high(ours), module._our_crowd_hash_low(ours));
    }

    destroy() {
        this.module._our_crowd_destroy(this.ours);
    }
}
