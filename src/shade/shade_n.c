/* SPDX-License-Identifier: MIT */
/* shade_n.c - shading many surfaces: chunks of planes, every light as a sphere or a fixed cap. */
#include "src/base/tables.h"
#include "src/light/cap.h"
#include "src/preintegrated/lobe_eval.h"
#include "src/shade/chunk.h"

static const float pi = 3.14159265f;

static lmp_vec3 vector_at(const lmp_vec3_array *array, size_t i) {
    lmp_vec3 v = { 0, 0, 0 };
    if (array->x) {
        memcpy(&v.x, (const char *)array->x + i * array->stride, sizeof v.x);
        memcpy(&v.y, (const char *)array->y + i * array->stride, sizeof v.y);
        memcpy(&v.z, (const char *)array->z + i * array->stride, sizeof v.z);
    }
    return v;
}

/* Sums of coefficients: surface by surface. */
static void shade_each(const lmp_shade_settings *resolved, const lmp_surfaces *surfaces,
                       const size_t *at, size_t count, const lmp_light *lights, size_t light_count,
                       size_t stride, float *rgb) {
    for (size_t i = 0; i < count; i++) {
        const lmp_surface surface = { .position = vector_at(&surfaces->position, at[i]),
                                      .normal = vector_at(&surfaces->normal, at[i]),
                                      .view = vector_at(&surfaces->view, at[i]),
                                      .tangent = vector_at(&surfaces->tangent, at[i]) };
        const lmp_rgb color = lmp_shade_sum(resolved, lmp_material_at(surfaces, at[i]), &surface,
                                            lights, light_count);
        memcpy((char *)rgb + at[i] * stride, &color, sizeof color);
    }
}

/* Spots that one call of a kernel takes at most: each needs a plane of its own. */
enum { SPOTS_MAX = 4 };

/* --- methods ---------------------------------------------------------------------------------- */

/* How lobes are shaded: by bands, or from a preintegrated lobe. */
typedef struct method {
    const lmp_shade_settings *settings;
    float window[LMP_BANDS_MAX], diffuse[LMP_BANDS_MAX];
    lmp_preintegrated_lobe_info info;
    uint32_t diffuse_first[LMP_KERNEL_LANES_MAX], diffuse_columns[LMP_KERNEL_LANES_MAX];
    float diffuse_numbers[3][LMP_KERNEL_LANES_MAX];
    lmp_kernel_lobe_positions diffuse_position;
} shade_method;

/* Where each surface's lobe lies. */
typedef struct chunk_positions {
    uint32_t first[LMP_BATCH], columns[LMP_BATCH];
    lmp_batch_plane fraction, density, lobe_angle;
} chunk_positions;

static lmp_kernel_lobe_positions find_positions(const lmp_preintegrated_lobe_info *info,
                                                const shade_lobe_planes *lobe, size_t count,
                                                chunk_positions *positions) {
    lmp_preintegrated_lobe_position position = { 0 };
    float exponent = -1;
    for (size_t i = 0; i < LMP_BATCH; i++) {
        /* Past the last surface, its position again: a kernel reads whole vectors. */
        const float e = lobe->exponent.at[i < count ? i : count - 1];
        if (e < exponent || e > exponent)
            lmp_preintegrated_lobe_lookup(info, e, &position);
        exponent = e;
        positions->first[i] = position.first;
        positions->columns[i] = position.columns;
        positions->fraction.at[i] = position.fraction;
        positions->density.at[i] = position.density;
        positions->lobe_angle.at[i] = position.lobe_angle;
        if (i >= count && i % LMP_KERNEL_LANES_MAX == LMP_KERNEL_LANES_MAX - 1)
            break;
    }
    return (lmp_kernel_lobe_positions) { positions->first, positions->columns,
                                         positions->fraction.at, positions->density.at,
                                         positions->lobe_angle.at };
}

/* A function of its own: under the zonal kernel its arrays would be too much stack. */
static __attribute__((noinline)) void shade_by_readings(const shade_method *method,
                                                        const shade_chunk *chunk,
                                                        const lmp_kernel_light *lights,
                                                        size_t count) {
    chunk_positions positions[LMP_KERNEL_LOBES_MAX];
    lmp_kernel_lobe_positions specular[LMP_KERNEL_LOBES_MAX];
    const lmp_kernel_preintegrated_lobe lobe = { method->info.coefficients };
    for (int k = 0; k < chunk->phong_count; k++)
        specular[k] =
            find_positions(&method->info, &chunk->planes.lobe[k], chunk->count, &positions[k]);
    lmp_kernels_get()->shade_preintegrated_lobe(&lobe, &method->diffuse_position, specular,
                                                &chunk->surfaces, lights, count, chunk->count,
                                                &chunk->sums);
}

static void shade_lobes_of_chunk(const shade_method *method, const shade_chunk *chunk,
                                 const lmp_kernel_light *lights, size_t count) {
    if (method->settings->method == LMP_SHADE_PREINTEGRATED)
        shade_by_readings(method, chunk, lights, count);
    else
        lmp_kernels_get()->shade_zonal(method->settings->bands, method->window, method->diffuse,
                                       &chunk->surfaces, lights, count, chunk->count, &chunk->sums);
}

static_assert(sizeof(lmp_kernel_slice) == sizeof(lmp_preintegrated_brdf_slice) &&
                  offsetof(lmp_kernel_slice, unit) == offsetof(lmp_preintegrated_brdf_slice, unit),
              "the kernels' slices are those of preintegrated BRDFs");

static void shade_brdf_planes(const shade_chunk *chunk, const lmp_kernel_light *lights,
                              size_t count, lmp_rgb ambient) {
    const lmp_preintegrated_brdf_info info =
        lmp_preintegrated_brdf_describe(chunk->source.preintegrated);
    const lmp_kernel_preintegrated_brdf material = { .mirrored = info.mirrored,
                                                     .width = info.width,
                                                     .radius = info.radius,
                                                     .reach = info.reach,
                                                     .slope = info.slope,
                                                     .lobe_angle = info.lobe_angle,
                                                     .view_count = info.view_count,
                                                     .cap_count = info.cap_count,
                                                     .view_steps = info.view_steps,
                                                     .cap_steps = info.cap_steps,
                                                     .view_remap = info.view_remap,
                                                     .cap_remap = info.cap_remap,
                                                     .ambient = info.ambient,
                                                     .slices = info.slices,
                                                     .texels = info.texels };
    lmp_kernels_get()->shade_preintegrated_brdf(&material, &chunk->surfaces, lights, count, ambient,
                                                chunk->count, chunk->sums.diffuse);
}

/* Takes lights until one more would be too many; returns how many. */
static size_t take_lights(const lmp_light *lights, size_t count, const shade_chunk *chunk,
                          lmp_batch_plane *scales, lmp_kernel_light *taken, lmp_rgb *ambient) {
    size_t n = 0, spots = 0;
    for (; n < count && n < LMP_KERNEL_LIGHTS_MAX; n++) {
        const bool spot = lights[n].kind == LMP_LIGHT_SPOT;
        if (spot && spots == SPOTS_MAX)
            break;
        taken[n] = lmp_shade_take_light(&lights[n], chunk, &scales[spots], ambient);
        spots += spot;
    }
    return n;
}

/* By the kernels. */
static void shade_by_kernels(const shade_method *method, const lmp_surfaces *surfaces,
                             shade_chunk *chunk, const lmp_light *lights, size_t light_count,
                             size_t stride, float *rgb) {
    lmp_batch_plane scales[SPOTS_MAX + 1];
    lmp_shade_load_chunk(surfaces, chunk);
    for (size_t light = 0, taken; light < light_count; light += taken) {
        lmp_kernel_light some[LMP_KERNEL_LIGHTS_MAX];
        lmp_rgb ambient = { 0, 0, 0 };
        taken = take_lights(lights + light, light_count - light, chunk, scales, some, &ambient);
        if (chunk->source.preintegrated)
            shade_brdf_planes(chunk, some, taken, ambient);
        else
            shade_lobes_of_chunk(method, chunk, some, taken);
        chunk->ambient[0] += ambient.r;
        chunk->ambient[1] += ambient.g;
        chunk->ambient[2] += ambient.b;
    }
    if (chunk->phong_count)
        lmp_shade_sum_planes(chunk->count, chunk->phong_count, chunk->ambient, &chunk->planes);
    lmp_shade_store_chunk(chunk, stride, rgb);
}

static void prepare_zonal(const lmp_shade_settings *settings, shade_method *method) {
    lmp_sh_window(settings->bands, settings->window, settings->window_size, method->window);
    lmp_lobe_diffuse(settings->bands, method->diffuse);
    for (int l = 0; l < settings->bands; l++)
        method->diffuse[l] /= pi;
}

static void prepare_preintegrated(const lmp_shade_settings *settings, shade_method *method) {
    lmp_preintegrated_lobe_position position;
    method->info = lmp_preintegrated_lobe_describe(settings->lobe);
    lmp_preintegrated_lobe_lookup(&method->info, 1, &position);
    for (int i = 0; i < LMP_KERNEL_LANES_MAX; i++) {
        method->diffuse_first[i] = position.first;
        method->diffuse_columns[i] = position.columns;
        method->diffuse_numbers[0][i] = position.fraction;
        method->diffuse_numbers[1][i] = position.density;
        method->diffuse_numbers[2][i] = position.lobe_angle;
    }
    method->diffuse_position =
        (lmp_kernel_lobe_positions) { method->diffuse_first, method->diffuse_columns,
                                      method->diffuse_numbers[0], method->diffuse_numbers[1],
                                      method->diffuse_numbers[2] };
}

void lmp_shade_uncoated_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                          size_t count, const lmp_light *lights, size_t light_count,
                          size_t rgb_stride, float *rgb) {
    const lmp_shade_settings resolved = lmp_shade_resolve(settings);
    const size_t stride = rgb_stride ? rgb_stride : sizeof(lmp_rgb);
    assert(lmp_are_surfaces(surfaces, count) && lmp_are_lights(lights, light_count));
    assert(stride >= sizeof(lmp_rgb) && stride % sizeof(float) == 0);
    shade_method method = { .settings = &resolved };
    shade_chunk chunk;
    if (resolved.method != LMP_SHADE_PREINTEGRATED)
        prepare_zonal(&resolved, &method);
    else if (resolved.lobe)
        prepare_preintegrated(&resolved, &method);
    for (size_t first = 0; first < count; first += LMP_BATCH) {
        size_t left[LMP_BATCH], left_count = lmp_batch_count(count, first);
        for (size_t i = 0; i < left_count; i++)
            left[i] = first + i;
        while (left_count > 0) {
            left_count = lmp_shade_take_alike(surfaces, resolved.method, left, left_count, &chunk);
            const bool lobes = chunk.phong_count > 0;
            assert(!lobes || resolved.method != LMP_SHADE_PREINTEGRATED || resolved.lobe);
            if (chunk.source.table || (lobes && resolved.method == LMP_SHADE_COEFFICIENTS))
                shade_each(&resolved, surfaces, chunk.at, chunk.count, lights, light_count, stride,
                           rgb);
            else
                shade_by_kernels(&method, surfaces, &chunk, lights, light_count, stride, rgb);
        }
    }
}
