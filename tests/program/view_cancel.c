/* SPDX-License-Identifier: MIT */
/* An image that is cancelled, whatever of it is in work: surfaces, shading, the rays of its shadows
 * or their filter. The window is answered meanwhile, and the image drawn next is the one that would
 * have been drawn first. */
#include "app/view/compositor.h"
#include "tests/program/load.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 240, HEIGHT = 180, PIXELS = WIDTH * HEIGHT, LIGHTS = 8 };
enum { BANDS = 40 }; /* more than a shader sums, so that the CPU draws */

static view_work *work;
static int limit; /* the tiles after which the image is cancelled; above all: never */
static int answers, done, all;

/* Takes events meanwhile: cancels once so many tiles are done. */
static void go_on(void *unused) {
    (void)unused;
    render_progress *progress = view_work_progress(work);
    answers++;
    do {
        done = atomic_load(&progress->done);
        all = atomic_load(&progress->all);
    } while (all > 0 && done < limit && done < all);
    if (done >= limit)
        atomic_store(&progress->cancelled, true);
}

static bool draw(view_compositor *compositor, const view_settings *settings, int index,
                 base_error *error) {
    view_statistics statistics;
    answers = done = all = 0;
    return view_compositor_draw(compositor, settings, 1, index, &statistics, error);
}

static const unsigned char *pixels_of(const view_compositor *compositor) {
    return view_compositor_images(compositor)->sides[0].rgb8;
}

static void what_is_cancelled_is_drawn_again_as_if_it_had_not_been(void **unused) {
    (void)unused;
    enum { TRIES = 24 };
    static view_settings settings;
    unsigned char *expected[2];
    base_error error = { "" };
    int cancelled = 0, in_shadows = 0;
    scene world = load("builtin:atrium");
    assert_true(scene_add_random_lights(&world, LIGHTS, 1, &error));
    strcpy(settings.environment.name, "none");
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.samples = 2;
    settings.exposure = 1;
    settings.shadows = true;
    settings.camera = scene_default_camera(&world, view_aspect(&settings));
    settings.shading[0] = (view_shading) { METHOD_ZONAL, BANDS, LMP_WINDOW_NONE };
    settings.light_count = world.light_count < LIGHTS ? world.light_count : LIGHTS;
    memcpy(settings.lights, world.lights, settings.light_count * sizeof *settings.lights);
    work = view_work_begin(go_on, NULL, &error);
    assert_non_null(work);
    view_compositor *compositor = view_compositor_create(NULL, &world, NULL, work, &error);
    assert_non_null(compositor);
    limit = INT32_MAX;
    for (int index = 0; index < 2; index++) {
        assert_true(draw(compositor, &settings, index, &error));
        expected[index] = malloc(3 * PIXELS);
        memcpy(expected[index], pixels_of(compositor), 3 * PIXELS);
    }
    const int tiles = all;
    assert_true(tiles > 0);
    for (int i = 0; i < TRIES; i++) {
        const int index = i % 2; /* the first sample, and one that refines it */
        limit = INT32_MAX;
        assert_true(index == 0 || draw(compositor, &settings, 0, &error));
        limit = 1 + i * tiles / TRIES;
        if (!draw(compositor, &settings, index, &error)) {
            assert_true(answers > 0);
            assert_non_null(strstr(error.text, "cancelled"));
            cancelled++;
            in_shadows += done > all / 2; /* surfaces and shading come first */
            limit = INT32_MAX;
            assert_true(draw(compositor, &settings, index, &error));
        }
        assert_memory_equal(expected[index], pixels_of(compositor), 3 * PIXELS);
    }
    print_message("%d of %d were cancelled, %d of them in shadows\n", cancelled, TRIES, in_shadows);
    assert_true(cancelled > TRIES / 2 && in_shadows > TRIES / 8);
    free(expected[0]);
    free(expected[1]);
    view_compositor_destroy(compositor);
    view_work_end(work);
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = { cmocka_unit_test(
        what_is_cancelled_is_drawn_again_as_if_it_had_not_been) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
