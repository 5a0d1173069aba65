// SPDX-License-Identifier: MIT
// npm.ts: what the npm package's types allow and refuse; compiled, not run.
import { Box3, LightProbe, Material, MeshStandardMaterial, Quaternion, Scene } from 'three';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Scene as BabylonScene } from '@babylonjs/core/scene.js';
import { AppBase, Entity, Vec3 } from 'playcanvas';
import { LampionError, compileLampion, load } from 'lampion';
import type { Light, Surfaces } from 'lampion';
import { LightProbeVolume as BabylonVolume, SphereLight as BabylonLight, SphereLights as BabylonLights } from 'lampion/babylon';
import { LightProbeVolume as PlayCanvasVolume, SphereLight as PlayCanvasLight, SphereLights as PlayCanvasLights } from 'lampion/playcanvas';
import { ProbeGrid } from 'lampion/probes';
import { LightProbeVolume as NodeVolume, SphereLights as NodeLights } from 'lampion/three-webgpu';
import { lampion } from 'lampion/shaders';
import { lampionWgsl } from 'lampion/wgsl';
import { LightProbeVolume, SphereLight, SphereLights, SplatLights, lightProbe } from 'lampion/three';

const lmp = await load({ memory: 1 << 24 });
const sh: Float32Array = lmp.floats(27);
const lamp: Light = { kind: lmp.LIGHT_SPHERE, position: [0, 3, 0], radius: 0.5, radiance: [10, 8, 5] };
lmp.light_project(3, [lamp], 1, [0, 0, 0], sh);
const { r, g, b } = lmp.probe_irradiance(3, sh, [0, 1, 0]);
const total: number = r + g + b;
const cap = lmp.light_find_cap(lamp, { x: 0, y: 0, z: 0 });
const one: number = cap.one_minus_cos;
const field = lmp.field_create({ nodes: [2, 2, 2], bands: 3 });
lmp.field_update(field, [lamp], 1);
lmp.field_destroy(field);
const surfaces: Surfaces = { position: sh, normal: sh, view: sh, material: { diffuse: [1, 1, 1] } };
lmp.shade_n(null, surfaces, 1, [lamp], 1, sh);
const lights = lmp.structs('light', 2);
lights.set(0, lamp);
const { radius = 0 } = lights.get(0), glow0: number = radius + lights.array('radius').at[0];
// @ts-expect-error no such member
lights.set(0, { radious: glow0 });
// @ts-expect-error no such struct
lmp.structs('lights', 2);
lmp.light_project_n(3, lights, 2, null, { x: sh, y: sh, z: sh, stride: 12 }, 1, { at: sh, layout: lmp.SH_PLANAR });
const [whole, series] = lmp.brdf_table_find_albedo(lmp.brdf_table_create(null, lmp.brdf_create_lambert([1, 1, 1])), 0, 0);
const found = lmp.probe_recognize(3, 1e-3, sh, sh);
const sign: number | undefined = found?.sign;
lmp.sh_project_function(3, 0, ([x, y, z]) => x * y + z, sh);
// @ts-expect-error a wrong name
lmp.light_project(3, [{ radious: 1 }], 1, [0, 0, 0], sh);
// @ts-expect-error too few arguments
lmp.sh_eval(3, [0, 0, 1]);
// @ts-expect-error an object of another kind
lmp.field_update(lmp.sh_product_create(3), [lamp], 1);
try { await compileLampion(); } catch (error) { if (error instanceof LampionError) console.log(error.code, total, one, whole.r, series.g, sign); }

const parts: Light = { kind: lmp.LIGHT_RECTANGLE, half: [{ x: 1, y: 0, z: 0 }, [0, 0, 1]] };
lmp.field_create({ bands: 3 })[Symbol.dispose]();
const values: number = lmp.SH_COUNT(3) + (parts.half?.length ?? 0), source: string = lampion;

const scene = new Scene(), glow = new SphereLight(0xffffff, 1, 0.1);
scene.add(glow);
const lit = new SphereLights(lmp, scene, { bands: 5 });
lit.update();
const volume = new LightProbeVolume(lmp, new Box3(), [2, 2, 2], { worker: new Worker('x') });
const material: MeshStandardMaterial = volume.add(new MeshStandardMaterial());
const probe: LightProbe = lightProbe(lmp, scene);
new SplatLights(lmp).rotate(new Quaternion(), 3, new Float32Array(24));
new ProbeGrid(lmp, { min: [0, 0, 0], max: [1, 1, 1], size: [2, 2, 2] }).light({ center: lmp.floats(3), radius: lmp.floats(1), radiance: lmp.floats(3) }, 1);
console.log(material, probe);
const text: string = lampionWgsl({ bands: 3, window: 'hanning', ggx: true });
// @ts-expect-error no such window
lampionWgsl({ bands: 3, window: 'hann' }).includes(text);
new NodeLights(lmp, scene, { bands: 5, most: 10 }).update();
new NodeVolume(lmp, new Box3(), [2, 2, 2]).add(new Material());
// @ts-expect-error a material that is not lit
volume.add(new Material());

const area: { min: Vector3, max: Vector3, size: [number, number, number] } = { min: new Vector3(0, 0, 0), max: new Vector3(1, 1, 1), size: [2, 2, 2] };
const bulb = new BabylonLight('bulb', new BabylonScene(), { radius: 0.2 });
bulb.radiance = 2 * bulb.intensity;
new BabylonLights(lmp, new BabylonScene(), { bands: 5 }).update();
new BabylonVolume(lmp, new BabylonScene(), area).addScene(new BabylonScene());
// @ts-expect-error a scene's place is an application's
new PlayCanvasLights(lmp).update();
const globe: Entity = new PlayCanvasLight('globe', { intensity: 3 });
new PlayCanvasVolume(lmp, new AppBase(), { ...area, min: new Vec3(0, 0, 0), max: new Vec3(1, 1, 1) }).update();
console.log(globe);
