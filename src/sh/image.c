/* SPDX-License-Identifier: MIT */
/* image.c - images of the surroundings onto coefficients: latitude-longitude and cube maps.
 *
 * Texels go through in runs of a row. The recurrences of sh run for a whole run at once, a few
 * orders m a pass, and what a run adds is summed in double, so that no number of texels loses
 * digits. The order of every sum is fixed: the result depends on the input alone. */
#include "src/base/precondition.h"
#include "src/sh/column.h"

#include <lampion/sh.h>

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum {
    RUN = 64,    /* texels */
    LANES = 8,   /* partial sums of a run */
    ORDERS = 3,  /* orders m a pass: one pass does for irradiance */
    CHANNELS = 4 /* a pass */
};

/* Texels in a row: directions, and values times their solid angles, 0 past the last. */
typedef struct run {
    float x[RUN], y[RUN], z[RUN];
    float value[CHANNELS][RUN];
} run;

typedef struct sums {
    double cosine[ORDERS][CHANNELS][LMP_BANDS_MAX], sine[ORDERS][CHANNELS][LMP_BANDS_MAX];
} sums;

/* --- texels ----------------------------------------------------------------------------------- */

/* Where a texel's channels lie, all strides in bytes. */
typedef struct grid {
    lmp_texel texel;
    size_t row_stride, texel_stride, channel_stride;
} grid;

static grid grid_of(lmp_texel texel, int width, int channels, size_t row_stride,
                    size_t texel_stride, size_t channel_stride) {
    const size_t size = texel == LMP_TEXEL_HALF ? 2 : 4;
    grid g = { texel, row_stride, texel_stride, channel_stride };
    if (g.channel_stride == 0)
        g.channel_stride = size;
    if (g.texel_stride == 0)
        g.texel_stride = (size_t)channels * size;
    if (g.row_stride == 0)
        g.row_stride = (size_t)width * g.texel_stride;
    return g;
}

static float float_of_half(uint16_t half) {
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    float value;
    if (exponent == 31)
        value = mantissa ? NAN : INFINITY;
    else
        value =
            ldexpf((float)(exponent ? mantissa + 1024 : mantissa), (exponent ? exponent : 1) - 25);
    return half >> 15 ? -value : value;
}

static float texel_at(const grid *g, const void *pixels, int row, int column, int channel) {
    const char *at = (const char *)pixels + (size_t)row * g->row_stride +
                     (size_t)column * g->texel_stride + (size_t)channel * g->channel_stride;
    if (g->texel == LMP_TEXEL_HALF) {
        uint16_t half;
        memcpy(&half, at, sizeof half);
        return float_of_half(half);
    }
    float value;
    memcpy(&value, at, sizeof value);
    return value;
}

/* Sets entry i of a run; w need not be unit. */
static void run_set(run *r, int i, const double w[3], double solid_angle, const grid *g,
                    const void *pixels, int row, int column, int first, int channels) {
    const double scale = 1 / sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    r->x[i] = (float)(w[0] * scale);
    r->y[i] = (float)(w[1] * scale);
    r->z[i] = (float)(w[2] * scale);
    for (int c = 0; c < channels; c++)
        r->value[c][i] = (float)((double)texel_at(g, pixels, row, column, first + c) * solid_angle);
}

/* --- sums ------------------------------------------------------------------------------------- */

static double run_dot(const float *a, const float *b) {
    float part[LANES] = { 0 };
    for (int i = 0; i < RUN; i += LANES)
        for (int k = 0; k < LANES; k++)
            part[k] += a[i + k] * b[i + k];
    double sum = 0;
    for (int k = 0; k < LANES; k++)
        sum += (double)part[k];
    return sum;
}

/* (x + iy)^m of every texel of a run. */
static void run_azimuths(const run *r, int m, float *c, float *s) {
    for (int i = 0; i < RUN; i++)
        c[i] = 1, s[i] = 0;
    for (; m > 0; m--)
        for (int i = 0; i < RUN; i++) {
            const lmp_azimuth next = lmp_azimuth_next((lmp_azimuth) { c[i], s[i] },
                                                      (lmp_vec3) { r->x[i], r->y[i], r->z[i] });
            c[i] = next.c;
            s[i] = next.s;
        }
}

/* Adds what a run gives to the coefficients ±m, l = m … bands-1, of every channel. */
static void run_add(const run *r, int bands, int m, int channels, double (*cosine)[LMP_BANDS_MAX],
                    double (*sine)[LMP_BANDS_MAX]) {
    const float *a = lmp_table_a + lmp_table_index(m, m);
    const float *b = lmp_table_b + lmp_table_index(m, m);
    float c[RUN], s[RUN], q[RUN], before[RUN] = { 0 }, y[RUN];
    run_azimuths(r, m, c, s);
    for (int i = 0; i < RUN; i++)
        q[i] = lmp_table_diagonal[m];
    for (int l = m; l < bands; l++) {
        if (l > m)
            for (int i = 0; i < RUN; i++) {
                const float next = a[l - m] * r->z[i] * q[i] + b[l - m] * before[i];
                before[i] = q[i];
                q[i] = next;
            }
        for (int i = 0; i < RUN; i++)
            y[i] = q[i] * c[i];
        for (int channel = 0; channel < channels; channel++)
            cosine[channel][l] += run_dot(y, r->value[channel]);
        for (int i = 0; i < RUN; i++)
            y[i] = q[i] * s[i];
        for (int channel = 0; m > 0 && channel < channels; channel++)
            sine[channel][l] += run_dot(y, r->value[channel]);
    }
}

static void sums_write(const sums *sum, int bands, int m, int order, int first, int channels,
                       float *sh) {
    for (int channel = 0; channel < channels; channel++) {
        float *plane = sh + (size_t)(first + channel) * LMP_SH_COUNT(bands);
        for (int l = m; l < bands; l++) {
            plane[LMP_SH_INDEX(l, -m)] = (float)sum->sine[order][channel][l];
            plane[LMP_SH_INDEX(l, m)] = (float)sum->cosine[order][channel][l];
        }
    }
}

/* Fills a run with `count` texels from (row, column) on of image `face`. */
typedef void fill_run(const void *image, const grid *g, int face, int row, int column, int count,
                      int first, int channels, run *r);

/* The coefficients of orders m … m+ORDERS-1 of a few channels. */
static void project_orders(const void *image, const grid *g, fill_run *fill, const int size[3],
                           int bands, int m, int first, int channels, float *sh) {
    const int orders = bands - m < ORDERS ? bands - m : ORDERS;
    sums sum;
    memset(&sum, 0, sizeof sum);
    for (int face = 0; face < size[2]; face++)
        for (int row = 0; row < size[1]; row++)
            for (int column = 0; column < size[0]; column += RUN) {
                run r;
                memset(&r, 0, sizeof r);
                fill(image, g, face, row, column, size[0] - column < RUN ? size[0] - column : RUN,
                     first, channels, &r);
                for (int i = 0; i < orders; i++)
                    run_add(&r, bands, m + i, channels, sum.cosine[i], sum.sine[i]);
            }
    for (int i = 0; i < orders; i++)
        sums_write(&sum, bands, m + i, i, first, channels, sh);
}

static void project(const void *image, const grid *g, fill_run *fill, const int size[3], int bands,
                    int channels, float *sh) {
    assert(lmp_is_bands(bands));
    for (int first = 0; first < channels; first += CHANNELS)
        for (int m = 0; m < bands; m += ORDERS)
            project_orders(image, g, fill, size, bands, m, first,
                           channels - first < CHANNELS ? channels - first : CHANNELS, sh);
}

/* --- latitude-longitude ------------------------------------------------------------------------
 */

static void latlong_run(const void *image, const grid *g, int face, int row, int column, int count,
                        int first, int channels, run *r) {
    const lmp_latlong *map = image;
    (void)face;
    const double top = cos(pi * row / map->height), bottom = cos(pi * (row + 1) / map->height);
    const double solid_angle = (top - bottom) * 2 * pi / map->width;
    const double polar = pi * (row + 0.5) / map->height;
    for (int i = 0; i < count; i++) {
        const double across = 2 * pi * (column + i + 0.5) / map->width - pi;
        const double azimuth = (map->mirrored ? -across : across) + (double)map->azimuth;
        const double a = sin(polar) * cos(azimuth), b = sin(polar) * sin(azimuth), up = cos(polar);
        const double w[3] = { a, map->z_up ? -b : up, map->z_up ? up : b };
        run_set(r, i, w, solid_angle, g, map->pixels, row, column + i, first, channels);
    }
}

void lmp_sh_project_latlong(int bands, const lmp_latlong *image, float *sh) {
    assert(image->pixels && image->width >= 1 && image->height >= 1 && image->channels >= 1);
    assert(isfinite(image->azimuth));
    const grid g = grid_of(image->texel, image->width, image->channels, image->row_stride,
                           image->texel_stride, image->channel_stride);
    const int size[3] = { image->width, image->height, 1 };
    project(image, &g, latlong_run, size, bands, image->channels, sh);
}

/* --- cube maps ---------------------------------------------------------------------------------
 */

/* A face: the axes of increasing column and row, and the axis it is on (OpenGL 4.6, table 8.19). */
static const signed char face_axes[6][3][3] = {
    { { 0, 0, -1 }, { 0, -1, 0 }, { 1, 0, 0 } }, { { 0, 0, 1 }, { 0, -1, 0 }, { -1, 0, 0 } },
    { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },   { { 1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } },
    { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 } },  { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } },
};

/* The solid angle of the rectangle from the center of a face to (u, v) on it. */
static double corner_angle(double u, double v) {
    return atan2(u * v, sqrt(u * u + v * v + 1));
}

static void cube_run(const void *image, const grid *g, int face, int row, int column, int count,
                     int first, int channels, run *r) {
    const lmp_cubemap *map = image;
    const double step = 2.0 / map->size, v = step * (row + 0.5) - 1;
    const double v0 = step * row - 1, v1 = step * (row + 1) - 1;
    for (int i = 0; i < count; i++) {
        const double u = step * (column + i + 0.5) - 1;
        const double u0 = step * (column + i) - 1, u1 = step * (column + i + 1) - 1;
        const double solid_angle = (corner_angle(u1, v1) - corner_angle(u0, v1)) -
                                   (corner_angle(u1, v0) - corner_angle(u0, v0));
        double w[3];
        for (int k = 0; k < 3; k++)
            w[k] = face_axes[face][0][k] * u + face_axes[face][1][k] * v + face_axes[face][2][k];
        if (map->left_handed)
            w[2] = -w[2];
        run_set(r, i, w, solid_angle, g, map->faces[face], row, column + i, first, channels);
    }
}

void lmp_sh_project_cubemap(int bands, const lmp_cubemap *map, float *sh) {
    assert(map->size >= 1 && map->channels >= 1);
    const grid g = grid_of(map->texel, map->size, map->channels, map->row_stride, map->texel_stride,
                           map->channel_stride);
    const int size[3] = { map->size, map->size, 6 };
    project(map, &g, cube_run, size, bands, map->channels, sh);
}
