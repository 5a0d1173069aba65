/* SPDX-License-Identifier: MIT */
/* bench_slots.h - what kernels and calls share: the values of an element, and the operations that
 * it asks for, mul, add, div and sqrt, none fused. */
#ifndef LAMPION_STUDY_BENCH_SLOTS_H
#define LAMPION_STUDY_BENCH_SLOTS_H

#include <lampion/sh.h>

static inline size_t bench_values_basis(int n) {
    return LMP_SH_COUNT(n);
}
static inline size_t bench_values_bands(int n) {
    return (size_t)n;
}
static inline size_t bench_values_color(int n) {
    (void)n;
    return 3;
}

/* Count bands past the second; entries (l, m) with m >= 0; and steps of their recurrences. */
static inline double bench_later(int n) {
    return n > 2 ? n - 2 : 0;
}
static inline double bench_entries(int n) {
    return n * (n + 1) / 2.0;
}
static inline double bench_steps(int n) {
    return n * (n - 1) / 2.0;
}

/* Count for a basis, per column, 2 for its first step, 4 for each later one, times C_m and S_m; C_m
 * and S_m take 6. */
static inline double bench_slots_basis(int n) {
    return 2 * (n - 1) + 4 * (bench_steps(n) - (n - 1)) + 2 * bench_steps(n) + 6 * bench_later(n);
}

/* Counts a column's step, lambda_l, and three channels of its cosine and sine; for a diffuse lobe
 * every other lambda_l vanishes. */
static inline double bench_slots_irradiance(int n) {
    return 4 * bench_steps(n) + 6 * bench_later(n) + (1 + 12) * bench_entries(n) / 2 + 12.0 * n;
}

static inline double bench_slots_rotate(int n) {
    double slots = 0;
    for (int side = 1; side < 2 * n; side += 2)
        slots += side * (2.0 * side - 1);
    return slots;
}

#endif
