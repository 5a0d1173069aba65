// SPDX-License-Identifier: MIT
// The program's own shaders in GLSL ES 3.00, which has no #include and no locations for varyings
// between stages.
import area from '../shaders/lampion/area.glsl';
import areaFragment from '../shaders/program/area.frag';
import areaHit from '../shaders/program/area_hit.glsl';
import areaVertex from '../shaders/program/area.vert';
import areas from '../shaders/program/areas.glsl';
import camera from '../shaders/program/camera.glsl';
import coat from '../shaders/lampion/coat.glsl';
import coefficients from '../shaders/lampion/coefficients.glsl';
import gbuffer from '../shaders/program/gbuffer.glsl';
import ggx from '../shaders/lampion/ggx.glsl';
import lampion from '../shaders/lampion/lampion.glsl';
import light from '../shaders/program/light.glsl';
import lightFragment from '../shaders/program/light.frag';
import lightVertex from '../shaders/program/light.vert';
import lobe from '../shaders/lampion/preintegrated_lobe.glsl';
import probe from '../shaders/lampion/probe.glsl';
import lookup from '../shaders/lampion/preintegrated_lookup.h';
import screen from '../shaders/program/screen.vert';
import shared from '../shaders/program/shared.h';
import splatFragment from './splat.frag';
import splatVertex from './splat.vert';
import surfaceFragment from '../shaders/program/surface.frag';
import surfaceVertex from '../shaders/program/surface.vert';
import texels from '../shaders/program/texels.glsl';
import tone from '../shaders/program/tone.h';
import toneFragment from '../shaders/program/tone.frag';
import volume from './package/volume.glsl';
import draft from './draft.glsl';
import shade from './shade.frag';

const files = {
    'area.glsl': area, 'area_hit.glsl': areaHit, 'areas.glsl': areas, 'texels.glsl': texels, 'light.frag': lightFragment,
    'light.vert': lightVertex, 'camera.glsl': camera, 'coat.glsl': coat, 'coefficients.glsl': coefficients, 'draft.glsl': draft, 'gbuffer.glsl': gbuffer, 'ggx.glsl': ggx,
    'lampion.glsl': lampion, 'light.glsl': light, 'preintegrated_lobe.glsl': lobe,
    'preintegrated_lookup.h': lookup, 'probe.glsl': probe, 'shared.h': shared, 'tone.h': tone, 'volume.glsl': volume,
};
export const stages = {
    surface: [surfaceVertex, surfaceFragment], light: [lightVertex, lightFragment],
    area: [areaVertex, areaFragment], shade: [screen, shade], tone: [screen, toneFragment],
    splat: [splatVertex, splatFragment],
};

function expand(text) {
    return text.replace(/^#include "(.*)"$/gm, (line, name) => expand(files[name]));
}

function translate(text, fragment) {
    return expand(text)
        .replace(/layout\(std140, binding = point\)/g, 'layout(std140)')
        .replace(/layout\((binding|location) = \w+( \+ \d)?\) (?=uniform)/g, '')
        .replace(fragment ? /layout\(location = \d+\) (flat )?in /g : /layout\(location = \d+\) (flat )?out /g,
            (match, flat) => `${flat ?? ''}${fragment ? 'in' : 'out'} `)
        .replace(/\bgl_PrimitiveID\b/g, '0');
}

function compile(gl, type, text) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return shader;
}

// Returns a function that makes something when it is first called.
export function once(make) {
    let made;
    return () => (made ??= make());
}

// Returns a function that begins to make a program when it is first called, and waits for it.
export function later(begin) {
    const begun = once(begin);
    return () => begun()();
}

// Waits until a program is linked; returns it with its uniforms. Blocks are bound where shared.h says.
function finish(gl, program, shaders) {
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
        throw new Error(`a shader does not compile: ${shaders.map((s) => gl.getShaderInfoLog(s)).join('')}${
            gl.getProgramInfoLog(program)}`);
    for (const [point, name] of ['frame_block', 'lights_block', 'material_block'].entries()) {
        const index = gl.getUniformBlockIndex(program, name);
        if (index !== gl.INVALID_INDEX)
            gl.uniformBlockBinding(program, index, point);
    }
    const uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
        const { name } = gl.getActiveUniform(program, i);
        uniforms[name] = gl.getUniformLocation(program, name);
    }
    return { program, uniforms };
}

// Begins to compile a program of a pair of stages, with `defines` before each, and returns a function that waits for it:
// browsers compile in another process, while the page builds its scene.
export function makeProgram(gl, [vertex, fragment], defines, lightsMost) {
    const head = `#version 300 es
precision highp float; precision highp int; precision highp sampler2D;
#define LAMPION_SHADER
#define SHARED_WITHOUT_STORAGE
${defines}\n`;
    const limit = (text) => text.replace(/#define SHARED_LIGHTS_MAX +\d+/, `#define SHARED_LIGHTS_MAX ${lightsMost}`);
    const program = gl.createProgram();
    const shaders = [compile(gl, gl.VERTEX_SHADER, head + limit(translate(vertex, false))),
        compile(gl, gl.FRAGMENT_SHADER, head + limit(translate(fragment, true)))];
    for (const shader of shaders)
        gl.attachShader(program, shader);
    gl.linkProgram(program);
    return once(() => finish(gl, program, shaders));
}
