// What the races can be asked for. As a program, `node options.mjs cloth|crowd OPTIONS...`, it only says what
// is wrong with them, before anything is compiled.
import { fileURLToPath } from 'node:url';
import { resolve } from 'node:path';
import { parseArgs } from 'node:util';

const common = {
    build: { type: 'string', default: 'build/web' },
    ticks: { type: 'string', default: '300' },
    json: { type: 'boolean', default: false },
};
const own = {
    cloth: { side: { type: 'string', default: '64' } },
    crowd: { crowd: { type: 'string', default: 'block' }, only: { type: 'string', default: '' } },
};

export function fail(sentence, code = 1) {
    console.error(sentence);
    process.exit(code);
}

export function demand(condition, sentence, code = 1) {
    if (!condition) {
        fail(sentence, code);
    }
}

function wholeNumber(name, text, least) {
    demand(/^\d+$/.test(text) && Number(text) >= least,
        `--${name} takes a whole number from ${least}, and not '${text}'.`, 2);
    return Number(text);
}

function regularExpression(text) {
    try {
        return new RegExp(text);
    } catch (error) {
        return fail(`--only takes a regular expression: ${error.message}.`, 2);
    }
}

function parse(race, words) {
    try {
        return parseArgs({ args: words, options: { ...common, ...own[race] } }).values;
    } catch (error) {
        return fail(`${error.message.split('. ')[0]}; bench/web/run.sh --help lists the options.`, 2);
    }
}

export function readOptions(race, words = process.argv.slice(2)) {
    const values = parse(race, words);
    const options = { ...values, build: resolve(values.build), ticks: wholeNumber('ticks', values.ticks, 1) };
    if (race === 'cloth') {
        return { ...options, side: wholeNumber('side', values.side, 3) };
    }
    demand(['block', 'pile'].includes(values.crowd),
        `--crowd takes block or pile, and not '${values.crowd}'.`, 2);
    return { ...options, only: regularExpression(values.only) };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const [race, ...words] = process.argv.slice(2);
    readOptions(race, words);
}
