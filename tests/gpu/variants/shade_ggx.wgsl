/* SPDX-License-Identifier: MIT */
/* What shade.wgsl has of the lobes of GGX. */
fn phong_lobe(exponent: f32) -> array<f32, LMP_BANDS> {
    var lambda: array<vec3f, LMP_BANDS>;
    var second: array<f32, LMP_BANDS>;
    lmp_lobe_make_phong(vec3f(1.0, exponent, 2.0), &lambda);
    for (var l = 0; l < LMP_BANDS; l++) {
        second[l] = lambda[l].y;
    }
    return second;
}

fn metal(thread: u32) -> lmp_metallic_roughness {
    return lmp_metallic_roughness(vec3f(0.9, 0.6, 0.3), 0.7, roughness_of(thread));
}
@compute @workgroup_size(SURFACES) fn ggx_zonal(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_zonal_metallic_roughness(begin(id.x, 23), metal(id.x)));
}
@compute @workgroup_size(SURFACES) fn ggx_coefficients(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_coefficients_metallic_roughness(begin(id.x, 26), metal(id.x)));
}
@compute @workgroup_size(SURFACES) fn ggx_preintegrated(@builtin(global_invocation_id) id: vec3u) {
    put3(lmp_shade_preintegrated_metallic_roughness(begin(id.x, 29), metal(id.x)));
}
@compute @workgroup_size(SURFACES) fn ggx_parts(@builtin(global_invocation_id) id: vec3u) {
    let surface = begin(id.x, 32);
    let coat = lmp_coat(0.8, 0.3);
    let part = lmp_coated(coat, surface.normal, surface.view);
    put3((1.0 - part) * lmp_shade_zonal_metallic_roughness(surface, metal(id.x)) +
         lmp_shade_zonal_lobes(surface, lmp_lobes_of_coat(surface, coat)));
    let node = lmp_ggx_lookup(surface.normal, surface.view, roughness_of(id.x));
    let lobe = lmp_ggx_lobe_at(node, surface.normal, surface.view, i32(id.x) % 5);
    put3(lobe.axis);
    put(lobe.exponent);
    put(lobe.f0);
    put(lobe.f90);
    put(lmp_ggx_diffuse_f90(node));
}
