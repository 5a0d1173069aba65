/* SPDX-License-Identifier: MIT */
/* The Metal variants, as a user includes them: inside a struct that holds what they read. The values are
 * those of values.h in their order. */
#define LMP_BANDS 6
#define LMP_WINDOW LMP_WINDOW_HANNING
#define GIVEN_SURFACES (2 * LIGHTS)
#define GIVEN_TEXELS   (GIVEN_SURFACES + 3 * SURFACES)
#define GIVEN_AREAS    (GIVEN_TEXELS + TEXELS)
#define GIVEN_PROBE    (GIVEN_AREAS + 11 * AREAS)
#define LMP_LIGHT_COUNT        LIGHTS
#define LMP_LIGHT_SPHERE(i)    given[2 * (i)]
#define LMP_LIGHT_RADIANCE(i)  given[2 * (i) + 1].rgb
#define LMP_LIGHT_FIXED(i)     (given[2 * (i) + 1].w > 0.5f)
#define LMP_GGX_TEXEL(i)       given[GIVEN_TEXELS + (i)]
#define LMP_AREA_COUNT         AREAS
#define LMP_AREA_TEXEL(i, k)   given[GIVEN_AREAS + 11 * (i) + (k)]
#define LMP_PREINTEGRATED_LOBE_PAIR(p)  read_pair(p)
#define LMP_PREINTEGRATED_LOBE_CELL(i)  read_cell(i)
#define LMP_PREINTEGRATED_LOBE_REMAP(i) number(words[1] + (i))
#define LMP_PREINTEGRATED_LOBE_SHAPE    float4(float3(number(3), words[4], 0.0), 0.0)
#define LMP_PREINTEGRATED_BRDF_TEXEL(p) read_texel(p)
#define LMP_PREINTEGRATED_BRDF_VALUE(i) number(words[5] + (i))

struct lampion {
    constant float4 *given;
    constant uint *words;

    float number(int i) {
        return as_type<float>(words[i]);
    }
    float4 read_cell(int i) {
        int at = words[0] + 4 * i;
        return float4(float3(number(at), number(at + 1), number(at + 2)), number(at + 3));
    }
    /* Two numbers of 16 bits, -1 … 1. */
    float2 unpack(uint bits) {
        return float2(max(short(bits & 0xffffu) / 32767.0f, -1.0f), max(short(bits >> 16) / 32767.0f, -1.0f));
    }
    float2 pair_at(int x, int y) {
        return unpack(words[words[2] + 256 * y + x]);
    }
    float3 texel_at(int x, int y) {
        int at = words[6] + 2 * (512 * y + x);
        float2 first = unpack(words[at]), second = unpack(words[at + 1]);
        return float3(first.x, first.y, second.x);
    }
    float2 read_pair(float2 p) {
        float2 corner = floor(p - 0.5f), f = p - 0.5f - corner;
        int x = int(corner.x), y = int(corner.y);
        return mix(mix(pair_at(x, y), pair_at(x + 1, y), f.x), mix(pair_at(x, y + 1), pair_at(x + 1, y + 1), f.x), f.y);
    }
    float3 read_texel(float2 p) {
        float2 corner = floor(p - 0.5f), f = p - 0.5f - corner;
        int x = int(corner.x), y = int(corner.y);
        return mix(mix(texel_at(x, y), texel_at(x + 1, y), f.x), mix(texel_at(x, y + 1), texel_at(x + 1, y + 1), f.x), f.y);
    }
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

inline float *put(float *to, float x) {
    *to = x;
    return to + 1;
}
inline float *put3(float *to, float3 v) {
    return put(put(put(to, v.x), v.y), v.z);
}
inline float *put_all(float *to, const float *from, int count) {
    for (int i = 0; i < count; i++)
        to = put(to, from[i]);
    return to;
}

inline float *put_parts(lampion &lit, lampion::lmp_surface surface, float *to) {
    constant float4 *probe = lit.given + GIVEN_PROBE;
    float4 first[3] = { probe[0], probe[1], probe[2] }, second[3] = { probe[3], probe[4], probe[5] };
    float3 sum = float3(0.0);
    to = put3(to, lit.lmp_probe_irradiance(first, second, probe[6], surface.normal));
    for (int i = 0; i < LIGHTS; i++)
        sum += lit.lmp_light_color(i, surface.position) *
               lit.lmp_cap_irradiance(lit.lmp_light_find_cap(i, surface.position), surface.normal);
    to = put3(to, sum);
    for (int i = 0; i < AREAS; i++)
        to = put(to, lit.lmp_area_irradiance(i, surface.position, surface.normal));
    return put(to, lit.lmp_coated(lit.lmp_make_coat(0.8, 0.3), surface.normal, surface.view));
}

inline float *put_ggx(lampion &lit, lampion::lmp_surface surface, float roughness, int k, float *to) {
    lampion::lmp_metallic_roughness metal =
        lit.lmp_make_metallic_roughness(float3(0.9, 0.6, 0.3), 0.7, roughness);
    lampion::lmp_coat coat = lit.lmp_make_coat(0.8, 0.3);
    float part = lit.lmp_coated(coat, surface.normal, surface.view);
    float3 under = lit.lmp_shade_zonal(surface, metal);
    to = put3(to, under);
    to = put3(to, lit.lmp_shade_coefficients(surface, metal));
    to = put3(to, lit.lmp_shade_preintegrated(surface, metal));
    to = put3(to, (1.0f - part) * under + lit.lmp_shade_zonal(surface, lit.lmp_lobes_of(surface, coat)));
    lampion::lmp_ggx_node node = lit.lmp_ggx_lookup(surface.normal, surface.view, roughness);
    lampion::lmp_ggx_lobe lobe = lit.lmp_ggx_lobe_at(node, surface.normal, surface.view, k);
    to = put(put3(to, lobe.axis), lobe.exponent);
    return put(put(put(to, lobe.f0), lobe.f90), lit.lmp_ggx_diffuse_f90(node));
}

inline void put_arrays(lampion &lit, lampion::lmp_surface surface, float exponent, float *to) {
    float3 lambda[LMP_BANDS];
    float array[LMP_BANDS], sh[LMP_SH_COUNT];
    lit.lmp_lobe_make_phong(float3(1.0, exponent, 2.0), lambda);
    for (int l = 0; l < LMP_BANDS; l++)
        to = put(to, lambda[l].y);
    lit.lmp_lobe_make_diffuse(array);
    to = put_all(to, array, LMP_BANDS);
    for (int l = 0; l < LMP_BANDS; l++)
        to = put(to, lit.lmp_window_weight(l));
    lit.lmp_cap_series(lit.lmp_cap_of_sphere(lit.given[0], surface.position), array);
    to = put_all(to, array, LMP_BANDS);
    lit.lmp_sphere_project(lit.given[0], surface.position, sh);
    to = put_all(to, sh, LMP_SH_COUNT);
    lit.lmp_sh_eval(surface.normal, sh);
    put_all(to, sh, LMP_SH_COUNT);
}

/* How many values a surface has. */
#define VALUES (42 + 4 * LMP_BANDS + 2 * LMP_SH_COUNT)

/* Computes the values of surface i. */
inline void shade(constant float4 *given, constant uint *words, int i, float *to) {
    lampion lit = { given, words };
    constant float4 *at = given + GIVEN_SURFACES + 3 * i;
    lampion::lmp_surface surface = lit.lmp_make_surface(at[0].xyz, at[1].xyz, at[2].xyz);
    lampion::lmp_material clay =
        lit.lmp_make_material(float3(0.8, 0.4, 0.3), float3(0.04, 0.05, 0.06), 30.0);
    to = put3(to, lit.lmp_shade_zonal(surface, clay));
    to = put3(to, lit.lmp_shade_coefficients(surface, clay));
    to = put3(to, lit.lmp_shade_preintegrated(surface, clay));
    to = put3(to, lit.lmp_shade_preintegrated_brdf(surface, 0));
    to = put_parts(lit, surface, to);
    to = put_ggx(lit, surface, at[0].w, i % 5, to);
    put_arrays(lit, surface, 200.0f * at[0].w, to);
}
