// SPDX-License-Identifier: MIT
// A room of lanterns that move, lit by a grid of probes: ?lights=1000, or as many as you like; ?three lights it by
// three's own point lights instead, ?worker lights the probes in a worker.
//
// For tests, ?frames=N draws so many frames as fast as it can: their milliseconds are window.times, a pixel of the floor
// window.pixel, errors of shaders window.errors; the probes are window.volume.
import * as THREE from 'three';
import { load } from 'lampion';
import { LightProbeVolume, SphereLight } from 'lampion/three';

const asked = new URLSearchParams(location.search);
const count = Number(asked.get('lights') ?? 1000), own = asked.has('three');
const size = asked.has('frames') ? [640, 360] : [innerWidth, innerHeight];
const ROOM = new THREE.Box3(new THREE.Vector3(-8, 0, -8), new THREE.Vector3(8, 4, 8)), RADIUS = 0.05;

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(60, size[0] / size[1], 0.1, 50);
camera.position.set(0, 2.2, 7.6);
camera.lookAt(0, 1.2, 0);

const clay = new THREE.MeshStandardMaterial({ color: 0xe8e0d8, roughness: 1 });
const room = new THREE.Mesh(new THREE.BoxGeometry(16, 4, 16), clay.clone());
room.material.side = THREE.BackSide;
room.position.y = 2;
scene.add(room);
const pillar = new THREE.CylinderGeometry(0.35, 0.35, 4, 48), ball = new THREE.SphereGeometry(0.6, 48, 32);
for (let i = 0; i < 12; i++) {
    const angle = (i + 0.5) * Math.PI / 6, column = new THREE.Mesh(pillar, clay), stone = new THREE.Mesh(ball, clay);
    column.position.set(5 * Math.cos(angle), 2, 5 * Math.sin(angle));
    stone.position.set(2.5 * Math.cos(angle), 0.6, 2.5 * Math.sin(angle));
    scene.add(column, stone);
}

// Lanterns: lights, and the spheres that are seen of them.
const intensity = 60 / count;
const shape = new THREE.InstancedMesh(new THREE.SphereGeometry(RADIUS, 12, 8), new THREE.MeshBasicMaterial(), count);
const lamps = Array.from({ length: count }, (none, i) => {
    const color = new THREE.Color().setHSL((i * 0.381966 + 0.02) % 1, 0.8, 0.6);
    shape.setColorAt(i, color);
    return own ? new THREE.PointLight(color, intensity) : new SphereLight(color, intensity, RADIUS);
});
scene.add(shape, ...lamps);

const matrix = new THREE.Matrix4();
function move(seconds) {
    lamps.forEach(({ position }, i) => {
        const a = i * 2.399963, r = 7.5 * Math.sqrt((i + 0.5) / count), turn = a + 0.05 * seconds;
        position.set(r * Math.cos(turn), 2 + 1.6 * Math.sin(0.3 * seconds + 1.7 * i), r * Math.sin(turn));
        shape.setMatrixAt(i, matrix.setPosition(position));
    });
    shape.instanceMatrix.needsUpdate = true;
}

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.toneMapping = THREE.ACESFilmicToneMapping;
renderer.setSize(...size);
document.body.append(renderer.domElement);

let volume;
if (!own) {
    const worker = asked.has('worker') ? new Worker(new URL('./node_modules/lampion/worker.js', import.meta.url), { type: 'module' }) : undefined;
    volume = new LightProbeVolume(await load(), ROOM, [17, 9, 17], { worker });
    volume.addScene(scene);
    window.volume = volume;
}
function draw(seconds) {
    move(seconds);
    volume?.update(scene);
    renderer.render(scene, camera);
}

const errors = [];
renderer.debug.onShaderError = (gl, program) => errors.push(gl.getProgramInfoLog(program));
if (asked.has('frames')) {
    const gl = renderer.getContext(), pixel = new Uint8Array(4);
    const finish = () => gl.readPixels(size[0] / 2, size[1] / 16, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // which waits for the frame
    draw(0);
    finish();
    window.times = Array.from({ length: Number(asked.get('frames')) }, (none, i) => {
        const begin = performance.now();
        draw(0.1 * i);
        finish();
        return performance.now() - begin;
    });
    Object.assign(window, { errors, pixel: [...pixel] });
} else {
    renderer.setAnimationLoop((time) => draw(time / 1000));
}
