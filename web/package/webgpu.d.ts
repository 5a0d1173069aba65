// SPDX-License-Identifier: MIT
import type { Object3D } from 'three';
import type { Lampion } from './index.js';
import { LightProbeVolume as Volume } from './three.js';

/** Lights the MeshStandardNodeMaterials of a scene by its SphereLights, in WebGPURenderer. */
export class SphereLights {
    /** bands: of highlights, 1 to 32; 10. most: the most lights; 256. */
    constructor(lmp: Lampion, scene: Object3D, options?: { bands?: number, most?: number });
    /** Reads the lights of the scene, and lights node materials that are new in it: before every frame. */
    update(): void;
    dispose(): void;
}

/** The volume of lampion/three, for node materials. */
export class LightProbeVolume extends Volume {}
