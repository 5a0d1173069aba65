/* SPDX-License-Identifier: MIT */
/* inputs.h - what the kernels are run on: spheres, points and directions, the worst first. */
#ifndef LAMPION_INPUTS_H
#define LAMPION_INPUTS_H

#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 67, LIGHTS = 7 };

/* Elements 0 … SPECIAL-1 are worst cases, the rest random. Coordinates are multiples of 2^-10, so
 * that center - point is exact and the oracle sees the same geometry. */
typedef struct inputs {
    _Alignas(64) float center[3][COUNT + 16], point[3][COUNT + 16], axis[3][COUNT + 16];
    _Alignas(64) float radius[COUNT + 16], distance[COUNT + 16];
    _Alignas(64) float rgb[3][COUNT + 16];
    _Alignas(64) float normal[3][COUNT + 16], view[3][COUNT + 16], exponent[COUNT + 16];
} inputs;

static const float special[][4] = {
    /* center - point, radius */
    { 0, 0, 1, 1 },          /* touching, at the pole */
    { 3, 4, 0, 5 },          /* touching, on the horizon */
    { 0, 0, 1, 2 },          /* inside */
    { 0.25f, 0.5f, -1, 4 },  /* inside */
    { 0, 0, 0, 1 },          /* at the center */
    { 0, 0, 0, 0 },          /* nothing is seen */
    { 1, 0, 0, 1e-6f },      /* tiny, on an axis */
    { 0, -1, 0, 1e-6f },     /* tiny */
    { 0, 0, -1, 0.5f },      /* south pole */
    { 1024, 1, -3, 0.001f }, /* far */
    { -1, 0, 0, 0.999f },    /* almost touching */
    { 0.0009765625f, 0, 1, 0.25f },
    { 1, 2, 2, 0 }, /* size 0 */
};
enum { SPECIAL = sizeof special / sizeof *special };

/* The state of a linear congruence, whose bits give the same numbers on every machine, for the
 * checksums. */
static uint64_t grid_state;
static float grid(float scale) {
    grid_state = grid_state * 6364136223846793005u + 1442695040888963407u;
    return (float)((int)(grid_state >> 53) - 1024) * scale;
}

static void set_seed(uint64_t seed) {
    grid_state = seed;
}

static void set_unit(float (*at)[COUNT + 16], int i, float x, float y, float z) {
    const float length = sqrtf(x * x + y * y + z * z);
    at[0][i] = length > 0 ? x / length : 0;
    at[1][i] = length > 0 ? y / length : 0;
    at[2][i] = length > 0 ? z / length : 1;
}

/* Makes surfaces: normals along the axes and views along them, level and from below, then any. The
 * first 32 have all sorts of exponents; after that neighbors share one. */
static void surfaces_create(inputs *in) {
    static const float worst[][6] = { { 0, 0, 1, 0, 0, 1 },
                                      { 0, 1, 0, 0, 1, 0 },
                                      { -1, 0, 0, 0, 0, 1 },
                                      { 0, 0, 1, 0, 0, -1 },
                                      { 0, 1, 0, 8, 0.5f, 0 } };
    static const float exponents[] = { 0, 1, 2, 3.5f, 10, 100, 1000, 10000 };
    for (int i = 0; i < COUNT + 16; i++) {
        float v[6];
        for (int k = 0; k < 6; k++)
            v[k] = i < 5 ? worst[i][k] : grid(1.0f / 1024);
        set_unit(in->normal, i, v[0], v[1], v[2]);
        set_unit(in->view, i, v[3], v[4], v[5]);
        in->exponent[i] = i < 32 ? exponents[i % 8] : 50;
    }
}

static inputs *inputs_create(uint64_t seed) {
    inputs *in = aligned_alloc(_Alignof(inputs), sizeof *in);
    assert_non_null(in);
    memset(in, 0, sizeof *in);
    set_seed(seed);
    for (int i = 0; i < COUNT + 16; i++) {
        float v[3], length = 0;
        for (int k = 0; k < 3; k++) {
            in->point[k][i] = grid(1.0f / 1024);
            v[k] = i < SPECIAL ? special[i][k] : grid(1.0f / 256);
            in->center[k][i] = in->point[k][i] + v[k];
            in->axis[k][i] = grid(1.0f / 1024);
            length += in->axis[k][i] * in->axis[k][i];
            in->rgb[k][i] = 1 + grid(1.0f / 2048);
        }
        for (int k = 0; k < 3; k++)
            in->axis[k][i] = length > 0 ? in->axis[k][i] / sqrtf(length) : k == 2 ? 1.0f : 0.0f;
        in->distance[i] = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        const float fraction = 0.5f + grid(1.0f / 2200);
        in->radius[i] = i < SPECIAL ? special[i][3] : in->distance[i] * fraction * fraction;
    }
    surfaces_create(in);
    return in;
}

#endif
