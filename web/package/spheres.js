// SPDX-License-Identifier: MIT
// spheres.js - spheres as arrays in Lampion's memory, which grow.
import { said, titleOf } from './options.js';

// Returns the radiance of a sphere of an intensity: of a distant point, in candela, and independent of the radius.
export const radianceOf = (intensity, radius) => intensity / (Math.PI * radius ** 2);

export class Spheres {
    constructor(lmp) {
        if (typeof lmp?.floats !== 'function')
            throw new TypeError('the first argument is not what load() resolves to (await load())');
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
    // Begins anew, without any sphere.
    clear() {
        if (!this.center)
            throw new Error('this was disposed of');
        this.count = 0;
    }
    // Adds an engine's SphereLight behind those there are.
    add(light, position, color) {
        const { radius, intensity } = light, refuse = (what) => { throw new RangeError(`${titleOf(light)}: ${what}`); };
        if (!(Number.isFinite(radius) && radius > 0))
            refuse(`its radius is ${said(radius)}, not above 0; 0.01 stands for a point`);
        if (!Number.isFinite(intensity))
            refuse(`its intensity is ${said(intensity)}, not a number`);
        if (!position.every(Number.isFinite))
            refuse(`its position is ${position}`);
        if (!color.every(Number.isFinite))
            refuse(`its color is ${color}`);
        const i = this.count++, radiance = radianceOf(intensity, radius);
        this.reserve(this.count);
        this.center.set(position, 3 * i);
        this.radius[i] = radius;
        this.radiance.set(color.map((value) => radiance * value), 3 * i);
    }
    get arrays() {
        return { center: this.center, radius: this.radius, radiance: this.radiance };
    }
    free() {
        if (this.center)
            [this.center, this.radius, this.radiance].forEach((array) => this.lmp.free(array));
        this.center = this.radius = this.radiance = undefined;
    }
}
