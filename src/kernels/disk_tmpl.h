/* SPDX-License-Identifier: MIT */
/* disk_tmpl.h - what is seen of a disk: irradiance by a closed form where the horizon does not cut
 * it, lobes by the trapezoidal rule around its edge, which converges fast, because all is periodic
 * there. src/light/loop.h has the integrals. Lanes are surfaces. */
#ifndef LAMPION_KERNELS_DISK_TMPL_H
#define LAMPION_KERNELS_DISK_TMPL_H

#include "src/kernels/flat_tmpl.h"

/* The rule's error at 10 bands is below 2e-7 of the solid angle where s > DISK_OPEN alpha (see
 * below), and the edge's half angle is not above DISK_WAVES / bands: the first bounds how near the
 * edge may be, the second how often lobes change along it. */
#define DISK_OPEN  0.7
#define DISK_WAVES 7.0

/* Nodes side by side. */
#define DISK_TOGETHER 4

/* A disk of radius r at the height h of the viewer, whose middle is `aside` from where its plane is
 * nearest. The square of the distance of a point of the edge is alpha + beta cos t, and s² =
 * alpha² - beta², here written without cancellation. */
typedef struct disk_seen {
    vd aside[3], aside2, s2, s, per_s, alpha;
} disk_seen;

LMPI_INLINE void disk_see(const lmpi_kernel_disk *light, const flat_place *place, disk_seen *seen) {
    const double r2 = light->flat.radius * light->flat.radius;
    const vd h2 = place->height * place->height;
    for (int k = 0; k < 3; k++)
        seen->aside[k] = place->to[k] - place->height * place->inner[k];
    seen->aside2 = vd_dot(seen->aside, seen->aside);
    const vd apart = seen->aside2 - r2;
    seen->s2 = apart * apart + h2 * (h2 + 2.0 * (seen->aside2 + r2));
    seen->per_s = vd_per_root(seen->s2);
    seen->s = seen->s2 * seen->per_s;
    seen->alpha = (seen->aside2 + h2) + r2;
}

/* Returns the irradiance, pi r²/s times the part along n of ((s + h² + r² - aside²) inner + 2h
 * aside) / (s + alpha): the integral of p x dp / 2|p|² around the edge, in elementary functions. */
LMPI_INLINE vd disk_open(const lmpi_kernel_disk *light, const flat_place *place,
                         const disk_seen *seen, const vd n[3]) {
    const double r2 = light->flat.radius * light->flat.radius;
    const vd straight = ((seen->s + place->height * place->height) + r2) - seen->aside2;
    const vd sum =
        straight * vd_dot(n, place->inner) + 2.0 * place->height * vd_dot(n, seen->aside);
    return (3.14159265358979323846 * r2) * seen->per_s * sum / (seen->s + seen->alpha);
}

/* Adds to each lobe's sum, and to the solid angle, what nodes from `first` on contribute, if the
 * front is seen. */
LMPI_INLINE void disk_nodes(int first, const lmpi_kernel_disk *light, const flat_surfaces *at,
                            const flat_place *place, vd *solid_angle, vd *sums) {
    vd w[DISK_TOGETHER][3], g[DISK_TOGETHER][3];
    LMPI_UNROLL for (int i = 0; i < DISK_TOGETHER; i++) {
        vd p[3];
        const double *along = light->along[first + i];
        for (int k = 0; k < 3; k++)
            p[k] = place->to[k] + light->node[first + i][k];
        const vd per = vd_per_root(vd_dot(p, p)), per2 = per * per;
        for (int k = 0; k < 3; k++) {
            w[i][k] = p[k] * per;
            g[i][k] =
                (p[(k + 1) % 3] * along[(k + 2) % 3] - p[(k + 2) % 3] * along[(k + 1) % 3]) * per2;
        }
        *solid_angle =
            *solid_angle + vd_dot(place->inner, g[i]) / (1.0 + vd_dot(place->inner, w[i]));
    }
    for (int k = 0; k < at->lobe_count; k++) {
        vd z[DISK_TOGETHER], slopes[DISK_TOGETHER];
        LMPI_UNROLL for (int i = 0; i < DISK_TOGETHER; i++) z[i] = vd_dot(at->axis[k], w[i]);
        flat_slopes(DISK_TOGETHER, at->bands, at->tables, flat_weights(at, k), z, slopes);
        LMPI_UNROLL for (int i = 0; i < DISK_TOGETHER; i++) sums[k] =
            sums[k] + vd_dot(at->axis[k], g[i]) * slopes[i];
    }
}

/* Adds the responses to the outline of the lanes that need it, and says which are left. */
static LMPI_NOINLINE void disk_outline(const lmpi_kernel_disk *light, const flat_surfaces *at,
                                       const flat_place *place, vd *responses, vd *left) {
    const vd zero = vd_set(0), half = vd_set(0.5);
    const double radius = light->flat.radius, bands = at->bands;
    const double waves = bands * radius / DISK_WAVES;
    disk_seen seen;
    disk_see(light, place, &seen);
    const vd open = vd_max(disk_open(light, place, &seen, at->normal), zero);
    const vd clear = vd_select_less(vd_abs(place->up), vd_set(radius), zero, vd_set(1));
    responses[0] =
        vd_select_less(half, place->outlined_diffuse,
                       vd_select_less(zero, place->up, clear * open, zero), responses[0]);
    const vd smooth = vd_select_less(vd_set(waves * waves), seen.alpha, vd_set(1), zero);
    const vd safe =
        vd_select_less((DISK_OPEN * DISK_OPEN) * (seen.alpha * seen.alpha), seen.s2, smooth, zero);
    const vd by_nodes = place->outlined_lobes * safe;
    *left = LMPI_LEFT_DIFFUSE * (place->outlined_diffuse * (1.0 - clear)) +
            LMPI_LEFT_LOBES * (place->outlined_lobes * (1.0 - safe));
    vd sums[LMPI_KERNEL_LOBES_MAX], solid_angle = zero;
    for (int k = 0; k < at->lobe_count; k++)
        sums[k] = zero;
    if (at->lobe_count > 0 && vd_any_less(half, by_nodes))
        for (int first = 0; first < LMPI_DISK_NODES; first += DISK_TOGETHER)
            disk_nodes(first, light, at, place, &solid_angle, sums);
    for (int k = 0; k < at->lobe_count; k++) {
        const vd all = place->side * (vd_load(flat_weights(at, k)) * solid_angle + sums[k]);
        responses[1 + k] =
            vd_select_less(half, place->outlined_lobes, vd_select_less(half, by_nodes, all, zero),
                           responses[1 + k]);
    }
}

#endif
