/* SPDX-License-Identifier: MIT */
/* The kernels of fields: cubics are kept, and both agree where both have a value. */
#include "src/kernels/dispatch.h"
#include "tests/oracle/check.h"

#include <lampion/cpu.h>

#include <math.h>

/* Evaluates x^i y^j z^k, i + j + k <= 3, and its derivatives. */
static void monomials(const double at[3], double value[20], double slopes[3][20]) {
    double power[3][5] = { { 0 } }; /* powers -1 … 3 */
    int count = 0;
    for (int a = 0; a < 3; a++)
        for (int i = 0; i <= 3; i++)
            power[a][1 + i] = i == 0 ? 1 : power[a][i] * at[a];
    for (int i = 0; i <= 3; i++)
        for (int j = 0; i + j <= 3; j++)
            for (int k = 0; i + j + k <= 3; k++, count++) {
                value[count] = power[0][1 + i] * power[1][1 + j] * power[2][1 + k];
                slopes[0][count] = i * power[0][i] * power[1][1 + j] * power[2][1 + k];
                slopes[1][count] = j * power[0][1 + i] * power[1][j] * power[2][1 + k];
                slopes[2][count] = k * power[0][1 + i] * power[1][1 + j] * power[2][k];
            }
}

/* The nodes of one cell hold the 20 monomials; the number of points ends within a register. */
static void interpolation_keeps_cubics(void **test) {
    (void)test;
    enum { POINTS = 37, PADDED = 48, MONOMIALS = 20, STRIDE = 32 };
    static float nodes[8 * 4 * STRIDE] __attribute__((aligned(64)));
    static float s[3][PADDED] __attribute__((aligned(64)));
    static uint32_t corners[PADDED * 8];
    static float out[POINTS * MONOMIALS];
    static const double edge[3] = { 0.5, 2, 1.25 };
    double value[MONOMIALS], slopes[3][MONOMIALS];
    for (int k = 0; k < 8; k++) {
        monomials((double[3]) { edge[0] * (k & 1), edge[1] * (k >> 1 & 1), edge[2] * (k >> 2) },
                  value, slopes);
        for (int v = 0; v < MONOMIALS; v++)
            for (int q = 0; q < 4; q++)
                nodes[(4 * k + q) * STRIDE + v] = (float)(q == 0 ? value[v] : slopes[q - 1][v]);
    }
    for (uint32_t i = 0; i < PADDED; i++) {
        for (uint32_t k = 0; k < 8; k++)
            corners[8 * i + k] = k;
        for (int a = 0; a < 3; a++)
            s[a][i] = (float)check_random();
    }
    const lmpi_kernel_cells cells = {
        nodes, STRIDE, { 0.5f, 2, 1.25f }, corners, { s[0], s[1], s[2] }
    };
    const lmpi_kernel_out to = { out, MONOMIALS, 0 };
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        lmpi_kernels kernels;
        (void)lmpi_kernels_init(&kernels, flag);
        kernels.field.interpolate(MONOMIALS, &cells, POINTS, &to);
        for (int i = 0; i < POINTS; i++) {
            const double at[3] = { edge[0] * (double)s[0][i], edge[1] * (double)s[1][i],
                                   edge[2] * (double)s[2][i] };
            monomials(at, value, slopes);
            CHECK_WITHIN(check_error(MONOMIALS, value, out + i * MONOMIALS), 3e-6);
        }
    }
}

/* A brick lies between nodes that hold the 20 monomials. */
static void refined_nodes_keep_cubics(void **test) {
    (void)test;
    enum { MONOMIALS = 20, STRIDE = 32 };
    static float from[12 * 4 * STRIDE] __attribute__((aligned(64)));
    static float nodes[16 * 4 * STRIDE] __attribute__((aligned(64)));
    static const double edge[3] = { 0.5, 2, 1.25 };
    lmpi_kernel_brick brick = { .stride = STRIDE, .cell = { 0.5f, 2, 1.25f }, .next = nodes };
    double value[MONOMIALS], slopes[3][MONOMIALS];
    for (int k = 0; k < 12; k++) {
        brick.from[k] = from + 4 * k * STRIDE;
        monomials((double[3]) { edge[0] * (k % 3), edge[1] * (k / 3 % 2), edge[2] * (k / 6) },
                  value, slopes);
        for (int v = 0; v < MONOMIALS; v++)
            for (int q = 0; q < 4; q++)
                from[(4 * k + q) * STRIDE + v] = (float)(q == 0 ? value[v] : slopes[q - 1][v]);
    }
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        lmpi_kernels kernels;
        (void)lmpi_kernels_init(&kernels, flag);
        kernels.field.refine(&brick, nodes);
        for (int i = 0; i < 16; i++) {
            const float *node = nodes + 4 * i * STRIDE;
            monomials((double[3]) { 0.5 * edge[0] * (i % 4), 0.5 * edge[1] * (i / 4 % 2),
                                    0.5 * edge[2] * (i / 8) },
                      value, slopes);
            CHECK_WITHIN(check_error(MONOMIALS, value, node), 3e-6);
            for (int a = 0; a < 3; a++)
                CHECK_WITHIN(check_error(MONOMIALS, slopes[a], node + (1 + a) * STRIDE), 6e-6);
        }
    }
}

/* Refined nodes agree with interpolation for any nodes, cubic or not. */
static void refined_nodes_are_interpolated(void **test) {
    (void)test;
    enum { STRIDE = 16 };
    static float from[12 * 4 * STRIDE] __attribute__((aligned(64)));
    static float nodes[16 * 4 * STRIDE] __attribute__((aligned(64)));
    static float s[3][16] __attribute__((aligned(64)));
    uint32_t corners[16 * 8];
    float out[16 * STRIDE];
    lmpi_kernels kernels;
    lmpi_kernel_brick brick = { .stride = STRIDE, .cell = { 0.5f, 2, 1.25f }, .next = nodes };
    for (size_t i = 0; i < sizeof from / sizeof *from; i++)
        from[i] = (float)check_random();
    for (uint32_t i = 0; i < 12; i++)
        brick.from[i] = from + 4 * i * STRIDE;
    for (uint32_t i = 0; i < 16; i++) {
        for (uint32_t k = 0; k < 8; k++)
            corners[8 * i + k] = i % 4 / 2 + k % 2 + 3 * (k / 2 % 2) + 6 * (k / 4);
        s[0][i] = 0.5f * (float)(i % 2);
        s[1][i] = 0.5f * (float)(i / 4 % 2);
        s[2][i] = 0.5f * (float)(i / 8);
    }
    const lmpi_kernel_cells cells = { from, STRIDE, brick.cell, corners, { s[0], s[1], s[2] } };
    const lmpi_kernel_out to = { out, STRIDE, 0 };
    (void)lmpi_kernels_init(&kernels, LMP_CPU_ALL);
    kernels.field.interpolate(STRIDE, &cells, 16, &to);
    kernels.field.refine(&brick, nodes);
    for (int i = 0; i < 16; i++)
        for (int v = 0; v < STRIDE; v++)
            CHECK_WITHIN((double)fabsf(nodes[4 * i * STRIDE + v] - out[i * STRIDE + v]), 1e-6);
}

/* The sums have the same bits on every instruction set. */
static void refined_nodes_are_added(void **test) {
    (void)test;
    enum { STRIDE = 48, ALL = 16 * 4 * STRIDE };
    static float from[12 * 4 * STRIDE] __attribute__((aligned(64)));
    static float nodes[ALL] __attribute__((aligned(64))), sums[ALL] __attribute__((aligned(64)));
    lmpi_kernel_brick brick = { .stride = STRIDE, .cell = { 0.5f, 2, 1.25f }, .next = nodes };
    for (size_t i = 0; i < sizeof from / sizeof *from; i++)
        from[i] = (float)check_random();
    for (int i = 0; i < 12; i++)
        brick.from[i] = from + 4 * i * STRIDE;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag *= 2) {
        lmpi_kernels kernels;
        (void)lmpi_kernels_init(&kernels, flag);
        kernels.field.refine(&brick, nodes);
        for (int i = 0; i < ALL; i++)
            sums[i] = from[i % STRIDE];
        kernels.field.refine_add(&brick, sums);
        for (int i = 0; i < ALL; i++) {
            const float sum = from[i % STRIDE] + nodes[i];
            assert_memory_equal(&sums[i], &sum, sizeof sum);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interpolation_keeps_cubics),
        cmocka_unit_test(refined_nodes_keep_cubics),
        cmocka_unit_test(refined_nodes_are_interpolated),
        cmocka_unit_test(refined_nodes_are_added),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
