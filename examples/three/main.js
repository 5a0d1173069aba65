// SPDX-License-Identifier: MIT
// Balls from smooth to rough under 30 sphere lights, beside a sun and a point light of three.js; ?probe is one matte
// ball lit by a LightProbe instead, ?volume matte balls lit by a grid of probes; &webgpu draws by WebGPU.
//
// For tests, ?export sends the scene as glTF and the image as OpenEXR to the server; with ?alone three.js' own lights are
// left out.
import { load } from 'lampion';
import { SphereLight, lightProbe } from 'lampion/three';

const asked = new URLSearchParams(location.search), webgpu = asked.has('webgpu');
const THREE = await (webgpu ? import('three/webgpu') : import('three'));
const { LightProbeVolume, SphereLights } = await (webgpu ? import('lampion/three-webgpu') : import('lampion/three'));
const Material = webgpu ? THREE.MeshStandardNodeMaterial : THREE.MeshStandardMaterial;
const size = asked.has('export') ? [320, 200] : [innerWidth, innerHeight];
const matte = asked.has('volume');

const { lights } = await (await fetch('lights.json')).json();
const lmp = await load();

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, size[0] / size[1], 0.1, 50);
camera.position.set(0, 2.6, 6);
camera.lookAt(0, 0.4, 0);
scene.add(camera);
const lamps = lights.map(({ position, radius, radiance }) => {
    const lamp = new SphereLight(new THREE.Color(...radiance), 1, radius);
    lamp.radiance = 1;
    lamp.position.set(...position);
    return lamp;
});
scene.add(...lamps);

function add(geometry, options) {
    const mesh = new THREE.Mesh(geometry, new Material(options));
    scene.add(mesh);
    return mesh;
}

function addBalls() {
    const white = { name: 'matte', color: 0xffffff, roughness: 1 };
    add(new THREE.PlaneGeometry(9, 9), matte ? white : { color: 0x998877, roughness: 0.7 }).rotation.x = -Math.PI / 2;
    const ball = new THREE.SphereGeometry(0.45, 128, 64);
    for (let i = 0; i < 8; i++) {
        const metal = i % 2, look = { color: metal ? 0xd0a050 : 0x4060a0, metalness: metal, roughness: 0.3 + 0.1 * i };
        add(ball, matte ? white : look)
            .position.set(1.2 * (i % 4) - 1.8, 0.45, i < 4 ? -0.8 : 0.8);
    }
}

function addProbe() {
    const probe = new THREE.LightProbe();
    probe.position.set(0, 0.6, 0);
    scene.add(lightProbe(lmp, scene, probe));
    add(new THREE.SphereGeometry(0.01, 96, 64), { name: 'matte', color: 0xffffff, roughness: 1 }).position.set(0, 0.6, 0);
    camera.position.set(0, 0.6, 0.04);
    camera.lookAt(0, 0.6, 0);
    camera.near = 0.005;
    camera.updateProjectionMatrix();
}

function addOwnLights() {
    const sun = new THREE.DirectionalLight(0xffeedd, 1.5);
    sun.add(sun.target); // as glTF requires
    sun.target.position.set(0, 0, -1);
    sun.lookAt(-1, -2, -1);
    const bulb = new THREE.PointLight(0x80c0ff, 3);
    bulb.position.set(-2.2, 1.6, 1.8);
    scene.add(sun, bulb);
}

let lit; // what is updated every frame: lights, or probes
if (asked.has('probe')) {
    addProbe();
} else {
    addBalls();
    if (!asked.has('alone') && !matte)
        addOwnLights();
    if (matte) {
        lit = new LightProbeVolume(lmp, new THREE.Box3(new THREE.Vector3(-4.5, -0.1, -4.5), new THREE.Vector3(4.5, 1.1, 4.5)), [37, 7, 37]);
        lit.addScene(scene);
    } else {
        lit = new SphereLights(lmp, scene, { bands: 16 });
    }
    lit.update(scene);
}

const renderer = new THREE[webgpu ? 'WebGPURenderer' : 'WebGLRenderer']({ antialias: true });
await renderer.init?.();
renderer.setSize(...size);
document.body.append(renderer.domElement);

// What WebGPU drew into a target, whose rows begin at the top, as a texture of WebGL's.
async function flipped(target) {
    const [width, height] = size, pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
    const rows = Array.from({ length: height }, (none, y) => pixels.subarray(4 * width * y, 4 * width * (y + 1))).reverse();
    const data = new Float32Array(pixels.length);
    rows.forEach((row, y) => data.set(row, 4 * width * y));
    return new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.FloatType);
}

async function exportAll() {
    const { EXRExporter, NO_COMPRESSION } = await import('three/addons/exporters/EXRExporter.js');
    const { GLTFExporter } = await import('three/addons/exporters/GLTFExporter.js');
    const target = new THREE.WebGLRenderTarget(...size, { type: THREE.FloatType });
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const options = { type: THREE.FloatType, compression: NO_COMPRESSION };
    const send = (name, body) => fetch(name, { method: 'PUT', body });
    if (!webgpu) // the same scene
        await send('scene.gltf', JSON.stringify(await new GLTFExporter().parseAsync(scene)));
    await send('three.exr', await (webgpu ? new EXRExporter().parse(await flipped(target), options) : new EXRExporter().parse(renderer, target, options)));
}

if (asked.has('export'))
    await exportAll();
else
    renderer.setAnimationLoop((time) => {
        lamps.forEach((lamp, i) => { lamp.position.y = lights[i].position[1] + 0.2 * Math.sin(time / 700 + i); });
        lit?.update(scene);
        renderer.render(scene, camera);
    });
