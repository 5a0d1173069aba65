/* SPDX-License-Identifier: MIT */
/* The HLSL variants as a user includes them: one thread and four values per surface. With WHOLE it
 * also calls what reads textures. */
#define LMP_BANDS 6
#define LMP_WINDOW LMP_WINDOW_HANNING
[[vk::binding(0)]] StructuredBuffer<float4> given;
[[vk::binding(1)]] RWStructuredBuffer<float4> values;
#define LMP_LIGHT_COUNT        LIGHTS
#define LMP_LIGHT_SPHERE(i)    given[2 * (i)]
#define LMP_LIGHT_RADIANCE(i)  given[2 * (i) + 1].rgb
#define LMP_GGX_TEXEL(i)       given[2 * LIGHTS + 3 * SURFACES + (i)]
#define LMP_AREA_COUNT         AREAS
#define LMP_AREA_TEXEL(i, k)   given[2 * LIGHTS + 3 * SURFACES + TEXELS + 11 * (i) + (k)]
#include "ggx.hlsl"
#include "lampion.hlsl"
#include "coat.hlsl"
#include "coefficients.hlsl"
#include "area.hlsl"
#include "probe.hlsl"
#ifdef WHOLE
Texture2D<float2> pairs;
Texture2D<float4> texels;
SamplerState linear_clamp;
Buffer<float> remap, brdf_values;
Buffer<float4> cells;
cbuffer lobe { float4 shape; };
#define LMP_PREINTEGRATED_LOBE_PAIR(p)  pairs.SampleLevel(linear_clamp, (p) / 2048.0, 0.0)
#define LMP_PREINTEGRATED_LOBE_CELL(i)  cells[i]
#define LMP_PREINTEGRATED_LOBE_REMAP(i) remap[i]
#define LMP_PREINTEGRATED_LOBE_SHAPE    shape
#define LMP_PREINTEGRATED_BRDF_TEXEL(p) texels.SampleLevel(linear_clamp, (p) / 4096.0, 0.0).rgb
#define LMP_PREINTEGRATED_BRDF_VALUE(i) brdf_values[i]
#include "preintegrated_lookup.h"
#include "preintegrated_lobe.hlsl"
#include "preintegrated_brdf.hlsl"
#endif

[numthreads(SURFACES, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
    uint at = 2 * LIGHTS + 3 * id.x;
    lmp_surface surface = lmp_make_surface(given[at].xyz, given[at + 1].xyz, given[at + 2].xyz);
    lmp_material clay =
        lmp_make_material(float3(0.8, 0.4, 0.3), float3(0.04, 0.05, 0.06), 30.0);
    lmp_metallic_roughness metal =
        lmp_make_metallic_roughness(float3(0.9, 0.6, 0.3), 0.7, given[at].w);
    float sh[LMP_SH_COUNT];
    lmp_sphere_project(given[0], surface.position, sh);
    values[4 * id.x] = float4(lmp_shade_zonal(surface, clay), 0.0);
    values[4 * id.x + 1] = float4(lmp_shade_zonal(surface, metal), 0.0);
    values[4 * id.x + 2] = float4(lmp_shade_coefficients(surface, metal), 0.0);
    values[4 * id.x + 3] = float4(sh[1], sh[4], sh[20], sh[35]);
#ifdef WHOLE
    float4 rows[3] = { given[0], given[1], given[2] };
    values[id.x] = float4(lmp_shade_preintegrated(surface, metal) +
                              lmp_shade_preintegrated_brdf(surface, 0) +
                              lmp_shade_zonal(surface, lmp_lobes_of(surface, lmp_make_coat(1.0, 0.3))) +
                              lmp_probe_irradiance(rows, rows, given[0], surface.normal),
                          0.0);
#endif
}
