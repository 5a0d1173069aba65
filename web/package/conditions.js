// SPDX-License-Identifier: MIT
// conditions.js - what C requires of arguments besides their lengths (extents.js) and the ranges that api.js has from the
// headers: indices of what there is, and members that depend on others. C trusts its caller, so they are checked before a
// call. A condition returns what is wrong, in words, or nothing.
import { constants, functions, structs } from './api.js';

const range = (name, value, low, high) => value >= low && value <= high ? '' : `${name} is ${value}, not ${low} to ${high}`;
const index = (name, value, count) => value < count ? '' : `${name} is ${value}, and there are ${count}`;
const part = (first, count, all) => first + count <= all ? '' : `first + count is ${first + count}, and there are ${all}`;

// --- structs -------------------------------------------------------------------------------------

export const structConditions = {
    light: ({ kind, corner_count = 0, corner }) => kind === constants.LIGHT_POLYGON && !(corner_count >= 3 && corner_count <= corner?.length)
        ? `corner_count is ${corner_count}, and ${corner?.length ?? 0} corners are given` : '',
    material: ({ kind, table, preintegrated }) =>
        kind === constants.MATERIAL_TABLE && !table && !preintegrated ? 'table is missing'
            : kind === constants.MATERIAL_PREINTEGRATED && !preintegrated ? 'preintegrated is missing' : '',
    latlong: ({ pixels, width = 0, height = 0, channels = 0 }) =>
        !pixels ? 'pixels is missing' : range('width', width, 1, Infinity) || range('height', height, 1, Infinity) || range('channels', channels, 1, Infinity),
    cubemap: ({ faces, size = 0, channels = 0 }) =>
        !(faces?.length === 6 && Array.from(faces).every(Boolean)) ? 'faces is not an array of six'
            : range('size', size, 1, Infinity) || range('channels', channels, 1, Infinity),
    environment: ({ sh, bands = 0 }) => sh ? range('bands', bands, 1, constants.BANDS_MAX) : 'sh is missing',
    surfaces: ({ material, material_stride = 0 }) => !material ? 'material is missing'
        : ![0, structs.material.size].includes(material_stride) ? `material_stride is ${material_stride}, not 0 or ${structs.material.size}` : '',
    sheen_layer: ({ white }) => white && !Array.from(white).every(Boolean) ? 'white lacks a table' : '',
    probe_convention({ axes = [] }) {
        const sorted = Array.from({ length: 3 }, (none, i) => Math.abs(axes[i] ?? 0)).sort().join();
        return sorted === '0,0,0' || sorted === '1,2,3' ? '' : `axes is ${Array.from(axes)}, not x, y and z as 1, 2 and 3 with signs`;
    },
};

// --- functions -----------------------------------------------------------------------------------

// Elements of an argument that is an array, one struct, or Structs.
const memberAt = (value, i, member) => value?.memberAt ? value.memberAt(i, member) : (Array.isArray(value) ? value[i] : value)?.[member];
const some = (value, count, is) => {
    for (let i = 0; i < count; i++)
        if (is((member) => memberAt(value, i, member)))
            return true;
    return false;
};

const isArea = (member) => (member('kind') ?? 0) >= constants.LIGHT_RECTANGLE;
const noArea = (name) => (args) => some(args[name], args.count ?? 1, isArea) ? `${name} ${args.count === undefined ? 'is' : 'has'} an area` : '';
const anArea = (name) => (args) => isArea((member) => memberAt(args[name], 0, member)) ? '' : `${name} is not an area`;

// A method reads lobes from a preintegrated lobe, and others the coefficients of tables. Of Structs, pointers are not known.
const { SHADE_PREINTEGRATED, MATERIAL_LOBES, MATERIAL_METALLIC_ROUGHNESS, MATERIAL_TABLE } = constants;
const hasLobes = (member) => [MATERIAL_LOBES, MATERIAL_METALLIC_ROUGHNESS].includes(member('kind') ?? MATERIAL_LOBES) || member('coat')?.weight > 0;
const lacksTable = (member) => member('kind') === MATERIAL_TABLE && !member('table');
function shading({ settings, material, surfaces, count }) {
    const materials = surfaces ? surfaces.material : material, many = surfaces?.material_stride ? count : 1;
    if (memberAt(settings, 0, 'method') === SHADE_PREINTEGRATED)
        return !settings.lobe && !settings.memberAt && some(materials, many, hasLobes) ? 'settings.lobe is missing, which SHADE_PREINTEGRATED reads' : '';
    return !materials.memberAt && some(materials, many, lacksTable) ? 'table is missing, which this method reads' : '';
}
const positioned = (args) => args.count === 0 ? '' : args.surfaces.position ? shading(args) : 'surfaces.position is missing';

const planes = (sh, count) => (sh?.length ?? 0) > count && sh.length % count === 0;
const single = ({ bands, sh, rotated }) => planes(sh, bands * bands) && rotated?.length === sh.length
    ? `sh has ${sh.length} values, and only ${bands * bands} would be turned: sh_rotate_n turns several functions` : '';

const lights = (field, lmp) => lmp.field_describe(field).light_count;
const nodes = (field, lmp) => lmp.field_describe(field).desc.nodes.reduce((product, along) => product * along, 1);

export const conditions = {
    sh_rotate: single, sh_rotate_z: single, sh_rotate_by_matrix: single,
    light_find_cap: noArea('light'), light_project_zonal: noArea('light'),
    light_copy_area_texels: anArea('area'), light_power_from_radiance: anArea('area'), light_radiance_from_power: anArea('area'),
    light_intensity_from_radiance: anArea('area'), light_radiance_from_intensity: anArea('area'),
    shade: shading, shade_n: positioned,
    brdf_table_find_albedo({ table, view, azimuth }, lmp) {
        const { views, azimuths } = lmp.brdf_table_describe(table);
        return range('view', view, 0, views - 1) || range('azimuth', azimuth, 0, Math.max(azimuths, 1) - 1);
    },
    field_remove: ({ field, at }, lmp) => index('at', at, lights(field, lmp)),
    field_move_n({ field, at, count, ...args }, lmp) {
        const all = Array.from({ length: count }, (none, i) => at[i]), there = lights(field, lmp);
        return all.map((one, i) => index(`at[${i}]`, one, there)).find(Boolean) ?? (new Set(all).size < count ? 'at names a light twice' : noArea('lights')({ ...args, count }));
    },
    field_copy_nodes: ({ field, first, count }, lmp) => part(first, count, nodes(field, lmp)),
    field_shade_n: ({ surfaces, count }) => count === 0 || surfaces.position ? '' : 'surfaces.position is missing',
    probe_make_positive_window: ({ planes: count }) => count ? '' : 'planes is 0',
    probe_convert: ({ bands, from, to }) => bands > constants.PROBE_AXES_BANDS_MAX && `${from.axes ?? [1, 2, 3]}` !== `${to.axes ?? [1, 2, 3]}`
        ? `bands is ${bands}, and axes that differ take at most ${constants.PROBE_AXES_BANDS_MAX}` : '',
    transfer_irradiance: ({ transfer, surfel }, lmp) => index('surfel', surfel, lmp.transfer_describe(transfer).surfel_count),
    transfer_copy_irradiance_n: ({ transfer, first, count }, lmp) => part(first, count, lmp.transfer_describe(transfer).surfel_count),
    transfer_eval_probe_n: ({ transfer, first, count }, lmp) => part(first, count, lmp.transfer_describe(transfer).probe_count),
};

// --- what C refuses ------------------------------------------------------------------------------

function firstFault(list, find) {
    for (let i = 0; i < list.length; i++) {
        const fault = find(list[i], i);
        if (fault)
            return fault;
    }
    return '';
}

// Finds a float that is not finite or out of its range; returns what is wrong, or ''.
function faultOfValue(type, value, name, [low, high, zero] = [-Infinity, Infinity]) {
    if (typeof value === 'number')
        return !Number.isFinite(value) ? `${name} is ${value}` : value === 0 && zero ? '' : range(name, value, low, high);
    if (Array.isArray(value) || ArrayBuffer.isView(value))
        return firstFault(value, (one, i) => faultOfValue(type, one, `${name}[${i}]`, [low, high, zero]));
    return value && !value.memberAt ? firstFault(structs[type.to ?? type]?.members ?? [], ([member, own, , limits]) =>
        faultOfValue(own, value[member] ?? (limits && own === 'f32' ? 0 : null), `${name}.${member}`, own === 'i32' || own === 'u32' ? undefined : limits ?? [low, high, zero])) : '';
}

// What else is likely.
const likely = {
    brdf_find_sgd: ({ name }) => `there is no material "${name}": brdf_sgd_name(i) names them`,
    brdf_project: () => 'rings is not 1 to 2048, or wo.z not above 0',
};

// Says why C returned ERROR_ARGUMENT, or ''.
export function explain(name, args) {
    const { parameters, fault = '' } = functions[name];
    return firstFault(parameters, ([parameter, type]) => faultOfValue(type, args[parameter], parameter)) || likely[name]?.(args) || fault;
}
