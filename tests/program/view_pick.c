/* SPDX-License-Identifier: MIT */
/* What the pointer picks, against all triangles one by one: what the image shows, and nothing
 * else. */
#include "app/scene/instance.h"
#include "app/scene/vector.h"
#include "tests/program/view.h"

/* --- a scene with what must not be picked ----------------------------------------------------- */

enum { PLATE, WALL, LEAF, HAZE, WING, MESHES, QUADS = 4, VERTICES = 4 * QUADS + 3 };

static scene_vertex vertices[VERTICES];
static uint32_t indices[6 * QUADS + 3];
static scene_mesh meshes[MESHES];
static scene_material materials[MESHES];

/* The wing is shown as it is and mirrored; both show their fronts to +z. */
static const scene_instance instances[] = {
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } }, PLATE },
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } }, WALL },
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } }, LEAF },
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } }, HAZE },
    { { { 1, 0, 0, 1.5f }, { 0, 1, 0, -1 }, { 0, 0, 1, 0.5f } }, WING },
    { { { -1, 0, 0, -1.5f }, { 0, 1, 0, -1 }, { 0, 0, 1, 0.5f } }, WING },
};

static void set_vertex(uint32_t at, float x, float y, float z, float alpha) {
    vertices[at] = (scene_vertex) { .position = { x, y, z },
                                    .normal = { 0, 0, 1 },
                                    .tangent = { 1, 0, 0, 1 },
                                    .color = { 65535, 65535, 65535, (uint16_t)(65535 * alpha) } };
}

static void add_mesh(uint32_t number, uint32_t flags, uint32_t first, uint32_t count) {
    scene_mesh *mesh = &meshes[number];
    *mesh = (scene_mesh) { .first_index = first, .index_count = count, .material = number };
    materials[number] =
        (scene_material) { .base_color = { 1, 1, 1, 1 }, .roughness = 1, .flags = flags };
    materials[number].alpha_cutoff = 0.5f;
    for (int i = 0; i < SCENE_MAPS; i++)
        materials[number].maps[i].texture = -1;
    for (int k = 0; k < 3; k++) {
        mesh->minimum[k] = INFINITY;
        mesh->maximum[k] = -INFINITY;
        for (uint32_t i = first; i < first + count; i++) {
            mesh->minimum[k] = fminf(mesh->minimum[k], vertices[indices[i]].position[k]);
            mesh->maximum[k] = fmaxf(mesh->maximum[k], vertices[indices[i]].position[k]);
        }
    }
}

/* A square across z, whose alpha grows from 0 at the left to 1 at the right where it is cut or
 * blended; `toward`: whether its front is toward +z. */
static void add_square(uint32_t number, uint32_t flags, float half, float z, bool toward) {
    static const uint32_t corners[2][6] = { { 0, 2, 1, 2, 0, 3 }, { 0, 1, 2, 2, 3, 0 } };
    for (uint32_t i = 0; i < 4; i++) {
        const bool right = i == 1 || i == 2;
        set_vertex(4 * number + i, right ? half : -half, i < 2 ? -half : half, z, right ? 1 : 0);
    }
    for (uint32_t i = 0; i < 6; i++)
        indices[6 * number + i] = 4 * number + corners[toward][i];
    add_mesh(number, flags, 6 * number, 6);
}

static int open_walls(void **unused) {
    if (open_state(unused) != 0)
        return -1;
    base_error error;
    view_settings *const now = &state.now;
    now->camera = (scene_camera) { .eye = { 0, 0, 6 }, .up = { 0, 1, 0 }, .fov = 0.8f };
    static scene walls;
    static view_tree *grown;
    view_tree_end(grown);
    add_square(PLATE, 0, 2, -2, true);
    add_square(WALL, 0, 2, 1, false);
    add_square(LEAF, SCENE_ALPHA_MASK | SCENE_DOUBLE_SIDED | SCENE_VERTEX_COLORS, 1, 3, true);
    add_square(HAZE, SCENE_ALPHA_BLEND | SCENE_VERTEX_COLORS, 1.5f, 2, true);
    set_vertex(4 * QUADS, 0, 0, 0, 1);
    set_vertex(4 * QUADS + 1, 1.5f, 0, 0.3f, 1);
    set_vertex(4 * QUADS + 2, 0.5f, 1.5f, 0.5f, 1);
    for (uint32_t i = 0; i < 3; i++)
        indices[6 * QUADS + i] = 4 * QUADS + i;
    add_mesh(WING, 0, 6 * QUADS, 3);
    walls = (scene) {
        .vertices = vertices,
        .indices = indices,
        .meshes = meshes,
        .instances = instances,
        .materials = materials,
        .vertex_count = VERTICES,
        .index_count = sizeof indices / sizeof *indices,
        .mesh_count = MESHES,
        .instance_count = sizeof instances / sizeof *instances,
        .material_count = MESHES,
        .minimum = { -2, -2, -2 },
        .maximum = { 2, 2, 3 },
        .name = "walls",
    };
    grown = view_tree_begin(&walls, &error);
    state.world = &walls;
    state.tree = grown;
    return grown ? 0 : -1;
}

/* --- every triangle --------------------------------------------------------------------------- */

typedef struct met {
    int mesh;
    double distance, normal[3];
    bool doubtful; /* whether an edge, of a triangle or of what is cut, is near */
} met;

static void cross(const double a[3], const double b[3], double c[3]) {
    for (int k = 0; k < 3; k++)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Replaces what was met by a triangle of an instance if that is nearer and shown (Möller and
 * Trumbore 1997). */
static void meet(size_t number, uint32_t triangle, const double from[3], const double along[3],
                 met *nearest) {
    const scene_material *m = &materials[instances[number].mesh];
    const scene_vertex *corner[3];
    float at[3][3];
    double a[3], b[3], s[3], normal[3], h[3], q[3], alpha = 0;
    scene_triangle_positions(state.world, number, triangle, at);
    scene_triangle_vertices(state.world, number, triangle, corner);
    for (int k = 0; k < 3; k++) {
        a[k] = (double)at[1][k] - (double)at[0][k];
        b[k] = (double)at[2][k] - (double)at[0][k];
        s[k] = from[k] - (double)at[0][k];
    }
    cross(a, b, normal);
    cross(along, b, h);
    cross(s, a, q);
    const double det = dot(a, h), u = dot(s, h) / det, v = dot(along, q) / det;
    const double inside = fmin(fmin(u, v), 1 - u - v), distance = dot(b, q) / det;
    if (!(inside > -1e-5) || !(distance > 0) || distance > nearest->distance + 1e-4)
        return;
    if (dot(normal, along) > 0 && !(m->flags & SCENE_DOUBLE_SIDED))
        return;
    const double weights[3] = { 1 - u - v, u, v };
    for (int i = 0; i < 3; i++)
        alpha += weights[i] * (double)corner[i]->color[3] / 65535;
    const bool cut = m->flags & (SCENE_ALPHA_MASK | SCENE_ALPHA_BLEND);
    const bool doubtful = inside < 1e-5 || (cut && fabs(alpha - 0.5) < 1e-3);
    if (!doubtful && cut && alpha < 0.5)
        return;
    *nearest = (met) { (int)instances[number].mesh, distance, { 0 }, doubtful };
    for (int k = 0; k < 3; k++)
        nearest->normal[k] =
            normal[k] / sqrt(dot(normal, normal)) * (dot(normal, along) > 0 ? -1 : 1);
}

static met meet_all(const view_ray *ray) {
    const double from[3] = { (double)ray->from.x, (double)ray->from.y, (double)ray->from.z };
    const double along[3] = { (double)ray->direction.x, (double)ray->direction.y,
                              (double)ray->direction.z };
    met nearest = { -1, (double)INFINITY, { 0 }, false };
    for (size_t i = 0; i < state.world->instance_count; i++)
        for (uint32_t t = 0; t < scene_instance_triangles(state.world, i); t++)
            meet(i, t, from, along, &nearest);
    return nearest;
}

static void the_pointer_picks_what_the_image_shows(void **unused) {
    (void)unused;
    int picked[MESHES + 1] = { 0 };
    for (int i = 0; i < check_count(20000, 1000000); i++) {
        scene_camera camera = state.now.camera;
        for (int k = 0; k < 3; k++) {
            camera.eye[k] = (float)check_random_between(-6, 6);
            camera.target[k] = (float)check_random_between(-2, 2);
        }
        camera.height = i % 3 ? 0 : 4;
        const view_ray ray = view_ray_through(&camera, 640, 480, check_random_between(0, 640),
                                              check_random_between(0, 480));
        const met expected = meet_all(&ray);
        if (expected.doubtful)
            continue;
        const view_hit hit = view_pick_surface(&ray, state.tree);
        assert_int_equal(hit.mesh, expected.mesh);
        picked[hit.mesh + 1]++;
        if (hit.mesh < 0)
            continue;
        CHECK_NEAR(expected.distance, hit.distance, 1e-4);
        CHECK_NEAR(expected.normal[0], hit.normal.x, 1e-5);
        CHECK_NEAR(expected.normal[1], hit.normal.y, 1e-5);
        CHECK_NEAR(expected.normal[2], hit.normal.z, 1e-5);
        assert_true(vec_dot(hit.normal, ray.direction) <= 0);
        assert_true(vec_dot(hit.normal, hit.smooth) >= 0);
    }
    for (int i = 0; i <= MESHES; i++)
        assert_true(picked[i] > 50);
}

/* What a camera's planes clip is not picked. */
static void clipped_surfaces_are_not_picked(void **unused) {
    (void)unused;
    scene_camera camera = state.now.camera;
    for (int parallel = 0; parallel < 2; parallel++) {
        camera.height = parallel ? 6 : 0;
        /* beside the middle, through the solid halves of leaf and haze, off to the side */
        const double x = parallel ? 360 : 380;
        camera.near = camera.far = 0;
        view_ray ray = view_ray_through(&camera, 640, 480, x, 250);
        assert_int_equal(view_pick_surface(&ray, state.tree).mesh, LEAF);
        camera.near = 3.01f; /* the leaf is 3 before the eye, as a depth */
        ray = view_ray_through(&camera, 640, 480, x, 250);
        assert_int_equal(view_pick_surface(&ray, state.tree).mesh, HAZE);
        camera.near = 4.01f;
        camera.far = 7.99f;
        ray = view_ray_through(&camera, 640, 480, x, 250);
        assert_int_equal(view_pick_surface(&ray, state.tree).mesh, -1);
        camera.far = 8.01f;
        ray = view_ray_through(&camera, 640, 480, x, 250);
        assert_int_equal(view_pick_surface(&ray, state.tree).mesh, PLATE);
    }
}

/* A new light lies over the plate behind the wall that is not drawn, and beside what is cut out of
 * the leaf. */
static void a_new_light_lies_over_what_is_seen(void **unused) {
    (void)unused;
    at(300, 240);
    key("n");
    const lmp_light *light = &state.now.lights[state.selected].emitter;
    CHECK_NEAR(-2 + 3 * light->radius, light->position.z, 1e-4);
    at(340, 240);
    key("n");
    light = &state.now.lights[state.selected].emitter;
    CHECK_NEAR(3 + 3 * light->radius, light->position.z, 1e-4);
}

#define WALLS_TEST(function) cmocka_unit_test_setup_teardown(function, open_walls, close_state)

int main(void) {
    const struct CMUnitTest tests[] = {
        WALLS_TEST(the_pointer_picks_what_the_image_shows),
        WALLS_TEST(clipped_surfaces_are_not_picked),
        WALLS_TEST(a_new_light_lies_over_what_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
