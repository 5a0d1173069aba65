/* SPDX-License-Identifier: MIT */
/* preintegrated_lookup.h - how a preintegrated lobe or BRDF is read (docs/preintegration.md): the
 * numbers of its layout and the arithmetic of a reading, written once and compiled three times, as
 * C of one float, as C of the kernels' lanes (where LMPI_LANES is defined) and as GLSL. What
 * differs among the three is only how a value is fetched. */
#ifndef LAMPION_PREINTEGRATED_LOOKUP_H
#define LAMPION_PREINTEGRATED_LOOKUP_H

#define LMP_LOOKUP_PI 3.14159265358979f

/* --- layout of a lobe ------------------------------------------------------------------------- */

/* The remap of exponents: the entry within an octave of 1 + e is given by the upper bits of the 23
 * of its mantissa. */
#define LMP_LOOKUP_OCTAVES      20
#define LMP_LOOKUP_OCTAVE_BITS  4
#define LMP_LOOKUP_REMAP_COUNT  (LMP_LOOKUP_OCTAVES * (1 << LMP_LOOKUP_OCTAVE_BITS) + 1)
#define LMP_LOOKUP_EXPONENT_MAX 1048575.0f /* 1 + e is 2^20 */

/* The largest coefficient: scaled values are about 1, splines' coefficients up to 1.5. */
#define LMP_LOOKUP_COEFFICIENT_MAX 2.0f

/* --- layout of a BRDF ---------------------------------------------------------------------------
 * An array of floats: header, view_remap, cap_remap, red, green, blue of every view's ambient, then
 * the slices, of every view those of all half angles. Indices: */
#define LMP_LOOKUP_VIEW_COUNT 0
#define LMP_LOOKUP_CAP_COUNT  1
#define LMP_LOOKUP_VIEW_STEPS 2
#define LMP_LOOKUP_CAP_STEPS  3
#define LMP_LOOKUP_WIDTH      4
#define LMP_LOOKUP_RADIUS     5
#define LMP_LOOKUP_REACH      6
#define LMP_LOOKUP_SLOPE      7
#define LMP_LOOKUP_LOBE_ANGLE 8
#define LMP_LOOKUP_MIRRORED   9 /* 1 or 0 */
#define LMP_LOOKUP_HEADER     10

#define LMP_LOOKUP_CORNER_X       0 /* of a slice's first texel in the texture */
#define LMP_LOOKUP_CORNER_Y       1
#define LMP_LOOKUP_ROWS           2
#define LMP_LOOKUP_COLUMNS        3
#define LMP_LOOKUP_ROW_DENSITY    4
#define LMP_LOOKUP_ROW_ORIGIN     5
#define LMP_LOOKUP_COLUMN_DENSITY 6
#define LMP_LOOKUP_VALUE_MAX      7 /* the value of the largest 16-bit number */
#define LMP_LOOKUP_SLICE          8

/* --- the three languages ---------------------------------------------------------------------- */

#ifndef __STDC_VERSION__ /* GLSL */
#define LOOKUP_FUNCTION(type)   type
#define LOOKUP_FLOAT            float
#define LOOKUP_INT              int
#define LOOKUP_SAME(x)          (x)
#define LOOKUP_SQRT(x)          sqrt(x)
#define LOOKUP_MIN(a, b)        min(a, b)
#define LOOKUP_MAX(a, b)        max(a, b)
#define LOOKUP_LESS(a, b, x, y) ((a) < (b) ? (x) : (y))
#define LOOKUP_TO_INT(x)        int(x)
#define LOOKUP_TO_FLOAT(i)      float(i)
#define LOOKUP_BITS(x)          floatBitsToInt(x)
#elif defined(LMPI_LANES)
#include <stdbool.h>
#define LOOKUP_FUNCTION(type)   LMPI_INLINE type
#define LOOKUP_FLOAT            vf
#define LOOKUP_INT              vi
#define LOOKUP_SAME(x)          vf_set(x)
#define LOOKUP_SQRT(x)          vf_sqrt(x)
#define LOOKUP_MIN(a, b)        vf_min(a, b)
#define LOOKUP_MAX(a, b)        vf_max(a, b)
#define LOOKUP_LESS(a, b, x, y) vf_select_less(a, b, x, y)
#define LOOKUP_TO_INT(x)        vi_from(x)
#define LOOKUP_TO_FLOAT(i)      vf_from(i)
#else
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#define LOOKUP_FUNCTION(type)   static inline type
#define LOOKUP_FLOAT            float
#define LOOKUP_INT              int32_t
#define LOOKUP_SAME(x)          (x)
#define LOOKUP_SQRT(x)          sqrtf(x)
#define LOOKUP_MIN(a, b)        fminf(a, b)
#define LOOKUP_MAX(a, b)        fmaxf(a, b)
#define LOOKUP_LESS(a, b, x, y) ((a) < (b) ? (x) : (y))
#define LOOKUP_TO_INT(x)        ((int32_t)(x))
#define LOOKUP_TO_FLOAT(i)      ((float)(i))
#define LOOKUP_BITS(x)          lmp_lookup_bits(x)
static inline int32_t lmp_lookup_bits(float x) {
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
#endif

/* --- angles ----------------------------------------------------------------------------------- */

/* Returns acos(1 - y), y in 0 … 1, to 3e-8, with the same relative error for small y (Abramowitz
 * and Stegun 4.4.46). */
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_arc(LOOKUP_FLOAT y) {
    LOOKUP_FLOAT x = 1.0f - y;
    LOOKUP_FLOAT p = -0.0012624911f * x + 0.0066700901f;
    p = p * x - 0.0170881256f;
    p = p * x + 0.0308918810f;
    p = p * x - 0.0501743046f;
    p = p * x + 0.0889789874f;
    p = p * x - 0.2145988016f;
    p = p * x + 1.5707963050f;
    return LOOKUP_SQRT(y) * p;
}

/* Returns acos(u), for u in -1 … 1 up to rounding. */
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_acos(LOOKUP_FLOAT u) {
    LOOKUP_FLOAT zero = LOOKUP_SAME(0.0f);
    LOOKUP_FLOAT near = lmp_lookup_arc(LOOKUP_MAX(1.0f - LOOKUP_MAX(u, -u), zero));
    return LOOKUP_LESS(u, zero, LMP_LOOKUP_PI - near, near);
}

/* Returns the angle of a unit vector to its z axis, from z and x² + y². */
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_polar(LOOKUP_FLOAT z, LOOKUP_FLOAT across2) {
    /* 1 - |z| without cancellation */
    LOOKUP_FLOAT y = across2 / (1.0f + LOOKUP_MAX(z, -z));
    LOOKUP_FLOAT near = lmp_lookup_arc(LOOKUP_MIN(y, LOOKUP_SAME(1.0f)));
    return LOOKUP_LESS(z, LOOKUP_SAME(0.0f), LMP_LOOKUP_PI - near, near);
}

/* Returns the azimuth of a vector, 0 … 2 pi, or 0 … pi where both sides are alike; 0 on the axis.
 */
LOOKUP_FUNCTION(LOOKUP_FLOAT)
lmp_lookup_azimuth(LOOKUP_FLOAT x, LOOKUP_FLOAT y, LOOKUP_FLOAT across2, bool mirrored) {
    LOOKUP_FLOAT zero = LOOKUP_SAME(0.0f), one = LOOKUP_SAME(1.0f), across = LOOKUP_SQRT(across2);
    LOOKUP_FLOAT side = LOOKUP_MIN(LOOKUP_MAX(x, -x) / across, one);
    LOOKUP_FLOAT quarter = lmp_lookup_arc(1.0f - LOOKUP_LESS(zero, across, side, one));
    LOOKUP_FLOAT half_circle = LOOKUP_LESS(x, zero, LMP_LOOKUP_PI - quarter, quarter);
    if (mirrored)
        return half_circle;
    return LOOKUP_LESS(y, zero, 2.0f * LMP_LOOKUP_PI - half_circle, half_circle);
}

/* --- where a reading lies --------------------------------------------------------------------- */

/* Returns the integer part of a coordinate along a remap or slices, at most `last`, so that there
 * is a next entry. */
LOOKUP_FUNCTION(LOOKUP_INT) lmp_lookup_first(LOOKUP_FLOAT at, float last) {
    return LOOKUP_TO_INT(LOOKUP_MIN(at, LOOKUP_SAME(last)));
}

LOOKUP_FUNCTION(LOOKUP_FLOAT)
lmp_lookup_between(LOOKUP_FLOAT low, LOOKUP_FLOAT high, LOOKUP_FLOAT fraction) {
    return low + fraction * (high - low);
}

#ifndef LMPI_LANES
/* Returns the remap's coordinate of an exponent, which is looked up once per surface. */
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_exponent(LOOKUP_FLOAT e) {
    return LOOKUP_TO_FLOAT(LOOKUP_BITS(1.0f + e) - LOOKUP_BITS(1.0f)) /
           LOOKUP_TO_FLOAT(1 << (23 - LMP_LOOKUP_OCTAVE_BITS));
}
#endif

/* Returns the nodes per radian of a lobe's cell, whose steps follow the width 1/sqrt(e + 1.5) of
 * the lobe: that of a Gaussian with the curvature of cos^e at its peak, a little wider for small e.
 */
LOOKUP_FUNCTION(LOOKUP_FLOAT)
lmp_lookup_density(LOOKUP_FLOAT scale, LOOKUP_FLOAT offset, LOOKUP_FLOAT e) {
    return scale * LOOKUP_SQRT(e + 1.5f) + offset;
}

/* Returns the solid angle of a lobe of n bands that is as high as its peak, up to a factor: width2
 * = 1/n². */
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_solid_angle(LOOKUP_FLOAT e, float width2) {
    return LMP_LOOKUP_PI * (1.0f / (e + 1.0f) + width2);
}

/* Returns the coordinate of a BRDF's cap_remap, 0 … 1, with finer steps for small lights. */
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_cap(LOOKUP_FLOAT a) {
    return a / (a + 0.5f) * ((LMP_LOOKUP_PI + 1.0f) / LMP_LOOKUP_PI);
}

/* Returns a BRDF's row coordinate, before density and origin, of a cap of half angle a at the angle
 * g from the mirror direction. It is counted from the rim of the cap, at its half angle; a cap
 * smaller than the lobe shifts nothing. */
LOOKUP_FUNCTION(LOOKUP_FLOAT)
lmp_lookup_row(LOOKUP_FLOAT g, LOOKUP_FLOAT a, float radius, float width, float reach,
               float slope) {
    LOOKUP_FLOAT rim = a * a / (LOOKUP_SQRT(a * a + radius * radius) + radius), x = g - rim;
    return x * (reach / (width * LOOKUP_SQRT(x * x + reach * reach)) + slope);
}

/* Return the integer part of a row or column that leaves a neighbor before and two after, so at
 * most count - 3, and the fraction past it. */
LOOKUP_FUNCTION(LOOKUP_INT) lmp_lookup_base(LOOKUP_FLOAT at, LOOKUP_FLOAT most) {
    return LOOKUP_TO_INT(LOOKUP_MIN(LOOKUP_MAX(at, LOOKUP_SAME(1.0f)), most));
}
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_past(LOOKUP_FLOAT at, LOOKUP_INT base) {
    LOOKUP_FLOAT past = LOOKUP_MAX(at - LOOKUP_TO_FLOAT(base), LOOKUP_SAME(0.0f));
    return LOOKUP_MIN(past, LOOKUP_SAME(1.0f));
}

/* --- splines ------------------------------------------------------------------------------------
 * Weights times 6 of the four neighbors of a point of a cubic B-spline, of which `x` is how far it
 * lies past the second: outer(1 - x), inner(x), inner(1 - x), outer(x). */

LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_outer(LOOKUP_FLOAT x) {
    return x * x * x;
}
LOOKUP_FUNCTION(LOOKUP_FLOAT) lmp_lookup_inner(LOOKUP_FLOAT x) {
    return 4.0f + 3.0f * (x * x) * (x - 2.0f);
}

#undef LOOKUP_FUNCTION
#undef LOOKUP_FLOAT
#undef LOOKUP_INT
#undef LOOKUP_SAME
#undef LOOKUP_SQRT
#undef LOOKUP_MIN
#undef LOOKUP_MAX
#undef LOOKUP_LESS
#undef LOOKUP_TO_INT
#undef LOOKUP_TO_FLOAT
#undef LOOKUP_BITS

#endif
