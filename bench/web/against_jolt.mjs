// The same cloth in Lockstitch and in Jolt Physics, both as WebAssembly on one thread: nanoseconds per
// constraint projection, and the stretch that is left, since cost means nothing without error.
// usage: node against_jolt.mjs --build FOLDER [--ticks N] [--side N] [--json]    FOLDER: as run.sh makes it
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { Stretch } from './cloth_shape.mjs';
import { JoltCloth } from './jolt_cloth.mjs';
import { LockstitchCloth } from './lockstitch_cloth.mjs';

const { values: options } = parseArgs({
    options: {
        build: { type: 'string', default: 'build/web' },
        ticks: { type: 'string', default: '300' },
        side: { type: 'string', default: '64' },
        json: { type: 'boolean', default: false },
    },
});
const build = resolve(options.build);
const ticks = Number(options.ticks);
const side = Number(options.side);
if (!Number.isInteger(ticks) || ticks < 1 || !Number.isInteger(side) || side < 3) {
    console.error('--ticks takes a whole number from 1, --side one from 3.');
    process.exit(2);
}
const passes = 20; // over every constraint, a tick
// Ticks whose time doesn't count: node is still compiling.
const warmUp = Math.min(30, Math.floor(ticks / 2));

const packages = createRequire(`${build}/`);
async function loadJolt(flavour) {
    // Its workers don't keep node alive while they start.
    const alive = setInterval(() => {}, 1000);
    const module = await import(pathToFileURL(packages.resolve(`jolt-physics/${flavour}`)));
    const Jolt = await module.default();
    clearInterval(alive);
    return Jolt;
}

// Of the package's builds only the one with threads was compiled with SIMD; it gets no workers here.
const joltSimd = await loadJolt('wasm-multithread');
const joltPlain = await loadJolt('wasm');
const joltVersion = packages('jolt-physics/package.json').version;

async function lockstitchContenders(schedule) {
    return Promise.all([['simd128', 'wasm32-simd128'], ['plain', 'wasm32']].map(async ([name, folder]) => ({
        name: `Lockstitch, ${name}`,
        cloth: await LockstitchCloth.create(`${build}/${folder}/lockstitch_cloth.js`, side, schedule),
    })));
}

function joltContenders() {
    // The order that stretches least stands for Jolt; the others show how much it matters.
    const best = { iterations: passes, collisionSteps: 1, order: 'to the pins' };
    const contenders = [
        ['SIMD, edges to the pins', joltSimd, best],
        ['SIMD, edges from the pins', joltSimd, { ...best, order: 'from the pins' }],
        ['SIMD, edges by family', joltSimd, { ...best, order: 'by family' }],
        ['SIMD, 20 collision steps', joltSimd, { ...best, iterations: 1, collisionSteps: passes }],
        ['no SIMD', joltPlain, best],
    ];
    return contenders.map(([name, Jolt, schedule]) =>
        ({ name: `Jolt, ${name}`, cloth: new JoltCloth(Jolt, side, schedule) }));
}

function median(numbers) {
    const sorted = [...numbers].sort((a, b) => a - b);
    const middle = sorted.length >> 1;
    return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// Tick by tick in turns, and the first one of each turn is another one each time.
function race(contenders) {
    const stretch = new Stretch(side);
    const runs = contenders.map(({ name, cloth }) => ({ name, cloth, times: [], worst: 0 }));
    for (let tick = 0; tick < ticks; ++tick) {
        for (let turn = 0; turn < runs.length; ++turn) {
            const run = runs[(tick + turn) % runs.length];
            const start = process.hrtime.bigint();
            run.cloth.step();
            const elapsed = Number(process.hrtime.bigint() - start);
            if (tick >= warmUp) {
                run.times.push(elapsed);
            }
            run.end = stretch.of(run.cloth.positions());
            run.worst = run.end.worst <= run.worst ? run.worst : run.end.worst;
        }
    }
    const first = median(runs[0].times);
    return runs.map(({ name, cloth, times, worst, end }) => {
        const time = median(times);
        const result = {
            name,
            ns_per_projection: time / (cloth.constraints * passes),
            ms_per_tick: time / 1e6,
            ratio: time / first,
            stretch: { worst_of_run: worst, worst_at_end: end.worst, rms_at_end: end.rms },
            hash: cloth.hash?.(),
        };
        cloth.destroy();
        return result;
    });
}

const schedules = [
    { name: '20 substeps x 1 iteration', lockstitch: { substeps: passes, iterations: 1 }, jolt: true },
    // Jolt has no iterations within a substep.
    { name: '1 substep x 20 iterations', lockstitch: { substeps: 1, iterations: passes }, jolt: false },
];
const report = {
    cloth: `${side} x ${side}`, constraints: new Stretch(side).edges.length, ticks, node: process.version,
    jolt_physics: joltVersion, schedules: [],
};
for (const { name, lockstitch, jolt } of schedules) {
    const contenders = [...await lockstitchContenders(lockstitch), ...(jolt ? joltContenders() : [])];
    report.schedules.push({ name, results: race(contenders) });
}

function percent(share) {
    const digits = share < 0.01 ? 3 : share < 1 ? 1 : 0;
    return `${(100 * share).toFixed(digits)} %`.padStart(13);
}

if (options.json) {
    console.log(JSON.stringify(report, null, 2));
} else {
    console.log(`Cloth of ${report.cloth}, ${report.constraints} constraints without compliance, two corners `
        + `pinned; ${ticks} ticks of 1/60 s; node ${report.node}, jolt-physics ${joltVersion}, one thread.`);
    for (const { name, results } of report.schedules) {
        console.log(`\n${name.padEnd(34)} ns/projection  ms/tick  ratio  stretch: worst   worst at end`
            + '     rms at end');
        for (const { name: who, ns_per_projection: ns, ms_per_tick: ms, ratio, stretch } of results) {
            console.log(who.padEnd(34) + ns.toFixed(2).padStart(14) + ms.toFixed(2).padStart(9)
                + ratio.toFixed(2).padStart(7) + '  ' + percent(stretch.worst_of_run)
                + '  ' + percent(stretch.worst_at_end) + '  ' + percent(stretch.rms_at_end));
        }
    }
}

for (const { name, results } of report.schedules) {
    const hashes = new Set(results.map((result) => result.hash).filter(Boolean));
    if (hashes.size !== 1) {
        console.error(`Lockstitch's states differ with and without SIMD, at ${name}: ${[...hashes]}`);
        process.exitCode = 1;
    }
}
