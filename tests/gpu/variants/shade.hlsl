/* SPDX-License-Identifier: MIT */
/* The HLSL variants as a user includes them: one thread a surface, whose values are those of values.h in
 * their order. GGX is defined for its lobes. */
[[vk::binding(0)]] StructuredBuffer<float4> given;
[[vk::binding(1)]] RWStructuredBuffer<float> values;
[[vk::binding(2)]] StructuredBuffer<uint> words;
static const int GIVEN_SURFACES = 2 * LIGHTS;
static const int GIVEN_TEXELS = GIVEN_SURFACES + 3 * SURFACES;
static const int GIVEN_AREAS = GIVEN_TEXELS + TEXELS;
static const int GIVEN_PROBE = GIVEN_AREAS + 11 * 4;

#define LMP_LIGHT_COUNT        LIGHTS
#define LMP_LIGHT_SPHERE(i)    given[2 * (i)]
#define LMP_LIGHT_RADIANCE(i)  given[2 * (i) + 1].rgb
#define LMP_LIGHT_FIXED(i)     (given[2 * (i) + 1].w > 0.5)
#if AREAS > 0
#define LMP_AREA_COUNT         AREAS
#define LMP_AREA_TEXEL(i, k)   given[GIVEN_AREAS + 11 * (i) + (k)]
#endif
#ifdef GGX
#define LMP_GGX_TEXEL(i)       given[GIVEN_TEXELS + (i)]
#include "ggx.hlsl"
#endif
#include "lampion.hlsl"
#include "coat.hlsl"
#include "coefficients.hlsl"
#include "probe.hlsl"
#if AREAS > 0
#include "area.hlsl"
#endif

/* Two numbers of 16 bits, -1 … 1. */
float2 unpack(uint bits) {
    int2 both = int2(bits << 16, bits) >> 16;
    return max(float2(both) / 32767.0, -1.0);
}
float2 pair_at(int2 i) {
    return unpack(words[words[2] + i.y * 256 + i.x]);
}
float3 texel_at(int2 i) {
    uint at = words[6] + 2 * (i.y * 512 + i.x);
    return float3(unpack(words[at]), unpack(words[at + 1]).x);
}
float2 read_pair(float2 p) {
    int2 i = int2(floor(p - 0.5));
    float2 f = p - 0.5 - float2(i);
    return lerp(lerp(pair_at(i), pair_at(i + int2(1, 0)), f.x), lerp(pair_at(i + int2(0, 1)), pair_at(i + int2(1, 1)), f.x), f.y);
}
float3 read_texel(float2 p) {
    int2 i = int2(floor(p - 0.5));
    float2 f = p - 0.5 - float2(i);
    return lerp(lerp(texel_at(i), texel_at(i + int2(1, 0)), f.x), lerp(texel_at(i + int2(0, 1)), texel_at(i + int2(1, 1)), f.x), f.y);
}
float4 read_cell(int i) {
    uint at = words[0] + 4 * i;
    return float4(asfloat(words[at]), asfloat(words[at + 1]), asfloat(words[at + 2]), asfloat(words[at + 3]));
}
#define LMP_PREINTEGRATED_LOBE_PAIR(p)  read_pair(p)
#define LMP_PREINTEGRATED_LOBE_CELL(i)  read_cell(i)
#define LMP_PREINTEGRATED_LOBE_REMAP(i) asfloat(words[words[1] + (i)])
#define LMP_PREINTEGRATED_LOBE_SHAPE    float4(asfloat(words[3]), float(words[4]), 0.0, 0.0)
#define LMP_PREINTEGRATED_BRDF_TEXEL(p) read_texel(p)
#define LMP_PREINTEGRATED_BRDF_VALUE(i) asfloat(words[words[5] + (i)])
#include "preintegrated_lookup.h"
#include "preintegrated_lobe.hlsl"
#include "preintegrated_brdf.hlsl"

static int at;
void put(float x) {
    values[at] = x;
    at++;
}
void put3(float3 v) {
    put(v.x);
    put(v.y);
    put(v.z);
}

void put_parts(lmp_surface surface) {
    float4 first[3] = { given[GIVEN_PROBE], given[GIVEN_PROBE + 1], given[GIVEN_PROBE + 2] };
    float4 second[3] = { given[GIVEN_PROBE + 3], given[GIVEN_PROBE + 4], given[GIVEN_PROBE + 5] };
    float3 sum = float3(0.0, 0.0, 0.0);
    put3(lmp_probe_irradiance(first, second, given[GIVEN_PROBE + 6], surface.normal));
    for (int i = 0; i < LIGHTS; i++)
        sum += lmp_light_color(i, surface.position) * lmp_cap_irradiance(lmp_light_find_cap(i, surface.position), surface.normal);
    put3(sum);
#if AREAS > 0
    for (int k = 0; k < 4; k++)
        put(lmp_area_irradiance(k, surface.position, surface.normal));
#else
    at += 4;
#endif
    put(lmp_coated(lmp_make_coat(0.8, 0.3), surface.normal, surface.view));
}

#ifdef GGX
void put_ggx(lmp_surface surface, float roughness, int k) {
    lmp_metallic_roughness metal = lmp_make_metallic_roughness(float3(0.9, 0.6, 0.3), 0.7, roughness);
    lmp_coat coat = lmp_make_coat(0.8, 0.3);
    float part = lmp_coated(coat, surface.normal, surface.view);
    float3 under = lmp_shade_zonal(surface, metal);
    put3(under);
    put3(lmp_shade_coefficients(surface, metal));
    put3(lmp_shade_preintegrated(surface, metal));
    put3((1.0 - part) * under + lmp_shade_zonal(surface, lmp_lobes_of(surface, coat)));
    lmp_ggx_node node = lmp_ggx_lookup(surface.normal, surface.view, roughness);
    lmp_ggx_lobe lobe = lmp_ggx_lobe_at(node, surface.normal, surface.view, k);
    put3(lobe.axis);
    put(lobe.exponent);
    put(lobe.f0);
    put(lobe.f90);
    put(lmp_ggx_diffuse_f90(node));
}
void make_phong(float exponent, out float second[LMP_BANDS]) {
    float3 lambda[LMP_BANDS];
    lmp_lobe_make_phong(float3(1.0, exponent, 2.0), lambda);
    for (int l = 0; l < LMP_BANDS; l++)
        second[l] = lambda[l].y;
}
#else
void put_ggx(lmp_surface surface, float roughness, int k) {
    at += 19;
}
void make_phong(float exponent, out float lambda[LMP_BANDS]) {
    lmp_lobe_make_phong(exponent, lambda);
}
#endif

void put_arrays(lmp_surface surface, float exponent) {
    float lobe[LMP_BANDS], diffuse[LMP_BANDS], series[LMP_BANDS], sh[LMP_SH_COUNT];
    int l;
    make_phong(exponent, lobe);
    lmp_lobe_make_diffuse(diffuse);
    lmp_cap_series(lmp_cap_of_sphere(given[0], surface.position), series);
    for (l = 0; l < LMP_BANDS; l++)
        put(lobe[l]);
    for (l = 0; l < LMP_BANDS; l++)
        put(diffuse[l]);
    for (l = 0; l < LMP_BANDS; l++)
        put(lmp_window_weight(l));
    for (l = 0; l < LMP_BANDS; l++)
        put(series[l]);
    lmp_sphere_project(given[0], surface.position, sh);
    for (l = 0; l < LMP_SH_COUNT; l++)
        put(sh[l]);
    lmp_sh_eval(surface.normal, sh);
    for (l = 0; l < LMP_SH_COUNT; l++)
        put(sh[l]);
}

[numthreads(SURFACES, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
    int own = GIVEN_SURFACES + 3 * id.x;
    lmp_surface surface = lmp_make_surface(given[own].xyz, given[own + 1].xyz, given[own + 2].xyz);
    lmp_material clay = lmp_make_material(float3(0.8, 0.4, 0.3), float3(0.04, 0.05, 0.06), 30.0);
    at = id.x * (42 + 4 * LMP_BANDS + 2 * LMP_SH_COUNT);
    put3(lmp_shade_zonal(surface, clay));
    put3(lmp_shade_coefficients(surface, clay));
    put3(lmp_shade_preintegrated(surface, clay));
    put3(lmp_shade_preintegrated_brdf(surface, 0));
    put_parts(surface);
    put_ggx(surface, given[own].w, id.x % 5);
    put_arrays(surface, 200.0 * given[own].w);
}
