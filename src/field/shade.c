/* SPDX-License-Identifier: MIT */
/* shade.c - surfaces under a field: the lobes of a chunk receive the interpolated coefficients,
 * then near lights by zonal sums, each weighted by the fraction that the field does not hold. */
#include "src/field/points.h"
#include "src/field/sort.h"
#include "src/kernels/dispatch.h"
#include "src/shade/chunk.h"

#include <math.h>
#include <string.h>

static const float pi = 3.14159265f;

/* What all chunks of a call share. */
typedef struct field_shading {
    const lmp_field *field;
    lmp_shade_settings settings; /* zonal, with the field's bands */
    float window[LMP_FIELD_BANDS_MAX], diffuse[LMP_FIELD_BANDS_MAX];
} field_shading;

/* --- far lights ------------------------------------------------------------------------------- */

static lmpi_kernel_vec3 from(const lmpi_kernel_vec3 *planes, size_t first) {
    return (lmpi_kernel_vec3) { planes->x + first, planes->y + first, planes->z + first };
}

/* Shades by the interpolated coefficients. It is a function of its own, because its planes would be
 * too much stack under the zonal kernel. */
static __attribute__((noinline)) void shade_far(const field_shading *shading, size_t first,
                                                const shade_chunk *chunk, field_blocks *blocks) {
    const lmp_field *field = shading->field;
    const size_t left = chunk->count - first, count = left < FIELD_BRICK ? left : FIELD_BRICK;
    float planes[FIELD_ROWS];
    lmp_vec3 points[FIELD_BRICK];
    lmpi_kernel_surfaces surfaces = { .normal = from(&chunk->surfaces.normal, first),
                                      .lobe_count = chunk->phong_count };
    lmpi_kernel_accumulated sums = { 0 };
    for (int c = 0; c < 3; c++)
        sums.diffuse[c] = chunk->sums.diffuse[c] + first;
    for (int k = 0; k < chunk->phong_count; k++) {
        const lmpi_kernel_lobe *lobe = &chunk->surfaces.lobe[k];
        surfaces.lobe[k] = (lmpi_kernel_lobe) { from(&lobe->axis, first), lobe->exponent + first };
        for (int c = 0; c < 3; c++)
            sums.specular[k][c] = chunk->sums.specular[k][c] + first;
    }
    for (size_t i = 0; i < count; i++)
        points[i] = lmpi_batch_get(&chunk->surfaces.point, first + i);
    if (count < FIELD_BRICK)
        memset(planes, 0, FIELD_BRICK * field->values * sizeof *planes);
    const lmpi_kernel_out out = { planes, FIELD_BRICK, 1 };
    const lmpi_kernel_in in = { planes, FIELD_BRICK, 1 };
    lmpi_field_interpolate(field, points, count, blocks, &out);
    lmpi_kernels_get()->shade.field(field->info.desc.bands, shading->window, shading->diffuse,
                                    &surfaces, &in, count, &sums);
}

/* --- near lights ------------------------------------------------------------------------------ */

/* Returns the box around a chunk's points. */
static field_box box_of(const shade_chunk *chunk) {
    const lmp_vec3 first = lmpi_batch_get(&chunk->surfaces.point, 0);
    field_box box = { first, first };
    for (size_t i = 1; i < chunk->count; i++)
        lmpi_field_box_grow(&box, lmpi_batch_get(&chunk->surfaces.point, i));
    return box;
}

/* Lights near a chunk that are found in one call. */
enum { FOUND = 128 };

/* Finds lights near a chunk from light *next on, and sets *next to the light to go on with, or to
 * FIELD_NONE. It is a function of its own, because its set would be too much stack under the zonal
 * kernel. */
static __attribute__((noinline)) size_t find_near(const lmp_field *field, const shade_chunk *chunk,
                                                  const field_blocks *blocks, uint32_t *next,
                                                  uint32_t found[FOUND]) {
    const field_box box = box_of(chunk);
    field_set near;
    lmpi_field_set_clear(field, &near);
    for (size_t i = 0; i < blocks->count; i++)
        lmpi_field_set_add(field, blocks->at[i], &near);
    return lmpi_field_set_find(field, &near, &box, FOUND, next, found);
}

/* Surfaces that are shaded together, and lights that the zonal kernel takes at once, at most. */
enum { FIELD_CHUNK = FIELD_BLOCKS, PASS = LMPI_KERNEL_LIGHTS_MAX };

/* Adds as many of the lights found as a kernel takes; returns how many. */
static size_t add_near(const field_shading *shading, const uint32_t *found, size_t count,
                       shade_chunk *chunk) {
    const lmp_field *field = shading->field;
    lmpi_packed_light lights[PASS];
    size_t taken = 0;
    for (; taken < count && taken < PASS; taken++) {
        const lmp_light *light = &field->lights[found[taken]];
        lmp_rgb ambient = { 0, 0, 0 };
        lmpi_shade_take_light(light, &lights[taken], &ambient);
        lights[taken].per_reach = lmpi_light_fades(light) ? 1 / field->info.reach : 0;
        chunk->ambient[0] += ambient.r;
        chunk->ambient[1] += ambient.g;
        chunk->ambient[2] += ambient.b;
    }
    lmpi_kernels_get()->shade.zonal(shading->settings.bands, shading->window, &chunk->surfaces,
                                    lights, taken, chunk->count, &chunk->sums);
    return taken;
}

static void shade_near(const field_shading *shading, const field_blocks *blocks,
                       shade_chunk *chunk) {
    for (uint32_t next = 0; next != FIELD_NONE;) {
        uint32_t found[FOUND];
        const size_t count = find_near(shading->field, chunk, blocks, &next, found);
        for (size_t i = 0; i < count;)
            i += add_near(shading, found + i, count - i, chunk);
    }
}

/* --- surfaces --------------------------------------------------------------------------------- */

static bool has_lobes(const lmp_material *material) {
    return material->kind == LMP_MATERIAL_LOBES ||
           material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS;
}

/* Shades a surface with a table, to which all lights are an environment. */
static __attribute__((noinline)) void shade_surroundings(const field_shading *shading,
                                                         const lmp_surfaces *one, lmp_rgb *color) {
    float sh[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
    const lmp_environment light = { sh, shading->settings.bands };
    const lmp_vec3 point = lmpi_vec3_element(&one->position, 0);
    lmpi_field_row(shading->field, point, sh);
    lmpi_shade_environment_bare_n(&shading->settings, one, 1, &light, sizeof *color, &color->r);
}

/* Shades a surface outside the grid, or of a material without lobes. */
static void shade_one(const field_shading *shading, const lmp_surfaces *surfaces, size_t i,
                      size_t stride, float *rgb) {
    const lmp_field *field = shading->field;
    const lmp_material *material = lmpi_material_at(surfaces, i);
    const lmp_surface surface = lmpi_surface_at(surfaces, i);
    const lmp_surfaces one = lmpi_surfaces_of(material, &surface);
    lmp_rgb color;
    if (material->kind == LMP_MATERIAL_TABLE && material->table) {
        shade_surroundings(shading, &one, &color);
    } else {
        lmp_shade_settings settings = shading->settings;
        if (!has_lobes(material))
            settings.method = LMP_SHADE_PREINTEGRATED;
        lmpi_shade_bare_n(&settings, &one, 1, field->lights, field->info.light_count, sizeof color,
                          &color.r);
    }
    memcpy((char *)rgb + i * stride, &color, sizeof color);
}

/* Shades surfaces inside the grid with `lobes` lobes each, no more than fit a chunk. It is a
 * function of its own, because shade_one must not be called on top of its chunk. */
static __attribute__((noinline)) void shade_alike(const field_shading *shading,
                                                  const lmp_surfaces *surfaces, int lobes,
                                                  size_t from, const uint16_t *order, size_t count,
                                                  size_t stride, float *rgb) {
    shade_chunk chunk;
    field_blocks blocks = { .count = 0 };
    lmpi_shade_take_lobes(surfaces, lobes, from, order, count, &chunk);
    lmpi_shade_load_chunk(surfaces, &chunk);
    for (size_t first = 0; first < chunk.count; first += FIELD_BRICK)
        shade_far(shading, first, &chunk, &blocks);
    shade_near(shading, &blocks, &chunk);
    lmpi_shade_sum_planes(chunk.count, chunk.phong_count, chunk.ambient, &chunk.planes);
    lmpi_shade_store(&chunk.planes, chunk.at, chunk.count, stride, rgb);
}

/* Cells so far apart share a key: their surfaces then come mixed, which only costs time. */
enum { CELLS = 1 << 20 };

/* Kinds of surfaces, by their number of lobes: 1, 3 or 5. */
enum { KINDS = LMPI_KERNEL_LOBES_MAX / 2 + 1 };

/* Whether a surface has lobes and lies inside the grid; if so, finds the key by which it is sorted,
 * of its lobes, its block and its cell. */
static bool find_key(const lmp_field *field, const lmp_surfaces *surfaces, size_t i,
                     uint32_t *key) {
    const lmp_material *material = lmpi_material_at(surfaces, i);
    field_place place;
    if (!has_lobes(material) ||
        !lmpi_field_find(field, lmpi_vec3_element(&surfaces->position, i), &place))
        return false;
    const int lobes = lmpi_shade_phong_count(material, lmpi_vec3_element(&surfaces->normal, i),
                                             lmpi_vec3_element(&surfaces->view, i));
    const uint32_t *cell = place.cell;
    const uint32_t within =
        (cell[2] % FIELD_BLOCK * FIELD_BLOCK + cell[1] % FIELD_BLOCK) * FIELD_BLOCK +
        cell[0] % FIELD_BLOCK;
    const uint32_t each = FIELD_BLOCK * FIELD_BLOCK * FIELD_BLOCK;
    *key = (uint32_t)lobes / 2 * CELLS + (lmpi_field_block(field, cell) * each + within) % CELLS;
    return true;
}

/* Sorts up to FIELD_SORTED surfaces: those with lobes by their keys, and behind them the others;
 * counts the surfaces of each kind. It is a function of its own, to keep its keys off the stack of
 * what follows. */
static __attribute__((noinline)) void sort(const lmp_field *field, const lmp_surfaces *surfaces,
                                           size_t first, size_t count, uint16_t *order,
                                           size_t kinds[KINDS]) {
    uint32_t keys[FIELD_SORTED];
    size_t sorted = 0, others = count;
    memset(kinds, 0, KINDS * sizeof *kinds);
    for (size_t i = 0; i < count; i++)
        if (find_key(field, surfaces, first + i, &keys[i])) {
            order[sorted++] = (uint16_t)i;
            kinds[keys[i] / CELLS]++;
        } else
            order[--others] = (uint16_t)i;
    lmpi_field_sort(keys, sorted, order);
}

static field_shading prepare(const lmp_shade_settings *settings, const lmp_field *field) {
    field_shading shading = { .field = field, .settings = lmpi_shade_resolve(settings) };
    shading.settings.method = LMP_SHADE_ZONAL;
    shading.settings.bands = field->info.desc.bands;
    lmp_sh_make_window(shading.settings.bands, shading.settings.window,
                       shading.settings.window_size, shading.window);
    lmp_lobe_make_diffuse(shading.settings.bands, shading.diffuse);
    for (int l = 0; l < shading.settings.bands; l++)
        shading.diffuse[l] /= pi;
    return shading;
}

/* Shades surfaces without their layers; returns which layers lie over any of them. */
static unsigned shade_bare(const void *light, const lmp_surfaces *surfaces, size_t count,
                           size_t stride, float *rgb) {
    const field_shading *shading = light;
    unsigned layer_mask = 0;
    assert(lmpi_are_surfaces(surfaces, count));
    for (size_t i = 0; i < count; i++)
        layer_mask |= lmpi_shade_layer_mask(lmpi_material_at(surfaces, i));
    for (size_t first = 0; first < count; first += FIELD_SORTED) {
        const size_t some = count - first < FIELD_SORTED ? count - first : FIELD_SORTED;
        uint16_t order[FIELD_SORTED];
        size_t kinds[KINDS], next = 0;
        sort(shading->field, surfaces, first, some, order, kinds);
        for (int k = 0; k < KINDS; k++) {
            const size_t end = next + kinds[k], fit = lmpi_shade_capacity(2 * k + 1);
            for (size_t taken; next < end; next += taken) {
                taken = fit < FIELD_CHUNK ? fit : FIELD_CHUNK;
                taken = end - next < taken ? end - next : taken;
                shade_alike(shading, surfaces, 2 * k + 1, first, order + next, taken, stride, rgb);
            }
        }
        for (; next < some; next++)
            shade_one(shading, surfaces, first + order[next], stride, rgb);
    }
    return layer_mask;
}

void lmp_field_shade_n(const lmp_shade_settings *settings, const lmp_field *field,
                       const lmp_surfaces *surfaces, size_t count, lmp_rgb_array rgb) {
    const field_shading shading = prepare(settings, field);
    lmpi_shade_layered(shade_bare, &shading, true, surfaces, count, rgb);
}
