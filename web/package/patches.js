// SPDX-License-Identifier: MIT
// patches.js - materials that were changed, and how to undo it.

const changed = new WeakSet(); // by any Patches: light added twice would count twice

export class Patches {
    // is: whether a material can be changed; patch: changes it, and returns what undoes it.
    constructor(is, patch) {
        Object.assign(this, { is, patch, undo: new Map() });
    }
    add(material) {
        if (!this.is(material) || this.undo.has(material))
            return material;
        if (changed.has(material))
            throw new Error(`the material "${material.name}" is already lit by other SphereLights or by a LightProbeVolume: it can have one of them`);
        this.undo.set(material, this.patch(material));
        changed.add(material);
        return material;
    }
    addAll(materials) {
        for (const material of materials)
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
