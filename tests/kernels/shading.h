/* SPDX-License-Identifier: MIT */
/* shading.h - the inputs of the kernels of shading. Their tables hold numbers of no real material:
 * a kernel must read whatever a table says. */
#ifndef LAMPION_SHADING_H
#define LAMPION_SHADING_H

#include "src/kernels/dispatch.h"
#include "src/light/seen.h"
#include "tests/kernels/inputs.h"
#include "tests/oracle/oracle.h"

#include <lampion/lampion.h>

#include <string.h>

enum {
    SHADE_LIGHTS = 11,
    SHADE_POLYGON_COUNT = 7,
    SHADE_ROUND_COUNT = 4,
    CELLS = 3,
    VIEWS = 5,
    CAPS = 4,
    VIEW_STEPS = 16,
    CAP_STEPS = 12
};

typedef struct shading {
    const inputs *in;
    int bands, lobes; /* Phong lobes */
    _Alignas(64) float axis[LMPI_KERNEL_LOBES_MAX][3][COUNT + 16];
    _Alignas(64) float exponent[LMPI_KERNEL_LOBES_MAX][COUNT + 16];
    lmpi_packed_light lights[SHADE_LIGHTS];
    lmpi_kernel_polygon polygons[SHADE_POLYGON_COUNT];
    lmpi_kernel_disk disks[SHADE_ROUND_COUNT];
    lmpi_kernel_tube tubes[SHADE_ROUND_COUNT];
    lmp_rgb ambient;
    float window[LMP_BANDS_MAX], diffuse[LMP_BANDS_MAX];
    lmpi_kernel_in sh; /* the light at each surface */

    int16_t *pairs;
    uint32_t cell_first[CELLS], cell_columns[CELLS];
    _Alignas(64) uint32_t first[LMPI_KERNEL_LOBES_MAX][COUNT + 16];
    _Alignas(64) uint32_t columns[LMPI_KERNEL_LOBES_MAX][COUNT + 16];
    _Alignas(64) float weight[LMPI_KERNEL_LOBES_MAX][COUNT + 16];
    _Alignas(64) float density[LMPI_KERNEL_LOBES_MAX][COUNT + 16];
    _Alignas(64) float angle[LMPI_KERNEL_LOBES_MAX][COUNT + 16];

    lmpi_kernel_slice slices[VIEWS * CAPS];
    float view_remap[VIEW_STEPS + 1], cap_remap[CAP_STEPS + 1];
    lmp_rgb colors[VIEWS];
    int16_t *texels;
    lmpi_kernel_preintegrated_brdf brdf;
} shading;

/* Makes lights: spheres, of which point i sees number i as special[i] says; a direction and a cap
 * that are the same from every point; and a Dirac and a cone, which point 2 sees as special[2]
 * says. */
static void make_lights(shading *s) {
    const inputs *in = s->in;
    static const int element[] = { 0, 1, 2, 3, 4, 5, 6, 20, 21, 30, 2 };
    for (int i = 0; i < SHADE_LIGHTS; i++) {
        const int e = element[i];
        lmpi_packed_light *light = &s->lights[i];
        *light =
            (lmpi_packed_light) { .form = LMPI_FORM_SPHERE,
                                  .at = { in->center[0][e], in->center[1][e], in->center[2][e] },
                                  .size = in->radius[e],
                                  .color = { in->rgb[0][i], in->rgb[1][i], in->rgb[2][i] },
                                  .axis = { 0.36f, -0.48f, 0.8f },
                                  .outer = -0.75f,
                                  .width = 1.5f };
        light->fixed = i == 7 || i == 8;
        if (light->fixed)
            light->at = (lmp_vec3) { in->axis[0][e], in->axis[1][e], in->axis[2][e] };
        if (i >= 7) {
            light->form = i == 8 ? LMPI_FORM_CAP : i == 10 ? LMPI_FORM_CONE : LMPI_FORM_DIRAC;
            light->size = i == 8 ? 0.5625f : LMPI_DIRAC;
        }
    }
    s->ambient = (lmp_rgb) { 0.5f, 0.25f, 1 };
}

static lmp_vec3 combined(const lmp_vec3 half[2], float a, float b) {
    return (lmp_vec3) { a * half[0].x + b * half[1].x, a * half[0].y + b * half[1].y,
                        a * half[0].z + b * half[1].z };
}

/* Makes flat lights of 3 to 8 corners in place of spheres, touched, seen edge-on, near and far. */
static void make_polygons(shading *s) {
    const inputs *in = s->in;
    static const int element[] = { 0, 1, 6, 9, 20, 21, 22 }, corners[] = { 4, 4, 4, 3, 5, 6, 8 };
    static const float outline[8][2] = { { 1, 0 },  { 1, 1 },   { 0, 0.5f }, { -1, 1 },
                                         { -1, 0 }, { -1, -1 }, { 0, -1 },   { 0.5f, -1 } };
    for (int i = 0; i < SHADE_POLYGON_COUNT; i++) {
        const int e = element[i];
        const float size = in->radius[e];
        const lmp_vec3 half[2] = {
            { size * in->axis[0][e], size * in->axis[1][e], size * in->axis[2][e] },
            { size * in->axis[1][e], -size * in->axis[0][e], size * in->axis[2][e + 1] }
        };
        lmp_light light = { .kind = i < 3 ? LMP_LIGHT_RECTANGLE : LMP_LIGHT_POLYGON,
                            .position = { in->center[0][e], in->center[1][e], in->center[2][e] },
                            .two_sided = i % 3 != 2,
                            .corner_count = corners[i],
                            .radiance = { in->rgb[0][i], in->rgb[1][i], in->rgb[2][i] } };
        if (i < 3)
            memcpy(light.half, half, sizeof half);
        for (int c = 0; i >= 3 && c < corners[i]; c++) {
            const float *at = outline[c * 8 / corners[i]];
            light.corner[c] = combined(half, at[0], at[1]);
        }
        lmpi_area area;
        lmpi_area_prepare(&light, &area);
        lmpi_area_pack_polygon(&area, &s->polygons[i]);
    }
}

/* Makes disks in place of spheres: touched, tiny, of any size, and one that is far. */
static void make_disks(shading *s) {
    const inputs *in = s->in;
    static const int element[SHADE_ROUND_COUNT] = { 0, 6, 20, 9 };
    for (int i = 0; i < SHADE_ROUND_COUNT; i++) {
        const int e = element[i];
        const lmp_light light = { .kind = LMP_LIGHT_DISK,
                                  .position = { in->center[0][e], in->center[1][e],
                                                in->center[2][e] },
                                  .direction = { in->axis[0][e], in->axis[1][e], in->axis[2][e] },
                                  .radius = in->radius[e],
                                  .two_sided = i % 2 == 0,
                                  .radiance = { in->rgb[0][i], in->rgb[1][i], in->rgb[2][i] } };
        lmpi_area area;
        lmpi_area_prepare(&light, &area);
        lmpi_area_pack_disk(&area, &s->disks[i]);
    }
}

/* Makes tubes in place of the same spheres, of which each is half as thick as the one before. */
static void make_tubes(shading *s) {
    const inputs *in = s->in;
    static const int element[SHADE_ROUND_COUNT] = { 0, 6, 20, 9 };
    for (int i = 0; i < SHADE_ROUND_COUNT; i++) {
        const int e = element[i];
        const float r = in->radius[e];
        const lmp_light light = {
            .kind = LMP_LIGHT_TUBE,
            .position = { in->center[0][e], in->center[1][e], in->center[2][e] },
            .half = { { r * in->axis[0][e], r * in->axis[1][e], r * in->axis[2][e] } },
            .radius = 0.25f * r / (float)(1 << i),
            .radiance = { in->rgb[0][i], in->rgb[1][i], in->rgb[2][i] }
        };
        lmpi_area area;
        lmpi_area_prepare(&light, &area);
        lmpi_area_pack_tube(&area, &s->tubes[i]);
    }
}

static int16_t number(void) {
    return (int16_t)grid(31);
}

/* Folds a node into a table that is mirrored at both ends, as values that depend on an angle are.
 */
static size_t fold(size_t node, size_t count) {
    const size_t along = node % (2 * count);
    return along > count ? 2 * count - along : along;
}

/* Makes cells of 8 to 40 steps, with half as many rows. */
static void make_preintegrated_lobe(shading *s) {
    uint32_t count = 0, steps[CELLS];
    for (uint32_t k = 0; k < CELLS; k++) {
        steps[k] = 8 + (uint32_t)s->bands % 5 + 14 * k;
        s->cell_first[k] = count;
        s->cell_columns[k] = steps[k] + 3;
        count += (steps[k] / 2 + 4) * (steps[k] + 3);
    }
    s->pairs = malloc(2 * count * sizeof *s->pairs);
    assert_non_null(s->pairs);
    for (uint32_t k = 0; k < CELLS; k++) {
        int16_t values[2][64];
        int16_t *row = s->pairs + 2 * s->cell_first[k];
        for (uint32_t r = 0; r < steps[k] / 2 + 4; r++, row += 2 * s->cell_columns[k]) {
            for (size_t j = 0; j <= steps[k]; j++)
                for (int side = 0; side < 2; side++)
                    values[side][j] = number();
            for (size_t j = 0; j < s->cell_columns[k]; j++)
                for (size_t side = 0; side < 2; side++)
                    row[2 * j + side] = values[side][fold(j + 2 * steps[k] - 1, steps[k])];
        }
    }
    for (int i = 0; i < COUNT + 16; i++) {
        const int k = i % CELLS;
        s->first[0][i] = s->cell_first[k];
        s->columns[0][i] = s->cell_columns[k];
        s->weight[0][i] = 0.5f + grid(1.0f / 2048);
        s->density[0][i] = (float)steps[k] * (float)(1 / ORACLE_PI);
        s->angle[0][i] = 1.25f + grid(1.0f / 1024);
    }
}

/* Makes lobes: the first is around the mirror direction, the others where a neighbor's numbers lie.
 */
static void make_lobes(shading *s) {
    const inputs *in = s->in;
    for (int i = 0; i < COUNT + 16; i++) {
        const float n[3] = { in->normal[0][i], in->normal[1][i], in->normal[2][i] };
        const float v[3] = { in->view[0][i], in->view[1][i], in->view[2][i] };
        const float twice = 2 * (n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
        for (int k = 0; k < LMPI_KERNEL_LOBES_MAX; k++) {
            const int from = (i + k) % (COUNT + 16);
            for (int c = 0; c < 3; c++)
                s->axis[k][c][i] = k ? in->axis[(c + k) % 3][i] : twice * n[c] - v[c];
            s->exponent[k][i] = in->exponent[from];
            s->first[k][i] = s->first[0][from];
            s->columns[k][i] = s->columns[0][from];
            s->weight[k][i] = s->weight[0][from];
            s->density[k][i] = s->density[0][from];
            s->angle[k][i] = s->angle[0][from];
        }
    }
}
static void make_remap(float *remap, int steps, int count) {
    for (int i = 0; i <= steps; i++)
        remap[i] = (float)(count - 1) * (float)(i * i) / (float)(steps * steps);
}

/* Makes slices of 4 to 17 rows and at least 4 columns; some end before the coordinates do. An odd
 * number of bands makes them of half a turn. */
static void make_preintegrated_brdf(shading *s) {
    const bool mirrored = s->bands % 2 != 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < VIEWS * CAPS; i++) {
        const uint32_t steps = (mirrored ? 1 : 4) + (i * 5 + (uint32_t)s->bands) % 7;
        const float density = 0.25f + 0.125f * (float)(i % 8);
        s->slices[i] =
            (lmpi_kernel_slice) { count,
                                  (uint32_t)(9 * density) + (i % 3 ? 4 : 2),
                                  steps + 3,
                                  density,
                                  -3.5f * density - 1,
                                  (float)steps * (float)((mirrored ? 1 : 0.5) / ORACLE_PI),
                                  (0.5f + 0.1f * (float)(i % 4)) / 32768 };
        count += s->slices[i].rows * s->slices[i].columns;
    }
    s->texels = calloc(3 * (count + LMPI_KERNEL_TEXELS_SPARE), sizeof *s->texels);
    assert_non_null(s->texels);
    for (size_t i = 0; i < VIEWS * CAPS; i++) {
        const size_t columns = s->slices[i].columns, steps = columns - 3;
        int16_t *row = s->texels + 3 * s->slices[i].first, values[3][16];
        for (uint32_t r = 0; r < s->slices[i].rows; r++, row += 3 * columns) {
            for (size_t j = 0; j <= steps; j++)
                for (int c = 0; c < 3; c++)
                    values[c][j] = number();
            for (size_t j = 0; j < columns; j++)
                for (size_t c = 0; c < 3; c++)
                    row[3 * j + c] = values[c][mirrored ? fold(j + 2 * steps - 1, steps)
                                                        : (j + steps - 1) % steps];
        }
    }
    make_remap(s->view_remap, VIEW_STEPS, VIEWS);
    make_remap(s->cap_remap, CAP_STEPS, CAPS);
    for (int i = 0; i < VIEWS; i++)
        s->colors[i] = (lmp_rgb) { 0.5f, 0.25f * (float)i, 1 - 0.125f * (float)i };
    s->brdf = (lmpi_kernel_preintegrated_brdf) { .mirrored = mirrored,
                                                 .width = 0.2f,
                                                 .radius = 0.3f,
                                                 .reach = 0.5f,
                                                 .slope = 1,
                                                 .lobe_angle = 0.75f,
                                                 .view_count = VIEWS,
                                                 .cap_count = CAPS,
                                                 .view_steps = VIEW_STEPS,
                                                 .cap_steps = CAP_STEPS,
                                                 .view_remap = s->view_remap,
                                                 .cap_remap = s->cap_remap,
                                                 .ambient = s->colors,
                                                 .slices = s->slices,
                                                 .texels = s->texels };
}

static shading *shading_create(const inputs *in, int bands, int lobes) {
    shading *s = aligned_alloc(64, (sizeof *s + 63) / 64 * 64);
    assert_non_null(s);
    memset(s, 0, sizeof *s);
    s->in = in;
    s->bands = bands;
    s->lobes = lobes;
    set_seed((uint64_t)bands * 77 + 5);
    make_lights(s);
    make_polygons(s);
    make_disks(s);
    make_tubes(s);
    make_preintegrated_lobe(s);
    make_preintegrated_brdf(s);
    make_lobes(s);
    lmp_lobe_make_diffuse(bands, s->diffuse);
    for (int l = 0; l < bands; l++) {
        s->diffuse[l] *= (float)(1 / ORACLE_PI);
        s->window[l] = 1 - 0.5f * (float)l / (float)bands;
    }
    return s;
}

static void shading_free(shading *s) {
    free(s->pairs);
    free(s->texels);
    free(s);
}

#endif
