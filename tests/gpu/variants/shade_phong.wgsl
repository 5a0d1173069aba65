/* SPDX-License-Identifier: MIT */
/* What shade.wgsl has of the lobes of Phong. */
fn phong_lobe(exponent: f32) -> array<f32, LMP_BANDS> {
    var lambda: array<f32, LMP_BANDS>;
    lmp_lobe_make_phong(exponent, &lambda);
    return lambda;
}
