/* SPDX-License-Identifier: MIT */
/* Seven by seven balls, roughness by metallic, as `render` draws them and as the ground truth has
 * them. LAMPION_IMAGES=FOLDER keeps both images there. */
#include "app/render/gl/gpu.h"
#include "app/render/shade.h"
#include "app/truth/reference.h"
#include "tests/oracle/check.h"
#include "tests/oracle/placed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 7, BALLS = SIDE * SIDE, RINGS = 32, STEPS = 64, CELL = 24, SIZE = SIDE * CELL };
enum { VERTICES = (RINGS + 1) * (STEPS + 1), INDICES = 6 * RINGS * STEPS };

typedef struct rack {
    scene_vertex vertices[BALLS * VERTICES];
    uint32_t indices[BALLS * INDICES];
    scene_mesh meshes[BALLS];
    scene_material materials[BALLS];
    scene_light lights[3];
    scene world;
} rack;

static rack balls;

static void lay_ball(int i) {
    const float x = (float)(i % SIDE) - SIDE / 2, y = (float)(SIDE / 2) - (float)(i / SIDE);
    scene_vertex *vertex = balls.vertices + i * VERTICES;
    uint32_t *index = balls.indices + i * INDICES;
    for (int r = 0; r <= RINGS; r++)
        for (int s = 0; s <= STEPS; s++) {
            const double to = 3.14159265358979 * r / RINGS, phi = 6.28318530717959 * s / STEPS;
            const float n[3] = { (float)(sin(to) * cos(phi)), (float)cos(to),
                                 (float)(-sin(to) * sin(phi)) };
            vertex[r * (STEPS + 1) + s] =
                (scene_vertex) { .position = { x + 0.46f * n[0], y + 0.46f * n[1], 0.46f * n[2] },
                                 .normal = { n[0], n[1], n[2] },
                                 .tangent = { 1, 0, 0, 1 } };
        }
    for (int r = 0; r < RINGS; r++)
        for (int s = 0; s < STEPS; s++) {
            const uint32_t first = (uint32_t)(i * VERTICES + r * (STEPS + 1) + s);
            const uint32_t below = first + STEPS + 1;
            const uint32_t corners[6] = { first, below, below + 1, first, below + 1, first + 1 };
            memcpy(index + 6 * (r * STEPS + s), corners, sizeof corners);
        }
    balls.meshes[i] = (scene_mesh) { .first_index = (uint32_t)(i * INDICES),
                                     .index_count = INDICES,
                                     .material = (uint32_t)i,
                                     .minimum = { x - 0.5f, y - 0.5f, -0.5f },
                                     .maximum = { x + 0.5f, y + 0.5f, 0.5f } };
    static const float color[3] = { 0.9f, 0.6f, 0.2f };
    scene_material *material = &balls.materials[i];
    *material = scene_material_plain();
    memcpy(material->base_color, color, sizeof color);
    material->metallic = (float)(i / SIDE) / (SIDE - 1);
    material->roughness = 0.25f + 0.75f * (float)(i % SIDE) / (SIDE - 1);
}

static void lay_balls(void) {
    static const lmp_light lamps[3] = {
        { .position = { -6, 6, 8 }, .radius = 1.5f, .radiance = { 20, 20, 20 } },
        { .position = { 8, 1, 3 }, .radius = 1, .radiance = { 10, 14, 20 } },
        { .position = { 1, -8, -2 }, .radius = 2, .radiance = { 8, 4, 2 } },
    };
    for (int i = 0; i < BALLS; i++)
        lay_ball(i);
    for (int i = 0; i < 3; i++)
        balls.lights[i] = (scene_light) { .emitter = lamps[i], .hidden = 1 };
    balls.world = (scene) { .vertices = balls.vertices,
                            .indices = balls.indices,
                            .meshes = balls.meshes,
                            .instances = placed_meshes(BALLS),
                            .materials = balls.materials,
                            .vertex_count = BALLS * VERTICES,
                            .index_count = BALLS * INDICES,
                            .mesh_count = BALLS,
                            .instance_count = BALLS,
                            .material_count = BALLS,
                            .lights = balls.lights,
                            .light_count = 3,
                            .minimum = { -4, -4, -1 },
                            .maximum = { 4, 4, 1 },
                            .name = "balls" };
}

static image draw(const scene_camera *camera) {
    gpu_context context;
    base_error error;
    image drawn;
    const render_frame frame = { .width = SIZE,
                                 .height = SIZE,
                                 .camera = *camera,
                                 .bands = LMP_BANDS_MAX,
                                 .lights = balls.lights,
                                 .light_count = 3,
                                 .cpu_shader = shade_frame };
    assert_true(gpu_context_create(check_gl_device(), &context, &error));
    gpu_renderer *renderer = gpu_renderer_create(&context, &balls.world, &error);
    assert_non_null(renderer);
    assert_true(gpu_render(renderer, &frame, NULL, &error));
    assert_true(gpu_read_image(renderer, &drawn, &error));
    gpu_renderer_destroy(renderer);
    gpu_context_destroy(&context);
    return drawn;
}

static void keep(const image *pixels, const char *name, float exposure) {
    base_error error;
    char path[512];
    if (!getenv("LAMPION_IMAGES"))
        return;
    snprintf(path, sizeof path, "%s/%s.png", getenv("LAMPION_IMAGES"), name);
    assert_true(image_write(pixels, path, &(image_display) { .exposure = exposure }, &error));
}

/* Returns the rms error of a ball relative to its brightest pixel, beyond what noise explains,
 * where both images show a ball; outlines are another test's concern. */
static double error_of_ball(int i, const image *drawn, const image *truth, const image *noise) {
    double squares = 0, variance = 0, peak = 0;
    int count = 0;
    for (int y = 0; y < CELL; y++)
        for (int x = 0; x < CELL; x++) {
            const size_t pixel = (size_t)((i / SIDE * CELL + y) * SIZE + i % SIDE * CELL + x) * 3;
            if (hypot(x - (CELL - 1) / 2.0, y - (CELL - 1) / 2.0) > 0.4 * CELL)
                continue;
            for (size_t c = 0; c < 3; c++) {
                const double d = (double)drawn->rgb[pixel + c] - (double)truth->rgb[pixel + c];
                squares += d * d;
                variance += (double)noise->rgb[pixel + c] * (double)noise->rgb[pixel + c];
                peak = fmax(peak, (double)truth->rgb[pixel + c]);
                count++;
            }
        }
    return sqrt(fmax(squares - variance, 0) / count) / peak;
}

static void balls_are_drawn_as_the_ground_truth_has_them(void **state) {
    (void)state;
    image truth, noise;
    base_error error;
    reference_settings settings = {
        .width = SIZE,
        .height = SIZE,
        .camera = { .eye = { 0, 0, 40 }, .up = { 0, 1, 0 }, .fov = 2 * atanf(SIDE / 80.0f) },
        .samples = check_count(512, 4096),
        .seed = 1,
    };
    lay_balls();
    assert_true(reference_render(&balls.world, &settings, &truth, &noise, &error));
    image drawn = draw(&settings.camera);
    keep(&truth, "truth", image_auto_exposure(&truth));
    keep(&drawn, "drawn", image_auto_exposure(&truth));
    for (int i = 0; i < BALLS; i++) {
        const double rms = error_of_ball(i, &drawn, &truth, &noise);
        print_message("%s%.4f%s", i % SIDE ? " " : "| ", rms, i % SIDE == SIDE - 1 ? " |\n" : " |");
        CHECK_WITHIN(rms, 0.01);
    }
    image_free(&drawn);
    image_free(&truth);
    image_free(&noise);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_are_drawn_as_the_ground_truth_has_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
