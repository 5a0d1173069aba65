// SPDX-License-Identifier: MIT
// receive.mjs FOLDER PAGE FILE: opens FOLDER/PAGE in headless Chromium, and writes what the page sends into FOLDER, until
// it has sent FILE.
import { openBrowser } from './browser.mjs';
import { serve } from './serve.mjs';

const [folder, page, last] = process.argv.slice(2);
let arrived;
const image = new Promise((resolve) => { arrived = resolve; });
const address = await serve(folder, (name) => name === last && arrived(true));
const browser = await openBrowser(`${folder}/profile`);
await browser.open(`${address}/${page}`);
setTimeout(arrived, 180000, false);
let status = 0;
if (!await image) {
    console.log(`the page sent no ${last} in 3 minutes`, ...browser.complaints);
    status = 1;
}
await browser.close();
process.exit(status);
