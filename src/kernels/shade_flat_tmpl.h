/* SPDX-License-Identifier: MIT */
/* shade_flat_tmpl.h - shades lobes of surfaces under areas: the diffuse one by the closed
 * form of the outline above the horizon, Phong's by sums over bands along the edges. Where a light
 * looks small, a few of its points serve, at distances from which nobody sees the difference: the
 * sums along the edges would cancel, and take longer.
 *
 * Lanes are surfaces. A lane's bits do not depend on its neighbors: what some lanes of a register
 * need is computed for all, and each takes its own. */
#ifndef LAMPION_KERNELS_SHADE_FLAT_TMPL_H
#define LAMPION_KERNELS_SHADE_FLAT_TMPL_H

#include "src/kernels/disk_tmpl.h"
#include "src/kernels/polygon_tmpl.h"
#include "src/kernels/tube_tmpl.h"
#include "src/kernels/zonal_sums_tmpl.h"

/* Bands of all lobes whose weights are kept for a block of surfaces. */
#define FLAT_ROWS LMP_BANDS_MAX

/* --- outlines --------------------------------------------------------------------------------- */

/* Adds the responses to the outline of the lanes that need it. */
LMPI_INLINE void polygon_outline(int count, const lmpi_kernel_polygon *light,
                                 const flat_surfaces *at, const flat_place *place, vd *responses) {
    const vd half = vd_set(0.5), zero = vd_set(0), radius = vd_set(light->flat.radius);
    const vd least = vd_abs(place->up);
    polygon_seen seen;
    polygon_see(count, light, place->to, &seen);
    vd twice = vd_select_less(zero, place->up, polygon_open(count, &seen, at->normal), zero);
    const vd open = vd_select_less(half, place->outlined_diffuse, least, radius);
    if (__builtin_expect(vd_any_less(open, radius), 0)) {
        const vd cut = polygon_cut(count, &seen, at->normal, place->inner);
        twice = vd_select_less(least, radius, cut, twice);
    }
    responses[0] = vd_select_less(half, place->outlined_diffuse,
                                  vd_max(0.5 * place->side * twice, zero), responses[0]);
    if (at->lobe_count == 0 || !vd_any_less(half, place->outlined_lobes))
        return;
    const vd whole = polygon_solid_angle(count, &seen, place->side);
    polygon_complete(count, &seen);
    for (int k = 0; k < at->lobe_count; k++) {
        const float *weights = flat_weights(at, k);
        const vd rest = polygon_lobe(count, at->bands, at->tables, &seen, at->axis[k], weights);
        responses[1 + k] =
            vd_select_less(half, place->outlined_lobes,
                           vd_load(weights) * whole + place->side * rest, responses[1 + k]);
    }
}

/* Functions of their own for each number of corners, as straight-line code. */
#define POLYGON_OUTLINE(count)                                                                     \
    static LMPI_NOINLINE void polygon_outline_##count(const lmpi_kernel_polygon *light,            \
                                                      const flat_surfaces *at,                     \
                                                      const flat_place *place, vd *responses) {    \
        polygon_outline(count, light, at, place, responses);                                       \
    }
POLYGON_OUTLINE(4)
POLYGON_OUTLINE(6)
POLYGON_OUTLINE(8)
#undef POLYGON_OUTLINE

/* --- surfaces --------------------------------------------------------------------------------- */

/* A light, of which one is not NULL. */
typedef struct flat_light {
    const lmpi_kernel_polygon *polygon;
    const lmpi_kernel_disk *disk;
    const lmpi_kernel_tube *tube;
} flat_light;

LMPI_INLINE lmp_rgb flat_radiance(flat_light light) {
    return light.tube   ? light.tube->radiance
           : light.disk ? light.disk->flat.radiance
                        : light.polygon->flat.radiance;
}

LMPI_INLINE void flat_outline(flat_light light, const flat_surfaces *at, const flat_place *place,
                              vd *responses, vd *left) {
    if (light.disk)
        disk_outline(light.disk, at, place, responses, left);
    else if (light.polygon->count == 4)
        polygon_outline_4(light.polygon, at, place, responses);
    else if (light.polygon->count == 6)
        polygon_outline_6(light.polygon, at, place, responses);
    else
        polygon_outline_8(light.polygon, at, place, responses);
}

/* Computes the responses of all lobes to a light of radiance 1, and says which lanes are left. */
LMPI_INLINE void flat_respond(flat_light light, const flat_surfaces *at, vd *responses, vd *left) {
    const vd zero = vd_set(0), half = vd_set(0.5);
    const lmpi_kernel_flat *flat = light.disk ? &light.disk->flat : &light.polygon->flat;
    flat_place place;
    flat_locate(flat, at, &place);
    const vd lit = place.side * place.side;
    const vd outlined =
        vd_max(place.outlined_diffuse, at->lobe_count > 0 ? place.outlined_lobes : zero);
    vd pointed = lit - place.outlined_diffuse;
    if (at->lobe_count > 0)
        pointed = vd_max(pointed, lit - place.outlined_lobes);
    *left = zero;
    for (int k = 0; k <= at->lobe_count; k++)
        responses[k] = zero;
    if (vd_any_less(half, pointed)) {
        flat_points(flat, at, &place, responses);
        for (int k = 0; k <= at->lobe_count; k++)
            responses[k] = vd_select_less(half, lit, responses[k], zero);
    }
    if (vd_any_less(half, outlined))
        flat_outline(light, at, &place, responses, left);
}

LMPI_INLINE void flat_unit(const lmpi_kernel_vec3 *from, size_t e, vd to[3]) {
    const vd v[3] = { vd_load(from->x + e), vd_load(from->y + e), vd_load(from->z + e) };
    const vd per = vd_per_root(vd_dot(v, v));
    for (int k = 0; k < 3; k++)
        to[k] = v[k] * per;
}

/* Adds what one lobe receives of one light. */
LMPI_INLINE void flat_add(lmp_rgb rgb, vd response, size_t e, float *const planes[3]) {
    vd_store(planes[0] + e, vd_load(planes[0] + e) + (double)rgb.r * response);
    vd_store(planes[1] + e, vd_load(planes[1] + e) + (double)rgb.g * response);
    vd_store(planes[2] + e, vd_load(planes[2] + e) + (double)rgb.b * response);
}

/* A call: the lobes from `first` on, of which `lobes` fit at once, and polygons, a disk or a
 * tube. */
typedef struct flat_work {
    int bands, first, lobes;
    const flat_tables *tables;
    const lmpi_kernel_surfaces *surfaces;
    const lmpi_kernel_polygon *polygons;
    size_t light_count;
    const lmpi_kernel_disk *disk;
    const lmpi_kernel_tube *tube;
    float *left;
    const lmpi_kernel_accumulated *accumulated;
    vf *weights;
} flat_work;

/* Computes the weights of the lobes of a block of surfaces. Neighbors often have the same
 * material. */
LMPI_INLINE void flat_weigh(const flat_work *work, size_t e) {
    for (int k = 0; k < work->lobes; k++) {
        const float *exponent = work->surfaces->lobe[work->first + k].exponent + e;
        if (e == 0 || memcmp(exponent, exponent - LMPI_LANES, sizeof(vf)) != 0)
            zonal_phong(work->bands, work->tables->weights, vf_load(exponent),
                        work->weights + (ptrdiff_t)(k * work->bands));
    }
}

/* Shades a register of surfaces from e on, whose weights begin at lane `lane` of their block. */
LMPI_INLINE void flat_shade(const flat_work *work, size_t e, int lane) {
    flat_surfaces at = { .lobe_count = work->lobes,
                         .bands = work->bands,
                         .tables = work->tables,
                         .weights = (const float *)work->weights + lane };
    const lmpi_kernel_vec3 *point = &work->surfaces->point;
    at.point[0] = vd_load(point->x + e);
    at.point[1] = vd_load(point->y + e);
    at.point[2] = vd_load(point->z + e);
    flat_unit(&work->surfaces->normal, e, at.normal);
    for (int k = 0; k < work->lobes; k++)
        flat_unit(&work->surfaces->lobe[work->first + k].axis, e, at.axis[k]);
    for (size_t i = 0; i < work->light_count; i++) {
        const flat_light light = { work->left ? NULL : work->polygons + i, work->disk, work->tube };
        const lmp_rgb radiance = flat_radiance(light);
        vd responses[FLAT_RESPONSES], left;
        if (light.tube)
            tube_respond(light.tube, &at, responses, &left);
        else
            flat_respond(light, &at, responses, &left);
        if (work->left)
            vd_store(work->left + e, left);
        if (work->first == 0)
            flat_add(radiance, responses[0] * (1 / 3.14159265358979323846), e,
                     work->accumulated->diffuse);
        for (int k = 0; k < work->lobes; k++)
            flat_add(radiance, responses[1 + k], e, work->accumulated->specular[work->first + k]);
    }
}

static void flat_call(int bands, const float *window, size_t count, flat_work *work) {
    flat_tables tables;
    vf weights[FLAT_ROWS];
    work->bands = bands < FLAT_BANDS_MIN ? FLAT_BANDS_MIN : bands;
    work->tables = &tables;
    work->weights = weights;
    work->first = 0;
    flat_prepare(bands, window, &tables);
    do {
        const int rest = work->surfaces->lobe_count - work->first, fit = FLAT_ROWS / work->bands;
        work->lobes = rest < fit ? rest : fit;
        for (size_t e = 0; e < count; e += LMPI_LANES) {
            flat_weigh(work, e);
            for (int lane = 0; lane < LMPI_LANES; lane += LMPI_DOUBLES)
                flat_shade(work, e + (size_t)lane, lane);
        }
        work->first += work->lobes;
    } while (work->first < work->surfaces->lobe_count);
}

static void kernel_shade_polygons(int bands, const float *window,
                                  const lmpi_kernel_surfaces *surfaces,
                                  const lmpi_kernel_polygon *lights, size_t light_count,
                                  size_t count, const lmpi_kernel_accumulated *accumulated) {
    flat_work work = { .surfaces = surfaces,
                       .polygons = lights,
                       .light_count = light_count,
                       .accumulated = accumulated };
    flat_call(bands, window, count, &work);
}

static void kernel_shade_disk(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                              const lmpi_kernel_disk *light, size_t count,
                              const lmpi_kernel_accumulated *accumulated, float *left) {
    flat_work work = { .surfaces = surfaces,
                       .light_count = 1,
                       .disk = light,
                       .left = left,
                       .accumulated = accumulated };
    flat_call(bands, window, count, &work);
}

static void kernel_shade_tube(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                              const lmpi_kernel_tube *light, size_t count,
                              const lmpi_kernel_accumulated *accumulated, float *left) {
    flat_work work = { .surfaces = surfaces,
                       .light_count = 1,
                       .tube = light,
                       .left = left,
                       .accumulated = accumulated };
    flat_call(bands, window, count, &work);
}

#endif
