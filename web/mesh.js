// SPDX-License-Identifier: MIT
// Draws a scene's triangles, materials and textures by WebGL 2, as app/render/gl/mesh.c does by
// OpenGL.
const ATTRIBUTES = [[3, 'FLOAT', 0], [3, 'FLOAT', 12], [4, 'FLOAT', 24], [4, 'FLOAT', 40], [4, 'UNSIGNED_SHORT', 56]];

// Makes a texture of one level, of numbers that shaders look up.
export function makeTable(gl, format, width, height, data = null, layout = gl.RGBA, filter = gl.NEAREST) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    if (data)
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, layout, gl.FLOAT, data);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, name, filter);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
        gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return texture;
}

export function bindTexture(gl, unit, texture) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
}

function makeMap(gl, { width, height, srgb, wrapU, wrapV, texels }) {
    const wraps = [gl.REPEAT, gl.CLAMP_TO_EDGE, gl.MIRRORED_REPEAT], texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1 + Math.floor(Math.log2(Math.max(width, height))), srgb ? gl.SRGB8_ALPHA8 : gl.RGBA8, width, height);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, texels);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wraps[wrapU]);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wraps[wrapV]);
    return texture;
}

function makeBuffer(gl, target, data) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return buffer;
}

function makeVertexArray(gl, { vertices, indices }) {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = [makeBuffer(gl, gl.ARRAY_BUFFER, vertices), makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, indices)];
    for (const [i, [size, type, offset]] of ATTRIBUTES.entries()) {
        gl.enableVertexAttribArray(i);
        gl.vertexAttribPointer(i, size, gl[type], true, 64, offset);
    }
    gl.bindVertexArray(null);
    return { array, buffers };
}

// Makes the materials' blocks, each at an offset where a block may begin.
function makeBlocks(gl, { materials, materialSize, materialCount }) {
    const align = gl.getParameter(gl.UNIFORM_BUFFER_OFFSET_ALIGNMENT), stride = Math.ceil(materialSize / align) * align;
    const blocks = new Uint8Array(stride * materialCount);
    for (let i = 0; i < materialCount; i++)
        blocks.set(materials.subarray(materialSize * i, materialSize * (i + 1)), stride * i);
    const buffer = makeBuffer(gl, gl.UNIFORM_BUFFER, blocks);
    return { buffer, bind: (i) => gl.bindBufferRange(gl.UNIFORM_BUFFER, 2, buffer, i * stride, materialSize) };
}

export function makeMesh(gl, scene) {
    const { array, buffers } = makeVertexArray(gl, scene), blocks = makeBlocks(gl, scene);
    const maps = scene.textures.map((texture) => makeMap(gl, texture));
    // only F0 and F90
    const dielectrics = scene.materialConstants.filter((x, i) => i % 8 < 4);
    const materialConstants = makeTable(gl, gl.RGBA32F, scene.materialCount, 1, dielectrics);
    const draws = [...scene.draws.filter(({ masked }) => !masked), ...scene.draws.filter(({ masked }) => masked)];
    return {
        materialConstants,
        // plain, opaque, masked: functions that return the program
        draw({ plain, opaque, masked }, units) {
            gl.bindVertexArray(array);
            gl.cullFace(gl.BACK);
            for (const draw of draws) {
                gl.useProgram(draw.plain ? plain() : draw.masked ? masked() : opaque());
                blocks.bind(draw.material);
                units.forEach((unit, i) => bindTexture(gl, unit, draw.maps[i] < 0 ? null : maps[draw.maps[i]]));
                (draw.doubleSided ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
                gl.drawElements(gl.TRIANGLES, draw.count, gl.UNSIGNED_INT, 4 * draw.first);
            }
        },
        delete() {
            [...maps, materialConstants].forEach((texture) => gl.deleteTexture(texture));
            [...buffers, blocks.buffer].forEach((buffer) => gl.deleteBuffer(buffer));
            gl.deleteVertexArray(array);
        },
    };
}
