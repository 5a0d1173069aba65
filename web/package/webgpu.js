// SPDX-License-Identifier: MIT
// Lampion in three.js' WebGPURenderer: sphere lights and grids of probes for standard materials, of nodes or not.
import { StorageBufferAttribute } from 'three/webgpu';
import {
    Fn, cameraPosition, code, diffuseColor, dot, materialEmissive, materialRoughness, max, metalness, normalWorld, positionWorld, storage, texture3D, uniform,
    vec3, vec4, wgslFn,
} from 'three/tsl';
import { checkBands } from './glsl.js';
import { optionsOf } from './options.js';
import { Patches } from './patches.js';
import { SLABS } from './probes.js';
import { Spheres } from './spheres.js';
import { LightProbeVolume as Volume } from './three.js';
import { gather, materialsOf, sceneOf } from './three-spheres.js';
import { lampionWgsl } from './wgsl.js';

// three declares a buffer only where a node reads it: the functions below are given an element of each.
const HOOKS = `
fn lmp_light_count() -> i32 { return i32(lampionLights.value[0].x); }
fn lmp_light_sphere(i: i32) -> vec4f { return lampionLights.value[2 * i + 1]; }
fn lmp_light_radiance(i: i32) -> vec3f { return lampionLights.value[2 * i + 2].rgb; }
fn lmp_ggx_texel(i: i32) -> vec4f { return lampionTable.value[i]; }`;
const SHADE = `
fn lampionShade(position: vec3f, normal: vec3f, view: vec3f, color: vec3f, metallic: f32, roughness: f32, light: vec4f, texel: vec4f) -> vec3f {
    return lmp_shade_zonal_metallic_roughness(lmp_surface(position, normal, view), lmp_metallic_roughness(color, metallic, roughness));
}`;

// Adds light to what a material emits. WebGPURenderer makes a node material of one that is none, with all its members, and
// so with its emissiveNode.
const isStandard = (material) => material?.isMeshStandardNodeMaterial === true || material?.isMeshStandardMaterial === true;
const emitting = (light) => new Patches('MeshStandardMaterial, a MeshPhysicalMaterial or the node material of one', isStandard, (material) => {
    const before = material.emissiveNode ?? null;
    Object.assign(material, { emissiveNode: (before ?? materialEmissive).add(light(material)), needsUpdate: true });
    return () => Object.assign(material, { emissiveNode: before, needsUpdate: true });
});

// Lights the standard materials of a scene by its SphereLights. Call update() before every frame.
//
// bands: of highlights, 1 to 32; most: the most lights. Materials whose userData.lampion is false are left alone.
export class SphereLights {
    constructor(lmp, scene, options = {}) {
        const { bands = 10, most = 256 } = optionsOf('SphereLights', options, ['bands', 'most']), spheres = new Spheres(lmp);
        checkBands(bands);
        if (!(Number.isInteger(most) && most >= 1))
            throw new RangeError(`SphereLights: most is ${most}, not a number of lights`);
        const table = new Float32Array(4 * lmp.GGX_TEXELS), size = 2 * most + 1;
        lmp.lobe_copy_ggx_texels(table);
        Object.assign(this, { scene: sceneOf('SphereLights', scene), most, spheres, attribute: new StorageBufferAttribute(new Float32Array(4 * size), 4) });
        const lights = storage(this.attribute, 'vec4', size).toReadOnly().setName('lampionLights');
        const texels = storage(new StorageBufferAttribute(table, 4), 'vec4', lmp.GGX_TEXELS).toReadOnly().setName('lampionTable');
        const shade = wgslFn(SHADE, [code(lampionWgsl({ bands, window: 'hanning', ggx: true }) + HOOKS, [], 'wgsl')]);
        const view = cameraPosition.sub(positionWorld).normalize();
        this.patches = emitting(({ roughnessNode }) => Fn(({ renderer }) => {
            if (!renderer.backend.isWebGPUBackend)
                throw new Error('SphereLights of lampion/three-webgpu need WebGPU, and this renderer fell back to WebGL 2: take WebGLRenderer and lampion/three');
            return shade(positionWorld, normalWorld, view, diffuseColor.rgb, metalness, roughnessNode ?? materialRoughness, lights.element(0), texels.element(0));
        })());
        this.update();
    }
    // Reads the lights of the scene, and lights materials that are new in it.
    update() {
        const { attribute, most, scene } = this, { array } = attribute;
        const { count, center, radius, radiance } = gather(scene, this.spheres);
        if (count > most)
            throw new RangeError(`SphereLights: there are ${count} lights, and most is ${most}`);
        this.patches.addAll(materialsOf(scene));
        array[0] = count;
        for (let i = 0; i < count; i++) {
            array.set(center.subarray(3 * i, 3 * i + 3), 8 * i + 4);
            array[8 * i + 7] = radius[i];
            array.set(radiance.subarray(3 * i, 3 * i + 3), 8 * i + 8);
        }
        attribute.needsUpdate = true;
    }
    dispose() {
        this.patches.dispose();
        this.spheres.free();
    }
}

// The volume of lampion/three, for WebGPURenderer.
export class LightProbeVolume extends Volume {
    makePatches([width, height, depth]) {
        const { lampionVolume, lampionVolumeMin, lampionVolumeExtent } = this.uniforms;
        const at = positionWorld.sub(uniform(lampionVolumeMin.value)).div(uniform(lampionVolumeExtent.value)).clamp(0, 1)
            .mul(vec3(width - 1, height - 1, depth - 1)).add(0.5);
        const slab = (k) => texture3D(lampionVolume.value, vec3(at.x.div(width), at.y.div(height), at.z.add(depth * k).div(SLABS * depth)));
        const n = normalWorld, linear = vec4(n, 1), quadratic = vec4(n.x.mul(n.y), n.y.mul(n.z), n.z.mul(n.z), n.z.mul(n.x));
        const sum = (factors, first) => vec3(dot(factors, slab(first)), dot(factors, slab(first + 1)), dot(factors, slab(first + 2)));
        const irradiance = sum(linear, 0).add(sum(quadratic, 3)).add(slab(6).rgb.mul(n.x.mul(n.x).sub(n.y.mul(n.y))));
        return emitting(() => max(irradiance, 0).mul(diffuseColor.rgb).mul(metalness.oneMinus()).div(Math.PI));
    }
}
