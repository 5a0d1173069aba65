// SPDX-License-Identifier: MIT
// Lampion in Babylon.js: sphere lights for PBRMaterial (SphereLights), and grids of probes that are relit every frame
// (LightProbeVolume). WebGL 2.
import { Constants } from '@babylonjs/core/Engines/constants.js';
import { MaterialPluginBase } from '@babylonjs/core/Materials/materialPluginBase.js';
import { PBRBaseMaterial } from '@babylonjs/core/Materials/PBR/pbrBaseMaterial.js';
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';
import { RawTexture3D } from '@babylonjs/core/Materials/Textures/rawTexture3D.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import { SphereTexels, checkBands, lightsGlsl, tableTexels, volumeGlsl } from './glsl.js';
import { optionsOf } from './options.js';
import { Patches } from './patches.js';
import { ProbeGrid, SLABS } from './probes.js';
import { Spheres, radianceOf } from './spheres.js';

// A glowing sphere. Its intensity is that of a point light, in candela, whatever its radius: it keeps its light as it
// grows. The color is linear.
export class SphereLight extends TransformNode {
    constructor(name, scene, options = {}) {
        const { color = Color3.White(), intensity = 1, radius = 0.1 } = optionsOf('SphereLight', options, ['color', 'intensity', 'radius']);
        super(name, scene); // which adds it to the scene
        Object.assign(this, { color, intensity, radius });
    }
    get radiance() {
        return radianceOf(this.intensity, this.radius);
    }
    set radiance(radiance) {
        this.intensity = radiance / radianceOf(1, this.radius);
    }
}

function gather(scene, spheres) {
    spheres.clear();
    for (const node of scene.transformNodes)
        if (node instanceof SphereLight && node.isEnabled()) {
            node.computeWorldMatrix(true);
            spheres.add(node, node.getAbsolutePosition().asArray(), node.color.asArray());
        }
}

// Adds light to the color of a material. Babylon removes no plugin, but it can be turned off.
class LightPlugin extends MaterialPluginBase {
    // define: [name, value] of GLSL's; head: functions; light: an expression; textures: of samplers; bind: sets uniforms.
    constructor(material, define, { head, light, textures, uniforms, bind }) {
        const [name, value] = define;
        super(material, name, 200, { [name]: 0 });
        Object.assign(this, { define, head, light, textures, uniforms, bind, on: true });
        this._enable(true);
        this.value = value;
    }
    getClassName() {
        return 'LampionPlugin';
    }
    turnOff() {
        this.on = false;
        this.markAllDefinesAsDirty();
    }
    prepareDefines(defines) {
        defines[this.name] = this.on ? this.value : 0;
    }
    getSamplers(samplers) {
        samplers.push(...Object.keys(this.textures()));
    }
    getUniforms() {
        return { externalUniforms: this.uniforms };
    }
    bindForSubMesh(buffer, scene, engine, { effect }) {
        if (!this.on)
            return;
        for (const [name, texture] of Object.entries(this.textures()))
            effect.setTexture(name, texture);
        this.bind(effect);
    }
    getCustomCode(stage) {
        return stage !== 'fragment' ? null : {
            CUSTOM_FRAGMENT_DEFINITIONS: `#if ${this.name} > 0\n${this.head}\n#endif`,
            CUSTOM_FRAGMENT_BEFORE_FOG: `#if ${this.name} > 0 && defined(METALLICWORKFLOW)\nfinalColor.rgb += ${this.light};\n#endif`,
        };
    }
}

const materialsOf = ({ materials }) => materials.filter(({ metadata }) => metadata?.lampion !== false);

// Patches of PBR materials by plugins: arguments of LightPlugin.
const plugins = (define, options) => new Patches('PBRMaterial', (material) => material instanceof PBRBaseMaterial, (material) => {
    const plugin = new LightPlugin(material, define, options);
    return () => plugin.turnOff();
});

const floatTexture = ({ data, width, height }, scene) =>
    RawTexture.CreateRGBATexture(data, width, height, scene, false, false, Constants.TEXTURE_NEAREST_SAMPLINGMODE, Constants.TEXTURETYPE_FLOAT);

// Lights the PBR materials of a scene by its SphereLights, those of metallic and roughness. Call update() before every
// frame, the first one, too: Babylon takes no plugin for a material that it has drawn. Materials whose metadata.lampion is
// false are left alone.
export class SphereLights {
    constructor(lmp, scene, options = {}) {
        const { bands = 10 } = optionsOf('SphereLights', options, ['bands']);
        checkBands(bands);
        Object.assign(this, { lmp, scene, spheres: new Spheres(lmp), texels: new SphereTexels(), table: floatTexture(tableTexels(lmp), scene) });
        this.patches = plugins(['LAMPION_BANDS', bands], {
            head: lightsGlsl(bands),
            light: 'lampionLight(vPositionW, normalW, viewDirectionW, baseColor, reflectivityOut.metallic, roughness)',
            textures: () => ({ lampionLights: this.lights, lampionTexels: this.table }),
            uniforms: ['lampionCount'],
            bind: (effect) => effect.setInt('lampionCount', this.spheres.count),
        });
        this.update();
    }
    // Reads the lights of the scene, and lights materials that are new in it.
    update() {
        const { scene, spheres, texels } = this;
        gather(scene, spheres);
        if (texels.write(spheres)) {
            this.lights?.dispose();
            this.lights = floatTexture(texels, scene);
        } else {
            this.lights.update(texels.data);
        }
        this.patches.addAll(materialsOf(scene));
    }
    dispose() {
        this.patches.dispose();
        this.lights.dispose();
        this.table.dispose();
        this.spheres.free();
    }
}

// A grid of probes in a box (ProbeGrid), relit by update(): diffuse light of many lights, at one cost per pixel.
//
// min, max: corners of the box, Vector3; size: probes along x, y, z. Materials that add() or addScene() is given receive it.
export class LightProbeVolume {
    constructor(lmp, scene, options) {
        const { min, max, size } = optionsOf('LightProbeVolume', options, ['min', 'max', 'size']);
        for (const [name, corner] of Object.entries({ min, max }))
            if (!(corner instanceof Vector3))
                throw new TypeError(`LightProbeVolume: ${name} is ${corner}, not a Vector3`);
        Object.assign(this, { scene, spheres: new Spheres(lmp), grid: new ProbeGrid(lmp, { min: min.asArray(), max: max.asArray(), size }) });
        const vectors = { Min: min.clone(), Extent: Vector3.FromArray(this.grid.extent), Size: Vector3.FromArray(size) };
        this.texture = new RawTexture3D(this.grid.halves, size[0], size[1], SLABS * size[2], Constants.TEXTUREFORMAT_RGBA, scene, false, false,
            Constants.TEXTURE_BILINEAR_SAMPLINGMODE, Constants.TEXTURETYPE_HALF_FLOAT);
        this.patches = plugins(['LAMPION_VOLUME', 1], {
            head: volumeGlsl,
            light: 'surfaceAlbedo * lampionVolumeIrradiance(vPositionW, normalW) / 3.14159265',
            textures: () => ({ lampionVolume: this.texture }),
            uniforms: Object.keys(vectors).map((name) => `lampionVolume${name}`),
            bind: (effect) => Object.entries(vectors).forEach(([name, vector]) => effect.setVector3(`lampionVolume${name}`, vector)),
        });
        this.update();
    }
    add(material) {
        return this.patches.add(material);
    }
    addScene(scene) {
        this.patches.addAll(materialsOf(scene));
    }
    // Lights the probes by the SphereLights of the scene.
    update() {
        gather(this.scene, this.spheres);
        this.grid.light(this.spheres.arrays, this.spheres.count);
        this.texture.update(this.grid.halves);
    }
    dispose() {
        this.patches.dispose();
        this.texture.dispose();
        this.grid.free();
        this.spheres.free();
    }
}
