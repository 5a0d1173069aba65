/* SPDX-License-Identifier: MIT */
/* sums.h - lights for the kernels that sum them, and those that add to what the output holds. */
#ifndef LAMPION_SUMS_H
#define LAMPION_SUMS_H

#include "src/kernels/dispatch.h"
#include "tests/kernels/inputs.h"

#include <lampion/sh.h>

#include <string.h>

static lmpi_kernel_lights lights_of(const inputs *in) {
    return (lmpi_kernel_lights) {
        .center = { in->center[0], in->center[1], in->center[2], sizeof(float) },
        .radius = { in->radius, sizeof(float) },
        .radiance = { in->rgb[0], in->rgb[1], in->rgb[2], sizeof(float) },
        .count = LIGHTS,
    };
}

/* Returns lights of which every other one is a Dirac. */
static lmpi_kernel_lights diracs_of(const inputs *in, float radius[LIGHTS]) {
    lmpi_kernel_lights lights = lights_of(in);
    for (int i = 0; i < LIGHTS; i++)
        radius[i] = i % 2 ? LMPI_DIRAC : in->radius[i];
    lights.radius.at = radius;
    return lights;
}

/* Returns what the output holds before: a different number for every element and value. */
static float held(size_t element, size_t value) {
    return (float)((31 * element + 7 * value) % 64) / 16 - 1;
}

static void hold(size_t values, size_t count, const lmpi_kernel_out *out) {
    for (size_t e = 0; e < count; e++)
        for (size_t v = 0; v < values; v++)
            out->at[out->planar ? v * out->stride + e : e * out->stride + v] = held(e, v);
}

static void run_more(const lmpi_kernels *k, int bands, const inputs *in, size_t count,
                     const lmpi_kernel_out *out) {
    const lmpi_kernel_vec3 point = { in->point[0], in->point[1], in->point[2] };
    const lmpi_kernel_lights lights = lights_of(in);
    hold(3 * LMP_SH_COUNT(bands), count, out);
    k->light.accumulate_more(NULL, bands, &lights, &point, count, out);
}

static void run_diracs(const lmpi_kernels *k, int bands, const inputs *in, size_t count,
                       const lmpi_kernel_out *out) {
    const lmpi_kernel_vec3 point = { in->point[0], in->point[1], in->point[2] };
    float radius[LIGHTS];
    const lmpi_kernel_lights lights = diracs_of(in, radius);
    k->light.accumulate(NULL, bands, &lights, &point, count, out);
}

/* Returns a number for value v. */
static float added(size_t v) {
    return (float)(v % 29) / 8 - 2;
}

/* Adds in two parts, times the elements' distances. */
static void run_add(const lmpi_kernels *k, int bands, const inputs *in, size_t count,
                    const lmpi_kernel_out *out) {
    const size_t values = 3 * LMP_SH_COUNT(bands), first = LMP_SH_COUNT(bands);
    float *sh = malloc(values * sizeof *sh);
    assert_non_null(sh);
    for (size_t v = 0; v < values; v++)
        sh[v] = added(v);
    hold(values, count, out);
    k->light.add(sh, 0, first, in->distance, count, out);
    k->light.add(sh + first, first, values - first, in->distance, count, out);
    free(sh);
}

/* Returns a cone at the first point. */
static lmpi_packed_light cone_of(const inputs *in) {
    return (lmpi_packed_light) { .form = LMPI_FORM_CONE,
                                 .at = { in->point[0][0], in->point[1][0], in->point[2][0] },
                                 .size = LMPI_DIRAC,
                                 .axis = { 0.36f, -0.48f, 0.8f },
                                 .outer = -0.25f,
                                 .width = 0.75f };
}

/* Multiplies the elements' distances by the falloff of a cone. */
static void run_cone(const lmpi_kernels *k, const inputs *in, size_t count,
                     const lmpi_kernel_out *out) {
    const lmpi_kernel_vec3 point = { in->point[0], in->point[1], in->point[2] };
    const lmpi_packed_light cone = cone_of(in);
    _Alignas(64) float factors[COUNT + 16];
    memcpy(factors, in->distance, sizeof factors);
    k->light.cone(&cone, &point, count, factors);
    for (size_t e = 0; e < count; e++)
        out->at[out->planar ? e : e * out->stride] = factors[e];
}

#endif
