// SPDX-License-Identifier: MIT
// wgsl.mjs MODULE STEPS WORK: the WGSL in Chromium, every function of which computes what the library does. STEPS is
// the program of variants.c.
import { strict as assert } from 'node:assert';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { openBrowser } from '../../web/browser.mjs';

const [module, steps, work] = process.argv.slice(2);
const { lampionWgsl } = await import(module);
const long = process.env.LAMPION_LONG === '1', sizes = { LIGHTS: 5, SURFACES: 64, TEXELS: 5152, AREAS: 4 };
const windows = ['none', 'hanning', 'lanczos'];
const own = (name) => readFileSync(fileURLToPath(new URL(name, import.meta.url)), 'utf8');

// A page may use the GPU where it comes from a file; everything else is evaluated in it.
writeFileSync(`${work}/page.html`, '<!doctype html><title>WGSL</title>');
const browser = await openBrowser(`${work}/profile`), { evaluate } = browser;
await browser.open(`file://${work}/page.html`);
await browser.until('document.title === "WGSL"');
await evaluate(`(async () => {
    const adapter = await navigator.gpu.requestAdapter();
    const device = await adapter.requestDevice();
    globalThis.compile = async (code) => {
        const module = device.createShaderModule({ code }), { messages } = await module.getCompilationInfo();
        if (messages.length)
            throw new Error(messages.slice(0, 5).map(({ lineNum, message }) => message + ': ' + code.split('\\n')[lineNum - 1]).join('\\n'));
        return module;
    };
    globalThis.run = async (code, inputs, size) => {
        const module = await compile(code), encoder = device.createCommandEncoder();
        const make = (size, usage) => device.createBuffer({ size, usage: usage | GPUBufferUsage.COPY_DST });
        const [given, tables] = inputs.map((base64) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)), buffer = make(bytes.length, GPUBufferUsage.STORAGE);
            device.queue.writeBuffer(buffer, 0, bytes);
            return buffer;
        });
        const values = make(size, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC), read = make(size, GPUBufferUsage.MAP_READ);
        const type = (type) => ({ visibility: GPUShaderStage.COMPUTE, buffer: { type } });
        const layout = device.createBindGroupLayout({ entries: ['read-only-storage', 'storage', 'read-only-storage'].map(
            (kind, binding) => ({ binding, ...type(kind) })) });
        const entries = [given, values, tables].map((buffer, binding) => ({ binding, resource: { buffer } }));
        const group = device.createBindGroup({ layout, entries }), pass = encoder.beginComputePass();
        for (const [, entryPoint] of code.matchAll(/@compute.* fn (\\w+)/g)) {
            pass.setPipeline(await device.createComputePipelineAsync({ layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
                compute: { module, entryPoint } }));
            pass.setBindGroup(0, group);
            pass.dispatchWorkgroups(1);
        }
        pass.end();
        encoder.copyBufferToBuffer(values, 0, read, 0, size);
        device.queue.submit([encoder.finish()]);
        await read.mapAsync(GPUMapMode.READ);
        return Array.from(new Uint32Array(read.getMappedRange()));
    };
})()`);

const constants = Object.entries(sizes).map(([name, value]) => `const ${name} = ${value};\n`).join('');

function wholeText({ bands, window, ggx, loops, areas }) {
    const text = lampionWgsl({ bands, window, ggx, loops, spheres: false, areas, coefficients: true, coat: true, probe: true,
        preintegrated: 'brdf' });
    return text + constants + own('shade.wgsl') + own(`shade_${ggx ? 'ggx' : 'phong'}.wgsl`) + (areas ? own('shade_areas.wgsl') : '');
}

// Computes by code, and returns what the steps say of the values.
async function compare(code, check, words, perSurface) {
    mkdirSync(`${work}/inputs`, { recursive: true });
    execFileSync(steps, ['inputs', `${work}/inputs`, ...words], { stdio: 'ignore' });
    const inputs = ['given', 'tables'].map((name) => readFileSync(`${work}/inputs/${name}`).toString('base64'));
    const values = await evaluate(`run(${JSON.stringify(code)}, ${JSON.stringify(inputs)}, ${4 * sizes.SURFACES * perSurface})`);
    writeFileSync(`${work}/values`, Buffer.from(Uint32Array.from(values).buffer));
    return execFileSync(steps, [check, `${work}/values`, ...check === 'check' ? words : []],
        { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }).trim();
}

async function compute({ bands, window, ggx, loops, areas }) {
    const words = [ggx ? 'ggx' : 'phong', bands, windows.indexOf(window), areas].map(String);
    const said = await compare(wholeText({ bands, window, ggx, loops, areas }), 'check', words, 42 + 4 * bands + 2 * bands * bands);
    console.log(`${said}${loops ? ', loops' : ''}`);
}

// The file for Bevy, whose preprocessor takes its line that begins with #.
async function computeProbes() {
    const file = own('../../../examples/engines/lampion_probe.wgsl').replace(/^#.*$/m, '');
    const probe = 2 * sizes.LIGHTS + 3 * sizes.SURFACES + sizes.TEXELS + 11 * sizes.AREAS;
    const code = `${constants}const PROBE = ${probe};\n${file}${own('../engines/bevy.wgsl')}`;
    console.log(await compare(code, 'check_probes', ['phong', '3', '0', '0'], 6));
}

// The usual form has each file, window and kind of lobes and loops once.
const some = [
    { bands: 1, window: 'none', ggx: false, loops: true, areas: 0 },
    { bands: 3, window: 'hanning', ggx: false, loops: false, areas: sizes.AREAS },
    { bands: 5, window: 'lanczos', ggx: true, loops: false, areas: 0 },
    { bands: 8, window: 'hanning', ggx: true, loops: true, areas: 0 },
];
const all = [1, 3, 5, 8, 10, 20, 32].flatMap((bands) => (bands > 10 ? ['hanning'] : windows).flatMap((window) => [false, true].map((ggx) => (
    { bands, window, ggx, loops: bands > 10 || window === 'lanczos', areas: window === 'none' && !ggx ? sizes.AREAS : 0 }))));

// The files themselves, joined as docs/webgpu.md says.
async function compileFiles() {
    const named = 'const LMP_BANDS = 8;\nconst LMP_WINDOW = LMP_WINDOW_HANNING;\nconst LMP_WINDOW_SIZE = 8;\n';
    const files = ['no_areas', 'spheres', 'lampion'].map((name) => readFileSync(`${dirname(module)}/phong/${name}.wgsl`, 'utf8'));
    const mine = `fn lmp_light_count() -> i32 { return 1; }
        fn lmp_light_sphere(i: i32) -> vec4f { return vec4f(0.0, 0.0, 2.0, 1.0); }
        fn lmp_light_radiance(i: i32) -> vec3f { return vec3f(1.0); }`;
    await evaluate(`compile(${JSON.stringify(named + files.join('') + mine)}).then(() => 0)`);
}

function refuse() {
    for (const options of [{ bands: 0 }, { bands: 33 }, { bands: 2.5 }, {}, { bands: 3, window: 'hann' }])
        assert.throws(() => lampionWgsl(options), RangeError);
}

let status = 0;
try {
    refuse();
    await compileFiles();
    for (const configuration of long ? all : some)
        await compute(configuration);
    await computeProbes();
    for (let bands = 1; bands <= 32; bands++)
        for (const loops of [false, true])
            if (loops || long || [1, 2, 4, 10].includes(bands))
                await evaluate(`compile(${JSON.stringify(wholeText({ bands, window: 'none', ggx: bands % 2 === 0, loops, areas: true }))}).then(() => 0)`);
    assert.deepEqual(browser.complaints, []);
} catch (error) {
    console.log(error.stdout ?? '', error.message);
    status = 1;
}
await browser.close();
process.exit(status);
