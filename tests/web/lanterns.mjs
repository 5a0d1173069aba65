// SPDX-License-Identifier: MIT
// lanterns.mjs FOLDER: the room of lanterns in headless Chromium: on probes, on probes that a worker lights, and under
// three's own lights. Prints the milliseconds of frames.
import assert from 'node:assert/strict';
import { openBrowser } from './browser.mjs';
import { serve } from './serve.mjs';

const [folder] = process.argv.slice(2);
const address = await serve(folder), browser = await openBrowser(`${folder}/profile`);
const open = (query) => browser.open(`${address}/lanterns.html?${query}`);
try {
    for (const query of ['lights=1000&frames=5', 'lights=100&frames=5', 'lights=100&frames=5&three', 'lights=10&frames=5', 'lights=10&frames=5&three']) {
        await open(query);
        await browser.until('window.times');
        const { times, errors, pixel } = await browser.evaluate('({ times, errors, pixel })');
        assert.deepEqual(errors, []);
        assert.ok(pixel[0] + pixel[1] + pixel[2] > 30, `${query}: the floor is dark`);
        console.log(query, times.sort((a, b) => a - b)[2].toFixed(0));
    }
    await open('lights=50&worker');
    await browser.until('window.volume?.grid.halves.some((half) => half)');
    assert.deepEqual(browser.complaints, []);
} finally {
    await browser.close();
}
