// SPDX-License-Identifier: MIT
// extents.js - how many elements C reads or writes of each array, by the arguments beside it: C trusts its caller,
// so these are checked before a call.
//
// For a pointer to numbers it is their count, for one to structs and for arrays of vectors or colors that of
// elements, and for coefficients of a batch [values of an element, elements].
import { constants } from './api.js';

const square = ({ bands }) => bands * bands;
const planes = (count) => ({ bands }) => count * bands * bands;
const each = (values) => ({ bands, count, point_count }) => [values * bands * bands, count ?? point_count];
const bandwise = ({ bands }) => bands;
const rotation = ({ bands: n }) => (4 * n * n - 1) * n / 3;
const number = (count) => () => count;
const asked = ({ count }) => count;
const pointwise = ({ point_count, count }) => point_count ?? count;
const lightwise = ({ light_count, sphere_count, count }) => light_count ?? sphere_count ?? count;
const sized = ({ size }) => size;
const fielded = ({ field, count }, lmp) => [3 * lmp.field_describe(field).desc.bands ** 2, count];
const multiplied = ({ product }) => product.bands ** 2;
const paired = (args) => spread(square(args), args.count, args);

// The length that an array must have for `count` elements of `values` numbers (lmp_sh_layout).
export function spread(values, count, { stride = 0, layout = 0 } = {}) {
    const [long, short] = layout ? [values, count] : [count, values];
    return long && short && (long - 1) * (stride / 4 || short) + short;
}

// By the name of a parameter, or of a function and a parameter.
export const extents = {
    sh: square, a: square, b: square, c: square, rotated: square, windowed: square, converted: square, ours: square, theirs: square,
    red: square, green: square, blue: square, gradient: planes(3), hessian: planes(6), matrices: rotation,
    zonal: bandwise, weights: bandwise, lambda: bandwise,
    rotation: number(9), direction: number(3), center: number(3), point: number(3), wi: number(3), wo: number(3),
    points: pointwise, axes: pointwise, directions: asked, normals: asked, rgb: pointwise, surfaces: asked,
    lights: lightwise, spheres: lightwise, light: number(1), area: number(1),
    visibility: ({ light_count, sphere_count, point_count }) => (light_count ?? sphere_count) * point_count,
    bytes: sized, data: sized, lighting: ({ transfer }, lmp) => lmp.transfer_describe(transfer),

    'sh_make_rotation_double.rotation': number(4), 'brdf_eval_double.rgb': number(3),
    'sh_project_latlong.sh': ({ bands, image: { channels = 0 } }) => channels * bands * bands,
    'sh_project_cubemap.sh': ({ bands, map: { channels = 0 } }) => channels * bands * bands,
    'sh_eval_n.sh': each(1), 'sh_eval_gradient_n.sh': each(1), 'sh_eval_gradient_n.gradient': each(3),
    'sh_dot_n.a': paired, 'sh_dot_n.b': paired, 'sh_dot_n.dots': asked,
    'sh_rotate_n.rotated': each(1), 'sh_rotate_n.sh': (args) => spread(square(args), args.count, args.rotated ?? undefined),
    'sh_pack_half_n.values': asked, 'sh_pack_half_n.halves': asked, 'sh_unpack_half_n.values': asked, 'sh_unpack_half_n.halves': asked,
    'sphere_project_zonal_n.radii': asked, 'sphere_project_zonal_n.distances': asked,
    'sphere_project_zonal_n.zonal': ({ bands, count }) => [bands, count],
    'sphere_project_n.sh': each(1), 'sphere_project_n.spheres': asked,
    'sphere_project_all_n.sh': ({ bands, sphere_count, point_count }) => [bands * bands, sphere_count * point_count],
    'sphere_sum_n.sh': each(3), 'sphere_sum_gradient_n.sh': each(3), 'sphere_sum_gradient_n.gradient': each(9),
    'light_project.sh': planes(3), 'light_project_n.sh': each(3), 'light_add_n.sh': each(3),
    'light_copy_area_texels.texels': number(4 * constants.AREA_TEXELS), 'lobe_copy_ggx_texels.texels': number(4 * constants.GGX_TEXELS),
    'probe_irradiance.sh': planes(3), 'probe_irradiance_n.sh': planes(3), 'probe_make_constants.sh': planes(3), 'probe_export.sh': planes(3),
    'probe_export.values': number(27), 'probe_make_positive_window.sh': ({ bands, planes: count }) => count * bands * bands,
    'sh_multiply.a': multiplied, 'sh_multiply.b': multiplied, 'sh_multiply.c': multiplied,
    'brdf_table_interpolate.sh': ({ table }, lmp) => 3 * lmp.brdf_table_describe(table).count, 'brdf_project.sh': planes(3),
    'brdf_table_coefficients.result': ({ table }, lmp) => {
        const { azimuths, views, count } = lmp.brdf_table_describe(table);
        return 3 * Math.max(azimuths, 1) * views * count;
    },
    'field_lights.result': ({ field }, lmp) => lmp.field_describe(field).light_count,
    'field_eval_n.sh': fielded, 'field_eval_lobe_n.lambda': ({ field }, lmp) => lmp.field_describe(field).desc.bands,
    'field_copy_nodes.texels': ({ field, count }, lmp) => 12 * lmp.field_describe(field).desc.bands ** 2 * count,
    'field_copy_lists.begin': ({ field, capacity }, lmp) =>
        capacity && lmp.field_describe(field).desc.nodes.reduce((product, nodes) => product * Math.floor(nodes / 2), 1) + 2,
    'transfer_eval_probe_n.sh': ({ transfer, count }, lmp) => [3 * lmp.transfer_describe(transfer).bands ** 2, count],
    'field_find_near.lights': ({ capacity }) => capacity, 'field_find_near.fractions': ({ capacity }) => capacity,
    'field_move_n.at': asked, 'field_move_n.lights': asked, 'field_copy_lists.lights': ({ capacity }) => capacity,
};

// What pointers within structs lead to, by the other members, and by what is known of the struct itself (`extents`).
const beside = (all, count) => count;
const pixel = ({ texel }) => texel ? 2 : 4;
const image = (width, height) => (map) => {
    const texel = map.texel_stride || map.channels * pixel(map), channel = map.channel_stride || pixel(map);
    return (height(map) - 1) * (map.row_stride || width(map) * texel) + (width(map) - 1) * texel + (map.channels - 1) * channel + pixel(map);
};
const edge = ({ size }) => size;
export const memberExtents = {
    latlong: { pixels: image(({ width }) => width, ({ height }) => height) },
    cubemap: { faces: image(edge, edge) },
    environment: { sh: ({ bands }) => 3 * bands * bands },
    probe_samples: { directions: asked, values: asked, weights: asked },
    spheres: { center: beside, radius: beside, radiance: beside },
    surfaces: {
        position: beside, normal: beside, view: beside, tangent: beside, coat_normal: beside,
        material: ({ material_stride }, count) => material_stride ? count : 1,
    },
    sheen_layer: { white: number(constants.SHEEN_TABLES) },
    transfer_desc: {
        surfels: ({ surfel_count }) => surfel_count, hits: ({ surfel_count, ray_count }) => surfel_count * ray_count,
        links: ({ surfel_count, link_count }) => surfel_count * link_count, probe_directions: ({ probe_ray_count }) => probe_ray_count,
        probe_hits: ({ probe_count, probe_ray_count }) => probe_count * probe_ray_count,
    },
    transfer_lighting: {
        direct: (all, { surfel_count }) => surfel_count, emission: (all, { surfel_count }) => surfel_count, sky: (all, { sky_count }) => sky_count,
    },
    preintegrated_lobe_info: {
        cells: ({ cell_count }) => cell_count, coefficients: ({ pair_count }) => 2 * pair_count, remap: number(constants.PREINTEGRATED_LOBE_REMAP_COUNT),
    },
    preintegrated_brdf_info: {
        view_remap: ({ view_steps }) => view_steps + 1, cap_remap: ({ cap_steps }) => cap_steps + 1, ambient: ({ view_count }) => view_count,
        slices: ({ view_count, cap_count }) => view_count * cap_count, texels: ({ texel_count }) => 3 * texel_count,
    },
};
