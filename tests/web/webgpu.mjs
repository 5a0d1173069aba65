// SPDX-License-Identifier: MIT
// webgpu.mjs PAGE MODULE IMAGE WORK: WORK/PAGE, which imports MODULE, as a visitor of a server has it, shows IMAGE, 256 rows
// of as many pixels of three bytes, within 2 %.
import { strict as assert } from 'node:assert';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { openBrowser } from './browser.mjs';
import { serve } from './serve.mjs';

const [page, module, image, work] = process.argv.slice(2), side = 256;
copyFileSync(module, `${work}/lampion.js`); // beside the page
const address = await serve(work);
// What WebGPU draws on a page reaches a screenshot where the page is composed by Vulkan, too.
const browser = await openBrowser(`${work}/profile`, ['--enable-features=Vulkan', '--use-vulkan=swiftshader']);

async function show() {
    await browser.size(side + 16, side + 16);
    await browser.open(`${address}/${page}`);
    await browser.until('document.title === "drawn"', 30);
    const { x, y } = await browser.evaluate('document.getElementById("view").getBoundingClientRect().toJSON()');
    const { data } = await browser.tell('Page.captureScreenshot', { clip: { x, y, width: side, height: side, scale: 1 } });
    writeFileSync(`${work}/shown.png`, Buffer.from(data, 'base64'));
    return browser.evaluate(`(async () => {
        const bitmap = await createImageBitmap(await (await fetch('data:image/png;base64,${data}')).blob());
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
        context.drawImage(bitmap, 0, 0);
        return Array.from(context.getImageData(0, 0, bitmap.width, bitmap.height).data);
    })()`);
}

let status = 0;
try {
    const shown = await show(), wanted = readFileSync(image);
    assert.equal(shown.length, 4 * side * side);
    let largest = 0, brightest = 0;
    for (let i = 0; i < side * side; i++)
        for (let c = 0; c < 3; c++) {
            largest = Math.max(largest, Math.abs(shown[4 * i + c] - wanted[3 * i + c]));
            brightest = Math.max(brightest, wanted[3 * i + c]);
        }
    console.log(`the page differs by at most ${largest} of 255 levels; the brightest is ${brightest}`);
    assert.ok(brightest > 100 && largest <= 5, 'the page shows what the library computes');
    assert.deepEqual(browser.complaints, []);
} catch (error) {
    console.log(error.message, ...browser.complaints);
    status = 1;
}
await browser.close();
process.exit(status);
