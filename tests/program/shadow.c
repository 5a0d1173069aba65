/* SPDX-License-Identifier: MIT */
/* Rays to lights: where they end, how they are distributed, and what they bring. */
#include "app/render/shadow/source.h"
#include "app/scene/vector.h"
#include "tests/oracle/check.h"
#include "tests/oracle/placed.h"

#include <math.h>
#include <string.h>

static shadow_source source_of(const scene_light *light) {
    static scene_emitter area;
    shadow_source sources[SHADOW_SOURCES(1)];
    assert_int_equal(shadow_sources_make(light, 1, NULL, &area, sources), 1);
    return sources[0];
}

/* Draws what the source brings to the origin, for each pair of numbers. */
static void draw(const shadow_source *source, const shadow_lanes u, const shadow_lanes v,
                 shadow_samples *samples) {
    static const shadow_vectors origins = { { { 0 } } };
    const shadow_source *sources[SHADOW_LANES];
    for (int i = 0; i < SHADOW_LANES; i++)
        sources[i] = source;
    shadow_sources_draw(sources, &origins, NULL, u, v, samples);
}

static double dot(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Rays end on a sphere as a point sees it: from outside on its near side, from inside on its far
 * side. */
static void rays_to_a_sphere_end_on_it(void **state) {
    (void)state;
    for (int i = 0; i < 400; i++) {
        const lmp_vec3 d = check_random_direction();
        const float away = (float)check_random_between(0.05, 6), r = i % 2 ? 1 : 0.25f;
        const scene_light light = { .emitter = { .position = { away * d.x, away * d.y, away * d.z },
                                                 .radius = r,
                                                 .radiance = { 1, 2, 3 } } };
        const shadow_source source = source_of(&light);
        shadow_lanes u, v;
        shadow_samples samples;
        for (int k = 0; k < SHADOW_LANES; k++) {
            u[k] = (float)check_random();
            v[k] = (float)check_random();
        }
        draw(&source, u, v, &samples);
        for (int k = 0; k < SHADOW_LANES; k++) {
            const lmp_vec3 direction = shadow_lane(&samples.direction, k);
            const double length = (double)samples.length[k], along = dot(d, direction);
            const double from_middle = sqrt(fmax(
                length * length - 2 * length * (double)away * along + (double)away * (double)away,
                0));
            CHECK_WITHIN(fabs(dot(direction, direction) - 1), 1e-5);
            CHECK_WITHIN(fabs(from_middle / (double)r - 1), 2e-3);
            if (away > r)
                CHECK_WITHIN(length, (double)away);
        }
    }
}

/* From the edge of half the sphere of directions on, they are sine and cosine of a fraction of a
 * circle, within the 4e-7 of their series and a rounding. */
static void rays_go_around_the_axis_by_parts_of_a_circle(void **state) {
    (void)state;
    const scene_light hemisphere = { .emitter = { .kind = LMP_LIGHT_CAP,
                                                  .direction = { 0, 0, 1 },
                                                  .angle = (float)acos(0),
                                                  .radiance = { 1, 1, 1 } } };
    const shadow_source source = source_of(&hemisphere);
    shadow_lanes u, v;
    shadow_samples samples;
    for (int i = 0; i < 4096; i += SHADOW_LANES - 1) {
        for (int k = 0; k < SHADOW_LANES; k++) {
            u[k] = 1;
            v[k] = k > 0 ? (float)(i + k - 1) / 4096
                         : 0; /* the first ray is at the beginning of the circle */
        }
        draw(&source, u, v, &samples);
        const lmp_vec3 x = shadow_lane(&samples.direction, 0), y = { -x.y, x.x, 0 };
        for (int k = 1; k < SHADOW_LANES; k++) {
            const lmp_vec3 d = shadow_lane(&samples.direction, k);
            const double angle = 2 * acos(-1) * (double)v[k];
            CHECK_WITHIN(fabs(dot(d, x) - cos(angle)), 4.6e-7);
            CHECK_WITHIN(fabs(fabs(dot(d, y)) - fabs(sin(angle))), 4.6e-7);
        }
    }
}

/* The mean of what rays bring, with the cosine of the light's center, is the irradiance there: pi L
 * sin²a of a sphere and of a cap, I/d² of a point, E of a direction, pi L of a sky. */
static void rays_bring_the_irradiance(void **state) {
    (void)state;
    enum { STEPS = 64 };
    const lmp_vec3 to = { 0.48f, 0.6f, 0.64f };
    const scene_light lights[] = {
        { .emitter = { .position = { 1.44f, 1.8f, 1.92f }, .radius = 1, .radiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_CAP,
                       .direction = to,
                       .angle = 0.4f,
                       .radiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_POINT,
                       .position = { 0.96f, 1.2f, 1.28f },
                       .intensity = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                       .direction = to,
                       .irradiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_CAP,
                       .direction = to,
                       .angle = 1.2f,
                       .radiance = { 1, 2, 4 } } },
    };
    const double pi = acos(-1),
                 expected[] = { pi / 9, pi * pow(sin(0.4), 2), 0.25, 1, pi * pow(sin(1.2), 2) };
    for (int i = 0; i < 5; i++) {
        const shadow_source source = source_of(&lights[i]);
        double sum[3] = { 0, 0, 0 }, across[3] = { 0, 0, 0 };
        for (int step = 0; step < STEPS * STEPS; step += SHADOW_LANES) {
            shadow_lanes u, v;
            shadow_samples samples;
            for (int k = 0; k < SHADOW_LANES; k++) {
                u[k] = ((float)((step + k) / STEPS) + 0.5f) / STEPS;
                v[k] = ((float)((step + k) % STEPS) + 0.5f) / STEPS;
            }
            draw(&source, u, v, &samples);
            for (int k = 0; k < SHADOW_LANES; k++) {
                const double cosine = dot(shadow_lane(&samples.direction, k), to);
                for (int c = 0; c < 3; c++) {
                    sum[c] += (double)samples.arrives.of[c][k] * cosine / (STEPS * STEPS);
                    across[c] += (double)samples.direction.of[c][k] / (STEPS * STEPS);
                }
            }
        }
        const double size =
            sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
        for (int c = 0; c < 3; c++) {
            CHECK_WITHIN(fabs(sum[c] / (expected[i] * (1 << c)) - 1), 1e-3);
            CHECK_WITHIN(fabs(across[c] / size - (double)(&to.x)[c]), 1e-3);
        }
    }
}

/* Sources of every kind side by side bring what each brings alone. */
static void neighbors_do_not_mix(void **state) {
    (void)state;
    const scene_light lights[] = {
        { .emitter = { .position = { 1, 2, 2 }, .radius = 1, .radiance = { 1, 2, 4 } } },
        { .emitter = { .position = { 0.1f, 0, 0 }, .radius = 1, .radiance = { 1, 2, 4 } } },
        { .emitter = { .kind = LMP_LIGHT_CAP,
                       .direction = { 0, 0.6f, 0.8f },
                       .angle = 2,
                       .radiance = { 4, 2, 1 } } },
        { .emitter = { .kind = LMP_LIGHT_SPOT,
                       .position = { 0, 3, 0 },
                       .direction = { 0, -1, 0 },
                       .inner = 0.1f,
                       .outer = 0.3f,
                       .intensity = { 1, 5, 1 } } },
        { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                       .direction = { 0, 0, -1 },
                       .irradiance = { 3, 2, 1 } } },
    };
    enum { COUNT = sizeof lights / sizeof *lights };
    shadow_source made[COUNT];
    const shadow_source *mixed[SHADOW_LANES];
    shadow_vectors positions;
    shadow_lanes u, v;
    shadow_samples together;
    for (int i = 0; i < COUNT; i++)
        made[i] = source_of(&lights[i]);
    for (int i = 0; i < SHADOW_LANES; i++) {
        mixed[i] = &made[i % COUNT];
        shadow_set_lane(&positions, i, i % 2 ? (lmp_vec3) { 0.2f, 0, 0 } : (lmp_vec3) { 0, 0, 0 });
        u[i] = (float)check_random();
        v[i] = (float)check_random();
    }
    shadow_sources_draw(mixed, &positions, NULL, u, v, &together);
    for (int i = 0; i < SHADOW_LANES; i++) {
        const shadow_source *alone[SHADOW_LANES];
        shadow_samples samples;
        for (int k = 0; k < SHADOW_LANES; k++)
            alone[k] = mixed[i];
        shadow_sources_draw(alone, &positions, NULL, u, v, &samples);
        const lmp_vec3 a = shadow_lane(&together.direction, i);
        const lmp_vec3 b = shadow_lane(&samples.direction, i);
        const lmp_vec3 more = shadow_lane(&together.arrives, i);
        const lmp_vec3 less = shadow_lane(&samples.arrives, i);
        assert_memory_equal(&a, &b, sizeof a);
        assert_memory_equal(&more, &less, sizeof more);
        CHECK_WITHIN(fabs(dot(a, a) - 1), 1e-5);
        assert_true(more.x > 0);
        assert_true(isinf(together.length[i]) == (i % COUNT == 2 || i % COUNT == 4));
        assert_true(together.length[i] == samples.length[i]);
    }
}

static const lmp_vec3 stands = { 3, -2, 5 };

/* Fills all lanes with one point: up is z, and the eye is reflected at 50 degrees. */
static void fill_lanes(shadow_points *points, float albedo, float shine, float coat) {
    const lmp_vec3 up = { 0, 0, 1 };
    const lmp_vec3 mirror = { (float)sin(50 * acos(-1) / 180), 0, (float)cos(50 * acos(-1) / 180) };
    memset(points, 0, sizeof *points);
    points->coated = coat > 0;
    for (int i = 0; i < SHADOW_LANES; i++) {
        points->lit[i] = true;
        for (int k = 0; k < 3; k++)
            points->position.of[k][i] = (&stands.x)[k];
        points->albedo[i] = albedo;
        points->shine[i] = shine;
        points->coat[i] = coat;
        points->alpha2[i] = points->coat_alpha2[i] = 0.04f;
        for (int k = 0; k < 3; k++) {
            points->normal.of[k][i] = points->coat_normal.of[k][i] = (&up.x)[k];
            points->mirror.of[k][i] = points->coat_mirror.of[k][i] = (&mirror.x)[k];
        }
    }
}

/* Rays are distributed by what lights are expected to bring: the cosine for small ones, and a lobe,
 * of the surface and of its coat, that falls off with the angle from the mirror direction by its
 * width. */
static void small_lights_weigh_what_is_reflected_of_them(void **state) {
    (void)state;
    const double pi = acos(-1);
    for (int degrees = 2; degrees < 88; degrees += 12) {
        const double angle = degrees * pi / 180, apart = (degrees - 50) * pi / 180;
        const lmp_vec3 w = { (float)sin(angle), 0, (float)cos(angle) };
        const lmp_rgb color = { 1, 2, 6 };
        const scene_light lights[] = {
            { .emitter = { .position = { stands.x + 10 * w.x, stands.y, stands.z + 10 * w.z },
                           .radius = 0.1f,
                           .radiance = color } },
            { .emitter = { .kind = LMP_LIGHT_POINT,
                           .position = { stands.x + 2 * w.x, stands.y, stands.z + 2 * w.z },
                           .intensity = color } },
            { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL, .direction = w, .irradiance = color } },
        };
        const double arrives[] = { 3 * pi * 1e-4, 3 / 4.0, 3 };
        for (int kind = 0; kind < 3; kind++) {
            const shadow_source source = source_of(&lights[kind]);
            shadow_points points;
            shadow_lanes diffuse, shiny, coated;
            fill_lanes(&points, 0.7f, 0, 0);
            shadow_sources_weigh(&source, 1, &points, &diffuse);
            fill_lanes(&points, 0, 0.7f, 0);
            shadow_sources_weigh(&source, 1, &points, &shiny);
            fill_lanes(&points, 0, 0, 0.7f);
            shadow_sources_weigh(&source, 1, &points, &coated);
            const double off = 0.04 + pow(sin(apart / 2), 2);
            const double lobe = arrives[kind] / pi * 0.7 * 0.04 / (4 * off * off);
            for (int i = 0; i < SHADOW_LANES; i++) {
                CHECK_WITHIN(fabs((double)diffuse[i] / (arrives[kind] / pi * 0.7 * cos(angle)) - 1),
                             0.2);
                CHECK_WITHIN(fabs((double)shiny[i] / lobe - 1), 0.05);
                CHECK_WITHIN(fabs((double)coated[i] / lobe - 1), 0.05);
            }
        }
    }
}

/* Makes the octant of a ball as one triangle, whose normals are the ball's or point into it. */
static void bend_triangle(float side, scene *world) {
    static const uint32_t indices[3] = { 0, 1, 2 };
    static const scene_mesh mesh = { .index_count = 3 };
    static const scene_material material = { .roughness = 1 };
    static scene_vertex corners[3];
    memset(corners, 0, sizeof corners);
    for (int i = 0; i < 3; i++) {
        corners[i].position[i] = 1;
        corners[i].normal[i] = side;
    }
    *world = (scene) { .vertices = corners,
                       .indices = indices,
                       .meshes = &mesh,
                       .instances = placed_meshes(1),
                       .materials = &material,
                       .vertex_count = 3,
                       .index_count = 3,
                       .mesh_count = 1,
                       .instance_count = 1,
                       .material_count = 1,
                       .maximum = { 1, 1, 1 } };
}

static const scene_camera camera = { .eye = { 4, 4, 4 } };
static const lmp_shade_settings shading = { .bands = 20, .window = LMP_WINDOW_NONE };

/* Sets points of the bent triangle by their weights, seen from outside, all of one material. */
static void set_points(const scene *world, lmp_vec3 at[SHADOW_LANES], render_tile *row,
                       const lmp_material *material, shadow_points *points) {
    trace_bvh *bvh = trace_create(world);
    const shadow_view view = { .scene = world,
                               .bvh = bvh,
                               .lift = (float)trace_lift(world),
                               .camera = &camera,
                               .settings = shading };
    int pixels[SHADOW_LANES];
    assert_non_null(bvh);
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 eye = vec_load(camera.eye), v = vec_normalize(vec_sub(eye, at[i]), eye);
        pixels[i] = i;
        row->ambient[i] = 1;
        for (int c = 0; c < 3; c++) {
            row->position[c][i] = (&at[i].x)[c];
            row->normal[c][i] = 1 / sqrtf(3);
            row->view[c][i] = (&v.x)[c];
            row->coat_normal[c][i] = 1 / sqrtf(3);
        }
        row->material[i] = *material;
    }
    shadow_points_set(&view, row, NULL, pixels, SHADOW_LANES, points);
    points->settings = &shading; /* the view ends at the point */
    trace_destroy(bvh);
}

static void pick(lmp_vec3 at[SHADOW_LANES]) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float a = 0.02f + 0.96f * (float)check_random(),
                    b = (1 - a) * (0.02f + 0.96f * (float)check_random());
        at[i] = vec(a, b, 1 - a - b);
    }
}

static const lmp_material matte = { .roughness = 1, .base_color = { 1, 1, 1 } };

/* Where corners and normals are those of a ball, rays start on the ball, within what a surface of
 * second degree can follow; on hollow triangles they start on the triangle. */
static void rays_leave_the_surface_that_normals_bend(void **state) {
    render_tile *row = *state;
    for (float side = 1; side >= -1; side -= 2) {
        scene world;
        shadow_points points;
        lmp_vec3 at[SHADOW_LANES];
        pick(at);
        bend_triangle(side, &world);
        set_points(&world, at, row, &matte, &points);
        for (int i = 0; i < SHADOW_LANES; i++) {
            const lmp_vec3 origin = shadow_lane(&points.origin, i);
            const double flat = sqrt(dot(at[i], at[i])), lift = 2 * trace_lift(&world);
            if (side > 0)
                CHECK_WITHIN(fabs(sqrt(dot(origin, origin)) - 1),
                             (1 - flat) * (1 - flat) / 2 + lift);
            else
                CHECK_WITHIN((double)vec_length(vec_sub(origin, at[i])), lift);
        }
    }
}

/* The cost of the coat's lobe is paid where some point has a coat. Straight toward the eye it
 * reflects 4 % of the light, times its weight. */
static void points_are_coated_where_their_material_is(void **state) {
    render_tile *row = *state;
    scene world;
    shadow_points points;
    lmp_vec3 at[SHADOW_LANES];
    for (int i = 0; i < SHADOW_LANES; i++)
        at[i] = vec(1 / 3.0f, 1 / 3.0f, 1 / 3.0f);
    bend_triangle(1, &world);
    set_points(&world, at, row, &matte, &points);
    assert_false(points.coated);
    lmp_material coated = matte;
    coated.coat = (lmp_coat) { .weight = 0.5f, .roughness = 0.3f };
    set_points(&world, at, row, &coated, &points);
    assert_true(points.coated);
    for (int i = 0; i < SHADOW_LANES; i++)
        CHECK_WITHIN(fabsf(points.coat[i] - 0.02f), 1e-5f);
}

/* Lobes of 20 bands under white light: each channel brings what its diffuse lobe reflects, pi times
 * less than the cosine except for what the bands leave out, and nothing from below. */
static void channels_of_series_reflect_what_is_theirs(void **state) {
    render_tile *row = *state;
    scene world;
    shadow_points points;
    shadow_vectors w, k;
    lmp_vec3 at[SHADOW_LANES];
    const float diffuse[3] = { 0.25f, 0.5f, 1 };
    const lmp_material lobes = { .kind = LMP_MATERIAL_LOBES,
                                 .diffuse = { diffuse[0], diffuse[1], diffuse[2] },
                                 .exponent = 1 };
    pick(at);
    bend_triangle(1, &world);
    set_points(&world, at, row, &lobes, &points);
    for (int i = 0; i < SHADOW_LANES; i++)
        shadow_set_lane(&w, i, check_random_direction());
    shadow_reflect(&points, &w, &k);
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 d = shadow_lane(&w, i);
        const double cosine = (double)(d.x + d.y + d.z) / sqrt(3);
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs((double)k.of[c][i] / (double)diffuse[c] - fmax(cosine, 0) / acos(-1)),
                         3e-3);
    }
}

static int make_row(void **state) {
    static render_tile row;
    *state = &row;
    return render_tile_create(SHADOW_LANES, &row) ? 0 : 1;
}

static int free_row(void **state) {
    render_tile_free(*state);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_to_a_sphere_end_on_it),
        cmocka_unit_test(rays_go_around_the_axis_by_parts_of_a_circle),
        cmocka_unit_test(rays_bring_the_irradiance),
        cmocka_unit_test(neighbors_do_not_mix),
        cmocka_unit_test(small_lights_weigh_what_is_reflected_of_them),
        cmocka_unit_test(rays_leave_the_surface_that_normals_bend),
        cmocka_unit_test(points_are_coated_where_their_material_is),
        cmocka_unit_test(channels_of_series_reflect_what_is_theirs),
    };
    return cmocka_run_group_tests(tests, make_row, free_row);
}
