/* SPDX-License-Identifier: MIT */
/* What is drawn where: light spheres, sides of sheets, materials, and errors of OpenGL. */
#include "tests/gpu/device.h"
#include "tests/gpu/sheets.h"

#include <epoxy/gl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static render_pixel pixel_at(gpu_renderer *renderer, const render_frame *frame, int x, int y) {
    render_pixel *pixels = render_pixels(renderer, frame);
    const render_pixel pixel = pixels[y * SIDE + x];
    free(pixels);
    return pixel;
}

static void positions_and_sides_are_where_the_camera_says(void **state) {
    (void)state;
    const scene *world = make_sheets();
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    /* column 47 is 15.5 pixels right of the middle: x = 15.5/16; row 16 is as far above it */
    const render_pixel front = pixel_at(renderer, &frame, 47, 16);
    assert_int_equal(front.kind, RENDER_SURFACE);
    assert_true(fabsf(front.surface.position.x - 15.5f / 16) <= 1e-5f);
    assert_true(fabsf(front.surface.position.y - 15.5f / 16) <= 1e-5f);
    assert_true(fabsf(front.surface.position.z) <= 1e-5f);
    assert_true(front.surface.normal.z >= 0.9999f);
    assert_int_equal(pixel_at(renderer, &frame, 49, 32).kind, RENDER_NONE);

    frame = look_at(world, 0, -1);
    const render_pixel back = pixel_at(renderer, &frame, 32, 32);
    assert_int_equal(back.kind, RENDER_SURFACE);
    assert_true(back.surface.normal.z <= -0.9999f);
    frame = look_at(world, 3, -1); /* a sheet with one side */
    assert_int_equal(pixel_at(renderer, &frame, 32, 32).kind, RENDER_NONE);
    gpu_renderer_destroy(renderer);
}

/* What is unlit glows by the colors of its vertices, too. */
static void vertices_color_what_is_unlit(void **state) {
    (void)state;
    const scene *world = make_sheets();
    for (int i = 0; i < 4; i++)
        memcpy(sheet.vertices[i].color, (const uint16_t[4]) { 65535, 32768, 0, 65535 },
               sizeof sheet.vertices[i].color);
    sheet.materials[0].flags |= SCENE_UNLIT | SCENE_VERTEX_COLORS;
    for (int c = 0; c < 3; c++)
        sheet.materials[0].emission[c] = 0.5f;
    gpu_renderer *renderer = open_renderer(world);
    const render_frame frame = look_at(world, 0, 1);
    const lmp_rgb seen = pixel_at(renderer, &frame, 32, 32).emission;
    assert_true(fabsf(seen.r - 0.5f) <= 1e-3f && fabsf(seen.g - 0.25f) <= 1e-3f && seen.b == 0);
    gpu_renderer_destroy(renderer);
}

/* Parallel rays show 8 pixels per unit at any distance, of a light too. */
static void parallel_rays_see_the_same_from_everywhere(void **state) {
    (void)state;
    const scene *world = make_sheets();
    sheet.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 3, -50 }, .radius = 0.5f, .radiance = { 1, 2, 3 } }
    };
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    frame.camera.height = 8;
    frame.light_count = 1;
    for (int distance = 1; distance <= 1000; distance *= 10) {
        frame.camera.eye[2] = (float)distance;
        const render_pixel corner = pixel_at(renderer, &frame, 39, 24);
        assert_int_equal(corner.kind, RENDER_SURFACE);
        assert_true(fabsf(corner.surface.position.x - 7.5f / 8) <= 1e-5f);
        assert_true(fabsf(corner.surface.position.y - 7.5f / 8) <= 1e-5f);
        assert_true(fabsf(corner.surface.position.z) <= 1e-6f * (float)distance);
        assert_true(corner.surface.view.z == 1);
        assert_int_equal(pixel_at(renderer, &frame, 40, 32).kind, RENDER_NONE);
        for (int row = 0; row < SIDE / 4; row++) /* 24 pixels above the middle, 4 of radius */
            assert_int_equal(pixel_at(renderer, &frame, 32, row).kind,
                             row >= 4 && row < 12 ? RENDER_LIGHT : RENDER_NONE);
    }
    gpu_renderer_destroy(renderer);
}

static void masks_cut_and_normal_maps_bend(void **state) {
    (void)state;
    const scene *world = make_sheets();
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 1, 1);
    const render_pixel red = pixel_at(renderer, &frame, 20, 32);
    assert_int_equal(red.kind, RENDER_SURFACE);
    assert_true(red.material.base_color.r == 1 && red.material.base_color.g == 0);
    assert_int_equal(pixel_at(renderer, &frame, 44, 32).kind, RENDER_NONE);
    frame = look_at(world, 2, 1);
    const render_pixel bent = pixel_at(renderer, &frame, 32, 32);
    assert_true(fabsf(bent.surface.normal.x - 0.6f) <= 0.01f);
    assert_true(fabsf(bent.surface.normal.z - 0.8f) <= 0.01f);
    gpu_renderer_destroy(renderer);
}

static void materials_are_those_of_the_library(void **state) {
    (void)state;
    const scene *world = make_sheets();
    const float roughness[MATERIALS] = { 1, 0.2004f, 0.1005f, 0 };
    const float metallic[MATERIALS] = { 0, 0.2f, 0.6003f, 1 };
    for (int i = 0; i < MATERIALS; i++) {
        sheet.materials[i].roughness = roughness[i];
        sheet.materials[i].metallic = metallic[i];
        sheet.materials[i].base_color_map.texture = -1;
        sheet.materials[i].base_color[2] = 0;
    }
    gpu_renderer *renderer = open_renderer(world);
    for (int i = 0; i < MATERIALS; i++) {
        const render_frame frame = look_at(world, i, 1);
        const render_pixel p = pixel_at(renderer, &frame, 32, 32);
        assert_int_equal(p.material.kind, LMP_MATERIAL_METALLIC_ROUGHNESS);
        assert_true(fabsf(p.material.base_color.r - 1) <= 1e-6f);
        assert_true(fabsf(p.material.base_color.b) <= 1e-6f);
        assert_true(fabsf(p.material.metallic - metallic[i]) <= 1e-5f);
        assert_true(fabsf(p.material.roughness - roughness[i]) <= 1e-5f);
        assert_true(p.emission.g == sheet.materials[i].emission[1]);
    }
    gpu_renderer_destroy(renderer);
}

/* --- glowing spheres -------------------------------------------------------------------------- */

/* Whether a pixel's center lies on the sphere, off it, or so near the outline (0) that rounding
 * decides. */
static int side_of_outline(const render_frame *frame, const scene_light *light, int x, int y) {
    const double step = 2.0 * tan(0.5 * (double)frame->camera.fov) / SIDE;
    const double ray[3] = { (x + 0.5 - SIDE / 2) * step, -(y + 0.5 - SIDE / 2) * step, -1 };
    double along = 0, length2 = 0, center2 = 0;
    for (int i = 0; i < 3; i++) {
        const double c = (double)(&light->emitter.position.x)[i] - (double)frame->camera.eye[i];
        along += ray[i] * c;
        length2 += ray[i] * ray[i];
        center2 += c * c;
    }
    const double miss2 = center2 - along * along / length2;
    const double r2 = (double)light->emitter.radius * (double)light->emitter.radius;
    return fabs(miss2 - r2) < 1e-4 * r2 ? 0 : miss2 < r2 ? 1 : -1;
}

static void light_spheres_are_exact_and_hide_what_is_behind(void **state) {
    (void)state;
    const scene *world = make_sheets();
    /* A light of which half sticks out of the sheet's front. */
    sheet.lights[0] = (scene_light) {
        .emitter = { .position = { 0.2f, 0.1f, 0 }, .radius = 0.6f, .radiance = { 5, 1e9f, 1e-9f } }
    };
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    frame.light_count = 1;
    render_pixel *pixels = render_pixels(renderer, &frame);
    int on = 0;
    for (int i = 0; i < PIXELS; i++) {
        const int side = side_of_outline(&frame, &sheet.lights[0], i % SIDE, i / SIDE);
        if (side == 0)
            continue;
        on += side > 0;
        assert_int_equal(pixels[i].kind == RENDER_LIGHT, side > 0);
        if (side > 0) /* the radiance itself, not what a G-buffer's format keeps of it */
            assert_true(pixels[i].emission.r == 5 && pixels[i].emission.g == 1e9f &&
                        pixels[i].emission.b == 1e-9f);
    }
    assert_true(on > 100);
    free(pixels);

    sheet.lights[0].emitter.position.z = -2; /* behind the sheet */
    assert_int_equal(pixel_at(renderer, &frame, 33, 31).kind, RENDER_SURFACE);
    sheet.lights[0].emitter.position.z = 2;
    assert_int_equal(pixel_at(renderer, &frame, 33, 31).kind, RENDER_LIGHT);
    sheet.lights[0].hidden = 1;
    assert_int_equal(pixel_at(renderer, &frame, 33, 31).kind, RENDER_SURFACE);
    gpu_renderer_destroy(renderer);
}

static void a_camera_inside_a_light_sees_it_all_round(void **state) {
    (void)state;
    const scene *world = make_sheets();
    sheet.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 0, 3 }, .radius = 1, .radiance = { 1, 2, 3 } }
    };
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    frame.light_count = 1;
    render_pixel *pixels = render_pixels(renderer, &frame);
    for (int i = 0; i < PIXELS; i++)
        assert_int_equal(pixels[i].kind, RENDER_LIGHT);
    free(pixels);
    gpu_renderer_destroy(renderer);
}

/* --- images ----------------------------------------------------------------------------------- */

static void samples_cover_a_pixel_in_part(void **state) {
    (void)state;
    const scene *world = make_sheets();
    for (int i = 0; i < MATERIALS; i++)
        sheet.materials[i].emission[0] = 1;
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    frame.camera.eye[0] = frame.camera.target[0] = 0.5f / 16; /* the edges halve pixels */
    frame.samples = 64;
    image pixels = render_image(renderer, &frame);
    const float *row = pixels.rgb + 3 * SIDE * 32;
    assert_true(row[3 * 32] == 1 && row[3 * 60] == 0);
    assert_true(fabsf(row[3 * 47] - 0.5f) <= 0.05f);
    image_free(&pixels);
    gpu_renderer_destroy(renderer);
}

static void the_device_and_the_cpu_tone_map_alike(void **state) {
    (void)state;
    static unsigned char on_device[3 * PIXELS], on_cpu[3 * PIXELS];
    base_error error = { "" };
    const scene *world = make_sheets();
    sheet.lights[0] = (scene_light) {
        .emitter = { .position = { 0.5f, 0.5f, 1 }, .radius = 0.3f, .radiance = { 5, 40, 0.2f } }
    };
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    frame.light_count = 1;
    image pixels = render_image(renderer, &frame);
    for (int tone = 0; image_tones[tone].name; tone++)
        for (int power = -2; power < 8; power++) {
            const image_display display = { .exposure = powf(10, (float)power), .tone = tone };
            expect(gpu_read_rgb8(renderer, &display, on_device, NULL, &error), &error);
            image_tone_map(&pixels, &display, on_cpu);
            for (size_t i = 0; i < 3 * PIXELS; i++)
                assert_true(abs(on_device[i] - on_cpu[i]) <= 1);
        }
    image_free(&pixels);
    gpu_renderer_destroy(renderer);
}

/* The sheet fills pixels 16 to 47 of each side: its edges in 8 bits, on each path to them. */
static void eight_bit_images_are_where_the_camera_says(void **state) {
    (void)state;
    static unsigned char rgb8[3 * PIXELS];
    base_error error = { "" };
    const scene *world = make_sheets();
    sheet.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 0, 50 }, .radius = 0.1f, .radiance = { 1e6f, 1e6f, 1e6f } }
    };
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    frame.light_count = 1;
    for (int m = 0; m < METHODS_TIMED; m++) {
        frame.method = (method_kind)m;
        if (method_table[m].reads & (METHOD_READS_PREINTEGRATED | METHOD_READS_FIELD))
            continue; /* needs lobes, or a field */
        expect(gpu_render(renderer, &frame, NULL, &error), &error);
        expect(gpu_read_rgb8(renderer, &(image_display) { .exposure = 1 }, rgb8, NULL, &error),
               &error);
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                const bool sheet_there = x >= 16 && x < 48 && y >= 16 && y < 48;
                if ((rgb8[3 * (SIDE * y + x)] > 0) != sheet_there)
                    fail_msg("method %d, pixel %d, %d", m, x, y);
            }
    }
    gpu_renderer_destroy(renderer);
}

/* --- refusals --------------------------------------------------------------------------------- */

static void impossible_frames_are_refused_with_a_reason(void **state) {
    (void)state;
    const scene *world = make_sheets();
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    base_error error = { "" };
    frame.width = GPU_SIZE_MAX + 1;
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_non_null(strstr(error.text, "beyond"));
    frame.width = SIDE;
    frame.bands = METHOD_GPU_BANDS_MAX + 1;
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_non_null(strstr(error.text, "bands"));
    frame.bands = 3;
    memcpy(frame.camera.target, frame.camera.eye, sizeof frame.camera.eye);
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_non_null(strstr(error.text, "camera"));
    gpu_renderer_destroy(renderer);
}

/* Each shader takes as many bands as its row says, and no more. */
static void bands_up_to_the_limit_of_a_method_are_drawn(void **state) {
    (void)state;
    const scene *world = make_sheets();
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = look_at(world, 0, 1);
    for (int m = 0; m < METHODS; m++) {
        base_error error = { "" };
        if (!draws_alone(m))
            continue;
        char limit[32];
        frame.method = (method_kind)m;
        frame.bands = method_table[m].bands_max[DEVICE_GPU];
        snprintf(limit, sizeof limit, "1 to %d", frame.bands);
        expect(gpu_render(renderer, &frame, NULL, &error), &error);
        frame.bands++;
        assert_false(gpu_render(renderer, &frame, NULL, &error));
        assert_non_null(strstr(error.text, limit));
    }
    gpu_renderer_destroy(renderer);
}

static void unknown_devices_are_refused_with_what_was_found(void **state) {
    (void)state;
    base_error error = { "" };
    gpu_context context;
    assert_false(gpu_context_create("99", &context, &error));
    assert_non_null(strstr(error.text, "no such OpenGL device"));
    assert_false(gpu_context_create("no such name", &context, &error));
    assert_non_null(strstr(error.text, "found"));
}

static void complaints_of_opengl_are_fatal_here(void **state) {
    (void)state;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        gpu_context context;
        base_error error = { "" };
        signal(SIGABRT, SIG_DFL);
        close(STDERR_FILENO);
        if (gpu_context_create(getenv("LAMPION_TEST_GL_DEVICE"), &context, &error))
            glEnable(0xdead);
        _exit(0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}

int main(void) {
    /* the forking test comes first, before this process has threads of a driver */
    setenv("LAMPION_GL_DEBUG", "fatal", 1);
    const struct CMUnitTest alone[] = { cmocka_unit_test(complaints_of_opengl_are_fatal_here),
                                        cmocka_unit_test(
                                            unknown_devices_are_refused_with_what_was_found) };
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_and_sides_are_where_the_camera_says),
        cmocka_unit_test(vertices_color_what_is_unlit),
        cmocka_unit_test(parallel_rays_see_the_same_from_everywhere),
        cmocka_unit_test(masks_cut_and_normal_maps_bend),
        cmocka_unit_test(materials_are_those_of_the_library),
        cmocka_unit_test(light_spheres_are_exact_and_hide_what_is_behind),
        cmocka_unit_test(a_camera_inside_a_light_sees_it_all_round),
        cmocka_unit_test(samples_cover_a_pixel_in_part),
        cmocka_unit_test(the_device_and_the_cpu_tone_map_alike),
        cmocka_unit_test(eight_bit_images_are_where_the_camera_says),
        cmocka_unit_test(bands_up_to_the_limit_of_a_method_are_drawn),
        cmocka_unit_test(impossible_frames_are_refused_with_a_reason),
    };
    return cmocka_run_group_tests(alone, NULL, NULL) +
           cmocka_run_group_tests(tests, open_device, close_device);
}
