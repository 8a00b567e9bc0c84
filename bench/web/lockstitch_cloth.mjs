// The cloth in Lockstitch, by the functions of hanging_cloth.c.
import { createRequire } from 'node:module';
import { edges, width } from './cloth_shape.mjs';

const require = createRequire(import.meta.url);

export class LockstitchCloth {
    // `path` is the module that emscripten made.
    static async create(path, side, { substeps, iterations }) {
        return new LockstitchCloth(await require(path)(), side, substeps, iterations);
    }

    constructor(module, side, substeps, iterations) {
        this.module = module;
        this.count = side * side;
        this.cloth = module._cloth_create(side, width, substeps, iterations);
        if (this.cloth === 0) {
            throw new Error(`Lockstitch refused a cloth of ${side} x ${side}.`);
        }
        this.buffer = module._malloc(this.count * 3 * Float64Array.BYTES_PER_ELEMENT);
        this.constraints = module._cloth_constraint_count(this.cloth);
        this.#demandSameEdges(edges(side));
    }

    step() {
        this.module._cloth_step(this.cloth);
    }

    positions() {
        this.module._cloth_positions(this.cloth, this.buffer);
        return new Float64Array(this.module.HEAPU8.buffer, this.buffer, this.count * 3);
    }

    hash() {
        const halves = [this.module._cloth_hash_high(this.cloth), this.module._cloth_hash_low(this.cloth)];
        return halves.map((half) => (half >>> 0).toString(16).padStart(8, '0')).join('');
    }

    destroy() {
        this.module._free(this.buffer);
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
        if (missing.size !== 0 || this.constraints !== expected.length) {
            throw new Error('Lockstitch and Jolt would not be given the same edges.');
        }
    }
}
