/* SPDX-License-Identifier: MIT */
/* Rays that are sorted by their lights and traced together find what each finds alone. */
#include "app/render/shadow/batch.h"

#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

enum { LIGHTS_MAX = 70000 };

/* Aims rays from about the middle of the atrium toward one of some lights each. */
static void aim(shadow_batch *b, int lights) {
    b->count = 1 + (int)(check_random() * SHADOW_SHOTS);
    for (int k = 0; k < b->count; k++)
        for (int i = 0; i < SHADOW_LANES; i++) {
            shadow_shot *shot = &b->shots[k];
            const int light = (int)(check_random() * lights);
            const double angle = 2.4 * light;
            const double to[3] = { cos(angle) + 0.1 * check_random(), 0.3 - 0.0001 * light,
                                   sin(angle) };
            shot->source[i] = light;
            shot->rays.start[i] = 0;
            shot->rays.length[i] = check_random() < 0.2 ? -1 : (float)(20 * check_random());
            for (int c = 0; c < 3; c++) {
                shot->rays.origin[c][i] = (float)(1 + 0.5 * check_random());
                shot->rays.direction[c][i] = (float)to[c];
            }
        }
}

static void check_ray(const trace_bvh *bvh, const shadow_shot *shot, int i) {
    const float origin[3] = { shot->rays.origin[0][i], shot->rays.origin[1][i],
                              shot->rays.origin[2][i] };
    const float direction[3] = { shot->rays.direction[0][i], shot->rays.direction[1][i],
                                 shot->rays.direction[2][i] };
    const float length = shot->rays.length[i];
    const trace_hit hit = trace_nearest(bvh, TRACE_LIGHT, origin, direction);
    const float expected = length >= 0 && hit.distance <= length ? hit.distance : INFINITY;
    assert_memory_equal(&shot->distance[i], &expected, sizeof expected);
}

static void order_changes_no_distance(void **state) {
    (void)state;
    static const int lights[] = { 1, 3, 30, 256, 257, LIGHTS_MAX };
    static shadow_batch batch;
    base_error error;
    scene world;
    size_t hidden = 0;
    if (!scene_load("builtin:atrium", &(scene_options) { .no_cache = true }, &world, &error))
        fail_msg("%s", error.text);
    trace_bvh *bvh = trace_create(&world);
    assert_non_null(bvh);
    for (size_t n = 0; n < sizeof lights / sizeof *lights; n++) {
        size_t sent = 0;
        aim(&batch, lights[n]);
        batch.around = n == 1 ? 1 : -1;
        const size_t count = shadow_batch_send(&batch, bvh);
        for (int k = 0; k < batch.count; k++)
            for (int i = 0; i < SHADOW_LANES; i++) {
                check_ray(bvh, &batch.shots[k], i);
                sent += batch.shots[k].rays.length[i] >= 0;
                hidden += batch.shots[k].distance[i] < INFINITY;
            }
        assert_int_equal(count, sent);
    }
    assert_true(hidden > 100);
    trace_destroy(bvh);
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_changes_no_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
