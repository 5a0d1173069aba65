/* SPDX-License-Identifier: MIT */
/* The image that the GPU shades by lobes against the ground truth of GGX in as many bands. */
#include "app/render/gl/gpu.h"
#include "app/truth/reference.h"
#include "app/truth/reference_light.h"
#include "app/truth/reference_trace.h"
#include "tests/oracle/check.h"
#include "tests/oracle/kinds.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 120, HEIGHT = 80 };

static image draw_by_harmonics(const scene *world, const reference_settings *settings,
                               render_pixel **pixels, bool *software) {
    gpu_context context;
    base_error error;
    image drawn;
    const render_frame frame = { .width = WIDTH,
                                 .height = HEIGHT,
                                 .camera = settings->camera,
                                 .method =
                                     METHOD_COEFFICIENTS, /* truncates the diffuse lobe as well */
                                 .bands = settings->band_limit.bands,
                                 .window = settings->band_limit.window,
                                 .lights = world->lights,
                                 .light_count = world->light_count };
    assert_true(gpu_context_create(check_gl_device(), &context, &error));
    gpu_renderer *renderer = gpu_renderer_create(&context, world, &error);
    assert_non_null(renderer);
    assert_true(gpu_render(renderer, &frame, NULL, &error));
    assert_true(gpu_read_image(renderer, &drawn, &error));
    assert_true(gpu_read_pixels(renderer, pixels, &error));
    gpu_renderer_destroy(renderer);
    *software = context.software;
    gpu_context_destroy(&context);
    return drawn;
}

/* What one pixel shows. */
typedef struct pixel_hit {
    render_kind kind;
    reference_vec position, normal;
} pixel_hit;

static pixel_hit seen_by_ray(const scene *world, const reference_tracer *tracer, reference_vec eye,
                             reference_vec direction) {
    const reference_hit hit = reference_tracer_see(tracer, eye, direction);
    pixel_hit s = { isfinite(hit.distance) ? RENDER_SURFACE : RENDER_NONE, hit.position,
                    hit.normal };
    for (size_t i = 0; i < world->light_count; i++) {
        const scene_light *light = &world->lights[i];
        if (scene_light_is_drawn(light) && reference_light_is_hit(light, eye, direction) &&
            reference_light_distance(light, eye, direction) < hit.distance)
            s.kind = RENDER_LIGHT;
    }
    return s;
}

/* Whether the rasterizer and the ray through the pixel's center found the same piece of surface:
 * along an edge either may be right. */
static bool same_surface(const render_pixel *pixel, const pixel_hit *ray, reference_vec eye) {
    if (pixel->kind != ray->kind || ray->kind != RENDER_SURFACE)
        return pixel->kind == ray->kind;
    const lmp_vec3 p = pixel->surface.position, n = pixel->surface.normal;
    const reference_vec position = { (double)p.x, (double)p.y, (double)p.z };
    const reference_vec normal = { (double)n.x, (double)n.y, (double)n.z };
    const double distance = reference_length(reference_subtract(ray->position, eye));
    return reference_length(reference_subtract(position, ray->position)) <= 1e-3 * distance &&
           reference_dot(normal, ray->normal) >= 0.9999;
}
/* Finds what the rays through the pixels' centers meet; the caller frees it. */
static pixel_hit *look(const scene *world, const scene_camera *camera) {
    pixel_hit *hits = malloc(WIDTH * HEIGHT * sizeof *hits);
    reference_tracer *tracer;
    base_error error;
    const reference_vec eye = reference_from_floats(camera->eye);
    const reference_vec forward =
        reference_normalize(reference_subtract(reference_from_floats(camera->target), eye));
    const reference_vec right =
        reference_normalize(reference_cross(forward, reference_from_floats(camera->up)));
    const bool parallel = camera->height > 0;
    const double seen = parallel ? (double)camera->height : 2 * tan((double)camera->fov / 2);
    const double step = seen / HEIGHT;
    assert_non_null(hits);
    assert_true(reference_tracer_create(world, &tracer, &error));
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        const double x = step * (p % WIDTH + 0.5 - WIDTH / 2.0);
        const double y = step * (HEIGHT / 2.0 - 0.5 - p / WIDTH);
        const reference_vec up = reference_cross(right, forward);
        const reference_vec across =
            reference_add(reference_scale(x, right), reference_scale(y, up));
        hits[p] = parallel ? seen_by_ray(world, tracer, reference_add(eye, across), forward)
                           : seen_by_ray(world, tracer, eye,
                                         reference_normalize(reference_add(forward, across)));
    }
    reference_tracer_destroy(tracer);
    return hits;
}

/* Whether a channel differs by more than 5 standard errors and one step of 8 bits. What lobes leave
 * of GGX is less than that in few bands, except at a silhouette. */
static bool differs(const float *drawn, const float *truth, const float *standard_error,
                    double exposure) {
    for (int c = 0; c < 3; c++) {
        const double d = fabs((double)drawn[c] - (double)truth[c]);
        if (!((d - 5 * (double)standard_error[c]) * exposure <= 1.0 / 255))
            return true;
    }
    return false;
}

/* Checks a scene under random lights or, with `kinds`, a light of each kind; with a height, by
 * parallel rays. */
static void check_scene(const char *name, int lights, bool kinds, float height,
                        const reference_band_limit *limit) {
    scene world;
    base_error error;
    image truth, standard_error;
    render_pixel *pixels;
    reference_settings settings = {
        .width = WIDTH, .height = HEIGHT, .samples = 256, .seed = 1, .band_limit = *limit
    };
    const scene_lights_options random = { .random_count = lights, .seed = 1 };
    int edges = 0, different = 0;
    bool software;
    assert_true(scene_load(name, &(scene_options) { .no_cache = true }, &world, &error));
    assert_true(scene_apply_lights(&world, &random, &error));
    for (int i = 0; kinds && i < KINDS; i++)
        world.lights[i] = (scene_light) { .emitter = one_of_each_kind[i] };
    if (kinds)
        world.light_count = KINDS;
    settings.camera = scene_default_camera(&world, (float)WIDTH / HEIGHT);
    settings.camera.height = height;
    assert_true(reference_render(&world, &settings, &truth, &standard_error, &error));
    image drawn = draw_by_harmonics(&world, &settings, &pixels, &software);
    pixel_hit *hits = look(&world, &settings.camera);
    const double exposure = (double)image_auto_exposure(&truth);
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        const bool edge =
            !same_surface(&pixels[p], &hits[p], reference_from_floats(settings.camera.eye));
        edges += edge;
        different += !edge && differs(&drawn.rgb[3 * p], &truth.rgb[3 * p],
                                      &standard_error.rgb[3 * p], exposure);
    }
    assert_in_range(different, 0, WIDTH * HEIGHT / 2000);
    /* Hardware interpolates between corners that it has moved to 1/256 of a pixel: normals of
     * triangles smaller than a pixel rotate by a degree or two. */
    assert_in_range(edges, 0, WIDTH * HEIGHT / (software ? 250 : 125));
    free(hits);
    free(pixels);
    image_free(&drawn);
    image_free(&truth);
    image_free(&standard_error);
    scene_free(&world);
}

static void truncated_lobes_render_as_the_ground_truth_of_balls(void **state) {
    (void)state;
    check_scene("builtin:balls", 0, false, 0, &(reference_band_limit) { 8, LMP_WINDOW_NONE, 0 });
}

static void truncated_lobes_render_as_the_ground_truth_of_the_atrium(void **state) {
    (void)state;
    check_scene("builtin:atrium", 30, false, 0,
                &(reference_band_limit) { 5, LMP_WINDOW_HANNING, 0 });
}

static void every_kind_of_light_renders_as_the_ground_truth(void **state) {
    (void)state;
    check_scene("builtin:balls", 0, true, 0, &(reference_band_limit) { 8, LMP_WINDOW_NONE, 0 });
}

static void parallel_rays_render_as_the_ground_truth(void **state) {
    (void)state;
    check_scene("builtin:balls", 0, true, 4, &(reference_band_limit) { 8, LMP_WINDOW_NONE, 0 });
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truncated_lobes_render_as_the_ground_truth_of_balls),
        cmocka_unit_test(truncated_lobes_render_as_the_ground_truth_of_the_atrium),
        cmocka_unit_test(every_kind_of_light_renders_as_the_ground_truth),
        cmocka_unit_test(parallel_rays_render_as_the_ground_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
