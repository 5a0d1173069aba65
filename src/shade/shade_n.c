/* SPDX-License-Identifier: MIT */
/* batch.c - shading many surfaces: chunks of planes, every light as a sphere or a fixed cap. */
#include "src/base/tables.h"
#include "src/kernels/batch.h"
#include "src/preintegrated/lobe_eval.h"

#include <lampion/shade.h>

#include <assert.h>
#include <math.h>

/* A Dirac is a cap this wide, or a sphere this large, of the same strength. That takes (n a)²/15
 * off its highlight, a the half angle: of the cap nothing that shows, of the sphere less than
 * rounding from a distance of 2e-3 on (shade.h). */
#define DIRAC_SINE   1e-5f
#define DIRAC_RADIUS LMP_POINT_DISTANCE_MIN

static const float pi = 3.14159265f;

/* --- a chunk ---------------------------------------------------------------------------------- */

/* Surfaces near each other that are shaded alike: by `response`, else by `table`, else by lobes. */
typedef struct chunk {
    const lmp_brdf_table *table;
    const lmp_preintegrated_brdf *response;
    size_t count;
    size_t at[LMP_BATCH]; /* among the caller's; rising */
    lmp_batch_vec3 point, normal, view, diffuse, specular;
    lmp_batch_plane exponent;
    lmp_batch_plane gathered[6];
    float ambient[3];
    lmp_kernel_surfaces surfaces;
    lmp_kernel_accumulated sums;
} chunk_planes;

/* Surface i's pointer, at a stride. */
static const void *pointer_at(const void *first, size_t stride, size_t i) {
    const void *at = NULL;
    if (first)
        memcpy(&at, (const char *)first + i * stride, sizeof at);
    return at;
}

/* Moves from `left` what is like its first; returns how many stay. */
static size_t take_alike(const lmp_surfaces *surfaces, bool preintegrated, size_t *left,
                         size_t count, chunk_planes *chunk) {
    size_t others = 0;
    chunk->count = 0;
    for (size_t i = 0; i < count; i++) {
        const lmp_brdf_table *table = pointer_at(surfaces->table, surfaces->table_stride, left[i]);
        const lmp_preintegrated_brdf *response =
            preintegrated ? pointer_at(surfaces->response, surfaces->response_stride, left[i])
                          : NULL;
        if (i == 0) {
            chunk->table = table;
            chunk->response = response;
        }
        if (table == chunk->table && response == chunk->response)
            chunk->at[chunk->count++] = left[i];
        else
            left[others++] = left[i];
    }
    return others;
}

static const float *load_floats(const float *array, size_t stride, const chunk_planes *chunk,
                                lmp_batch_plane *plane) {
    const size_t first = chunk->at[0], count = chunk->count;
    if (chunk->at[count - 1] - first == count - 1) {
        lmp_batch_floats(array, stride, first, count, plane);
        return plane->at;
    }
    for (size_t i = 0; i < count; i++)
        memcpy(&plane->at[i], (const char *)array + chunk->at[i] * stride, sizeof(float));
    for (size_t i = count; i % LMP_KERNEL_LANES_MAX; i++)
        plane->at[i] = 0;
    return plane->at;
}

static lmp_kernel_vec3 load_vectors(const lmp_vec3_array *array, const chunk_planes *chunk,
                                    lmp_batch_vec3 *planes) {
    return (lmp_kernel_vec3) { load_floats(array->x, array->stride, chunk, &planes->x),
                               load_floats(array->y, array->stride, chunk, &planes->y),
                               load_floats(array->z, array->stride, chunk, &planes->z) };
}

static void load_chunk(const lmp_surfaces *surfaces, chunk_planes *chunk) {
    chunk->surfaces.point = load_vectors(&surfaces->position, chunk, &chunk->point);
    chunk->surfaces.normal = load_vectors(&surfaces->normal, chunk, &chunk->normal);
    chunk->surfaces.view = load_vectors(&surfaces->view, chunk, &chunk->view);
    if (!chunk->response) {
        load_vectors(&surfaces->diffuse, chunk, &chunk->diffuse);
        load_vectors(&surfaces->specular, chunk, &chunk->specular);
        chunk->surfaces.exponent =
            load_floats(surfaces->exponent.at, surfaces->exponent.stride, chunk, &chunk->exponent);
    }
    memset(chunk->gathered, 0, sizeof chunk->gathered);
    memset(chunk->ambient, 0, sizeof chunk->ambient);
    for (int c = 0; c < 3; c++) {
        chunk->sums.diffuse[c] = chunk->gathered[c].at;
        chunk->sums.specular[c] = chunk->gathered[3 + c].at;
    }
}

static void store_chunk(const chunk_planes *chunk, size_t stride, float *rgb) {
    const float *diffuse[3] = { chunk->diffuse.x.at, chunk->diffuse.y.at, chunk->diffuse.z.at };
    const float *specular[3] = { chunk->specular.x.at, chunk->specular.y.at, chunk->specular.z.at };
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < chunk->count; i++) {
            const float broad = chunk->gathered[c].at[i], ambient = chunk->ambient[c];
            const float sum = chunk->response
                                  ? broad
                                  : diffuse[c][i] * (broad + ambient) +
                                        specular[c][i] * (chunk->gathered[3 + c].at[i] + ambient);
            rgb[chunk->at[i] * stride + c] = sum > 0 ? sum : 0;
        }
}

static lmp_vec3 vector_at(const lmp_vec3_array *array, size_t i) {
    lmp_vec3 v;
    memcpy(&v.x, (const char *)array->x + i * array->stride, sizeof v.x);
    memcpy(&v.y, (const char *)array->y + i * array->stride, sizeof v.y);
    memcpy(&v.z, (const char *)array->z + i * array->stride, sizeof v.z);
    return v;
}

/* A table without a response: surface by surface. */
static void shade_tables(const lmp_surfaces *surfaces, const chunk_planes *chunk,
                         const lmp_light *lights, size_t light_count, size_t stride, float *rgb) {
    for (size_t i = 0; i < chunk->count; i++) {
        const size_t at = chunk->at[i];
        const lmp_surface surface = { vector_at(&surfaces->position, at),
                                      vector_at(&surfaces->normal, at),
                                      vector_at(&surfaces->view, at) };
        const lmp_rgb color =
            lmp_shade_table(chunk->table, &surface, (lmp_vec3) { 0, 0, 0 }, lights, light_count);
        memcpy(rgb + at * stride, &color, sizeof color);
    }
}

/* --- lights ----------------------------------------------------------------------------------- */

static lmp_rgb scaled(lmp_rgb color, float factor) {
    return (lmp_rgb) { color.r * factor, color.g * factor, color.b * factor };
}

/* A cap seen alike from everywhere. */
static lmp_kernel_light fixed_cap(lmp_vec3 direction, float sine, lmp_rgb radiance) {
    return (lmp_kernel_light) { direction.x, direction.y, direction.z, 0, sine, radiance, NULL };
}

/* The light as one sphere or cap; `ambient` receives what it adds from every direction. scale: a
 * plane for spots. */
static lmp_kernel_light take_light(const lmp_light *light, const chunk_planes *chunk,
                                   lmp_batch_plane *scale, lmp_rgb *ambient) {
    const lmp_vec3 p = light->position;
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        return (lmp_kernel_light) { p.x, p.y, p.z, 1, light->radius, light->radiance, NULL };
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT: {
        lmp_kernel_light dirac = {
            p.x, p.y,          p.z,
            1,   DIRAC_RADIUS, scaled(light->intensity, 1 / pi / DIRAC_RADIUS / DIRAC_RADIUS),
            NULL
        };
        if (light->kind == LMP_LIGHT_POINT)
            return dirac;
        lmp_light white = *light;
        lmp_light plain = *light;
        white.intensity = plain.intensity = (lmp_rgb) { 1, 1, 1 };
        plain.kind = LMP_LIGHT_POINT;
        for (size_t i = 0; i < chunk->count; i++) {
            const lmp_vec3 at = { chunk->point.x.at[i], chunk->point.y.at[i],
                                  chunk->point.z.at[i] };
            lmp_cap cone, full;
            lmp_light_cap(&white, at, &cone);
            lmp_light_cap(&plain, at, &full);
            scale->at[i] = cone.strength.r / full.strength.r;
        }
        dirac.scale = scale->at;
        return dirac;
    }
    default:
        break;
    }
    /* The others are the same cap from every point. */
    lmp_cap cap;
    lmp_light_cap(light, p, &cap);
    ambient->r += cap.ambient.r;
    ambient->g += cap.ambient.g;
    ambient->b += cap.ambient.b;
    const float sine = cap.sin2 > 0 ? sqrtf(cap.sin2) : DIRAC_SINE;
    return fixed_cap(cap.axis, sine, scaled(cap.strength, 1 / (pi * sine * sine)));
}

/* --- methods ---------------------------------------------------------------------------------- */

/* How the lobes are known: by bands, or by a response. */
typedef struct method {
    int bands;
    float window[LMP_BANDS_MAX], diffuse[LMP_BANDS_MAX];
    const lmp_preintegrated_lobe *response;
    lmp_preintegrated_lobe_info info;
    uint32_t broad_first[LMP_KERNEL_LANES_MAX], broad_columns[LMP_KERNEL_LANES_MAX];
    float broad[3][LMP_KERNEL_LANES_MAX];
    lmp_kernel_lobe_positions diffuse_place;
} shade_method;

/* Where each surface's lobe lies. */
typedef struct chunk_places {
    uint32_t first[LMP_BATCH], columns[LMP_BATCH];
    lmp_batch_plane share, density, lobe_angle;
} chunk_places;

static lmp_kernel_lobe_positions find_places(const lmp_preintegrated_lobe_info *info,
                                             const chunk_planes *chunk, chunk_places *places) {
    lmp_preintegrated_lobe_position place = { 0 };
    float exponent = -1;
    for (size_t i = 0; i < LMP_BATCH; i++) {
        /* Past the last surface, its place again: a kernel reads whole vectors. */
        const float e = chunk->exponent.at[i < chunk->count ? i : chunk->count - 1];
        if (e < exponent || e > exponent)
            lmp_preintegrated_lobe_lookup(info, e, &place);
        exponent = e;
        places->first[i] = place.first;
        places->columns[i] = place.columns;
        places->share.at[i] = place.fraction;
        places->density.at[i] = place.density;
        places->lobe_angle.at[i] = place.lobe_angle;
        if (i >= chunk->count && i % LMP_KERNEL_LANES_MAX == LMP_KERNEL_LANES_MAX - 1)
            break;
    }
    return (lmp_kernel_lobe_positions) { places->first, places->columns, places->share.at,
                                         places->density.at, places->lobe_angle.at };
}

static void gather_lobes(const shade_method *method, const chunk_planes *chunk,
                         const lmp_kernel_light *lights, size_t count) {
    const lmp_kernels *kernels = lmp_kernels_get();
    if (!method->response) {
        kernels->shade_zonal(method->bands, method->window, method->diffuse, &chunk->surfaces,
                             lights, count, chunk->count, &chunk->sums);
        return;
    }
    chunk_places places;
    const lmp_kernel_preintegrated_lobe response = { method->info.coefficients };
    const lmp_kernel_lobe_positions specular = find_places(&method->info, chunk, &places);
    kernels->shade_preintegrated_lobe(&response, &method->diffuse_place, &specular,
                                      &chunk->surfaces, lights, count, chunk->count, &chunk->sums);
}

static_assert(sizeof(lmp_kernel_slice) == sizeof(lmp_preintegrated_brdf_slice) &&
                  offsetof(lmp_kernel_slice, unit) == offsetof(lmp_preintegrated_brdf_slice, unit),
              "the kernels' slices are the responses'");

static void gather_measured(const chunk_planes *chunk, const lmp_kernel_light *lights, size_t count,
                            lmp_rgb ambient) {
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(chunk->response);
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

/* By the kernels. `method` is that of lobes, and else not read. */
static void shade_chunk(const shade_method *method, const lmp_surfaces *surfaces,
                        chunk_planes *chunk, const lmp_light *lights, size_t light_count,
                        size_t stride, float *rgb) {
    lmp_batch_plane scales[LMP_KERNEL_LIGHTS_MAX];
    load_chunk(surfaces, chunk);
    for (size_t light = 0; light < light_count; light += LMP_KERNEL_LIGHTS_MAX) {
        lmp_kernel_light some[LMP_KERNEL_LIGHTS_MAX];
        lmp_rgb ambient = { 0, 0, 0 };
        const size_t left = light_count - light;
        const size_t taken = left < LMP_KERNEL_LIGHTS_MAX ? left : LMP_KERNEL_LIGHTS_MAX;
        for (size_t i = 0; i < taken; i++)
            some[i] = take_light(&lights[light + i], chunk, &scales[i], &ambient);
        if (chunk->response)
            gather_measured(chunk, some, taken, ambient);
        else
            gather_lobes(method, chunk, some, taken);
        chunk->ambient[0] += ambient.r;
        chunk->ambient[1] += ambient.g;
        chunk->ambient[2] += ambient.b;
    }
    store_chunk(chunk, stride, rgb);
}

static void shade_surfaces(const shade_method *method, const lmp_surfaces *surfaces, size_t count,
                           const lmp_light *lights, size_t light_count, size_t rgb_stride,
                           float *rgb) {
    chunk_planes chunk;
    const size_t stride = rgb_stride ? rgb_stride : 3;
    for (size_t first = 0; first < count; first += LMP_BATCH) {
        size_t left[LMP_BATCH], left_count = lmp_batch_count(count, first);
        for (size_t i = 0; i < left_count; i++)
            left[i] = first + i;
        while (left_count > 0) {
            left_count = take_alike(surfaces, method->response != NULL, left, left_count, &chunk);
            if (chunk.table && !chunk.response)
                shade_tables(surfaces, &chunk, lights, light_count, stride, rgb);
            else
                shade_chunk(method, surfaces, &chunk, lights, light_count, stride, rgb);
        }
    }
}

void lmp_shade_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces, size_t count,
                 const lmp_light *lights, size_t light_count, size_t rgb_stride, float *rgb) {
    const lmp_shade_settings chosen = settings ? *settings : (lmp_shade_settings) { 0 };
    shade_method method = { .bands = chosen.bands ? chosen.bands : LMP_SHADE_BANDS_DEFAULT };
    assert(method.bands >= 1 && method.bands <= LMP_BANDS_MAX);
    lmp_sh_window(chosen.window, method.bands, chosen.window_size, method.window);
    lmp_lobe_diffuse(method.bands, method.diffuse);
    for (int l = 0; l < method.bands; l++)
        method.diffuse[l] /= pi;
    shade_surfaces(&method, surfaces, count, lights, light_count, rgb_stride, rgb);
}

void lmp_shade_preintegrated_n(const lmp_preintegrated_lobe *response, const lmp_surfaces *surfaces,
                               size_t count, const lmp_light *lights, size_t light_count,
                               size_t rgb_stride, float *rgb) {
    shade_method method = { .response = response,
                            .info = lmp_preintegrated_lobe_describe(response) };
    lmp_preintegrated_lobe_position place;
    lmp_preintegrated_lobe_lookup(&method.info, 1, &place);
    for (int i = 0; i < LMP_KERNEL_LANES_MAX; i++) {
        method.broad_first[i] = place.first;
        method.broad_columns[i] = place.columns;
        method.broad[0][i] = place.fraction;
        method.broad[1][i] = place.density;
        method.broad[2][i] = place.lobe_angle;
    }
    method.diffuse_place =
        (lmp_kernel_lobe_positions) { method.broad_first, method.broad_columns, method.broad[0],
                                      method.broad[1], method.broad[2] };
    shade_surfaces(&method, surfaces, count, lights, light_count, rgb_stride, rgb);
}

/* --- one surface ------------------------------------------------------------------------------ */

lmp_rgb lmp_shade_table_preintegrated(const lmp_preintegrated_brdf *response,
                                      const lmp_surface *surface, const lmp_light *lights,
                                      size_t count) {
    const lmp_surfaces one = {
        .position = lmp_vec3_array_same(&surface->position),
        .normal = lmp_vec3_array_same(&surface->normal),
        .view = lmp_vec3_array_same(&surface->view),
    };
    chunk_planes chunk;
    float rgb[3];
    chunk.table = NULL;
    chunk.response = response;
    chunk.count = 1;
    chunk.at[0] = 0;
    shade_chunk(NULL, &one, &chunk, lights, count, 3, rgb);
    return (lmp_rgb) { rgb[0], rgb[1], rgb[2] };
}

lmp_rgb lmp_shade_preintegrated(const lmp_preintegrated_lobe *response,
                                const lmp_material *material, const lmp_surface *surface,
                                const lmp_light *lights, size_t count) {
    const lmp_surfaces one = {
        .position = lmp_vec3_array_same(&surface->position),
        .normal = lmp_vec3_array_same(&surface->normal),
        .view = lmp_vec3_array_same(&surface->view),
        .diffuse = { &material->diffuse.r, &material->diffuse.g, &material->diffuse.b, 0 },
        .specular = { &material->specular.r, &material->specular.g, &material->specular.b, 0 },
        .exponent = { &material->exponent, 0 },
    };
    float rgb[3];
    if (material->response)
        return lmp_shade_table_preintegrated(material->response, surface, lights, count);
    if (material->table)
        return lmp_shade_table(material->table, surface, (lmp_vec3) { 0, 0, 0 }, lights, count);
    lmp_shade_preintegrated_n(response, &one, 1, lights, count, 3, rgb);
    return (lmp_rgb) { rgb[0], rgb[1], rgb[2] };
}
