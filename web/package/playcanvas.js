// SPDX-License-Identifier: MIT
// Lampion in PlayCanvas: sphere lights for StandardMaterial (SphereLights), and grids of probes that are relit every frame
// (LightProbeVolume). WebGL 2.
import {
    ADDRESS_CLAMP_TO_EDGE, Color, Entity, FILTER_LINEAR, FILTER_NEAREST, PIXELFORMAT_RGBA16F, PIXELFORMAT_RGBA32F, SHADERLANGUAGE_GLSL, ShaderChunks,
    StandardMaterial, Texture, Vec3,
} from 'playcanvas';
import { SphereTexels, checkBands, lightsGlsl, tableTexels, volumeGlsl } from './glsl.js';
import { optionsOf } from './options.js';
import { Patches } from './patches.js';
import { ProbeGrid, SLABS } from './probes.js';
import { Spheres, radianceOf } from './spheres.js';

// A glowing sphere. Its intensity is that of a point light, in candela, whatever its radius: it keeps its light as it
// grows. The color is linear.
export class SphereLight extends Entity {
    constructor(name, options = {}) {
        const { color = new Color(1, 1, 1), intensity = 1, radius = 0.1 } = optionsOf('SphereLight', options, ['color', 'intensity', 'radius']);
        super(name);
        Object.assign(this, { color, intensity, radius });
    }
    get radiance() {
        return radianceOf(this.intensity, this.radius);
    }
    set radiance(radiance) {
        this.intensity = radiance / radianceOf(1, this.radius);
    }
}

function gather(app, spheres) {
    spheres.clear();
    for (const node of app.root.find((one) => one instanceof SphereLight && one.enabled)) {
        const { x, y, z } = node.getPosition(), { r, g, b } = node.color;
        spheres.add(node, [x, y, z], [r, g, b]);
    }
}

function* materialsOf(app) {
    for (const { meshInstances } of app.root.findComponents('render'))
        for (const { material } of meshInstances)
            if (material.lampion !== false)
                yield material;
}

// Changes chunks of a material, by name, and adds the light of an expression to its color; returns what undoes it.
function extend(device, material, changes, light) {
    const common = ShaderChunks.get(device, SHADERLANGUAGE_GLSL), chunks = material.getShaderChunks(SHADERLANGUAGE_GLSL), before = new Map();
    const all = { ...changes, endPS: (code) => code.replace('+= litArgs_emission;', (emission) => `${emission}\n\tgl_FragColor.rgb += ${light};`) };
    for (const [name, change] of Object.entries(all)) {
        before.set(name, chunks.get(name));
        chunks.set(name, change(chunks.get(name) ?? common.get(name) ?? ''));
    }
    material.update();
    return () => {
        before.forEach((code, name) => code === undefined ? chunks.delete(name) : chunks.set(name, code));
        material.update();
    };
}

// Only materials of a metalness are glTF's.
const METALLIC = 'StandardMaterial whose useMetalness is set';
const isMetallic = (material) => material instanceof StandardMaterial && material.useMetalness;

const floatTexture = (device, { data, width, height }) => new Texture(device, {
    width, height, format: PIXELFORMAT_RGBA32F, mipmaps: false, minFilter: FILTER_NEAREST, magFilter: FILTER_NEAREST,
    addressU: ADDRESS_CLAMP_TO_EDGE, addressV: ADDRESS_CLAMP_TO_EDGE, levels: [data],
});

// Lights the standard materials of an application's scene by its SphereLights, those whose useMetalness is set. Call
// update() before every frame. Materials whose `lampion` is false are left alone.
export class SphereLights {
    constructor(lmp, app, options = {}) {
        const { bands = 10 } = optionsOf('SphereLights', options, ['bands']);
        checkBands(bands);
        const device = app.graphicsDevice;
        Object.assign(this, { app, spheres: new Spheres(lmp), texels: new SphereTexels(), table: floatTexture(device, tableTexels(lmp)) });
        const changes = {
            litUserDeclarationPS: (code) => `${code}\nvec3 lampionColor;${lightsGlsl(bands)}`,
            debugProcessFrontendPS: (code) => `lampionColor = litArgs_albedo; // which PlayCanvas multiplies by 1 - metalness\n${code}`,
        };
        const light = 'lampionLight(vPositionW, litArgs_worldNormal, dViewDirW, lampionColor, litArgs_metalness, 1.0 - litArgs_gloss)';
        this.patches = new Patches(METALLIC, isMetallic, (material) => extend(device, material, changes, light));
        this.update();
    }
    // Reads the lights of the scene, and lights materials that are new in it.
    update() {
        const { app, patches, spheres, table, texels } = this;
        gather(app, spheres);
        patches.addAll(materialsOf(app));
        if (texels.write(spheres)) {
            this.lights?.destroy();
            this.lights = floatTexture(app.graphicsDevice, texels);
        } else {
            this.lights.upload();
        }
        patches.forEach((material) => {
            material.setParameter('lampionTexels', table);
            material.setParameter('lampionLights', this.lights);
            material.setParameter('lampionCount', spheres.count);
        });
    }
    dispose() {
        this.patches.dispose();
        this.lights.destroy();
        this.table.destroy();
        this.spheres.free();
    }
}

// A grid of probes in a box (ProbeGrid), relit by update(): diffuse light of many lights, at one cost per pixel.
//
// min, max: corners of the box, Vec3; size: probes along x, y, z. Materials that add() or addScene() is given receive it.
export class LightProbeVolume {
    constructor(lmp, app, options) {
        const { min, max, size } = optionsOf('LightProbeVolume', options, ['min', 'max', 'size']);
        for (const [name, corner] of Object.entries({ min, max }))
            if (!(corner instanceof Vec3))
                throw new TypeError(`LightProbeVolume: ${name} is ${corner}, not a Vec3`);
        const corners = { min: [min.x, min.y, min.z], max: [max.x, max.y, max.z] };
        Object.assign(this, { app, spheres: new Spheres(lmp), grid: new ProbeGrid(lmp, { ...corners, size }) });
        this.texture = new Texture(app.graphicsDevice, {
            width: size[0], height: size[1], depth: SLABS * size[2], volume: true, format: PIXELFORMAT_RGBA16F, mipmaps: false,
            minFilter: FILTER_LINEAR, magFilter: FILTER_LINEAR, addressU: ADDRESS_CLAMP_TO_EDGE, addressV: ADDRESS_CLAMP_TO_EDGE,
            addressW: ADDRESS_CLAMP_TO_EDGE, levels: [this.grid.halves],
        });
        const parameters = { '': this.texture, Min: corners.min, Extent: this.grid.extent, Size: size };
        const changes = { litUserDeclarationPS: (code) => `${code}\n${volumeGlsl}` };
        const light = 'litArgs_albedo * lampionVolumeIrradiance(vPositionW, litArgs_worldNormal) / 3.14159265';
        this.patches = new Patches(METALLIC, isMetallic, (material) => {
            Object.entries(parameters).forEach(([name, value]) => material.setParameter(`lampionVolume${name}`, value));
            return extend(app.graphicsDevice, material, changes, light);
        });
        this.update();
    }
    add(material) {
        return this.patches.add(material);
    }
    addScene(app) {
        this.patches.addAll(materialsOf(app));
    }
    // Lights the probes by the SphereLights of the scene.
    update() {
        gather(this.app, this.spheres);
        this.grid.light(this.spheres.arrays, this.spheres.count);
        this.texture.upload();
    }
    dispose() {
        this.patches.dispose();
        this.texture.destroy();
        this.grid.free();
        this.spheres.free();
    }
}
