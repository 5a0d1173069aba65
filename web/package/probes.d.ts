// SPDX-License-Identifier: MIT
import type { Lampion } from './index.js';

export const SLABS: 7;

export interface ProbeGridOptions {
    /** Corners of the box; the corner probes stand there. */
    min: ArrayLike<number>;
    max: ArrayLike<number>;
    /** Probes along x, y, z: two at least, the third at most 292. */
    size: [number, number, number];
}

/** A grid of probes that is relit every frame, for any renderer. */
export class ProbeGrid {
    constructor(lmp: Lampion, options: ProbeGridOptions);
    readonly count: number;
    /** Positions, x fastest, then y, z. */
    readonly points: Float32Array;
    /** The coefficients of each probe: 9 of red, then green, then blue. */
    readonly sh: Float32Array;
    /** Texels of four halves, size[0] by size[1] in SLABS * size[2] layers. */
    readonly halves: Uint16Array;
    light(spheres: { center: Float32Array, radius: Float32Array, radiance: Float32Array }, count: number): Uint16Array;
    free(): void;
}
