/* SPDX-License-Identifier: MIT */
/* What a material emits is in the .exr as its file says (KHR_materials_emissive_strength), on every
 * device, within half's precision of 2^-11 and far beyond half's largest number. */
#include "app/image/image.h"
#include "app/render/renderer/renderer.h"
#include "app/render/shade.h"
#include "tests/gpu/device.h"
#include "tests/program/folder.h"

#include <math.h>

#define HALF 4.8828125e-4

/* A triangle across the whole view, in the plane y = 0, black except for its emission. */
static const char triangle[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
    "\"materials\":[{\"emissiveFactor\":[1,0.3,1e-6],\"pbrMetallicRoughness\":{"
    "\"baseColorFactor\":[0,0,0,1]},\"doubleSided\":true,\"extensions\":{"
    "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":%s}}}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,"
    "\"uri\":\"data:application/octet-stream;base64,"
    "AACAwAAAAAAAAIBAAACAQAAAAAAAAIBAAAAAAAAAAAAAAIDA\"}]}";

/* Draws an image and reads it back from a .exr. */
static image draw(any_renderer *renderer, const render_frame *frame) {
    base_error error = { "" };
    image drawn, read;
    expect(renderer_draw(renderer, frame, NULL, &error), &error);
    expect(renderer_read_image(renderer, &drawn, &error), &error);
    expect(image_write(&drawn, in_folder("drawn.exr"), NULL, &error), &error);
    expect(image_read(in_folder("drawn.exr"), IMAGE_READ_PIXELS, &read, &error), &error);
    image_free(&drawn);
    return read;
}

static void expect_emission(any_renderer *renderer, const render_frame *frame, double strength) {
    const double factors[3] = { 1, 0.3, 1e-6 };
    image pixels = draw(renderer, frame);
    for (int i = 0; i < pixels.width * pixels.height; i++)
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs((double)pixels.rgb[3 * i + c] / (strength * factors[c]) - 1), HALF);
    image_free(&pixels);
}

/* With one sample per pixel values are copied, with two they are summed. */
static void expect_drawn(const scene *world, const render_device *opened, double strength) {
    base_error error = { "" };
    any_renderer *renderer = renderer_create(opened, &error);
    expect(renderer != NULL, &error);
    render_frame frame = frame_of(world, 8, 8);
    frame.camera = (scene_camera) { .eye = { 0, 1, 0 }, .up = { 0, 0, -1 }, .fov = 1 };
    frame.light_count = 0;
    for (frame.samples = 1; frame.samples <= 2; frame.samples++) {
        frame.cpu_shader = NULL;
        expect_emission(renderer, &frame, strength);
        frame.cpu_shader = shade_frame;
        expect_emission(renderer, &frame, strength);
    }
    renderer_destroy(renderer);
}

/* The image is drawn by shaders, by the library from a G-buffer, and by rays. */
static void emission_is_what_the_file_says(void **state) {
    (void)state;
    static const char *const strengths[] = { "0.02", "1", "7", "65000", "1e6", "1e18" };
    for (size_t i = 0; i < sizeof strengths / sizeof *strengths; i++) {
        char text[sizeof triangle + 16];
        scene world;
        base_error error = { "" };
        render_device gl, rays;
        snprintf(text, sizeof text, triangle, strengths[i]);
        folder_write_text("triangle.gltf", text);
        expect(scene_load(in_folder("triangle.gltf"), &(scene_options) { .no_cache = true }, &world,
                          &error),
               &error);
        render_device_adopt(&device, &world, &gl);
        expect_drawn(&world, &gl, strtod(strengths[i], NULL));
        expect(render_device_open(DEVICE_CPU, NULL, &world, &rays, &error), &error);
        expect_drawn(&world, &rays, strtod(strengths[i], NULL));
        render_device_close(&rays);
        render_device_close(&gl);
        scene_free(&world);
    }
}

static int open_both(void **state) {
    return open_device(state) || folder_make(state);
}

static int close_both(void **state) {
    return close_device(state) || folder_remove(state);
}

int main(void) {
    const struct CMUnitTest tests[] = { cmocka_unit_test(emission_is_what_the_file_says) };
    return cmocka_run_group_tests(tests, open_both, close_both);
}
