// SPDX-License-Identifier: MIT
// The G-buffer by WebGL 2: the attachments that shared.h lists, and depth.
import { makeTable } from './mesh.js';

// the samplers of shade.frag, in the order of the textures
const INPUTS = ['base_metallic', 'normals', 'roughness_kind', 'emissions', 'weights', 'depths'];

export function makeTargets(gl) {
    const norm16 = gl.getExtension('EXT_texture_norm16'), two = norm16 ? norm16.RG16_EXT : gl.RG32F;
    const formats = [norm16 ? norm16.RGBA16_EXT : gl.RGBA16F, two, two, gl.R11F_G11F_B10F, gl.RG8];
    let textures = [], framebuffer = null;
    const targets = {
        width: 0, height: 0,
        resize(width, height) {
            if (width === targets.width && height === targets.height)
                return;
            textures.forEach((texture) => gl.deleteTexture(texture));
            gl.deleteFramebuffer(framebuffer);
            textures = [...formats, gl.DEPTH_COMPONENT32F].map((format) => makeTable(gl, format, width, height));
            framebuffer = gl.createFramebuffer();
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
            const attachments = formats.map((format, i) => gl.COLOR_ATTACHMENT0 + i);
            [...attachments, gl.DEPTH_ATTACHMENT].forEach((point, i) =>
                gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, textures[i], 0));
            gl.drawBuffers(attachments);
            Object.assign(targets, { width, height });
        },
        bind() {
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
            gl.viewport(0, 0, targets.width, targets.height);
        },
        clear() {
            formats.forEach((format, i) => gl.clearBufferfv(gl.COLOR, i, [0, 0, 0, 0]));
            gl.clearBufferfv(gl.DEPTH, 0, [0]);
        },
        inputs: () => Object.fromEntries(INPUTS.map((name, i) => [name, textures[i]])),
    };
    return targets;
}
