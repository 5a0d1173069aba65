/* SPDX-License-Identifier: MIT */
/* lampion_probe.wgsl - irradiance from a probe in Bevy's shaders. Its world has the axes of this library.
 *
 * What lmp_probe_make_constants returns, scale 1/pi, is [Vec4; 7] of a material that derives AsBindGroup. The
 * first three alone are a probe of two bands, made of coefficients whose third band is 0.
 *
 *     #import lampion::probe::irradiance_l2
 *     @group(2) @binding(0) var<uniform> probe: array<vec4<f32>, 7>;
 *     ...
 *     color += albedo * max(irradiance_l2(probe, in.world_normal), vec3(0.0));
 */
#define_import_path lampion::probe

/* Returns irradiance over pi of two bands; n is unit, in the world. The result may ring below 0. */
fn irradiance_l1(probe: array<vec4<f32>, 3>, n: vec3<f32>) -> vec3<f32> {
    let m = vec4<f32>(n, 1.0);
    return vec3<f32>(dot(probe[0], m), dot(probe[1], m), dot(probe[2], m));
}

/* Returns that of three bands. */
fn irradiance_l2(probe: array<vec4<f32>, 7>, n: vec3<f32>) -> vec3<f32> {
    let q = n.xyzz * n.yzzx;
    return irradiance_l1(array<vec4<f32>, 3>(probe[0], probe[1], probe[2]), n) +
        vec3<f32>(dot(probe[3], q), dot(probe[4], q), dot(probe[5], q)) +
        probe[6].rgb * (n.x * n.x - n.y * n.y);
}
