/* SPDX-License-Identifier: MIT */
/* reference_vector.h - 3D vectors in double, random streams, and directions around an axis. */
#ifndef LAMPION_TRUTH_REFERENCE_VECTOR_H
#define LAMPION_TRUTH_REFERENCE_VECTOR_H

#include <lampion/base.h>

#include <math.h>
#include <stdint.h>

#define REFERENCE_PI 3.14159265358979323846

typedef struct reference_vec {
    double x, y, z;
} reference_vec;

static inline reference_vec reference_from_floats(const float v[3]) {
    return (reference_vec) { (double)v[0], (double)v[1], (double)v[2] };
}

static inline reference_vec reference_from(lmp_vec3 v) {
    return (reference_vec) { (double)v.x, (double)v.y, (double)v.z };
}

static inline reference_vec reference_add(reference_vec a, reference_vec b) {
    return (reference_vec) { a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline reference_vec reference_subtract(reference_vec a, reference_vec b) {
    return (reference_vec) { a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline reference_vec reference_scale(double s, reference_vec v) {
    return (reference_vec) { s * v.x, s * v.y, s * v.z };
}

static inline double reference_dot(reference_vec a, reference_vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline reference_vec reference_cross(reference_vec a, reference_vec b) {
    return (reference_vec) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double reference_length(reference_vec v) {
    return sqrt(reference_dot(v, v));
}

/* Returns v/|v|, or z for the zero vector. */
static inline reference_vec reference_normalize(reference_vec v) {
    const double length = reference_length(v);
    return length > 0 ? reference_scale(1 / length, v) : (reference_vec) { 0, 0, 1 };
}

/* Returns the angle between two unit vectors, accurate for small angles too. */
static inline double reference_angle(reference_vec a, reference_vec b) {
    return atan2(reference_length(reference_cross(a, b)), reference_dot(a, b));
}

/* Returns the mirror direction 2 (n·v) n - v. */
static inline reference_vec reference_mirror(reference_vec v, reference_vec n) {
    return reference_subtract(reference_scale(2 * reference_dot(n, v), n), v);
}

/* Returns the direction at `cosine` and `sine` from `axis`, at azimuth 2 pi u, in an orthonormal
 * basis without branches at the poles (Duff et al. 2017). */
static inline reference_vec reference_around(reference_vec axis, double cosine, double sine,
                                             double u) {
    const double sign = copysign(1, axis.z), a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
    const reference_vec s = { 1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x };
    const reference_vec t = { b, sign + axis.y * axis.y * a, -axis.y };
    const double x = sine * cos(2 * REFERENCE_PI * u), y = sine * sin(2 * REFERENCE_PI * u);
    return (reference_vec) { x * s.x + y * t.x + cosine * axis.x,
                             x * s.y + y * t.y + cosine * axis.y,
                             x * s.z + y * t.z + cosine * axis.z };
}

/* Returns number `counter` of the stream `key` (SplitMix64, Steele, Lea and Flood). */
static inline uint64_t reference_hash(uint64_t key, uint64_t counter) {
    uint64_t z = key + 0x9e3779b97f4a7c15u * (counter + 1);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Returns number `counter` of the stream `key`, uniform in [0, 1). */
static inline double reference_random(uint64_t key, uint64_t counter) {
    return (double)(reference_hash(key, counter) >> 11) * 0x1p-53;
}

#endif
