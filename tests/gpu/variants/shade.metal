/* SPDX-License-Identifier: MIT */
/* The Metal variants, as a user includes them: inside a struct that holds what they read. */
#define LMP_BANDS 6
#define LMP_WINDOW LMP_WINDOW_HANNING
#define LMP_LIGHT_COUNT        LIGHTS
#define LMP_LIGHT_SPHERE(i)    given[2 * (i)]
#define LMP_LIGHT_RADIANCE(i)  given[2 * (i) + 1].rgb
#define LMP_GGX_TEXEL(i)       given[2 * LIGHTS + 3 * SURFACES + (i)]
#define LMP_AREA_COUNT         AREAS
#define LMP_AREA_TEXEL(i, k)   given[2 * LIGHTS + 3 * SURFACES + TEXELS + 11 * (i) + (k)]
#define LMP_PREINTEGRATED_LOBE_PAIR(p)  float2((p).x, 0.0)
#define LMP_PREINTEGRATED_LOBE_CELL(i)  given[i]
#define LMP_PREINTEGRATED_LOBE_REMAP(i) given[i].x
#define LMP_PREINTEGRATED_LOBE_SHAPE    given[0]
#define LMP_PREINTEGRATED_BRDF_TEXEL(p) float3((p).x, 0.0, 0.0)
#define LMP_PREINTEGRATED_BRDF_VALUE(i) given[i].x

struct lampion {
    constant float4 *given;
#include "ggx.metal"
#include "lampion.metal"
#include "coat.metal"
#include "coefficients.metal"
#include "area.metal"
#include "probe.metal"
#include "preintegrated_lookup.h"
#include "preintegrated_lobe.metal"
#include "preintegrated_brdf.metal"
};

/* Computes the four values of surface i. */
inline void shade(constant float4 *given, int i, float4 *values) {
    lampion lit = { given };
    constant float4 *at = given + 2 * LIGHTS + 3 * i;
    lampion::lmp_surface surface = lit.lmp_make_surface(at[0].xyz, at[1].xyz, at[2].xyz);
    lampion::lmp_material clay =
        lit.lmp_make_material(float3(0.8, 0.4, 0.3), float3(0.04, 0.05, 0.06), 30.0);
    lampion::lmp_metallic_roughness metal =
        lit.lmp_make_metallic_roughness(float3(0.9, 0.6, 0.3), 0.7, at[0].w);
    float sh[LMP_SH_COUNT];
    lit.lmp_sphere_project(given[0], surface.position, sh);
    values[0] = float4(lit.lmp_shade_zonal(surface, clay), 0.0);
    values[1] = float4(lit.lmp_shade_zonal(surface, metal), 0.0);
    values[2] = float4(lit.lmp_shade_coefficients(surface, metal), 0.0);
    values[3] = float4 { sh[1], sh[4], sh[20], sh[35] };
}
