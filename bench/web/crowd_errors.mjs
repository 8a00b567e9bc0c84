// One measure for all engines, in double precision and from nothing but where bodies are and how they move:
// thirteen numbers each, position, rotation (x, y, z, w), velocity and spin in world axes.
import { bodies, inertia, joints } from './crowd_shape.mjs';
import { compose, conjugate, relative, rotate, subtract } from './rotation.mjs';

const gravity = 9.81;
const numbers = 13;

export class CrowdMeasure {
    constructor(crowd) {
        this.bones = bodies(crowd).map(({ bone }) => bone);
        this.moments = this.bones.map(inertia);
        this.joints = joints(crowd);
    }

    // Metres, and radians: how far the axes are apart, and by how much b is twisted against a.
    joint({ a, b, inA, inB }, states) {
        const [frameA, frameB] = [[a, inA], [b, inB]].map(([i, frame]) => compose(place(states, i), frame));
        const apart = Math.hypot(...subtract(frameA.position, frameB.position));
        const [x, y, z, w] = relative(frameA, frameB).rotation;
        return {
            apart,
            swing: 2 * Math.atan2(Math.hypot(x, z), Math.hypot(y, w)),
            twist: 2 * Math.atan2(w < 0 ? -y : y, Math.abs(w)),
        };
    }

    // `beyond`: radians beyond the joint's limits; a hinge's axes count as a swing that must be none.
    errors(states) {
        let worst = 0;
        let sum = 0;
        let beyond = 0;
        for (const joint of this.joints) {
            const { apart, swing, twist } = this.joint(joint, states);
            const { swing: swingLimit, twistMin, twistMax } = joint.bone;
            const excess = Math.max(swing - swingLimit, twist - twistMax, twistMin - twist);
            sum += apart;
            worst = apart <= worst ? worst : apart; // NaN is the worst
            beyond = excess <= beyond ? beyond : excess;
        }
        return { mean: sum / this.joints.length, worst, beyond };
    }

    // Joules; potential energy is none at y = 0.
    energy(states) {
        return this.bones.reduce((energy, bone, i) => {
            const [, y, , qx, qy, qz, qw, vx, vy, vz, ...spin] =
                states.subarray(numbers * i, numbers * (i + 1));
            const local = rotate(conjugate([qx, qy, qz, qw]), spin);
            const turning = this.moments[i].reduce((sum, moment, axis) => sum + moment * local[axis] ** 2, 0);
            return energy + bone.mass * (gravity * y + (vx * vx + vy * vy + vz * vz) / 2) + turning / 2;
        }, 0);
    }

    // Of the common centre of mass, metres.
    height(states) {
        const mass = this.bones.reduce((sum, bone) => sum + bone.mass, 0);
        return this.bones.reduce((sum, bone, i) => sum + bone.mass * states[numbers * i + 1], 0) / mass;
    }

    // How deep bodies are in the ground, metres: the lowest one, and the mean of those that are.
    depths(states) {
        const depths = this.bones.map((bone, i) => {
            const { position, rotation } = place(states, i);
            const down = rotate(conjugate(rotation), [0, -1, 0]);
            const reach = bone.box
                ? bone.halfExtents.reduce((sum, half, axis) => sum + half * Math.abs(down[axis]), 0)
                : bone.radius + bone.halfLength * Math.abs(down[1]);
            return reach - position[1];
        }).filter((depth) => !(depth <= 0)); // NaN is one
        const sum = depths.reduce((all, depth) => all + depth, 0);
        return { worst: Math.max(0, ...depths), mean: sum / Math.max(1, depths.length) };
    }
}

function place(states, i) {
    const [x, y, z, ...rotation] = states.subarray(numbers * i, numbers * i + 7);
    return { position: [x, y, z], rotation };
}

// The errors of a whole run.
export class CrowdRun {
    constructor(measure, states) {
        this.measure = measure;
        this.least = measure.energy(states);
        this.worst = 0;
        this.beyond = 0;
        this.gained = 0;
        this.deepest = 0;
        this.sum = 0;
        this.ticks = 0;
    }

    add(states) {
        const { mean, worst, beyond } = this.measure.errors(states);
        this.sum += mean;
        ++this.ticks;
        this.worst = worst <= this.worst ? this.worst : worst;
        this.beyond = beyond <= this.beyond ? this.beyond : beyond;
        this.energy = this.measure.energy(states);
        this.gained = Math.max(this.gained, this.energy - this.least);
        this.least = Math.min(this.least, this.energy);
        this.height = this.measure.height(states);
        this.depths = this.measure.depths(states);
        this.deepest = this.depths.worst <= this.deepest ? this.deepest : this.depths.worst;
    }

    result() {
        return {
            joint_error_mm: { mean: 1000 * this.sum / this.ticks, worst: 1000 * this.worst },
            beyond_limits_degrees: this.beyond * 180 / Math.PI,
            energy_gained_joules: this.gained,
            energy_at_end_joules: this.energy,
            height_at_end_metres: this.height,
            in_ground_mm: {
                worst: 1000 * this.deepest,
                worst_at_end: 1000 * this.depths.worst,
                mean_at_end: 1000 * this.depths.mean,
            },
        };
    }
}
