// SPDX-License-Identifier: MIT
import type { Brdf, Constants, Functions, Rgb, StructTypes } from './api.js';

export * from './api.js';

export interface LoadOptions {
    /** Bytes of memory, 4 MB to 2 GB; 64 MB. It does not grow, so that arrays of it stay valid. */
    memory?: number;
    /** The module, its bytes or its address; by default that of this package. */
    source?: WebAssembly.Module | BufferSource | string | URL;
    /** Whether to load the module with SIMD; by default where it runs. */
    simd?: boolean;
}

/** What a function of C returns other than LMP_OK, as `code`. */
export class LampionError extends Error {
    readonly code: number;
}

/** Structs side by side in Lampion's memory, for what changes every frame: passed without copies. */
export interface Structs<T> {
    readonly length: number;
    get(i: number): T;
    /** Sets the members given; the others stay as they are. */
    set(i: number, value: T): void;
    /** A member of all elements, a float or a vector: numbers as { at, stride }, vectors as { x, y, z, stride }, stride in bytes. */
    array(member: keyof T & string): { at: Float32Array, stride: number } & { x: Float32Array, y: Float32Array, z: Float32Array, stride: number };
    free(): void;
}

export interface Lampion extends Constants, Functions {
    readonly memory: WebAssembly.Memory;
    /** Projects a function, called at `nodes` heights (0: as many as bands) times 2 * nodes azimuths. */
    sh_project_function(bands: number, nodes: number, f: (direction: [number, number, number]) => number, sh: Float32Array): void;
    sh_project_function_rgb(bands: number, nodes: number, f: (direction: [number, number, number]) => Rgb | ArrayLike<number>, sh: Float32Array): void;
    brdf_encode_merl(brdf: Brdf): Uint8Array;
    brdf_encode_rgl(brdf: Brdf): Uint8Array;
    /** The texels of a volume of probes of 3 bands, as halves: a slab of `count` for each vector of lmp_probe_constants. */
    pack_volume(sh: Float32Array, count: number, halves: Uint16Array): void;
    /** Arrays of zeros in Lampion's memory, which functions read and write in place; give them back by free(). */
    floats(count: number): Float32Array;
    doubles(count: number): Float64Array;
    halves(count: number): Uint16Array;
    uints(count: number): Uint32Array;
    bytes(count: number): Uint8Array;
    /** Coefficients of so many bands; the index of one; and the values of sh_make_rotation. */
    SH_COUNT(bands: number): number;
    SH_INDEX(l: number, m: number): number;
    SH_ROTATION_COUNT(bands: number): number;
    /** `count` structs of zeros, such as structs('light', 100). */
    structs<K extends keyof StructTypes>(type: K, count: number): Structs<StructTypes[K]>;
    free(array: ArrayBufferView | Structs<any>): void;
}

/** Compiles the module, to be passed to load() of several threads as `source`. */
export function compileLampion(options?: Pick<LoadOptions, 'source' | 'simd'>): Promise<WebAssembly.Module>;

/** Makes an instance with memory of its own. */
export function load(options?: LoadOptions): Promise<Lampion>;
