// SPDX-License-Identifier: MIT
// Lampion's C library and scenes as WebAssembly (demo.c).
import packed from 'demo.wasm';

const VERTEX = 16, LIGHT = 12, CONSTANTS = 8, AREA = 44; // in floats

// A page has no files: any call for files, a clock or more memory returns -1.
const nothing = new Proxy({}, { get: () => () => -1 });

// Returns the module, which the page's script holds compressed: a third of the bytes is read sooner.
function unpack() {
    const bytes = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Response(bytes, { headers: { 'Content-Type': 'application/wasm' } });
}

export async function loadLibrary() {
    const { instance } = await WebAssembly.instantiateStreaming(unpack(), { env: nothing, wasi_snapshot_preview1: nothing });
    const c = instance.exports;
    c._initialize();
    const memory = () => c.memory.buffer;
    const floats = (at, count) => new Float32Array(memory(), at, count);
    const words = (at, count) => new Uint32Array(memory(), at, count);
    const text = (at) => {
        const all = new Uint8Array(memory(), at);
        return new TextDecoder().decode(all.subarray(0, all.indexOf(0)));
    };
    // Runs a function with a copy of an array in C's memory.
    const lend = (array, run) => {
        const at = c.malloc(array.byteLength);
        new Uint8Array(memory(), at, array.byteLength).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
        const result = run(at);
        c.free(at);
        return result;
    };
    const check = (error) => {
        if (error)
            throw new Error(text(error));
    };
    return {
        openBuiltin: (name) => lend(new TextEncoder().encode(`${name}\0`), (at) => check(c.demo_open_builtin(at))),
        openFile: (data) => lend(data, (at) => check(c.demo_open_file(at, data.byteLength))),
        unsupported: () => text(c.demo_unsupported()),
        materialSize: () => c.demo_material_size(),
        // Returns views of C's memory, valid until the next call that allocates.
        scene() {
            const [vertices, vertexCount, indices, indexCount, materials, materialConstants, materialCount, minimum, maximum] =
                words(c.demo_arrays(), 9);
            const materialSize = c.demo_material_size();
            return {
                vertices: floats(vertices, VERTEX * vertexCount), indices: words(indices, indexCount), materialCount, materialSize,
                materials: new Uint8Array(memory(), materials, materialSize * materialCount),
                materialConstants: floats(materialConstants, CONSTANTS * materialCount),
                minimum: [...floats(minimum, 3)], maximum: [...floats(maximum, 3)],
                draws: Array.from({ length: c.demo_draw_count() }, (none, i) => {
                    const [first, count, material, masked, doubleSided, plain, ...maps] = words(c.demo_draw_at(i), 16);
                    return { first, count, material, masked, doubleSided, plain, maps: maps.map((map) => map | 0) };
                }),
                textures: Array.from({ length: c.demo_texture_count() }, (none, i) => {
                    const [width, height, srgb, wrapU, wrapV, at] = words(c.demo_texture(i), 6);
                    return { width, height, srgb, wrapU, wrapV, texels: new Uint8Array(memory(), at, 4 * width * height) };
                }),
            };
        },
        camera(aspect) {
            const all = floats(c.demo_camera(aspect), 10).slice();
            return { eye: [...all.subarray(0, 3)], target: [...all.subarray(3, 6)], up: [...all.subarray(6, 9)], fov: all[9] };
        },
        scatterLights: (count, seed) => check(c.demo_scatter_lights(count, seed)),
        // Returns copies of the lights as the shaders read them: center, radius, radiance, kind, cone, of spheres
        // and then of areas; those of spheres alone; and the texels of areas.
        lights(seconds) {
            const count = c.demo_move_lights(seconds), areaCount = c.demo_area_count();
            const all = floats(c.demo_lights(), LIGHT * (count + areaCount)).slice();
            return {
                all, spheres: all.subarray(0, LIGHT * count), areaCount, areas: floats(c.demo_areas(), AREA * areaCount).slice(),
            };
        },
        // Relights the grid of probes; returns its box, its size, and a view of its texels.
        probes() {
            const at = c.demo_light_probes(), size = [...words(at + 24, 3)], [texels] = words(at + 36, 1);
            return {
                minimum: floats(at, 3).slice(), extent: floats(at + 12, 3).slice(), size,
                texels: floats(texels, 28 * size[0] * size[1] * size[2]),
            };
        },
        // Relights the splats; returns a view of them, as splats.h lays them out.
        splats: (bands, window) => floats(c.demo_light_splats(bands, window), 18 * c.demo_splat_count()),
        dragLight: (i, [x, y, z]) => c.demo_drag_light(i, x, y, z),
        ggxTexels: () => floats(c.demo_ggx_texels(), 4 * 5152),
        exposure: (width, height, rgb) => lend(rgb, (at) => c.demo_exposure(width, height, at)),
        // Returns a preintegrated lobe: its numbers, and its texture of pairs.
        lobe(bands, window) {
            const at = c.demo_make_lobe(bands, window);
            if (!at)
                throw new Error(`a preintegrated lobe of ${bands} bands does not fit`);
            const cells = 4 + 4 * 128, remap = 321;
            const [height, pairs] = words(at + 4 * (cells + remap), 2);
            return {
                shape: floats(at, 4).slice(), cells: floats(at + 16, cells - 4), remap: floats(at + 4 * cells, remap),
                width: 2048, height, pairs: floats(pairs, 2 * 2048 * height),
            };
        },
        // Returns nanoseconds per point and light at so many bands, the least of several runs.
        cost(bands, vectors) {
            let least = Infinity;
            for (let i = 0; i < 5; i++) {
                const start = performance.now();
                let pairs = 0, spent;
                do {
                    pairs += c.demo_shade(bands, vectors);
                    spent = performance.now() - start;
                } while (spent < 3);
                least = Math.min(least, 1e6 * spent / pairs);
            }
            c.demo_shade(1, true);
            return least;
        },
    };
}
