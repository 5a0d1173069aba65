// SPDX-License-Identifier: MIT
// Draws a scene by WebGL 2 as the program does: a G-buffer, its radiance, and the tones that are shown.
import { bindTexture, makeMesh, makeTable } from './mesh.js';
import { later, makeProgram, once, stages } from './shaders.js';
import { makeSplats } from './splats.js';
import { makeTargets } from './targets.js';

const AREA_TEXELS = 11, AREAS_MOST = 64; // of shared.h and demo.c
const UNITS = { base_color_map: 0, metallic_roughness_map: 1, normal_map: 2, emission_map: 3, occlusion_map: 4, specular_map: 5 };

export const methods = {
    zonal: { bands: 32, define: '' },
    coefficients: { bands: 10, define: '#define SHADE_COEFFICIENTS' },
    preintegrated: { bands: 100, define: '#define SHADE_PREINTEGRATED' },
    probes: { bands: 3, define: '#define SHADE_PROBES' },
    draft: { bands: 1, define: '#define SHADE_DRAFT' },
};
// What the first frame of a scene is drawn by (draft.glsl).
export const draft = { method: 'draft', bands: 1, window: 'none' };
export const windows = ['none', 'hanning', 'lanczos']; // in the order of lmp_window

// Makes the programs that shade, each when it is first used. Returns a function that begins one and returns what waits
// for it.
function makeShades(gl, lightsMost) {
    const programs = new Map();
    return ({ method, bands, window }, shadesAreas) => {
        const areas = shadesAreas && !['probes', 'draft'].includes(method); // probes are lit by areas, too
        const straight = method !== 'preintegrated' ? bands : areas ? Math.min(bands, 10) : 1;
        const key = `${method} ${straight} ${window} ${areas}`;
        if (!programs.has(key))
            programs.set(key, makeProgram(gl, stages.shade, `#define LMP_BANDS ${straight}
#define LMP_WINDOW ${windows.indexOf(window)}
#define SHADE ${method === 'probes' ? 'shade_probes' : `lmp_shade_${method}`}
${methods[method].define}
${areas ? '#define SHADE_AREAS' : ''}`, lightsMost));
        return programs.get(key);
    };
}

// Makes preintegrated lobes as textures, each when it is first used.
function makeLobes(gl, library) {
    const lobes = new Map(), format = once(() => (gl.getExtension('OES_texture_float_linear') ? gl.RG32F : gl.RG16F));
    return ({ method, bands, window }) => {
        const key = `${bands} ${window}`;
        if (method !== 'preintegrated')
            return { shape: [0, 0, 0, 0], textures: {} };
        if (!lobes.has(key)) {
            const { shape, width, height, pairs, cells, remap } = library.lobe(bands, windows.indexOf(window));
            lobes.set(key, {
                shape,
                textures: {
                    lobe_pairs: makeTable(gl, format(), width, height, pairs, gl.RG, gl.LINEAR),
                    lobe_cells: makeTable(gl, gl.RGBA32F, cells.length / 4, 1, cells),
                    lobe_remap: makeTable(gl, gl.R32F, remap.length, 1, remap, gl.RED),
                },
            });
        }
        return lobes.get(key);
    };
}

// Begins to make a program that draws surfaces.
function makeSurface(gl, defines, lightsMost) {
    const made = makeProgram(gl, stages.surface, defines, lightsMost);
    return once(() => {
        const { program, uniforms } = made();
        gl.useProgram(program);
        for (const [name, unit] of Object.entries(UNITS))
            gl.uniform1i(uniforms[name] ?? null, unit);
        return program;
    });
}

// Makes the volume of probes as uniforms of volume.glsl, anew for each size.
function makeVolume(gl) {
    let texture = null, made = '';
    return {
        upload({ size: [x, y, z], texels }) {
            if (made !== `${[x, y, z]}`) {
                gl.deleteTexture(texture);
                texture = gl.createTexture();
                gl.bindTexture(gl.TEXTURE_3D, texture);
                gl.texStorage3D(gl.TEXTURE_3D, 1, gl.RGBA16F, x, y, 7 * z);
                for (const name of ['MIN_FILTER', 'MAG_FILTER'])
                    gl.texParameteri(gl.TEXTURE_3D, gl[`TEXTURE_${name}`], gl.LINEAR);
                for (const name of ['S', 'T', 'R'])
                    gl.texParameteri(gl.TEXTURE_3D, gl[`TEXTURE_WRAP_${name}`], gl.CLAMP_TO_EDGE);
                made = `${[x, y, z]}`;
            }
            gl.bindTexture(gl.TEXTURE_3D, texture);
            gl.texSubImage3D(gl.TEXTURE_3D, 0, 0, 0, 0, x, y, 7 * z, gl.RGBA, gl.FLOAT, texels);
        },
        bind(unit, uniforms, { minimum, extent, size }) {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_3D, texture);
            gl.uniform1i(uniforms.lampionVolume, unit);
            gl.uniform3fv(uniforms.lampionVolumeMin, minimum);
            gl.uniform3fv(uniforms.lampionVolumeExtent, extent);
            gl.uniform3fv(uniforms.lampionVolumeSize, size);
        },
    };
}

function makeBlock(gl, point, size) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.UNIFORM_BUFFER, buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, size, gl.DYNAMIC_DRAW);
    return (data) => {
        gl.bindBufferBase(gl.UNIFORM_BUFFER, point, buffer);
        gl.bufferSubData(gl.UNIFORM_BUFFER, 0, data);
    };
}

export function openContext(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, depth: false, powerPreference: 'high-performance' });
    if (!gl || !gl.getExtension('EXT_color_buffer_float'))
        throw new Error('this browser has no WebGL 2 with floating-point targets');
    return gl;
}

export function makeRenderer(gl, library) {
    const { canvas } = gl;
    const lightsMost = Math.min(1024, Math.floor(gl.getParameter(gl.MAX_UNIFORM_BLOCK_SIZE) / 48));
    // Programs come first, so that they are compiled while the page builds its scene, and nothing here waits for the GPU.
    const shades = makeShades(gl, lightsMost), lobes = makeLobes(gl, library), targets = makeTargets(gl);
    const ggx = makeTable(gl, gl.RGBA32F, 32, 161, library.ggxTexels()), empty = gl.createVertexArray();
    const setFrame = makeBlock(gl, 0, 4 * 48), setLights = makeBlock(gl, 1, 48 * lightsMost);
    const light = makeProgram(gl, stages.light, '', lightsMost);
    const tone = makeProgram(gl, stages.tone, '#define TONE tone_filmic', lightsMost);
    const surfaces = {
        plain: makeSurface(gl, '#define SURFACE_PLAIN', lightsMost), opaque: later(() => makeSurface(gl, '', lightsMost)),
        masked: later(() => makeSurface(gl, '#define SURFACE_MASKED', lightsMost)),
    };
    const areaLight = later(() => makeProgram(gl, stages.area, '', lightsMost));
    const areas = makeTable(gl, gl.RGBA32F, AREA_TEXELS, AREAS_MOST);
    const volume = makeVolume(gl), drawSplats = makeSplats(gl, lightsMost);
    let mesh = null, probes = null;

    function uploadAreas(texels, count) {
        bindTexture(gl, 0, areas);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, AREA_TEXELS, count, gl.RGBA, gl.FLOAT, texels);
    }

    // Draws the surfaces; returns how many spheres and areas the shaders know.
    function drawSurfaces(camera, lights) {
        const lightCount = Math.min(lights.spheres.length / 12, lightsMost);
        const areaCount = lightCount + lights.areaCount <= lightsMost ? lights.areaCount : 0;
        targets.resize(canvas.width, canvas.height);
        setFrame(camera.frame(canvas.width, canvas.height, lightCount, areaCount));
        setLights(lights.all.subarray(0, 12 * (lightCount + areaCount)));
        if (areaCount)
            uploadAreas(lights.areas, areaCount);
        for (let unit = 0; unit < 16; unit++)
            bindTexture(gl, unit, null);
        targets.bindSurfaces();
        targets.clear();
        gl.enable(gl.DEPTH_TEST);
        mesh.draw(surfaces, Object.values(UNITS));
        gl.disable(gl.CULL_FACE);
        gl.disable(gl.DEPTH_TEST);
        return { lightCount, areaCount };
    }

    // Draws the lights themselves in front of the surfaces.
    function drawLamps({ lightCount, areaCount }) {
        targets.bindSurfaces();
        gl.bindVertexArray(empty);
        gl.enable(gl.DEPTH_TEST);
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.FRONT);
        gl.useProgram(light().program);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 14, lightCount);
        if (areaCount) {
            gl.useProgram(areaLight().program);
            bindTexture(gl, 0, areas);
            gl.uniform1i(areaLight().uniforms.areas_texels ?? null, 0);
            gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 14, areaCount);
        }
        gl.disable(gl.CULL_FACE);
        gl.disable(gl.DEPTH_TEST);
    }

    // Shades a part of the G-buffer, x from … to of its width, into that many pixels of the radiance.
    function shade(settings, { areaCount }, { width, height, from = 0, to = 1 }) {
        const { program, uniforms } = shades(settings, areaCount > 0)(), lobe = lobes(settings);
        const textures = { ggx_texels: ggx, areas_texels: areas, material_constants: mesh.materialConstants, ...lobe.textures, ...targets.inputs() };
        targets.bindRadiance();
        gl.useProgram(program);
        Object.entries(textures).forEach(([name, texture], unit) => {
            bindTexture(gl, unit, texture);
            gl.uniform1i(uniforms[name] ?? null, unit);
        });
        if (settings.method === 'probes')
            volume.bind(15, uniforms, probes);
        gl.uniform4fv(uniforms.lobe_shape ?? null, lobe.shape);
        gl.uniform2f(uniforms.pixels, targets.width / width, targets.height / height);
        gl.viewport(0, 0, width, height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(Math.round(from * width), 0, Math.round(to * width) - Math.round(from * width), height);
        gl.bindVertexArray(empty);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.disable(gl.SCISSOR_TEST);
    }

    // Returns the exposure that the program would choose for the surfaces drawn, of fewer pixels. They are a corner of the
    // radiance, because a target of another format would have the shader compiled once more.
    function measureExposure(settings, drawn) {
        const width = Math.min(160, targets.width), height = Math.min(90, targets.height), rgba = new Float32Array(4 * width * height);
        shade(settings, drawn, { width, height });
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, rgba);
        return library.exposure(width, height, rgba.filter((x, i) => i % 4 < 3));
    }

    function show(exposure) {
        const { program, uniforms } = tone();
        gl.bindVertexArray(empty);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, targets.width, targets.height);
        gl.useProgram(program);
        bindTexture(gl, 0, targets.radiance());
        gl.uniform1i(uniforms.hdr, 0);
        gl.uniform1f(uniforms.exposure, exposure);
        gl.uniform1i(uniforms.flip, 1);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    gl.frontFace(gl.CW);
    gl.depthFunc(gl.GREATER);
    return {
        gl, lightsMost,
        // Begins to compile what shades so.
        prepare(settings) {
            shades(settings, false);
        },
        setScene(scene) {
            mesh?.delete();
            mesh = makeMesh(gl, scene);
        },
        // lights.splats: those that are drawn over the surfaces. `other` is shown from `split` on, a fraction of the width.
        // Returns the exposure, which is measured where 0 is given.
        draw(camera, lights, settings, other, split, given) {
            const { width, height } = canvas, drawn = drawSurfaces(camera, lights);
            if (settings.method === 'probes')
                volume.upload(probes = library.probes());
            const exposure = given || measureExposure(settings, drawn);
            drawLamps(drawn);
            shade(settings, drawn, { width, height, to: split });
            if (split < 1)
                shade(other, drawn, { width, height, from: split });
            if (lights.splats)
                drawSplats(lights.splats, camera.ray(0, 0, 1).forward, targets.inputs().depths);
            show(exposure);
            return exposure;
        },
    };
}
