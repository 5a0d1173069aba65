/* SPDX-License-Identifier: MIT */
/* The random numbers of shadows: even in every square of pixels, and in none as in another. */
#include "app/render/shadow/sequence.h"

#include "tests/oracle/check.h"

#include <string.h>

enum { SIZE = 64, RAYS = 2, SEED = 7 };

/* Draws the numbers of a pixel's ray in steps of 1 / `steps`. */
static void draw(uint32_t x, uint32_t y, uint32_t ray, uint32_t steps, uint32_t strata[3]) {
    const shadow_sequence sequence = shadow_sequence_of(x, y, RAYS, SEED);
    float u[3];
    shadow_draw(&sequence, ray, u);
    for (int k = 0; k < 3; k++)
        strata[k] = (uint32_t)(u[k] * (float)steps);
}

/* What a filter mixes has one ray in each stratum. */
static void squares_have_a_ray_in_every_stratum(void **state) {
    (void)state;
    for (uint32_t side = 1; side <= SIZE; side *= 2) {
        const uint32_t steps = RAYS * side * side;
        for (uint32_t left = 0; left < SIZE; left += side) {
            static unsigned char met[3][RAYS * SIZE * SIZE];
            memset(met, 0, sizeof met);
            for (uint32_t i = 0; i < steps; i++) {
                uint32_t strata[3];
                draw(left + i / RAYS % side, i / RAYS / side, i % RAYS, steps, strata);
                for (int k = 0; k < 3; k++)
                    assert_int_equal(met[k][strata[k]]++, 0);
            }
        }
    }
}

/* Numbers that come back at regular distances would show in penumbras as teeth. */
static void no_distance_brings_the_same_strata_back(void **state) {
    (void)state;
    enum { STEPS = 16 };
    for (uint32_t distance = 1; distance <= 32; distance++)
        for (int down = 0; down < 2; down++) {
            int same[3] = { 0 };
            for (uint32_t i = 0; i < SIZE * SIZE; i++) {
                const uint32_t x = i % SIZE, y = i / SIZE;
                uint32_t here[3], there[3];
                draw(x, y, 0, STEPS, here);
                draw(x + (down ? 0 : distance), y + (down ? distance : 0), 0, STEPS, there);
                for (int k = 0; k < 3; k++)
                    same[k] += here[k] == there[k];
            }
            for (int k = 0; k < 3; k++)
                assert_true(same[k] * STEPS < 3 * SIZE * SIZE);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_have_a_ray_in_every_stratum),
        cmocka_unit_test(no_distance_brings_the_same_strata_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
