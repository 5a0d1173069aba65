/* SPDX-License-Identifier: MIT */
/* The reference's areas against closed forms and quadrature, and images against the reference. */
#include "tests/oracle/areas.h"
#include "app/render/renderer/renderer.h"
#include "app/render/renderer/shadows.h"
#include "app/render/shade_field.h"
#include "app/scene/bake.h"
#include "app/truth/reference.h"
#include "app/truth/reference_estimate.h"

#include <stdlib.h>
#include <string.h>

/* --- irradiance ------------------------------------------------------------------------------- */

static reference_result reflect(const lmp_light *light, reference_vec point, reference_vec normal,
                                int samples) {
    const reference_band_limit whole = { .bands = 0 };
    const reference_material white = { .diffuse = { 1, 1, 1 } };
    const scene_light own = { .emitter = *light };
    const reference_stop stop = { .samples = samples };
    reference_surface surface;
    reference_estimator estimator;
    reference_surface_set(&surface, &whole, &white, point, normal, normal);
    assert_true(reference_estimator_create(&estimator, &own, 1));
    const reference_result result = reference_estimate(&estimator, &surface, &stop, 7);
    reference_estimator_free(&estimator);
    return result;
}

/* Lambert's formula: half the sum, over the sides, of the angle between their ends times the cosine
 * between the normal and the plane through the side. Exact above the horizon. */
static double lambert(const reference_vec *corner, int count, reference_vec n) {
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const reference_vec a = corner[i], b = corner[(i + 1) % count];
        const reference_vec across = reference_cross(a, b);
        sum += reference_angle(reference_normalize(a), reference_normalize(b)) *
               reference_dot(reference_normalize(across), n);
    }
    return fabs(sum) / 2;
}

static void check_reflection(const lmp_light *light, double irradiance) {
    const reference_vec origin = { 0, 0, 0 }, up = { 0, 1, 0 };
    const reference_result found = reflect(light, origin, up, 4096);
    const double exact = irradiance / REFERENCE_PI;
    CHECK_WITHIN(fabs(found.mean[1] - exact), 4 * found.standard_error[1] + 1e-9);
    CHECK_WITHIN(found.standard_error[1], 0.02 * exact);
}

/* A floor under the middle of a rectangle, a disk and a triangle, which shine downward. */
static void a_floor_under_an_area_gets_the_closed_form(void **state) {
    (void)state;
    const lmp_light rectangle = { .kind = LMP_LIGHT_RECTANGLE,
                                  .position = { 0, 2, 0 },
                                  .half = { { 1.5f, 0, 0 }, { 0, 0, 0.5f } },
                                  .radiance = { 1, 1, 1 } };
    const lmp_light disk = { .kind = LMP_LIGHT_DISK,
                             .position = { 0, 2, 0 },
                             .direction = { 0, -1, 0 },
                             .radius = 1,
                             .radiance = { 1, 1, 1 } };
    const lmp_light triangle = { .kind = LMP_LIGHT_POLYGON,
                                 .position = { 0, 1, 0 },
                                 .corner_count = 3,
                                 .corner = { { -1, 0, -1 }, { 1, 0, -1 }, { 0, 0, 2 } },
                                 .radiance = { 1, 1, 1 } };
    const reference_vec four[] = {
        { -1.5, 2, -0.5 }, { 1.5, 2, -0.5 }, { 1.5, 2, 0.5 }, { -1.5, 2, 0.5 }
    };
    const reference_vec three[] = { { -1, 1, -1 }, { 1, 1, -1 }, { 0, 1, 2 } }, up = { 0, 1, 0 };
    check_reflection(&rectangle, lambert(four, 4, up));
    check_reflection(&disk, REFERENCE_PI * 1 / (1 + 4.0));
    check_reflection(&triangle, lambert(three, 3, up));
}

/* Any area from anywhere, also from behind and with its plane across the surface. Where it is
 * hardly above the horizon, too few samples see it to tell how much they vary. */
static void every_area_gives_the_irradiance_of_quadrature(void **state) {
    (void)state;
    const int count = check_count(120, 2000);
    double squares = 0;
    int judged = 0;
    for (int i = 0; i < count; i++) {
        const random_area a = area_random(area_kinds[i % AREA_KINDS]);
        const double beyond = a.light.kind == LMP_LIGHT_TUBE ? (double)a.light.radius : 0;
        const double distance = beyond + a.size * check_random_between(1.2, 6);
        const lmp_vec3 from = area_sum(a.light.position, distance, check_random_direction());
        const lmp_vec3 n = check_random_direction();
        const double point[3] = { (double)from.x, (double)from.y, (double)from.z };
        const double normal[3] = { (double)n.x, (double)n.y, (double)n.z };
        const double exact = oracle_area_irradiance(&a.light, point, normal) / REFERENCE_PI;
        const reference_vec facing = reference_normalize(
            reference_subtract(reference_from(a.light.position), reference_from(from)));
        const double toward[3] = { facing.x, facing.y, facing.z };
        const double most = oracle_area_irradiance(&a.light, point, toward) / REFERENCE_PI;
        const reference_result found =
            reflect(&a.light, reference_from(from), reference_normalize(reference_from(n)), 1024);
        const double off = found.mean[0] - exact, error = found.standard_error[0];
        CHECK_WITHIN(fabs(off), 5 * error + 2e-4 * most + 1e-9);
        if (exact > 1e-3 * most) {
            assert_true(error > 0);
            squares += off * off / (error * error);
            judged++;
        }
    }
    assert_true(judged > count / 4);
    CHECK_WITHIN(sqrt(squares / judged), 1.25); /* a bias would add up */
}

/* --- images ----------------------------------------------------------------------------------- */

enum { WIDTH = 72, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

/* One of each over matte balls on a floor; the rectangle's back is toward the camera. */
static const lmp_light four[] = {
    { .kind = LMP_LIGHT_RECTANGLE,
      .position = { 0, 3, -1 },
      .half = { { 0.6f, 0, 0 }, { 0, 0, 0.3f } },
      .radiance = { 20, 18, 15 } },
    { .kind = LMP_LIGHT_DISK,
      .position = { 2.5f, 2.2f, 0 },
      .direction = { -0.8f, -0.6f, 0 },
      .radius = 0.4f,
      .two_sided = true,
      .radiance = { 5, 6, 15 } },
    { .kind = LMP_LIGHT_TUBE,
      .position = { 0, 0.3f, 2 },
      .half = { { 1.2f, 0, 0 } },
      .radius = 0.05f,
      .radiance = { 5, 15, 8 } },
    { .kind = LMP_LIGHT_POLYGON,
      .position = { -2.5f, 1, 0 },
      .corner_count = 5,
      .corner = { { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0.5f, 1.5f }, { 0, 0, 1 } },
      .radiance = { 18, 5, 3 } },
};
enum { FOUR = sizeof four / sizeof *four };

static void expect(bool ok, const base_error *error) {
    if (!ok)
        fail_msg("%s", error->text);
}

static void open_scene(scene *world) {
    base_error error;
    expect(scene_load("builtin:balls", &(scene_options) { .no_cache = true }, world, &error),
           &error);
    scene_clear_lights(world);
    for (int i = 0; i < FOUR; i++)
        world->lights[world->light_count++] = (scene_light) { .emitter = four[i] };
}

/* Draws the scene on the CPU, with shadows whose rays are many and not filtered. */
static image draw(const scene *world, method_kind method, int bands, bool shadows) {
    const shadow_settings settings = { .rays = 256, .raw = true };
    base_error error = { "" };
    render_device device;
    image pixels;
    render_frame frame = { .width = WIDTH,
                           .height = HEIGHT,
                           .camera = scene_default_camera(world, (float)WIDTH / HEIGHT),
                           .method = method,
                           .bands = bands,
                           .lights = world->lights,
                           .light_count = world->light_count };
    const shade_field_options exact = { .error = 1e-4f };
    lmp_preintegrated_lobe *lobes = NULL;
    shade_field *field = NULL;
    if (method_table[method].reads & METHOD_READS_PREINTEGRATED)
        expect(bake_lobes(bands, LMP_WINDOW_NONE, &lobes, &error), &error);
    if (method_table[method].reads & METHOD_READS_FIELD)
        expect((field = shade_field_create(world, &exact, bands, &error)), &error);
    frame.lobes = lobes;
    shade_field_attach(field, &frame);
    expect(render_device_open(DEVICE_CPU, NULL, world, &device, &error), &error);
    any_renderer *renderer = renderer_create(&device, &error);
    shadow *caster = shadows ? render_device_shadow(&device, NULL, &settings, &error) : NULL;
    expect(renderer && (caster || !shadows), &error);
    if (caster)
        frame.shadow = shadow_pass(caster);
    expect(renderer_draw(renderer, &frame, NULL, &error), &error);
    expect(renderer_read_image(renderer, &pixels, &error), &error);
    shadow_destroy(caster);
    renderer_destroy(renderer);
    render_device_close(&device);
    shade_field_destroy(field);
    lmp_preintegrated_lobe_destroy(lobes);
    return pixels;
}

static void trace(const scene *world, int samples, int bands, bool shadows, image *truth,
                  image *standard_error) {
    const reference_settings settings = {
        .width = WIDTH,
        .height = HEIGHT,
        .camera = scene_default_camera(world, (float)WIDTH / HEIGHT),
        .samples = samples,
        .seed = 1,
        .shadows = shadows,
        .band_limit = { bands, LMP_WINDOW_NONE, 0 },
    };
    base_error error;
    expect(reference_render(world, &settings, truth, standard_error, &error), &error);
}

/* The same series of 8 bands, which only noise tells apart, but for pixels at edges of what is
 * seen; these agree because both are seen by the same rays. */
static void images_are_the_reference_s_in_as_many_bands(void **state) {
    (void)state;
    scene world;
    image truth, noise;
    int different = 0, visible = 0;
    double squares = 0;
    open_scene(&world);
    image drawn = draw(&world, METHOD_COEFFICIENTS, 8, false);
    trace(&world, 128, 8, false, &truth, &noise);
    for (int i = 0; i < 3 * PIXELS; i++) {
        const double off = (double)drawn.rgb[i] - (double)truth.rgb[i];
        const double error = (double)noise.rgb[i];
        visible += error == 0 && truth.rgb[i] > 4;
        different += !(fabs(off) <= 5 * error + 2e-3 * (double)truth.rgb[i] + 1e-4);
        squares += error > 0 ? off * off / (error * error) : 0;
    }
    print_message("%d of %d differ, %d show a light, %.2f standard errors\n", different, 3 * PIXELS,
                  visible, sqrt(squares / (3 * PIXELS)));
    assert_true(visible >= 3 * 10);
    assert_in_range(different, 0, 3 * PIXELS / 500);
    image_free(&drawn);
    image_free(&truth);
    image_free(&noise);
    scene_free(&world);
}

/* Makes all surfaces rough, so that bands leave nothing out. */
static void roughen(scene *world, scene_material *rough) {
    memcpy(rough, world->materials, world->material_count * sizeof *rough);
    for (size_t i = 0; i < world->material_count; i++) {
        rough[i].roughness = 1;
        rough[i].metallic = 0;
    }
    world->materials = rough;
}

/* Returns the difference from the truth beyond its noise, as a root of the mean square relative to
 * the mean. */
static double difference(const image *drawn, const image *truth, const image *noise) {
    double squares = 0, sum = 0;
    for (int i = 0; i < 3 * PIXELS; i++) {
        const double off = (double)drawn->rgb[i] - (double)truth->rgb[i];
        squares += off * off - (double)noise->rgb[i] * (double)noise->rgb[i];
        sum += (double)truth->rgb[i];
    }
    return sqrt(fmax(squares, 0) / (3 * PIXELS)) / (sum / (3 * PIXELS));
}

/* The image without shadows is as far from the reference with them as shadows are strong. */
static void shadows_are_the_reference_s(void **state) {
    (void)state;
    static scene_material rough[64];
    scene world;
    image truth, noise;
    open_scene(&world);
    assert_true(world.material_count <= 64);
    roughen(&world, rough);
    image shadowed = draw(&world, METHOD_ZONAL, 20, true),
          lit = draw(&world, METHOD_ZONAL, 20, false);
    trace(&world, 640, 0, true, &truth, &noise);
    const double off = difference(&shadowed, &truth, &noise),
                 without = difference(&lit, &truth, &noise);
    print_message("%.4f of the mean, without shadows %.4f\n", off, without);
    CHECK_WITHIN(off, 0.03);
    CHECK_WITHIN(0.1, without);
    image_free(&shadowed);
    image_free(&lit);
    image_free(&truth);
    image_free(&noise);
    scene_free(&world);
}

/* A sphere besides, of which alone these methods approximate the light. */
static void methods_that_hold_no_areas_light_by_them_as_zonal_does(void **state) {
    (void)state;
    static const method_kind methods[] = { METHOD_PREINTEGRATED, METHOD_FIELD };
    scene world;
    open_scene(&world);
    world.lights[world.light_count++] = (scene_light) {
        .emitter = { .position = { 1, 4, 1 }, .radius = 0.3f, .radiance = { 30, 30, 30 } }
    };
    image zonal = draw(&world, METHOD_ZONAL, 5, false);
    world.light_count--;
    image without = draw(&world, METHOD_ZONAL, 5, false);
    world.light_count++;
    const image exact = { .rgb = calloc(3 * PIXELS, sizeof *exact.rgb) };
    const double sphere = difference(&without, &zonal, &exact);
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        image drawn = draw(&world, methods[m], 5, false);
        const double off = difference(&drawn, &zonal, &exact);
        print_message("%s: %.5f of the mean\n", method_table[methods[m]].name, off);
        CHECK_WITHIN(off, 0.1 * sphere);
        image_free(&drawn);
    }
    free(exact.rgb);
    image_free(&zonal);
    image_free(&without);
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_floor_under_an_area_gets_the_closed_form),
        cmocka_unit_test(every_area_gives_the_irradiance_of_quadrature),
        cmocka_unit_test(images_are_the_reference_s_in_as_many_bands),
        cmocka_unit_test(shadows_are_the_reference_s),
        cmocka_unit_test(methods_that_hold_no_areas_light_by_them_as_zonal_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
