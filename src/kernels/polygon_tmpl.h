/* SPDX-License-Identifier: MIT */
/* polygon_tmpl.h - what is seen of a flat light with corners: sums along its edges, in double,
 * because the edges of a light that looks small nearly cancel. src/light/loop.h has the integrals;
 * there they are computed for one point, and of any outline. Lanes are points. */
#ifndef LAMPION_KERNELS_POLYGON_TMPL_H
#define LAMPION_KERNELS_POLYGON_TMPL_H

#include "src/base/unroll.h"
#include "src/kernels/flat_tmpl.h"

/* --- angles ----------------------------------------------------------------------------------- */

/* Returns the angle of the direction (D, A), 0 … pi, divided by A, the length of `across`, given L²
 * = D² + A². With C = cos(angle/2) = sqrt((L + D) / 2L) it is acos(C) / sqrt(1 - C²) * 2 / sqrt(2L
 * (L + D)). The polynomial of C keeps the relative error below 6e-11 and, as important, smooth, so
 * that it cancels around a light as the edges do. */
LMPI_INLINE vd polygon_angle(vd length, vd along, const vd across[3]) {
    static const double series[] = {
        1.57079632671434196,  -0.999999972166828062, 0.785396557573014691,  -0.666629921568698172,
        0.588606482764974295, -0.530115630605379059, 0.475496479771783161,  -0.406212992853778488,
        0.307877270205461218, -0.189296848091146705, 0.0850301256872544316, -0.0241543416460268082,
        0.0032064642663102291
    };
    enum { TERMS = sizeof series / sizeof *series };
    vd sum = length + along;
    /* Past a right angle the sum cancels. */
    if (__builtin_expect(vd_any_less(along, vd_set(0)), 0))
        sum = vd_select_less(along, vd_set(0), vd_dot(across, across) / (length - along), sum);
    const vd root = vd_per_root(2.0 * length * sum), cosine = sum * root, square = cosine * cosine;
    vd even = vd_set(series[TERMS - 1]), odd = vd_set(series[TERMS - 2]);
    LMPI_UNROLL for (int i = TERMS - 3; i > 0; i -= 2) {
        even = even * square + series[i];
        odd = odd * square + series[i - 1];
    }
    even = even * square + series[0];
    return 2.0 * root * (even + cosine * odd);
}

/* Returns the argument of re + i im, -pi … pi. */
LMPI_INLINE vd polygon_argument(vd re, vd im) {
    const vd across[3] = { im, vd_set(0), vd_set(0) }, square = re * re + im * im;
    return im * polygon_angle(square * vd_per_root(square), re, across);
}

/* --- edges ------------------------------------------------------------------------------------ */

/* A light seen from points in its front, counter-clockwise; from behind it is clockwise. `angle`
 * is that of an edge divided by |normal|. */
typedef struct polygon_seen {
    vd corner[LMPI_POLYGON_CORNERS][3], square[LMPI_POLYGON_CORNERS],
        per_length[LMPI_POLYGON_CORNERS];
    vd normal[LMPI_POLYGON_CORNERS][3],
        along[LMPI_POLYGON_CORNERS]; /* corner x edge, corner · next */
    vd angle[LMPI_POLYGON_CORNERS];
} polygon_seen;

LMPI_INLINE void polygon_see(int count, const lmpi_kernel_polygon *light, const vd to[3],
                             polygon_seen *seen) {
    LMPI_UNROLL for (int i = 0; i < count; i++) {
        vd *corner = seen->corner[i], *normal = seen->normal[i];
        const double *edge = light->edge[i];
        for (int k = 0; k < 3; k++)
            corner[k] = to[k] + light->corner[i][k];
        seen->square[i] = vd_dot(corner, corner);
        seen->per_length[i] = vd_per_root(seen->square[i]);
        normal[0] = corner[1] * edge[2] - corner[2] * edge[1];
        normal[1] = corner[2] * edge[0] - corner[0] * edge[2];
        normal[2] = corner[0] * edge[1] - corner[1] * edge[0];
    }
    LMPI_UNROLL for (int i = 0; i < count; i++) {
        const int next = i + 1 < count ? i + 1 : 0;
        const vd length =
            (seen->square[i] * seen->per_length[i]) * (seen->square[next] * seen->per_length[next]);
        seen->along[i] = vd_dot(seen->corner[i], seen->corner[next]);
        seen->angle[i] = polygon_angle(length, seen->along[i], seen->normal[i]);
    }
}

/* --- irradiance ------------------------------------------------------------------------------- */

/* Returns twice the irradiance on a surface whose horizon does not cut the light (Lambert). */
LMPI_INLINE vd polygon_open(int count, const polygon_seen *seen, const vd n[3]) {
    vd sum = vd_set(0);
    LMPI_UNROLL for (int i = 0; i < count; i++) sum =
        sum + vd_dot(n, seen->normal[i]) * seen->angle[i];
    return sum;
}

/* Returns twice the irradiance under the horizon of n. What is left of each edge goes from one of
 * its ends to the crossing x, and the horizon closes the outline where it leaves and until it
 * comes back, by the azimuths of the crossings. These are counted from `inner`, the direction
 * straight to the light's plane, and are within a right angle of it, so that their sum, the
 * argument of a product, does not wrap. Few surfaces come here, so that the others keep their
 * registers. */
static LMPI_NOINLINE vd polygon_cut(int count, const polygon_seen *seen, const vd n[3],
                                    const vd inner[3]) {
    const vd zero = vd_set(0), one = vd_set(1);
    vd above[LMPI_POLYGON_CORNERS], beside[3], sum = zero, re = one, im = zero;
    vd_cross(n, inner, beside);
    for (int i = 0; i < count; i++)
        above[i] = vd_dot(n, seen->corner[i]);
    for (int i = 0; i < count; i++) {
        const int next = i + 1 < count ? i + 1 : 0;
        const vd a = above[i], b = above[next], size_a = vd_abs(a), size_b = vd_abs(b);
        vd x[3], from[3], to[3], normal[3];
        /* from x to is so many times the normal */
        const vd times = vd_select_less(b, zero, size_a, vd_select_less(a, zero, size_b, one));
        for (int k = 0; k < 3; k++) {
            x[k] = seen->corner[i][k] * size_b + seen->corner[next][k] * size_a;
            from[k] = vd_select_less(a, zero, x[k], seen->corner[i][k]);
            to[k] = vd_select_less(b, zero, x[k], seen->corner[next][k]);
            normal[k] = times * seen->normal[i][k];
        }
        const vd squares = vd_dot(from, from) * vd_dot(to, to);
        const vd part = vd_dot(n, normal) *
                        polygon_angle(squares * vd_per_root(squares), vd_dot(from, to), normal);
        sum = sum + vd_select_less(a, zero, vd_select_less(b, zero, zero, part), part);
        /* 1 unless the edge crosses; the outline leaves at a negative azimuth */
        const vd along = vd_dot(x, inner), across = vd_dot(x, beside);
        const vd per = vd_per_root(along * along + across * across);
        const vd cosine = along * per, sine = across * per;
        const vd c = vd_select_less(a, zero, vd_select_less(b, zero, one, cosine),
                                    vd_select_less(b, zero, cosine, one));
        const vd s = vd_select_less(a, zero, vd_select_less(b, zero, zero, sine),
                                    vd_select_less(b, zero, -sine, zero));
        const vd product = re * c - im * s;
        im = re * s + im * c;
        re = product;
    }
    return sum + polygon_argument(re, im);
}

/* --- lobes ------------------------------------------------------------------------------------ */

/* Scales the normals of the edges to 1, and the angles by as much. */
LMPI_INLINE void polygon_complete(int count, polygon_seen *seen) {
    LMPI_UNROLL for (int i = 0; i < count; i++) {
        const vd square = vd_dot(seen->normal[i], seen->normal[i]), per = vd_per_root(square);
        seen->angle[i] = seen->angle[i] * (square * per);
        for (int k = 0; k < 3; k++)
            seen->normal[i][k] = seen->normal[i][k] * per;
    }
}

/* Returns the solid angle, the sum over triangles of 2 arg(1 + a·b + b·c + c·a + i a·(b x c)) (van
 * Oosterom and Strackee 1983), as that of the product, because all of it is at most 2 pi. */
LMPI_INLINE vd polygon_solid_angle(int count, const polygon_seen *seen, vd side) {
    const vd per_first = seen->per_length[0];
    vd re = vd_set(1), im = vd_set(0), last = seen->along[0] * (per_first * seen->per_length[1]);
    LMPI_UNROLL for (int i = 1; i + 1 < count; i++) {
        const vd along =
            i + 2 < count ? vd_dot(seen->corner[0], seen->corner[i + 1]) : seen->along[count - 1];
        const vd next = along * (per_first * seen->per_length[i + 1]);
        const vd per = seen->per_length[i] * seen->per_length[i + 1];
        const vd x = ((1.0 + last) + seen->along[i] * per) + next;
        const vd y = vd_dot(seen->corner[0], seen->normal[i]) * (per_first * per);
        const vd product = re * x - im * y;
        im = re * y + im * x;
        re = product;
        last = next;
    }
    return 2.0 * side * polygon_argument(re, im);
}

/* Edges as a lobe sees them, of which every `step`-th from the first on counts; the corners are
 * where they begin and, the next one, end. The cosine of the axis with each corner, the slopes of
 * that at both ends of an edge, its cosine with the edge's pole, and the edge's angle. */
typedef struct polygon_edges {
    vd x[LMPI_POLYGON_CORNERS], begin[LMPI_POLYGON_CORNERS], end[LMPI_POLYGON_CORNERS];
    vd z[LMPI_POLYGON_CORNERS], angle[LMPI_POLYGON_CORNERS];
} polygon_edges;

/* Returns what edges contribute to a lobe's response from l = 1 on; weights are LMPI_LANES
 * apart. */
LMPI_INLINE vd polygon_bands(int count, int step, int bands, const flat_tables *tables,
                             const polygon_edges *edges, const float *weights) {
    vd p[LMPI_POLYGON_CORNERS], p_below[LMPI_POLYGON_CORNERS], z2[LMPI_POLYGON_CORNERS];
    vd d[LMPI_POLYGON_CORNERS][4], sum[LMPI_POLYGON_CORNERS], all = vd_set(0);
    const vd first = vd_load(weights + LMPI_LANES);
    LMPI_UNROLL for (int i = 0; i < count; i++) {
        p[i] = vd_set(1);
        p_below[i] = vd_set(0);
    }
    LMPI_UNROLL for (int i = 0; i < count; i += step) {
        z2[i] = edges->z[i] * edges->z[i];
        d[i][0] = d[i][1] = d[i][2] = vd_set(0);
        d[i][3] = edges->angle[i];
        sum[i] = first * edges->angle[i];
    }
    LMPI_ROLLED for (int l = 0; l + 2 < bands; l++) {
        const vd weight = vd_load(weights + (ptrdiff_t)(l + 2) * LMPI_LANES);
        LMPI_UNROLL for (int i = 0; i < count; i += step) {
            const int next = i + 1 < count ? i + 1 : 0;
            const vd ends = p[next] * edges->end[i] - p[i] * edges->begin[i];
            const vd d_next = ((tables->same[l] - tables->less[l] * z2[i]) * d[i][2] -
                               tables->below[l] * d[i][0]) -
                              ends;
            sum[i] = sum[i] + weight * d_next;
            d[i][0] = d[i][1];
            d[i][1] = d[i][2];
            d[i][2] = d[i][3];
            d[i][3] = d_next;
        }
        LMPI_UNROLL for (int i = 0; i < count; i++) {
            const vd p_next = edges->x[i] * p[i] - tables->of_p[l] * p_below[i];
            p_below[i] = p[i];
            p[i] = p_next;
        }
    }
    LMPI_UNROLL for (int i = 0; i < count; i += step) all = all + edges->z[i] * sum[i];
    return all;
}

/* Returns a lobe's response from l = 1 on. */
LMPI_INLINE vd polygon_lobe(int count, int bands, const flat_tables *tables,
                            const polygon_seen *seen, const vd q[3], const float *weights) {
    polygon_edges edges;
    LMPI_UNROLL for (int i = 0; i < count; i++) {
        const int next = i + 1 < count ? i + 1 : 0;
        vd slope[3];
        vd_cross(q, seen->normal[i], slope);
        edges.begin[i] = vd_dot(slope, seen->corner[i]) * seen->per_length[i];
        edges.end[i] = vd_dot(slope, seen->corner[next]) * seen->per_length[next];
        edges.x[i] = vd_dot(q, seen->corner[i]) * seen->per_length[i];
        edges.z[i] = vd_dot(q, seen->normal[i]);
        edges.angle[i] = seen->angle[i];
    }
    return polygon_bands(count, 1, bands, tables, &edges, weights);
}

#endif
