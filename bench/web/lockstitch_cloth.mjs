// The cloth in Lockstitch, by the functions of hanging_cloth.c.
import { edges, width } from './cloth_shape.mjs';
import { hexHash, loadModule, readNumbers } from './lockstitch_module.mjs';
import { demand } from './options.mjs';

export class LockstitchCloth {
    // `path` is the module that emscripten made.
    static async create(path, side, { substeps, iterations }) {
        return new LockstitchCloth(await loadModule(path), side, substeps, iterations);
    }

    constructor(module, side, substeps, iterations) {
        this.module = module;
        this.count = side * side;
        this.cloth = module._cloth_create(side, width, substeps, iterations);
        demand(this.cloth !== 0, `Lockstitch refused a cloth of ${side} x ${side}.`);
        this.constraints = module._cloth_constraint_count(this.cloth);
        this.#demandSameEdges(edges(side));
    }

    step() {
        this.module._cloth_step(this.cloth);
    }

    positions() {
        return readNumbers(this.module, this.count * 3,
            (memory) => this.module._cloth_positions(this.cloth, memory));
    }

    hash() {
        return hexHash(this.module._cloth_hash_high(this.cloth), this.module._cloth_hash_low(this.cloth));
    }

    destroy() {
        this.module._cloth_destroy(this.cloth);
    }

    #demandSameEdges(expected) {
        const memory = this.module._malloc(this.constraints * 2 * Uint32Array.BYTES_PER_ELEMENT);
        this.module._cloth_edges(this.cloth, memory);
        const pairs = new Uint32Array(this.module.HEAPU8.buffer, memory, this.constraints * 2);
        const key = (a, b) => Math.min(a, b) * this.count + Math.max(a, b);
        const missing = new Set(expected.map(([a, b]) => key(a, b)));
        for (let i = 0; i < pairs.length; i += 2) {
            missing.delete(key(pairs[i], pairs[i + 1]));
        }
        this.module._free(memory);
        demand(missing.size === 0 && this.constraints === expected.length,
            'Lockstitch and Jolt would not be given the same edges.');
    }
}
