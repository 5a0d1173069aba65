// SPDX-License-Identifier: MIT
// three-spheres.js - three's SphereLight, and those of a scene as arrays in Lampion's memory.
import { Color, Object3D, Vector3 } from 'three';
import { titleOf } from './options.js';
import { radianceOf } from './spheres.js';

const world = new Vector3();

// A glowing sphere. Its intensity is that of a PointLight, in candela, whatever its radius: it keeps its light as it
// grows. `radiance` is that of its surface.
export class SphereLight extends Object3D {
    constructor(color = 0xffffff, intensity = 1, radius = 0.1) {
        if (typeof color === 'object' && !color?.isColor)
            throw new TypeError('SphereLight takes a color, an intensity and a radius, not an object');
        super();
        this.isSphereLight = true;
        this.type = 'SphereLight';
        this.color = new Color(color);
        Object.assign(this, { intensity, radius });
    }
    get radiance() {
        return radianceOf(this.intensity, this.radius);
    }
    set radiance(radiance) {
        this.intensity = radiance / radianceOf(1, this.radius);
    }
    get power() {
        return 4 * Math.PI * this.intensity;
    }
    set power(power) {
        this.intensity = power / (4 * Math.PI);
    }
    copy(source, recursive) {
        super.copy(source, recursive);
        this.color.copy(source.color);
        return Object.assign(this, { intensity: source.intensity, radius: source.radius });
    }
    toJSON(meta) {
        const data = super.toJSON(meta), { color, intensity, radius } = this;
        Object.assign(data.object, { color: color.getHex(), intensity, radius });
        return data;
    }
}

// Returns the visible sphere lights of a scene as arrays in Lampion's memory, which `spheres` keeps.
export function gather(scene, spheres) {
    spheres.clear();
    scene.updateMatrixWorld();
    scene.traverseVisible((light) => {
        if (light.isSphereLight)
            spheres.add(light, world.setFromMatrixPosition(light.matrixWorld).toArray(), light.color.toArray());
    });
    return spheres;
}

// Returns a scene, or says what else it is.
export function sceneOf(owner, scene) {
    if (!scene?.isObject3D)
        throw new TypeError(`${owner}: ${titleOf(scene)} is not a scene`);
    return scene;
}

// Returns all materials of a scene whose userData.lampion is not false.
export function materialsOf(scene) {
    const all = [];
    scene.traverse(({ material }) => all.push(...[material ?? []].flat()));
    return all.filter(({ userData }) => userData.lampion !== false);
}
