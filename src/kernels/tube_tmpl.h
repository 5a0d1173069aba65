/* SPDX-License-Identifier: MIT */
/* tube_tmpl.h - what is seen of a tube from beside it: two straight edges, where planes touch it,
 * and the arcs of its round ends between them. src/light/loop.h has the integrals. Lanes are
 * surfaces.
 *
 * All is computed in the frame of a surface: along the tube's axis, from the surface straight to
 * the line of the axis, and across both. The planes have the poles sine toward -+ cosine across. */
#ifndef LAMPION_KERNELS_TUBE_TMPL_H
#define LAMPION_KERNELS_TUBE_TMPL_H

#include "src/kernels/polygon_tmpl.h"

/* Lobes are summed at few or many nodes of an arc. Their error at 10 bands is below 1e-6 of the
 * most that a lobe can receive, where an end's half angle is at most WAVES / bands and the arc's
 * half angle has a cosine of at least TUBE_ARC. */
#define TUBE_WAVES_FEW  0.7
#define TUBE_WAVES_MANY 4.0
#define TUBE_ARC        -0.5
enum { TUBE_PAIRS_MAX = 6, TUBE_TOGETHER = 3 };

/* Beyond so many sizes, or so many for each band, a tube is a Dirac, unless it is seen so nearly
 * along its axis that one end hides much of the other: from nearer to the axis than TUBE_ASIDE
 * radii. There the outline serves until its parts cancel. */
#define TUBE_FAR              600.0
#define TUBE_FAR_LOBES_A_BAND 100.0
#define TUBE_ASIDE            400.0
#define TUBE_CANCELS          3e4

/* An end: where it is along the axis; 1 / the distance of its middle; the sine and cosine of its
 * half angle; and 1 / the distance of the points where planes touch it. The arc's middle is away
 * from the tube, its half angle `arc`. */
typedef struct tube_end {
    vd at, per_distance, sine, cosine, per_length;
    vd arc, arc_sine, arc_cosine;
} tube_end;

typedef struct tube_seen {
    vd toward[3], across[3];
    vd distance, per_distance, sine, cosine; /* of the axis' line, and of the planes */
    vd angle;                                /* of both edges */
    tube_end end[2];                         /* at -half and half */
} tube_seen;

/* A direction in the frame. */
typedef struct tube_direction {
    vd axis, toward, across;
} tube_direction;

LMPI_INLINE tube_direction tube_rotate(const lmpi_kernel_tube *light, const tube_seen *seen,
                                       const vd v[3]) {
    return (tube_direction) { light->axis[0] * v[0] + light->axis[1] * v[1] + light->axis[2] * v[2],
                              vd_dot(v, seen->toward), vd_dot(v, seen->across) };
}

/* Finds an end, given the square of the distance of the axis' line. */
LMPI_INLINE void tube_see_end(const lmpi_kernel_tube *light, double sign, vd along, vd distance2,
                              tube_seen *seen, tube_end *end) {
    const double r = light->radius;
    const vd at = along + sign * light->half, touched2 = at * at + (distance2 - r * r);
    end->at = at;
    end->per_distance = vd_per_root(at * at + distance2);
    end->per_length = vd_per_root(touched2);
    end->sine = r * end->per_distance;
    end->cosine = touched2 * end->per_length * end->per_distance;
    /* where a plane touches the arc's circle, from the arc's middle on */
    const vd u = seen->sine * (sign * at) * end->per_distance, v = seen->cosine;
    const vd per = vd_per_root(u * u + v * v), none = vd_set(0);
    end->arc_cosine = u * per;
    end->arc_sine = v * per;
    end->arc = end->arc_sine * polygon_angle(vd_set(1), end->arc_cosine,
                                             (const vd[3]) { end->arc_sine, none, none });
}

LMPI_INLINE void tube_see(const lmpi_kernel_tube *light, const vd to[3], tube_seen *seen) {
    const double r = light->radius;
    vd along = vd_set(0), left = vd_set(0), rest[3];
    for (int k = 0; k < 3; k++)
        along = along + light->axis[k] * to[k];
    for (int k = 0; k < 3; k++)
        rest[k] = to[k] - along * light->axis[k];
    /* The second step removes what rounding leaves of the axis. */
    for (int k = 0; k < 3; k++)
        left = left + light->axis[k] * rest[k];
    for (int k = 0; k < 3; k++)
        rest[k] = rest[k] - left * light->axis[k];
    const vd distance2 = vd_dot(rest, rest);
    seen->per_distance = vd_per_root(distance2);
    seen->distance = distance2 * seen->per_distance;
    for (int k = 0; k < 3; k++)
        seen->toward[k] = rest[k] * seen->per_distance;
    for (int k = 0; k < 3; k++)
        seen->across[k] = light->axis[(k + 1) % 3] * seen->toward[(k + 2) % 3] -
                          light->axis[(k + 2) % 3] * seen->toward[(k + 1) % 3];
    seen->sine = r * seen->per_distance;
    const vd outside = vd_max((seen->distance - r) * (seen->distance + r), vd_set(0));
    seen->cosine = outside * vd_per_root(outside) * seen->per_distance;
    tube_see_end(light, -1, along, distance2, seen, &seen->end[0]);
    tube_see_end(light, 1, along, distance2, seen, &seen->end[1]);
    const tube_end *a = &seen->end[0], *b = &seen->end[1];
    const vd across[3] = { 2 * light->half * seen->distance * seen->cosine, vd_set(0), vd_set(0) };
    const vd squares = (a->at * a->at + outside) * (b->at * b->at + outside);
    seen->angle = across[0] * polygon_angle(squares * (a->per_length * b->per_length),
                                            a->at * b->at + outside, across);
}

/* --- irradiance ------------------------------------------------------------------------------- */

/* The parts of a direction along the way to an end's middle, away from the tube there, and along
 * the arc. */
typedef struct tube_parts {
    vd middle, away, aside;
} tube_parts;

LMPI_INLINE tube_parts tube_parts_of(double sign, const tube_seen *seen, const tube_end *end,
                                     tube_direction v) {
    return (tube_parts) { (end->at * v.axis + seen->distance * v.toward) * end->per_distance,
                          sign *
                              ((seen->distance * v.axis - end->at * v.toward) * end->per_distance),
                          -sign * v.across };
}

/* Returns the irradiance on a surface whose horizon does not cut the light. From a viewer all of an
 * arc is equally far, so that w x dw has a closed integral. */
LMPI_INLINE vd tube_open(const tube_seen *seen, tube_direction n) {
    vd sum = seen->angle * (seen->sine * n.toward);
    LMPI_UNROLL for (int i = 0; i < 2; i++) {
        const tube_end *end = &seen->end[i];
        const tube_parts part = tube_parts_of(2 * i - 1, seen, end, n);
        sum = sum + end->sine * (end->sine * part.middle * end->arc -
                                 end->cosine * part.away * end->arc_sine);
    }
    return sum;
}

/* --- lobes ------------------------------------------------------------------------------------ */

/* Returns the solid angle: that of the rectangle between the edges, and at each end a sector less
 * the triangle between the end's middle and the rectangle; the rectangle and the triangles are
 * twice the argument of a product. */
LMPI_INLINE vd tube_solid_angle(const lmpi_kernel_tube *light, const tube_seen *seen) {
    const double r = light->radius;
    const vd height = seen->cosine * seen->cosine, across = r * seen->cosine * seen->per_distance;
    vd sectors = vd_set(0), re = vd_set(1), im = vd_set(0);
    LMPI_UNROLL for (int i = 0; i < 2; i++) {
        const tube_end *end = &seen->end[i];
        const vd at = (2.0 * i - 1) * (end->at * end->per_length), s2 = end->sine * end->sine;
        /* the sine of the angle of half of the rectangle's end side */
        const vd half = r * seen->cosine * end->per_length;
        const vd x = 2.0 * ((1.0 + end->cosine) - half * half),
                 y = -2.0 * at * half * (seen->sine * (r * end->per_distance));
        const vd u = height * x - (at * across) * y, v = height * y + (at * across) * x;
        const vd product = re * u - im * v;
        im = re * v + im * u;
        re = product;
        sectors = sectors + end->arc * s2 / (1.0 + end->cosine);
    }
    return 2.0 * (polygon_argument(re, im) + sectors);
}

/* Gauss' nodes in the angle of an arc, from the middle on to one side, and their weights. */
typedef struct tube_rule {
    int pairs;
    double at[TUBE_PAIRS_MAX], weight[TUBE_PAIRS_MAX];
} tube_rule;

static const tube_rule tube_few = { 3,
                                    { 0.2386191860831969, 0.6612093864662645, 0.9324695142031521 },
                                    { 0.46791393457269104, 0.3607615730481386,
                                      0.17132449237917036 } };
static const tube_rule tube_many = { 6,
                                     { 0.12523340851146894, 0.3678314989981802, 0.5873179542866175,
                                       0.7699026741943047, 0.9041172563704748, 0.9815606342467192 },
                                     { 0.24914704581340288, 0.23349253653835478,
                                       0.20316742672306584, 0.16007832854334633,
                                       0.10693932599531818, 0.047175336386511835 } };

/* Finds the cosine and the sine of an angle up to 2, by the series of its half. */
LMPI_INLINE void tube_cosine_sine(vd angle, vd *cosine, vd *sine) {
    static const double even[] = { -1. / 2,       1. / 24,        -1. / 720,        1. / 40320,
                                   -1. / 3628800, 1. / 479001600, -1. / 87178291200 };
    static const double odd[] = { -1. / 6,     1. / 120,       -1. / 5040,
                                  1. / 362880, -1. / 39916800, 1. / 6227020800 };
    const vd half = 0.5 * angle, square = half * half;
    vd c = vd_set(even[6]), s = vd_set(odd[5]);
    LMPI_UNROLL for (int i = 5; i >= 0; i--) c = c * square + even[i];
    LMPI_UNROLL for (int i = 4; i >= 0; i--) s = s * square + odd[i];
    c = 1.0 + square * c;
    s = half + half * (square * s);
    *cosine = 2.0 * c * c - 1.0;
    *sine = 2.0 * s * c;
}

/* Returns what an end contributes to a lobe's response from l = 1 on. */
LMPI_INLINE vd tube_end_lobe(const tube_rule *rule, double sign, const flat_surfaces *at,
                             const tube_seen *seen, const tube_end *end, tube_direction q,
                             const float *weights) {
    const tube_parts part = tube_parts_of(sign, seen, end, q);
    const vd z_middle = end->cosine * part.middle, g_middle = end->sine * part.middle;
    vd sum = vd_set(0);
    for (int first = 0; first < rule->pairs; first += TUBE_TOGETHER) {
        vd along[2 * TUBE_TOGETHER], z[2 * TUBE_TOGETHER], slopes[2 * TUBE_TOGETHER];
        LMPI_UNROLL for (int i = 0; i < TUBE_TOGETHER; i++) {
            vd c, s;
            tube_cosine_sine(rule->at[first + i] * end->arc, &c, &s);
            along[2 * i] = part.away * c - part.aside * s;
            along[2 * i + 1] = part.away * c + part.aside * s;
        }
        LMPI_UNROLL for (int i = 0; i < 2 * TUBE_TOGETHER; i++) z[i] =
            z_middle + end->sine * along[i];
        flat_slopes(2 * TUBE_TOGETHER, at->bands, at->tables, weights, z, slopes);
        LMPI_UNROLL for (int i = 0; i < 2 * TUBE_TOGETHER; i++) sum =
            sum + rule->weight[first + i / 2] * ((g_middle - end->cosine * along[i]) * slopes[i]);
    }
    return end->arc * end->sine * sum;
}

/* Returns what both ends contribute. */
static LMPI_NOINLINE vd tube_ends_lobe(const tube_rule *rule, const flat_surfaces *at,
                                       const tube_seen *seen, tube_direction q,
                                       const float *weights) {
    vd sum = vd_set(0);
    LMPI_ROLLED for (int i = 0; i < 2; i++) sum =
        sum + tube_end_lobe(rule, 2 * i - 1, at, seen, &seen->end[i], q, weights);
    return sum;
}

/* Returns what the edges contribute: from the first end to the second, and back. */
LMPI_INLINE vd tube_edges_lobe(const lmpi_kernel_tube *light, const flat_surfaces *at,
                               const tube_seen *seen, tube_direction q, const float *weights) {
    const vd height = seen->distance - light->radius * seen->sine;
    polygon_edges edges;
    LMPI_UNROLL for (int i = 0; i < 4; i++) {
        const tube_end *end = &seen->end[i == 1 || i == 2];
        const double side = i < 2 ? 1 : -1;
        const vd slope = side * seen->cosine * (seen->distance * q.axis - end->at * q.toward) -
                         seen->sine * (end->at * q.across);
        edges.x[i] = ((end->at * q.axis + height * q.toward) +
                      (side * light->radius) * (seen->cosine * q.across)) *
                     end->per_length;
        edges.z[i] = seen->sine * q.toward - side * (seen->cosine * q.across);
        edges.angle[i] = seen->angle;
        *(i % 2 ? &edges.end[i - 1] : &edges.begin[i]) = slope * end->per_length;
    }
    return polygon_bands(4, 2, at->bands, at->tables, &edges, weights);
}

/* --- surfaces --------------------------------------------------------------------------------- */

/* Computes what a lobe receives of the Dirac that a tube is from afar. */
LMPI_INLINE vd tube_dirac_lobe(const flat_surfaces *at, const vd w[3], const vd q[3],
                               const float *weights) {
    const vd z = vd_dot(q, w), zero = vd_set(0);
    vd y1 = zero, y2 = zero;
    LMPI_ROLLED for (int l = at->bands - 1; l >= 0; l--) {
        const vd weight = vd_load(weights + (ptrdiff_t)l * LMPI_LANES) * at->tables->to_p[l];
        const double of_p = l + 1 < at->bands ? at->tables->of_p[l + 1] : 0;
        const vd y0 = (weight - of_p * y2) + z * y1;
        y2 = y1;
        y1 = y0;
    }
    return y1;
}

/* A tube from a surface: where it is, and how; the Dirac that it is from afar. Then what serves it
 * in which lanes, 1 or 0: for the diffuse lobe the Dirac or the outline, where the horizon does not
 * cut it; for the others the Dirac, or the outline with few nodes or with many. */
typedef struct tube_place {
    vd up, direction[3], strength;
    tube_seen seen;
    tube_direction normal;
    vd diffuse_dirac, diffuse_outline, lobes_dirac, lobes_few, lobes_many;
} tube_place;

LMPI_INLINE void tube_choose(const lmpi_kernel_tube *light, const flat_surfaces *at, vd distance2,
                             tube_place *place) {
    const tube_end *ends = place->seen.end;
    const double r = light->radius, size = light->half + r, far = TUBE_FAR * size,
                 far_lobes = TUBE_FAR_LOBES_A_BAND * at->bands * size,
                 cancels = TUBE_CANCELS * size;
    const vd zero = vd_set(0), one = vd_set(1), half = vd_set(0.5);
    /* from beyond an end, or inside, there are no edges; rounding may decide which it is */
    const vd beside = vd_select_less(vd_set(1.0001 * r), place->seen.distance, one, zero);
    const vd aside = vd_select_less(vd_set(TUBE_ASIDE * r), place->seen.distance, one, zero);
    const vd near = vd_select_less(distance2, vd_set(cancels * cancels), beside, zero);
    const vd reach = light->half * vd_abs(place->normal.axis) + r;
    const vd cut = vd_select_less(vd_abs(place->up), reach, one, zero);
    place->diffuse_dirac = vd_select_less(vd_set(far * far), distance2, aside * (1.0 - cut), zero);
    place->diffuse_outline = vd_select_less(half, place->diffuse_dirac, zero, near * (1.0 - cut));
    place->lobes_dirac = vd_select_less(vd_set(far_lobes * far_lobes), distance2, aside, zero);
    const vd arc = -vd_max(-ends[0].arc_cosine, -ends[1].arc_cosine),
             wide = vd_max(ends[0].sine, ends[1].sine) * (double)at->bands;
    const vd outline = vd_select_less(vd_set(TUBE_ARC), arc,
                                      vd_select_less(half, place->lobes_dirac, zero, near), zero);
    place->lobes_few = vd_select_less(wide, vd_set(TUBE_WAVES_FEW), outline, zero);
    place->lobes_many =
        vd_select_less(wide, vd_set(TUBE_WAVES_MANY), outline - place->lobes_few, zero);
}

LMPI_INLINE void tube_locate(const lmpi_kernel_tube *light, const flat_surfaces *at,
                             tube_place *place) {
    const double position[3] = { (double)light->position.x, (double)light->position.y,
                                 (double)light->position.z };
    vd to[3];
    for (int k = 0; k < 3; k++)
        to[k] = (position[k] - at->point[k]) * light->per_unit;
    tube_see(light, to, &place->seen);
    const vd square = vd_dot(to, to), per = vd_per_root(square);
    for (int k = 0; k < 3; k++)
        place->direction[k] = to[k] * per;
    place->strength =
        (light->radius * (per * per)) *
        ((4 * light->half) * (place->seen.distance * per) + 3.14159265358979323846 * light->radius);
    place->up = vd_dot(at->normal, to);
    place->normal = tube_rotate(light, &place->seen, at->normal);
    tube_choose(light, at, square, place);
}

/* Returns a lobe's response where the outline serves. */
LMPI_INLINE vd tube_outline_lobe(const lmpi_kernel_tube *light, const flat_surfaces *at,
                                 const tube_place *place, vd solid_angle, const vd axis[3],
                                 const float *weights) {
    const vd half = vd_set(0.5), zero = vd_set(0);
    const tube_direction q = tube_rotate(light, &place->seen, axis);
    const vd edges =
        vd_load(weights) * solid_angle + tube_edges_lobe(light, at, &place->seen, q, weights);
    vd ends = zero;
    if (vd_any_less(half, place->lobes_few))
        ends = vd_select_less(half, place->lobes_few,
                              tube_ends_lobe(&tube_few, at, &place->seen, q, weights), ends);
    if (vd_any_less(half, place->lobes_many))
        ends = vd_select_less(half, place->lobes_many,
                              tube_ends_lobe(&tube_many, at, &place->seen, q, weights), ends);
    return vd_select_less(half, place->lobes_few + place->lobes_many, edges + ends, zero);
}

/* Computes the responses of all lobes to a light of radiance 1, and says which lanes are left. */
static LMPI_NOINLINE void tube_respond(const lmpi_kernel_tube *light, const flat_surfaces *at,
                                       vd *responses, vd *left) {
    const vd zero = vd_set(0), half = vd_set(0.5);
    tube_place place;
    tube_locate(light, at, &place);
    const vd dirac = place.strength * vd_max(vd_dot(at->normal, place.direction), zero),
             outline = vd_max(tube_open(&place.seen, place.normal), zero);
    responses[0] = vd_select_less(
        zero, place.up,
        vd_select_less(half, place.diffuse_dirac, dirac, place.diffuse_outline * outline), zero);
    *left = LMPI_LEFT_DIFFUSE * (1.0 - (place.diffuse_dirac + place.diffuse_outline));
    if (at->lobe_count == 0)
        return;
    const vd outlined = place.lobes_few + place.lobes_many;
    *left = *left + LMPI_LEFT_LOBES * (1.0 - (place.lobes_dirac + outlined));
    const int is_outlined = vd_any_less(half, outlined),
              is_dirac = vd_any_less(half, place.lobes_dirac);
    const vd solid_angle = tube_solid_angle(light, &place.seen);
    for (int k = 0; k < at->lobe_count; k++) {
        const float *weights = flat_weights(at, k);
        vd sum = is_outlined
                     ? tube_outline_lobe(light, at, &place, solid_angle, at->axis[k], weights)
                     : zero;
        if (is_dirac)
            sum = vd_select_less(
                half, place.lobes_dirac,
                place.strength * tube_dirac_lobe(at, place.direction, at->axis[k], weights), sum);
        responses[1 + k] = sum;
    }
}

#endif
