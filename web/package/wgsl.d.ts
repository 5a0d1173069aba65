// SPDX-License-Identifier: MIT

export interface WgslOptions {
    /** 1 to 32. */
    bands: number;
    window?: 'none' | 'hanning' | 'lanczos';
    /** The band whose weight falls to 0; `bands`. */
    windowSize?: number;
    /** glTF's material as well: you define lmp_ggx_texel. */
    ggx?: boolean;
    /** false: lights are of any kind, and you define lmp_light_fixed, _color and _lit. */
    spheres?: boolean;
    /** You define lmp_area_count and lmp_area_texel. */
    areas?: boolean;
    coefficients?: boolean;
    coat?: boolean;
    probe?: boolean;
    preintegrated?: '' | 'lobe' | 'brdf';
    /** Keep the loops over bands, which are short to compile and slower to run. */
    loops?: boolean;
}

/** Returns the functions of Lampion for a WGSL shader module, to be joined with yours. */
export function lampionWgsl(options: WgslOptions): string;
