/* SPDX-License-Identifier: MIT */
/* What shade.wgsl has of areas. */
fn lmp_area_count() -> i32 {
    return AREAS;
}
fn lmp_area_texel(i: i32, k: i32) -> vec4f {
    return given[GIVEN_AREAS + 11 * i + k];
}
@compute @workgroup_size(SURFACES) fn areas(@builtin(global_invocation_id) id: vec3u) {
    let surface = begin(id.x, 18);
    for (var i = 0; i < AREAS; i++) {
        put(lmp_area_irradiance(i, surface.position, surface.normal));
    }
}
