// SPDX-License-Identifier: MIT
// npm_engines.mjs babylon|playcanvas: what the classes for Babylon.js and PlayCanvas say of wrong options, lamps and
// materials, in node, where these engines run without drawing.
import assert from 'node:assert/strict';
import { load } from 'lampion';

const engines = {
    async babylon() {
        const { NullEngine } = await import('@babylonjs/core/Engines/nullEngine.js'), { Scene } = await import('@babylonjs/core/scene.js');
        const { PBRMaterial } = await import('@babylonjs/core/Materials/PBR/pbrMaterial.js'), { StandardMaterial } = await import('@babylonjs/core/Materials/standardMaterial.js');
        const { Vector3 } = await import('@babylonjs/core/Maths/math.vector.js'), lampion = await import('lampion/babylon'), engine = new NullEngine(), scene = new Scene(engine);
        Object.assign(engine, { createRawTexture3D: () => engine.createRawTexture(null, 1, 1, 5, false, false, 1), updateRawTexture3D() {} }); // which it lacks
        return {
            lampion, place: scene, lamp: new lampion.SphereLight('lamp', scene), make: (options) => new lampion.SphereLight('lamp', scene, options),
            corners: [Vector3.Zero(), Vector3.One()], dull: new StandardMaterial('dull', scene), shiny: new PBRMaterial('shiny', scene), kind: /cannot be lit; only a PBRMaterial can/,
        };
    },
    async playcanvas() {
        const { Entity, NullGraphicsDevice, StandardMaterial, Vec3 } = await import('playcanvas'), lampion = await import('lampion/playcanvas');
        const canvas = { addEventListener() {}, getBoundingClientRect: () => ({}) }, app = { graphicsDevice: new NullGraphicsDevice(canvas), root: new Entity() };
        const lamp = new lampion.SphereLight('lamp'), named = (name, members) => Object.assign(new StandardMaterial(), { name, ...members });
        app.root._enabledInHierarchy = true; // as an application's root
        app.root.addChild(lamp);
        return {
            lampion, place: app, lamp, make: (options) => new lampion.SphereLight('lamp', options), corners: [new Vec3(), new Vec3(1, 1, 1)],
            dull: named('dull'), shiny: named('shiny', { useMetalness: true }), kind: /cannot be lit; only a StandardMaterial whose useMetalness is set can/,
        };
    },
};

const { lampion: { LightProbeVolume, SphereLights }, place, lamp, make, corners: [min, max], dull, shiny, kind } = await engines[process.argv[2]]();
const lmp = await load(), size = [2, 2, 2], lights = new SphereLights(lmp, place), volume = new LightProbeVolume(lmp, place, { min, max, size });
const refused = (run, fault) => assert.throws(run, { message: fault });
const [radiance] = lights.spheres.radiance;
refused(() => make({ intensitty: 3 }), /SphereLight: there is no option intensitty/);
refused(() => make(3), /SphereLight takes options/);
refused(() => new SphereLights(lmp, place, { band: 8 }), /SphereLights: there is no option band/);
refused(() => new SphereLights(lmp, place, 8), /SphereLights takes options/);
refused(() => new LightProbeVolume(lmp, place, { min, max, sizes: size }), /LightProbeVolume: there is no option sizes/);
refused(() => new LightProbeVolume(lmp, place, { min: [0, 0, 0], max, size }), /min is 0,0,0, not a Vec/);
refused(() => volume.add(dull), /"dull" cannot be lit/);
refused(() => volume.add(dull), kind);
for (const [member, value, fault] of [['intensity', NaN, /"lamp": its intensity is NaN/], ['radius', 0, /"lamp": its radius is 0, not above 0/], ['radius', '1', /its radius is "1"/]]) {
    const before = lamp[member];
    lamp[member] = value;
    refused(() => lights.update(), fault);
    lamp[member] = before;
}
lights.update();
assert.equal(lights.spheres.radiance[0], radiance);
lights.dispose();
assert.equal(volume.add(shiny), shiny);
