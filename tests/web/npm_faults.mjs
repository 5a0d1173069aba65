// SPDX-License-Identifier: MIT
// npm_faults.mjs: the npm package, as installed beside it, given wrong arguments in node: an exception that names the
// fault, and an instance that works as before.
import assert from 'node:assert/strict';
import { LampionError, load } from 'lampion';
import { enums, functions, structs as layouts } from './node_modules/lampion/api.js';
import { conditions } from './node_modules/lampion/conditions.js';
import { extents, memberExtents } from './node_modules/lampion/extents.js';

const lmp = await load();
const floats = (count) => new Float32Array(count);
const sphere = { position: [0, 0, 3], radius: 1, radiance: [1, 2, 4] };
const rectangle = { kind: lmp.LIGHT_RECTANGLE, position: [0, 3, 0], half: [[0, 0, 1], [1, 0, 0]], radiance: [1, 1, 1] };
const surface = { position: [0, 0, 0], normal: [0, 0, 1], view: [0, 0, 1] };
const gloss = { kind: lmp.MATERIAL_METALLIC_ROUGHNESS, base_color: [1, 1, 1], roughness: 0.5 };
const irradiance = (light) => lmp.light_irradiance([light], 1, [0, 0, 0], [0, 0, 1]).g;
const isGood = () => assert.ok(Math.abs(irradiance(sphere) - 2 * Math.PI / 9) <= 1e-6); // π L sin²a

function refuse(wrong) {
    for (const [run, fault] of wrong)
        for (let i = 0; i < 20; i++)
            assert.throws(run, fault instanceof RegExp ? { message: fault } : fault, `${run}`);
    isGood();
}

// Every array that is passed has a length to be checked against.
{
    const numbers = [...Object.keys(enums), 'i8', 'u8', 'i16', 'u16', 'i32', 'u32', 'f32', 'f64'], described = ['vec3_array', 'float_array', 'sh_array', 'rgb_array'];
    const isArray = (type) => described.includes(type) || numbers.includes(type.to);
    for (const [name, { parameters }] of Object.entries(functions))
        for (const [i, [parameter, type, how]] of parameters.entries())
            if (how === 'given' && (isArray(type) || layouts[type.to] && /count$/.test(parameters[i + 1]?.[0])))
                assert.ok(extents[`${name}.${parameter}`] ?? extents[parameter], `${name}: nothing says how long ${parameter} is`);
    for (const [name, { members }] of Object.entries(layouts))
        if (!described.includes(name))
            for (const [member, type] of members.filter(([, type]) => isArray(type) || layouts[type.to]))
                assert.ok(memberExtents[name]?.[member], `lmp_${name}: nothing says how long ${member} is`);
}

// --- lengths and forms ---------------------------------------------------------------------------
{
    const sh = floats(9), wrong = [
        [() => lmp.sh_eval(3, [0, 0, 1], floats(8)), /sh has 8 values, and 9 are needed/],
        [() => lmp.sh_eval(0, [0, 0, 1], sh), /bands is 0/],
        [() => lmp.sh_eval(129, [0, 0, 1], floats(20000)), /bands is 129/],
        [() => lmp.sh_eval(2.5, [0, 0, 1], sh), /bands is 2.5/],
        [() => lmp.sh_eval('3', [0, 0, 1], sh), /bands is not a number/],
        [() => lmp.sh_eval(3, [0, 0], sh), /direction has 2 numbers, not 3/],
        [() => lmp.sh_eval(3, null, sh), /direction is null, not an object or 3 numbers/],
        [() => lmp.sh_eval(3, { x: 0, y: 0, w: 1 }, sh), /direction.w is not a member/],
        [() => lmp.sh_eval(3, [0, 0, 1], [0, 0, 0, 0, 0, 0, 0, 0, 0]), /sh is not a Float32Array/],
        [() => lmp.sh_eval(3, [0, 0, 1], null), /sh is missing/],
        [() => lmp.sh_eval(3, [0, 0, 1]), /takes 3 arguments, not 2/],
        [() => lmp.sh_eval(3, [0, 0, 1], new Float64Array(9)), /sh is not a Float32Array/],
        [() => lmp.sh_eval_n(3, floats(3), 2, floats(18)), /directions has 3 values, and 6 are needed/],
        [() => lmp.sh_eval_n(3, floats(6), 2, { at: floats(18), stride: 40 }), /sh.at has 18 values, and 19 are needed/],
        [() => lmp.sh_eval_n(3, floats(6), 2, { at: floats(18), stride: 3 }), /stride is not a multiple of 4/],
        [() => lmp.sh_eval_n(3, floats(6), -1, floats(18)), /count is -1/],
        [() => lmp.sh_project_latlong(3, { pixels: floats(24), width: 4, height: 2, channels: 3 }, sh), /sh has 9 values, and 27 are needed/],
        [() => lmp.sh_project_latlong(3, { pixels: floats(23), width: 4, height: 2, channels: 3 }, floats(27)), /pixels has 92 values, and 96 are needed/],
        [() => lmp.light_project(3, sphere, 2, [0, 0, 0], floats(27)), /lights has 1 elements, and 2 are needed/],
        [() => lmp.light_project(3, [sphere], 2, [0, 0, 0], floats(27)), /lights has 1 elements, and 2 are needed/],
        [() => lmp.light_project(3, [{ ...sphere, radius: 'big' }], 1, [0, 0, 0], floats(27)), /lights\[0\].radius is not a number/],
        [() => lmp.light_project(3, [{ radious: 1 }], 1, [0, 0, 0], floats(27)), /radious is not a member/],
        [() => lmp.light_project(3, [{ kind: lmp.LIGHT_SPHERES }], 1, [0, 0, 0], floats(27)), /kind is undefined/],
        [() => lmp.light_project(3, [{ radiance: '#fff' }], 1, [0, 0, 0], floats(27)), /radiance is "#fff", not an object or 3 numbers/],
        [() => lmp.sphere_sum_n(3, { center: floats(3), radius: floats(1) }, 2, null, floats(3), 1, floats(27)), /center has 3 values, and 6 are needed/],
        [() => lmp.field_update({}, [], 0), /field is not an lmp_field/],
        [() => lmp.shade(null, { kind: lmp.MATERIAL_TABLE, table: lmp.sh_product_create(2) }, { normal: [0, 0, 1], view: [0, 0, 1] }, [], 0), /table is not an lmp_brdf_table/],
        [() => lmp.structs('lamp', 1), /there is no struct lmp_lamp/],
        [() => lmp.structs('light', -1), /-1 is not a number of elements/],
        [() => lmp.structs('light', 1.5), /1.5 is not a number of elements/],
        [() => lmp.pack_volume(lmp.floats(0), -1, lmp.halves(0)), /pack_volume: -1 is not a number of elements/],
        [() => lmp.sh_project_function(2, 2 ** 32, () => 1, sh), /nodes not a count/],
        [() => lmp.free(floats(1)), /not of this instance's memory/],
        [() => lmp.free(lmp.floats(2).subarray(1)), /freed, or is a part/],
        [() => lmp.floats(1e9), LampionError],
        [() => lmp.floats(-1), /-1 is not a number of elements/],
        [() => lmp.floats('a'), /a is not a number of elements/],
        [() => lmp.field_create({ nodes: [500, 500, 500], bands: 8 }), LampionError],
    ];
    refuse(wrong);
    const all = lmp.floats(10 << 20); // of 16M floats: nothing of the above is kept
    lmp.free(all);
    assert.throws(() => lmp.free(all), /this array was freed/);
    await assert.rejects(load({ memory: 1 }), RangeError);
    await assert.rejects(load({ memori: 1 << 24 }), /no option memori/);
    await assert.rejects(load({ source: new Uint8Array(8) }), WebAssembly.CompileError);
}

// --- indices, constants and ranges ---------------------------------------------------------------
{
    const field = lmp.field_create({ bands: 3, nodes: [4, 4, 4], light_max: 4 }), texels = floats(108 * 64), sh = floats(27);
    lmp.field_update(field, [sphere, sphere], 2);
    const table = lmp.brdf_table_create({ bands: 3, views: 8 }, lmp.brdf_create_lambert([1, 1, 1])), weights = floats(128);
    const surfel = { albedo: [0.5, 0.5, 0.5], radius: 1, position: [0, 0, 0], normal: [0, 0, 1] };
    const transfer = lmp.transfer_create({ surfels: [surfel, surfel], surfel_count: 2, hits: [1, 0], ray_count: 1 });
    const polygon = (corner_count, corners) => ({ kind: lmp.LIGHT_POLYGON, corner_count, corner: [[-1, 0, 3], [1, 0, 3], [1, 1, 3], [-1, 1, 3]].slice(0, corners), two_sided: true, radiance: [1, 1, 1] });
    const shade = (settings, material = gloss) => lmp.shade(settings, material, surface, [sphere], 1);
    assert.ok(irradiance(polygon(4, 4)) > irradiance(polygon(3, 4)));
    assert.equal(irradiance({ kind: lmp.LIGHT_POINT, intensity: [0, 9, 0], position: [0, 0, 3], corner_count: 0 }), 1);
    refuse([
        [() => lmp.field_remove(field, 2), /field_remove: at is 2, and there are 2/],
        [() => lmp.field_remove(field, 7), /at is 7/],
        [() => lmp.field_remove(field, 2 ** 32), /at is 4294967296, not a count/],
        [() => lmp.field_move_n(field, [0, 2], [sphere, sphere], 2), /at\[1\] is 2, and there are 2/],
        [() => lmp.field_move_n(field, new Uint32Array([1e9]), [sphere], 1), /at\[0\] is 1000000000/],
        [() => lmp.field_move_n(field, [1, 1], [sphere, sphere], 2), /at names a light twice/],
        [() => lmp.field_move_n(field, [1], [rectangle], 1), /lights has an area/],
        [() => lmp.field_copy_nodes(field, 60, 5, texels), /first \+ count is 65, and there are 64/],
        [() => lmp.field_copy_nodes(field, 1e8, 1, texels), /first \+ count is 100000001/],
        [() => lmp.brdf_table_find_albedo(table, 8, 0), /view is 8, not 0 to 7/],
        [() => lmp.brdf_table_find_albedo(table, -1, 0), /view is -1/],
        [() => lmp.brdf_table_find_albedo(table, 0, 1), /azimuth is 1, not 0 to 0/],
        [() => lmp.transfer_irradiance(transfer, 2, [0, 0, 0], [0, 0, 1]), /surfel is 2, and there are 2/],
        [() => lmp.transfer_copy_irradiance_n(transfer, 1, 2, floats(6)), /first \+ count is 3/],
        [() => lmp.transfer_eval_probe_n(transfer, 0, 1, sh), /first \+ count is 1, and there are 0/],
        [() => shade({ method: lmp.SHADE_PREINTEGRATED }), /settings.lobe is missing/],
        [() => shade({ method: 77 }), /settings.method is 77, none of SHADE_ZONAL/],
        [() => shade({ window: 9 }), /settings.window is 9/],
        [() => shade({ bands: 129 }), /settings.bands is 129, not 1 to 128/],
        [() => shade({ bands: 2.5 }), /settings.bands is 2.5, not an integer/],
        [() => shade(null, { kind: lmp.MATERIAL_TABLE }), /material.table is missing/],
        [() => shade(null, { kind: lmp.MATERIAL_PREINTEGRATED }), /material.preintegrated is missing/],
        [() => shade(null, { kind: lmp.MATERIAL_TABLE, preintegrated: lmp.preintegrated_brdf_create(null, table) }), /table is missing, which this method reads/],
        [() => lmp.shade_n({ method: lmp.SHADE_PREINTEGRATED }, { position: floats(6), normal: floats(6), view: floats(6), material: [{ kind: lmp.MATERIAL_TABLE, table }, gloss], material_stride: lmp.structs('material', 0).size },
            2, [sphere], 1, floats(6)), /settings.lobe is missing/],
        [() => lmp.shade_n(null, { position: floats(3), normal: floats(3), view: floats(3), material: gloss, material_stride: 8 }, 1, [sphere], 1, floats(3)), /material_stride is 8, not 0 or/],
        [() => lmp.shade_n(null, { position: floats(6), normal: floats(6), view: floats(6), material: [gloss, gloss], material_stride: 184 }, 2, [sphere], 1, floats(6)), /material_stride is 184/],
        [() => lmp.shade_n(null, { normal: floats(3), view: floats(3), material: gloss }, 1, [sphere], 1, floats(3)), /surfaces.position is missing/],
        [() => lmp.shade_n(null, { position: floats(3), view: floats(3), material: gloss }, 1, [sphere], 1, floats(3)), /surfaces.normal is missing/],
        [() => lmp.shade_n(null, { position: floats(3), normal: floats(3), view: floats(3) }, 1, [sphere], 1, floats(3)), /surfaces.material is missing/],
        [() => lmp.shade_environment(null, gloss, surface, { sh, bands: 0 }), /environment.bands is 0, not 1 to 128/],
        [() => lmp.shade_environment(null, gloss, surface, { bands: 3 }), /environment.sh is missing/],
        [() => lmp.sh_make_window(3, 9, 3, weights), /sh_make_window: window is 9, none of WINDOW_NONE/],
        [() => lmp.sh_eval_n(3, floats(3), 1, { at: sh, layout: 2 }), /sh.layout is 2/],
        [() => lmp.sh_eval_n(3, null, 1, sh), /directions is missing/],
        [() => lmp.sphere_sum_n(3, { radius: [1], radiance: floats(3) }, 1, null, floats(3), 1, sh), /spheres.center is missing/],
        [() => lmp.sh_multiply_few(7, weights, weights, floats(49)), /bands is 7, not 1 to 6/],
        [() => lmp.probe_minimum(4, weights), /bands is 4, not 1 to 3/],
        [() => lmp.probe_make_constants(2, 1, weights), /bands is 2, not 3 to 128/],
        [() => lmp.probe_export(2, lmp.probe_engine_format(0), weights, sh), /bands is 2/],
        [() => lmp.probe_make_positive_window(33, floats(33 ** 2), 1, weights), /bands is 33, not 1 to 32/],
        [() => lmp.probe_make_positive_window(3, weights, 0, weights), /planes is 0/],
        [() => lmp.probe_engine_format(99), /engine is 99, none of PROBE_UNITY/],
        [() => lmp.probe_convert(3, { axes: [1, 2, 4] }, {}, weights, sh), /from.axes is 1,2,4/],
        [() => lmp.probe_convert(17, { axes: [1, 3, -2] }, {}, floats(289), floats(289)), /bands is 17, and axes that differ take at most 16/],
        [() => irradiance(polygon(9, 4)), /corner_count is 9, and 4 corners are given/],
        [() => irradiance(polygon(8, 4)), /corner_count is 8, and 4 corners are given/],
        [() => irradiance(polygon(0, 4)), /corner_count is 0/],
        [() => lmp.structs('light', 1).set(0, { corner_count: 9 }), /corner_count is 9, not 3 to 8/],
        [() => irradiance({ ...sphere, kind: 99 }), /lights\[0\].kind is 99, none of LIGHT_SPHERE/],
        [() => irradiance({ ...sphere, kind: 'sphere' }), /kind is "sphere", not a constant such as LIGHT_SPHERE/],
        [() => lmp.light_irradiance([sphere, , sphere], 3, [0, 0, 0], [0, 0, 1]), /lights\[1\] is undefined/], // eslint-disable-line no-sparse-arrays
        [() => lmp.light_find_cap(rectangle, [0, 0, 0]), /light is an area/],
        [() => lmp.light_project_zonal(3, rectangle, [0, 0, 0], weights), /light is an area/],
        [() => lmp.light_power_from_radiance(sphere, 1), /area is not an area/],
        [() => lmp.light_copy_area_texels(sphere, floats(44)), /area is not an area/],
        [() => lmp.sh_project_latlong(3, { pixels: sh, width: 0, height: 2, channels: 1 }, sh), /image.width is 0/],
        [() => lmp.sh_project_latlong(3, { pixels: sh, width: -4, height: -2, channels: 1 }, sh), /image.width is -4/],
        [() => lmp.sh_project_latlong(3, { pixels: sh, width: 4, height: 2, channels: 1, texel: 5 }, sh), /image.texel is 5/],
        [() => lmp.sh_project_cubemap(3, { faces: [sh], size: 1, channels: 1 }, sh), /faces is not an array of six/],
        [() => lmp.sh_rotate(3, floats(35), sh, floats(27)), /only 9 would be turned: sh_rotate_n/],
        [() => lmp.sh_make_rotation(3, ['0', 0, 0, 1], floats(35)), /rotation\[0\] is not a number/],
        [() => lmp.lobe_project(3, [1, '2', 3], [0, 0, 1], sh), /lambda\[1\] is not a number/],
        [() => lmp.structs('light', 1).array('kind'), /kind is neither a float nor a vector/],
    ]);
    assert.equal(lmp.field_describe(field).light_count, 2);
    lmp.field_remove(field, 1);
    assert.equal(lmp.field_describe(field).light_count, 1);

    // members of three's quaternions that are its own
    const matrices = floats(35), same = floats(35), quaternion = Object.create({ x: 0, y: 0, z: 0.6, w: 0.8 });
    lmp.sh_make_rotation(3, Object.assign(quaternion, { isQuaternion: true, _x: 0, _onChangeCallback() {} }), matrices);
    lmp.sh_make_rotation(3, [0, 0, 0.6, 0.8], same);
    assert.deepEqual(matrices, same);
}

// Every integer that is passed is a count, which a length depends on, or has a condition; C itself looks at the others.
{
    const integers = ['i32', 'u32'], own = ['brdf_sgd_name.index', 'cpu_limit.mask', 'brdf_project.rings', 'sh_dot_n.stride'];
    for (const [name, { parameters }] of Object.entries(functions))
        for (const [parameter, type, how] of parameters)
            if (how === 'given' && integers.includes(type) && !/^(bands|capacity|size|\w*count)$/.test(parameter))
                assert.ok(conditions[name] || own.includes(`${name}.${parameter}`), `${name}: nothing checks ${parameter}`);
    let members = 0;
    for (const [type, layout] of Object.entries(layouts).filter(([type]) => type !== 'sh_array'))
        for (const [member, of, , range] of layout.members) {
            const most = enums[of]?.length - 1 || range?.[1], one = lmp.structs(type, 1);
            if (most && (enums[of] || integers.includes(of))) {
                one.set(0, { [member]: most });
                assert.throws(() => one.set(0, { [member]: most + 1 }), RangeError, `${type}.${member}`);
                assert.throws(() => one.set(0, { [member]: 1.5 }), RangeError);
                members++;
            }
            one.free();
        }
    assert.ok(members >= 25, `${members} members with a range`);
}

// --- what C refuses, in words --------------------------------------------------------------------
{
    const field = lmp.field_create({ bands: 3, nodes: [4, 4, 4], light_max: 1 });
    refuse([
        [() => lmp.field_create({ bands: 100 }), /field_create: desc.bands is 100, not 1 to 10/],
        [() => lmp.field_create({ nodes: [4, 1, 4] }), /desc.nodes\[1\] is 1, not 2 to 1024/],
        [() => lmp.field_create({ error: 7 }), /desc.error is 7, not 0.00001 to 1|desc.error is 7, not 1e-5 to 1/],
        [() => lmp.field_update(field, [sphere, sphere], 2), /field_update: there are more than light_max lights, or one is an area/],
        [() => lmp.field_reset(field, [rectangle], 1), /field_reset: there are more than light_max lights, or one is an area/],
        [() => lmp.brdf_find_sgd('golden'), /brdf_find_sgd: there is no material "golden"/],
        [() => lmp.brdf_create_ggx({ alpha_x: 0 }), /brdf_create_ggx: ggx.alpha_x is 0, not 0.001 to 1/],
        [() => lmp.brdf_create_ggx({ alpha_x: 0.5, f0: [0, 2, 0] }), /ggx.f0\[1\] is 2, not 0 to 1/],
        [() => lmp.brdf_create_lambert([0, NaN, 0]), /albedo\[1\] is NaN/],
        [() => lmp.field_add(field, rectangle), (error) => error instanceof LampionError && error.code === lmp.ERROR_ARGUMENT && /light_max are there, or it is an area/.test(error.message)],
    ]);
}

// --- callbacks: their exceptions leave nothing behind --------------------------------------------
{
    const sh = floats(108);
    for (let i = 0; i < 10000; i++)
        assert.throws(() => lmp.sh_project_function(6, 0, () => { throw new Error('mine'); }, sh), /mine/);
    lmp.sh_project_function(6, 0, () => 1, sh);
    assert.ok(Math.abs(sh[0] - 2 * Math.sqrt(Math.PI)) <= 1e-5);
    refuse([
        [() => lmp.sh_project_function(3, 0, () => {}, sh), /sh_project_function: the function returned undefined, not a number/],
        [() => lmp.sh_project_function_rgb(3, 0, () => 1, sh), /the function returned 1, not a color/],
        [() => lmp.sh_project_function_rgb(3, 0, () => [1, 2], sh), /not a color/],
    ]);
}

// --- memory that was given back ------------------------------------------------------------------
{
    const a = lmp.floats(27), b = lmp.floats(27), other = await load({ memory: 4 << 20 }), structs = lmp.structs('light', 2);
    structs.set(0, sphere);
    refuse([
        [() => lmp.free(a.subarray(3)), /freed, or is a part/],
        [() => lmp.free(a.subarray(0, 9)), /freed, or is a part/],
        [() => other.free(a), /not of this instance's memory/],
        [() => other.free(structs), /not of this instance's memory/],
    ]);
    lmp.free(a);
    structs.free();
    const table = lmp.brdf_table_create({ bands: 3, views: 8 }, lmp.brdf_create_lambert([1, 1, 1])), coefficients = lmp.brdf_table_coefficients(table);
    assert.ok(lmp.sh_dot(2, coefficients, coefficients) > 0);
    lmp.brdf_table_destroy(table);
    refuse([
        [() => lmp.light_project(3, [sphere], 1, [0, 0, 0], a), /light_project: sh was freed/],
        [() => lmp.sh_eval(3, [0, 0, 1], a.subarray(9)), /sh was freed/],
        [() => lmp.sh_project_function(3, 0, () => 1, a), /sh was freed/],
        [() => lmp.pack_volume(a, 1, lmp.halves(28)), /sh was freed/],
        [() => lmp.free(a), /freed, or is a part/],
        [() => lmp.light_irradiance(structs, 1, [0, 0, 0], [0, 0, 1]), /lights was freed/],
        [() => structs.set(0, sphere), /these structs were freed/],
        [() => structs.array('radius'), /these structs were freed/],
        [() => structs.free(), /these structs were freed/],
        [() => lmp.free(structs), /these structs were freed/],
        [() => lmp.sh_dot(2, coefficients, coefficients), /was freed/],
    ]);
    lmp.light_project(3, [sphere], 1, [0, 0, 0], b); // what is left is whole
    const some = Array.from({ length: 1000 }, (none, i) => lmp.floats(i % 7));
    some.forEach((array) => lmp.sh_pack_half_n(array, array.length, new Uint16Array(7)));
    some.reverse().forEach((array) => lmp.free(array));
    lmp.free(b);
}

// --- options of load() ---------------------------------------------------------------------------
await assert.rejects(load(null), /load takes options, such as \{ memory \}, not null/);
await assert.rejects(load({ source: 'nope.wasm' }), /source is "nope.wasm", neither an address nor a module/);
await assert.rejects(load({ source: 7 }), /source is 7/);
await assert.rejects(load({ simd: 'yes' }), /simd is "yes"/);
await assert.rejects(load({ memory: '64MB' }), RangeError);

// --- three.js ------------------------------------------------------------------------------------
{
    const three = await import('three'), { LightProbeVolume, SphereLight, SphereLights, SplatLights, lightProbe } = await import('lampion/three');
    const { SphereTexels } = await import('./node_modules/lampion/glsl.js'), webgpu = await import('lampion/three-webgpu');
    const scene = new three.Scene(), lamp = new SphereLight(0xff8000, 2, 0.2), ball = new three.Mesh(new three.SphereGeometry(), new three.MeshStandardMaterial());
    const matte = new three.MeshLambertMaterial(), box = new three.Box3(new three.Vector3(), new three.Vector3(1, 1, 1));
    scene.add(lamp, ball, new three.Mesh(ball.geometry, matte));
    const lights = new SphereLights(lmp, scene), volume = new LightProbeVolume(lmp, box, [2, 2, 2]), splats = new SplatLights(lmp);
    lamp.position.set(0, 0, 1);
    lights.update();
    const [before] = lights.spheres.radiance;
    const withLamp = (members) => () => {
        const { intensity, radius } = lamp, { x } = lamp.position;
        Object.assign(lamp, members);
        lamp.position.x = members.x ?? x;
        try {
            lights.update();
        } finally {
            Object.assign(lamp, { intensity, radius });
            lamp.position.x = x;
        }
    };
    const placed = { positions: floats(6), albedo: floats(6) }, where = new RegExp(`SphereLight ${lamp.uuid}`);
    refuse([
        [withLamp({ intensity: NaN }), where],
        [withLamp({ intensity: NaN }), /its intensity is NaN, not a number/],
        [withLamp({ intensity: '3' }), /its intensity is "3", not a number/],
        [withLamp({ radius: '0.2' }), /its radius is "0.2", not above 0/],
        [withLamp({ radius: 0 }), /its radius is 0, not above 0; 0.01 stands for a point/],
        [withLamp({ radius: Infinity }), /its radius is Infinity/],
        [withLamp({ x: NaN }), /its position is NaN/],
        [() => new SphereLight({ color: 0xffffff, radius: 0.1 }), /takes a color, an intensity and a radius, not an object/],
        [() => new SphereLights(lmp, scene, { band: 8 }), /SphereLights: there is no option band, only bands/],
        [() => new SphereLights(lmp, scene, 8), /SphereLights takes options, such as \{ bands \}, not 8/],
        [() => new SphereLights(lmp, lmp), /is not a scene/],
        [() => new webgpu.SphereLights(lmp, scene, { most: 0 }), /most is 0, not a number of lights/],
        [() => new webgpu.SphereLights(lmp, scene, { bands: 33 }), /bands is 33, not 1 to 32/],
        [() => new webgpu.SphereLights(lmp, scene, { max: 3 }), /no option max, only bands, most/],
        [() => new LightProbeVolume(lmp, { min: [0, 0, 0], max: [1, 1, 1] }, [2, 2, 2]), /is not a Box3/],
        [() => new LightProbeVolume(lmp, box, new three.Vector3(2, 2, 2)), /size is {"x":2,"y":2,"z":2}, not three counts/],
        [() => new LightProbeVolume(lmp, box, [2, 2, 2], { worker: true }), /worker is true, not a Worker/],
        [() => new LightProbeVolume(lmp, box, [2, 2, 2], { workers: 1 }), /no option workers/],
        [() => volume.add(matte), /MeshLambertMaterial .* cannot be lit; only a MeshStandardMaterial or a MeshPhysicalMaterial can/],
        [() => volume.add(ball), /Mesh .* cannot be lit/],
        [() => volume.add(), /undefined cannot be lit/],
        [() => volume.add(ball.material), new RegExp(`MeshStandardMaterial ${ball.material.uuid} is already lit`)],
        [() => new LightProbeVolume(lmp, box, [80, 80, 80]), LampionError],
        [() => lightProbe(lmp, undefined), /undefined is not a scene/],
        [() => splats.light(scene, placed, floats(3)), /f_dc is not a Float32Array of three numbers per splat/],
        [() => splats.light(scene, { ...placed, albedo: floats(3) }, floats(6)), /albedo is not/],
        [() => splats.light(scene, { ...placed, normals: floats(3) }, floats(6)), /normals is not/],
        [() => splats.light(scene, { positions: floats(6), albedos: floats(6) }, floats(6)), /no option albedos/],
        [() => splats.rotate([0, 0, 0, 1], 3, floats(24)), /Array is not a Quaternion/],
        [() => splats.rotate(new three.Quaternion(), 1, floats(24)), /bands is 1, not 2 or more/],
        [() => new SphereTexels().write({ count: 2 ** 20 + 1 }), /1048577 lights, more than 1048576/],
    ]);
    new LightProbeVolume(lmp, box, [40, 40, 40]).dispose(); // what did not fit took nothing
    const late = new LightProbeVolume(lmp, box, [2, 2, 2]);
    late.dispose();
    late.receive({ halves: new Uint16Array(224) }); // a worker's answer that nobody waits for
    lights.update();
    assert.equal(lights.spheres.radiance[0], before);
    const { object } = lamp.toJSON();
    assert.deepEqual([object.type, object.color, object.intensity, object.radius], ['SphereLight', 0xff8000, 2, 0.2]);
    volume.addScene(new three.Scene().add(new three.Mesh(ball.geometry, matte))); // not lit, and no fault
}
