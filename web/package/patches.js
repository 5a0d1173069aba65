// SPDX-License-Identifier: MIT
// patches.js - materials that were changed, and how to undo it.

export class Patches {
    // is: whether a material can be changed; patch: changes it, and returns what undoes it.
    constructor(is, patch) {
        Object.assign(this, { is, patch, undo: new Map() });
    }
    add(material) {
        if (this.is(material) && !this.undo.has(material))
            this.undo.set(material, this.patch(material));
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
        this.undo.forEach((undo) => undo());
        this.undo.clear();
    }
}
