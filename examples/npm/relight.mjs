// SPDX-License-Identifier: MIT
// node relight.mjs: how long it takes to relight 16 x 16 x 16 probes of 3 bands, by every sphere and by a field of them.
import { load } from 'lampion';

const lmp = await load(), SIDE = 16, PROBES = SIDE ** 3, BANDS = 3;
const points = lmp.floats(3 * PROBES), sh = lmp.floats(3 * BANDS ** 2 * PROBES);
for (let i = 0; i < PROBES; i++)
    points.set([i % SIDE, Math.floor(i / SIDE) % SIDE, Math.floor(i / SIDE ** 2)], 3 * i);

const ROUNDS = 41;

/** Times functions in turn, so that what else the machine does slows them alike; returns the times of each, in milliseconds. */
function time(...runs) {
    const times = runs.map(() => []);
    for (let round = -5; round < ROUNDS; round++)
        runs.forEach((run, i) => {
            const start = performance.now();
            run();
            if (round >= 0) // the first rounds run code that is not optimized yet
                times[i].push(performance.now() - start);
        });
    return times;
}

/** Says the median, and the quartiles around it. */
function spread(values) {
    const sorted = values.toSorted((a, b) => a - b), at = (part) => sorted[Math.floor(part * sorted.length)].toFixed(2);
    return `${at(0.5)} (${at(0.25)} to ${at(0.75)})`;
}

function spheres(count) {
    const lights = lmp.structs('light', count), at = () => (SIDE - 1) * Math.random();
    for (let i = 0; i < count; i++)
        lights.set(i, { position: [at(), at(), at()], radius: 0.1, radiance: [Math.random(), Math.random(), Math.random()] });
    return lights;
}

const few = spheres(32), many = spheres(1000), nodes = 6, exact = new Float32Array(sh.length);
const field = lmp.field_create({ bands: BANDS, nodes: [nodes, nodes, nodes], cell: Array(3).fill((SIDE - 1) / (nodes - 1)), reach: 1 });
const direct = (lights) => lmp.light_project_n(BANDS, lights, lights.length, null, points, PROBES, sh);
const [ofFew, ofMany, update, read] = time(() => direct(few), () => direct(many),
    () => lmp.field_update(field, many, many.length), () => lmp.field_eval_n(field, points, PROBES, sh));
const byField = update.map((value, i) => value + read[i]);

direct(many);
exact.set(sh);
lmp.field_eval_n(field, points, PROBES, sh);
const square = (values) => values.reduce((sum, value) => sum + value * value, 0);
const error = Math.sqrt(square(sh.map((value, i) => value - exact[i])) / square(exact));
console.log(`Milliseconds, medians and quartiles of ${ROUNDS} rounds:
32 spheres: ${spread(ofFew)}
1000 spheres: ${spread(ofMany)}
1000 spheres by a field of ${nodes} x ${nodes} x ${nodes} nodes: ${spread(byField)}, of which ${spread(update)} to update it
times as fast: ${spread(ofMany.map((value, i) => value / byField[i]))}; root mean square error: ${(100 * error).toFixed(1)} %`);
