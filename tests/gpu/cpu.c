/* SPDX-License-Identifier: MIT */
/* Images of the CPU's device beside OpenGL's: rays and a G-buffer find the same surfaces, but for a
 * few pixels at edges, which are counted. */
#include "app/render/renderer/renderer.h"

#include "tests/gpu/device.h"

#include <math.h>

enum { WIDTH = 480, HEIGHT = 270, PIXELS = WIDTH * HEIGHT };

/* Whether a pixel sees another surface than its neighbor, or one whose normal differs. */
static bool differ(const render_pixel *a, const render_pixel *b) {
    const lmp_vec3 p = a->surface.normal, q = b->surface.normal;
    const lmp_rgb c = a->material.base_color, d = b->material.base_color;
    return a->kind != b->kind ||
           (a->kind == RENDER_SURFACE &&
            (p.x * q.x + p.y * q.y + p.z * q.z < 0.97f ||
             fabsf(c.r - d.r) + fabsf(c.g - d.g) + fabsf(c.b - d.b) > 0.02f)) ||
           (a->kind == RENDER_LIGHT && fabsf(a->emission.r - b->emission.r) > 0);
}

static bool is_edge(const render_pixel *pixels, int x, int y) {
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < HEIGHT; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < WIDTH; i++)
            if (differ(&pixels[y * WIDTH + x], &pixels[j * WIDTH + i]))
                return true;
    return false;
}

/* Expects the images to agree within some decibels where both show the same surface away from
 * edges. Hardware interpolates between corners that it has moved by up to half of 1/256 of a pixel,
 * and is allowed `less` decibels. */
static void expect_alike(const char *name, int samples, double decibels, double less) {
    static unsigned char shown[2][3 * PIXELS];
    base_error error = { "" };
    scene world;
    expect(scene_load(name, &(scene_options) { .no_cache = true }, &world, &error), &error);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    const image_display display = { .exposure = 1 };
    render_device cpu;
    gpu_renderer *gl = open_renderer(&world);
    expect(render_device_open(DEVICE_CPU, NULL, &world, &cpu, &error), &error);
    any_renderer *rays = renderer_create(&cpu, &error);
    expect(rays != NULL, &error);
    render_pixel *pixels = render_pixels(gl, &frame);
    frame.samples = samples;
    expect(gpu_render(gl, &frame, NULL, &error), &error);
    expect(gpu_read_rgb8(gl, &display, shown[0], NULL, &error), &error);
    expect(renderer_draw(rays, &frame, NULL, &error), &error);
    expect(renderer_read_rgb8(rays, &display, shown[1], NULL, &error), &error);
    double squares = 0;
    int edges = 0, inner = 0;
    for (int i = 0; i < PIXELS; i++) {
        if (is_edge(pixels, i % WIDTH, i / WIDTH)) {
            edges++;
            continue;
        }
        inner++;
        for (int c = 0; c < 3; c++) {
            const double d = (double)shown[0][3 * i + c] - shown[1][3 * i + c];
            squares += d * d;
        }
    }
    const double found = 10 * log10(255 * 255 / fmax(squares / (3.0 * inner), 1e-9));
    print_message("%s, %d samples: %.1f dB, without %d pixels of edges of %d\n", name, samples,
                  found, edges, PIXELS);
    assert_true(inner > PIXELS / 4);
    CHECK_WITHIN(device.software ? decibels : decibels - less, found);
    free(pixels);
    renderer_destroy(rays);
    render_device_close(&cpu);
    gpu_renderer_destroy(gl);
    scene_free(&world);
}

static void rays_and_gbuffers_show_the_same_balls(void **state) {
    (void)state;
    expect_alike("builtin:balls", 1, 65, 5);
    expect_alike("builtin:balls", 4, 50, 0);
}

static void rays_and_gbuffers_show_the_same_atrium(void **state) {
    (void)state;
    expect_alike("builtin:atrium", 1, 65, 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_and_gbuffers_show_the_same_balls),
        cmocka_unit_test(rays_and_gbuffers_show_the_same_atrium),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
