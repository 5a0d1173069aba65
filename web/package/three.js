// SPDX-License-Identifier: MIT
// Lampion in three.js: sphere lights for MeshStandardMaterial (SphereLights), grids of probes that are relit every
// frame (LightProbeVolume), and lights and rotations for Gaussian splats (SplatLights). WebGL 2.
import {
    Data3DTexture, DataTexture, FloatType, HalfFloatType, LightProbe, LinearFilter, RGBAFormat, Vector3,
} from 'three';
import { SphereTexels, checkBands, lightsGlsl, tableTexels, volumeGlsl } from './glsl.js';
import { optionsOf, titleOf } from './options.js';
import { Patches } from './patches.js';
import { ProbeGrid, SLABS } from './probes.js';
import { Spheres } from './spheres.js';
import { SphereLight, gather, materialsOf, sceneOf } from './three-spheres.js';

export { SphereLight };

// Adds code to the shader of a standard material, after what others have added.
function extend(material, key, uniforms, change) {
    const before = material.onBeforeCompile, keyBefore = material.customProgramCacheKey;
    material.onBeforeCompile = function compile(shader, renderer) {
        before.call(this, shader, renderer);
        Object.assign(shader.uniforms, uniforms);
        shader.fragmentShader = change(shader.fragmentShader);
    };
    material.customProgramCacheKey = function cacheKey() {
        return `${keyBefore.call(this)},${key}`;
    };
    material.needsUpdate = true;
    return () => {
        Object.assign(material, { onBeforeCompile: before, customProgramCacheKey: keyBefore, needsUpdate: true });
    };
}

const standard = (patch) => new Patches('MeshStandardMaterial or a MeshPhysicalMaterial', (material) => material?.isMeshStandardMaterial === true, patch);

function floatTexture({ data, width, height }) {
    const texture = new DataTexture(data, width, height, RGBAFormat, FloatType);
    texture.needsUpdate = true;
    return texture;
}

const WORLD = `
    vec3 lampionToWorld(vec3 v) { return (vec4(v, 0.0) * viewMatrix).xyz; }
    vec3 lampionWorldPosition(vec3 v) { return (vec4(v - viewMatrix[3].xyz, 0.0) * viewMatrix).xyz; }`;

// Lights the standard materials of a scene by its SphereLights. Call update() before every frame.
//
// bands: of highlights, 1 to 32: more for smoother surfaces. Materials whose userData.lampion is false are left alone.
export class SphereLights {
    constructor(lmp, scene, options = {}) {
        const { bands = 10 } = optionsOf('SphereLights', options, ['bands']);
        checkBands(bands);
        Object.assign(this, { lmp, spheres: new Spheres(lmp), scene: sceneOf('SphereLights', scene), texels: new SphereTexels() });
        this.uniforms = { lampionLights: { value: null }, lampionCount: { value: 0 }, lampionTexels: { value: floatTexture(tableTexels(lmp)) } };
        const head = `${WORLD.replaceAll('lampion', 'lampionLight')}${lightsGlsl(bands)}
            void main() {`;
        const body = `#include <lights_fragment_end>
            reflectedLight.directSpecular += lampionLight(lampionLightWorldPosition(geometryPosition),
                lampionLightToWorld(geometryNormal), lampionLightToWorld(geometryViewDir), diffuseColor.rgb, metalnessFactor, roughnessFactor);`;
        this.patches = standard((material) => extend(material, `lampion ${bands}`, this.uniforms, (shader) =>
            shader.replace('void main() {', () => head).replace('#include <lights_fragment_end>', () => body)));
        this.update();
    }
    // Reads the lights of the scene, and lights materials that are new in it.
    update() {
        const { scene, spheres, texels, uniforms } = this;
        gather(scene, spheres);
        this.patches.addAll(materialsOf(scene));
        if (texels.write(spheres)) {
            uniforms.lampionLights.value?.dispose();
            uniforms.lampionLights.value = floatTexture(texels);
        }
        uniforms.lampionLights.value.needsUpdate = true;
        uniforms.lampionCount.value = spheres.count;
    }
    dispose() {
        this.patches.dispose();
        this.uniforms.lampionLights.value.dispose();
        this.uniforms.lampionTexels.value.dispose();
        this.spheres.free();
    }
}

// A grid of probes in a box (ProbeGrid), relit by update(): diffuse light of many lights, at one cost per pixel.
//
// box: a Box3; size: probes along x, y, z. Only the standard materials given to add(), or found in the scene that
// addScene() is given, receive it. worker: a Worker of lampion/worker, which then lights the probes; they follow as soon
// as it is done, and update() returns at once.
export class LightProbeVolume {
    constructor(lmp, box, size, options = {}) {
        const { worker } = optionsOf('LightProbeVolume', options, ['worker']), spheres = new Spheres(lmp);
        if (!box?.isBox3)
            throw new TypeError(`LightProbeVolume: ${titleOf(box)} is not a Box3`);
        if (worker !== undefined && typeof worker?.postMessage !== 'function')
            throw new TypeError(`LightProbeVolume: worker is ${worker}, not a Worker`);
        const grid = { min: box.min.toArray(), max: box.max.toArray(), size };
        Object.assign(this, { spheres, grid: new ProbeGrid(lmp, grid), worker });
        const { halves, extent } = this.grid;
        if (worker) {
            worker.postMessage({ grid });
            worker.onmessage = ({ data }) => this.receive(data);
            worker.onerror = ({ message }) => {
                throw new Error(`LightProbeVolume: ${message ?? 'its worker could not be loaded'}`);
            };
        }
        const texture = new Data3DTexture(halves, size[0], size[1], SLABS * size[2]);
        Object.assign(texture, { format: RGBAFormat, type: HalfFloatType, minFilter: LinearFilter, magFilter: LinearFilter });
        this.uniforms = {
            lampionVolume: { value: texture }, lampionVolumeMin: { value: box.min.clone() }, lampionVolumeExtent: { value: new Vector3(...extent) },
            lampionVolumeSize: { value: new Vector3(...size) },
        };
        this.patches = this.makePatches(size);
    }
    makePatches() {
        const head = `${WORLD.replaceAll('lampion', 'lampionVolume')}${volumeGlsl}
            void main() {`;
        const body = `
            #if defined( RE_IndirectDiffuse )
                irradiance += lampionVolumeIrradiance(lampionVolumeWorldPosition(geometryPosition), lampionVolumeToWorld(geometryNormal));
            #endif
            #include <lights_fragment_maps>`;
        return standard((material) => extend(material, 'lampion volume', this.uniforms, (shader) =>
            shader.replace('void main() {', () => head).replace('#include <lights_fragment_maps>', () => body)));
    }
    add(material) {
        return this.patches.add(material);
    }
    addScene(scene) {
        this.patches.addAll(materialsOf(scene));
    }
    // Lights the probes by the SphereLights of a scene.
    update(scene) {
        if (!scene)
            throw new TypeError('LightProbeVolume: update takes the scene whose lamps light the probes');
        const { count, center, radius, radiance } = gather(sceneOf('LightProbeVolume', scene), this.spheres);
        if (!this.worker) {
            this.grid.light(this.spheres.arrays, count);
            this.uniforms.lampionVolume.value.needsUpdate = true;
        } else if (!this.busy) {
            this.busy = true;
            const spheres = { center: center.slice(0, 3 * count), radius: radius.slice(0, count), radiance: radiance.slice(0, 3 * count) };
            this.worker.postMessage({ spheres, count }, Object.values(spheres).map(({ buffer }) => buffer));
        }
    }
    receive({ halves, error }) {
        this.busy = false;
        if (error)
            throw new Error(`LightProbeVolume: ${error}`);
        if (!this.grid.halves) // disposed of, while the worker was busy
            return;
        this.grid.halves.set(halves);
        this.uniforms.lampionVolume.value.needsUpdate = true;
    }
    dispose() {
        this.patches.dispose();
        this.uniforms.lampionVolume.value.dispose();
        this.grid.free();
        this.spheres.free();
    }
}

// Lights a LightProbe by the SphereLights of a scene, as they are seen from its position. three's basis lacks the
// Condon-Shortley sign: odd m, the odd indices of three bands, change theirs. Both are of radiance.
export function lightProbe(lmp, scene, light = new LightProbe()) {
    const spheres = new Spheres(lmp), sh = new Float32Array(27), { arrays, count } = gather(sceneOf('lightProbe', scene), spheres);
    light.updateMatrixWorld();
    lmp.sphere_sum_n(3, arrays, count, null, new Float32Array(new Vector3().setFromMatrixPosition(light.matrixWorld).toArray()), 1, sh);
    spheres.free();
    for (let i = 0; i < 9; i++)
        light.sh.coefficients[i].set(sh[i], sh[9 + i], sh[18 + i]).multiplyScalar(i % 2 ? -1 : 1);
    return light;
}

const BAND_0 = 0.28209479177387814; // Y_00

// Lights for 3D Gaussian splats (Kerbl et al. 2023), and their coefficients when a scene turns.
export class SplatLights {
    constructor(lmp) {
        Object.assign(this, { lmp, spheres: new Spheres(lmp) });
    }
    // Writes the color of band 0, f_dc, of splats lit by the SphereLights of a scene; 3DGS shows 0.5 + Y_00 f_dc.
    //
    // positions, albedo and f_dc: three numbers per splat. normals: of splats that lie on surfaces, which then reflect
    // diffusely; without them, a splat scatters the light from everywhere alike.
    light(scene, splats, f_dc) {
        const { positions, normals, albedo } = optionsOf('SplatLights', splats, ['positions', 'normals', 'albedo']), { lmp } = this;
        for (const [name, array] of Object.entries({ positions, albedo, f_dc, ...normals && { normals } }))
            if (!(array instanceof Float32Array && array.length === positions.length && array.length % 3 === 0))
                throw new RangeError(`SplatLights: ${name} is not a Float32Array of three numbers per splat`);
        const n = positions.length / 3, { arrays, count } = gather(sceneOf('SplatLights', scene), this.spheres), rgb = lmp.floats(3 * n);
        if (normals) {
            const lights = Array.from({ length: count }, (none, i) => ({
                position: arrays.center.subarray(3 * i, 3 * i + 3), radius: arrays.radius[i], radiance: arrays.radiance.subarray(3 * i, 3 * i + 3),
            }));
            const surfaces = { position: positions, normal: normals, view: normals, material: { diffuse: [1, 1, 1] } };
            lmp.shade_n(null, surfaces, n, lights, count, rgb);
        } else { // the mean of the radiance over all directions
            lmp.sphere_sum_n(1, arrays, count, null, positions, n, rgb);
            for (let i = 0; i < 3 * n; i++)
                rgb[i] *= BAND_0;
        }
        for (let i = 0; i < 3 * n; i++)
            f_dc[i] = (rgb[i] * albedo[i] - 0.5) / BAND_0;
        lmp.free(rgb);
    }
    // Turns the coefficients of splats with a scene: f_rest holds, per splat, the coefficients of bands 1 and up of all
    // of red, then green, then blue. Viewers that leave this out leave the highlights behind.
    rotate(quaternion, bands, f_rest) {
        const { lmp } = this, rest = bands * bands - 1, n = f_rest.length / (3 * rest);
        if (!quaternion?.isQuaternion)
            throw new TypeError(`SplatLights: ${titleOf(quaternion)} is not a Quaternion`);
        if (!(Number.isInteger(bands) && bands >= 2))
            throw new RangeError(`SplatLights: bands is ${bands}, not 2 or more`);
        if (!Number.isInteger(n))
            throw new RangeError(`SplatLights: f_rest has ${f_rest.length} values, no multiple of ${3 * rest}`);
        const matrices = new Float32Array((4 * bands * bands - 1) * bands / 3);
        lmp.sh_make_rotation(bands, quaternion.toArray(), matrices);
        const from = lmp.floats(3 * n * (rest + 1)), to = lmp.floats(3 * n * (rest + 1));
        for (let i = 0; i < 3 * n; i++)
            from.set(f_rest.subarray(rest * i, rest * (i + 1)), (rest + 1) * i + 1);
        lmp.sh_rotate_n(bands, matrices, from, 3 * n, to);
        for (let i = 0; i < 3 * n; i++)
            f_rest.set(to.subarray((rest + 1) * i + 1, (rest + 1) * (i + 1)), rest * i);
        lmp.free(from);
        lmp.free(to);
    }
    dispose() {
        this.spheres.free();
    }
}
