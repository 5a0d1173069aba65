/* SPDX-License-Identifier: MIT */
/* given.h - what the variants of the shaders read: lights, surfaces, texels and preintegrated
 * tables. */
#ifndef LAMPION_TESTS_GPU_VARIANTS_GIVEN_H
#define LAMPION_TESTS_GPU_VARIANTS_GIVEN_H

#include "app/render/gl/shelves.h"
#include "shaders/lampion/preintegrated_lookup.h"
#include "tests/oracle/check.h"

#include <lampion/brdf.h>
#include <lampion/lobe.h>
#include <lampion/preintegrated.h>
#include <lampion/probe.h>
#include <lampion/shade.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a variant is compiled for. */
typedef struct configuration {
    int bands;
    lmp_window window;
    bool ggx;  /* lobes are those of GGX, or one of Phong */
    int areas; /* how many of AREAS there are */
} configuration;

typedef struct given {
    float light[LIGHTS][2][4];     /* as LMP_LIGHT_SPHERE; color, and 1 if it is fixed */
    float surface[SURFACES][3][4]; /* position and roughness, normal, view */
    float texel[LMP_GGX_TEXELS][4];
    float area[AREAS][LMP_AREA_TEXELS][4];
    float probe[7][4], probe_of_two[3][4]; /* of three bands and of two */
} given;

/* The tables are words of 32 bits. A header says where the others begin: numbers and textures, of
 * which a pair of 16 bits is a word, and a texel of three is two. */
enum {
    TABLE_CELLS,
    TABLE_REMAP,
    TABLE_PAIRS,
    TABLE_WIDTH2,
    TABLE_CELL_COUNT,
    TABLE_VALUES,
    TABLE_TEXELS,
    TABLE_HEADER,
    TABLE_WORDS_MAX = 1 << 23,
    LOBE_CELLS_MAX = 1024
};
typedef struct tables {
    lmp_preintegrated_lobe *lobe;
    lmp_preintegrated_brdf *brdf;
    uint32_t *word;
    size_t count;
} tables;

/* What the given data say, as the library takes it. */
typedef struct world {
    lmp_light lights[LIGHTS + AREAS];
    float probe_sh[3 * 9];
} world;

static void set(float to[4], lmp_vec3 v, double w) {
    memcpy(to, (const float[4]) { v.x, v.y, v.z, (float)w }, 4 * sizeof *to);
}

static lmp_vec3 vec3_of(const float v[4]) {
    return (lmp_vec3) { v[0], v[1], v[2] };
}

/* Makes an area of each kind, around which the surfaces are as near as they are far. */
static void make_areas(lmp_light areas[AREAS]) {
    static const lmp_light_kind kinds[AREAS] = { LMP_LIGHT_RECTANGLE, LMP_LIGHT_DISK,
                                                 LMP_LIGHT_TUBE, LMP_LIGHT_POLYGON };
    for (int i = 0; i < AREAS; i++) {
        areas[i] = (lmp_light) { .kind = kinds[i],
                                 .position = { (float)i - 1, 1.5f, -1 },
                                 .direction = { 0.6f, -0.8f, 0 },
                                 .radius = 0.3f,
                                 .two_sided = i > 0,
                                 .radiance = { 1, 2, (float)i } };
        if (kinds[i] == LMP_LIGHT_POLYGON) {
            areas[i].corner_count = 5;
            for (int k = 0; k < 5; k++)
                areas[i].corner[k] =
                    (lmp_vec3) { 0.5f * cosf(1.2f * (float)k), 0, 0.5f * sinf(1.2f * (float)k) };
        } else {
            areas[i].half[0] = (lmp_vec3) { 0.7f, 0.2f, 0 };
            areas[i].half[1] = (lmp_vec3) { 0, 0.1f, 0.4f };
        }
    }
}

/* Spheres, some of which contain surfaces; a point and a sun are the last. */
static void make_lights(given *data, world *made) {
    for (int i = 0; i < LIGHTS; i++) {
        lmp_light *light = &made->lights[i];
        const lmp_vec3 w = check_random_direction();
        const float d = (float)check_random_between(1, 4), angle = 0.4f;
        light->position = (lmp_vec3) { d * w.x, d * w.y, d * w.z };
        light->radius = (float)check_random_between(0.1, 1.5);
        light->radiance = (lmp_rgb) { 3, (float)i, 1 };
        set(data->light[i][0], light->position, (double)light->radius);
        set(data->light[i][1], (lmp_vec3) { 3, (float)i, 1 }, i == LIGHTS - 1);
        if (i == LIGHTS - 2) {
            light->kind = LMP_LIGHT_POINT;
            data->light[i][0][3] = -1;
        } else if (i == LIGHTS - 1) {
            light->kind = LMP_LIGHT_CAP;
            light->direction = w;
            light->angle = angle;
            set(data->light[i][0], w, 2 * pow(sin(0.5 * (double)angle), 2));
        }
    }
}

static void fill_given(given *data, world *made) {
    make_lights(data, made);
    make_areas(made->lights + LIGHTS);
    for (int i = 0; i < SURFACES; i++) {
        lmp_vec3 view = check_random_direction(), normal = check_random_direction();
        const float cosine = view.x * normal.x + view.y * normal.y + view.z * normal.z;
        if (cosine < 0)
            view = (lmp_vec3) { -view.x, -view.y, -view.z };
        set(data->surface[i][0], check_random_direction(), check_random_between(0.1, 1));
        set(data->surface[i][1], normal, 0);
        set(data->surface[i][2], view, 0);
    }
    lmp_lobe_copy_ggx_texels(data->texel[0]);
    for (int i = 0; i < AREAS; i++)
        lmp_light_copy_area_texels(&made->lights[LIGHTS + i], data->area[i][0]);
    for (int k = 0; k < 27; k++)
        made->probe_sh[k] = (float)check_random_between(-1, 1);
    lmp_probe_constants constants;
    lmp_probe_make_constants(3, 1, made->probe_sh, &constants);
    memcpy(data->probe, &constants, sizeof constants);
    float two[3 * 9] = { 0 };
    for (int k = 0; k < 3 * 9; k++)
        two[k] = k % 9 < 4 ? made->probe_sh[k] : 0;
    lmp_probe_make_constants(3, 1, two, &constants);
    memcpy(data->probe_of_two, constants.linear, sizeof data->probe_of_two);
}

/* --- tables ----------------------------------------------------------------------------------- */

static void add_words(tables *made, const void *from, size_t count) {
    assert_true(made->count + count <= TABLE_WORDS_MAX);
    memcpy(made->word + made->count, from, count * sizeof *made->word);
    made->count += count;
}

static uint32_t pack(const int16_t *pair) {
    return (uint32_t)(uint16_t)pair[0] | (uint32_t)(uint16_t)pair[1] << 16;
}

/* Cells and slices lie on shelves of a texture, from left to right, which keeps coordinates small.
 */
enum { PAIRS_WIDTH = 256, TEXELS_WIDTH = 512 };

/* Adds words of 0, and returns them. */
static uint32_t *add_texture(tables *made, int where, size_t count) {
    assert_true(made->count + count <= TABLE_WORDS_MAX);
    made->word[where] = (uint32_t)made->count;
    made->count += count;
    return made->word + made->word[where];
}

static void add_lobe(tables *made) {
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(made->lobe);
    gpu_shelves shelves = { .width = PAIRS_WIDTH };
    gpu_corner corners[LOBE_CELLS_MAX];
    assert_true(info.cell_count <= LOBE_CELLS_MAX);
    memcpy(&made->word[TABLE_WIDTH2], &info.width2, sizeof info.width2);
    made->word[TABLE_CELL_COUNT] = info.cell_count;
    made->word[TABLE_CELLS] = (uint32_t)made->count;
    for (uint32_t i = 0; i < info.cell_count; i++) {
        const lmp_preintegrated_lobe_cell *cell = &info.cells[i];
        corners[i] = gpu_shelves_put(&shelves, (int)cell->columns, (int)cell->rows);
        const float values[] = { cell->scale, cell->offset, (float)corners[i].x,
                                 (float)corners[i].y };
        add_words(made, values, 4);
    }
    made->word[TABLE_REMAP] = (uint32_t)made->count;
    add_words(made, info.remap, LMP_LOOKUP_REMAP_COUNT);
    uint32_t *pairs = add_texture(made, TABLE_PAIRS, PAIRS_WIDTH * (size_t)shelves.bottom);
    for (uint32_t i = 0; i < info.cell_count; i++)
        for (uint32_t y = 0; y < info.cells[i].rows; y++)
            for (uint32_t x = 0; x < info.cells[i].columns; x++)
                pairs[PAIRS_WIDTH * ((uint32_t)corners[i].y + y) + (uint32_t)corners[i].x + x] =
                    pack(info.coefficients +
                         2 * (size_t)(info.cells[i].first + y * info.cells[i].columns + x));
}

static void add_brdf_header(tables *made, const lmp_preintegrated_brdf_info *info) {
    const float header[LMP_LOOKUP_HEADER] = { [LMP_LOOKUP_VIEW_COUNT] = (float)info->view_count,
                                              [LMP_LOOKUP_CAP_COUNT] = (float)info->cap_count,
                                              [LMP_LOOKUP_VIEW_STEPS] = (float)info->view_steps,
                                              [LMP_LOOKUP_CAP_STEPS] = (float)info->cap_steps,
                                              [LMP_LOOKUP_WIDTH] = info->width,
                                              [LMP_LOOKUP_RADIUS] = info->radius,
                                              [LMP_LOOKUP_REACH] = info->reach,
                                              [LMP_LOOKUP_SLOPE] = info->slope,
                                              [LMP_LOOKUP_LOBE_ANGLE] = info->lobe_angle,
                                              [LMP_LOOKUP_MIRRORED] = info->mirrored };
    made->word[TABLE_VALUES] = (uint32_t)made->count;
    add_words(made, header, LMP_LOOKUP_HEADER);
    add_words(made, info->view_remap, info->view_steps + 1);
    add_words(made, info->cap_remap, info->cap_steps + 1);
    add_words(made, info->ambient, 3 * (size_t)info->view_count);
}

static void add_brdf(tables *made) {
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(made->brdf);
    const size_t slices = (size_t)info.view_count * info.cap_count;
    gpu_shelves shelves = { .width = TEXELS_WIDTH };
    gpu_corner *corners = malloc(slices * sizeof *corners);
    assert_non_null(corners);
    add_brdf_header(made, &info);
    for (size_t i = 0; i < slices; i++) {
        const lmp_preintegrated_brdf_slice *s = &info.slices[i];
        corners[i] = gpu_shelves_put(&shelves, (int)s->columns, (int)s->rows);
        const float values[LMP_LOOKUP_SLICE] = { [LMP_LOOKUP_CORNER_X] = (float)corners[i].x,
                                                 [LMP_LOOKUP_CORNER_Y] = (float)corners[i].y,
                                                 [LMP_LOOKUP_ROWS] = (float)s->rows,
                                                 [LMP_LOOKUP_COLUMNS] = (float)s->columns,
                                                 [LMP_LOOKUP_ROW_DENSITY] = s->row_density,
                                                 [LMP_LOOKUP_ROW_ORIGIN] = s->row_origin,
                                                 [LMP_LOOKUP_COLUMN_DENSITY] = s->column_density,
                                                 [LMP_LOOKUP_VALUE_MAX] = s->unit * 32767 };
        add_words(made, values, LMP_LOOKUP_SLICE);
    }
    uint32_t *texels = add_texture(made, TABLE_TEXELS, 2 * TEXELS_WIDTH * (size_t)shelves.bottom);
    for (size_t i = 0; i < slices; i++)
        for (uint32_t y = 0; y < info.slices[i].rows; y++)
            for (uint32_t x = 0; x < info.slices[i].columns; x++) {
                const lmp_preintegrated_brdf_slice *s = &info.slices[i];
                const int16_t *texel = info.texels + 3 * (size_t)(s->first + y * s->columns + x);
                const int16_t last[2] = { texel[2], 0 };
                uint32_t *to = texels + 2 * (TEXELS_WIDTH * ((uint32_t)corners[i].y + y) +
                                             (uint32_t)corners[i].x + x);
                to[0] = pack(texel);
                to[1] = pack(last);
            }
    free(corners);
}

static tables make_tables(const configuration *of) {
    tables made = { .word = calloc(TABLE_WORDS_MAX, sizeof(uint32_t)), .count = TABLE_HEADER };
    assert_non_null(made.word);
    const lmp_preintegrated_lobe_desc desc = { .bands = of->bands, .window = of->window };
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &made.lobe), LMP_OK);
    const lmp_ggx ggx = { 0.5f, 0.5f, { 0.9f, 0.8f, 0.6f }, { 0.1f, 0.1f, 0.2f } };
    const lmp_brdf_table_desc coarse = { .bands = 6, .views = 6 };
    const lmp_preintegrated_brdf_desc rough = { .error = 0.05f };
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &coarse, brdf, &table), LMP_OK);
    assert_int_equal(lmp_preintegrated_brdf_create(NULL, &rough, table, &made.brdf), LMP_OK);
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
    add_lobe(&made);
    add_brdf(&made);
    return made;
}

static void free_tables(tables *made) {
    lmp_preintegrated_lobe_destroy(made->lobe);
    lmp_preintegrated_brdf_destroy(made->brdf);
    free(made->word);
}

#endif
