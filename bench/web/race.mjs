// Tick by tick in turns, and the first one of each turn is another one each time, so that what else the
// machine does falls on all. Time is the processor's, not the wall's: nobody waits for other programs.

function processorTime() {
    const { user, system } = process.cpuUsage();
    return 1000 * (user + system);
}

export function median(numbers) {
    const sorted = [...numbers].sort((a, b) => a - b);
    const middle = sorted.length >> 1;
    return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// Each contender has step(). `look` is called with a contender's index after each of its ticks. Returned is
// what each one's ticks took, in nanoseconds, without the first ones, in which node is still compiling.
export function race(contenders, ticks, look) {
    const warmUp = Math.min(30, Math.floor(ticks / 2));
    const times = contenders.map(() => []);
    for (let tick = 0; tick < ticks; ++tick) {
        for (let turn = 0; turn < contenders.length; ++turn) {
            const index = (tick + turn) % contenders.length;
            const start = processorTime();
            contenders[index].step();
            const elapsed = processorTime() - start;
            if (tick >= warmUp) {
                times[index].push(elapsed);
            }
            look(index);
        }
    }
    return times;
}

// Of those results that have one: Lockstitch's states with and without SIMD.
export function demandSameHash(setting, results) {
    const hashes = new Set(results.map(({ hash }) => hash).filter(Boolean));
    if (hashes.size > 1) {
        console.error(`Lockstitch's states differ with and without SIMD, at ${setting}: ${[...hashes]}`);
        process.exitCode = 1;
    }
}
