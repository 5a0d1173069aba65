// SPDX-License-Identifier: MIT
// Balls from smooth to rough under 30 sphere lights, the scene of examples/three; ?volume lights matte balls by a grid of
// probes. For tests, ?export sends the image to the server, and that without lights: floats, rows from below.
import {
    Application, Color, Entity, FILLMODE_FILL_WINDOW, FILLMODE_NONE, GAMMA_NONE, Mesh, MeshInstance, PIXELFORMAT_RGBA32F, PlaneGeometry, RESOLUTION_AUTO,
    RESOLUTION_FIXED, RenderTarget, SphereGeometry, StandardMaterial, TONEMAP_NONE, Texture, Vec3,
} from 'playcanvas';
import { load } from 'lampion';
import { LightProbeVolume, SphereLight, SphereLights } from 'lampion/playcanvas';

const asked = new URLSearchParams(location.search), matte = asked.has('volume'), exporting = asked.has('export');
const app = new Application(document.querySelector('canvas')), device = app.graphicsDevice;
app.setCanvasFillMode(exporting ? FILLMODE_NONE : FILLMODE_FILL_WINDOW, 320, 200);
app.setCanvasResolution(exporting ? RESOLUTION_FIXED : RESOLUTION_AUTO, 320, 200);

const camera = new Entity('camera');
camera.addComponent('camera', { fov: 40, nearClip: 0.1, farClip: 50, clearColor: new Color(0, 0, 0) });
camera.setPosition(0, 2.6, 6);
camera.lookAt(0, 0.4, 0);
app.root.addChild(camera);

const { lights } = await (await fetch('../three/lights.json')).json();
const lamps = lights.map(({ position, radius, radiance }, i) => {
    const lamp = new SphereLight(`lamp ${i}`, { color: new Color(radiance), radius });
    lamp.radiance = 1;
    lamp.setPosition(...position);
    app.root.addChild(lamp);
    return lamp;
});

function add(geometry, color, metalness, roughness, position) {
    const look = matte ? { diffuse: new Color(1, 1, 1), gloss: 0 } : { diffuse: new Color().fromString(color), metalness, gloss: 1 - roughness };
    const material = Object.assign(new StandardMaterial(), { useMetalness: true, metalness: 0, ...look }), entity = new Entity();
    material.update();
    entity.addComponent('render', { meshInstances: [new MeshInstance(Mesh.fromGeometry(device, geometry), material)] });
    entity.setPosition(...position);
    app.root.addChild(entity);
}

add(new PlaneGeometry({ halfExtents: { x: 4.5, y: 4.5 } }), '#998877', 0, 0.7, [0, 0, 0]);
const ball = new SphereGeometry({ radius: 0.45, latitudeBands: 64, longitudeBands: 128 });
for (let i = 0; i < 8; i++)
    add(ball, i % 2 ? '#d0a050' : '#4060a0', i % 2, 0.3 + 0.1 * i, [1.2 * (i % 4) - 1.8, 0.45, i < 4 ? -0.8 : 0.8]);

const lmp = await load();
let lit; // what is updated every frame: lights, or probes
if (matte) {
    lit = new LightProbeVolume(lmp, app, { min: new Vec3(-4.5, -0.1, -4.5), max: new Vec3(4.5, 1.1, 4.5), size: [37, 7, 37] });
    lit.addScene(app);
} else {
    lit = new SphereLights(lmp, app, { bands: 16 });
}

async function exportImage() {
    const colorBuffer = new Texture(device, { width: 320, height: 200, format: PIXELFORMAT_RGBA32F, mipmaps: false });
    const renderTarget = new RenderTarget({ colorBuffer, depth: true });
    Object.assign(camera.camera, { renderTarget, gammaCorrection: GAMMA_NONE, toneMapping: TONEMAP_NONE });
    app.autoRender = false;
    app.start();
    const send = async (name) => {
        app.render();
        await fetch(name, { method: 'PUT', body: await colorBuffer.read(0, 0, 320, 200, { renderTarget }) });
    };
    await send('image.floats');
    lit.dispose();
    await send('disposed.floats');
}

if (exporting) {
    await exportImage();
} else {
    app.on('update', () => {
        lamps.forEach((lamp, i) => {
            const [x, y, z] = lights[i].position;
            lamp.setPosition(x, y + 0.2 * Math.sin(performance.now() / 700 + i), z);
        });
        lit.update();
    });
    app.start();
}
