// SPDX-License-Identifier: MIT
// Lampion as WebAssembly: load() makes an instance with memory of its own, whose functions are those of the C
// headers without the prefix lmp_. README.md tells how arguments are passed.
import { constants, structs } from './api.js';
import { Caller, LampionError, Structs } from './call.js';
import { optionsOf } from './options.js';

export { LampionError };

const PAGE = 65536, MEMORY_MIN = 4 << 20, MEMORY_MAX = 2 ** 31 - PAGE;

// A function with one instruction of SIMD.
const SIMD = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);

const compiled = new Map(); // modules, which instances share

function addressOf(source) {
    try {
        return new URL(source, globalThis.location?.href);
    } catch {
        throw new TypeError(`load: source is ${JSON.stringify(source)}, neither an address nor a module nor its bytes`);
    }
}

// Compiles the module of this package, or one that was fetched in another way.
async function compile(source, simd) {
    if (source instanceof WebAssembly.Module)
        return source;
    if (ArrayBuffer.isView(source) || source instanceof ArrayBuffer)
        return WebAssembly.compile(source);
    const url = source !== undefined ? addressOf(source)
        : simd ? new URL('lampion.wasm', import.meta.url) : new URL('lampion-scalar.wasm', import.meta.url);
    if (url.protocol === 'file:') {
        const node = 'node:fs/promises'; // in a variable, for bundlers for browsers not to look for it
        const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ node);
        return WebAssembly.compile(await readFile(url));
    }
    const response = await fetch(url);
    if (!response.ok)
        throw new Error(`${url}: ${response.status} ${response.statusText}`);
    return WebAssembly.compile(await response.arrayBuffer());
}

export async function compileLampion(options = {}) {
    const { source, simd = WebAssembly.validate(SIMD) } = optionsOf('compileLampion', options, ['source', 'simd']);
    if (typeof simd !== 'boolean')
        throw new TypeError(`load: simd is ${JSON.stringify(simd)}, neither true nor false`);
    if (source !== undefined)
        return compile(source);
    if (!compiled.has(simd))
        compiled.set(simd, compile(undefined, simd));
    try {
        return await compiled.get(simd);
    } catch (error) {
        compiled.delete(simd); // for another attempt
        throw error;
    }
}

export async function load(options = {}) {
    const { memory: bytes = 64 << 20, source, simd } = optionsOf('load', options, ['memory', 'source', 'simd']);
    if (!(bytes >= MEMORY_MIN && bytes <= MEMORY_MAX))
        throw new RangeError(`load: memory is ${bytes} bytes, not ${MEMORY_MIN} to ${MEMORY_MAX}`);
    const module = await compileLampion({ source, simd });
    const pages = Math.ceil(bytes / PAGE);
    const memory = new WebAssembly.Memory({ initial: pages, maximum: pages });
    const projected = []; // functions that are being projected, the innermost last
    const imports = {
        env: { memory, emscripten_notify_memory_growth() {}, emscripten_resize_heap: () => 0 },
        wasi_snapshot_preview1: new Proxy({}, { get: () => () => 8 }), // there are no files
        lampion: {
            call(x, y, z, at) {
                const { f, name, planes } = projected.at(-1), value = f([x, y, z]);
                const values = planes === 1 ? [value] : [value?.r ?? value?.[0], value?.g ?? value?.[1], value?.b ?? value?.[2]];
                if (!values.every((one) => typeof one === 'number'))
                    throw new TypeError(`${name}: the function returned ${value}, not ${planes === 1 ? 'a number' : 'a color'}`);
                new Float32Array(memory.buffer, at, planes).set(values);
            },
        },
    };
    const { exports: c } = await WebAssembly.instantiate(module, imports);
    c._initialize?.();
    const caller = new Caller(c, memory), { blocks } = caller;

    const checkCount = (count, owner = '') => {
        if (!(Number.isInteger(count) && count >= 0))
            throw new RangeError(`${owner}${count} is not a number of elements`);
    };
    const numbers = (Kind) => (count) => {
        checkCount(count);
        const at = c.malloc(count * Kind.BYTES_PER_ELEMENT || 1);
        if (!at)
            throw new LampionError(constants.ERROR_MEMORY, `${count} numbers do not fit into the memory of ${bytes} bytes that load() was given`);
        blocks.add(at, count * Kind.BYTES_PER_ELEMENT);
        return new Kind(memory.buffer, at, count).fill(0);
    };
    const project = (bands, nodes, f, sh, name, planes) => {
        if (typeof f !== 'function')
            throw new TypeError(`${name}: function is not a function`);
        if (!(Number.isInteger(bands) && bands >= 1 && bands <= constants.BANDS_MAX && Number.isInteger(nodes) && nodes >= 0 && nodes < 2 ** 31))
            throw new RangeError(`${name}: bands is not 1 to ${constants.BANDS_MAX}, or nodes not a count`);
        if (!(sh instanceof Float32Array && sh.length >= planes * bands * bands))
            throw new RangeError(`${name}: sh is not a Float32Array of ${planes * bands * bands} values`);
        if (sh.buffer === memory.buffer)
            blocks.check(sh, `${name}: sh`);
        caller.stack.within(() => {
            const at = caller.stack.take(4 * planes * bands * bands);
            projected.push({ f, name, planes });
            try {
                c[planes === 1 ? 'lampion_project' : 'lampion_project_rgb'](bands, nodes, at);
            } finally {
                projected.pop();
            }
            sh.set(new Float32Array(memory.buffer, at, planes * bands * bands));
        });
    };
    const encode = (name) => (brdf) => caller.stack.within(() => {
        const at = caller.stack.take(8), pointer = caller.pointer({ to: 'brdf' }, brdf, `${name}: brdf`);
        const status = c[`lmp_${name}`](0, pointer, at, at + 4);
        if (status)
            throw new LampionError(status, `${name}: ${caller.string(c.lmp_result_text(status))}`);
        const [data, size] = new Uint32Array(memory.buffer, at, 2);
        const encoded = new Uint8Array(memory.buffer, data, size).slice();
        c.free(data);
        return encoded;
    });
    return Object.freeze({
        ...constants, ...caller.api, memory,
        sh_project_function: (bands, nodes, f, sh) => project(bands, nodes, f, sh, 'sh_project_function', 1),
        sh_project_function_rgb: (bands, nodes, f, sh) => project(bands, nodes, f, sh, 'sh_project_function_rgb', 3),
        brdf_encode_merl: encode('brdf_encode_merl'), brdf_encode_rgl: encode('brdf_encode_rgl'),
        // The texels of LightProbeVolume: `count` probes of 3 bands, interleaved, as halves, both in this memory.
        pack_volume(sh, count, halves) {
            checkCount(count, 'pack_volume: ');
            if (!(sh.buffer === memory.buffer && sh.length >= 27 * count && halves.buffer === memory.buffer && halves.length >= 28 * count))
                throw new RangeError('pack_volume: an array is too short, or not of this instance\'s memory');
            blocks.check(sh, 'pack_volume: sh');
            blocks.check(halves, 'pack_volume: halves');
            c.lampion_pack_volume(sh.byteOffset, count, halves.byteOffset);
        },
        floats: numbers(Float32Array), doubles: numbers(Float64Array), halves: numbers(Uint16Array), uints: numbers(Uint32Array), bytes: numbers(Uint8Array),
        SH_COUNT: (bands) => bands * bands,
        SH_INDEX: (l, m) => l * l + l + m,
        SH_ROTATION_COUNT: (bands) => bands * (4 * bands * bands - 1) / 3,
        structs(type, count) {
            if (!structs[type])
                throw new TypeError(`there is no struct lmp_${type}`);
            checkCount(count);
            return new Structs(caller, type, count);
        },
        free(array) {
            if ((array instanceof Structs ? array.caller : array?.buffer) !== (array instanceof Structs ? caller : memory.buffer))
                throw new TypeError('free: this array is not of this instance\'s memory');
            if (array instanceof Structs)
                return array.free();
            if (!blocks.remove(array.byteOffset, array.byteLength))
                throw new TypeError('free: this array was freed, or is a part of one');
            c.free(array.byteOffset);
        },
    });
}
