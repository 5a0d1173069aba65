/* SPDX-License-Identifier: MIT */
/* shade_polygons_tmpl.h - shades lobes of surfaces under flat lights with corners: the diffuse one
 * by the closed form of the outline above the horizon, Phong's by sums over bands along the edges.
 * Where a light looks small, a few of its points serve, at distances from which nobody sees the
 * difference: the sums along the edges would cancel, and take longer.
 *
 * Lanes are surfaces. A lane's bits do not depend on its neighbors: what some lanes of a register
 * need is computed for all, and each takes its own. */
#ifndef LAMPION_KERNELS_SHADE_POLYGONS_TMPL_H
#define LAMPION_KERNELS_SHADE_POLYGONS_TMPL_H

#include "src/kernels/polygon_tmpl.h"
#include "src/kernels/shade.h"
#include "src/kernels/zonal_sums_tmpl.h"

/* Beyond so many radii a light that the horizon may cut is points, too. */
#define POLYGON_TINY 1e6

/* Bands of all lobes whose weights are kept for a block of surfaces. */
#define POLYGON_ROWS LMP_BANDS_MAX

enum { POLYGON_RESPONSES = 1 + LMPI_KERNEL_LOBES_MAX }; /* of the diffuse lobe, then of Phong's */

/* A register of surfaces. Directions are unit; weights are those of their lobes. */
typedef struct polygon_surfaces {
    vd point[3], normal[3], axis[LMPI_KERNEL_LOBES_MAX][3];
    int lobe_count, bands;
    const polygon_tables *tables;
    const float *weights;
} polygon_surfaces;

/* Where a light is, in its units: its position; the direction straight to its plane, and how far
 * that is; the side that is seen, 1 or -1, or 0 where it does not shine; and how far above the
 * horizon its middle is. The last two are 1 in lanes that need the outline, else 0. */
typedef struct polygon_place {
    vd to[3], inner[3], height, side, up;
    vd outlined_diffuse, outlined_lobes;
} polygon_place;

LMPI_INLINE const float *polygon_weights(const polygon_surfaces *at, int lobe) {
    return at->weights + (ptrdiff_t)(lobe * at->bands) * LMPI_LANES;
}

/* Locates a light. Points serve for the diffuse lobe from some distance on where the horizon cannot
 * cut the light, and for the others from a distance on that grows with the bands. */
LMPI_INLINE void polygon_locate(const lmpi_kernel_polygon *light, const polygon_surfaces *at,
                                polygon_place *place) {
    const vd zero = vd_set(0), one = vd_set(1);
    const double position[3] = { (double)light->position.x, (double)light->position.y,
                                 (double)light->position.z };
    const double radius = light->radius, far = light->far_for_irradiance * radius;
    const double far_lobes = light->far_for_lobes_a_band * at->bands * radius;
    const double tiny = POLYGON_TINY * radius;
    vd center[3], along = zero;
    for (int k = 0; k < 3; k++) {
        place->to[k] = (position[k] - at->point[k]) * light->per_unit;
        center[k] = place->to[k] + light->centroid[k];
        along = along + light->area[k] * (place->to[k] + light->corner[0][k]);
    }
    const vd behind = vd_select_less(zero, along, vd_set(light->two_sided ? -1 : 0), zero);
    place->side = vd_select_less(along, zero, one, behind);
    place->height = vd_abs(along) * light->per_area;
    for (int k = 0; k < 3; k++)
        place->inner[k] =
            vd_select_less(along, zero, vd_set(-light->normal[k]), vd_set(light->normal[k]));
    place->up = vd_dot(at->normal, center);
    const vd distance2 = vd_dot(center, center), lit = place->side * place->side;
    const vd near = vd_select_less(vd_set(far * far), distance2, zero, lit);
    const vd cut = vd_select_less(vd_set(tiny * tiny), distance2, zero, lit);
    place->outlined_diffuse = vd_select_less(vd_abs(place->up), vd_set(radius), cut, near);
    place->outlined_lobes = vd_select_less(vd_set(far_lobes * far_lobes), distance2, zero, lit);
}

/* --- points ----------------------------------------------------------------------------------- */

/* Sums a lobe around q under points of weights `each` from the last band to the first, as
 * zonal_phong_sum does. */
LMPI_INLINE vd polygon_points_lobe(int bands, const polygon_tables *tables, const float *weights,
                                   const vd (*direction)[3], const vd *each, const vd q[3]) {
    vd x[LMPI_POLYGON_POINTS], y1[LMPI_POLYGON_POINTS], y2[LMPI_POLYGON_POINTS], sum = vd_set(0);
    LMPI_UNROLL for (int i = 0; i < LMPI_POLYGON_POINTS; i++) {
        x[i] = vd_dot(q, direction[i]);
        y1[i] = y2[i] = vd_set(0);
    }
    LMPI_ROLLED for (int l = bands - 1; l >= 0; l--) {
        const vd weight = vd_load(weights + (ptrdiff_t)l * LMPI_LANES) * tables->to_p[l];
        const double of_p = l + 1 < bands ? tables->of_p[l + 1] : 0;
        LMPI_UNROLL for (int i = 0; i < LMPI_POLYGON_POINTS; i++) {
            const vd y0 = (weight - of_p * y2[i]) + x[i] * y1[i];
            y2[i] = y1[i];
            y1[i] = y0;
        }
    }
    LMPI_UNROLL for (int i = 0; i < LMPI_POLYGON_POINTS; i++) sum = sum + each[i] * y1[i];
    return sum;
}

/* Computes the responses to the points, each a Dirac of the area that it stands for times the
 * cosine at the light over the square of the distance. */
static LMPI_NOINLINE void polygon_points(const lmpi_kernel_polygon *light,
                                         const polygon_surfaces *at, const polygon_place *place,
                                         vd *responses) {
    vd direction[LMPI_POLYGON_POINTS][3], each[LMPI_POLYGON_POINTS];
    responses[0] = vd_set(0);
    LMPI_UNROLL for (int i = 0; i < LMPI_POLYGON_POINTS; i++) {
        vd *w = direction[i];
        for (int k = 0; k < 3; k++)
            w[k] = place->to[k] + light->point[i][k];
        const vd per = vd_per_root(vd_dot(w, w));
        for (int k = 0; k < 3; k++)
            w[k] = w[k] * per;
        each[i] = light->each * (place->height * per) * (per * per);
        responses[0] = responses[0] + each[i] * vd_max(vd_dot(at->normal, w), vd_set(0));
    }
    for (int k = 0; k < at->lobe_count; k++)
        responses[1 + k] = polygon_points_lobe(at->bands, at->tables, polygon_weights(at, k),
                                               (const vd(*)[3])direction, each, at->axis[k]);
}

/* --- outlines --------------------------------------------------------------------------------- */

/* Adds the responses to the outline of the lanes that need it. */
LMPI_INLINE void polygon_outline(int count, const lmpi_kernel_polygon *light,
                                 const polygon_surfaces *at, const polygon_place *place,
                                 vd *responses) {
    const vd half = vd_set(0.5), zero = vd_set(0), radius = vd_set(light->radius);
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
        const float *weights = polygon_weights(at, k);
        const vd rest = polygon_lobe(count, at->bands, at->tables, &seen, at->axis[k], weights);
        responses[1 + k] =
            vd_select_less(half, place->outlined_lobes,
                           vd_load(weights) * whole + place->side * rest, responses[1 + k]);
    }
}

/* Functions of their own for each number of corners, as straight-line code. */
#define POLYGON_OUTLINE(count)                                                                     \
    static LMPI_NOINLINE void polygon_outline_##count(const lmpi_kernel_polygon *light,            \
                                                      const polygon_surfaces *at,                  \
                                                      const polygon_place *place, vd *responses) { \
        polygon_outline(count, light, at, place, responses);                                       \
    }
POLYGON_OUTLINE(4)
POLYGON_OUTLINE(6)
POLYGON_OUTLINE(8)
#undef POLYGON_OUTLINE

/* --- surfaces --------------------------------------------------------------------------------- */

/* Computes the responses of all lobes to a light of radiance 1. */
LMPI_INLINE void polygon_respond(const lmpi_kernel_polygon *light, const polygon_surfaces *at,
                                 vd *responses) {
    const vd zero = vd_set(0), half = vd_set(0.5);
    polygon_place place;
    polygon_locate(light, at, &place);
    const vd lit = place.side * place.side;
    const vd outlined =
        vd_max(place.outlined_diffuse, at->lobe_count > 0 ? place.outlined_lobes : zero);
    vd pointed = lit - place.outlined_diffuse;
    if (at->lobe_count > 0)
        pointed = vd_max(pointed, lit - place.outlined_lobes);
    for (int k = 0; k <= at->lobe_count; k++)
        responses[k] = zero;
    if (vd_any_less(half, pointed)) {
        polygon_points(light, at, &place, responses);
        for (int k = 0; k <= at->lobe_count; k++)
            responses[k] = vd_select_less(half, lit, responses[k], zero);
    }
    if (vd_any_less(half, outlined)) {
        if (light->count == 4)
            polygon_outline_4(light, at, &place, responses);
        else if (light->count == 6)
            polygon_outline_6(light, at, &place, responses);
        else
            polygon_outline_8(light, at, &place, responses);
    }
}

LMPI_INLINE void polygon_unit(const lmpi_kernel_vec3 *from, size_t e, vd to[3]) {
    const vd v[3] = { vd_load(from->x + e), vd_load(from->y + e), vd_load(from->z + e) };
    const vd per = vd_per_root(vd_dot(v, v));
    for (int k = 0; k < 3; k++)
        to[k] = v[k] * per;
}

/* Adds what one lobe receives of one light. */
LMPI_INLINE void polygon_add(lmp_rgb rgb, vd response, size_t e, float *const planes[3]) {
    vd_store(planes[0] + e, vd_load(planes[0] + e) + (double)rgb.r * response);
    vd_store(planes[1] + e, vd_load(planes[1] + e) + (double)rgb.g * response);
    vd_store(planes[2] + e, vd_load(planes[2] + e) + (double)rgb.b * response);
}

/* A call: the lobes from `first` on, of which `lobes` fit at once. */
typedef struct polygon_work {
    int bands, first, lobes;
    const polygon_tables *tables;
    const lmpi_kernel_surfaces *surfaces;
    const lmpi_kernel_polygon *lights;
    size_t light_count;
    const lmpi_kernel_accumulated *accumulated;
    vf *weights;
} polygon_work;

/* Computes the weights of the lobes of a block of surfaces. Neighbors often have the same
 * material. */
LMPI_INLINE void polygon_weigh(const polygon_work *work, size_t e) {
    for (int k = 0; k < work->lobes; k++) {
        const float *exponent = work->surfaces->lobe[work->first + k].exponent + e;
        if (e == 0 || memcmp(exponent, exponent - LMPI_LANES, sizeof(vf)) != 0)
            zonal_phong(work->bands, work->tables->weights, vf_load(exponent),
                        work->weights + (ptrdiff_t)(k * work->bands));
    }
}

/* Shades a register of surfaces from e on, whose weights begin at lane `lane` of their block. */
LMPI_INLINE void polygon_shade(const polygon_work *work, size_t e, int lane) {
    polygon_surfaces at = { .lobe_count = work->lobes,
                            .bands = work->bands,
                            .tables = work->tables,
                            .weights = (const float *)work->weights + lane };
    const lmpi_kernel_vec3 *point = &work->surfaces->point;
    at.point[0] = vd_load(point->x + e);
    at.point[1] = vd_load(point->y + e);
    at.point[2] = vd_load(point->z + e);
    polygon_unit(&work->surfaces->normal, e, at.normal);
    for (int k = 0; k < work->lobes; k++)
        polygon_unit(&work->surfaces->lobe[work->first + k].axis, e, at.axis[k]);
    for (size_t i = 0; i < work->light_count; i++) {
        const lmpi_kernel_polygon *light = &work->lights[i];
        vd responses[POLYGON_RESPONSES];
        polygon_respond(light, &at, responses);
        if (work->first == 0)
            polygon_add(light->radiance, responses[0] * (1 / 3.14159265358979323846), e,
                        work->accumulated->diffuse);
        for (int k = 0; k < work->lobes; k++)
            polygon_add(light->radiance, responses[1 + k], e,
                        work->accumulated->specular[work->first + k]);
    }
}

static void kernel_shade_polygons(int bands, const float *window,
                                  const lmpi_kernel_surfaces *surfaces,
                                  const lmpi_kernel_polygon *lights, size_t light_count,
                                  size_t count, const lmpi_kernel_accumulated *accumulated) {
    polygon_tables tables;
    vf weights[POLYGON_ROWS];
    polygon_work work = { .bands = bands < POLYGON_BANDS_MIN ? POLYGON_BANDS_MIN : bands,
                          .tables = &tables,
                          .surfaces = surfaces,
                          .lights = lights,
                          .light_count = light_count,
                          .accumulated = accumulated,
                          .weights = weights };
    polygon_prepare(bands, window, &tables);
    do {
        const int left = surfaces->lobe_count - work.first, fit = POLYGON_ROWS / work.bands;
        work.lobes = left < fit ? left : fit;
        for (size_t e = 0; e < count; e += LMPI_LANES) {
            polygon_weigh(&work, e);
            for (int lane = 0; lane < LMPI_LANES; lane += LMPI_DOUBLES)
                polygon_shade(&work, e + (size_t)lane, lane);
        }
        work.first += work.lobes;
    } while (work.first < surfaces->lobe_count);
}

#endif
