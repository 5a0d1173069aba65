/* SPDX-License-Identifier: MIT */
/* Rays to lights: where they end, how they are spread, and what they bring. */
#include "app/shadow/source.h"
#include "tests/oracle/check.h"

#include <math.h>

static const lmp_vec3 origin = { 0, 0, 0 };

static shadow_source source_of(const scene_light *light) {
    shadow_source sources[SHADOW_SOURCES(1)];
    assert_int_equal(shadow_sources_make(light, 1, NULL, sources), 1);
    return sources[0];
}

static double dot(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Of a sphere as a point sees it, from outside its near side and from inside its far one. */
static void rays_to_a_sphere_end_on_it(void **state) {
    (void)state;
    for (int i = 0; i < 400; i++) {
        const lmp_vec3 d = check_random_direction();
        const float away = (float)check_random_between(0.05, 6), r = i % 2 ? 1 : 0.25f;
        const scene_light light = { .emitter = { .position = { away * d.x, away * d.y, away * d.z },
                                                 .radius = r,
                                                 .radiance = { 1, 2, 3 } } };
        const shadow_source source = source_of(&light);
        for (int k = 0; k < 20; k++) {
            const shadow_sample s =
                shadow_source_draw(&source, origin, (float)check_random(), (float)check_random());
            const double length = (double)s.length, along = dot(d, s.direction);
            const double from_middle = sqrt(fmax(
                length * length - 2 * length * (double)away * along + (double)away * (double)away,
                0));
            CHECK_WITHIN(fabs(dot(s.direction, s.direction) - 1), 1e-5);
            CHECK_WITHIN(fabs(from_middle / (double)r - 1), 2e-3);
            if (away > r)
                CHECK_WITHIN(length, (double)away);
        }
    }
}

/* The mean of what rays bring, by the cosine with the light's middle, is the irradiance there: pi L
 * sin²a of a sphere and of a cap, I/d² of a point, E of a direction, pi L of a sky. */
static void rays_bring_the_irradiance(void **state) {
    (void)state;
    enum { STEPS = 64 };
    const lmp_vec3 to = { 0.48f, 0.6f, 0.64f };
    const scene_light lights[] = {
        { .emitter = { .position = { 1.44f, 1.8f, 1.92f }, .radius = 1, .radiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_CAP,
                       .direction = to,
                       .angle = 0.4f,
                       .radiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_POINT,
                       .position = { 0.96f, 1.2f, 1.28f },
                       .intensity = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                       .direction = to,
                       .irradiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_CAP,
                       .direction = to,
                       .angle = 1.2f,
                       .radiance = { 1, 2, 4 } } },
    };
    const double pi = acos(-1),
                 expected[] = { pi / 9, pi * pow(sin(0.4), 2), 0.25, 1, pi * pow(sin(1.2), 2) };
    for (int i = 0; i < 5; i++) {
        const shadow_source source = source_of(&lights[i]);
        double sum[3] = { 0, 0, 0 }, across[3] = { 0, 0, 0 };
        for (int u = 0; u < STEPS; u++)
            for (int v = 0; v < STEPS; v++) {
                const shadow_sample s = shadow_source_draw(
                    &source, origin, ((float)u + 0.5f) / STEPS, ((float)v + 0.5f) / STEPS);
                const double cosine = dot(s.direction, to) / (STEPS * STEPS);
                for (int c = 0; c < 3; c++) {
                    sum[c] += (double)(&s.arrives.r)[c] * cosine;
                    across[c] += (double)(&s.direction.x)[c] / (STEPS * STEPS);
                }
            }
        const double size =
            sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
        for (int c = 0; c < 3; c++) {
            CHECK_WITHIN(fabs(sum[c] / (expected[i] * (1 << c)) - 1), 1e-3);
            CHECK_WITHIN(fabs(across[c] / size - (double)(&to.x)[c]), 1e-3);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_to_a_sphere_end_on_it),
        cmocka_unit_test(rays_bring_the_irradiance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
