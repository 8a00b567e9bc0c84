// What both of our modules need.
import { createRequire } from 'node:module';

const require = createRequire(import.meta.url);

// `path` is the module that emscripten made.
export function loadModule(path) {
    return require(path)();
}

// The numbers that `fill` writes to the address it gets; valid until the next call into the module.
export function readNumbers(module, count, fill) {
    const memory = module._malloc(count * Float64Array.BYTES_PER_ELEMENT);
    fill(memory);
    const numbers = new Float64Array(module.HEAPU8.buffer, memory, count).slice();
    module._free(memory);
    return numbers;
}

// Of two halves, as JavaScript's numbers have 53 bits.
export function hexHash(high, low) {
    return [high, low].map((half) => (half >>> 0).toString(16).padStart(8, '0')).join('');
}
