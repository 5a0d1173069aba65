/* SPDX-License-Identifier: MIT */
/* flat_tmpl.h - where flat lights are for surfaces, and what the points give that stand for one
 * that looks small. In double, because what a light gives that looks small is the rest of what
 * nearly cancels. Lanes are surfaces. */
#ifndef LAMPION_KERNELS_FLAT_TMPL_H
#define LAMPION_KERNELS_FLAT_TMPL_H

#include "src/base/unroll.h"
#include "src/kernels/lanes.h"
#include "src/kernels/shade.h"

/* The fewest bands; fewer are padded by bands of weight 0. */
enum { FLAT_BANDS_MIN = 2 };

/* Numbers per band that all points share. The recurrence of Wang and Ramamoorthi (2018) for I_l =
 * ∫ P_l ds and D_l = ∫ P'_l ds, without I_l, is
 *
 *     D_(l+2) = (1 + g - b z²) D_l - g D_(l-2) - b [P_l p'],  b = (2l+1)(2l+3) / (l+1)²,
 *                                                             g = b l² / (4l²-1),
 *
 * where z is the cosine of the lobe's axis with the edge's pole, and [P_l p'] is P_l times the
 * slope of the cosine of the axis at the edge's end, less that at its beginning. With the monic
 * p_l = P_l / k_l, k_l = (2l-1)!!/l!, and d_(l+2) = D_(l+2) / (b k_l), d_1 = D_1, two factors are
 * 1. */
typedef struct flat_tables {
    double same[LMP_BANDS_MAX], less[LMP_BANDS_MAX], below[LMP_BANDS_MAX]; /* of d_l, z² d_l … */
    double of_p[LMP_BANDS_MAX]; /* p_(l+1) = x p_l - of_p p_(l-1) */
    double to_p[LMP_BANDS_MAX]; /* makes a weight of d_l one of p_l */
    /* The same of monic slopes, P'_l = l k_l u_l, u_(l+2) = x u_(l+1) - of_slope[l] u_l. */
    double of_slope[LMP_BANDS_MAX], to_slope[LMP_BANDS_MAX];
    float weights[LMP_BANDS_MAX]; /* of d_l, times the window */
} flat_tables;

static inline void flat_prepare(int bands, const float *window, flat_tables *tables) {
    const double pi = 3.14159265358979323846;
    double k = 1;
    for (int i = 0; i < bands || i < FLAT_BANDS_MIN; i++) {
        const double l = i, square4 = 4 * l * l - 1;
        const double b = (2 * l + 1) * (2 * l + 3) / ((l + 1) * (l + 1)), g = b * l * l / square4;
        const double less = i < 2 ? l : l / (l - 1);
        k *= i < 1 ? 1 : (2 * l - 1) / l;
        tables->less[i] = less;
        tables->same[i] = (1 + g) * less / b;
        tables->below[i] =
            i < 3 ? 0 : g / b * tables->less[i - 2] * l * (l - 1) / (square4 - 8 * (l - 0.5));
        tables->of_p[i] = l * l / square4;
        tables->to_p[i] = i < 1 ? 1 : l * (l + 1) / less;
        tables->of_slope[i] = ((l + 1) * (l + 1) - 1) / (4 * (l + 1) * (l + 1) - 1);
        tables->to_slope[i] = i < 1 ? 0 : l / less;
        tables->weights[i] = (float)((2 * l + 1) / (4 * pi) * k / tables->to_p[i] *
                                     (i < bands ? (double)window[i] : 0));
    }
}

/* The most nodes side by side. */
enum { FLAT_NODES = 6 };

/* Beyond so many radii a light that the horizon may cut is points, too. */
#define FLAT_TINY 1e6

enum { FLAT_RESPONSES = 1 + LMPI_KERNEL_LOBES_MAX }; /* of the diffuse lobe, then of Phong's */

/* A register of surfaces. Directions are unit; weights are those of their lobes. */
typedef struct flat_surfaces {
    vd point[3], normal[3], axis[LMPI_KERNEL_LOBES_MAX][3];
    int lobe_count, bands;
    const flat_tables *tables;
    const float *weights;
} flat_surfaces;

/* Where a light is, in its units: its position; the direction straight to its plane, and how far
 * that is; the side that is seen, 1 or -1, or 0 where it does not shine; and how far above the
 * horizon its middle is. The last two are 1 in lanes that need the outline, else 0. */
typedef struct flat_place {
    vd to[3], inner[3], height, side, up;
    vd outlined_diffuse, outlined_lobes;
} flat_place;

LMPI_INLINE const float *flat_weights(const flat_surfaces *at, int lobe) {
    return at->weights + (ptrdiff_t)(lobe * at->bands) * LMPI_LANES;
}

/* Locates a light. Points serve for the diffuse lobe from some distance on where the horizon cannot
 * cut the light, and for the others from a distance on that grows with the bands. */
LMPI_INLINE void flat_locate(const lmpi_kernel_flat *light, const flat_surfaces *at,
                             flat_place *place) {
    const vd zero = vd_set(0), one = vd_set(1);
    const double position[3] = { (double)light->position.x, (double)light->position.y,
                                 (double)light->position.z };
    const double radius = light->radius, far = light->far_for_irradiance * radius;
    const double far_lobes = light->far_for_lobes_a_band * at->bands * radius;
    const double tiny = FLAT_TINY * radius;
    vd center[3], along = zero;
    for (int k = 0; k < 3; k++) {
        place->to[k] = (position[k] - at->point[k]) * light->per_unit;
        center[k] = place->to[k] + light->centroid[k];
        along = along + light->area[k] * (place->to[k] + light->corner[k]);
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

/* --- nodes ------------------------------------------------------------------------------------ */

/* Computes what a lobe's sum over bands from l = 1 on is at nodes of an outline, for the cosines z
 * of its axis there: times the part of the axis along w x dw these sum to ∫ P_l. P'_l is l k_l
 * times a monic u_l; Clenshaw's sum goes from the last band on. */
LMPI_INLINE void flat_slopes(int count, int bands, const flat_tables *tables, const float *weights,
                             const vd *z, vd *slopes) {
    vd y2[FLAT_NODES];
    LMPI_UNROLL for (int i = 0; i < count; i++) slopes[i] = y2[i] = vd_set(0);
    LMPI_ROLLED for (int l = bands - 1; l >= 1; l--) {
        const vd weight = vd_load(weights + (ptrdiff_t)l * LMPI_LANES) * tables->to_slope[l];
        LMPI_UNROLL for (int i = 0; i < count; i++) {
            const vd y0 = (weight - tables->of_slope[l] * y2[i]) + z[i] * slopes[i];
            y2[i] = slopes[i];
            slopes[i] = y0;
        }
    }
}

/* --- points ----------------------------------------------------------------------------------- */

/* Sums a lobe around q under points of weights `each` from the last band to the first, as
 * zonal_phong_sum does. */
LMPI_INLINE vd flat_points_lobe(int bands, const flat_tables *tables, const float *weights,
                                const vd (*direction)[3], const vd *each, const vd q[3]) {
    vd x[LMPI_FLAT_POINTS], y1[LMPI_FLAT_POINTS], y2[LMPI_FLAT_POINTS], sum = vd_set(0);
    LMPI_UNROLL for (int i = 0; i < LMPI_FLAT_POINTS; i++) {
        x[i] = vd_dot(q, direction[i]);
        y1[i] = y2[i] = vd_set(0);
    }
    LMPI_ROLLED for (int l = bands - 1; l >= 0; l--) {
        const vd weight = vd_load(weights + (ptrdiff_t)l * LMPI_LANES) * tables->to_p[l];
        const double of_p = l + 1 < bands ? tables->of_p[l + 1] : 0;
        LMPI_UNROLL for (int i = 0; i < LMPI_FLAT_POINTS; i++) {
            const vd y0 = (weight - of_p * y2[i]) + x[i] * y1[i];
            y2[i] = y1[i];
            y1[i] = y0;
        }
    }
    LMPI_UNROLL for (int i = 0; i < LMPI_FLAT_POINTS; i++) sum = sum + each[i] * y1[i];
    return sum;
}

/* Computes the responses to the points, each a Dirac of the area that it stands for times the
 * cosine at the light over the square of the distance. */
static LMPI_NOINLINE void flat_points(const lmpi_kernel_flat *light, const flat_surfaces *at,
                                      const flat_place *place, vd *responses) {
    vd direction[LMPI_FLAT_POINTS][3], each[LMPI_FLAT_POINTS];
    responses[0] = vd_set(0);
    LMPI_UNROLL for (int i = 0; i < LMPI_FLAT_POINTS; i++) {
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
        responses[1 + k] = flat_points_lobe(at->bands, at->tables, flat_weights(at, k),
                                            (const vd(*)[3])direction, each, at->axis[k]);
}

#endif
