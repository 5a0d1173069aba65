/* SPDX-License-Identifier: MIT */
/* Aiming lights by dragging over surfaces: by the law of reflection, and in images. */
#include "app/render/renderer/renderer.h"
#include "app/scene/vector.h"
#include "app/view/aim.h"
#include "tests/program/view.h"

/* --- bodies with known normals ---------------------------------------------------------------- */

enum {
    RINGS = 256,
    SPOKES = 256,
    POINTS = (RINGS + 1) * (SPOKES + 1),
    CORNERS = 6 * RINGS * SPOKES
};

static scene_vertex vertices[POINTS];
static uint32_t indices[CORNERS];
static scene_mesh mesh;
static scene_material material;
static const scene_instance instance = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } }, 0 };
static scene body;
static view_tree *body_tree;

/* A point of a body and its normal, by parameters 0 … 1. */
typedef void surface(double u, double v, double point[3], double normal[3]);

/* A surface that a profile sweeps around y: its radius and height at u, and their derivatives. */
static void revolve(double radius, double height, double radius_u, double height_u, double v,
                    double point[3], double normal[3]) {
    const double angle = 2 * 3.14159265358979 * v, length = hypot(radius_u, height_u);
    const double out = -height_u / length, up = radius_u / length;
    point[0] = radius * sin(angle);
    point[1] = height;
    point[2] = radius * cos(angle);
    normal[0] = out * sin(angle);
    normal[1] = up;
    normal[2] = out * cos(angle);
}

static void sphere(double u, double v, double point[3], double normal[3]) {
    const double angle = 3.14159265358979 * (0.001 + 0.998 * u);
    revolve(sin(angle), cos(angle), cos(angle), -sin(angle), v, point, normal);
}

/* From the mouth down: a neck, shoulders, and a belly. */
static void bottle(double u, double v, double point[3], double normal[3]) {
    const double height = 1 - 2 * u, step = tanh(5 * (0.3 - height));
    const double radius_h = -0.2 * 5 * (1 - step * step);
    revolve(0.45 + 0.2 * step, height, -2 * radius_h, -2, v, point, normal);
}

/* A square that leans back. */
static void plate(double u, double v, double point[3], double normal[3]) {
    const double across = 3 * v - 1.5, along = 1.5 - 3 * u;
    point[0] = across;
    point[1] = 0.6 * along;
    point[2] = -0.8 * along;
    normal[0] = 0;
    normal[1] = 0.8;
    normal[2] = 0.6;
}

static void open_body(surface *shape) {
    base_error error;
    for (int i = 0; i < POINTS; i++) {
        double point[3], normal[3];
        shape((double)(i / (SPOKES + 1)) / RINGS, (double)(i % (SPOKES + 1)) / SPOKES, point,
              normal);
        vertices[i] = (scene_vertex) { .tangent = { 1, 0, 0, 1 } };
        for (int k = 0; k < 3; k++) {
            vertices[i].position[k] = (float)point[k];
            vertices[i].normal[k] = (float)normal[k];
        }
    }
    for (uint32_t i = 0; i < RINGS * SPOKES; i++) {
        const uint32_t a = i / SPOKES * (SPOKES + 1) + i % SPOKES, b = a + SPOKES + 1;
        const uint32_t corners[6] = { a, b, a + 1, a + 1, b, b + 1 };
        memcpy(indices + 6 * (size_t)i, corners, sizeof corners);
    }
    mesh = (scene_mesh) { .index_count = CORNERS,
                          .minimum = { -1.5f, -1.5f, -1.5f },
                          .maximum = { 1.5f, 1.5f, 1.5f } };
    material = (scene_material) {
        .name = "metal", .base_color = { 1, 1, 1, 1 }, .metallic = 1, .roughness = 0.1f, .f90 = 1
    };
    for (int i = 0; i < SCENE_MAPS; i++)
        material.maps[i].texture = -1;
    body = (scene) { .vertices = vertices,
                     .indices = indices,
                     .meshes = &mesh,
                     .instances = &instance,
                     .materials = &material,
                     .vertex_count = POINTS,
                     .index_count = CORNERS,
                     .mesh_count = 1,
                     .instance_count = 1,
                     .material_count = 1,
                     .minimum = { -1.5f, -1.5f, -1.5f },
                     .maximum = { 1.5f, 1.5f, 1.5f },
                     .name = "body" };
    view_tree_end(body_tree);
    body_tree = view_tree_begin(&body, &error);
    assert_non_null(body_tree);
    state.world = &body;
    state.tree = body_tree;
    state.now.width = state.now.height = 256;
    state.now.camera = (scene_camera) { .eye = { 0.5f, 1, 5 }, .up = { 0, 1, 0 }, .fov = 0.6f };
}

static int close_body(void **unused) {
    view_tree_end(body_tree);
    body_tree = NULL;
    return close_state(unused);
}

/* --- lights ----------------------------------------------------------------------------------- */

/* Puts one small light of a kind beside the body, and selects it. */
static lmp_light *put_light(lmp_light_kind kind) {
    lmp_light light = scene_light_model(kind, 1, 0.5f);
    light.position = vec(2, 3, 2);
    state.now.light_count = 1;
    state.now.lights[0] = (scene_light) { .emitter = light, .hidden = 1 };
    scene_light_resize(&state.now.lights[0].emitter,
                       0.02f / fmaxf(scene_light_extent(&light), 0.02f));
    if (kind == LMP_LIGHT_CAP)
        state.now.lights[0].emitter.angle = 0.01f;
    state.selected = 0;
    return &state.now.lights[0].emitter;
}

static void drag(double x, double y) {
    at(x, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

/* Finds the point of a unit sphere under the pointer: its normal is the point. */
static bool point_on_sphere(double x, double y, lmp_vec3 *point, lmp_vec3 *view) {
    const view_ray ray = view_ray_through(&state.now.camera, 256, 256, x, y);
    const float half = vec_dot(ray.from, ray.direction);
    const float square = half * half - vec_dot(ray.from, ray.from) + 1;
    if (!(square > 0))
        return false;
    *point = vec_add(ray.from, vec_scale(ray.direction, -half - sqrtf(square)));
    *view = vec_scale(ray.direction, -1);
    return true;
}

static float between(lmp_vec3 a, lmp_vec3 b) {
    return vec_length(vec_sub(a, b));
}

/* The light lies where a mirror, the normal or a grazing direction wants it, as far away as
 * before. */
static void lights_go_where_the_aim_says(void **unused) {
    (void)unused;
    open_body(sphere);
    int aimed[VIEW_AIMS] = { 0 };
    for (int i = 0; i < check_count(300, 20000); i++) {
        const lmp_light *light = put_light(LMP_LIGHT_SPHERE);
        const double x = check_random_between(0, 256), y = check_random_between(0, 256);
        const view_aim aim = (view_aim)(1 + i % (VIEW_AIMS - 1));
        lmp_vec3 n, v;
        state.now.camera.height = i % 2 ? 2.5f : 0;
        if (!point_on_sphere(x, y, &n, &v) || vec_dot(n, v) < 0.3f)
            continue;
        const float distance = between(light->position, n);
        state.aim = aim;
        drag(x, y);
        const lmp_vec3 way = vec_sub(light->position, n);
        const lmp_vec3 l = vec_normalize(way, vec(0, 0, 0));
        CHECK_NEAR(distance, vec_length(way), 2e-3);
        if (aim == VIEW_AIM_REFLECTION) /* the normal halves the angle between light and eye */
            CHECK_NEAR(0, between(vec_normalize(vec_add(l, v), v), n), 1e-3);
        if (aim == VIEW_AIM_ILLUMINATION)
            CHECK_NEAR(0, between(l, n), 1e-3);
        if (aim == VIEW_AIM_RIM) {
            CHECK_NEAR(sin(15 * 3.14159265 / 180), vec_dot(l, n), 2e-3);
            /* in the plane of the view and the normal, and beyond the silhouette */
            CHECK_NEAR(0, vec_dot(l, vec_normalize(vec_cross(n, v), n)), 5e-3);
            assert_true(vec_dot(l, vec_sub(v, vec_scale(n, vec_dot(n, v)))) < 0);
        }
        aimed[aim]++;
    }
    for (int aim = 1; aim < VIEW_AIMS; aim++)
        assert_true(aimed[aim] > 20);
}

/* Returns how an area's parts lie to each other, which turning must not change. */
static double shape_of(const lmp_light *light) {
    const int count = light->kind == LMP_LIGHT_POLYGON ? light->corner_count
                      : light->kind == LMP_LIGHT_TUBE  ? 1
                                                       : 2;
    double sum = 0;
    for (int i = 0; i < count; i++)
        for (int k = 0; k <= i; k++)
            sum += (1 + i + 2 * k) * (double)vec_dot(light->corner[i], light->corner[k]);
    return sum;
}

/* Every kind lights the point: what has a front shows it, suns and skies come from there. */
static void lights_of_every_kind_turn_to_the_point(void **unused) {
    (void)unused;
    open_body(sphere);
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++) {
        lmp_light *light = put_light((lmp_light_kind)kind);
        const bool moves = scene_light_has(&state.now.lights[0], SCENE_LIGHT_POSITION);
        const double shape = shape_of(light);
        scene_light_error wrong;
        lmp_vec3 n, v;
        assert_true(point_on_sphere(140, 100, &n, &v));
        state.aim = VIEW_AIM_ILLUMINATION;
        drag(140, 100);
        assert_true(scene_light_check(&state.now.lights[0], &wrong));
        CHECK_NEAR(shape, shape_of(light), 1e-5 * fabs(shape));
        if (!moves)
            CHECK_NEAR(0, between(light->direction, n), 1e-3);
        else
            CHECK_NEAR(0, between(vec_normalize(vec_sub(light->position, n), v), n), 1e-3);
        const lmp_rgb there = lmp_light_irradiance(light, 1, n, n);
        if (kind == LMP_LIGHT_TUBE)
            CHECK_NEAR(0, vec_dot(vec_normalize(light->half[0], n), n), 1e-3);
        if (kind == LMP_LIGHT_SPOT || kind == LMP_LIGHT_DISK)
            CHECK_NEAR(0, between(light->direction, vec_scale(n, -1)), 1e-3);
        if (scene_light_is_area(light)) { /* which turned any other way would give less */
            for (int k = 0; k < 3; k++) {
                lmp_light other = *light;
                lmp_vec3 by = { 0, 0, 0 };
                (&by.x)[k] = 0.3f;
                const lmp_vec3 to = vec_normalize(vec_add(vec_scale(n, -1), by), n);
                view_aim_light(&other, vec_sub(other.position, vec_scale(to, -1)),
                               vec_scale(to, -1), 1);
                other.position = light->position;
                if (kind != LMP_LIGHT_TUBE)
                    assert_true(lmp_light_irradiance(&other, 1, n, n).r < there.r);
            }
        }
        assert_true(there.r > 0);
    }
}

/* A light that shines from both sides shows the one that is nearer to the point already. */
static void lights_turn_as_little_as_it_takes(void **unused) {
    (void)unused;
    open_body(sphere);
    for (int side = -1; side <= 1; side += 2) {
        lmp_light *light = put_light(LMP_LIGHT_DISK);
        lmp_vec3 n, v;
        assert_true(point_on_sphere(128, 128, &n, &v));
        light->direction = vec_normalize(vec((float)side * 0.5f, (float)side, 0), n);
        light->two_sided = true;
        const lmp_vec3 before = light->direction;
        state.aim = VIEW_AIM_ILLUMINATION;
        drag(128, 128);
        CHECK_NEAR(1, fabsf(vec_dot(light->direction, n)), 1e-5);
        assert_true(vec_dot(light->direction, before) > 0);
    }
    /* one that shines from one side and shows its back takes half a turn */
    lmp_light *light = put_light(LMP_LIGHT_DISK);
    lmp_vec3 n, v;
    assert_true(point_on_sphere(128, 128, &n, &v));
    light->direction = n;
    drag(128, 128);
    CHECK_NEAR(0, between(light->direction, vec_scale(n, -1)), 1e-3);
}

/* A drag is one step to undo, whatever its way, and the wheel changes the distance. */
static void a_drag_ends_the_same_whatever_its_way(void **unused) {
    (void)unused;
    open_body(sphere);
    scene_light ends[2], before = { .hidden = 0 };
    for (int way = 0; way < 2; way++) {
        put_light(LMP_LIGHT_RECTANGLE);
        view_history_keep(&state.history, &state.now, state.numbers);
        before = state.now.lights[0];
        state.aim = VIEW_AIM_REFLECTION;
        at(128, 128);
        button(VIEW_PRESS, VIEW_LEFT, false);
        for (int i = 0; i < 20 && way; i++)
            at(128 + 50 * sin(0.4 * i), 128 + 50 * cos(0.3 * i));
        at(1, 1); /* off the body it stays */
        const scene_light there = state.now.lights[0];
        at(2, 1);
        assert_memory_equal(&there, &state.now.lights[0], sizeof there);
        at(150, 120);
        button(VIEW_RELEASE, VIEW_LEFT, false);
        ends[way] = state.now.lights[0];
        key("Ctrl+Z");
        assert_memory_equal(&before, &state.now.lights[0], sizeof before);
        key("Ctrl+Y");
        assert_memory_equal(&ends[way], &state.now.lights[0], sizeof before);
    }
    assert_memory_equal(&ends[0], &ends[1], sizeof ends[0]);
    lmp_vec3 n, v;
    at(150, 120);
    assert_true(point_on_sphere(150, 120, &n, &v));
    button(VIEW_PRESS, VIEW_LEFT, false);
    view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 1 });
    button(VIEW_RELEASE, VIEW_LEFT, false);
    CHECK_NEAR((double)between(ends[1].emitter.position, n) / 0.88,
               between(state.now.lights[0].emitter.position, n), 2e-3);
}

/* Without a light, or beside the body, the camera moves as ever, and a selected light stays so. */
static void elsewhere_the_camera_moves(void **unused) {
    (void)unused;
    open_body(sphere);
    put_light(LMP_LIGHT_SPHERE);
    key("1");
    assert_int_equal(state.aim, VIEW_AIM_REFLECTION);
    const scene_light before = state.now.lights[0];
    at(1, 1);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.drag, VIEW_DRAG_ORBIT);
    assert_int_equal(state.selected, 0);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    key("Escape");
    at(128, 128);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.drag, VIEW_DRAG_ORBIT);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    key("3");
    assert_int_equal(state.aim, VIEW_AIM_RIM);
    assert_non_null(strstr(state.message, "select a light"));
    key("3");
    assert_int_equal(state.aim, VIEW_AIM_OFF);
    view_handle(&state, &(view_event) { .kind = VIEW_SET, .text = "view/aim illumination" });
    view_handle(&state, &(view_event) { .kind = VIEW_SET, .text = "view/aim illumination" });
    assert_int_equal(state.aim, VIEW_AIM_ILLUMINATION);
    view_handle(&state, &(view_event) { .kind = VIEW_SET, .text = "view/aim off" });
    assert_int_equal(state.aim, VIEW_AIM_OFF);
    assert_memory_equal(&before, &state.now.lights[0], sizeof before);
}

/* --- images ----------------------------------------------------------------------------------- */

/* Draws what the state shows on the CPU and finds the brightest pixel within a reach of the
 * pointer. */
static void find_highlight(double reach, double *x, double *y) {
    base_error error;
    render_device device;
    image drawn;
    const render_frame frame = { .width = 256,
                                 .height = 256,
                                 .camera = state.now.camera,
                                 .method = METHOD_ZONAL,
                                 .bands = 100,
                                 .lights = state.now.lights,
                                 .light_count = state.now.light_count,
                                 .samples = 1 };
    assert_true(render_device_open_cpu(&body, view_tree_wait(body_tree), &device, &error));
    any_renderer *renderer = renderer_create(&device, &error);
    assert_non_null(renderer);
    assert_true(renderer_draw(renderer, &frame, NULL, &error));
    assert_true(renderer_read_image(renderer, &drawn, &error));
    float brightest = -1;
    for (int i = 0; i < 256 * 256; i++) {
        const double column = i % 256 + 0.5, row = i / 256 + 0.5;
        if (hypot(column - state.x, row - state.y) <= reach && drawn.rgb[3 * i] > brightest) {
            brightest = drawn.rgb[3 * i];
            *x = column;
            *y = row;
        }
    }
    image_free(&drawn);
    renderer_destroy(renderer);
    render_device_close(&device);
}

/* A bottle has several highlights, of which that under the pointer need not be the brightest: there
 * a maximum must be near, which is none if the brightest pixel is at the end of the reach. */
static void highlights_lie_under_the_pointer(void **unused) {
    (void)unused;
    surface *const shapes[] = { sphere, plate, bottle };
    static const lmp_light_kind kinds[] = { LMP_LIGHT_SPHERE, LMP_LIGHT_CAP, LMP_LIGHT_RECTANGLE };
    static const double positions[][2] = { { 128, 128 }, { 105, 145 }, { 140, 101 }, { 111, 175 } };
    double worst = 0;
    for (int s = 0; s < 3; s++) {
        open_body(shapes[s]);
        for (int kind = 0; kind < 3; kind++)
            for (int i = 0; i < check_count(2, 4); i++) {
                const double *there = positions[(i + kind + s) % 4];
                double x, y;
                put_light(kinds[kind]);
                state.aim = VIEW_AIM_REFLECTION;
                drag(there[0], there[1]);
                find_highlight(shapes[s] == bottle ? 10 : 256, &x, &y);
                const double off = hypot(x - there[0], y - there[1]);
                worst = fmax(worst, off);
                CHECK_WITHIN(off, 2);
            }
    }
    print_message("highlights within %.2f pixels\n", worst);
}

#define BODY_TEST(function) cmocka_unit_test_setup_teardown(function, open_state, close_body)

int main(void) {
    const struct CMUnitTest tests[] = {
        BODY_TEST(lights_go_where_the_aim_says),
        BODY_TEST(lights_of_every_kind_turn_to_the_point),
        BODY_TEST(lights_turn_as_little_as_it_takes),
        BODY_TEST(a_drag_ends_the_same_whatever_its_way),
        BODY_TEST(elsewhere_the_camera_moves),
        BODY_TEST(highlights_lie_under_the_pointer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
