// SPDX-License-Identifier: MIT
import { type AppBase, type Color, Entity, type Material, type Vec3 } from 'playcanvas';
import type { Lampion } from './index.js';

/** A glowing sphere. Its intensity is that of a point light, in candela, whatever its radius. */
export class SphereLight extends Entity {
    constructor(name: string, options?: { color?: Color, intensity?: number, radius?: number });
    /** Linear. */
    color: Color;
    intensity: number;
    /** Above 0; 0.01 stands for a point. */
    radius: number;
    /** Of its surface, candela per square meter. */
    radiance: number;
}

/** Lights the standard materials of an application's scene whose useMetalness is set by its SphereLights. Those whose `lampion` is false are left alone. */
export class SphereLights {
    /** bands: of highlights, 1 to 32; 10. */
    constructor(lmp: Lampion, app: AppBase, options?: { bands?: number });
    /** Reads the lights of the scene, and lights materials that are new in it: before every frame. */
    update(): void;
    dispose(): void;
}

/** A grid of probes in a box, relit by update(): diffuse light of many lights, at one cost per pixel. */
export class LightProbeVolume {
    constructor(lmp: Lampion, app: AppBase, options: { min: Vec3, max: Vec3, size: [number, number, number] });
    /** material: a StandardMaterial whose useMetalness is set; others throw. */
    add<T extends Material>(material: T): T;
    /** Adds those of its materials that can be lit. */
    addScene(app: AppBase): void;
    /** Lights the probes by the SphereLights of the scene. */
    update(): void;
    dispose(): void;
}
