// SPDX-License-Identifier: MIT
// npm.mjs: the npm package, as installed beside it, in node: values from definitions, every function called, arguments
// in every form. Wrong ones are npm_faults.mjs's.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { LampionError, compileLampion, load } from 'lampion';
import { lampion as glsl } from 'lampion/shaders';
import { lampionWgsl } from 'lampion/wgsl';
import { functions } from './node_modules/lampion/api.js';

const close = (value, expected, bound, what) => assert.ok(Math.abs(value - expected) <= bound, `${what}: ${value}, not ${expected}`);
const alike = (values, expected, what) => expected.forEach((one, i) => close(values[i], one, 1e-6, what));
const made = await load();
const called = new Set();
const lmp = new Proxy(made, {
    get(all, name) {
        if (functions[name] || name.startsWith?.('sh_project_f') || name.startsWith?.('brdf_encode'))
            called.add(name);
        return all[name];
    },
});
const floats = (count) => new Float32Array(count);
const vector = ({ x, y, z }) => [x, y, z];
const colors = ({ r, g, b }) => [r, g, b];
const sphere = { position: [0, 0, 3], radius: 1, radiance: [1, 2, 4] };

// --- harmonics -----------------------------------------------------------------------------------
{
    const d = [0.48, -0.6, 0.64], sh = floats(9), more = floats(9), gradient = floats(27);
    lmp.sh_eval(3, d, sh);
    close(sh[0], Math.sqrt(1 / (4 * Math.PI)), 1e-7, 'Y_00');
    close(sh[1], -Math.sqrt(3 / (4 * Math.PI)) * d[1], 1e-7, 'Y_1-1');
    close(sh[4], Math.sqrt(15 / (4 * Math.PI)) * d[0] * d[1], 1e-7, 'Y_2-2');
    lmp.sh_eval_gradient(3, d, more, gradient);
    more.forEach((value, i) => close(value, sh[i], 1e-6, 'a value beside its gradient'));
    for (let i = 0; i < 9; i++)
        close(d[0] * gradient[i] + d[1] * gradient[9 + i] + d[2] * gradient[18 + i], 0, 1e-6, 'a gradient across the sphere');
    lmp.sh_combine(3, 2, sh, -1, sh, more);
    assert.deepEqual(more, sh);
    close(lmp.sh_dot(3, sh, sh), 9 / (4 * Math.PI), 1e-6, 'Σ Y²');
    close(lmp.sh_reconstruct(3, sh, d), 9 / (4 * Math.PI), 1e-6, 'Σ Y² by reconstruction');
    lmp.sh_expand_zonal(3, [1, 0, 0], d, more);
    assert.deepEqual([...more.subarray(1)].map(Math.abs), Array(8).fill(0));
    const matrices = floats(35), quat = [0, 0, Math.SQRT1_2, Math.SQRT1_2], turned = floats(9), turned2 = floats(9), matrix = [0, -1, 0, 1, 0, 0, 0, 0, 1];
    lmp.sh_make_rotation(3, quat, matrices);
    lmp.sh_rotate(3, matrices, sh, turned);
    lmp.sh_eval(3, [0.6, 0.48, 0.64], more);
    turned.forEach((value, i) => close(value, more[i], 1e-6, 'a rotation'));
    lmp.sh_make_rotation_from_matrix(3, matrix, matrices);
    lmp.sh_rotate_by_matrix(3, matrix, sh, turned2);
    turned2.forEach((value, i) => close(value, more[i], 1e-6, 'a rotation by a matrix'));
    lmp.sh_rotate_z(3, Math.PI / 2, sh, turned2);
    turned2.forEach((value, i) => close(value, more[i], 1e-6, 'a rotation around z'));
    const three = new Float32Array([...sh, ...more, ...sh]), out = floats(27);
    lmp.sh_rotate_n(3, matrices, three, 3, out);
    out.subarray(18).forEach((value, i) => close(value, more[i], 1e-6, 'many rotations'));
    assert.equal(lmp.sh_window_name(lmp.WINDOW_HANNING), 'hanning');
    assert.equal(lmp.sh_window_name(lmp.WINDOW_COUNT), null);
    const weights = floats(3);
    lmp.sh_make_window(3, lmp.WINDOW_HANNING, 0, weights);
    close(weights[1], (1 + Math.cos(Math.PI / 3)) / 2, 1e-7, 'Hanning');
    lmp.sh_make_laplacian_window(3, 0.5, sh, weights);
    assert.equal(weights[0], 1);
    assert.ok(weights[2] < weights[1] && weights[1] < 1);
    lmp.sh_apply_window(3, [1, 0.5, 0], sh, more);
    [sh[1] / 2, sh[2] / 2, sh[3] / 2, 0].forEach((value, i) => close(more[1 + i], value, 1e-7, 'a window'));
    let calls = 0;
    lmp.sh_project_function(3, 0, ([x, y, z]) => {
        calls++;
        made.sh_eval(3, [x, y, z], more); // a call within a call
        return more[6];
    }, turned);
    assert.equal(calls, 18);
    turned.forEach((value, i) => close(value, i === 6 ? 1 : 0, 1e-6, 'a projected function'));
    lmp.sh_project_function_rgb(2, 4, ([, , z]) => ({ r: 1, g: z, b: 0 }), out);
    close(out[0], 2 * Math.sqrt(Math.PI), 1e-5, 'a projected color');
    close(out[4 + 2], Math.sqrt(4 * Math.PI / 3), 1e-5, 'its green');
    assert.throws(() => lmp.sh_project_function(3, 0, () => { throw new Error('mine'); }, turned), /mine/);
    const pixels = floats(32 * 64).fill(2);
    lmp.sh_project_latlong(3, { pixels, width: 64, height: 32, channels: 1 }, sh);
    close(sh[0], 4 * Math.sqrt(Math.PI), 1e-4, 'a gray panorama');
    const face = floats(16 * 16).fill(2);
    lmp.sh_project_cubemap(3, { faces: Array(6).fill(face), size: 16, channels: 1 }, sh);
    close(sh[0], 4 * Math.sqrt(Math.PI), 1e-4, 'a gray cube map');
    lmp.sh_multiply_few(3, sh, sh, more);
    close(more[0], 8 * Math.sqrt(Math.PI), 1e-3, 'a product');
    const product = lmp.sh_product_create(3);
    lmp.sh_multiply(product, sh, sh, out);
    close(out[0], more[0], 1e-4, 'a product by a grid');
    lmp.sh_product_destroy(product);
    assert.throws(() => lmp.sh_multiply(product, sh, sh, out), /destroyed/);

    const directions = new Float32Array([...d, 0, 0, 1]), both = floats(18), planar = floats(18), slopes = floats(54);
    lmp.sh_eval_n(3, directions, 2, both);
    lmp.sh_eval(3, d, more);
    alike(both.subarray(0, 9), more, 'many directions');
    lmp.sh_eval_n(3, directions, 2, { at: planar, layout: lmp.SH_PLANAR });
    for (let i = 0; i < 9; i++)
        alike([planar[2 * i], planar[2 * i + 1]], [both[i], both[9 + i]], 'planes');
    lmp.sh_eval_gradient_n(3, directions, 2, both, slopes);
    slopes.subarray(0, 27).forEach((value, i) => close(value, gradient[i], 1e-6, 'many gradients'));
    lmp.sh_dot_n(3, lmp.SH_INTERLEAVED, 0, both, both, 2, out);
    close(out[1], 9 / (4 * Math.PI), 1e-6, 'many products');
    const halves = new Uint16Array(9), back = floats(9);
    lmp.sh_pack_half_n(more, 9, halves);
    lmp.sh_unpack_half_n(halves, 9, back);
    back.forEach((value, i) => close(value, more[i], 1e-3, 'halves'));

    const wide = new Float64Array(9), slope = new Float64Array(27), hessian = new Float64Array(54);
    lmp.sh_eval_double(3, d, wide);
    wide.forEach((value, i) => close(value, more[i], 1e-6, 'in double'));
    lmp.sh_eval_gradient_double(3, d, wide, slope);
    lmp.sh_eval_gradient_double(3, d, wide, null);
    lmp.sh_eval_hessian_double(3, d, hessian);
    close(hessian[6] + hessian[27 + 6] + hessian[45 + 6], -6 * wide[6], 1e-9, 'the trace of a Hessian');
    const wideMatrices = new Float64Array(35), wideTurned = new Float64Array(9);
    lmp.sh_make_rotation_double(3, quat, wideMatrices);
    lmp.sh_rotate_double(3, wideMatrices, wide, wideTurned);
    close(wideTurned[1], -Math.sqrt(3 / (4 * Math.PI)) * 0.48, 1e-12, 'a rotation in double');
}

// --- spheres and lights --------------------------------------------------------------------------
{
    const zonal = floats(4), sh = floats(16), rgb = floats(48), more = floats(48);
    lmp.sphere_project_zonal(4, 1, 2, zonal);
    close(zonal[0], Math.sqrt(Math.PI) * (1 - Math.sqrt(3) / 2), 1e-6, 'Z_0'); // √(π) (1 - cos a)
    close(zonal[1], Math.sqrt(3 * Math.PI) / 2 / 4, 1e-6, 'Z_1');
    lmp.sphere_project(4, [0, 0, 2], 1, [0, 0, 0], sh);
    for (let l = 0; l < 4; l++)
        close(sh[l * l + l], zonal[l], 1e-6, 'a sphere on the axis');
    const wide = new Float64Array(16), gradient = floats(48);
    lmp.sphere_project_double(4, [0, 0, 2], 1, [0, 0, 0], wide);
    close(wide[2], Math.sqrt(3 * Math.PI) / 8, 1e-14, 'a sphere in double');
    lmp.sphere_project_gradient(4, [0, 0, 2], 1, [0, 0, 0], sh, gradient);
    close(gradient[32 + 2], Math.sqrt(3 * Math.PI) / 2 * 0.25, 1e-6, 'dZ_1/dz'); // of r²/d² at d = 2
    lmp.sphere_project_zonal_n(4, [1, 1], [2, 2], 2, more);
    close(more[5], zonal[1], 1e-6, 'many zonal');
    lmp.sphere_project_zonal_n(4, { at: floats(1).fill(1), stride: 0 }, [2, 2], 2, more);
    close(more[5], zonal[1], 1e-6, 'a stride of 0');

    const spheres = { center: new Float32Array([0, 0, 2, 0, 2, 0]), radius: [1, 0.5], radiance: new Float32Array([1, 0, 0, 0, 1, 0]) };
    const points = new Float32Array([0, 0, 0, 1, 0, 0]);
    lmp.sphere_project_n(4, spheres, points, 2, more);
    close(more[2], zonal[1], 1e-6, 'many spheres');
    const all = floats(64);
    lmp.sphere_project_all_n(4, spheres, 2, points, 2, all);
    alike(all.subarray(0, 16), more.subarray(0, 16), 'all spheres');
    const sums = floats(96), again = floats(96), slopes = floats(288);
    lmp.sphere_sum_n(4, spheres, 2, null, points, 2, sums);
    close(sums[2], zonal[1], 1e-6, 'red of a sum');
    lmp.sphere_sum_n(4, spheres, 2, floats(4).fill(1), points, 2, again);
    assert.deepEqual(again, sums);
    lmp.sphere_sum_gradient_n(4, spheres, 2, points, 2, again, slopes);
    close(slopes[96 + 2], gradient[32 + 2], 1e-5, 'the gradient of a sum');
    const separate = { x: floats(2), y: floats(2), z: floats(2), stride: 4 };
    separate.x[1] = 1;
    lmp.sphere_sum_n(4, spheres, 2, null, separate, 2, again);
    assert.deepEqual(again, sums);
    // in Lampion's memory, strided
    const at = made.floats(16), result = made.floats(100);
    at.set([0, 0, 0, 9, 1, 0, 0, 9]);
    lmp.sphere_sum_n(4, spheres, 2, null, { x: at.subarray(0), y: at.subarray(1), z: at.subarray(2), stride: 16 }, 2, { at: result, stride: 200 });
    assert.deepEqual(result.slice(50, 98), sums.slice(48));
    made.free(at);
    made.free(result);

    for (const [from, to] of [['power', 4 * Math.PI ** 2 * 0.25], ['intensity', Math.PI * 0.25]]) {
        close(lmp[`sphere_${from}_from_radiance`](2, 0.5), 2 * to, 1e-5, from);
        close(lmp[`sphere_radiance_from_${from}`](2 * to, 0.5), 2, 1e-5, from);
    }
    const cap = lmp.light_find_cap(sphere, [0, 0, 0]);
    close(cap.sin2, 1 / 9, 1e-7, 'sin²a');
    assert.deepEqual(vector(cap.axis), [0, 0, 1]);
    const axis = lmp.light_project_zonal(4, sphere, [0, 0, 1], zonal);
    assert.deepEqual(vector(axis), [0, 0, 1]);
    close(zonal[1], Math.sqrt(3 * Math.PI) / 8, 1e-6, 'the zonal coefficients of a light');
    lmp.light_project(4, [sphere], 1, [0, 0, 1], rgb);
    close(rgb[32 + 2], 4 * zonal[1], 1e-5, 'blue of a light');
    lmp.light_project_gradient(4, sphere, [0, 0, 1], sh, gradient);
    close(gradient[32 + 2], Math.sqrt(3 * Math.PI) / 8, 1e-5, 'the gradient of a light');
    lmp.light_project_channels(4, [sphere], 1, [0, 0, 1], null, null, sh);
    alike(sh, rgb.subarray(32), 'a channel');
    close(lmp.light_irradiance([sphere], 1, [0, 0, 0], [0, 0, 1]).g, 2 * Math.PI / 9, 1e-6, 'irradiance');
    const kinds = [sphere, { kind: lmp.LIGHT_DIRECTIONAL, direction: [0, 1, 0], irradiance: [1, 1, 1] }];
    lmp.light_project_n(4, kinds, 2, null, points, 2, sums);
    const structs = made.structs('light', 2);
    kinds.forEach((light, i) => structs.set(i, light));
    lmp.light_project_n(4, structs, 2, null, points, 2, again);
    assert.deepEqual(again, sums);
    assert.deepEqual(colors(structs.get(0).radiance), [1, 2, 4]);
    structs.array('radiance').x[0] = 5;
    assert.equal(structs.get(0).radiance.r, 5);
    assert.throws(() => structs.get(2), RangeError);
    lmp.light_add_n(4, [{ ...sphere, radiance: [-1, -2, -4] }], 1, null, points, 2, again);
    lmp.light_project_n(4, kinds.slice(1), 1, null, points, 2, sums);
    again.forEach((value, i) => close(value, sums[i], 1e-6, 'a light taken away'));
    structs.free();
    assert.throws(() => lmp.light_project_n(4, structs, 2, null, points, 2, sums), /lights was freed/);
    close(lmp.light_range({ ...sphere, radiance: [1, 1, 1] }, Math.PI / 100), 10, 1e-3, 'a range');
    const panel = { kind: lmp.LIGHT_RECTANGLE, half: [[1, 0, 0], [0, 2, 0]], radiance: [1, 1, 1] }, texels = floats(44);
    lmp.light_copy_area_texels(panel, texels);
    assert.ok(texels.some(Boolean));
    close(lmp.light_power_from_radiance(panel, 1), 8 * Math.PI, 1e-4, 'the power of a panel');
    close(lmp.light_radiance_from_power(panel, 8 * Math.PI), 1, 1e-6, 'the radiance of a panel');
    close(lmp.light_intensity_from_radiance(panel, 1), 8, 1e-5, 'the intensity of a panel');
    close(lmp.light_radiance_from_intensity(panel, 8), 1, 1e-6, 'its radiance');
    close(lmp.light_cap_irradiance_from_radiance(1, Math.PI / 6), Math.PI / 4, 1e-6, 'a cap');
    close(lmp.light_cap_radiance_from_irradiance(Math.PI / 4, Math.PI / 6), 1, 1e-6, 'its radiance');
}

// --- lobes, materials, shading -------------------------------------------------------------------
{
    const lambda = floats(3), rgb = floats(6), up = [0, 0, 1];
    lmp.lobe_make_diffuse(3, lambda);
    close(lambda[0], Math.PI, 1e-6, 'the cosine');
    lmp.lobe_make_vmf(3, 2, lambda);
    close(lambda[0], 1, 1e-6, 'von Mises and Fisher');
    lmp.lobe_make_phong(3, 4, lambda);
    close(lambda[0], 1, 1e-6, 'Phong');
    const sh = floats(9);
    lmp.lobe_project(3, lambda, up, sh);
    close(sh[0], Math.sqrt(1 / (4 * Math.PI)), 1e-6, 'a lobe');
    const response = lmp.lobe_response(3, lambda, up, [sphere], 1, [0, 0, 0]);
    lmp.lobe_response_n(3, lambda, new Float32Array(up), { center: [0, 0, 3], radius: [1], radiance: new Float32Array([1, 2, 4]) }, 1, floats(3), 1, rgb);
    close(rgb[1], response.g, 1e-5, 'many responses');
    const { lobe } = lmp.lobe_find_ggx(up, up, 0.5);
    assert.equal(lobe.length, lmp.GGX_LOBES);
    const table = floats(4 * lmp.GGX_TEXELS);
    lmp.lobe_copy_ggx_texels(table);
    assert.ok(table.every(Number.isFinite));
    const lobes = lmp.preintegrated_lobe_create({ bands: 3 });
    close(lmp.preintegrated_lobe_eval(lobes, 4, 0, 1), lmp.lobe_response(3, lambda, up, [{ kind: lmp.LIGHT_DIRECTIONAL, direction: up, irradiance: [1, 0, 0] }], 1, [0, 0, 0]).r,
        0.01, 'a preintegrated lobe');
    const info = lmp.preintegrated_lobe_describe(lobes);
    assert.equal(info.coefficients.length, 2 * info.pair_count);
    const bytes = new Uint8Array(lmp.preintegrated_lobe_size(lobes));
    lmp.preintegrated_lobe_write(lobes, bytes.length, bytes);
    const read = lmp.preintegrated_lobe_read(bytes, bytes.length);
    assert.equal(lmp.preintegrated_lobe_eval(read, 4, 0.1, 0.5), lmp.preintegrated_lobe_eval(lobes, 4, 0.1, 0.5));
    bytes[100] ^= 1;
    assert.throws(() => lmp.preintegrated_lobe_read(bytes, bytes.length), (error) => error instanceof LampionError && error.code === lmp.ERROR_CHECKSUM && error.message.length > 30);
    lmp.preintegrated_lobe_destroy(read);

    close(lmp.material_dielectric(1.5, 1, [1, 1, 1]).f0.r, 0.04, 1e-6, 'F0');
    assert.ok(lmp.material_coat_reflectance({ weight: 1 }, up, up) > 0.03);
    const white = { diffuse: [1, 1, 1] }, surface = { position: [0, 0, 0], normal: up, view: up };
    close(lmp.shade(null, white, surface, [sphere], 1).g, 2 / 9, 1e-6, 'Lambert');
    const surfaces = { position: floats(6), normal: new Float32Array([...up, ...up]), view: new Float32Array([...up, ...up]), material: white };
    lmp.shade_n(null, surfaces, 2, [sphere], 1, rgb);
    close(rgb[4], 2 / 9, 1e-6, 'many surfaces');
    const gloss = { kind: lmp.MATERIAL_METALLIC_ROUGHNESS, base_color: [1, 1, 1], metallic: 1, roughness: 0.5 };
    lmp.shade_n({ method: lmp.SHADE_PREINTEGRATED, lobe: lobes }, { ...surfaces, material: [gloss, white], material_stride: made.structs('material', 1).size }, 2, [sphere], 1, rgb);
    assert.ok(rgb[1] > 2 / 9 && Math.abs(rgb[4] - 2 / 9) < 1e-6);
    const environment = { sh: floats(27), bands: 3 };
    environment.sh[0] = 2 * Math.sqrt(Math.PI);
    close(lmp.shade_environment(null, white, surface, environment).r, 1, 1e-6, 'a white sky');
    lmp.shade_environment_n(null, surfaces, 2, environment, rgb);
    close(rgb[3], 1, 1e-6, 'many surfaces under a sky');
    lmp.preintegrated_lobe_destroy(lobes);
}

// --- BRDFs ---------------------------------------------------------------------------------------
{
    const up = [0, 0, 1], lambert = lmp.brdf_create_lambert([1, 0.5, 0]);
    close(lmp.brdf_eval(lambert, up, up).g, 0.5 / Math.PI, 1e-6, 'f_r');
    const rgb = new Float64Array(3), sh = floats(300);
    lmp.brdf_eval_double(lambert, up, up, rgb);
    close(rgb[0], 1 / Math.PI, 1e-7, 'f_r in double');
    assert.equal(lmp.brdf_describe(lambert).kind, lmp.BRDF_LAMBERT);
    for (const other of [lmp.brdf_create_phong([1, 1, 1], 5), lmp.brdf_create_ggx({ alpha_x: 0.3, alpha_y: 0.2, f0: [1, 1, 1] }), lmp.brdf_create_sheen({ color: [1, 1, 1], roughness: 0.5 }),
        lmp.brdf_create_sgd(lmp.brdf_find_sgd(lmp.brdf_sgd_name(0)))]) {
        assert.ok(lmp.brdf_eval(other, up, up).r >= 0);
        lmp.brdf_destroy(other);
    }
    assert.equal(lmp.brdf_sgd_name(1000), null);
    lmp.brdf_project(3, 16, lambert, up, sh);
    close(sh[0], Math.sqrt(Math.PI) / 2 / Math.PI, 1e-3, 'a projected BRDF'); // Y_00 ∫ cos/π
    const table = lmp.brdf_table_create({ bands: 4, views: 8 }, lambert), info = lmp.brdf_table_describe(table);
    assert.equal(info.bands, 4);
    assert.ok(lmp.brdf_table_coefficients(table).every(Number.isFinite));
    lmp.brdf_table_interpolate(table, 1, 0, sh);
    close(sh[0], Math.sqrt(Math.PI) / 2 / Math.PI, 1e-3, 'an interpolated table');
    const [whole] = lmp.brdf_table_find_albedo(table, 0, 0);
    close(whole.g, 0.5, 1e-3, 'an albedo');
    const bytes = new Uint8Array(lmp.brdf_table_size(table));
    lmp.brdf_table_write(table, bytes.length, bytes);
    lmp.brdf_table_destroy(lmp.brdf_table_read(bytes, bytes.length));
    assert.throws(() => lmp.brdf_table_read(new Uint8Array(8), 8), LampionError);
    const caps = lmp.preintegrated_brdf_create({}, table);
    assert.ok(lmp.preintegrated_brdf_eval(caps, 1, up, 0.1).r > 0);
    assert.ok(lmp.preintegrated_brdf_ambient(caps, 1).r > 0);
    assert.equal(lmp.preintegrated_brdf_describe(caps).bands, 4);
    const stored = new Uint8Array(lmp.preintegrated_brdf_size(caps));
    lmp.preintegrated_brdf_write(caps, stored.length, stored);
    lmp.preintegrated_brdf_destroy(lmp.preintegrated_brdf_read(stored, stored.length));
    const shaded = lmp.shade(null, { kind: lmp.MATERIAL_TABLE, table }, { position: [0, 0, 0], normal: up, view: up }, [sphere], 1);
    const lambda = floats(4);
    lmp.lobe_make_diffuse(4, lambda);
    close(shaded.r, lmp.lobe_response(4, lambda, up, [sphere], 1, [0, 0, 0]).r / Math.PI, 1e-4, 'a table under a sphere');
    lmp.preintegrated_brdf_destroy(caps);
    lmp.brdf_table_destroy(table);
    const rgl = lmp.brdf_encode_rgl(lambert), again = lmp.brdf_read_rgl(rgl, rgl.length);
    close(lmp.brdf_eval(again, up, up).g, 0.5 / Math.PI, 2e-3, 'an RGL file');
    lmp.brdf_destroy(again);
    lmp.brdf_destroy(lambert);
    assert.throws(() => lmp.brdf_read_merl(new Uint8Array(12), 12), LampionError);
    assert.throws(() => lmp.brdf_create_lambert([NaN, 0, 0]), LampionError);
}

// --- fields, probes, bounces ---------------------------------------------------------------------
{
    const field = lmp.field_create({ bands: 3, nodes: [4, 4, 4], origin: [-1.5, -1.5, 2], cell: [1, 1, 1], light_max: 4 });
    assert.equal(lmp.field_describe(field).desc.bands, 3);
    lmp.field_update(field, [sphere], 1);
    assert.equal(lmp.field_lights(field).length, 1);
    const points = new Float32Array([0.25, 0.5, 4.5]), sh = floats(27), direct = floats(27), rgb = floats(3), up = new Float32Array([0, 0, 1]);
    lmp.field_eval_n(field, points, 1, sh);
    lmp.light_project_n(3, [sphere], 1, null, points, 1, direct);
    sh.forEach((value, i) => close(value, direct[i], 0.02, 'a field'));
    lmp.field_reset(field, [sphere], 1);
    lmp.field_want_n(field, points, 1);
    lmp.field_compute(field);
    lmp.field_move_n(field, [0], [{ ...sphere, radiance: [0, 0, 1] }], 1);
    lmp.field_add(field, sphere);
    lmp.field_remove(field, 0);
    lmp.field_eval_n(field, points, 1, sh);
    sh.forEach((value, i) => close(value, direct[i], 0.02, 'a field in pieces'));
    lmp.field_eval_lobe_n(field, [Math.PI, 2, 1], up, points, 1, rgb);
    lmp.field_shade_n(null, field, { position: points, normal: up, view: up, material: { diffuse: [1, 1, 1] } }, 1, rgb);
    assert.ok(rgb.every((value) => value >= 0));
    const near = new Uint32Array(4), fractions = floats(4);
    assert.equal(lmp.field_find_near(field, [0, 0, 3.5], 4, near, fractions), 1);
    const nodes = floats(64 * 108), begin = new Uint32Array(10);
    lmp.field_update(field, [sphere], 1);
    lmp.field_copy_nodes(field, 0, 64, nodes);
    lmp.field_copy_lists(field, lmp.field_copy_lists(field, 0, begin, near), begin, new Uint32Array(64));
    assert.equal(lmp.field_coarser_level(field), null);
    lmp.field_destroy(null);
    const fine = lmp.field_create({ bands: 1, nodes: [16, 16, 16], light_max: 1 }), coarse = lmp.field_coarser_level(fine);
    assert.equal(lmp.field_describe(coarse).desc.cell.x, 2);
    assert.throws(() => lmp.field_destroy(coarse), /belongs to another object/);
    lmp.field_destroy(fine);
    const odd = lmp.field_create({ bands: 1, nodes: [3, 3, 3], light_max: 1 });
    lmp.field_copy_lists(odd, 1, new Uint32Array(3), near); // one block, and everywhere
    lmp.field_destroy(odd);
    const bytes = new Uint8Array(lmp.field_size(field));
    lmp.field_write(field, bytes.length, bytes);
    lmp.field_destroy(lmp.field_read(bytes, bytes.length));
    assert.throws(() => lmp.field_update(field, Array(5).fill(sphere), 5), LampionError);
    lmp.field_destroy(field);

    close(lmp.probe_irradiance(3, direct, [0, 0, -1]).g, 2 * lmp.probe_irradiance(3, direct, [0, 0, -1]).r, 1e-5, 'green of a probe');
    lmp.probe_irradiance_n(3, direct, up, 1, rgb);
    const constants = lmp.probe_make_constants(3, 1, direct);
    close(constants.linear[0][2] + constants.linear[0][3] + constants.quadratic[0][2], rgb[0], 1e-5, 'constants of a probe');
    const directions = floats(3 * 200), values = floats(200), fitted = floats(4);
    for (let i = 0; i < 200; i++) {
        const z = 1 - (2 * i + 1) / 200, a = 2.399963 * i;
        directions.set([Math.sqrt(1 - z * z) * Math.cos(a), Math.sqrt(1 - z * z) * Math.sin(a), z], 3 * i);
        values[i] = 1 + z;
    }
    lmp.probe_fit(2, 0, { directions, values, count: 200 }, fitted);
    close(fitted[2], Math.sqrt(4 * Math.PI / 3), 1e-4, 'a fit');
    const weights = floats(3);
    lmp.probe_make_positive_window(3, direct, 3, weights);
    assert.ok(weights[0] === 1 && weights[2] <= 1);
    assert.ok(Number.isFinite(lmp.probe_minimum(3, direct)));
    const three = { sign: lmp.PROBE_SIGN_POSITIVE }, converted = floats(9);
    lmp.probe_convert(3, {}, three, direct.subarray(0, 9), converted);
    assert.equal(lmp.probe_recognize(3, 1e-4, direct.subarray(0, 9), converted).sign, lmp.PROBE_SIGN_POSITIVE);
    assert.equal(lmp.probe_recognize(3, 1e-4, direct.subarray(0, 9), floats(9).fill(7)), null);
    const format = lmp.probe_engine_format(lmp.PROBE_UNITY), exported = floats(27);
    assert.equal(format.name, 'unity');
    lmp.probe_export(3, format, direct, exported);
    assert.ok(exported.some(Boolean));
    const volume = made.floats(27), halves = made.halves(28);
    volume.set(direct);
    made.pack_volume(volume, 1, halves);
    const unpacked = floats(28);
    lmp.sh_unpack_half_n(halves, 28, unpacked);
    close(unpacked[0], constants.linear[0][0], 2e-3, 'a volume');
    assert.throws(() => made.pack_volume(direct, 1, halves), RangeError);

    // Two plates that see only each other: E = (direct + E) albedo, so 1/2 + 1/4 + … = 1.
    const plate = { albedo: [0.5, 0.5, 0.5], radius: 1 };
    const transfer = lmp.transfer_create({
        surfels: [{ ...plate, position: [0, 0, 0], normal: [0, 0, 1] }, { ...plate, position: [0, 0, 1], normal: [0, 0, -1] }], surfel_count: 2,
        hits: new Uint32Array([1, 0]), ray_count: 1, probe_directions: [[0, 0, 1], [0, 0, -1]], probe_hits: new Uint32Array([1, 0]), probe_count: 1, probe_ray_count: 2,
    });
    lmp.transfer_update(transfer, { iterations: 60 }, { direct: new Float32Array([1, 1, 1, 1, 1, 1]) });
    close(lmp.transfer_irradiance(transfer, 0, [0, 0, 0], [0, 0, 1]).r, 1, 1e-5, 'bounces');
    const e = floats(6);
    lmp.transfer_copy_irradiance_n(transfer, 0, 2, e);
    close(e[5], 1, 1e-5, 'bounces of all');
    lmp.transfer_eval_probe_n(transfer, 0, 1, sh);
    assert.ok(sh[0] > 0);
    lmp.transfer_reset(transfer);
    assert.equal(lmp.transfer_describe(transfer).surfel_count, 2);
    assert.throws(() => lmp.transfer_update(transfer, null, { direct: floats(3) }), RangeError);
    lmp.transfer_destroy(transfer);
}

const { version } = createRequire(import.meta.url)('./node_modules/lampion/package.json');
assert.equal([lmp.version() >> 16, lmp.version() >> 8 & 255, lmp.version() & 255].join('.'), version);
assert.equal(lmp.result_text(lmp.OK).length > 0, true);
assert.equal(lmp.cpu_name(), 'wasm');
assert.equal(lmp.cpu_flags(), lmp.CPU_VECTOR);
assert.equal(lmp.cpu_limit(lmp.CPU_VECTOR), lmp.CPU_VECTOR);

// MERL files are 33 MB: an instance with room for one.
{
    const large = await load({ memory: 256 << 20 }), lambert = large.brdf_create_lambert([1, 0.5, 0]);
    called.add('brdf_encode_merl');
    const file = large.brdf_encode_merl(lambert), read = large.brdf_read_merl(file, file.length);
    close(large.brdf_eval(read, [0, 0, 1], [0, 0, 1]).g, 0.5 / Math.PI, 1e-3, 'a MERL file');
}

const missing = [...Object.keys(functions), 'sh_project_function', 'sh_project_function_rgb', 'brdf_encode_merl', 'brdf_encode_rgl']
    .filter((name) => !called.has(name));
assert.deepEqual(missing, [], 'functions that nothing calls');

// --- both modules, one module in two instances ---------------------------------------------------
{
    const scalar = await load({ simd: false }), module = await compileLampion(), twin = await load({ source: module });
    assert.equal(scalar.cpu_name(), 'scalar');
    assert.throws(() => scalar.field_describe(made.field_create({ bands: 3 })), /belongs to another instance/);
    assert.throws(() => scalar.light_irradiance(made.structs('light', 1), 1, [0, 0, 0], [0, 1, 0]), /belongs to another instance/);
    const points = Float32Array.from({ length: 300 }, (none, i) => Math.sin(i)), spheres = {
        center: Float32Array.from({ length: 96 }, (none, i) => 3 * Math.cos(i)), radius: floats(32).fill(0.3), radiance: floats(96).fill(1),
    };
    const results = [made, scalar, twin].map((one) => {
        const sh = floats(100 * 75);
        one.sphere_sum_n(5, spheres, 32, null, points, 100, sh);
        return sh;
    });
    assert.deepEqual(results[1], results[0], 'the bits of both modules');
    assert.deepEqual(results[2], results[0]);
    for (const name of ['lampion.wasm', 'lampion-scalar.wasm'])
        assert.ok(WebAssembly.Module.exports(new WebAssembly.Module(readFileSync(`node_modules/lampion/${name}`))).length > 160);
}

// --- three.js, as far as it needs no browser -----------------------------------------------------
{
    const { Box3, Color, MeshStandardMaterial, Mesh, Scene, SphereGeometry, Vector3 } = await import('three');
    const { LightProbeVolume, SphereLight, SphereLights } = await import('lampion/three');
    const kind = lmp.LIGHT_RECTANGLE, half = [new Vector3(1, 0, 0), new Vector3(0, 1, 0)], sh = floats(27), same = floats(27);
    lmp.light_project(3, [{ kind, half, position: new Vector3(0, 0, 3), radiance: new Color(1, 2, 3) }], 1, [0, 0, 0], sh);
    lmp.light_project(3, [{ kind, half: [[1, 0, 0], [0, 1, 0]], position: [0, 0, 3], radiance: [1, 2, 3] }], 1, [0, 0, 0], same);
    assert.deepEqual(sh, same, "three's vectors and colors");
    const scene = new Scene(), material = new MeshStandardMaterial({ name: 'clay' });
    scene.add(new Mesh(new SphereGeometry(), material), new SphereLight());
    const lights = new SphereLights(made, scene), volume = new LightProbeVolume(made, new Box3(new Vector3(), new Vector3(1, 1, 1)), [2, 2, 2]);
    for (const again of [() => volume.add(material), () => volume.addScene(scene), () => new SphereLights(made, scene)])
        assert.throws(again, /"clay" is already lit/);
    assert.throws(() => new SphereLights(load(), scene), /not what load\(\) resolves to/);
    assert.throws(() => volume.update(), /takes the scene/);
    lights.dispose();
    lights.dispose(); // frees nothing twice
    assert.throws(() => lights.update(), /disposed of/);
    volume.addScene(scene);
    volume.update(scene);
    volume.dispose();
    volume.dispose();
    assert.throws(() => volume.update(scene), /disposed of/);
    const arrays = Array.from({ length: 64 }, () => made.floats(100));
    assert.equal(new Set(arrays.map(({ byteOffset }) => byteOffset)).size, 64);
    arrays.forEach((array) => made.free(array));
}
assert.deepEqual([lmp.SH_COUNT(3), lmp.SH_INDEX(2, -1), lmp.SH_ROTATION_COUNT(3)], [9, 5, 35]);
assert.ok(glsl.includes('lmp_shade_zonal') && lampionWgsl({ bands: 3 }).includes('fn lmp_shade_zonal'));
console.log(`${called.size} functions`);
