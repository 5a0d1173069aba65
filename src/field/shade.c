/* SPDX-License-Identifier: MIT */
/* shade.c - surfaces under a field: lobes of a chunk receive the interpolated coefficients, then
 * the near lights by zonal sums, each light weighted by what the field lacks of it. */
#include "src/field/field.h"
#include "src/light/cap.h"
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

static lmp_kernel_vec3 from(const lmp_kernel_vec3 *planes, size_t first) {
    return (lmp_kernel_vec3) { planes->x + first, planes->y + first, planes->z + first };
}

/* A function of its own: under the zonal kernel its planes would be too much stack. */
static __attribute__((noinline)) void shade_far(const field_shading *shading, size_t first,
                                                const shade_chunk *chunk, field_blocks *blocks) {
    const lmp_field *field = shading->field;
    const size_t left = chunk->count - first, count = left < FIELD_BRICK ? left : FIELD_BRICK;
    float planes[FIELD_ROWS];
    lmp_vec3 points[FIELD_BRICK];
    lmp_kernel_surfaces surfaces = { .normal = from(&chunk->surfaces.normal, first),
                                     .lobe_count = chunk->phong_count };
    lmp_kernel_accumulated sums = { 0 };
    for (int c = 0; c < 3; c++)
        sums.diffuse[c] = chunk->sums.diffuse[c] + first;
    for (int k = 0; k < chunk->phong_count; k++) {
        const lmp_kernel_lobe *lobe = &chunk->surfaces.lobe[k];
        surfaces.lobe[k] = (lmp_kernel_lobe) { from(&lobe->axis, first), lobe->exponent + first };
        for (int c = 0; c < 3; c++)
            sums.specular[k][c] = chunk->sums.specular[k][c] + first;
    }
    for (size_t i = 0; i < count; i++)
        points[i] = lmp_batch_get(&chunk->surfaces.point, first + i);
    if (count < FIELD_BRICK)
        memset(planes, 0, FIELD_BRICK * field->values * sizeof *planes);
    const lmp_kernel_out out = { planes, FIELD_BRICK, 1 };
    const lmp_kernel_in in = { planes, FIELD_BRICK, 1 };
    lmp_field_interpolate(field, points, count, blocks, &out);
    lmp_kernels_get()->shade_field(field->info.desc.bands, shading->window, shading->diffuse,
                                   &surfaces, &in, count, &sums);
}

/* --- near lights ------------------------------------------------------------------------------ */

static float lower(float a, float b) {
    return a < b ? a : b;
}

static float higher(float a, float b) {
    return a > b ? a : b;
}

/* Around a chunk's points. */
static field_box box_of(const shade_chunk *chunk) {
    field_box box;
    box.low = box.high = lmp_batch_get(&chunk->surfaces.point, 0);
    for (size_t i = 1; i < chunk->count; i++) {
        const lmp_vec3 p = lmp_batch_get(&chunk->surfaces.point, i);
        box.low =
            (lmp_vec3) { lower(box.low.x, p.x), lower(box.low.y, p.y), lower(box.low.z, p.z) };
        box.high = (lmp_vec3) { higher(box.high.x, p.x), higher(box.high.y, p.y),
                                higher(box.high.z, p.z) };
    }
    return box;
}

/* Whether some point of the box may lack some of the light. */
static bool is_near(const lmp_field *field, uint32_t light, const field_box *box) {
    const field_sphere *sphere = &field->spheres[light];
    const float reach = lmp_field_around(sphere, field->info.reach) * 1.0001f;
    return (lmp_field_distance2(box, sphere->center) < reach * reach) | field->everywhere[light];
}

/* Lights near a chunk that are found at once. */
enum { FOUND = 128 };

/* The first of them from light *next on, which becomes the one to go on with or FIELD_NONE. A
 * function of its own: under the zonal kernel its set would be too much stack. */
static __attribute__((noinline)) size_t find_near(const lmp_field *field, const shade_chunk *chunk,
                                                  const field_blocks *blocks, uint32_t *next,
                                                  uint32_t found[FOUND]) {
    const field_box box = box_of(chunk);
    size_t count = 0;
    field_set near;
    lmp_field_set_clear(field, &near);
    for (size_t i = 0; i < blocks->count; i++)
        lmp_field_set_add(field, blocks->at[i], &near);
    for (uint32_t word = *next / 64; word < near.words; word++)
        for (uint64_t bits = near.bits[word]; bits; bits &= bits - 1) {
            const uint32_t light = 64 * word + (uint32_t)__builtin_ctzll(bits);
            if (count == FOUND) {
                *next = light;
                return count;
            }
            found[count] = light;
            count += light >= *next && is_near(field, light, &box);
        }
    *next = FIELD_NONE;
    return count;
}

/* Surfaces that are shaded together at most, and lights that the zonal kernel takes at once. */
enum { FIELD_CHUNK = FIELD_BLOCKS, PASS = LMP_KERNEL_LIGHTS_MAX };

/* Adds the first of the lights found; returns how many. */
static size_t add_near(const field_shading *shading, const uint32_t *found, size_t count,
                       shade_chunk *chunk) {
    const lmp_field *field = shading->field;
    lmp_packed_light lights[PASS];
    size_t taken = 0;
    for (; taken < count && taken < PASS; taken++) {
        const lmp_light *light = &field->lights[found[taken]];
        lmp_rgb ambient = { 0, 0, 0 };
        lmp_shade_take_light(light, &lights[taken], &ambient);
        lights[taken].per_reach = lmp_light_fades(light) ? 1 / field->info.reach : 0;
        chunk->ambient[0] += ambient.r;
        chunk->ambient[1] += ambient.g;
        chunk->ambient[2] += ambient.b;
    }
    lmp_kernels_get()->shade_zonal(shading->settings.bands, shading->window, &chunk->surfaces,
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

/* All the light at a surface as its surroundings: what a table reads. */
static __attribute__((noinline)) void shade_surroundings(const field_shading *shading,
                                                         const lmp_surfaces *one, lmp_rgb *color) {
    float sh[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
    const lmp_environment light = { sh, shading->settings.bands };
    const lmp_vec3 point = lmp_vec3_element(&one->position, 0);
    lmp_field_rows(shading->field, &point, 1, sh);
    lmp_shade_environment_bare_n(&shading->settings, one, 1, &light, 0, &color->r);
}

/* A surface outside the grid, or of a material without lobes. */
static void shade_one(const field_shading *shading, const lmp_surfaces *surfaces, size_t i,
                      size_t stride, float *rgb) {
    const lmp_field *field = shading->field;
    const lmp_material *material = lmp_material_at(surfaces, i);
    const lmp_surface surface = lmp_surface_at(surfaces, i);
    const lmp_surfaces one = lmp_surfaces_of(material, &surface);
    lmp_rgb color;
    if (material->kind == LMP_MATERIAL_TABLE && material->table) {
        shade_surroundings(shading, &one, &color);
    } else {
        lmp_shade_settings settings = shading->settings;
        if (!has_lobes(material))
            settings.method = LMP_SHADE_PREINTEGRATED;
        lmp_shade_bare_n(&settings, &one, 1, field->lights, field->info.light_count, 0, &color.r);
    }
    memcpy((char *)rgb + i * stride, &color, sizeof color);
}

/* Surfaces with so many lobes, inside the grid, that fit a chunk. A function of its own, for
 * shade_one must not be called on top of its chunk. */
static __attribute__((noinline)) void shade_alike(const field_shading *shading,
                                                  const lmp_surfaces *surfaces, int lobes,
                                                  size_t from, const uint16_t *order, size_t count,
                                                  size_t stride, float *rgb) {
    shade_chunk chunk;
    field_blocks blocks = { .count = 0 };
    lmp_shade_take_lobes(surfaces, lobes, from, order, count, &chunk);
    lmp_shade_load_chunk(surfaces, &chunk);
    for (size_t first = 0; first < chunk.count; first += FIELD_BRICK)
        shade_far(shading, first, &chunk, &blocks);
    shade_near(shading, &blocks, &chunk);
    lmp_shade_sum_planes(chunk.count, chunk.phong_count, chunk.ambient, &chunk.planes);
    lmp_shade_store(&chunk.planes, chunk.at, chunk.count, stride, rgb);
}

/* Cells so many apart have the same key: they come mixed, which costs time alone. */
enum { CELLS = 1 << 20 };

/* Surfaces of one number of lobes: 1, 3 or 5. */
enum { KINDS = LMP_KERNEL_LOBES_MAX / 2 + 1 };

/* Whether a surface has lobes and lies inside the grid; then a key of its lobes, its block and its
 * cell, by which it is sorted. */
static bool find_key(const lmp_field *field, const lmp_surfaces *surfaces, size_t i,
                     uint32_t *key) {
    const lmp_material *material = lmp_material_at(surfaces, i);
    field_place place;
    if (!has_lobes(material) ||
        !lmp_field_find(field, lmp_vec3_element(&surfaces->position, i), &place))
        return false;
    const int lobes = lmp_shade_phong_count(material, lmp_vec3_element(&surfaces->normal, i),
                                            lmp_vec3_element(&surfaces->view, i));
    const uint32_t *cell = place.cell;
    const uint32_t within =
        (cell[2] % FIELD_BLOCK * FIELD_BLOCK + cell[1] % FIELD_BLOCK) * FIELD_BLOCK +
        cell[0] % FIELD_BLOCK;
    const uint32_t each = FIELD_BLOCK * FIELD_BLOCK * FIELD_BLOCK;
    *key = (uint32_t)lobes / 2 * CELLS + (lmp_field_block(field, cell) * each + within) % CELLS;
    return true;
}

/* Those of FIELD_SORTED surfaces that have lobes, sorted, and behind them the others; counts those
 * of each number of lobes. A function of its own, for its keys are not wanted on the stack below.
 */
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
    lmp_field_sort(keys, sorted, order);
}

static field_shading prepare(const lmp_shade_settings *settings, const lmp_field *field) {
    field_shading shading = { .field = field, .settings = lmp_shade_resolve(settings) };
    shading.settings.method = LMP_SHADE_ZONAL;
    shading.settings.bands = field->info.desc.bands;
    lmp_sh_window(shading.settings.bands, shading.settings.window, shading.settings.window_size,
                  shading.window);
    lmp_lobe_diffuse(shading.settings.bands, shading.diffuse);
    for (int l = 0; l < shading.settings.bands; l++)
        shading.diffuse[l] /= pi;
    return shading;
}

/* Without layers; returns which lie over any of them. */
static unsigned shade_bare(const void *light, const lmp_surfaces *surfaces, size_t count,
                           size_t stride, float *rgb) {
    const field_shading *shading = light;
    unsigned overs = 0;
    assert(lmp_are_surfaces(surfaces, count));
    assert(stride >= sizeof(lmp_rgb) && stride % sizeof(float) == 0);
    for (size_t i = 0; i < count; i++)
        overs |= lmp_shade_overs(lmp_material_at(surfaces, i));
    for (size_t first = 0; first < count; first += FIELD_SORTED) {
        const size_t some = count - first < FIELD_SORTED ? count - first : FIELD_SORTED;
        uint16_t order[FIELD_SORTED];
        size_t kinds[KINDS], next = 0;
        sort(shading->field, surfaces, first, some, order, kinds);
        for (int k = 0; k < KINDS; k++) {
            const size_t end = next + kinds[k], fit = lmp_shade_capacity(2 * k + 1);
            for (size_t taken; next < end; next += taken) {
                taken = fit < FIELD_CHUNK ? fit : FIELD_CHUNK;
                taken = end - next < taken ? end - next : taken;
                shade_alike(shading, surfaces, 2 * k + 1, first, order + next, taken, stride, rgb);
            }
        }
        for (; next < some; next++)
            shade_one(shading, surfaces, first + order[next], stride, rgb);
    }
    return overs;
}

void lmp_field_shade_n(const lmp_shade_settings *settings, const lmp_field *field,
                       const lmp_surfaces *surfaces, size_t count, size_t rgb_stride, float *rgb) {
    const field_shading shading = prepare(settings, field);
    lmp_shade_layered(shade_bare, &shading, true, surfaces, count, rgb_stride, rgb);
}
