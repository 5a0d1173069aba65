// SPDX-License-Identifier: MIT
import type { Box3, Color, ColorRepresentation, LightProbe, MeshStandardMaterial, Object3D, Quaternion } from 'three';
import type { Lampion } from './index.js';

/** A glowing sphere. Its intensity is that of a PointLight, in candela, whatever its radius. Its scale does not matter. */
export class SphereLight extends Object3D {
    constructor(color?: ColorRepresentation, intensity?: number, radius?: number);
    readonly isSphereLight: true;
    color: Color;
    intensity: number;
    /** Above 0; 0.01 stands for a point. */
    radius: number;
    /** Of its surface, candela per square meter. */
    radiance: number;
    /** Lumens. */
    power: number;
}

/** Lights the MeshStandardMaterials and MeshPhysicalMaterials of a scene by its SphereLights. */
export class SphereLights {
    /** bands: of highlights, 1 to 32; 10. Materials whose userData.lampion is false are left alone. */
    constructor(lmp: Lampion, scene: Object3D, options?: { bands?: number });
    /** Reads the lights of the scene, and lights materials that are new in it: before every frame. */
    update(): void;
    dispose(): void;
}

/** A grid of probes in a box, relit by update(): diffuse light of many lights, at one cost per pixel. */
export class LightProbeVolume {
    constructor(lmp: Lampion, box: Box3, size: [number, number, number], options?: { worker?: Worker });
    /** material: a MeshStandardMaterial or a MeshPhysicalMaterial; others throw. */
    add<T extends MeshStandardMaterial>(material: T): T;
    /** Adds those of a scene's materials that can be lit. */
    addScene(scene: Object3D): void;
    /** Lights the probes by the SphereLights of a scene; with a worker of lampion/worker, as soon as it is done. */
    update(scene: Object3D): void;
    dispose(): void;
}

/** Lights a LightProbe by the SphereLights of a scene, as they are seen from its position. */
export function lightProbe(lmp: Lampion, scene: Object3D, light?: LightProbe): LightProbe;

export interface Splats {
    positions: Float32Array;
    /** Unit; of splats that lie on surfaces. Without them, a splat scatters the light from everywhere alike. */
    normals?: Float32Array;
    albedo: Float32Array;
}

/** Lights for 3D Gaussian splats, and their coefficients when a scene turns. */
export class SplatLights {
    constructor(lmp: Lampion);
    /** Writes f_dc of splats lit by the SphereLights of a scene; 3DGS shows 0.5 + 0.2821 f_dc. */
    light(scene: Object3D, splats: Splats, f_dc: Float32Array): void;
    /** Turns f_rest of splats of `bands` bands, red, then green, then blue, with a scene. */
    rotate(quaternion: Quaternion, bands: number, f_rest: Float32Array): void;
    dispose(): void;
}
