// SPDX-License-Identifier: MIT
// worker.js - a Worker that lights the probes of a ProbeGrid: first it is sent { grid }, the grid's options, then
// { spheres, count } for each frame, and answers with { halves } or { error }.
import { load } from './index.js';
import { ProbeGrid } from './probes.js';

const lampion = load();
let grid;

globalThis.onmessage = async ({ data }) => {
    try {
        const lmp = await lampion;
        if (data.grid) {
            grid?.free();
            grid = new ProbeGrid(lmp, data.grid);
            return;
        }
        const halves = grid.light(data.spheres, data.count).slice();
        postMessage({ halves }, [halves.buffer]);
    } catch (error) {
        postMessage({ error: error.message });
    }
};
