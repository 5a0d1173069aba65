/* SPDX-License-Identifier: MIT */
/* Images of the ground truth: a floor of which every pixel has a known value. */
#include "app/scene/trace/trace.h"
#include "app/truth/reference.h"
#include "tests/oracle/check.h"
#include "tests/oracle/gltf.h"
#include "tests/oracle/placed.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 24, HEIGHT = 16 };

/* A square floor at y = 0, 20 wide, and a camera above it. */
typedef struct fixture {
    scene_vertex vertices[4];
    uint32_t indices[6];
    scene_mesh mesh;
    scene_material material;
    scene_texture texture;
    unsigned char texels[16];
    scene_light lights[2];
    scene world;
    reference_settings settings;
} fixture;

static void build(fixture *s) {
    static const uint32_t counter_clockwise[6] = { 0, 1, 2, 0, 2, 3 };
    *s = (fixture) {
        .mesh = { .index_count = 6 },
        .material = scene_material_plain(),
        .lights = { { .emitter = { .position = { 1, 3, -1 },
                                   .radius = 0.5f,
                                   .radiance = { 10, 20, 30 } } },
                    { .emitter = { .position = { -3, 1, 2 },
                                   .radius = 2,
                                   .radiance = { 1, 1, 1 } } } },
        .settings = { .width = WIDTH,
                      .height = HEIGHT,
                      .camera = { .eye = { 0, 5, 0.01f }, .up = { 0, 1, 0 }, .fov = 1 },
                      .samples = 256,
                      .seed = 5 },
    };
    const float color[3] = { 0.5f, 0.25f, 1 };
    memcpy(s->material.base_color, color, sizeof color);
    s->material.metallic = 0.5f;
    s->material.roughness = 0.6f;
    for (int i = 0; i < 4; i++) {
        const float x = i == 0 || i == 3 ? -1 : 1, z = i < 2 ? 1 : -1;
        s->vertices[i] = (scene_vertex) { .position = { 10 * x, 0, 10 * z },
                                          .normal = { 0, 1, 0 },
                                          .uv = { { (x + 1) / 2, (z + 1) / 2 } },
                                          .tangent = { 1, 0, 0, 1 } };
    }
    memcpy(s->indices, counter_clockwise, sizeof s->indices);
    s->world = (scene) { .vertices = s->vertices,
                         .indices = s->indices,
                         .meshes = &s->mesh,
                         .instances = placed_meshes(1),
                         .materials = &s->material,
                         .textures = &s->texture,
                         .texels = s->texels,
                         .vertex_count = 4,
                         .index_count = 6,
                         .mesh_count = 1,
                         .instance_count = 1,
                         .material_count = 1,
                         .texture_count = 1,
                         .texel_bytes = 16,
                         .lights = s->lights,
                         .light_count = 2,
                         .minimum = { -10, 0, -10 },
                         .maximum = { 10, 0, 10 },
                         .name = "floor" };
    s->texture = (scene_texture) { .width = 2, .height = 2 };
}

static void draw(const fixture *s, image *radiance, image *standard_error) {
    base_error error;
    assert_true(reference_render(&s->world, &s->settings, radiance, standard_error, &error));
}

static void draw_plain(const fixture *s, image *radiance) {
    image standard_error;
    draw(s, radiance, &standard_error);
    image_free(&standard_error);
}

/* Returns the floor point seen through the center of a pixel, by the camera's definition. */
static reference_vec floor_point(const fixture *s, int x, int y) {
    const double top = tan((double)s->settings.camera.fov / 2);
    const reference_vec eye = reference_from_floats(s->settings.camera.eye);
    const reference_vec forward = reference_normalize(reference_scale(-1, eye));
    const reference_vec right =
        reference_normalize(reference_cross(forward, reference_from_floats(s->settings.camera.up)));
    const reference_vec up = reference_cross(right, forward);
    const double across = (2 * (x + 0.5) / WIDTH - 1) * top * WIDTH / HEIGHT;
    const double along = (1 - 2 * (y + 0.5) / HEIGHT) * top;
    const reference_vec d = reference_add(
        forward, reference_add(reference_scale(across, right), reference_scale(along, up)));
    return reference_add(eye, reference_scale(-eye.y / d.y, d));
}

/* Returns the green of the floor's mixture of metal and dielectric under a sphere, by appendix B of
 * glTF 2.0. */
static double exact_green(const fixture *s, const scene_light *light, reference_vec p,
                          reference_vec view) {
    const double base = 0.25, metallic = (double)s->material.metallic;
    const double alpha = pow((double)s->material.roughness, 2), angle = acos(view.y);
    const oracle_gltf metal = { alpha, angle, base, 1, 0 },
                      dielectric = { alpha, angle, 0.04, 1, base };
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), p);
    const double d = reference_length(to), r = (double)light->emitter.radius;
    const double flat = fmax(hypot(view.x, view.z), 1e-12);
    const double x = -(to.x * view.x + to.z * view.z) / flat;
    const double y = (to.z * view.x - to.x * view.z) / flat;
    const double middle[3] = { x / d, y / d, to.y / d };
    const double half_angle = d > r ? asin(r / d) : REFERENCE_PI;
    return (double)light->emitter.radiance.g *
           (metallic * oracle_gltf_cap(&metal, middle, half_angle) +
            (1 - metallic) * oracle_gltf_cap(&dielectric, middle, half_angle));
}

static void every_pixel_is_what_the_specification_says(void **state) {
    (void)state;
    fixture s;
    image radiance, standard_error;
    int outside = 0;
    build(&s);
    s.lights[0].hidden = s.lights[1].hidden = 1;
    draw(&s, &radiance, &standard_error);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const reference_vec p = floor_point(&s, x, y);
            const reference_vec view = reference_normalize(
                reference_subtract(reference_from_floats(s.settings.camera.eye), p));
            const double exact =
                exact_green(&s, &s.lights[0], p, view) + exact_green(&s, &s.lights[1], p, view);
            const size_t i = 3 * ((size_t)y * WIDTH + (size_t)x) + 1;
            const double error = fabs((double)radiance.rgb[i] - exact);
            outside += !(error <= 3 * (double)standard_error.rgb[i] + 1e-4 * exact);
            CHECK_WITHIN(error, 6 * (double)standard_error.rgb[i] + 1e-4 * exact);
        }
    /* 3 in 1000 lie outside three standard errors; of 64 skewed samples somewhat more. */
    assert_in_range(outside, 0, WIDTH * HEIGHT / 50);
    image_free(&radiance);
    image_free(&standard_error);
}

/* A light that is seen is its radiance, of which nothing is random; lights of other kinds are not
 * seen. */
static void a_glowing_sphere_is_its_radiance_exactly(void **state) {
    (void)state;
    fixture s;
    image radiance, standard_error;
    build(&s);
    s.lights[0].emitter = (lmp_light) {
        .position = { 0, 3, 0 }, .radius = 1.9f, .radiance = { 10, 20, 30 }, .ground = { 7, 8, 9 }
    };
    s.world.light_count = 1;
    draw(&s, &radiance, &standard_error);
    const size_t middle = 3 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
    for (size_t c = 0; c < 3; c++) {
        assert_true(radiance.rgb[middle + c] == 10 * (float)(c + 1));
        assert_true(standard_error.rgb[middle + c] == 0);
    }
    image_free(&radiance);
    image_free(&standard_error);
}

/* What is unlit glows by the colors of its vertices, too. */
static void vertices_color_what_is_unlit(void **state) {
    (void)state;
    fixture s;
    image radiance;
    build(&s);
    s.world.light_count = 0;
    s.material.flags = SCENE_UNLIT | SCENE_VERTEX_COLORS;
    for (int c = 0; c < 3; c++)
        s.material.emission[c] = 0.5f;
    for (int i = 0; i < 4; i++)
        memcpy(s.vertices[i].color, (const uint16_t[4]) { 65535, 13107, 0, 65535 },
               sizeof s.vertices[i].color);
    draw_plain(&s, &radiance);
    static const double expected[3] = { 0.5, 0.1, 0 };
    const size_t middle = 3 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
    for (size_t c = 0; c < 3; c++)
        CHECK_WITHIN(fabs((double)radiance.rgb[middle + c] - expected[c]), 1e-6);
    image_free(&radiance);
}

/* Rounding grows with the coordinates, and so does how far rays start off their surface: the same
 * scene in units 4096 times larger is the same. */
static void rays_are_lifted_in_the_scenes_own_unit(void **state) {
    (void)state;
    fixture s;
    build(&s);
    const double lift = trace_lift(&s.world);
    CHECK_WITHIN(fabs(lift / 10 - 1e-5), 1e-12);
    for (int i = 0; i < 3; i++) {
        s.world.minimum[i] /= 4096;
        s.world.maximum[i] /= 4096;
    }
    CHECK_WITHIN(fabs(trace_lift(&s.world) * 4096 / lift - 1), 1e-12);
    s.world.minimum[1] = -1; /* the farthest point, below the floor */
    CHECK_WITHIN(fabs(trace_lift(&s.world) - 1e-5), 1e-12);
}

static void the_number_of_threads_changes_no_bit(void **state) {
    (void)state;
    scene world;
    base_error error;
    image one[2], two[2];
    reference_settings settings = {
        .width = 40, .height = 30, .samples = 16, .seed = 9, .error = 0.2, .shadows = true
    };
    assert_true(scene_load("builtin:balls", &(scene_options) { .no_cache = true }, &world, &error));
    settings.camera = scene_default_camera(&world, 4.0f / 3);
    settings.threads = 1;
    assert_true(reference_render(&world, &settings, &one[0], &one[1], &error));
    settings.threads = 2;
    assert_true(reference_render(&world, &settings, &two[0], &two[1], &error));
    for (int i = 0; i < 2; i++)
        assert_memory_equal(one[i].rgb, two[i].rgb, sizeof(float) * 3 * 40 * 30);
    settings.seed = 10;
    image_free(&two[0]);
    image_free(&two[1]);
    assert_true(reference_render(&world, &settings, &two[0], &two[1], &error));
    assert_memory_not_equal(one[0].rgb, two[0].rgb, sizeof(float) * 3 * 40 * 30);
    for (int i = 0; i < 2; i++) {
        image_free(&one[i]);
        image_free(&two[i]);
    }
    scene_free(&world);
}

/* Finds whether the left and the right end of the image's middle row are lit. */
static void lit_ends(const fixture *s, bool *left, bool *right) {
    image radiance;
    draw_plain(s, &radiance);
    const float *row = radiance.rgb + 3 * WIDTH * (HEIGHT / 2);
    *left = row[0] > 0;
    *right = row[3 * (WIDTH - 1)] > 0;
    image_free(&radiance);
}

static void backs_of_single_sided_triangles_are_not_seen(void **state) {
    (void)state;
    fixture s;
    bool left, right;
    build(&s);
    s.lights[0].hidden = s.lights[1].hidden = 1;
    s.settings.camera.eye[1] = -5;
    s.lights[0].emitter.position.y = -3;
    lit_ends(&s, &left, &right);
    assert_false(left || right);
    s.material.flags = SCENE_DOUBLE_SIDED;
    lit_ends(&s, &left, &right);
    assert_true(left && right);
}

static void an_alpha_mask_cuts_holes(void **state) {
    (void)state;
    fixture s;
    bool left, right;
    build(&s);
    s.lights[0].hidden = s.lights[1].hidden = 1;
    s.material.base_color_map.texture = 0;
    s.material.flags = SCENE_ALPHA_MASK;
    s.material.alpha_cutoff = 0.5f;
    for (int i = 0; i < 16; i++)
        s.texels[i] = (unsigned char)(i % 8 == 3 ? 0 : 255); /* transparent where u < 1/2 */
    s.texture.wrap_u = s.texture.wrap_v = SCENE_WRAP_CLAMP;
    lit_ends(&s, &left, &right);
    assert_true(!left && right);
}

static void a_normal_map_tilts_the_normal(void **state) {
    (void)state;
    fixture s;
    image flat, tilted;
    build(&s);
    s.lights[0] = (scene_light) {
        .emitter = { .position = { 100, 100, 0 }, .radius = 1, .radiance = { 1e4f, 1e4f, 1e4f } },
        .hidden = 1
    };
    s.world.light_count = 1;
    s.material.metallic = 0;
    s.material.roughness = 1;
    s.settings.samples = 4096;
    draw_plain(&s, &flat);
    s.material.normal_map = (scene_texture_use) { 0, { 1, 0, 0, 1 }, { 0, 0 }, 0 };
    for (int i = 0; i < 4; i++)
        memcpy(s.texels + 4 * i, (const unsigned char[4]) { 218, 128, 218, 255 }, 4);
    draw_plain(&s, &tilted);
    /* The normal lies 45° towards the light, so the irradiance grows by sqrt 2, and the diffuse
     * part with it. */
    const size_t i = 3 * (WIDTH * (HEIGHT / 2) + WIDTH / 2) + 2;
    CHECK_WITHIN(fabs((double)tilted.rgb[i] / (double)flat.rgb[i] - sqrt(2.0)), 0.05);
    image_free(&flat);
    image_free(&tilted);
}

static void shadows_fall_only_when_asked_for(void **state) {
    (void)state;
    fixture s;
    bool left, right;
    build(&s);
    s.material.flags = SCENE_DOUBLE_SIDED;
    s.lights[0] = (scene_light) {
        .emitter = { .position = { 0, -3, 0 }, .radius = 4, .radiance = { 1, 1, 1 } }, .hidden = 1
    };
    s.world.light_count = 1;
    s.settings.camera.eye[1] = 6;
    s.material.roughness = 1;
    s.lights[0].emitter.radius = 2.5f;
    s.vertices[0].normal[1] = s.vertices[1].normal[1] = -1; /* shaded as if seen from below */
    s.vertices[2].normal[1] = s.vertices[3].normal[1] = -1;
    lit_ends(&s, &left, &right);
    assert_true(left && right);
    s.settings.shadows = true;
    lit_ends(&s, &left, &right);
    assert_false(left || right);
}

static void glowing_spheres_are_seen(void **state) {
    (void)state;
    fixture s;
    image radiance, standard_error;
    build(&s);
    s.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 2, 0 }, .radius = 1, .radiance = { 3, 5, 7 } }
    };
    draw(&s, &radiance, &standard_error);
    const size_t i = 3 * (WIDTH * (HEIGHT / 2) + WIDTH / 2);
    assert_true(radiance.rgb[i] == 3 && radiance.rgb[i + 1] == 5 && radiance.rgb[i + 2] == 7);
    assert_true(standard_error.rgb[i] == 0);
    image_free(&radiance);
    image_free(&standard_error);
}

/* The mean over a pixel that the edge of a light crosses is between the two radiances on its sides,
 * and over the whole image the light covers the area that its projection has. */
static void rays_spread_over_the_pixel_filter_edges(void **state) {
    (void)state;
    fixture s;
    image radiance;
    build(&s);
    s.settings.camera = (scene_camera) { .eye = { 0, 5, 0.01f }, .up = { 0, 0, -1 }, .height = 4 };
    s.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 2, 0 }, .radius = 1, .radiance = { 100, 100, 100 } }
    };
    s.world.light_count = 1;
    s.material.base_color[0] = s.material.base_color[1] = s.material.base_color[2] = 0;
    s.settings.samples = 1;
    double errors[2];
    for (int k = 0; k < 2; k++) {
        double covered = 0;
        int between = 0;
        s.settings.rays = k == 0 ? 1 : 64;
        draw_plain(&s, &radiance);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const double part = (double)radiance.rgb[3 * i] / 100;
            covered += part;
            between += part > 0.1 && part < 0.9;
        }
        assert_true(k == 0 ? between == 0 : between >= 12);
        /* a pixel is a quarter wide and high */
        errors[k] = fabs(covered / 16 - REFERENCE_PI);
        image_free(&radiance);
    }
    CHECK_WITHIN(errors[1], 0.015 * REFERENCE_PI);
    CHECK_WITHIN(errors[1], errors[0] + 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_spread_over_the_pixel_filter_edges),
        cmocka_unit_test(every_pixel_is_what_the_specification_says),
        cmocka_unit_test(a_glowing_sphere_is_its_radiance_exactly),
        cmocka_unit_test(vertices_color_what_is_unlit),
        cmocka_unit_test(rays_are_lifted_in_the_scenes_own_unit),
        cmocka_unit_test(the_number_of_threads_changes_no_bit),
        cmocka_unit_test(backs_of_single_sided_triangles_are_not_seen),
        cmocka_unit_test(an_alpha_mask_cuts_holes),
        cmocka_unit_test(a_normal_map_tilts_the_normal),
        cmocka_unit_test(shadows_fall_only_when_asked_for),
        cmocka_unit_test(glowing_spheres_are_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
