// SPDX-License-Identifier: MIT
// materials.mjs FOLDER: materials in three's WebGPURenderer, by FOLDER/materials.html in headless Chromium: those that are
// no node materials are lit as those that are, and where the renderer falls back to WebGL 2, an error says what to take.
import assert from 'node:assert/strict';
import { openBrowser } from './browser.mjs';
import { serve } from './serve.mjs';

const [folder] = process.argv.slice(2);
const address = await serve(folder), browser = await openBrowser(`${folder}/profile`);
const draw = (kind, light, options = {}) => browser.evaluate(`draw('${kind}', '${light}', ${JSON.stringify(options)})`);
try {
    await browser.open(`${address}/materials.html`);
    await browser.until('window.ready');
    for (const light of ['lamp', 'probes']) {
        const [wanted] = await draw('MeshStandardNodeMaterial', light);
        // a white lamp of 5 candela, 2 from the ball: the albedo, 0.216, times 5 / 4 / pi, and a highlight of a few percent
        assert.ok(wanted > 0.08 && wanted < 0.11, `${light}: ${wanted}`);
        for (const kind of ['MeshStandardMaterial', 'MeshPhysicalMaterial', 'MeshPhysicalNodeMaterial']) {
            const [found, after] = await draw(kind, light);
            assert.ok(Math.abs(found - wanted) <= 1e-4, `${kind}, ${light}: ${found}, not ${wanted}`);
            assert.equal(after, 0, `${kind}, ${light}: light is left`);
        }
        assert.deepEqual(await draw('MeshLambertMaterial', light), [0, 0]);
    }
    assert.deepEqual(await browser.evaluate('errors'), []);
    assert.ok((await draw('MeshStandardMaterial', 'probes', { forceWebGL: true }))[0] > 0.08, 'probes by WebGL 2');
    assert.deepEqual(await browser.evaluate('errors'), []);
    await draw('MeshStandardMaterial', 'lamp', { forceWebGL: true });
    assert.match((await browser.evaluate('errors')).join(), /need WebGPU.*fell back to WebGL 2/);
    assert.deepEqual(browser.complaints, []);
} finally {
    await browser.close();
}
