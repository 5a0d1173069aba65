/* SPDX-License-Identifier: MIT */
/* The WGSL variants as a user joins them: one thread a surface, whose values are those of values.h in their
 * order. LIGHTS, SURFACES, TEXELS and AREAS are constants that are joined, too. */
@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;
@group(0) @binding(2) var<storage, read> words: array<u32>;
const GIVEN_SURFACES = 2 * LIGHTS;
const GIVEN_TEXELS = GIVEN_SURFACES + 3 * SURFACES;
const GIVEN_AREAS = GIVEN_TEXELS + TEXELS;
const GIVEN_PROBE = GIVEN_AREAS + 11 * AREAS;

fn lmp_light_count() -> i32 {
    return LIGHTS;
}
fn lmp_light_sphere(i: i32) -> vec4f {
    return given[2 * i];
}
fn lmp_light_fixed(i: i32) -> bool {
    return given[2 * i + 1].w > 0.5;
}
fn lmp_light_color(i: i32, p: vec3f) -> vec3f {
    return given[2 * i + 1].rgb;
}
fn lmp_light_lit(i: i32, p: vec3f) -> bool {
    return true;
}
fn lmp_ggx_texel(i: i32) -> vec4f {
    return given[GIVEN_TEXELS + i];
}

fn word(i: i32) -> i32 {
    return i32(words[i]);
}
fn number(i: i32) -> f32 {
    return bitcast<f32>(words[i]);
}
fn pair_at(i: vec2i) -> vec2f {
    return unpack2x16snorm(words[word(2) + i.y * 256 + i.x]);
}
fn texel_at(i: vec2i) -> vec3f {
    let at = word(6) + 2 * (i.y * 512 + i.x);
    return vec3f(unpack2x16snorm(words[at]), unpack2x16snorm(words[at + 1]).x);
}
fn lmp_preintegrated_lobe_pair(p: vec2f) -> vec2f {
    let i = vec2i(floor(p - 0.5));
    let f = p - 0.5 - vec2f(i);
    return mix(mix(pair_at(i), pair_at(i + vec2i(1, 0)), f.x), mix(pair_at(i + vec2i(0, 1)), pair_at(i + vec2i(1, 1)), f.x), f.y);
}
fn lmp_preintegrated_lobe_cell(i: i32) -> vec4f {
    let at = word(0) + 4 * i;
    return vec4f(number(at), number(at + 1), number(at + 2), number(at + 3));
}
fn lmp_preintegrated_lobe_remap(i: i32) -> f32 {
    return number(word(1) + i);
}
fn lmp_preintegrated_lobe_shape() -> vec4f {
    return vec4f(number(3), f32(word(4)), 0.0, 0.0);
}
fn lmp_preintegrated_brdf_texel(p: vec2f) -> vec3f {
    let i = vec2i(floor(p - 0.5));
    let f = p - 0.5 - vec2f(i);
    return mix(mix(texel_at(i), texel_at(i + vec2i(1, 0)), f.x), mix(texel_at(i + vec2i(0, 1)), texel_at(i + vec2i(1, 1)), f.x), f.y);
}
fn lmp_preintegrated_brdf_value(i: i32) -> f32 {
    return number(word(5) + i);
}

var<private> at: i32;
fn put(x: f32) {
    values[at] = x;
    at++;
}
fn put3(v: vec3f) {
    put(v.x);
    put(v.y);
    put(v.z);
}

/* What all entry points begin with: the surface, whose values from k on are put. */
fn begin(thread: u32, k: i32) -> lmp_surface {
    let own = GIVEN_SURFACES + 3 * i32(thread);
    at = i32(thread) * (42 + 4 * LMP_BANDS + 2 * LMP_SH_COUNT) + k;
    return lmp_surface(given[own].xyz, given[own + 1].xyz, given[own + 2].xyz);
}
fn roughness_of(thread: u32) -> f32 {
    return given[GIVEN_SURFACES + 3 * i32(thread)].w;
}
const clay = lmp_material(vec3f(0.8, 0.4, 0.3), vec3f(0.04, 0.05, 0.06), 30.0);

@compute @workgroup_size(SURFACES) fn zonal(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_zonal_material(begin(id.x, 0), clay));
}
@compute @workgroup_size(SURFACES) fn coefficients(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_coefficients_material(begin(id.x, 3), clay));
}
@compute @workgroup_size(SURFACES) fn preintegrated(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_preintegrated_material(begin(id.x, 6), clay));
}
@compute @workgroup_size(SURFACES) fn preintegrated_brdf(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_preintegrated_brdf(begin(id.x, 9), 0));
}

@compute @workgroup_size(SURFACES) fn parts(@builtin(global_invocation_id) id: vec3u) {
    let surface = begin(id.x, 12);
    let first = array<vec4f, 3>(given[GIVEN_PROBE], given[GIVEN_PROBE + 1], given[GIVEN_PROBE + 2]);
    let second = array<vec4f, 3>(given[GIVEN_PROBE + 3], given[GIVEN_PROBE + 4], given[GIVEN_PROBE + 5]);
    put3(lmp_probe_irradiance(first, second, given[GIVEN_PROBE + 6], surface.normal));
    var sum = vec3f(0.0);
    for (var i = 0; i < lmp_light_count(); i++) {
        let cap = lmp_light_find_cap(i, surface.position);
        sum += lmp_light_color(i, surface.position) * lmp_cap_irradiance(cap, surface.normal);
    }
    put3(sum);
    at += AREAS;
    put(lmp_coated(lmp_coat(0.8, 0.3), surface.normal, surface.view));
}

fn put_bands(bands: array<f32, LMP_BANDS>) {
    for (var l = 0; l < LMP_BANDS; l++) {
        put(bands[l]);
    }
}
fn put_coefficients(sh: array<f32, LMP_SH_COUNT>) {
    for (var i = 0; i < LMP_SH_COUNT; i++) {
        put(sh[i]);
    }
}
@compute @workgroup_size(SURFACES) fn arrays(@builtin(global_invocation_id) id: vec3u) {
    let surface = begin(id.x, 42);
    var bands: array<f32, LMP_BANDS>;
    var sh: array<f32, LMP_SH_COUNT>;
    put_bands(phong_lobe(200.0 * roughness_of(id.x)));
    lmp_lobe_make_diffuse(&bands);
    put_bands(bands);
    for (var l = 0; l < LMP_BANDS; l++) {
        put(lmp_window_weight(l));
    }
    lmp_cap_series(lmp_cap_of_sphere(given[0], surface.position), &bands);
    put_bands(bands);
    lmp_sphere_project(given[0], surface.position, &sh);
    put_coefficients(sh);
    lmp_sh_eval(surface.normal, &sh);
    put_coefficients(sh);
}
