/* SPDX-License-Identifier: MIT */
/* The picture that the GPU shades against the ground truth of the same cut lobes. */
#include "app/gpu/gpu.h"
#include "app/reference/reference.h"
#include "tests/oracle/check.h"

#include <math.h>

enum { WIDTH = 120, HEIGHT = 80 };

static image draw_by_harmonics(const scene *world, const reference_settings *settings) {
    gpu_context context;
    cli_error error;
    image picture;
    const gpu_frame frame = { .width = WIDTH,
                              .height = HEIGHT,
                              .camera = settings->camera,
                              .bands = settings->cut.bands,
                              .window = settings->cut.window,
                              .lights = world->lights,
                              .light_count = world->light_count };
    assert_true(gpu_context_create("software", &context, &error));
    gpu_renderer *renderer = gpu_renderer_create(&context, world, &error);
    assert_non_null(renderer);
    assert_true(gpu_render(renderer, &frame, NULL, &error));
    assert_true(gpu_read_image(renderer, &picture, &error));
    gpu_renderer_destroy(renderer);
    gpu_context_destroy(&context);
    return picture;
}

/* How many pixels differ by more than 4 standard errors and one step of 8 bits. */
static int count_different(const image *picture, const image *truth, const image *standard_error) {
    const double exposure = (double)image_auto_exposure(truth);
    int different = 0;
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        bool differs = false;
        for (int i = 3 * p; i < 3 * p + 3; i++) {
            const double d = fabs((double)picture->rgb[i] - (double)truth->rgb[i]);
            differs =
                differs || !((d - 4 * (double)standard_error->rgb[i]) * exposure <= 1.0 / 255);
        }
        different += differs;
    }
    return different;
}

static void check_scene(const char *name, int lights, const reference_cut *cut) {
    scene world;
    cli_error error;
    image truth, standard_error;
    reference_settings settings = {
        .width = WIDTH, .height = HEIGHT, .samples = 256, .seed = 1, .cut = *cut
    };
    const scene_lights_options random = { .random_count = lights, .seed = 1 };
    assert_true(scene_load(name, &(scene_options) { .no_cache = true }, &world, &error));
    assert_true(scene_apply_lights(&world, &random, &error));
    settings.camera = scene_default_camera(&world, (float)WIDTH / HEIGHT);
    assert_true(reference_render(&world, &settings, &truth, &standard_error, &error));
    image picture = draw_by_harmonics(&world, &settings);
    /* Edges: rasteriser and ray may choose different triangles for a pixel's centre. */
    assert_in_range(count_different(&picture, &truth, &standard_error), 0, WIDTH * HEIGHT / 250);
    image_free(&picture);
    image_free(&truth);
    image_free(&standard_error);
    scene_free(&world);
}

static void cut_lobes_render_as_the_ground_truth_of_balls(void **state) {
    (void)state;
    check_scene("builtin:balls", 0, &(reference_cut) { 8, LMP_WINDOW_NONE, 0 });
}

static void cut_lobes_render_as_the_ground_truth_of_the_atrium(void **state) {
    (void)state;
    check_scene("builtin:atrium", 30, &(reference_cut) { 5, LMP_WINDOW_HANNING, 0 });
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_lobes_render_as_the_ground_truth_of_balls),
        cmocka_unit_test(cut_lobes_render_as_the_ground_truth_of_the_atrium),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
