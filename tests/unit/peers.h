/* SPDX-License-Identifier: MIT */
/* peers.h - what the tests of docs/migrating.md and docs/migrating-engines.md share: three bands as
 * other libraries publish them. */
#ifndef LAMPION_TESTS_UNIT_PEERS_H
#define LAMPION_TESTS_UNIT_PEERS_H

#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/probe.h>

#include <math.h>
#include <string.h>

enum { COUNT = 9 };

static const lmp_probe_convention ours = { 0 };
static const lmp_vec3 up = { 0, 1, 0 }, down = { 0, -1, 0 };

static inline void randomize(float *sh, int count) {
    for (int i = 0; i < count; i++)
        sh[i] = (float)check_random_between(-1, 1);
}

/* Evaluates three bands as polynomials, Sloan's «Stupid Spherical Harmonics Tricks», A2; `sign` -1
 * is the sign of Condon and Shortley, as there. */
static inline void published_basis(lmp_vec3 d, double sign, double basis[COUNT]) {
    const double x = (double)d.x, y = (double)d.y, z = (double)d.z;
    const double values[COUNT] = { 0.282094791773878,
                                   sign * 0.488602511902920 * y,
                                   0.488602511902920 * z,
                                   sign * 0.488602511902920 * x,
                                   1.092548430592079 * x * y,
                                   sign * 1.092548430592079 * y * z,
                                   0.315391565252520 * (3 * z * z - 1),
                                   sign * 1.092548430592079 * x * z,
                                   0.546274215296040 * (x * x - y * y) };
    memcpy(basis, values, sizeof values);
}

static inline double published_sum(lmp_vec3 d, double sign, const float *sh) {
    double basis[COUNT], sum = 0;
    published_basis(d, sign, basis);
    for (int i = 0; i < COUNT; i++)
        sum += basis[i] * (double)sh[i];
    return sum;
}

/* Makes a cube map of one channel whose faces show the function of `sh` in the directions that
 * `direction` gives for a face, a column and a row, both in -1 … 1. */
enum { CUBE = 48 };
typedef float cube_texels[6][CUBE][CUBE];
typedef lmp_vec3 cube_direction(int face, float column, float row);
static inline lmp_cubemap cube_of(cube_direction *direction, double sign, const float *sh,
                                  cube_texels texels) {
    lmp_cubemap map = { .size = CUBE, .channels = 1 };
    for (int face = 0; face < 6; face++) {
        map.faces[face] = texels[face];
        for (int row = 0; row < CUBE; row++)
            for (int column = 0; column < CUBE; column++) {
                lmp_vec3 d = direction(face, (2 * (float)column + 1) / CUBE - 1,
                                       (2 * (float)row + 1) / CUBE - 1);
                const float length = sqrtf(d.x * d.x + d.y * d.y + d.z * d.z);
                d = (lmp_vec3) { d.x / length, d.y / length, d.z / length };
                texels[face][row][column] = (float)published_sum(d, sign, sh);
            }
    }
    return map;
}

/* Returns the difference relative to the largest coefficient. */
static inline double difference(const float *a, const float *b) {
    double expected[COUNT];
    for (int i = 0; i < COUNT; i++)
        expected[i] = (double)a[i];
    return check_error(COUNT, expected, b);
}

#endif
