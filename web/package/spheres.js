// SPDX-License-Identifier: MIT
// spheres.js - SphereLight, and the sphere lights of a scene as arrays in Lampion's memory.
import { Color, Object3D, Vector3 } from 'three';

const world = new Vector3();

// A glowing sphere. Its intensity is that of a PointLight, in candela, whatever its radius: it keeps its light as it
// grows. `radiance` is that of its surface.
export class SphereLight extends Object3D {
    constructor(color = 0xffffff, intensity = 1, radius = 0.1) {
        super();
        this.isSphereLight = true;
        this.type = 'SphereLight';
        this.color = new Color(color);
        Object.assign(this, { intensity, radius });
    }
    get radiance() {
        return this.intensity / (Math.PI * this.radius ** 2);
    }
    set radiance(radiance) {
        this.intensity = radiance * Math.PI * this.radius ** 2;
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
}

// Returns the visible sphere lights of a scene as arrays in Lampion's memory, which `spheres` keeps.
export function gather(scene, spheres) {
    let count = 0;
    scene.traverseVisible((light) => {
        if (!light.isSphereLight)
            return;
        if (!(light.radius > 0))
            throw new RangeError(`the radius of SphereLight ${light.name} is ${light.radius}`);
        spheres.reserve(count + 1);
        world.setFromMatrixPosition(light.matrixWorld).toArray(spheres.center, 3 * count);
        spheres.radius[count] = light.radius;
        const { radiance } = light;
        spheres.radiance.set([radiance * light.color.r, radiance * light.color.g, radiance * light.color.b], 3 * count);
        count++;
    });
    spheres.count = count;
    return spheres;
}

export class Spheres {
    constructor(lmp) {
        Object.assign(this, { lmp, count: 0, capacity: 0 });
        this.reserve(64);
    }
    reserve(count) {
        if (count <= this.capacity)
            return;
        const { lmp, center, radius, radiance } = this;
        this.capacity = Math.max(count, 2 * this.capacity);
        for (const [name, width, old] of [['center', 3, center], ['radius', 1, radius], ['radiance', 3, radiance]]) {
            this[name] = lmp.floats(width * this.capacity);
            if (old) {
                this[name].set(old);
                lmp.free(old);
            }
        }
    }
    get arrays() {
        return { center: this.center, radius: this.radius, radiance: this.radiance };
    }
    free() {
        for (const array of [this.center, this.radius, this.radiance])
            this.lmp.free(array);
    }
}
