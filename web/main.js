// SPDX-License-Identifier: MIT
// The page: applies what is chosen in the panel or given after # in the address (docs/web.md), and
// passes the scene on.
import { dragged, makeCamera, pick } from './camera.js';
import { loadLibrary } from './library.js';
import { draft, makeRenderer, methods, openContext, windows } from './renderer.js';

const element = (id) => document.getElementById(id);
const canvas = element('view'), asked = new URLSearchParams(location.hash.slice(1));
// What suits a scene: the fewest lights, which belong to it, their number at first and, where it matters, the method.
const usual = (scene) => ({
    room: { fewest: 4, lights: 4 }, 'atrium:lanterns=1000': { fewest: 1000, lights: 1000, method: 'probes' },
}[scene] ?? { fewest: 30, lights: 40 });
const scene = asked.get('scene') ?? 'atrium';
const state = {
    scene, lights: Number(asked.get('lights') ?? usual(scene).lights), bands: Number(asked.get('bands') ?? 8),
    method: asked.get('method') ?? usual(scene).method ?? 'zonal', window: asked.get('window') ?? 'hanning', split: asked.has('split'),
    moving: !asked.has('time'), scale: asked.get('scale') ?? 'auto', divider: Number(asked.get('split') || 0.5),
};
let seconds = Number(asked.get('time') ?? 0), exposure = Number(asked.get('exposure') ?? 0);
let library, renderer = null, camera, lights;

// Returns the bands that the method takes of those that are chosen; probes have three.
const bandsTaken = () => (state.method === 'probes' ? 3 : Math.min(state.bands, methods[state.method].bands));

function tell(message, wrong = false) {
    element('message').textContent = message;
    element('message').className = wrong ? 'wrong' : '';
}

// --- the scene ---

function frameScene() {
    const { minimum, maximum } = library.scene();
    camera = makeCamera(library.camera(innerWidth / innerHeight), minimum, maximum);
    const view = asked.get('view')?.split(',').map(Number);
    if (view?.length === 6 && view.every(Number.isFinite) && state.scene === scene)
        camera.place(view);
}

function showScene() {
    renderer.setScene(library.scene());
    frameScene();
}

function openBuiltin() {
    library.openBuiltin(state.scene === 'splats' ? 'ball' : state.scene);
    scatterLights();
    showScene();
}

// Returns the scene of the first frame: the atrium with a third of its triangles, and without the lights that move. The
// others are there at once.
const roughly = (scene) => (scene.startsWith('atrium') ? `${scene}${scene.includes(':') ? ',' : ':'}detail=25` : null);

// The atrium's own lanterns are the first 30, and do not move, nor do the room's four lights.
function scatterLights() {
    library.scatterLights(Math.min(state.lights, renderer.lightsMost), 1);
    exposure = Number(asked.get('exposure') ?? 0);
}

// Opens a file; one that is not a scene leaves the present scene in place.
async function openFile(file) {
    tell(`Reading ${file.name} …`);
    const data = new Uint8Array(await file.arrayBuffer());
    try {
        library.openFile(data);
    } catch (error) {
        tell(`${file.name}: ${error.message.replace(/^file: /, '')}`, true);
        return;
    }
    const unsupported = library.unsupported();
    tell(unsupported && `${file.name}: left out: ${unsupported}${/file|image/.test(unsupported) ? '. Use a .glb, which holds its images.' : ''}`);
    state.scene = file.name;
    offer('dropped', file.name);
    scatterLights();
    showScene();
    showState();
}

// --- frames ---

// Automatic resolution: the first frame is small, the next ones as large as holds BUSY milliseconds; a page at rest is drawn
// once more, as large as holds REST.
const BUSY = 80, REST = 1000, SMALLEST = 0.1;
let autoScale = 0.25, refined = false;
const holding = (spent, milliseconds) => Math.min(Math.max(autoScale * Math.sqrt(milliseconds / spent), SMALLEST), 1);

function fit(scale) {
    const ratio = scale * Math.min(devicePixelRatio, 2);
    canvas.width = Math.max(1, Math.round(innerWidth * ratio));
    canvas.height = Math.max(1, Math.round(innerHeight * ratio));
}

// Milliseconds from one frame to the next; with software rendering that is the time of a frame.
let mean = 0, told = 0, latest = BUSY;
function measure(spent, now) {
    latest = spent;
    mean = mean ? 0.8 * mean + 0.2 * spent : spent;
    if (now - told > 300) {
        element('frame').value = `${mean.toFixed(mean < 100 ? 1 : 0)} ms · ${canvas.width}×${canvas.height}`;
        told = now;
    }
    const scale = holding(spent, BUSY);
    if (scale < 0.8 * autoScale || scale > 1.25 * autoScale || scale === 1) // small changes would flicker
        autoScale = scale;
}

const chosen = () => ({ method: state.method, bands: bandsTaken(), window: state.window });

function draw(scale = autoScale) {
    fit(state.scale === 'auto' ? scale : Number(state.scale));
    lights = library.lights(seconds);
    if (state.scene === 'splats')
        lights.splats = library.splats(bandsTaken(), windows.indexOf(state.window));
    const other = { method: 'preintegrated', bands: 100, window: state.window };
    exposure = renderer.draw(camera, lights, chosen(), other, state.split ? state.divider : 1, exposure);
}

// Shows the first frame, which takes a second or two without a GPU, before the whole scene is made. The frame after it is
// shaded as chosen, and not waited for: its shaders are compiled, in another process, while the scene is made.
async function drawRoughly(scene) {
    library.openBuiltin(scene);
    showScene();
    fit(autoScale);
    lights = library.lights(seconds);
    const measured = renderer.draw(camera, lights, draft, draft, 1, exposure);
    tell('');
    await frameSeen();
    renderer.draw(camera, lights, chosen(), chosen(), 1, measured);
}

// Nothing is drawn again until something changes, which takes some frames to be measured, because the first may compile
// shaders: a still page costs nothing.
const FRAMES = 5;
let due = FRAMES, last = 0;
function frame(now) {
    const drawing = renderer && (state.moving || due > 0);
    if (drawing) {
        if (last) {
            measure(now - last, now);
            seconds += state.moving && !held ? Math.min(now - last, 100) / 1000 : 0;
        }
        due--;
        draw(autoScale);
        refined = false;
    } else if (renderer && !refined) {
        draw(holding(latest, REST));
        refined = true;
    }
    last = drawing ? now : 0;
    requestAnimationFrame(frame);
}

// --- hands ---

const pointers = new Map();
let held = null; // the light that is dragged
const rayAt = ({ clientX, clientY }) =>
    camera.ray(2 * clientX / innerWidth - 1, 2 * clientY / innerHeight - 1, innerWidth / innerHeight);

canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
    const ray = rayAt(event), light = pointers.size === 1 ? pick(lights.spheres, ray, event.pointerType === 'touch' ? 2 : 1.3) : -1;
    held = light < 0 ? null : { light, ray };
});
canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before)
        return;
    pointers.set(event.pointerId, event);
    due = FRAMES;
    if (held) {
        const ray = rayAt(event), { light } = held;
        library.dragLight(light, dragged(lights.spheres.subarray(12 * light, 12 * light + 3), held.ray, ray));
        lights = library.lights(seconds);
        held.ray = ray;
    } else if (pointers.size === 1) {
        camera.look((before.clientX - event.clientX) / innerHeight, (event.clientY - before.clientY) / innerHeight);
    } else {
        const other = [...pointers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
        const apart = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
        camera.move((apart(event) - apart(before)) / innerHeight);
    }
});
for (const name of ['pointerup', 'pointercancel'])
    canvas.addEventListener(name, (event) => {
        pointers.delete(event.pointerId);
        held = null;
    });
canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    due = FRAMES;
    camera.move(-event.deltaY / 2000);
}, { passive: false });
addEventListener('resize', () => { due = FRAMES; });
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
    event.preventDefault();
    const { files } = event.dataTransfer;
    if (files.length > 1)
        tell(`${files.length} files were dropped, and one is read: use a .glb, which holds everything.`, true);
    else if (files.length)
        openFile(files[0]);
});

// --- the panel ---

// Shows a list's last option, for what none of the others is.
function offer(id, value) {
    Object.assign(element(id), { hidden: false, textContent: value, value });
}

function showState() {
    due = FRAMES;
    if (!['auto', '1', '0.5'].includes(state.scale))
        offer('scaled', state.scale);
    element('share').disabled = state.scene === element('dropped').value; // no link has the file
    element('shared').value = '';
    element('lights').min = usual(state.scene).fewest;
    for (const id of ['scene', 'lights', 'method', 'window', 'scale'])
        element(id).value = state[id];
    for (const id of ['split', 'moving'])
        element(id).checked = state[id];
    Object.assign(element('bands'), { max: methods[state.method].bands, value: bandsTaken(), disabled: state.method === 'probes' });
    for (const id of ['lights', 'bands'])
        element(id).nextElementSibling.value = element(id).value;
    const divider = element('divider');
    divider.hidden = !state.split;
    divider.style.left = `${100 * state.divider}%`;
    element('left').textContent = `${bandsTaken()} bands`;
    element('right').textContent = '100 bands';
}

let costTimer = 0;
function tellCost() {
    clearTimeout(costTimer);
    costTimer = setTimeout(() => {
        const [vector, scalar] = [true, false].map((vectors) => library.cost(bandsTaken(), vectors));
        element('cost').textContent = `The C library in WebAssembly, ${bandsTaken()} bands: ${vector.toFixed(1)} ns ` +
            `for a point and light with SIMD, ${scalar.toFixed(1)} without.`;
    }, 400);
}

function change(id, value) {
    state[id] = value;
    if (id === 'scene') {
        state.lights = usual(value).lights;
        state.method = usual(value).method ?? state.method;
        openBuiltin();
    }
    if (id === 'lights')
        scatterLights();
    showState();
    if (['bands', 'method', 'lights'].includes(id))
        tellCost();
}

// Returns the address of what is shown, but for lights that were dragged.
function linkToState() {
    const { scene, lights, bands, method, window, scale } = state, all = { scene, lights, bands, method, window, scale };
    if (state.split)
        all.split = state.divider.toFixed(3);
    if (!state.moving)
        all.time = seconds.toFixed(3);
    if (asked.has('exposure'))
        all.exposure = asked.get('exposure');
    all.view = camera.view().map((x) => x.toFixed(4)).join();
    return `${location.href.split('#')[0]}#${new URLSearchParams(all)}`;
}

// Copies the link; a browser that refuses, as most do on pages that are not secure, has it as the page's address.
async function share() {
    const link = linkToState();
    try {
        await navigator.clipboard.writeText(link);
        element('shared').value = 'Copied.';
    } catch {
        history.replaceState(null, '', link);
        element('shared').value = 'It is the address now.';
    }
}

function watchPanel() {
    element('share').addEventListener('click', share);
    for (const id of ['lights', 'bands'])
        element(id).addEventListener('input', (event) => change(id, Number(event.target.value)));
    for (const id of ['scene', 'method', 'window', 'scale'])
        element(id).addEventListener('change', (event) => change(id, event.target.value));
    for (const id of ['split', 'moving'])
        element(id).addEventListener('change', (event) => change(id, event.target.checked));
    element('file').addEventListener('change', (event) => event.target.files.length && openFile(event.target.files[0]));
    const divider = element('divider');
    divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener('pointermove', (event) => {
        if (divider.hasPointerCapture(event.pointerId))
            change('divider', Math.max(0.02, Math.min(0.98, event.clientX / innerWidth)));
    });
}

// --- the beginning ---

function startRenderer() {
    renderer = makeRenderer(openContext(canvas), library);
    element('lights').max = Math.min(1000, renderer.lightsMost);
}

canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    renderer = null;
    tell('The GPU was lost …');
});
canvas.addEventListener('webglcontextrestored', () => {
    startRenderer();
    renderer.setScene(library.scene());
    due = FRAMES;
    tell('');
});

// Waits until what has been drawn is seen.
const frameSeen = () => new Promise((seen) => { requestAnimationFrame(() => requestAnimationFrame(seen)); });

async function begin() {
    const loading = loadLibrary(), rough = roughly(state.scene);
    openContext(canvas); // waits for the GPU's process, while other threads compile the library
    library = await loading;
    startRenderer();
    renderer.prepare(rough ? draft : chosen());
    if (rough)
        await drawRoughly(rough);
    openBuiltin();
    tell('');
    element('panel').open = !asked.has('closed') && innerWidth > 600;
    watchPanel();
    showState();
    tellCost();
    requestAnimationFrame(frame);
}
// Not before the page is loaded: until then browsers turn a sign of loading, and without a GPU that takes a core.
addEventListener('load', () => setTimeout(() => begin().catch((error) => tell(error.message, true))));

// for the console, and for tests
globalThis.lampion = {
    draw, state, probes: () => library.probes(), splats: () => lights.splats, spheres: () => lights.spheres, rested: () => refined, lightAt: (i) => [...lights.spheres.subarray(12 * i, 12 * i + 4)],
    see: (point) => camera.project(point, innerWidth, innerHeight),
    project: (i) => camera.project([...lights.spheres.subarray(12 * i, 12 * i + 3)], innerWidth, innerHeight),
    pick: ([clientX, clientY]) => pick(lights.spheres, rayAt({ clientX, clientY }), 1),
    get exposure() { return exposure; },
    get frameTime() { return mean; },
    get ready() { return mean > 0 && (state.moving || due <= 0); },
    get gl() { return renderer?.gl; },
};
