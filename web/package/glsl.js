// SPDX-License-Identifier: MIT
// glsl.js - what the shaders of every engine are made of and read: the functions of lights.glsl and volume.glsl, expanded,
// and lights as texels.
import { lights, volume } from './expanded.js';

const ROW = 512; // lights in a row of the texture, 2 texels each
const ROWS = 2048; // which every WebGL 2 has
const TABLE_WIDTH = 32;

// Texels of spheres for a texture of floats: center and radius, then radiance.
export class SphereTexels {
    width = 2 * ROW;
    height = 0;
    // Returns whether there is now another array, of another height, for which a texture must be made.
    write({ count, center, radius, radiance }) {
        const height = Math.max(Math.ceil(count / ROW), 1), grown = height !== this.height;
        if (height > ROWS)
            throw new RangeError(`SphereLights: there are ${count} lights, more than ${ROW * ROWS}`);
        if (grown)
            Object.assign(this, { height, data: new Float32Array(8 * ROW * height) });
        const { data } = this;
        for (let i = 0; i < count; i++) {
            data.set(center.subarray(3 * i, 3 * i + 3), 8 * i);
            data[8 * i + 3] = radius[i];
            data.set(radiance.subarray(3 * i, 3 * i + 3), 8 * i + 4);
        }
        return grown;
    }
}

// Returns the lobes of glTF's materials, texels of a texture TABLE_WIDTH wide.
export function tableTexels(lmp) {
    const data = new Float32Array(4 * lmp.GGX_TEXELS);
    lmp.lobe_copy_ggx_texels(data);
    return { data, width: TABLE_WIDTH, height: lmp.GGX_TEXELS / TABLE_WIDTH };
}

export function checkBands(bands) {
    if (!(Number.isInteger(bands) && bands >= 1 && bands <= 32))
        throw new RangeError(`SphereLights: bands is ${JSON.stringify(bands)}, not 1 to 32`);
}

// Returns the functions of lights.glsl.
export const lightsGlsl = (bands) => `
#define LAMPION_LAST_BAND ${bands - 1}
${lights}`;

export { volume as volumeGlsl };
