/* SPDX-License-Identifier: MIT */
/* lampion.glsl - sphere lights through spherical harmonics, in one file to include as it is.
 *
 * GLSL 4.20 (3.30 by GL_ARB_shading_language_420pack), Vulkan's, ES 3.00 (set a float precision).
 * The same mathematics as the C library, to rounding; its headers hold the derivations.
 *
 * Define before including
 *   LMP_BANDS                1 … 32, an integer literal: degrees l = 0 … LMP_BANDS-1
 *   LMP_WINDOW               LMP_WINDOW_NONE (default), LMP_WINDOW_HANNING, LMP_WINDOW_LANCZOS:
 *                            damps the ringing of the glossy lobes' truncated series
 *   LMP_WINDOW_SIZE          the band whose weight falls to 0; default LMP_BANDS
 *   LMP_WINDOW_WEIGHTS       in place of these two, LMP_BANDS weights separated by commas
 * and, to have the lmp_shade_… functions,
 *   LMP_LIGHT_COUNT          int: number of lights
 *   LMP_LIGHT_SPHERE(i)      vec4: center and radius of light i, 0 <= i < LMP_LIGHT_COUNT
 *   LMP_LIGHT_RADIANCE(i)    vec3: its radiance, W/(sr m²)
 * and, where some lights are no spheres,
 *   LMP_LIGHT_FIXED(i)       bool: it is the same cap from every point, a sun or a sky; SPHERE(i) is
 *                            then its unit axis and 1 - cos a, a its half angle; default false
 *   LMP_LIGHT_COLOR(i, p)    vec3: its radiance towards p; default LMP_LIGHT_RADIANCE(i). Where
 *                            SPHERE(i).w < 0 it has no size: its intensity or, if fixed, irradiance
 *   LMP_LIGHT_LIT(i, p)      bool: it gives p light, or lmp_shade_zonal leaves it out; default true
 *
 * A fragment shader that is lit by it, all of it:
 *     #version 450 core
 *     #define LMP_BANDS 8
 *     #define LMP_WINDOW LMP_WINDOW_HANNING
 *     uniform vec4 lights[64];
 *     uniform int count;
 *     #define LMP_LIGHT_COUNT count
 *     #define LMP_LIGHT_SPHERE(i) lights[2 * (i)]
 *     #define LMP_LIGHT_RADIANCE(i) lights[2 * (i) + 1].rgb
 *     #include "lampion.glsl"
 *     in vec3 position, normal, view;
 *     out vec4 color;
 *     void main() {
 *         lmp_surface surface = lmp_surface(position, normalize(normal), normalize(view));
 *         lmp_material clay = lmp_material(vec3(0.8, 0.4, 0.3), vec3(0.04), 30.0);
 *         color = vec4(lmp_shade_zonal(surface, clay), 1.0);
 *     }
 * (GLSL has no #include: put this text there; or take GL_GOOGLE_include_directive.) A program of
 * this kind is examples/lanterns.c.
 *
 * What there is
 *   lmp_shade_zonal          radiance to the viewer under all lights: O(LMP_BANDS) a light
 *   lmp_lobes_of, _next      what a surface reflects by, for passes of your own
 *   lmp_cap_irradiance       irradiance under a cap, by its closed form
 *   lmp_cap_response         response of lobes to a cap, by weights that lmp_lobe_weigh makes of
 *   lmp_lobe_make_phong           coefficients lambda_l of lobes: lobe around w: lambda_l Y_lm(w)
 *   lmp_cap_of_light, lmp_cap_series, lmp_window_weight, lmp_view_frame: their parts
 * After this file, coefficients.glsl has the coefficients themselves, for probes and the paper's
 * method, area.glsl lights that are rectangles, disks, tubes and polygons, and
 * preintegrated_lobe.glsl lmp_shade_preintegrated, of one cost for any bands.
 * All of them also take a lmp_metallic_roughness, glTF's material, where ggx.glsl stands before.
 * All names begin with lmp_ or LMP_. Nothing is kept: no uniforms, buffers or bindings.
 *
 * Conventions: directions are unit and point away from the shaded point; lengths are in any one
 * unit; colors are linear. A coefficient (l, m) has the index l*l + l + m, the basis is real and
 * orthonormal with the Condon-Shortley sign: Y_1 = 0.4886 (-y, z, -x). No visibility.
 *
 * A light that touches or contains the point is no special case for the caller: the cap it covers
 * grows on from the hemisphere at its surface to the full sphere at its center, continuously.
 *
 * Loops over bands are macros: every array index in them is a literal, so that a compiler keeps
 * coefficients in registers. An index computed at run time costs ten times the arithmetic. */
#ifndef LAMPION_GLSL
#define LAMPION_GLSL

#define LMP_BANDS_GLSL_MAX 32
#if !defined(LMP_BANDS) || LMP_BANDS < 1 || LMP_BANDS > LMP_BANDS_GLSL_MAX
#error lampion.glsl: define LMP_BANDS as 1 to 32
#endif

#define LMP_WINDOW_NONE    0
#define LMP_WINDOW_HANNING 1
#define LMP_WINDOW_LANCZOS 2
#ifndef LMP_WINDOW
#define LMP_WINDOW LMP_WINDOW_NONE
#endif
#if LMP_WINDOW < LMP_WINDOW_NONE || LMP_WINDOW > LMP_WINDOW_LANCZOS
#error lampion.glsl: define LMP_WINDOW as one of LMP_WINDOW_NONE, LMP_WINDOW_HANNING, LMP_WINDOW_LANCZOS
#endif
#ifndef LMP_WINDOW_SIZE
#define LMP_WINDOW_SIZE float(LMP_BANDS)
#endif

#define LMP_PI       3.14159265358979
#define LMP_SH_COUNT (LMP_BANDS * LMP_BANDS)

/* A point to shade; view points to the viewer. */
struct lmp_surface {
    vec3 position;
    vec3 normal;
    vec3 view;
};

/* diffuse/pi max(n.w, 0) + specular (e+1)/(2 pi) max(r.w, 0)^e, cosine included. */
struct lmp_material {
    vec3 diffuse;
    vec3 specular;
    float exponent;
};

/* Products of a matrix and a vector, which HLSL writes in another way. */
#define LMP_MATRIX_TIMES(m, v) ((m) * (v))
#define LMP_TIMES_MATRIX(v, m) ((v) * (m))

/* Phong lobes of a surface that are summed together: one, or those of GGX, LMP_GGX_LOBES_FEW of
 * them, then the others. */
#ifdef LAMPION_GGX_GLSL
#define LMP_LOBES LMP_GGX_LOBES_FEW
#else
#define LMP_LOBES 1
#endif
/* A number of each of these lobes is an element of a LMP_EACH, and a vector a column of a
 * LMP_EACH_VEC3; LMP_LOBE is the element of lobe k, LMP_DOT(v, m) v times each column, LMP_SUM(m,
 * v) the weighted sum of the columns. */
#ifdef LAMPION_GGX_GLSL
#define LMP_EACH        vec3
#define LMP_EACH_VEC3   mat3
#define LMP_LOBE(of, k) of[k]
#define LMP_DOT(v, m)   LMP_TIMES_MATRIX(v, m)
#define LMP_SUM(m, v)   LMP_MATRIX_TIMES(m, v)
#else
#define LMP_EACH        float
#define LMP_EACH_VEC3   vec3
#define LMP_LOBE(of, k) of
#define LMP_DOT(v, m)   dot(v, m)
#define LMP_SUM(m, v)   ((m) * (v))
#endif

/* What a surface reflects by: diffuse/pi max(n.w, 0), and for each lobe weight (exponent+1)/(2 pi)
 * max(axis.w, 0)^exponent. */
struct lmp_lobes {
    vec3 diffuse;
    LMP_EACH_VEC3 axis, weight;
    LMP_EACH exponent;
#ifdef LAMPION_GGX_GLSL
    bool more; /* whether more lobes follow */
    mat3 more_axis, more_weight;
    vec3 more_exponent;
#endif
};

/* Replaces the lobes summed by those that follow; returns false where none do. */
bool lmp_lobes_next(inout lmp_lobes lobes) {
#ifdef LAMPION_GGX_GLSL
    bool more = lobes.more;
    lobes.diffuse = vec3(0.0);
    lobes.axis = lobes.more_axis;
    lobes.weight = lobes.more_weight;
    lobes.exponent = lobes.more_exponent;
    lobes.more = false;
    return more;
#else
    return false;
#endif
}

/* A sphere light as seen from one point. Its coefficients for radiance 1 are, by paper Eq. 12 and
 * 13 in one,
 *     L_00 = pi base Y_00      L_lm = pi strength R_l Y_lm(axis)   (l >= 1)
 * with R_l = 2 P'_l(a)/(l(l+1)), a = 1 - one_minus_cos. A point inside the light has a < 0; by parity
 * that is the mirrored axis with a negative strength. */
struct lmp_cap {
    vec3 axis;
    float base;      /* 2 (1 - cos a) */
    float strength;  /* sin²a, exact however small; negative inside */
    float one_minus_cos; /* 1 - |cos a|, exact however small */
};

/* X(l) for l = 2 … 31; each body starts with the constant test `if (l < LMP_BANDS)`. */
#define LMP_FOR_BANDS(X)                                                                           \
    X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15) X(16) X(17) X(18)  \
    X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28) X(29) X(30) X(31)
/* An index that stays legal in the blocks that the constant tests remove. */
#define LMP_BAND(l) (l < LMP_BANDS ? l : 0)

/* The weight of band l under LMP_WINDOW, a constant for a constant l. */
#ifdef LMP_WINDOW_WEIGHTS
float lmp_window_weight(int l) {
    const float weights[LMP_BANDS] = float[LMP_BANDS](LMP_WINDOW_WEIGHTS);
    return weights[l];
}
#else
float lmp_window_weight(int l) {
    /* half the angle pi l / size, and its sine: languages promise few digits of their own */
    float x = LMP_PI / 2.0 * float(l) / float(LMP_WINDOW_SIZE), x2 = x * x;
    float series = 1.0 - x2 / 42.0 * (1.0 - x2 / 72.0 * (1.0 - x2 / 110.0));
    float sine = x * (1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * series));
    if (LMP_WINDOW == LMP_WINDOW_NONE || l == 0)
        return 1.0;
    if (float(l) >= float(LMP_WINDOW_SIZE))
        return 0.0;
    return LMP_WINDOW == LMP_WINDOW_HANNING ? 1.0 - sine * sine : sine * sqrt(1.0 - sine * sine) / x;
}
#endif

/* Returns the cap of the sphere (center, radius) seen from a point; that of a Dirac has size 0. */
lmp_cap lmp_cap_of_sphere(vec4 sphere, vec3 from) {
    vec3 v = sphere.xyz - from;
    float d = sqrt(dot(v, v)), r = max(sphere.w, 0.0);
    bool inside = d < r;
    float far = max(max(d, r), 1e-30), near = min(d, r), s = near / far;
    float a = sqrt((far - near) * (far + near)) / far, side = inside ? -1.0 : 1.0;
    lmp_cap cap;
    cap.axis = v * (side / max(d, 1e-30));
    cap.one_minus_cos = s * s / (1.0 + a);
    cap.base = 2.0 * (inside ? 1.0 + a : cap.one_minus_cos);
    cap.strength = side * s * s;
    if (sphere.w < 0.0)
        cap.base = cap.strength = 1.0 / LMP_PI / (max(d, 1e-6) * max(d, 1e-6));
    return cap;
}

/* Returns the cap of the directions up to a from `axis`, 1 - cos a in 0 … 2; below 0, of the axis
 * alone. */
lmp_cap lmp_cap_of_directions(vec3 axis, float one_minus_cos) {
    float side = one_minus_cos > 1.0 ? -1.0 : 1.0, held = max(one_minus_cos, 0.0);
    lmp_cap cap;
    cap.axis = side * axis;
    cap.one_minus_cos = min(held, 2.0 - held);
    cap.base = one_minus_cos < 0.0 ? 1.0 / LMP_PI : 2.0 * held;
    cap.strength = side * cap.one_minus_cos * (2.0 - cap.one_minus_cos);
    cap.strength = one_minus_cos < 0.0 ? cap.base : cap.strength;
    return cap;
}

/* Returns the cap of a light that LMP_LIGHT_SPHERE and LMP_LIGHT_FIXED describe. */
lmp_cap lmp_cap_of_light(vec4 sphere, bool fixed_cap, vec3 from) {
    if (fixed_cap)
        return lmp_cap_of_directions(sphere.xyz, sphere.w);
    return lmp_cap_of_sphere(sphere, from);
}

/* Returns a diffuse lobe and one other. */
lmp_lobes lmp_lobes_of_one(vec3 diffuse, vec3 axis, vec3 weight, float exponent) {
    lmp_lobes lobes;
    lobes.diffuse = diffuse;
    lobes.exponent = LMP_EACH(exponent);
#if LMP_LOBES == 1
    lobes.axis = axis;
    lobes.weight = weight;
#else
    lobes.axis = mat3(axis, axis, axis);
    lobes.weight = mat3(weight, vec3(0.0), vec3(0.0));
    lobes.more = false;
#endif
    return lobes;
}

lmp_lobes lmp_lobes_of(lmp_surface surface, lmp_material material) {
    return lmp_lobes_of_one(material.diffuse, reflect(-surface.view, surface.normal),
                            material.specular, material.exponent);
}

#ifdef LAMPION_GGX_GLSL
/* Returns the lobes of a metal, whose F0 is the base color, mixed with a dielectric, whose base
 * lies under a layer. */
lmp_lobes lmp_lobes_of(lmp_surface surface, lmp_metallic_roughness material, lmp_dielectric layer) {
    lmp_ggx_node node = lmp_ggx_lookup(surface.normal, surface.view, material.roughness);
    vec3 f0 = mix(layer.f0, material.base_color, material.metallic);
    float f90 = layer.f90 + (1.0 - layer.f90) * material.metallic;
    float held = max(layer.f0.r, max(layer.f0.g, layer.f0.b));
    float passed = 1.0 - held - (layer.f90 - held) * lmp_ggx_diffuse_f90(node);
    mat3 axis, weight;
    vec3 exponent;
    lmp_lobes lobes;
    lobes.diffuse = material.base_color * ((1.0 - material.metallic) * passed);
    lmp_ggx_lobes(node, surface.normal, surface.view, 0, f0, f90, axis, weight, exponent);
    lobes.axis = axis;
    lobes.weight = weight;
    lobes.exponent = exponent;
    lobes.more = lmp_ggx_count(node) > LMP_LOBES;
    if (lobes.more)
        lmp_ggx_lobes(node, surface.normal, surface.view, LMP_LOBES, f0, f90, axis, weight, exponent);
    lobes.more_axis = axis;
    lobes.more_weight = weight;
    lobes.more_exponent = exponent;
    return lobes;
}

lmp_lobes lmp_lobes_of(lmp_surface surface, lmp_metallic_roughness material) {
    return lmp_lobes_of(surface, material, lmp_dielectric(vec3(0.04), 1.0));
}
#endif

/* Returns the cosine u of a cap's axis with a normal, clipped by the horizon: a cap of radiance L
 * and half angle a gives pi L sin²a times this; t = 1 - cos a, 0 … 1. Where the horizon cuts it,
 * with q² = sin²a - u²,
 *     pi f = u atan2(q, -u cos a) + (atan2(q, cos a) - q cos a) / sin²a,
 * by the numbers of src/kernels/horizon_tmpl.h, which says why these. */
float lmp_horizon_cosine(float u, float t) {
    float sin2 = t * (2.0 - t), cosine = 1.0 - t;
    if (u * u >= sin2)
        return max(u, 0.0);
    float q2 = max(sin2 - u * u, 1e-30), p2 = q2 + cosine * cosine, q = sqrt(q2), p = sqrt(p2);
    float along = abs(u) * cosine, per_sum = 1.0 / (p + cosine), y = p * per_sum;
    float n = (q - along) / (q + along), n2 = n * n;
    float angle = ((0.0021207465 * n2 - 0.010554982) * n2 + 0.025184294) * n2 - 0.042036485;
    angle = 0.25 + n * (((angle * n2 + 0.0630279) * n2 - 0.10605005) * n2 + 0.31830856);
    float g = ((0.04378761 - 0.00937415 * y) * y - 0.09877415) * y + 0.2402777;
    float second = q / (p2 * sin2) * (q2 * per_sum * (g * y + 0.3240828) + abs(u) * along / LMP_PI);
    return max(u, 0.0) + (second - abs(u) * angle);
}

/* Returns the irradiance under a cap of radiance 1; more than a hemisphere is ambient light less
 * the rest. */
float lmp_cap_irradiance(lmp_cap cap, vec3 normal) {
    float ambient = cap.base > 2.0 && cap.strength <= 0.0 ? 1.0 : 0.0;
    return LMP_PI * (ambient + cap.strength * lmp_horizon_cosine(dot(cap.axis, normal), cap.one_minus_cos));
}

/* Computes lambda_l of (e+1)/(2 pi) max(t, 0)^e, windowed, with exponent e >= 0, for one lobe or
 * for each. */
void lmp_lobe_make_phong(LMP_EACH e, out LMP_EACH lambda[LMP_BANDS]) {
    LMP_EACH l0 = LMP_EACH(1.0), l1 = (e + 1.0) / (e + 2.0), l2;
    lambda[0] = l0;
    if (LMP_BANDS > 1)
        lambda[LMP_BAND(1)] = lmp_window_weight(1) * l1;
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        l2 = l0 * ((e - float(l - 2)) / (e + float(l + 1)));                                       \
        l0 = l1;                                                                                   \
        l1 = l2;                                                                                   \
        lambda[LMP_BAND(l)] = lmp_window_weight(l) * l2;                                           \
    }
    LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
}

/* Computes what multiplies pi Y_lm(axis) in the coefficients of a cap of radiance 1, band by band:
 * strength R_l, by its differences, which keep far lights exact. */
#ifdef LMP_CAP_SERIES /* the includer has another */
void lmp_cap_series(lmp_cap cap, out float R[LMP_BANDS]);
#else
void lmp_cap_series(lmp_cap cap, out float R[LMP_BANDS]) {
    float r = cap.strength, difference = 0.0;
    R[0] = cap.base;
    if (LMP_BANDS > 1)
        R[LMP_BAND(1)] = r;
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        difference = float(l - 2) / float(l + 1) * difference -                                    \
                     float(2 * l - 1) / float(l + 1) * (cap.one_minus_cos * r);                        \
        r += difference;                                                                           \
        R[LMP_BAND(l)] = r;                                                                        \
    }
    LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
}
#endif

#ifdef LMP_LIGHT_COUNT
#ifndef LMP_LIGHT_FIXED
#define LMP_LIGHT_FIXED(i) false
#endif
#ifndef LMP_LIGHT_COLOR
#define LMP_LIGHT_COLOR(i, p) LMP_LIGHT_RADIANCE(i)
#endif
#ifndef LMP_LIGHT_LIT
#define LMP_LIGHT_LIT(i, p) true
#endif
/* Defines a function of a surface and the lobes that are summed together, of a surface and all its
 * lobes, and of a surface and its material; the latter two are clamped at 0. */
#define LMP_SHADE_LOBES(shade, shade_some)                                                         \
    vec3 shade(lmp_surface surface, lmp_lobes lobes) {                                             \
        vec3 sum = vec3(0.0);                                                                      \
        for (bool more = true; more; more = lmp_lobes_next(lobes))                                 \
            sum += shade_some(surface, lobes);                                                     \
        return max(sum, vec3(0.0));                                                                \
    }
#define LMP_SHADE_MATERIAL(shade, type)                                                            \
    vec3 shade(lmp_surface surface, type material) {                                               \
        return shade(surface, lmp_lobes_of(surface, material));                                    \
    }
#ifdef LAMPION_GGX_GLSL
#define LMP_SHADE_MATERIALS(shade, shade_some)                                                     \
    LMP_SHADE_LOBES(shade, shade_some)                                                             \
    LMP_SHADE_MATERIAL(shade, lmp_material) LMP_SHADE_MATERIAL(shade, lmp_metallic_roughness)
#else
#define LMP_SHADE_MATERIALS(shade, shade_some)                                                     \
    LMP_SHADE_LOBES(shade, shade_some) LMP_SHADE_MATERIAL(shade, lmp_material)
#endif
/* What the includer defined is only read here, where no local name can hide one of its own. */
int lmp_light_count() {
    return LMP_LIGHT_COUNT;
}
vec4 lmp_light_sphere(int lmp_i) {
    return LMP_LIGHT_SPHERE(lmp_i);
}
bool lmp_light_fixed(int lmp_i) {
    return LMP_LIGHT_FIXED(lmp_i);
}
vec3 lmp_light_color(int lmp_i, vec3 lmp_p) {
    return LMP_LIGHT_COLOR(lmp_i, lmp_p);
}
bool lmp_light_lit(int lmp_i, vec3 lmp_p) {
    return LMP_LIGHT_LIT(lmp_i, lmp_p);
}

lmp_cap lmp_light_find_cap(int i, vec3 from) {
    return lmp_cap_of_light(lmp_light_sphere(i), lmp_light_fixed(i), from);
}

/* Turns lambda_l of lobes into what multiplies the terms of lmp_cap_response. */
void lmp_lobe_weigh(inout LMP_EACH weights[LMP_BANDS]) {
    float leading = 1.0; /* the coefficient of v^l in P_l */
    weights[0] *= 0.25;
    if (LMP_BANDS > 1)
        weights[LMP_BAND(1)] *= 0.75;
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        leading *= float(2 * l - 1) / float(l);                                                    \
        weights[LMP_BAND(l)] *= float(2 * l + 1) * 0.25 * leading;                                 \
    }
    LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
}

/* Returns the response of Phong lobes to a cap by the addition theorem, O(LMP_BANDS):
 *
 *     sum_l (2l+1)/4 lambda_l R_l P_l(axis.lobe)
 *
 * P_l is carried monic (p_l = v p_(l-1) - b_l p_(l-2)) and the differences of R_l scaled, which
 * saves four products a band; the scales are in the weights. */
LMP_EACH lmp_cap_response(lmp_cap cap, LMP_EACH_VEC3 axis, in LMP_EACH weights[LMP_BANDS]) {
    float r = 1.0, difference = 0.0;
    LMP_EACH v = LMP_DOT(cap.axis, axis), q0 = LMP_EACH(1.0), q1 = v, q2, g = LMP_EACH(0.0);
    if (LMP_BANDS > 1)
        g = weights[LMP_BAND(1)] * v;
    /* difference holds -(l+1)/(2l-1) times R_l - R_(l-1) */
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        difference = float((l - 2) * (2 * l - 3)) / float(l * (2 * l - 1)) * difference +          \
                     cap.one_minus_cos * r;                                                        \
        r -= float(2 * l - 1) / float(l + 1) * difference;                                         \
        q2 = v * q1 - float((l - 1) * (l - 1)) / float((2 * l - 1) * (2 * l - 3)) * q0;            \
        q0 = q1;                                                                                   \
        q1 = q2;                                                                                   \
        g += weights[LMP_BAND(l)] * r * q1;                                                        \
    }
    LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
    return weights[0] * cap.base + cap.strength * g;
}

#ifdef LMP_AREA_COUNT
/* Defined by area.glsl, which follows: the radiance under all areas, with the lobes' weights. */
vec3 lmp_areas_shade(lmp_surface surface, lmp_lobes lobes, in LMP_EACH weights[LMP_BANDS]);
#endif

/* Radiance to the viewer under all lights, O(LMP_BANDS) per light: of the diffuse lobe by the closed
 * form of irradiance, of the others by lmp_cap_response. */
vec3 lmp_shade_some_zonal(lmp_surface surface, lmp_lobes lobes) {
    LMP_EACH weights[LMP_BANDS];
    lmp_lobe_make_phong(lobes.exponent, weights);
    lmp_lobe_weigh(weights);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < lmp_light_count(); i++) {
        if (!lmp_light_lit(i, surface.position))
            continue;
        lmp_cap cap = lmp_light_find_cap(i, surface.position);
        float d = lmp_cap_irradiance(cap, surface.normal) / LMP_PI;
        LMP_EACH g = lmp_cap_response(cap, lobes.axis, weights);
        sum += lmp_light_color(i, surface.position) * (lobes.diffuse * d + LMP_SUM(lobes.weight, g));
    }
#ifdef LMP_AREA_COUNT
    sum += lmp_areas_shade(surface, lobes, weights);
#endif
    return sum;
}

/* Returns the rotation from the world to the frame whose z is the normal and in whose x-z plane the
 * viewer is, x >= 0. */
mat3 lmp_view_frame(lmp_surface surface) {
    vec3 normal = surface.normal;
    vec3 tangent = surface.view - normal * dot(surface.view, normal);
    tangent = dot(tangent, tangent) > 1e-12 ? normalize(tangent)
              : abs(normal.x) < 0.5         ? normalize(cross(normal, vec3(1.0, 0.0, 0.0)))
                                            : normalize(cross(normal, vec3(0.0, 1.0, 0.0)));
    return transpose(mat3(tangent, cross(normal, tangent), normal));
}

LMP_SHADE_MATERIALS(lmp_shade_zonal, lmp_shade_some_zonal)

#endif
#endif
