// The same cloth in Lockstitch and in Jolt Physics, both as WebAssembly on one thread: nanoseconds per
// constraint projection, and the stretch that is left, since cost means nothing without error.
// usage: node cloth_race.mjs --build FOLDER [--ticks N] [--side N] [--json]    FOLDER: as run.sh makes it
import { Stretch } from './cloth_shape.mjs';
import { JoltCloth } from './jolt_cloth.mjs';
import { createJolt, joltVersion } from './jolt_system.mjs';
import { LockstitchCloth } from './lockstitch_cloth.mjs';
import { readOptions } from './options.mjs';
import { demandSameHash, median, race } from './race.mjs';

const options = readOptions('cloth');
const { build, ticks, side } = options;
const passes = 20; // over every constraint, a tick

async function lockstitchContenders(schedule) {
    return Promise.all([['simd128', 'wasm32-simd128'], ['plain', 'wasm32']].map(async ([name, folder]) => ({
        name: `Lockstitch, ${name}`,
        cloth: await LockstitchCloth.create(`${build}/${folder}/lockstitch_cloth.js`, side, schedule),
    })));
}

async function joltContenders() {
    const [simd, plain] = await Promise.all([createJolt(build, 'simd'), createJolt(build, 'plain')]);
    // The order that stretches least stands for Jolt; the others show how much it matters.
    const best = { iterations: passes, collisionSteps: 1, order: 'to the pins' };
    const contenders = [
        ['SIMD, edges to the pins', simd, best],
        ['SIMD, edges from the pins', simd, { ...best, order: 'from the pins' }],
        ['SIMD, edges by family', simd, { ...best, order: 'by family' }],
        ['SIMD, 20 collision steps', simd, { ...best, iterations: 1, collisionSteps: passes }],
        ['no SIMD', plain, best],
    ];
    return contenders.map(([name, Jolt, schedule]) =>
        ({ name: `Jolt, ${name}`, cloth: new JoltCloth(Jolt, side, schedule) }));
}

function raceOf(contenders) {
    const stretch = new Stretch(side);
    const runs = contenders.map(({ name, cloth }) => ({ name, cloth, worst: 0 }));
    const times = race(contenders.map(({ cloth }) => cloth), ticks, (i) => {
        const run = runs[i];
        run.end = stretch.of(run.cloth.positions());
        run.worst = run.end.worst <= run.worst ? run.worst : run.end.worst; // NaN is the worst
    }).map(median);
    return runs.map(({ name, cloth, worst, end }, i) => {
        const result = {
            name,
            ns_per_projection: times[i] / (cloth.constraints * passes),
            ms_per_tick: times[i] / 1e6,
            ratio: times[i] / times[0],
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
    jolt_physics: joltVersion(build), schedules: [],
};
for (const { name, lockstitch, jolt } of schedules) {
    const contenders = [...await lockstitchContenders(lockstitch), ...(jolt ? await joltContenders() : [])];
    report.schedules.push({ name, results: raceOf(contenders) });
}

function percent(share) {
    const digits = share < 0.01 ? 3 : share < 1 ? 1 : 0;
    return `${(100 * share).toFixed(digits)} %`.padStart(13);
}

if (options.json) {
    console.log(JSON.stringify(report, null, 2));
} else {
    console.log(`Cloth of ${report.cloth}, ${report.constraints} constraints without compliance, two corners `
        + `pinned; ${ticks} ticks of 1/60 s; node ${report.node}, `
        + `jolt-physics ${report.jolt_physics}, one thread.`);
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
    demandSameHash(name, results);
}
