// SPDX-License-Identifier: MIT
// patches.js - materials that were changed, and how to undo it.
import { titleOf } from './options.js';

const changed = new WeakSet(); // by any Patches: light added twice would count twice

export class Patches {
    // kinds: of materials that can be changed, in words; is: whether one can; patch: changes it, and returns what undoes it.
    constructor(kinds, is, patch) {
        Object.assign(this, { kinds, is, patch, undo: new Map() });
    }
    add(material) {
        if (!this.is(material))
            throw new TypeError(`${titleOf(material)} cannot be lit; only a ${this.kinds} can`);
        if (this.undo.has(material))
            return material;
        if (changed.has(material))
            throw new Error(`${titleOf(material)} is already lit by other SphereLights or by a LightProbeVolume: it can have one of them`);
        this.undo.set(material, this.patch(material));
        changed.add(material);
        return material;
    }
    // Adds those of a scene's materials that can be lit.
    addAll(materials) {
        for (const material of materials)
            if (this.is(material))
                this.add(material);
    }
    forEach(visit) {
        for (const material of this.undo.keys())
            visit(material);
    }
    dispose() {
        this.undo.forEach((undo, material) => {
            undo();
            changed.delete(material);
        });
        this.undo.clear();
    }
}
