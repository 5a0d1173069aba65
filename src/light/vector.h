/* SPDX-License-Identifier: MIT */
/* vector.h - vectors in double, in which the outlines of lights are computed: where a light looks
 * small or is seen edge-on, what its edges contribute cancels, and float32 would lose it. */
#ifndef LAMPION_LIGHT_VECTOR_H
#define LAMPION_LIGHT_VECTOR_H

#include <lampion/base.h>

#include <math.h>

typedef struct lmpi_vector {
    double x, y, z;
} lmpi_vector;

static inline lmpi_vector lmpi_vector_of(lmp_vec3 v) {
    return (lmpi_vector) { (double)v.x, (double)v.y, (double)v.z };
}

static inline lmp_vec3 lmpi_vector_rounded(lmpi_vector v) {
    return (lmp_vec3) { (float)v.x, (float)v.y, (float)v.z };
}

static inline lmpi_vector lmpi_vector_add(lmpi_vector a, lmpi_vector b) {
    return (lmpi_vector) { a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline lmpi_vector lmpi_vector_sub(lmpi_vector a, lmpi_vector b) {
    return (lmpi_vector) { a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline lmpi_vector lmpi_vector_scale(lmpi_vector v, double factor) {
    return (lmpi_vector) { v.x * factor, v.y * factor, v.z * factor };
}

static inline double lmpi_vector_dot(lmpi_vector a, lmpi_vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline lmpi_vector lmpi_vector_cross(lmpi_vector a, lmpi_vector b) {
    return (lmpi_vector) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double lmpi_vector_length(lmpi_vector v) {
    return sqrt(lmpi_vector_dot(v, v));
}

/* Returns v / |v|, or 0 where v is 0. */
static inline lmpi_vector lmpi_vector_unit(lmpi_vector v) {
    const double length = lmpi_vector_length(v);
    return lmpi_vector_scale(v, length > 0 ? 1 / length : 0);
}

/* Returns a unit vector perpendicular to a unit vector. */
static inline lmpi_vector lmpi_vector_perpendicular(lmpi_vector v) {
    const lmpi_vector x = { 1, 0, 0 }, y = { 0, 1, 0 };
    return lmpi_vector_unit(lmpi_vector_cross(v, fabs(v.x) < 0.6 ? x : y));
}

#endif
