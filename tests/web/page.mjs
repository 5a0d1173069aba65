// SPDX-License-Identifier: MIT
// page.mjs FOLDER PROGRAM WORK: the demo in FOLDER as a visitor has it, opened from disk: what it draws against
// PROGRAM's image, its first frame, probes against their definition, lights dragged by mouse and finger, splats, a link to what
// is shown, another size, a lost GPU, a dropped file, a phone.
import { strict as assert } from 'node:assert';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { openBrowser } from './browser.mjs';

const [folder, program, work] = process.argv.slice(2);
const edges = 0.04; // of a small image's pixels show other triangles

const browser = await openBrowser(`${work}/profile`);
const { evaluate, until, tell } = browser;

async function open(hash) {
    await browser.open(`file://${folder}/index.html#${hash}`);
    await until('globalThis.lampion?.ready || document.getElementById("message")?.className === "wrong"');
    assert.equal(await evaluate('document.getElementById("message").textContent'), '');
}
const pixels = `(lampion.draw(), createImageBitmap(document.getElementById("view")))`;

// Returns the fraction of the page's pixels that differ by more than two levels from what PROGRAM renders.
const rendered = (...options) => differ(2, ...options);

async function differ(levels, ...options) {
    const exposure = await evaluate('lampion.exposure');
    execFileSync(program, ['render', `builtin:${await evaluate('lampion.state.scene')}`, '--no-shadows', '--samples', '1', '--exposure', `${exposure}`,
        '--animate', 'orbit', '--frames', '0-0', ...options, '-o', `${work}/wanted.png`]);
    const image = readFileSync(`${work}/wanted_0000.png`).toString('base64');
    return evaluate(`(async () => {
        const read = (bitmap) => {
            const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
            context.drawImage(bitmap, 0, 0);
            return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
        };
        const shown = read(await ${pixels});
        const wanted = read(await createImageBitmap(await (await fetch('data:image/png;base64,${image}')).blob()));
        if (shown.length !== wanted.length)
            return 1;
        let count = 0;
        for (let i = 0; i < shown.length; i += 4)
            count += Math.max(...[0, 1, 2].map((c) => Math.abs(shown[i + c] - wanted[i + c]))) > ${levels} ? 1 : 0;
        return count / (shown.length / 4);
    })()`);
}

// Returns the page's pixels, and the fraction of the bytes of two such that differ.
const read = () => evaluate(`(async () => {
    const bitmap = await ${pixels}, context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return [...context.getImageData(0, 0, bitmap.width, bitmap.height).data];
})()`);
const unlike = (a, b) => (a.length === b.length ? a.filter((x, i) => Math.abs(x - b[i]) > 2).length / a.length : 1);

async function screenshot(name) {
    const { data } = await tell('Page.captureScreenshot');
    writeFileSync(`${work}/${name}.png`, Buffer.from(data, 'base64'));
}

// Finds a light that is visible, and its position on the page.
const findLight = () => evaluate(`Array.from({ length: 30 }, (none, i) => i).find((i) => {
    const [x, y] = lampion.project(i);
    return x > 40 && x < innerWidth - 80 && y > 20 && y < innerHeight / 2 && lampion.pick([x, y]) === i;
})`);
const whereIs = (i) => evaluate(`lampion.project(${i})`);
const lightAt = async (i) => JSON.stringify(await evaluate(`lampion.lightAt(${i})`));

async function draw() {
    await browser.size(1280, 720);
    await open('time=0&scale=1&closed&lights=30');
    const size = ['--size', '1280x720'];
    const same = await rendered(...size, '--bands', '8');
    console.log(`${(100 * same).toFixed(2)} % of the pixels differ by more than 2 levels; a frame takes ${
        (await evaluate('lampion.frameTime')).toFixed(0)} ms`);
    assert.ok(same <= 0.01, 'the page draws what lampion render does');
    await screenshot('desktop');
}

// Returns the brightness of an image's squares, 16 across and 9 down.
const squares = (image) => evaluate(`(async () => {
    const context = new OffscreenCanvas(16, 9).getContext('2d'), bitmap = await createImageBitmap(await (await fetch('data:image/png;base64,${image}')).blob());
    context.imageSmoothingQuality = 'high';
    context.drawImage(bitmap, 0, 0, 16, 9);
    const { data } = context.getImageData(0, 0, 16, 9);
    return Array.from({ length: 144 }, (none, i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2]);
})()`);

// The first frame, of a page that never gets to a second one: a draft of the atrium under its own lanterns.
async function first() {
    await browser.size(320, 180);
    const { identifier } = await tell('Page.addScriptToEvaluateOnNewDocument', { source: 'globalThis.requestAnimationFrame = () => 0' });
    await browser.open(`file://${folder}/index.html#closed`);
    await until('document.getElementById("message")?.textContent === ""');
    await until('document.getElementById("view").width === 80');
    assert.ok(await evaluate('!lampion.ready && lampion.spheres().length / 12 === 30'), 'the lights that move are not there');
    await evaluate('document.getElementById("panel").hidden = true');
    const { data } = await tell('Page.captureScreenshot');
    await tell('Page.removeScriptToEvaluateOnNewDocument', { identifier });
    writeFileSync(`${work}/first.png`, Buffer.from(data, 'base64'));
    execFileSync(program, ['render', 'builtin:atrium', '--no-shadows', '--size', '320x180', '-o', `${work}/atrium.png`]);
    const shown = await squares(data), wanted = await squares(readFileSync(`${work}/atrium.png`).toString('base64'));
    const mean = (a) => a.reduce((sum, x) => sum + x, 0) / a.length;
    const product = (a, b) => mean(a.map((x, i) => (x - mean(a)) * (b[i] - mean(b))));
    const alike = product(shown, wanted) / Math.sqrt(product(shown, shown) * product(wanted, wanted)), brighter = mean(shown) / mean(wanted);
    console.log(`the first frame: correlation ${alike.toFixed(2)}, ${brighter.toFixed(2)} times as bright`);
    assert.ok(alike >= 0.8 && brighter >= 0.7 && brighter <= 1.4, 'the first frame shows the atrium');
}

async function choose() {
    await browser.size(320, 180);
    await open('time=0&scale=1&closed&lights=100&bands=5&method=coefficients&window=none');
    const size = ['--size', '320x180', '--keep-lights', '--random-lights', '70', '--seed', '1', '--method', 'coefficients'];
    const hundred = await rendered(...size, '--bands', '5', '--window', 'none');
    assert.ok(hundred <= edges, `100 lights by coefficients: ${hundred}`);
    assert.ok(await rendered(...size, '--bands', '6', '--window', 'none') > 2 * edges, 'another number of bands is seen');
    await open('time=0&scale=1&closed&lights=30&bands=100&method=preintegrated');
    const many = await rendered('--size', '320x180', '--bands', '100', '--method', 'preintegrated');
    assert.ok(many <= edges, `100 bands: ${many}`);
    await open('time=0&scale=1&closed&lights=30&split=0.5');
    const split = await rendered('--size', '320x180', '--bands', '8');
    assert.ok(split > 2 * edges && split < 0.5, `half of the image has 100 bands (${split} differs)`);
}

// The room's lights are areas, but for a globe.
async function room() {
    await open('scene=room&time=0&scale=1&closed');
    const same = await rendered('--size', '320x180', '--bands', '8');
    assert.ok(same <= edges, `the room: ${same}`);
    assert.ok(await rendered('--size', '320x180', '--bands', '8', '--hide-lights') > edges, 'areas are seen');
    await screenshot('room');
    await open('scene=room&time=0&scale=1&closed&bands=8&method=preintegrated');
    const beside = await rendered('--size', '320x180', '--bands', '8', '--method', 'preintegrated');
    assert.ok(beside <= edges, `areas beside preintegrated lobes: ${beside}`);
}

// Returns the irradiance at a probe that faces n, by the polynomial of lampion/probe.h.
function probed({ size, texels }, i, n) {
    const count = size[0] * size[1] * size[2], vector = (slab) => texels.slice(4 * (slab * count + i), 4 * (slab * count + i) + 4);
    const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0), [x, y, z] = n;
    return [0, 1, 2].map((c) => dot(vector(c), [x, y, z, 1]) + dot(vector(3 + c), [x * y, y * z, z * z, z * x]) + vector(6)[c] * (x * x - y * y));
}

// Returns the same of three bands from its definition, the sum over the bands of A_l (2l+1)/(4 pi) P_l(n · w) times the
// integral of P_l over the cap that a sphere covers, and the part of the first band, which scales errors.
function irradiance(spheres, point, n) {
    const sum = [0, 0, 0], mean = [0, 0, 0];
    for (const { center, radius, radiance } of spheres) {
        const way = center.map((x, axis) => x - point[axis]), distance = Math.hypot(...way);
        if (distance < 1.01 * radius)
            return null;
        const t = way.reduce((all, x, axis) => all + x * n[axis], 0) / distance, c = Math.sqrt(1 - (radius / distance) ** 2);
        const bands = [Math.PI * (1 - c) / 2, Math.PI / 2 * (1 - c * c) * t, 5 * Math.PI / 16 * (c - c ** 3) * (3 * t * t - 1) / 2];
        radiance.forEach((x, channel) => {
            sum[channel] += x * (bands[0] + bands[1] + bands[2]);
            mean[channel] += x * bands[0];
        });
    }
    return { sum, mean };
}

// The grid follows the lights, and surfaces read it.
async function probes() {
    for (const time of [0, 2]) {
        await open(`scene=balls&time=${time}&scale=0.2&closed&lights=30&method=probes`);
        const { grid, lights } = await evaluate(`lampion.draw(), { grid: (({ minimum, extent, size, texels }) => ({ minimum: [...minimum],
            extent: [...extent], size, texels: [...texels] }))(lampion.probes()), lights: [...lampion.spheres()] }`);
        const spheres = Array.from({ length: lights.length / 12 }, (none, i) => lights.slice(12 * i, 12 * i + 7))
            .map(([x, y, z, radius, ...radiance]) => ({ center: [x, y, z], radius, radiance })), { size } = grid;
        assert.equal(spheres.length, 30);
        let count = 0;
        for (let i = 0; i < size[0] * size[1] * size[2]; i += 7) {
            const at = [i % size[0], Math.floor(i / size[0]) % size[1], Math.floor(i / (size[0] * size[1]))];
            const point = at.map((k, axis) => grid.minimum[axis] + grid.extent[axis] * k / (size[axis] - 1));
            for (const n of [[0, 1, 0], [0.6, 0, -0.8], [-0.48, -0.6, 0.64]]) {
                const wanted = irradiance(spheres, point, n), found = probed(grid, i, n);
                for (const channel of wanted ? [0, 1, 2] : [])
                    assert.ok(Math.abs(found[channel] - wanted.sum[channel]) <= 1e-4 * wanted.mean[channel], `probe ${i}: ${found}, not ${wanted.sum}`);
                count += wanted ? 1 : 0;
            }
        }
        assert.ok(count > 500, `${count} irradiances`);
    }
    await open('scene=room&time=0&scale=1&closed&method=probes');
    const far = await differ(24, '--size', '320x180', '--method', 'coefficients', '--bands', '3', '--window', 'none');
    assert.ok(far <= 0.2, `the room on probes, without its gloss: ${far}`);
    await screenshot('probes');
}

// Returns the integral of the cosine to n, where it is positive, over the cap of directions that a sphere covers: in closed
// form where the horizon does not cut the cap, else as a sum over directions.
function capCosine({ center, radius }, point, n) {
    const way = center.map((x, axis) => x - point[axis]), distance = Math.hypot(...way), dot = (a, b) => a.reduce((sum, x, axis) => sum + x * b[axis], 0);
    const axis = way.map((x) => x / distance), sine = radius / distance, t = dot(axis, n);
    if (Math.abs(t) >= sine)
        return t > 0 ? Math.PI * sine * sine * t : 0;
    const across = Math.sqrt(1 - t * t), lowest = Math.sqrt(1 - sine * sine), steps = 200;
    let sum = 0;
    for (let i = 0; i < steps; i++)
        for (let k = 0; k < steps; k++) {
            const c = 1 - (1 - lowest) * (i + 0.5) / steps, s = Math.sqrt(1 - c * c);
            sum += Math.max(0, c * t + s * across * Math.cos(2 * Math.PI * (k + 0.5) / steps));
        }
    return sum * 2 * Math.PI * (1 - lowest) / steps ** 2;
}

// Splats are matte surfaces under the lights, and are seen where the ball does not hide them.
async function splats() {
    const eye = [0, 1.75, 6.6], ball = [0, 1.18, 0], view = `view=${[...eye, 0, 1.12, 0]}`;
    let centers;
    await browser.size(320, 180);
    for (const time of [0, 4]) {
        await open(`scene=splats&time=${time}&scale=1&closed&lights=30&${view}`);
        const { floats, lights } = await evaluate('lampion.draw(), { floats: [...lampion.splats()], lights: [...lampion.spheres()] }');
        const spheres = Array.from({ length: lights.length / 12 }, (none, i) => lights.slice(12 * i, 12 * i + 7))
            .map(([x, y, z, radius, ...radiance]) => ({ center: [x, y, z], radius, radiance }));
        assert.equal(spheres.length, 30);
        centers = Array.from({ length: floats.length / 18 }, (none, i) => floats.slice(18 * i, 18 * i + 3));
        for (let i = 0; 18 * i < floats.length; i += 61) {
            const [center, normal, along, across, albedo, color] = [0, 3, 6, 9, 12, 15].map((at) => floats.slice(18 * i + at, 18 * i + at + 3));
            for (const axis of [along, across])
                assert.ok(Math.abs(axis.reduce((sum, x, k) => sum + x * normal[k], 0)) <= 1e-5, `splat ${i} is flat`);
            const lit = [0, 0, 0];
            for (const sphere of spheres) {
                const cosine = capCosine(sphere, center, normal);
                sphere.radiance.forEach((x, channel) => { lit[channel] += x * cosine / Math.PI; });
            }
            for (const channel of [0, 1, 2])
                assert.ok(Math.abs(color[channel] - albedo[channel] * lit[channel]) <= 2e-3 * lit[channel], `splat ${i}: ${color}, not ${lit} times ${albedo}`);
        }
    }
    const shown = await read(), places = await evaluate(`${JSON.stringify(centers)}.map(lampion.see).map((place) => place.map((x) => Math.floor(x)))`);
    await screenshot('splats');
    await open(`scene=ball&time=4&scale=1&closed&lights=30&${view}`);
    const bare = await read(), differs = ([x, y]) => [0, 1, 2].some((c) => Math.abs(shown[4 * (320 * y + x) + c] - bare[4 * (320 * y + x) + c]) > 2);
    const sum = (a, b) => a.reduce((all, x, k) => all + x * b[k], 0), from = eye.map((x, k) => x - ball[k]);
    const isHidden = (center) => { // whether the ray to the splat enters the ball, of radius 1, before it
        const way = center.map((x, k) => x - eye[k]), a = sum(way, way), b = sum(way, from), root = b * b - a * (sum(from, from) - 1);
        return root > 0 && -b - Math.sqrt(root) < a;
    };
    const front = places.filter((place, i) => !isHidden(centers[i]));
    const behind = places.filter(([x, y], i) => isHidden(centers[i]) && !front.some((place) => Math.hypot(place[0] - x, place[1] - y) < 8));
    const seen = front.filter(differs).length / front.length;
    assert.ok(seen >= 0.7, `${seen} of the splats that nothing but lamps hides are seen`);
    assert.ok(behind.length >= 50 && !behind.some(differs), `${behind.filter(differs).length} of ${behind.length} splats behind the ball are seen`);
}

// Lanterns that probes alone afford.
async function lanterns() {
    await open('scene=atrium:lanterns=1000&time=0&scale=0.5&closed');
    assert.deepEqual(await evaluate('[lampion.state.method, lampion.spheres().length / 12, document.getElementById("scene").value]'),
        ['probes', 1000, 'atrium:lanterns=1000']);
    await screenshot('lanterns');
}

async function drag() {
    await open('time=0&scale=1&closed&lights=30');
    const light = await findLight(), before = await lightAt(light), from = await whereIs(light);
    const to = [from[0] + 40, from[1] + 30];
    const mouse = (type, [x, y]) => tell('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1 });
    await mouse('mousePressed', from);
    await mouse('mouseMoved', to);
    await mouse('mouseReleased', to);
    await evaluate('lampion.draw()');
    assert.notEqual(await lightAt(light), before, 'a light follows the mouse');
    const at = await whereIs(light);
    assert.ok(Math.hypot(at[0] - to[0], at[1] - to[1]) < 1.5, `to where the mouse is: ${at}, not ${to}`);
    assert.ok(await rendered('--size', '320x180', '--bands', '8') > 2 * edges, 'and its light with it');
}

// The atrium's lanterns stay where their cages are, while the other lights move.
async function rest() {
    await open('time=0&scale=1&closed');
    const all = () => evaluate('lampion.draw(), Array.from({ length: 40 }, (none, i) => lampion.lightAt(i).join())');
    const before = await all();
    await open('time=3&scale=1&closed');
    const after = await all();
    assert.ok(before.every((light, i) => (light === after[i]) === (i < 30)), 'the first 30 lights alone rest');
}

// The whole panel must be visible in a small window.
async function small() {
    await browser.size(640, 420);
    await open('time=0&scale=0.3');
    await until('document.getElementById("cost").textContent !== ""');
    const panel = 'document.getElementById("panel")';
    assert.ok(await evaluate(`${panel}.open && ${panel}.scrollHeight <= ${panel}.clientHeight`), 'the panel does not scroll');
    assert.ok(await evaluate(`${panel}.getBoundingClientRect().bottom <= innerHeight`), 'the panel ends in the window');
    assert.equal(await evaluate('document.getElementById("scale").selectedOptions[0].textContent'), '0.3');
    await screenshot('small');
    await browser.size(320, 180);
}

// Presses the button by the keyboard, and returns what the page says then.
async function pressShare(clipboard) {
    await evaluate(`navigator.clipboard.writeText = ${clipboard}, document.getElementById("shared").value = "",
        document.getElementById("share").focus(), 0`);
    for (const type of ['keyDown', 'keyUp'])
        await tell('Input.dispatchKeyEvent', { type, key: 'Enter', code: 'Enter', windowsVirtualKeyCode: 13, text: type === 'keyDown' ? '\r' : '' });
    await until('document.getElementById("shared").value !== ""');
    return evaluate('document.getElementById("shared").value');
}

// The link that the button copies shows the same.
async function share() {
    await browser.size(640, 420);
    await open('time=1.5&scale=0.25&lights=50&bands=5&window=none&method=coefficients&split=0.3&exposure=1');
    const mouse = (type, [x, y]) => tell('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1 });
    const before = await read();
    await mouse('mousePressed', [320, 400]);
    await mouse('mouseMoved', [380, 360]);
    await mouse('mouseReleased', [380, 360]);
    const shown = await read(), state = await evaluate('JSON.stringify(lampion.state)');
    assert.ok(unlike(before, shown) > 2 * edges, 'the view has turned');
    assert.equal(await pressShare('async (text) => { globalThis.copied = text; }'), 'Copied.');
    await screenshot('share');
    const link = await evaluate('copied');
    assert.equal(await pressShare('() => Promise.reject(new Error("refused"))'), 'It is the address now.');
    assert.equal(await evaluate('location.href'), link);
    await open(link.split('#')[1]);
    assert.equal(await evaluate('JSON.stringify(lampion.state)'), state);
    const again = unlike(shown, await read());
    assert.ok(again <= edges / 4, `the link shows the same: ${again} differs`);
    await browser.size(320, 180);
}

async function resize() {
    await browser.size(200, 150);
    await until('lampion.draw(), document.getElementById("view").width === 200');
    assert.equal(await evaluate('document.getElementById("view").height'), 150);
}

// Automatic resolution is lower while lights move than at rest.
async function adapt() {
    await browser.size(640, 360);
    const width = () => evaluate('document.getElementById("view").width');
    await open('lights=30&closed');
    await until('document.getElementById("frame").value !== ""');
    await evaluate('new Promise((wake) => setTimeout(wake, 1500))');
    const moving = await width();
    await open('time=0&lights=30&closed');
    await until('lampion.rested()');
    const rest = await width();
    assert.ok(moving >= 64 && rest >= moving, `${moving} pixels across while lights move, ${rest} at rest`);
    await browser.size(320, 180);
}

async function lose() {
    await browser.size(200, 150);
    await open('time=0&scale=1&closed&lights=30');
    await evaluate('globalThis.loss = lampion.gl.getExtension("WEBGL_lose_context"), loss.loseContext()');
    await until('!lampion.gl');
    await evaluate('loss.restoreContext()');
    await until('lampion.gl');
    const same = await rendered('--size', '200x150', '--bands', '8');
    assert.ok(same <= edges, `the same image after the GPU was lost: ${same} differs`);
}

async function drop() {
    const file = async (name, bytes) => {
        writeFileSync(`${work}/${name}`, bytes);
        const { root } = await tell('DOM.getDocument');
        const { nodeId } = await tell('DOM.querySelector', { nodeId: root.nodeId, selector: '#file' });
        await tell('DOM.setFileInputFiles', { nodeId, files: [`${work}/${name}`] });
    };
    const positions = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
    const gltf = {
        asset: { version: '2.0' }, scenes: [{ nodes: [0] }], scene: 0, nodes: [{ mesh: 0 }],
        meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
        buffers: [{ byteLength: 36, uri: `data:application/octet-stream;base64,${positions.toString('base64')}` }],
        bufferViews: [{ buffer: 0, byteLength: 36 }],
        accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] }],
    };
    await file('triangle.gltf', JSON.stringify(gltf));
    await until('lampion.state.scene === "triangle.gltf"');
    gltf.accessors[0].count = 4;
    await file('broken.gltf', JSON.stringify(gltf));
    await until('/^broken.gltf: .*accessor 0/.test(document.getElementById("message").textContent)');
    assert.equal(await evaluate('lampion.draw(), document.getElementById("scene").value'), 'triangle.gltf');
    gltf.accessors[0].count = 3;
    gltf.buffers[0].uri = 'triangle.bin';
    await file('parts.gltf', JSON.stringify(gltf));
    await until('/^parts.gltf: .*triangle.bin.*use a .glb/.test(document.getElementById("message").textContent)');
    assert.ok(await evaluate('document.getElementById("share").disabled'), 'no link holds a file');
}

async function phone() {
    await browser.size(390, 844, true);
    await open('time=0&scale=0.3&lights=30');
    assert.ok(await evaluate('document.documentElement.scrollWidth <= 390'), 'the page is no wider than a phone');
    const touch = (type, points) => tell('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
    const light = await findLight(), before = await lightAt(light), from = await whereIs(light);
    await touch('touchStart', [from]);
    await touch('touchMove', [[from[0] + 20, from[1] + 60]]);
    await touch('touchEnd', []);
    await evaluate('lampion.draw()');
    assert.notEqual(await lightAt(light), before, 'a light follows the finger');
    await screenshot('phone');
}

let status = 0;
try {
    for (const step of [draw, first, choose, room, probes, splats, lanterns, rest, small, share, drag, resize, adapt, lose, drop, phone]) {
        console.time(step.name);
        await step();
        console.timeEnd(step.name);
    }
    assert.deepEqual(browser.complaints.filter((line) => !/CONTEXT_LOST/.test(line)), []);
} catch (error) {
    console.log(error.stack, ...browser.complaints);
    status = 1;
}
await browser.close();
process.exit(status);
