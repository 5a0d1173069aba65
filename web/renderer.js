// SPDX-License-Identifier: MIT
// A scene by WebGL 2 as the program draws it: a G-buffer, then one pass that shades and shows.
import { makeProgram, stages } from './shaders.js';

const DOUBLE_SIDED = 1, MASKED = 2 | 32; // scene_flags
const UNITS = { base_color_map: 0, metallic_roughness_map: 1, normal_map: 2, emission_map: 3, occlusion_map: 10, specular_map: 11 };
const MAP_UNITS = Object.values(UNITS);
const MATERIAL = 72, REFLECTOR = 8; // floats

export const methods = {
    zonal: { bands: 32, define: '' },
    coefficients: { bands: 10, define: '#define SHADE_COEFFICIENTS' },
    preintegrated: { bands: 128, define: '#define SHADE_PREINTEGRATED' },
};
export const windows = ['none', 'hanning', 'lanczos']; // lmp_window

export function makeRenderer(canvas, library) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, depth: false, powerPreference: 'high-performance' });
    if (!gl || !gl.getExtension('EXT_color_buffer_float'))
        throw new Error('this browser has no WebGL 2 with floating-point targets');
    const norm16 = gl.getExtension('EXT_texture_norm16');
    const linear = gl.getExtension('OES_texture_float_linear');
    const lightsMost = Math.min(1024, Math.floor(gl.getParameter(gl.MAX_UNIFORM_BLOCK_SIZE) / 48));
    const two = norm16 ? norm16.RG16_EXT : gl.RG32F;
    // as shared.h lists them, and depth
    const formats = [norm16 ? norm16.RGBA16_EXT : gl.RGBA16F, two, two, gl.R11F_G11F_B10F, gl.RG8];
    const inputs = ['base_metallic', 'normals', 'roughness_kind', 'emissions', 'layers', 'depths'];

    const surface = ['', '#define SURFACE_MASKED'].map((defines) => makeProgram(gl, stages.surface, defines, lightsMost));
    const light = makeProgram(gl, stages.light, '', lightsMost);
    for (const { program, uniforms } of surface) {
        gl.useProgram(program);
        for (const [name, unit] of Object.entries(UNITS))
            gl.uniform1i(uniforms[name] ?? null, unit);
    }
    const frameBlock = gl.createBuffer(), lightsBlock = gl.createBuffer();
    gl.bindBuffer(gl.UNIFORM_BUFFER, frameBlock);
    gl.bufferData(gl.UNIFORM_BUFFER, 4 * 48, gl.DYNAMIC_DRAW);
    gl.bindBuffer(gl.UNIFORM_BUFFER, lightsBlock);
    gl.bufferData(gl.UNIFORM_BUFFER, 48 * lightsMost, gl.DYNAMIC_DRAW);
    const empty = gl.createVertexArray();

    function texture(format, width, height, data, layout, type = gl.FLOAT, filter = gl.NEAREST) {
        const made = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, made);
        gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
        if (data)
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, layout, type, data);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        return made;
    }
    const ggx = texture(gl.RGBA32F, 32, 161, library.ggxTexels(), gl.RGBA);

    // --- the scene ---

    let mesh = null;
    function makeMap({ width, height, srgb, wrapU, wrapV, texels }) {
        const wraps = [gl.REPEAT, gl.CLAMP_TO_EDGE, gl.MIRRORED_REPEAT];
        const made = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, made);
        gl.texStorage2D(gl.TEXTURE_2D, 1 + Math.floor(Math.log2(Math.max(width, height))), srgb ? gl.SRGB8_ALPHA8 : gl.RGBA8, width, height);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, texels);
        gl.generateMipmap(gl.TEXTURE_2D);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wraps[wrapU]);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wraps[wrapV]);
        return made;
    }

    function makeVertexArray(vertices, indices) {
        const array = gl.createVertexArray(), buffers = [gl.createBuffer(), gl.createBuffer()];
        gl.bindVertexArray(array);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffers[0]);
        gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[1]);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        const attributes = [[3, gl.FLOAT, 0], [3, gl.FLOAT, 12], [4, gl.FLOAT, 24], [4, gl.FLOAT, 40], [4, gl.UNSIGNED_SHORT, 56]];
        for (const [i, [size, type, offset]] of attributes.entries()) {
            gl.enableVertexAttribArray(i);
            gl.vertexAttribPointer(i, size, type, true, 64, offset);
        }
        gl.bindVertexArray(null);
        return { array, buffers };
    }

    function deleteMesh() {
        mesh.maps.forEach((map) => gl.deleteTexture(map));
        mesh.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
        gl.deleteTexture(mesh.reflectors);
        gl.deleteVertexArray(mesh.array);
    }

    function setScene(scene) {
        if (mesh)
            deleteMesh();
        const { array, buffers } = makeVertexArray(scene.vertices, scene.indices);
        const align = gl.getParameter(gl.UNIFORM_BUFFER_OFFSET_ALIGNMENT), stride = Math.ceil(4 * MATERIAL / align) * align;
        const blocks = new Float32Array(stride / 4 * scene.materialCount), reflectors = new Float32Array(4 * scene.materialCount);
        for (let i = 0; i < scene.materialCount; i++) {
            blocks.set(scene.materials.subarray(MATERIAL * i, MATERIAL * (i + 1)), stride / 4 * i);
            reflectors.set(scene.reflectors.subarray(REFLECTOR * i, REFLECTOR * i + 4), 4 * i);
        }
        const materials = gl.createBuffer();
        gl.bindBuffer(gl.UNIFORM_BUFFER, materials);
        gl.bufferData(gl.UNIFORM_BUFFER, blocks, gl.STATIC_DRAW);
        mesh = {
            array, buffers: [...buffers, materials], materials, stride, maps: scene.textures.map(makeMap),
            reflectors: texture(gl.RGBA32F, scene.materialCount, 1, reflectors, gl.RGBA),
            draws: scene.draws.sort((a, b) => (a.flags & MASKED ? 1 : 0) - (b.flags & MASKED ? 1 : 0)),
        };
    }

    // --- targets ---

    let target = null;
    function resize(width, height) {
        if (target?.width === width && target.height === height)
            return;
        if (target) {
            target.textures.forEach((made) => gl.deleteTexture(made));
            gl.deleteFramebuffer(target.framebuffer);
        }
        const textures = [...formats, gl.DEPTH_COMPONENT32F].map((format) => texture(format, width, height));
        const framebuffer = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        const attachments = formats.map((format, i) => gl.COLOR_ATTACHMENT0 + i);
        [...attachments, gl.DEPTH_ATTACHMENT].forEach((point, i) =>
            gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, textures[i], 0));
        gl.drawBuffers(attachments);
        target = { width, height, textures, framebuffer };
    }

    // --- drawing ---

    function drawGeometry(lightCount) {
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
        gl.viewport(0, 0, target.width, target.height);
        gl.frontFace(gl.CW);
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.GREATER);
        formats.forEach((format, i) => gl.clearBufferfv(gl.COLOR, i, [0, 0, 0, 0]));
        gl.clearBufferfv(gl.DEPTH, 0, [0]);
        gl.bindVertexArray(mesh.array);
        gl.cullFace(gl.BACK);
        for (const draw of mesh.draws) {
            gl.useProgram(surface[draw.flags & MASKED ? 1 : 0].program);
            gl.bindBufferRange(gl.UNIFORM_BUFFER, 2, mesh.materials, draw.material * mesh.stride, 4 * MATERIAL);
            draw.maps.forEach((map, i) => bindTexture(MAP_UNITS[i], map < 0 ? null : mesh.maps[map]));
            (draw.flags & DOUBLE_SIDED ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
            gl.drawElements(gl.TRIANGLES, draw.count, gl.UNSIGNED_INT, 4 * draw.first);
        }
        gl.bindVertexArray(empty);
        gl.useProgram(light.program);
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.FRONT);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 14, lightCount);
        gl.disable(gl.CULL_FACE);
        gl.disable(gl.DEPTH_TEST);
    }

    function bindTexture(unit, made) {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, made);
    }

    const programs = new Map(), lobes = new Map();
    function shadeProgram({ method, bands, window }, radiance) {
        const preintegrated = method === 'preintegrated';
        const key = `${method} ${preintegrated ? 1 : bands} ${window} ${radiance}`;
        if (!programs.has(key))
            programs.set(key, makeProgram(gl, stages.shade, `#define LMP_BANDS ${preintegrated ? 1 : bands}
#define LMP_WINDOW ${windows.indexOf(window)}
#define SHADE lmp_shade_${method}
${methods[method].define}
${radiance ? '#define RADIANCE' : ''}`, lightsMost));
        return programs.get(key);
    }

    function lobeOf(bands, window) {
        const key = `${bands} ${window}`;
        if (!lobes.has(key)) {
            const made = library.lobe(bands, windows.indexOf(window));
            lobes.set(key, {
                shape: made.shape,
                textures: {
                    lobe_pairs: texture(linear ? gl.RG32F : gl.RG16F, made.width, made.height, made.pairs, gl.RG, gl.FLOAT, gl.LINEAR),
                    lobe_cells: texture(gl.RGBA32F, 128, 1, made.cells, gl.RGBA),
                    lobe_remap: texture(gl.R32F, made.remap.length, 1, made.remap, gl.RED),
                },
            });
        }
        return lobes.get(key);
    }

    // shades a part of the current target, x from … to of its width
    function shade(settings, exposure, width, height, from, to, radiance = false) {
        const { program, uniforms } = shadeProgram(settings, radiance);
        const lobe = settings.method === 'preintegrated' ? lobeOf(settings.bands, settings.window) : null;
        gl.useProgram(program);
        const textures = { ggx_texels: ggx, reflectors: mesh.reflectors, ...lobe?.textures };
        inputs.forEach((name, i) => { textures[name] = target.textures[i]; });
        Object.entries(textures).forEach(([name, made], unit) => {
            bindTexture(unit, made);
            gl.uniform1i(uniforms[name] ?? null, unit);
        });
        gl.uniform4fv(uniforms.lobe_shape ?? null, lobe?.shape ?? [0, 0, 0, 0]);
        gl.uniform2f(uniforms.pixels, target.width / width, target.height / height);
        gl.uniform1f(uniforms.exposure ?? null, exposure);
        gl.viewport(0, 0, width, height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(Math.round(from * width), 0, Math.round(to * width) - Math.round(from * width), height);
        gl.bindVertexArray(empty);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.disable(gl.SCISSOR_TEST);
    }

    function begin(camera, lights) {
        const lightCount = Math.min(lights.length / 12, lightsMost);
        resize(canvas.width, canvas.height);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, frameBlock);
        gl.bufferSubData(gl.UNIFORM_BUFFER, 0, camera.frame(canvas.width, canvas.height, lightCount), 0, 48);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, 1, lightsBlock);
        gl.bufferSubData(gl.UNIFORM_BUFFER, 0, lights, 0, 12 * lightCount);
        gl.bindBufferRange(gl.UNIFORM_BUFFER, 2, mesh.materials, 0, 4 * MATERIAL);
        for (let unit = 0; unit < 16; unit++)
            bindTexture(unit, null);
        drawGeometry(lightCount);
    }

    return {
        gl, lightsMost, setScene,
        // `other` is shown from `split`, a part of the width, on
        draw(camera, lights, settings, other, split, exposure) {
            begin(camera, lights);
            gl.bindFramebuffer(gl.FRAMEBUFFER, null);
            shade(settings, exposure, canvas.width, canvas.height, 0, split);
            if (split < 1)
                shade(other, exposure, canvas.width, canvas.height, split, 1);
        },
        // what the program would expose this image by
        exposure(camera, lights, settings) {
            const width = 160, height = 90, rgba = new Float32Array(4 * width * height);
            const radiance = texture(gl.RGBA32F, width, height), framebuffer = gl.createFramebuffer();
            begin(camera, lights);
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
            gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, radiance, 0);
            shade(settings, 1, width, height, 0, 1, true);
            gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, rgba);
            gl.deleteFramebuffer(framebuffer);
            gl.deleteTexture(radiance);
            return library.exposure(width, height, rgba.filter((x, i) => i % 4 < 3));
        },
    };
}
