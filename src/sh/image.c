/* SPDX-License-Identifier: MIT */
/* image.c - projects images of the surroundings, latitude-longitude and cube maps.
 *
 * Texels go through a kernel in runs of a row, a few orders m a pass, and what a run adds is summed
 * in double, so that no number of texels loses digits. The positions of a run's texels are computed
 * once for all rows or faces that share them. */
#include "src/base/half.h"
#include "src/base/precondition.h"
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"

#include <lampion/sh.h>

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { RUN = LMPI_KERNEL_TEXELS };

/* --- texels ----------------------------------------------------------------------------------- */

/* Where a texel's channels lie, all strides in bytes. */
typedef struct grid {
    lmp_texel texel;
    size_t row_stride, texel_stride, channel_stride;
} grid;

static grid grid_of(lmp_texel texel, int width, int channels, size_t row_stride,
                    size_t texel_stride, size_t channel_stride) {
    assert(texel == LMP_TEXEL_FLOAT || texel == LMP_TEXEL_HALF);
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

/* --- a pass ----------------------------------------------------------------------------------- */

/* What a pass projects: orders m … m+orders-1 of a few channels, and a run of texels. */
typedef struct pass {
    const lmpi_kernels *kernels;
    grid g;
    int bands, m, orders, first, channels;
    _Alignas(64) float x[RUN], y[RUN], z[RUN], value[LMPI_KERNEL_CHANNELS][RUN];
    lmpi_kernel_texel_sums sums;
} pass;

static void read_channel(const pass *p, const char *at, int count, const double *solid_angle,
                         float *value) {
    const size_t stride = p->g.texel_stride;
    if (p->g.texel == LMP_TEXEL_HALF)
        for (int i = 0; i < count; i++) {
            uint16_t half;
            memcpy(&half, at + (size_t)i * stride, sizeof half);
            value[i] = (float)((double)lmpi_float_of_half(half) * solid_angle[i]);
        }
    else
        for (int i = 0; i < count; i++) {
            float texel;
            memcpy(&texel, at + (size_t)i * stride, sizeof texel);
            value[i] = (float)((double)texel * solid_angle[i]);
        }
    lmpi_batch_fill_plane(value, (size_t)count);
}

/* Adds `count` texels from (row, column) on, whose directions are set. */
static void add_run(pass *p, const void *pixels, int row, int column, int count,
                    const double *solid_angle) {
    const char *at =
        (const char *)pixels + (size_t)row * p->g.row_stride + (size_t)column * p->g.texel_stride;
    lmpi_kernel_texels texels = { .direction = { p->x, p->y, p->z }, .channels = p->channels };
    for (int c = 0; c < p->channels; c++) {
        read_channel(p, at + (size_t)(p->first + c) * p->g.channel_stride, count, solid_angle,
                     p->value[c]);
        texels.value[c] = p->value[c];
    }
    p->kernels->sh.image(p->bands, p->m, p->orders, &texels, (size_t)count, &p->sums);
}

static void write_sums(const pass *p, float *sh) {
    for (int c = 0; c < p->channels; c++) {
        float *plane = sh + (size_t)(p->first + c) * LMP_SH_COUNT(p->bands);
        for (int i = 0; i < p->orders; i++)
            for (int m = p->m + i, l = m; l < p->bands; l++) {
                plane[LMP_SH_INDEX(l, -m)] = (float)p->sums.sine[i][c][l];
                plane[LMP_SH_INDEX(l, m)] = (float)p->sums.cosine[i][c][l];
            }
    }
}

/* Adds all texels of an image. */
typedef void add_image(const void *image, pass *p);

static void project(const void *image, grid g, add_image *add, int bands, int channels, float *sh) {
    assert(lmpi_is_bands(bands));
    pass p = { .kernels = lmpi_kernels_get(), .g = g, .bands = bands };
    for (p.first = 0; p.first < channels; p.first += LMPI_KERNEL_CHANNELS) {
        const int left = channels - p.first;
        p.channels = left < LMPI_KERNEL_CHANNELS ? left : LMPI_KERNEL_CHANNELS;
        for (p.m = 0; p.m < bands; p.m += LMPI_KERNEL_ORDERS) {
            p.orders = bands - p.m < LMPI_KERNEL_ORDERS ? bands - p.m : LMPI_KERNEL_ORDERS;
            memset(&p.sums, 0, sizeof p.sums);
            add(image, &p);
            write_sums(&p, sh);
        }
    }
}

/* --- latitude-longitude ----------------------------------------------------------------------- */

static void add_latlong(const void *image, pass *p) {
    const lmp_latlong *map = image;
    double across[2][RUN], solid_angle[RUN];
    for (int column = 0; column < map->width; column += RUN) {
        const int count = map->width - column < RUN ? map->width - column : RUN;
        for (int i = 0; i < count; i++) {
            const double angle = 2 * pi * (column + i + 0.5) / map->width - pi;
            const double azimuth = (map->mirrored ? -angle : angle) + (double)map->azimuth;
            across[0][i] = cos(azimuth);
            across[1][i] = map->z_up ? -sin(azimuth) : sin(azimuth);
        }
        for (int row = 0; row < map->height; row++) {
            const double top = cos(pi * row / map->height);
            const double bottom = cos(pi * (row + 1) / map->height);
            const double polar = pi * (row + 0.5) / map->height;
            const double radius = sin(polar), up = cos(polar);
            float *level = map->z_up ? p->y : p->z, *height = map->z_up ? p->z : p->y;
            for (int i = 0; i < count; i++) {
                p->x[i] = (float)(radius * across[0][i]);
                level[i] = (float)(radius * across[1][i]);
                height[i] = (float)up;
                solid_angle[i] = (top - bottom) * 2 * pi / map->width;
            }
            add_run(p, map->pixels, row, column, count, solid_angle);
        }
    }
}

void lmp_sh_project_latlong(int bands, const lmp_latlong *image, float *sh) {
    assert(image->pixels && image->width >= 1 && image->height >= 1 && image->channels >= 1);
    assert(isfinite(image->azimuth));
    const grid g = grid_of(image->texel, image->width, image->channels, image->row_stride,
                           image->texel_stride, image->channel_stride);
    project(image, g, add_latlong, bands, image->channels, sh);
}

/* --- cube maps -------------------------------------------------------------------------------- */

/* The axes of each face: of increasing column, of increasing row, and the axis it is on (OpenGL
 * 4.6, table 8.19). */
static const signed char face_axes[6][3][3] = {
    { { 0, 0, -1 }, { 0, -1, 0 }, { 1, 0, 0 } }, { { 0, 0, 1 }, { 0, -1, 0 }, { -1, 0, 0 } },
    { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },   { { 1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } },
    { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 } },  { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } },
};

/* Returns the solid angle of the rectangle from the center of a face to (u, v) on it. */
static double corner_angle(double u, double v) {
    return atan2(u * v, sqrt(u * u + v * v + 1));
}

/* What texels of all faces share: their positions on the face, as unit vectors, and their solid
 * angles. */
typedef struct face_run {
    double u[RUN], v[RUN], w[RUN], solid_angle[RUN];
} face_run;

static void set_face_run(int size, int row, int column, int count, face_run *run) {
    const double step = 2.0 / size, v = step * (row + 0.5) - 1;
    const double v0 = step * row - 1, v1 = step * (row + 1) - 1, left = step * column - 1;
    double before = corner_angle(left, v1) - corner_angle(left, v0);
    for (int i = 0; i < count; i++) {
        const double u = step * (column + i + 0.5) - 1, right = step * (column + i + 1) - 1;
        const double scale = 1 / sqrt(u * u + v * v + 1);
        const double after = corner_angle(right, v1) - corner_angle(right, v0);
        run->u[i] = u * scale;
        run->v[i] = v * scale;
        run->w[i] = scale;
        run->solid_angle[i] = after - before;
        before = after;
    }
}

/* Sets coordinate k of the directions of a face's texels. */
static void set_coordinate(const face_run *run, int count, int face, int k, float sign, float *to) {
    const signed char(*axes)[3] = face_axes[face];
    const double *from = axes[0][k] ? run->u : axes[1][k] ? run->v : run->w;
    const double scale = (double)sign * (axes[0][k] + axes[1][k] + axes[2][k]);
    for (int i = 0; i < count; i++)
        to[i] = (float)(scale * from[i]);
}

static void add_cubemap(const void *image, pass *p) {
    const lmp_cubemap *map = image;
    face_run run;
    for (int row = 0; row < map->size; row++)
        for (int column = 0; column < map->size; column += RUN) {
            const int count = map->size - column < RUN ? map->size - column : RUN;
            set_face_run(map->size, row, column, count, &run);
            for (int face = 0; face < 6; face++) {
                set_coordinate(&run, count, face, 0, 1, p->x);
                set_coordinate(&run, count, face, 1, 1, p->y);
                set_coordinate(&run, count, face, 2, map->left_handed ? -1 : 1, p->z);
                add_run(p, map->faces[face], row, column, count, run.solid_angle);
            }
        }
}

void lmp_sh_project_cubemap(int bands, const lmp_cubemap *map, float *sh) {
    assert(map->size >= 1 && map->channels >= 1);
    for (int face = 0; face < 6; face++)
        assert(map->faces[face]);
    const grid g = grid_of(map->texel, map->size, map->channels, map->row_stride, map->texel_stride,
                           map->channel_stride);
    project(map, g, add_cubemap, bands, map->channels, sh);
}
