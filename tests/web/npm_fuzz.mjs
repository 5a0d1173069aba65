// SPDX-License-Identifier: MIT
// npm_fuzz.mjs [CALLS] [SEED]: the npm package, as installed beside it, given arguments of the right kinds and of any
// values, lengths and gaps: whatever they are, WebAssembly does not trap, and what is refused is refused on purpose.
import assert from 'node:assert/strict';
import { LampionError, load } from 'lampion';
import { enums, functions, structs } from './node_modules/lampion/api.js';

const [calls = '3000', first = '1'] = process.argv.slice(2);
const lmp = await load({ memory: 256 << 20 });
let seed = Number(first);
const below = (n) => (seed = seed * 48271 % 2147483647) % n; // Park and Miller 1993
const pick = (list) => list[below(list.length)];

const sphere = { position: [0, 3, 0], radius: 0.5, radiance: [1, 1, 1] }, surfel = { albedo: [0.5, 0.5, 0.5], radius: 1, position: [0, 0, 0], normal: [0, 0, 1] };
const brdfs = [{ alpha_x: 0.5 }, { alpha_x: 0.5, alpha_y: 0.2 }].map((ggx) => lmp.brdf_create_ggx({ ...ggx, f0: [0.1, 0.1, 0.1] }));
const tables = brdfs.map((brdf, i) => lmp.brdf_table_create({ bands: 4, views: 8, azimuths: i && 4 }, brdf)), field = lmp.field_create({ bands: 3, nodes: [4, 4, 4], light_max: 4 });
lmp.field_update(field, [sphere, sphere], 2);
const objects = {
    brdf: brdfs, brdf_table: tables, field: [field], preintegrated_brdf: [lmp.preintegrated_brdf_create(null, tables[0])],
    preintegrated_lobe: [lmp.preintegrated_lobe_create({ bands: 3 })], sh_product: [lmp.sh_product_create(3)],
    transfer: [lmp.transfer_create({ surfels: [surfel, surfel], surfel_count: 2, sky_count: 1, hits: [1, 0], ray_count: 1, probe_directions: [[0, 0, 1]], probe_hits: [0, 1], probe_count: 2, probe_ray_count: 1 })],
};

const kinds = { i8: Int8Array, u8: Uint8Array, i16: Int16Array, u16: Uint16Array, i32: Int32Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };
const large = Object.fromEntries(Object.entries(kinds).map(([type, Kind]) => [type, new Kind(60000).fill(1)])), MOST = 2 ** 32 - 1;
const integers = [0, 1, 1, 2, 2, 3, 3, 4, 5, 6, 7, 8, 9, 16, 33, 64, 100, 128, 129, 1e6, -1, 2 ** 31 - 1, MOST], numbers = [0, 1, 1, 1, -1, 0.5, 2, 1e-9, 1e9, NaN, Infinity];

function valueOf(type) {
    if (type === 'bool')
        return below(2) === 1;
    if (enums[type])
        return below(8) ? below(enums[type].length) : pick(integers);
    if (kinds[type])
        return pick(type[0] === 'f' ? numbers : integers);
    if (type === 'vec3')
        return pick([[0, 0, 1], [0, 1, 0], [0.6, 0, 0.8], [0, 0, 0], [1, 2, 3]]);
    if (/_array$/.test(type))
        return below(12) === 0 ? null : below(5) || type === 'vec3_array' ? large.f32 : { at: large.f32, stride: pick([0, 4, 12, 16, 400]), ...type === 'sh_array' && { layout: below(2) } };
    if (type.of)
        return Array.from({ length: type.count - (below(6) ? 0 : 1) }, () => valueOf(type.of));
    return type.to ? pointed(type.to) : Object.fromEntries(structs[type].members.filter(() => below(3)).map(([member, of]) => [member, valueOf(of)]));
}

function pointed(to) {
    if (to === 'char')
        return pick(['gold-metallic-paint', 'x', '']);
    if (to.to)
        return Array.from({ length: 16 }, () => pick(objects[to.to]));
    if (below(12) === 0)
        return null;
    if (objects[to])
        return pick(objects[to]);
    if (kinds[to] || to === 'void')
        return below(4) ? large[to === 'void' ? 'u8' : to] : new (kinds[to] ?? Uint8Array)(pick([0, 1, 3, 9, 27, 100])).map(() => below(5));
    const count = pick([1, 1, 2, 2, 3, 16]);
    return count === 1 ? valueOf(to) : Array.from({ length: count }, () => valueOf(to));
}

// Counts are small, as the arrays are, or the largest; objects stay, and tables take long to make.
const argument = (name, type) => name === 'bands' ? pick([1, 2, 3, 3, 4, 6, 10, 33])
    : kinds[type] && type[0] !== 'f' ? pick([0, 1, 1, 2, 2, 3, 64, MOST]) : valueOf(type);
const names = Object.keys(functions).filter((name) => !/_destroy$|(brdf_table|preintegrated_\w+)_create$|cpu_limit/.test(name));
let done = 0;
for (let i = 0; i < Number(calls); i++) {
    const name = names[i % names.length], given = functions[name].parameters.filter(([, , how]) => how === 'given');
    try {
        lmp[name](...given.map(([parameter, type]) => argument(parameter, type)));
        done++;
    } catch (error) {
        const meant = error instanceof LampionError || [TypeError, RangeError].includes(error.constructor) && error.message.startsWith(`${name}`);
        assert.ok(meant, `call ${i}, of ${name}: ${error.stack}`);
    }
}
assert.ok(done > Number(calls) / 4, `${done} calls of ${calls} did something`);
assert.ok(Math.abs(lmp.light_irradiance([sphere], 1, [0, 0, 0], [0, 1, 0]).r - Math.PI * 0.25 / 9) <= 1e-6, 'an instance as before');
console.log(`${done} calls of ${calls}`);
