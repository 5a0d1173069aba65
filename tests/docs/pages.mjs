// SPDX-License-Identifier: MIT
// pages.mjs WORK SITE [FOLDER]: every page of the site in headless Chromium, as wide as a desktop and as a phone: nothing
// reaches beyond the screen but what scrolls by itself, no image is missing, what a finger opens is as high as a finger.
// With FOLDER, an image of each is written there.
import { strict as assert } from 'node:assert';
import { readdirSync, writeFileSync } from 'node:fs';
import { openBrowser } from '../web/browser.mjs';

const [work, site, folder] = process.argv.slice(2);
const widths = { desktop: 1280, phone: 390 };
const finger = 30; // CSS pixels; WCAG 2.2 asks for 24

// Runs in the page, and returns what is wrong with it, as sentences.
function faults(width, least) {
    const scrolls = (element) => element && (element.scrollWidth > element.clientWidth &&
        /auto|scroll/.test(getComputedStyle(element).overflowX) || scrolls(element.parentElement));
    const name = (element) => `${element.localName} "${element.textContent.trim().slice(0, 60)}"`;
    const found = [];
    if (document.documentElement.scrollWidth > width)
        found.push(`is ${document.documentElement.scrollWidth} pixels wide`);
    for (const element of document.querySelectorAll('main *, header *, nav *, aside *')) {
        const { left, right } = element.getBoundingClientRect();
        if ((right > width + 1 || left < -1) && !scrolls(element.parentElement))
            found.push(`${name(element)} reaches from ${Math.round(left)} to ${Math.round(right)}`);
    }
    for (const image of document.images)
        if (!image.complete || !image.naturalWidth)
            found.push(`no image ${image.src}`);
    for (const element of width < 800 ? document.querySelectorAll('nav a, nav label, aside a, aside label, search input') : []) {
        const { height } = element.getBoundingClientRect();
        if (height && height < least)
            found.push(`${name(element)} is ${Math.round(height)} pixels high`);
    }
    return found;
}

const browser = await openBrowser(`${work}/profile`);

async function look(page, kind) {
    await browser.size(widths[kind], 900, kind === 'phone');
    const found = [];
    for (const opened of [true, false]) { // the lists of pages and of headings
        await browser.evaluate(`for (const box of document.querySelectorAll("nav input, aside input")) box.checked = ${opened}`);
        found.push(...await browser.evaluate(`(${faults})(${widths[kind]}, ${finger})`));
    }
    return [...new Set(found)].map((fault) => `${page} on a ${kind}: ${fault}`);
}

// Taken in pieces, because browsers draw no image as high as a long page.
async function capture(page, kind) {
    const total = await browser.evaluate('document.documentElement.scrollHeight'), width = widths[kind], height = 1900;
    for (let y = 0, piece = 10; y < total; y += height, piece++) {
        const clip = { x: 0, y, width, height: Math.min(height, total - y), scale: kind === 'phone' ? 0.5 : 1 };
        const { data } = await browser.tell('Page.captureScreenshot', { captureBeyondViewport: true, clip });
        writeFileSync(`${folder}/${kind}-${page.replaceAll('/', '-')}-${piece}.png`, Buffer.from(data, 'base64'));
    }
}

const pages = readdirSync(site, { recursive: true }).filter((name) => name.endsWith('.html') && !name.startsWith('demo/')).sort();
try {
    const wrong = [];
    for (const page of pages) {
        await browser.open(`file://${site}/${page}`);
        await browser.until('document.readyState === "complete" && location.protocol === "file:"', 20);
        for (const kind of Object.keys(widths)) {
            wrong.push(...await look(page, kind));
            if (folder)
                await capture(page, kind);
        }
    }
    assert.deepEqual(wrong, []);
    console.log(`${pages.length} pages`);
} finally {
    await browser.close();
}
