// SPDX-License-Identifier: MIT
// spheres.js - spheres as arrays in Lampion's memory, which grow.

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
    // Adds a sphere behind those there are.
    add(name, position, radius, color, radiance) {
        if (!(radius > 0))
            throw new RangeError(`the radius of the SphereLight "${name}" is ${radius}, not above 0`);
        const i = this.count++;
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
