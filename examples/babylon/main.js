// SPDX-License-Identifier: MIT
// Balls from smooth to rough under 30 sphere lights, the scene of examples/three; ?volume lights matte balls by a grid of
// probes. For tests, ?export sends the image to the server, and that without lights: floats, rows from below.
import { Constants } from '@babylonjs/core/Engines/constants.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { PBRMaterial } from '@babylonjs/core/Materials/PBR/pbrMaterial.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { Color3, Color4 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { CreateGround } from '@babylonjs/core/Meshes/Builders/groundBuilder.js';
import { CreateSphere } from '@babylonjs/core/Meshes/Builders/sphereBuilder.js';
import { Scene } from '@babylonjs/core/scene.js';
import { load } from 'lampion';
import { LightProbeVolume, SphereLight, SphereLights } from 'lampion/babylon';

const asked = new URLSearchParams(location.search), matte = asked.has('volume');
const engine = new Engine(document.querySelector('canvas'), true), scene = new Scene(engine);
scene.useRightHandedSystem = true;
scene.clearColor = new Color4(0, 0, 0, 1);
const camera = new FreeCamera('camera', new Vector3(0, 2.6, 6), scene);
camera.setTarget(new Vector3(0, 0.4, 0));
Object.assign(camera, { fov: 40 * Math.PI / 180, minZ: 0.1, maxZ: 50 });

const { lights } = await (await fetch('../three/lights.json')).json();
const lamps = lights.map(({ position, radius, radiance }, i) => {
    const lamp = new SphereLight(`lamp ${i}`, scene, { color: Color3.FromArray(radiance), radius });
    lamp.radiance = 1;
    lamp.position.copyFromFloats(...position);
    return lamp;
});

function dress(mesh, albedo, metallic, roughness) {
    const look = matte ? { albedoColor: Color3.White(), metallic: 0, roughness: 1, metallicF0Factor: 0 } :
        { albedoColor: Color3.FromHexString(albedo).toLinearSpace(true), metallic, roughness };
    mesh.material = Object.assign(new PBRMaterial(mesh.name, scene), look);
    return mesh;
}

dress(CreateGround('ground', { width: 9, height: 9 }, scene), '#998877', 0, 0.7);
for (let i = 0; i < 8; i++)
    dress(CreateSphere(`ball ${i}`, { diameter: 0.9, segments: 62 }, scene), i % 2 ? '#d0a050' : '#4060a0', i % 2, 0.3 + 0.1 * i)
        .position.set(1.2 * (i % 4) - 1.8, 0.45, i < 4 ? -0.8 : 0.8);

const lmp = await load();
let lit; // what is updated every frame: lights, or probes
if (matte) {
    lit = new LightProbeVolume(lmp, scene, { min: new Vector3(-4.5, -0.1, -4.5), max: new Vector3(4.5, 1.1, 4.5), size: [37, 7, 37] });
    lit.addScene(scene);
} else {
    lit = new SphereLights(lmp, scene, { bands: 16 });
}

async function exportImage() {
    const size = { width: 320, height: 200 };
    const target = new RenderTargetTexture('image', size, scene, { type: Constants.TEXTURETYPE_FLOAT, samplingMode: Constants.TEXTURE_NEAREST_SAMPLINGMODE });
    target.renderList = scene.meshes;
    target.clearColor = scene.clearColor;
    scene.customRenderTargets.push(target);
    scene.imageProcessingConfiguration.applyByPostProcess = true; // of which there is none: materials give linear values
    engine.setSize(size.width, size.height);
    await scene.whenReadyAsync(true);
    const send = async (name) => {
        scene.render();
        await fetch(name, { method: 'PUT', body: await target.readPixels() });
    };
    await send('image.floats');
    lit.dispose();
    await scene.whenReadyAsync(true);
    await send('disposed.floats');
}

if (asked.has('export'))
    await exportImage();
else
    engine.runRenderLoop(() => {
        lamps.forEach((lamp, i) => { lamp.position.y = lights[i].position[1] + 0.2 * Math.sin(performance.now() / 700 + i); });
        lit.update();
        scene.render();
    });
