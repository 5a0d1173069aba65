/* SPDX-License-Identifier: MIT */
/* cap_tmpl.h - the cap that a sphere covers, for LMPI_LANES spheres at once.
 *
 * One quotient and two roots serve everything: with e = sqrt(d² - r²), alpha = e/d and
 * X = 1/(d (d + e)),
 *     1/d = (d + e) X,  t = 1 - alpha = r² X,  s2 = sin²a = (r/d)².
 * Inside the sphere d and r are exchanged (sphere.h). A radius of LMPI_DIRAC means a Dirac: a cap
 * of size 0 that pi s2 = 1/d² makes as strong. */
#ifndef LAMPION_KERNELS_CAP_TMPL_H
#define LAMPION_KERNELS_CAP_TMPL_H

#include "src/base/tables.h"
#include "src/kernels/arrays.h"
#include "src/kernels/lanes.h"
#include "src/kernels/packed_light.h"

#include <float.h>

/* 2 pi is twice the float nearest to pi, so the two agree on the surface to the last bit. */
#define LMPI_KERNEL_PI 3.14159265f

/* Caps whose recurrences run side by side: as many as their R_l fit the first-level cache. */
#define CAP_SIDE_BY_SIDE (LMPI_LANES == 16 ? 2 : 4)

typedef struct cap_lanes {
    vf x, y, z;  /* from the point to the center */
    vf per_d;    /* 1/d; 0 at the center */
    vf s2, t;    /* sin²a, 1 - |cos a| */
    vf t_full;   /* 1 - cos a, which is 2 - t inside */
    vf alpha;    /* |cos a|; only where asked for */
    vf s2_per_d; /* s2/d without 0/0; only where asked for */
    vf even;     /* -1 inside, where R_l changes sign with even l, else 1 */
    int inside;  /* some lane is inside, or d = 0 */
} cap_lanes;

/* Returns s2 of a Dirac, 0 where the radius is not that of one. */
LMPI_INLINE vf cap_dirac(vf d2, vf r) {
    const vf held = vf_max(d2, vf_set(LMPI_DIRAC_DISTANCE_MIN * LMPI_DIRAC_DISTANCE_MIN));
    return vf_select_less(r, vf_set(0), vf_set(1 / LMPI_KERNEL_PI) / held, vf_set(0));
}

/* Finds the caps where some lane is inside, has d = 0, or is a Dirac; other lanes get the bits of
 * cap_from. A square that underflows counts as 0. Called by value, so that the common path keeps
 * its cap in registers. */
static __attribute__((noinline)) cap_lanes cap_inside(vf x, vf y, vf z, vf d2, vf d, vf r, vf gap) {
    const vf zero = vf_set(0), one = vf_set(1), least = vf_set(FLT_MIN);
    const vf dirac = cap_dirac(d2, r);
    vf r2 = vf_select_less(r, zero, zero, r * r);
    gap = vf_select_less(r, zero, d2, gap);
    d2 = vf_select_less(d2, least, zero, d2);
    r2 = vf_select_less(r2, least, zero, r2);
    d = vf_select_less(zero, d2, d, zero);
    const vf far2 = vf_max(d2, r2), near2 = vf_select_less(d2, r2, d2, r2);
    /* d = r = 0 is a light of size 0: nothing is seen, in any direction. */
    const vf far = vf_select_less(zero, far2, vf_select_less(d2, r2, r, d), one);
    const vf e = vf_sqrt(vf_max(gap, -gap)), sum = far + e, inverse = one / (far * sum);
    const vf per_far = sum * inverse;
    const vf per_d = vf_select_less(d2, r2, one / vf_max(d, least), per_far);
    cap_lanes cap;
    cap.x = x;
    cap.y = y;
    /* At the center any axis serves; it is multiplied by 0. */
    cap.z = vf_select_less(zero, d2, z, one);
    cap.per_d = vf_select_less(zero, d2, per_d, zero);
    cap.t = near2 * inverse;
    cap.t_full = vf_select_less(d2, r2, vf_set(2) - cap.t, cap.t);
    cap.s2 = near2 * per_far * per_far;
    cap.even = vf_select_less(d2, r2, -one, one);
    cap.alpha = e * per_far;
    cap.s2_per_d = vf_select_less(d2, r2, d * per_far * per_far, cap.s2 * cap.per_d);
    cap.s2 = cap.s2 + dirac;
    cap.t_full = cap.t_full + 0.5f * dirac;
    cap.s2_per_d = cap.s2_per_d + dirac * cap.per_d;
    cap.inside = 1;
    return cap;
}

/* Finds the cap, given gap = d² - r²; `gradient` asks for alpha and s2_per_d. */
LMPI_INLINE cap_lanes cap_at(vf x, vf y, vf z, vf d2, vf d, vf r, vf gap, int gradient) {
    const vf r2 = r * r;
    if (__builtin_expect(vf_any_less(d2, vf_max(r2, vf_set(FLT_MIN))), 0))
        return cap_inside(x, y, z, d2, d, r, gap);
    const vf e = vf_sqrt(gap), sum = d + e, inverse = vf_set(1) / (d * sum);
    cap_lanes cap;
    cap.x = x;
    cap.y = y;
    cap.z = z;
    cap.inside = 0;
    cap.per_d = sum * inverse;
    cap.t = r2 * inverse;
    cap.t_full = cap.t;
    cap.s2 = r2 * cap.per_d * cap.per_d;
    cap.even = vf_set(1);
    if (gradient) {
        cap.alpha = e * cap.per_d;
        cap.s2_per_d = cap.s2 * cap.per_d;
    }
    return cap;
}

LMPI_INLINE cap_lanes cap_from(vf x, vf y, vf z, vf r, int gradient) {
    const vf d2 = x * x + y * y + z * z;
    return cap_at(x, y, z, d2, vf_sqrt(d2), r, d2 - r * r, gradient);
}

/* Finds the cap from a given distance, which is exact, as is d - r: the product form of d² - r²
 * keeps that. */
LMPI_INLINE cap_lanes cap_from_distance(vf d, vf r) {
    return cap_at(vf_set(0), vf_set(0), d, d * d, d, r, (d - r) * (d + r), 0);
}

/* Replaces the vector to the center by the axis. */
LMPI_INLINE void cap_axis(cap_lanes *cap) {
    const vf center_z = cap->z;
    cap->x = cap->x * cap->per_d;
    cap->y = cap->y * cap->per_d;
    cap->z = cap->z * cap->per_d;
    if (__builtin_expect(cap->inside, 0))
        cap->z = vf_select_less(vf_set(0), cap->per_d, cap->z, center_z);
}

/* Computes radial[k][l] = strength s2 R_l(cos a) of cap k for 1 <= l < bands, by the differences of
 * R_l (sphere.h: no cancellation however small the light), and radial[k][0] = strength 2 (1 - cos
 * a). Caps go side by side, because each waits for its own recurrence. */
LMPI_INLINE void cap_radials(int caps, int bands, const cap_lanes *cap, vf strength,
                             vf *const *radial) {
    const float *cap_d = lmpi_table_cap_d, *cap_t = lmpi_table_cap_t;
    vf r[CAP_SIDE_BY_SIDE], difference[CAP_SIDE_BY_SIDE];
    LMPI_OPAQUE(cap_d);
    LMPI_OPAQUE(cap_t);
    /* all, because compilers do not see that there is at least one cap */
    LMPI_UNROLL for (int k = 0; k < CAP_SIDE_BY_SIDE; k++) r[k] = difference[k] = vf_set(0);
    LMPI_UNROLL for (int k = 0; k < caps; k++) {
        r[k] = strength * cap[k].s2;
        radial[k][0] = (strength + strength) * cap[k].t_full;
        if (bands > 1)
            radial[k][1] = r[k];
    }
    LMPI_UNROLL for (int l = 2; l < bands; l++) LMPI_UNROLL for (int k = 0; k < caps; k++) {
        difference[k] = cap_d[l] * difference[k] - cap_t[l] * cap[k].t * r[k];
        r[k] = r[k] + difference[k];
        radial[k][l] = r[k];
    }
    LMPI_UNROLL for (int k = 0; k < caps; k++) {
        if (__builtin_expect(cap[k].inside, 0))
            for (int l = 2; l < bands; l += 2)
                radial[k][l] = radial[k][l] * cap[k].even;
    }
}

LMPI_INLINE void cap_radial(int bands, const cap_lanes *cap, vf strength, vf *radial) {
    cap_radials(1, bands, cap, strength, &radial);
}

#endif
