// SPDX-License-Identifier: MIT
import type { Material, Object3D } from 'three';
import type { Lampion } from './index.js';
import { LightProbeVolume as Volume } from './three.js';

/** Lights the standard and physical materials of a scene, of nodes or not, by its SphereLights, in WebGPURenderer on WebGPU itself. */
export class SphereLights {
    /** bands: of highlights, 1 to 32; 10. most: the most lights; 256. */
    constructor(lmp: Lampion, scene: Object3D, options?: { bands?: number, most?: number });
    /** Reads the lights of the scene, and lights materials that are new in it: before every frame. */
    update(): void;
    dispose(): void;
}

/** The volume of lampion/three, for WebGPURenderer, also where it falls back to WebGL 2. */
export class LightProbeVolume extends Volume {
    /** material: standard or physical, of nodes or not; others throw. */
    add<T extends Material>(material: T): T;
}
