/* SPDX-License-Identifier: MIT */
/* Ground that is not drawn, but receives shadows, against a closed form: under a sky of even
 * radiance, a ball of radius r that stands on the ground hides the fraction (r/d)³ from a point of
 * the ground at distance d of its center, because it covers a cap of half angle asin(r/d), all
 * above the horizon, whose center is at the cosine r/d from the zenith. */
#include "tests/gpu/shadow.h"

#include "app/render/shadow/ground.h"

static const lmp_vec3 middle = { 0.1f, 0.5f, 0 };

static void make_ball(scene *world) {
    enum { RINGS = 128 };
    scene_builder builder = { .out_of_memory = false };
    shape_point profile[RINGS + 1];
    add_material(&builder, "ball", 0.8f);
    scene_shaper shaper = { .builder = &builder };
    for (int i = 0; i <= RINGS; i++) {
        const float angle = PI * (float)i / (float)RINGS;
        profile[i] = (shape_point) { i % RINGS ? sinf(angle) : 0, -cosf(angle) };
    }
    shape_revolve(&shaper, &(shape_revolution) { .profile = profile,
                                                 .point_count = RINGS + 1,
                                                 .origin = middle,
                                                 .axis = 'y',
                                                 .segments = 2 * RINGS });
    shaper_finish(&shaper);
    open_scene(&builder, world);
}

/* Makes a sky of even radiance, with or without ground. */
static environment make_sky(bool ground) {
    static float ones[3 * 8 * 4];
    for (size_t i = 0; i < sizeof ones / sizeof *ones; i++)
        ones[i] = 1;
    return (environment) { .light = { 8, 4, ones }, .ground = ground };
}

/* Returns what arrives where the middle of a pixel sees the ground under the ball; below 0 where it
 * sees something else. */
static double arrives_at(const scene_camera *seen, int x, int y) {
    const lmp_vec3 eye = vec_load(seen->eye);
    const lmp_vec3 forward = vec_normalize(vec_sub(vec_load(seen->target), eye), vec(0, 0, 1));
    const lmp_vec3 right = vec_normalize(vec_cross(forward, vec(0, 1, 0)), vec(1, 0, 0));
    const lmp_vec3 up = vec_cross(right, forward);
    const float slope = tanf(0.5f * seen->fov);
    const float across = (2 * ((float)x + 0.5f) / WIDTH - 1) * slope * WIDTH / HEIGHT;
    const float above = (1 - 2 * ((float)y + 0.5f) / HEIGHT) * slope;
    const lmp_vec3 d = vec_add(forward, vec_add(vec_scale(right, across), vec_scale(up, above)));
    const lmp_vec3 at = vec_add(eye, vec_scale(d, (middle.y - 1 - eye.y) / d.y));
    const double away = (double)vec_length(vec_sub(at, middle));
    return d.y < 0 && eye.y > middle.y - 1 ? 1 - 1 / (away * away * away) : -1;
}

static image draw(bool ground, const scene_camera *seen, const shadow_settings *settings,
                  unsigned char covered[PIXELS]) {
    const environment sky = make_sky(ground);
    stage s;
    open_scene_stage(&s, make_ball);
    set_lights(&s, NULL, 0);
    s.frame.camera = *seen;
    for (int c = 0; c < 3; c++)
        s.frame.background[c] = c == 1 ? 0 : 1;
    image bare = render_image(s.renderer, &s.frame);
    for (int i = 0; i < PIXELS; i++)
        covered[i] = bare.rgb[3 * i] < 1;
    image_free(&bare);
    image pixels = draw_shadows(&s, &sky, settings);
    close_stage(&s);
    return pixels;
}

static void a_ball_hides_of_an_even_sky_what_its_cap_does(void **state) {
    (void)state;
    static unsigned char covered[PIXELS];
    const shadow_settings settings[] = { { .rays = 400, .raw = true }, { .rays = 0 } };
    const double bounds[] = { 0.1, 0.3 }, means[] = { 0.01, 0.03 };
    for (int k = 0; k < 2; k++) {
        image pixels = draw(true, &camera, &settings[k], covered);
        double off = 0;
        int judged = 0;
        for (int i = 0; i < PIXELS; i++) {
            const double arrives = arrives_at(&camera, i % WIDTH, i / WIDTH);
            if (covered[i])
                continue;
            assert_true(pixels.rgb[3 * i + 1] == 0);
            if (arrives < 0) {
                assert_true(pixels.rgb[3 * i] == 1);
                continue;
            }
            CHECK_WITHIN(fabs((double)pixels.rgb[3 * i] - arrives), bounds[k]);
            off += fabs((double)pixels.rgb[3 * i] - arrives);
            judged++;
        }
        print_message("%d pixels of the ground, off by %.4f in the mean\n", judged, off / judged);
        assert_in_range(judged, PIXELS / 8, PIXELS);
        CHECK_WITHIN(off, means[k] * judged);
        image_free(&pixels);
    }
}

/* Nor does the ground hide anything from a camera under it. */
static void without_ground_nothing_past_the_scene_darkens(void **state) {
    (void)state;
    static unsigned char covered[PIXELS];
    scene_camera below = camera;
    below.eye[1] = -1.5f;
    for (int k = 0; k < 2; k++) {
        image pixels =
            draw(k == 1, k == 1 ? &below : &camera, &(shadow_settings) { .rays = 2 }, covered);
        for (int i = 0; i < PIXELS; i++)
            if (!covered[i])
                assert_true(pixels.rgb[3 * i] == 1 && pixels.rgb[3 * i + 2] == 1);
        image_free(&pixels);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_hides_of_an_even_sky_what_its_cap_does),
        cmocka_unit_test(without_ground_nothing_past_the_scene_darkens),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
