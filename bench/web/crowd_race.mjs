// The same humanoids falling in Lockstitch, in Jolt Physics and in Rapier, all as WebAssembly on one thread:
// milliseconds a tick, and how far joints come apart, since cost means nothing without error.
// usage: node crowd_race.mjs --build FOLDER [--ticks N] [--crowd block|pile] [--only TEXT] [--json]
//   FOLDER: as run.sh makes it; block: 100 on a plane, pile: 30 in a pit; TEXT: what the names of those who
//   run must match
import { CrowdMeasure, CrowdRun } from './crowd_errors.mjs';
import { inertia } from './crowd_shape.mjs';
import { JoltCrowd } from './jolt_crowd.mjs';
import { createJolt, joltVersion } from './jolt_system.mjs';
import { LockstitchCrowds } from './lockstitch_crowd.mjs';
import { demand, readOptions } from './options.mjs';
import { demandSameHash, median, race } from './race.mjs';
import { RapierCrowd, loadRapier } from './rapier_crowd.mjs';

const options = readOptions('crowd');
const { build, ticks } = options;
const ourSubsteps = [8, 4, 2, 1];

async function loadOurs(folder) {
    return LockstitchCrowds.load(`${build}/${folder}/lockstitch_crowd.js`, options.crowd === 'pile');
}

const ours = { SIMD: await loadOurs('wasm32-simd128'), plain: await loadOurs('wasm32') };
const { crowd } = ours.SIMD;
const rapier = {
    SIMD: await loadRapier(build, 'simd'),
    deterministic: await loadRapier(build, 'deterministic'),
};

function plural(count, noun) {
    return `${count} ${noun}${count === 1 ? '' : 's'}`;
}

function allContenders() {
    const list = [];
    const add = (engine, name, create) => list.push({ engine, name: `${engine}, ${name}`, create });
    const addJolt = (name, settings, flavour = 'simd') =>
        add('Jolt', name, async () => new JoltCrowd(await createJolt(build, flavour), crowd, settings));
    const addRapier = (name, settings, flavour = 'SIMD') =>
        add('Rapier', name, () => new RapierCrowd(rapier[flavour], crowd, settings));

    for (const [flavour, crowds] of Object.entries(ours)) {
        for (const substeps of ourSubsteps) {
            add('Lockstitch', `${flavour}, ${plural(substeps, 'substep')}`, () => crowds.create(substeps));
        }
    }
    // Its defaults are ten velocity and two position iterations.
    for (const steps of [1, 2, 4, 8]) {
        addJolt(`SIMD, ${plural(steps, 'step')}`, { steps });
    }
    for (const [velocitySteps, positionSteps] of [[4, 1], [20, 8], [40, 16]]) {
        addJolt(`SIMD, 1 step of ${velocitySteps} + ${positionSteps}`, { velocitySteps, positionSteps });
    }
    addJolt('SIMD, 8 steps of 2 + 1', { steps: 8, velocitySteps: 2, positionSteps: 1 });
    addJolt('SIMD, 1 step, feet first', { reversed: true });
    for (const steps of [1, 4]) {
        addJolt(`plain, ${plural(steps, 'step')}`, { steps }, 'plain');
    }
    // Its iterations are substeps; four are the default.
    for (const iterations of [4, 8, 16]) {
        addRapier(`SIMD, ${iterations} iterations`, { iterations });
    }
    addRapier('SIMD, 4 steps', { steps: 4 });
    for (const steps of [1, 4]) {
        addRapier(`deterministic, ${plural(steps, 'step')}`, { steps }, 'deterministic');
    }
    return list.filter(({ name }) => options.only.test(name));
}

// A peer must be given what ours is: the masses, the moments of inertia, and joints at rest.
function checkPeer({ name, world }, measure) {
    const alike = (a, b) => Math.abs(a / b - 1) < 1e-4;
    world.masses().forEach(({ mass, inertia: found }, i) => {
        const bone = crowd.bones[i % crowd.bones.length];
        const wanted = inertia(bone);
        demand(alike(mass, bone.mass) && found.every((moment, axis) => alike(moment, wanted[axis])),
            `${name}: body ${i} has ${mass} kg and ${found} kg·m², and not ${bone.mass} and ${wanted}.`);
    });
    const { worst, beyond } = measure.errors(world.states());
    demand(worst < 1e-5 && beyond < 1e-3, `${name}: joints begin ${worst} m and ${beyond} rad from rest.`);
}

// What the SDK says of itself must be what is measured here.
function checkOurs({ name, world }, measure) {
    const states = world.states();
    world.joints().forEach((said, i) => {
        const seen = measure.joint(measure.joints[i], states);
        demand(['apart', 'swing', 'twist'].every((what) => Math.abs(said[what] - seen[what]) < 1e-4),
            `${name}: joint ${i} is ${JSON.stringify(seen)}, and the SDK says ${JSON.stringify(said)}.`);
    });
    const [said, seen] = [world.energy(), measure.energy(states)];
    demand(Math.abs(said / seen - 1) < 1e-4, `${name}: the energy is ${seen} J, and the SDK says ${said} J.`);
}

const measure = new CrowdMeasure(crowd);
const runs = await Promise.all(allContenders().map(async ({ engine, name, create }) =>
    ({ engine, name, world: await create() })));
for (const run of runs) {
    if (run.engine !== 'Lockstitch') {
        checkPeer(run, measure);
    }
    run.errors = new CrowdRun(measure, run.world.states());
}
const times = race(runs.map(({ world }) => world), ticks, (i) => runs[i].errors.add(runs[i].world.states()));
const results = runs.map((run, i) => {
    const { engine, name, world, errors } = run;
    if (engine === 'Lockstitch') {
        checkOurs(run, measure);
    } else {
        demand(world.awake() === world.bodies.length,
            `${name}: ${world.awake()} of ${world.bodies.length} bodies are awake.`);
    }
    return {
        name, engine, ms_per_tick: median(times[i]) / 1e6, slowest_ms: Math.max(...times[i]) / 1e6,
        ...errors.result(), hash: world.hash?.(),
    };
});

// Of ours, the fastest whose joints are no further apart, by the mean and by the worst.
function cheapestOfOurs({ joint_error_mm: { mean, worst } }) {
    return results.filter(({ engine, joint_error_mm: error }) =>
        engine === 'Lockstitch' && error.mean <= mean && error.worst <= worst)
        .sort((a, b) => a.ms_per_tick - b.ms_per_tick)[0];
}

for (const result of results) {
    const own = result.engine === 'Lockstitch' ? undefined : cheapestOfOurs(result);
    if (own !== undefined) {
        result.no_worse_of_ours = { name: own.name, share_of_time: own.ms_per_tick / result.ms_per_tick };
    }
}

const report = {
    crowd: options.crowd, bodies: measure.bones.length, joints: measure.joints.length, ticks,
    node: process.version, jolt_physics: joltVersion(build), rapier: rapier.SIMD.version(),
    rapier_deterministic: rapier.deterministic.version(), results,
};

function printTable() {
    const { bodies, joints, node, jolt_physics: jolt, rapier: simd, rapier_deterministic: other } = report;
    console.log(`${bodies} bodies, ${joints} joints, ${ticks} ticks of 1/60 s; node ${node}, `
        + `jolt-physics ${jolt}, Rapier ${simd} and, deterministic, ${other}; one thread.\n`);
    const columns = ['', 'ms/tick', 'apart: mean', 'worst', 'beyond limits', 'energy gained', 'at end',
        'height', 'in ground: worst', 'mean at end', 'ours, no worse'];
    console.log(`| ${columns.join(' | ')} |`);
    console.log(`|---|${'--:|'.repeat(columns.length - 1)}`);
    for (const result of results) {
        const { joint_error_mm: apart, in_ground_mm: ground, no_worse_of_ours: own } = result;
        const cells = [result.name, result.ms_per_tick.toFixed(1), `${apart.mean.toPrecision(2)} mm`,
            `${apart.worst.toFixed(1)} mm`, `${result.beyond_limits_degrees.toFixed(0)}°`,
            `${result.energy_gained_joules.toFixed(0)} J`, `${result.energy_at_end_joules.toFixed(0)} J`,
            `${result.height_at_end_metres.toFixed(3)} m`, `${ground.worst.toFixed(0)} mm`,
            `${ground.mean_at_end.toFixed(1)} mm`,
            own ? `${own.share_of_time.toFixed(2)} (${own.name.replace('Lockstitch, ', '')})` : ''];
        console.log(`| ${cells.join(' | ')} |`);
    }
}

if (options.json) {
    console.log(JSON.stringify(report, null, 2));
} else {
    printTable();
}

for (const substeps of ourSubsteps) {
    const setting = plural(substeps, 'substep');
    demandSameHash(setting, results.filter(({ name }) => name.endsWith(`, ${setting}`)));
}
