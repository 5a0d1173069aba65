// SPDX-License-Identifier: MIT
// Balls from smooth to rough under 30 sphere lights of Lampion, beside a sun and a point light of
// three.js; ?probe is one matte ball lit by a LightProbe instead.
//
// For tests, ?export sends the scene as glTF and the image as OpenEXR to the server; with ?alone
// three.js' own lights are left out.
import * as THREE from 'three';
import { loadLampion, probeOf } from './lampion.js';

const asked = new URLSearchParams(location.search);
const size = asked.has('export') ? [320, 200] : [innerWidth, innerHeight];

const { lights } = await (await fetch('lights.json')).json();
const lampion = await loadLampion('shaders', 16);
lampion.setLights(lights);

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, size[0] / size[1], 0.1, 50);
camera.position.set(0, 2.6, 6);
camera.lookAt(0, 0.4, 0);
scene.add(camera);

function add(geometry, options, lit = lampion) {
    const material = new THREE.MeshStandardMaterial(options);
    const mesh = new THREE.Mesh(geometry, lit ? lit.patch(material) : material);
    scene.add(mesh);
    return mesh;
}

function addBalls() {
    add(new THREE.PlaneGeometry(9, 9), { color: 0x998877, roughness: 0.7 }).rotation.x = -Math.PI / 2;
    const ball = new THREE.SphereGeometry(0.45, 96, 64);
    for (let i = 0; i < 8; i++) {
        const metal = i % 2;
        add(ball, { color: metal ? 0xd0a050 : 0x4060a0, metalness: metal, roughness: 0.3 + 0.1 * i })
            .position.set(1.2 * (i % 4) - 1.8, 0.45, i < 4 ? -0.8 : 0.8);
    }
}

// The ball is not patched, because a probe stands in for the lights.
async function addProbe() {
    scene.add(probeOf(await (await fetch('probe.json')).json()));
    const geometry = new THREE.SphereGeometry(0.01, 96, 64);
    add(geometry, { name: 'matte', color: 0xffffff, roughness: 1 }, null).position.set(0, 0.6, 0);
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

if (asked.has('probe'))
    await addProbe();
else
    addBalls();
if (!asked.has('probe') && !asked.has('alone'))
    addOwnLights();

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(...size);
document.body.append(renderer.domElement);

async function exportAll() {
    const { EXRExporter, NO_COMPRESSION } = await import('three/addons/exporters/EXRExporter.js');
    const { GLTFExporter } = await import('three/addons/exporters/GLTFExporter.js');
    const target = new THREE.WebGLRenderTarget(...size, { type: THREE.FloatType });
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const options = { type: THREE.FloatType, compression: NO_COMPRESSION };
    const send = (name, body) => fetch(name, { method: 'PUT', body });
    await send('scene.gltf', JSON.stringify(await new GLTFExporter().parseAsync(scene)));
    await send('three.exr', await new EXRExporter().parse(renderer, target, options));
}

if (asked.has('export'))
    await exportAll();
else
    renderer.setAnimationLoop((time) => {
        lampion.setLights(lights.map((light, i) => ({
            ...light, position: [light.position[0], light.position[1] + 0.2 * Math.sin(time / 700 + i), light.position[2]],
        })));
        renderer.render(scene, camera);
    });
