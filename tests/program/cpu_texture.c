/* SPDX-License-Identifier: MIT */
/* The CPU's textures: levels keep the mean of what they halve, and lookups take the level that a
 * pixel's footprint asks for. */
#include "app/render/cpu/texture.h"

#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 64 };

typedef struct sample_scene {
    scene world;
    scene_texture texture;
    unsigned char texels[4 * SIDE_MAX * SIDE_MAX];
} sample_scene;

static const scene_texture_use whole = { .texture = 0, .matrix = { 1, 0, 0, 1 } };

static void set_scene(sample_scene *s, uint32_t width, uint32_t height, bool srgb) {
    s->texture = (scene_texture) { .width = width, .height = height, .srgb = srgb };
    s->world = (scene) { .textures = &s->texture,
                         .texels = s->texels,
                         .texture_count = 1,
                         .texel_bytes = 4 * (size_t)width * height };
}

/* Looks up u, v for a pixel that covers some of the texture along u and along v. */
static void look(const cpu_textures *textures, float u, float v, float across, float down,
                 float rgba[4]) {
    const cpu_footprint at = { .uv = { { u, v } },
                               .across = { { across, 0 } },
                               .down = { { 0, down } } };
    cpu_cover cover;
    cpu_texture_cover(textures, &whole, &at, &cover);
    cpu_texture_read(textures, &whole, &cover, rgba);
}

/* A texture seen as one pixel is its mean, of odd sides or even; sRGB is averaged in linear values.
 * Each level rounds to a byte. */
static void the_last_level_is_the_mean(void **state) {
    (void)state;
    static const uint32_t sizes[][2] = { { 64, 64 }, { 63, 63 }, { 37, 12 }, { 1, 50 }, { 5, 1 } };
    static sample_scene s;
    for (size_t n = 0; n < sizeof sizes / sizeof *sizes; n++)
        for (int srgb = 0; srgb < 2; srgb++) {
            const uint32_t width = sizes[n][0], height = sizes[n][1];
            double mean[4] = { 0 };
            set_scene(&s, width, height, srgb == 1);
            for (size_t i = 0; i < 4 * (size_t)width * height; i++) {
                s.texels[i] = (unsigned char)(64 + 180 * check_random());
                const double v = s.texels[i] / 255.0;
                const bool curved = srgb && i % 4 < 3;
                mean[i % 4] += (curved ? pow((v + 0.055) / 1.055, 2.4) : v) / (width * height);
            }
            cpu_textures *textures = cpu_textures_create(&s.world);
            assert_non_null(textures);
            float rgba[4];
            look(textures, 0.3f, 0.7f, 1, 1, rgba);
            for (int c = 0; c < 4; c++)
                CHECK_WITHIN(fabs((double)rgba[c] - mean[c]), 0.02);
            cpu_textures_destroy(textures);
        }
}

/* Makes columns that alternate between black and white. */
static cpu_textures *make_stripes(sample_scene *s) {
    set_scene(s, 64, 64, false);
    for (size_t i = 0; i < 64 * 64; i++)
        memset(s->texels + 4 * i, i % 2 ? 255 : 0, 4);
    cpu_textures *textures = cpu_textures_create(&s->world);
    assert_non_null(textures);
    return textures;
}

/* Pixels as small as a texel see the stripes, those of two texels see gray. */
static void the_footprint_chooses_the_level(void **state) {
    (void)state;
    static sample_scene s;
    cpu_textures *textures = make_stripes(&s);
    float rgba[4];
    for (int column = 0; column < 8; column++) {
        const float u = ((float)column + 0.5f) / 64;
        look(textures, u, 0.5f, 1 / 64.0f, 1 / 64.0f, rgba);
        CHECK_WITHIN(fabsf(rgba[0] - (float)(column % 2)), 1e-5);
        look(textures, u, 0.5f, 2 / 64.0f, 2 / 64.0f, rgba);
        CHECK_WITHIN(fabsf(rgba[0] - 0.5f), 0.003);
        look(textures, u, 0.5f, 1.5f / 64, 1.5f / 64, rgba); /* halfway between two levels */
        CHECK_WITHIN(fabsf(fabsf(rgba[0] - 0.5f) - 0.2075f), 0.01);
    }
    cpu_textures_destroy(textures);
}

/* One pixel is long across the stripes, the other along them: the second still sees them, as on a
 * plane at a grazing angle. */
static void long_footprints_are_sharp_across_their_length(void **state) {
    (void)state;
    static sample_scene s;
    cpu_textures *textures = make_stripes(&s);
    float rgba[4];
    look(textures, 10.5f / 64, 0.5f, 1 / 64.0f, 8 / 64.0f, rgba);
    CHECK_WITHIN(rgba[0], 1e-5);
    look(textures, 11.5f / 64, 0.5f, 1 / 64.0f, 8 / 64.0f, rgba);
    CHECK_WITHIN(1 - rgba[0], 1e-5);
    look(textures, 11.5f / 64, 0.5f, 8 / 64.0f, 1 / 64.0f, rgba);
    CHECK_WITHIN(fabsf(rgba[0] - 0.5f), 0.01);
    /* A pixel more than eight times as long as wide takes a coarser level. */
    look(textures, 11.5f / 64, 0.5f, 1 / 64.0f, 16 / 64.0f, rgba);
    CHECK_WITHIN(fabsf(rgba[0] - 0.5f), 0.01);
    cpu_textures_destroy(textures);
}

/* The left half is black and the right half white: each mode has its own neighbor of the last
 * texel. */
static void edges_follow_the_wrap_modes(void **state) {
    (void)state;
    static sample_scene s;
    static const struct {
        uint32_t mode;
        float beyond, far; /* at u = 1 + 1/8, and at u = 1 + 5/8 */
    } modes[] = { { SCENE_WRAP_REPEAT, 0, 1 },
                  { SCENE_WRAP_CLAMP, 1, 1 },
                  { SCENE_WRAP_MIRROR, 1, 0 } };
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        float rgba[4];
        set_scene(&s, 4, 4, false);
        s.texture.wrap_u = s.texture.wrap_v = modes[i].mode;
        for (size_t k = 0; k < 16; k++)
            memset(s.texels + 4 * k, k % 4 < 2 ? 0 : 255, 4);
        cpu_textures *textures = cpu_textures_create(&s.world);
        assert_non_null(textures);
        look(textures, 1.125f, 0.5f, 0, 0, rgba);
        CHECK_WITHIN(fabsf(rgba[0] - modes[i].beyond), 1e-6);
        look(textures, 1.625f, 0.5f, 0, 0, rgba);
        CHECK_WITHIN(fabsf(rgba[0] - modes[i].far), 1e-6);
        look(textures, -0.875f, 0.5f, 0, 0, rgba);
        CHECK_WITHIN(fabsf(rgba[0] - (modes[i].mode == SCENE_WRAP_MIRROR ? 1.0f : 0.0f)), 1e-6);
        cpu_textures_destroy(textures);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_level_is_the_mean),
        cmocka_unit_test(the_footprint_chooses_the_level),
        cmocka_unit_test(long_footprints_are_sharp_across_their_length),
        cmocka_unit_test(edges_follow_the_wrap_modes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
