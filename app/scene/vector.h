/* SPDX-License-Identifier: MIT */
/* vector.h - arithmetic on lmp_vec3 by value. */
#ifndef LAMPION_SCENE_VECTOR_H
#define LAMPION_SCENE_VECTOR_H

#include <lampion/base.h>

#include <math.h>

#define PI 3.14159265f /* M_PI is the double */

static inline lmp_vec3 vec(float x, float y, float z) {
    return (lmp_vec3) { x, y, z };
}

static inline lmp_vec3 vec_load(const float *p) {
    return (lmp_vec3) { p[0], p[1], p[2] };
}

static inline void vec_store(lmp_vec3 a, float *p) {
    p[0] = a.x;
    p[1] = a.y;
    p[2] = a.z;
}

static inline lmp_vec3 vec_add(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline lmp_vec3 vec_sub(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline lmp_vec3 vec_scale(lmp_vec3 a, float s) {
    return (lmp_vec3) { a.x * s, a.y * s, a.z * s };
}

static inline lmp_rgb rgb_load(const float *p) {
    return (lmp_rgb) { p[0], p[1], p[2] };
}

static inline void rgb_store(lmp_rgb a, float *p) {
    p[0] = a.r;
    p[1] = a.g;
    p[2] = a.b;
}

static inline lmp_rgb rgb_scale(lmp_rgb a, float s) {
    return (lmp_rgb) { a.r * s, a.g * s, a.b * s };
}

/* Returns the brightest channel of a color. */
static inline float rgb_brightest(const float color[3]) {
    const float brighter = color[1] > color[2] ? color[1] : color[2];
    return color[0] > brighter ? color[0] : brighter;
}

static inline float vec_dot(lmp_vec3 a, lmp_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline lmp_vec3 vec_cross(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline float vec_length(lmp_vec3 a) {
    return sqrtf(vec_dot(a, a));
}

/* Normalizes a; returns `fallback` if a has no direction. */
static inline lmp_vec3 vec_normalize(lmp_vec3 a, lmp_vec3 fallback) {
    const float square = vec_dot(a, a);
    if (square > 1e-30f && square < 1e30f)
        return vec_scale(a, 1.0f / sqrtf(square));
    /* squares of floats may overflow, underflow or lose digits; those of doubles do not */
    const double x = (double)a.x, y = (double)a.y, z = (double)a.z;
    const double length = sqrt(x * x + y * y + z * z);
    return length > 0.0 && isfinite(length)
               ? vec((float)(x / length), (float)(y / length), (float)(z / length))
               : fallback;
}

/* Returns a unit vector perpendicular to the unit vector n. */
static inline lmp_vec3 vec_across(lmp_vec3 n) {
    const lmp_vec3 axis = fabsf(n.x) < 0.6f ? vec(1.0f, 0.0f, 0.0f) : vec(0.0f, 0.0f, 1.0f);
    return vec_normalize(vec_cross(axis, n), vec(1.0f, 0.0f, 0.0f));
}

/* Returns the unit vector along what of v is perpendicular to the unit vector n, or any such one if
 * nothing is. */
static inline lmp_vec3 vec_reject(lmp_vec3 v, lmp_vec3 n) {
    return vec_normalize(vec_sub(v, vec_scale(n, vec_dot(v, n))), vec_across(n));
}

#endif
