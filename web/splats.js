// SPDX-License-Identifier: MIT
// Draws Gaussian splats over the radiance of a G-buffer, the farthest first.
import { bindTexture } from './mesh.js';
import { later, makeProgram, stages } from './shaders.js';

const SPLAT = 18, DRAWN = 12; // floats of splats.h, and those of them that are drawn
const CENTER = 0, AXES = 6, COLOR = 15;

export function makeSplats(gl, lightsMost) {
    const program = later(() => makeProgram(gl, stages.splat, '', lightsMost)), array = gl.createVertexArray(), buffer = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    for (let i = 0; i < DRAWN / 3; i++) {
        gl.enableVertexAttribArray(i);
        gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 4 * DRAWN, 12 * i);
        gl.vertexAttribDivisor(i, 1);
    }
    gl.bindVertexArray(null);

    // Returns what is drawn of splats, sorted along a direction.
    function sort(splats, [x, y, z]) {
        const count = splats.length / SPLAT, far = (i) => splats[SPLAT * i] * x + splats[SPLAT * i + 1] * y + splats[SPLAT * i + 2] * z;
        const depths = Float32Array.from({ length: count }, (none, i) => far(i)), sorted = new Float32Array(DRAWN * count);
        Uint32Array.from(depths.keys()).sort((a, b) => depths[b] - depths[a]).forEach((from, to) => {
            for (const [at, offset, length] of [[0, CENTER, 3], [3, AXES, 6], [9, COLOR, 3]])
                sorted.set(splats.subarray(SPLAT * from + offset, SPLAT * from + offset + length), DRAWN * to + at);
        });
        return sorted;
    }

    return (splats, forward, depths) => {
        const { program: drawing, uniforms } = program();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, sort(splats, forward), gl.DYNAMIC_DRAW);
        gl.useProgram(drawing);
        bindTexture(gl, 0, depths);
        gl.uniform1i(uniforms.depths, 0);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        gl.bindVertexArray(array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, splats.length / SPLAT);
        gl.bindVertexArray(null);
        gl.disable(gl.BLEND);
    };
}
