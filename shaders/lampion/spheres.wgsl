/* SPDX-License-Identifier: MIT */
/* spheres.wgsl - what lampion.wgsl asks about lights, where all of them are spheres of one color. Define
 *     fn lmp_light_radiance(i: i32) -> vec3f
 * or, in place of this file, these three functions, whose GLSL macros lampion.glsl explains. */
fn lmp_light_fixed(i: i32) -> bool {
    return false;
}

fn lmp_light_color(i: i32, p: vec3f) -> vec3f {
    return lmp_light_radiance(i);
}

fn lmp_light_lit(i: i32, p: vec3f) -> bool {
    return true;
}
