// SPDX-License-Identifier: MIT
import type { Material } from '@babylonjs/core/Materials/material.js';
import type { Color3 } from '@babylonjs/core/Maths/math.color.js';
import type { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import type { Scene } from '@babylonjs/core/scene.js';
import type { Lampion } from './index.js';

/** A glowing sphere. Its intensity is that of a point light, in candela, whatever its radius. */
export class SphereLight extends TransformNode {
    constructor(name: string, scene: Scene, options?: { color?: Color3, intensity?: number, radius?: number });
    /** Linear. */
    color: Color3;
    intensity: number;
    /** Above 0; 0.01 stands for a point. */
    radius: number;
    /** Of its surface, candela per square meter. */
    radiance: number;
}

/** Lights the PBR materials of a scene, those of metallic and roughness, by its SphereLights. Those whose metadata.lampion is false are left alone. */
export class SphereLights {
    /** bands: of highlights, 1 to 32; 10. */
    constructor(lmp: Lampion, scene: Scene, options?: { bands?: number });
    /** Reads the lights of the scene, and lights materials that are new in it: before every frame. */
    update(): void;
    dispose(): void;
}

/** A grid of probes in a box, relit by update(): diffuse light of many lights, at one cost per pixel. */
export class LightProbeVolume {
    constructor(lmp: Lampion, scene: Scene, options: { min: Vector3, max: Vector3, size: [number, number, number] });
    /** material: a PBRMaterial; others throw. */
    add<T extends Material>(material: T): T;
    /** Adds those of its materials that can be lit. */
    addScene(scene: Scene): void;
    /** Lights the probes by the SphereLights of the scene. */
    update(): void;
    dispose(): void;
}
