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
    // All materials of a scene whose userData.lampion is not false.
    addScene(scene) {
        scene.traverse(({ material }) => {
            for (const one of material ? [material].flat() : [])
                if (one.userData.lampion !== false)
                    this.add(one);
        });
    }
    dispose() {
        this.undo.forEach((undo) => undo());
        this.undo.clear();
    }
}
