/* SPDX-License-Identifier: MIT */
/* Textures that show one image by several samplers: uploaded once, and each as its sampler says. */
#include "tests/gpu/device.h"
#include "tests/gpu/sheets.h"

#include <epoxy/gl.h>

/* Returns the color that sheet 0 shows with texture number t at a given u. */
static lmp_rgb color_at(int t, float u) {
    scene_texture_use *use = &sheet.materials[0].base_color_map;
    *use = (scene_texture_use) { .texture = t, .offset = { u, 0.5f } };
    gpu_renderer *renderer = open_renderer(&sheet.world);
    render_frame frame = look_at(&sheet.world, 0, 1);
    render_pixel *pixels = render_pixels(renderer, &frame);
    const render_pixel center = pixels[SIDE / 2 * SIDE + SIDE / 2];
    free(pixels);
    gpu_renderer_destroy(renderer);
    return center.material.base_color;
}

static int count_textures(void) {
    int count = 0;
    for (GLuint name = 1; name < 4096; name++)
        count += glIsTexture(name);
    return count;
}

/* The texture is red on the left and green on the right: beyond the right edge samplers differ. */
static void samplers_share_their_image(void **state) {
    (void)state;
    static const bool red[][2] = { [SCENE_WRAP_REPEAT] = { true, false },
                                   [SCENE_WRAP_CLAMP] = { false, false },
                                   [SCENE_WRAP_MIRROR] = { false, true } };
    scene *world = make_sheets();
    scene_texture textures[18];
    for (uint32_t i = 0; i < 18; i++) {
        textures[i] = sheet.textures[0];
        textures[i].wrap_u = i % 3;
        textures[i].wrap_v = i / 3 % 3;
        textures[i].srgb = i / 9;
    }
    world->textures = textures;
    world->texture_count = 1;
    sheet.materials[2].normal_map.texture = -1;
    const int none = count_textures();
    gpu_renderer *renderer = open_renderer(world);
    const int one = count_textures() - none;
    gpu_renderer_destroy(renderer);
    assert_int_equal(count_textures(), none);
    world->texture_count = 18;
    renderer = open_renderer(world);
    assert_int_equal(count_textures() - none, one + 1); /* linear and sRGB */
    gpu_renderer_destroy(renderer);
    for (int i = 0; i < 18; i++)
        for (int k = 0; k < 2; k++) {
            const lmp_rgb found = color_at(i, k ? 1.75f : 1.25f);
            assert_true(red[i % 3][k] ? found.r > 0.9f && found.g < 0.1f
                                      : found.r < 0.1f && found.g > 0.9f);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = { cmocka_unit_test(samplers_share_their_image) };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
