// SPDX-License-Identifier: MIT
// What is drawn to by WebGL 2, of one size: the G-buffer, which is the attachments that shared.h lists and depth, and the
// radiance of its pixels.
import { makeTable } from './mesh.js';
import { once } from './shaders.js';

// the samplers of shade.frag, in the order of the textures
const INPUTS = ['base_metallic', 'normals', 'roughness_kind', 'emissions', 'weights', 'depths'];

export function makeTargets(gl) {
    // asked for when it is needed, because the answer waits for the GPU
    const formats = once(() => {
        const norm16 = gl.getExtension('EXT_texture_norm16'), two = norm16 ? norm16.RG16_EXT : gl.RG32F;
        return [norm16 ? norm16.RGBA16_EXT : gl.RGBA16F, two, two, gl.R11F_G11F_B10F, gl.RG8];
    });
    let textures = [], hdr = null, framebuffers = [];

    function makeFramebuffer(points, attached) {
        const framebuffer = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
        points.forEach((point, i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, attached[i], 0));
        return framebuffer;
    }

    const targets = {
        width: 0, height: 0,
        resize(width, height) {
            if (width === targets.width && height === targets.height)
                return;
            [...textures, hdr].forEach((texture) => gl.deleteTexture(texture));
            framebuffers.forEach((framebuffer) => gl.deleteFramebuffer(framebuffer));
            const attachments = formats().map((format, i) => gl.COLOR_ATTACHMENT0 + i);
            textures = [...formats(), gl.DEPTH_COMPONENT32F].map((format) => makeTable(gl, format, width, height));
            hdr = makeTable(gl, gl.RGBA16F, width, height);
            const surfaces = makeFramebuffer([...attachments, gl.DEPTH_ATTACHMENT], textures);
            gl.drawBuffers(attachments);
            framebuffers = [surfaces, makeFramebuffer([gl.COLOR_ATTACHMENT0], [hdr])];
            Object.assign(targets, { width, height });
        },
        bindSurfaces() {
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffers[0]);
            gl.viewport(0, 0, targets.width, targets.height);
        },
        bindRadiance: () => gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffers[1]),
        clear() {
            formats().forEach((format, i) => gl.clearBufferfv(gl.COLOR, i, [0, 0, 0, 0]));
            gl.clearBufferfv(gl.DEPTH, 0, [0]);
        },
        inputs: () => Object.fromEntries(INPUTS.map((name, i) => [name, textures[i]])),
        radiance: () => hdr,
    };
    return targets;
}
