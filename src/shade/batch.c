/* SPDX-License-Identifier: MIT */
/* batch.c - shading many surfaces: chunks of planes, every light as a sphere or a fixed cap. */
#include "src/kernels/batch.h"
#include "src/base/tables.h"
#include "src/response/eval.h"

#include <lampion/shade.h>

#include <assert.h>
#include <math.h>

/* A Dirac is a cap this wide, or a sphere this large, of the same strength: the difference is below
 * rounding at any number of bands. */
#define DIRAC_SINE   1e-5f
#define DIRAC_RADIUS LMP_POINT_DISTANCE_MIN

static const float pi = 3.14159265f;

/* --- a chunk ---------------------------------------------------------------------------------- */

typedef struct chunk {
    size_t count;
    lmp_batch_vec3 point, normal, view, diffuse, specular;
    lmp_batch_plane exponent;
    lmp_batch_plane gathered[6];
    lmp_kernel_surfaces surfaces;
    lmp_kernel_gathered sums;
} chunk_planes;

static lmp_vec3 vector_at(const lmp_vec3_array *array, size_t i) {
    lmp_vec3 v;
    memcpy(&v.x, (const char *)array->x + i * array->stride, sizeof v.x);
    memcpy(&v.y, (const char *)array->y + i * array->stride, sizeof v.y);
    memcpy(&v.z, (const char *)array->z + i * array->stride, sizeof v.z);
    return v;
}

static void load_chunk(const lmp_surfaces *surfaces, size_t first, size_t count,
                       chunk_planes *chunk) {
    chunk->count = count;
    chunk->surfaces.point = lmp_batch_vectors(&surfaces->position, first, count, &chunk->point);
    chunk->surfaces.normal = lmp_batch_vectors(&surfaces->normal, first, count, &chunk->normal);
    chunk->surfaces.view = lmp_batch_vectors(&surfaces->view, first, count, &chunk->view);
    lmp_batch_vectors(&surfaces->diffuse, first, count, &chunk->diffuse);
    lmp_batch_vectors(&surfaces->specular, first, count, &chunk->specular);
    lmp_batch_floats(surfaces->exponent.at, surfaces->exponent.stride, first, count,
                     &chunk->exponent);
    chunk->surfaces.exponent = chunk->exponent.at;
    for (int c = 0; c < 3; c++) {
        chunk->sums.diffuse[c] = chunk->gathered[c].at;
        chunk->sums.specular[c] = chunk->gathered[3 + c].at;
    }
}

static void store_chunk(const chunk_planes *chunk, const float *ambient, size_t stride,
                        float *rgb) {
    const float *diffuse[3] = { chunk->diffuse.x.at, chunk->diffuse.y.at, chunk->diffuse.z.at };
    const float *specular[3] = { chunk->specular.x.at, chunk->specular.y.at, chunk->specular.z.at };
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < chunk->count; i++) {
            const float sum = diffuse[c][i] * (chunk->gathered[c].at[i] + ambient[c]) +
                              specular[c][i] * (chunk->gathered[3 + c].at[i] + ambient[c]);
            rgb[i * stride + c] = sum > 0 ? sum : 0;
        }
}

/* Surface i's pointer, at a stride. */
static const void *pointer_at(const void *first, size_t stride, size_t i) {
    const void *at = NULL;
    if (first)
        memcpy(&at, (const char *)first + i * stride, sizeof at);
    return at;
}

/* Surfaces with a table: one by one, over what their lobes gave. */
static void shade_tables(const lmp_surfaces *surfaces, bool preintegrated, size_t first,
                         const chunk_planes *chunk, const lmp_light *lights, size_t light_count,
                         size_t stride, float *rgb) {
    for (size_t i = 0; surfaces->table && i < chunk->count; i++) {
        const lmp_brdf_table *table =
            pointer_at(surfaces->table, surfaces->table_stride, first + i);
        const lmp_brdf_response *response =
            preintegrated ? pointer_at(surfaces->response, surfaces->response_stride, first + i)
                          : NULL;
        if (!table)
            continue;
        const lmp_surface surface = { vector_at(&surfaces->position, first + i),
                                      vector_at(&surfaces->normal, first + i),
                                      vector_at(&surfaces->view, first + i) };
        const lmp_rgb color =
            response
                ? lmp_shade_table_preintegrated(response, &surface, lights, light_count)
                : lmp_shade_table(table, &surface, (lmp_vec3) { 0, 0, 0 }, lights, light_count);
        memcpy(rgb + i * stride, &color, sizeof color);
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

/* The light as one sphere or cap, and what it adds from every direction. scale: planes for spots.
 */
static lmp_kernel_light take_light(const lmp_light *light, const chunk_planes *chunk,
                                   lmp_batch_plane *scale, float ambient[3]) {
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
    ambient[0] += cap.ambient.r;
    ambient[1] += cap.ambient.g;
    ambient[2] += cap.ambient.b;
    const float sine = cap.sin2 > 0 ? sqrtf(cap.sin2) : DIRAC_SINE;
    return fixed_cap(cap.axis, sine, scaled(cap.strength, 1 / (pi * sine * sine)));
}

/* --- methods ---------------------------------------------------------------------------------- */

/* How the lobes are known: by bands, or by a response. */
typedef struct method {
    int bands;
    float window[LMP_BANDS_MAX], diffuse[LMP_BANDS_MAX];
    const lmp_response *response;
    lmp_response_info info;
    uint32_t broad_first[LMP_KERNEL_LANES_MAX], broad_columns[LMP_KERNEL_LANES_MAX];
    float broad[3][LMP_KERNEL_LANES_MAX];
    lmp_kernel_places diffuse_place;
} shade_method;

/* Where each surface's lobe lies. */
typedef struct chunk_places {
    uint32_t first[LMP_BATCH], columns[LMP_BATCH];
    lmp_batch_plane share, density, lobe_angle;
} chunk_places;

static lmp_kernel_places find_places(const lmp_response_info *info, const chunk_planes *chunk,
                                     chunk_places *places) {
    lmp_response_place place = { 0 };
    float exponent = -1;
    for (size_t i = 0; i < LMP_BATCH; i++) {
        /* Past the last surface, its place again: a kernel reads whole vectors. */
        const float e = chunk->exponent.at[i < chunk->count ? i : chunk->count - 1];
        if (e < exponent || e > exponent)
            lmp_response_seek(info, e, &place);
        exponent = e;
        places->first[i] = place.first;
        places->columns[i] = place.columns;
        places->share.at[i] = place.share;
        places->density.at[i] = place.density;
        places->lobe_angle.at[i] = place.lobe_angle;
        if (i >= chunk->count && i % LMP_KERNEL_LANES_MAX == LMP_KERNEL_LANES_MAX - 1)
            break;
    }
    return (lmp_kernel_places) { places->first, places->columns, places->share.at,
                                 places->density.at, places->lobe_angle.at };
}

static void gather(const shade_method *method, const chunk_planes *chunk,
                   const lmp_kernel_light *lights, size_t count) {
    const lmp_kernels *kernels = lmp_kernels_get();
    if (!method->response) {
        kernels->shade_zonal(method->bands, method->window, method->diffuse, &chunk->surfaces,
                             lights, count, chunk->count, &chunk->sums);
        return;
    }
    chunk_places places;
    const lmp_kernel_response response = { method->info.coefficients };
    const lmp_kernel_places specular = find_places(&method->info, chunk, &places);
    kernels->shade_response(&response, &method->diffuse_place, &specular, &chunk->surfaces, lights,
                            count, chunk->count, &chunk->sums);
}

static void shade_chunks(const shade_method *method, const lmp_surfaces *surfaces, size_t count,
                         const lmp_light *lights, size_t light_count, size_t rgb_stride,
                         float *rgb) {
    chunk_planes chunk = { 0 };
    lmp_batch_plane scales[LMP_KERNEL_LIGHTS_MAX];
    const size_t stride = rgb_stride ? rgb_stride : 3;
    for (size_t first = 0; first < count; first += LMP_BATCH) {
        load_chunk(surfaces, first, lmp_batch_count(count, first), &chunk);
        memset(chunk.gathered, 0, sizeof chunk.gathered);
        float ambient[3] = { 0, 0, 0 };
        for (size_t light = 0; light < light_count; light += LMP_KERNEL_LIGHTS_MAX) {
            lmp_kernel_light some[LMP_KERNEL_LIGHTS_MAX];
            const size_t taken = light_count - light < LMP_KERNEL_LIGHTS_MAX
                                     ? light_count - light
                                     : LMP_KERNEL_LIGHTS_MAX;
            for (size_t i = 0; i < taken; i++)
                some[i] = take_light(&lights[light + i], &chunk, &scales[i], ambient);
            gather(method, &chunk, some, taken);
        }
        store_chunk(&chunk, ambient, stride, rgb + first * stride);
        shade_tables(surfaces, method->response != NULL, first, &chunk, lights, light_count, stride,
                     rgb + first * stride);
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
    shade_chunks(&method, surfaces, count, lights, light_count, rgb_stride, rgb);
}

void lmp_shade_preintegrated_n(const lmp_response *response, const lmp_surfaces *surfaces,
                               size_t count, const lmp_light *lights, size_t light_count,
                               size_t rgb_stride, float *rgb) {
    shade_method method = { .response = response, .info = lmp_response_describe(response) };
    lmp_response_place place;
    lmp_response_seek(&method.info, 1, &place);
    for (int i = 0; i < LMP_KERNEL_LANES_MAX; i++) {
        method.broad_first[i] = place.first;
        method.broad_columns[i] = place.columns;
        method.broad[0][i] = place.share;
        method.broad[1][i] = place.density;
        method.broad[2][i] = place.lobe_angle;
    }
    method.diffuse_place =
        (lmp_kernel_places) { method.broad_first, method.broad_columns, method.broad[0],
                              method.broad[1], method.broad[2] };
    shade_chunks(&method, surfaces, count, lights, light_count, rgb_stride, rgb);
}

/* --- one surface ------------------------------------------------------------------------------ */

lmp_rgb lmp_shade_preintegrated(const lmp_response *response, const lmp_material *material,
                                const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const lmp_surfaces one = {
        .position = lmp_vec3_array_same(&surface->position),
        .normal = lmp_vec3_array_same(&surface->normal),
        .view = lmp_vec3_array_same(&surface->view),
        .diffuse = { &material->diffuse.r, &material->diffuse.g, &material->diffuse.b, 0 },
        .specular = { &material->specular.r, &material->specular.g, &material->specular.b, 0 },
        .exponent = { &material->exponent, 0 },
    };
    float rgb[3];
    if (material->table && material->response)
        return lmp_shade_table_preintegrated(material->response, surface, lights, count);
    if (material->table)
        return lmp_shade_table(material->table, surface, (lmp_vec3) { 0, 0, 0 }, lights, count);
    lmp_shade_preintegrated_n(response, &one, 1, lights, count, 3, rgb);
    return (lmp_rgb) { rgb[0], rgb[1], rgb[2] };
}
