// SPDX-License-Identifier: MIT
// probes.js - a grid of probes that is relit every frame, for any renderer: the texels of a 3D texture.
//
// A probe holds its irradiance as lmp_probe_constants, SLABS vectors of four, which probe.glsl evaluates. The texture has
// size[0] by size[1] texels in SLABS * size[2] layers: those of the first vector, then those of the second, and so on.
import { optionsOf } from './options.js';

export const SLABS = 7;

export class ProbeGrid {
    // min, max: corners of the box, whose corners have probes; size: probes along x, y, z, two at least each.
    constructor(lmp, options) {
        const { min, max, size } = optionsOf('ProbeGrid', options, ['min', 'max', 'size']);
        if (!(size?.length === 3 && size.every((n) => Number.isInteger(n) && n >= 2) && SLABS * size[2] <= 2048))
            throw new RangeError(`ProbeGrid: size is ${JSON.stringify(size)}, not three counts from 2 on, the third at most 292`);
        const extent = max.map((high, axis) => high - min[axis]), count = size[0] * size[1] * size[2];
        if (!extent.every((length) => length > 0 && Number.isFinite(length)))
            throw new RangeError('ProbeGrid: the box is empty or infinite');
        Object.assign(this, { lmp, extent, count });
        try {
            this.points = lmp.floats(3 * count);
            this.sh = lmp.floats(27 * count);
            this.halves = lmp.halves(4 * SLABS * count);
        } catch (error) {
            this.free(); // what did fit
            throw error;
        }
        for (let i = 0; i < count; i++) {
            const at = [i % size[0], Math.floor(i / size[0]) % size[1], Math.floor(i / (size[0] * size[1]))];
            for (let axis = 0; axis < 3; axis++)
                this.points[3 * i + axis] = min[axis] + extent[axis] * at[axis] / (size[axis] - 1);
        }
    }
    // Lights the probes by `count` spheres, arrays { center, radius, radiance }.
    light(spheres, count) {
        if (!this.points)
            throw new Error('ProbeGrid: light after free');
        this.lmp.sphere_sum_n(3, spheres, count, null, this.points, this.count, this.sh);
        this.lmp.pack_volume(this.sh, this.count, this.halves);
        return this.halves;
    }
    free() {
        for (const name of ['points', 'sh', 'halves'])
            if (this[name]) {
                this.lmp.free(this[name]);
                this[name] = undefined;
            }
    }
}
