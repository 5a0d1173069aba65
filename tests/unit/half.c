/* SPDX-License-Identifier: MIT */
/* Every number of 16 bits, and floats on all sides of them, against their definition in double,
 * with the same bits on every instruction set. */
#include "tests/oracle/check.h"

#include <lampion/cpu.h>
#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HALVES = 65536, FLOATS = 1 << 16 };

static uint16_t halves[HALVES], packed[FLOATS];
static float values[HALVES], floats[FLOATS];

/* Returns a half's value by IEEE 754: sign, 5 bits of exponent, 10 of the significand. */
static double value_of(uint16_t half) {
    const int exponent = half >> 10 & 31, significand = half & 1023;
    const double size = exponent == 0    ? ldexp(significand, -24)
                        : exponent == 31 ? significand ? (double)NAN : HUGE_VAL
                                         : ldexp(1024 + significand, exponent - 25);
    return half & 0x8000 ? -size : size;
}

/* Returns the nearest half of at least 0, the even one of two; past the greatest as if there were
 * more. */
static uint16_t nearest(double size) {
    uint16_t below = 0, above = 0x7c00;
    while (above - below > 1) {
        const uint16_t middle = (uint16_t)((below + above) / 2);
        if (value_of(middle) <= size)
            below = middle;
        else
            above = middle;
    }
    const double next = above == 0x7c00 ? 65536 : value_of(above);
    const double down = size - value_of(below), up = next - size;
    return down < up || (down == up && below % 2 == 0) ? below : above;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void every_half_comes_back(void **test) {
    (void)test;
    static uint16_t back[HALVES];
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2) {
        if (lmp_cpu_limit(flag) != flag)
            continue;
        for (int i = 0; i < HALVES; i++)
            halves[i] = (uint16_t)i;
        lmp_sh_unpack_half_n(halves, HALVES, values);
        lmp_sh_pack_half_n(values, HALVES, back);
        for (int i = 0; i < HALVES; i++) {
            const double expected = value_of(halves[i]);
            const bool nan = isnan(expected);
            assert_int_equal(bits_of(values[i]) >> 31, i >> 15);
            assert_true(nan ? isnan(values[i]) : (double)values[i] == expected);
            assert_int_equal(back[i], nan ? i | 0x200 : i);
            if (nan)
                assert_int_equal(bits_of(values[i]) & 0x7fffff, (i & 0x3ff) << 13 | 0x400000);
        }
    }
    lmp_cpu_limit(LMP_CPU_ALL);
}

/* Fills in halves, midpoints of two, the floats next to each, and then random bits. */
static void fill(void) {
    for (int i = 0; i < FLOATS; i++) {
        const uint32_t half = (uint32_t)i * 2654435761u >> 16 & 0x7bff;
        const double low = value_of((uint16_t)half);
        const double high = half == 0x7bff ? 65536 : value_of((uint16_t)(half + 1));
        const float edge = (float)(i % 2 ? low : (low + high) / 2);
        const float sides[] = { edge, nextafterf(edge, -1), nextafterf(edge, 1e9f) };
        floats[i] = i % 4 == 3 ? float_of((uint32_t)i * 2654435761u) : sides[i / 4 % 3];
        if (i % 8 < 4)
            floats[i] = -floats[i];
    }
    const float special[] = { 0,         -0.0f,      INFINITY, -INFINITY,
                              65504,     65519.996f, 65520,    65536,
                              1e30f,     0x1p-24f,   0x1p-25f, nextafterf(0x1p-25f, 1),
                              0x1p-126f, 0x1p-149f };
    memcpy(floats, special, sizeof special);
}

static void floats_become_the_nearest_half(void **test) {
    (void)test;
    fill();
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2) {
        if (lmp_cpu_limit(flag) != flag)
            continue;
        lmp_sh_pack_half_n(floats, FLOATS, packed);
        for (int i = 0; i < FLOATS; i++) {
            const uint32_t bits = bits_of(floats[i]), sign = bits >> 16 & 0x8000;
            const uint32_t size = isnan(floats[i])   ? 0x7e00 | (bits >> 13 & 0x3ff)
                                  : isinf(floats[i]) ? 0x7c00
                                                     : nearest(fabs((double)floats[i]));
            assert_int_equal(packed[i], sign | size);
        }
    }
    lmp_cpu_limit(LMP_CPU_ALL);
}

static void any_count_is_taken_and_nothing_else_is_written(void **test) {
    (void)test;
    uint16_t some[80];
    float back[80];
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2)
        for (size_t count = 0; count <= 70 && lmp_cpu_limit(flag) == flag; count++) {
            memset(some, 0x11, sizeof some);
            memset(back, 0x11, sizeof back);
            lmp_sh_pack_half_n(floats + 100, count, some + 3);
            lmp_sh_unpack_half_n(some + 3, count, back + 3);
            for (size_t i = 0; i < 80; i++) {
                const bool inside = i >= 3 && i < 3 + count;
                assert_int_equal(some[i], inside ? packed[100 + i - 3] : 0x1111);
                assert_true(inside || bits_of(back[i]) == 0x11111111);
            }
        }
    lmp_cpu_limit(LMP_CPU_ALL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_comes_back),
        cmocka_unit_test(floats_become_the_nearest_half),
        cmocka_unit_test(any_count_is_taken_and_nothing_else_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
