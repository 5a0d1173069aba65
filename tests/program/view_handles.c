/* SPDX-License-Identifier: MIT */
/* Handles of the selected light: where a drag of one leaves the light, to the pixel. */
#include "app/scene/vector.h"
#include "app/view/handles.h"
#include "tests/program/view.h"

static view_marks marks;

/* Puts one light of a kind where it is seen, and selects it. */
static lmp_light *put_light(lmp_light_kind kind, lmp_vec3 position) {
    lmp_light light = scene_light_model(kind, 1, 8);
    light.position = position;
    state.now.light_count = 1;
    state.now.lights[0] = (scene_light) { .emitter = light };
    state.selected = 0;
    view_history_keep(&state.history, &state.now, state.numbers);
    return &state.now.lights[0].emitter;
}

static bool project(lmp_vec3 point, double *x, double *y) {
    double scale;
    return view_project(&state.now.camera, 640, 480, point, x, y, &scale);
}

static float between(double low, double high) {
    return (float)check_random_between(low, high);
}

/* Looks from somewhere, with parallel rays or not, and puts a light before the eye. */
static lmp_light *look(int i, lmp_light_kind kind) {
    const float away = between(4, 7);
    const lmp_vec3 to = vec_normalize(vec(between(-1, 1), between(-0.5, 0.5), 1), vec(0, 0, 1));
    const lmp_vec3 position = vec(between(-1, 1), between(0, 2), between(-1, 1));
    vec_store(vec_add(position, vec_scale(to, away)), state.now.camera.eye);
    vec_store(vec(position.x + between(-0.4, 0.4), position.y, position.z),
              state.now.camera.target);
    state.now.camera.height = i % 2 ? 5 : 0;
    return put_light(kind, position);
}

/* Finds the last mark of a handle: an arrow's head comes after its shaft. */
static const view_mark *find_mark(view_handle_kind handle) {
    const view_mark *found = NULL;
    view_find_marks(&state, &marks);
    for (int i = 0; i < marks.count; i++)
        if (marks.of[i].handle == handle)
            found = &marks.of[i];
    return found;
}

/* Returns the middle of a mark. */
static void middle_of(const view_mark *mark, double *x, double *y) {
    *x = *y = 0;
    for (int i = 0; i < mark->count; i++) {
        *x += (double)mark->at[i][0] / mark->count;
        *y += (double)mark->at[i][1] / mark->count;
    }
}

static void press_at(double x, double y) {
    at(x, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
}

/* Grabs a handle at a place of it; returns false if another one, or nothing, is there. */
static bool grab(view_handle_kind handle, double *x, double *y) {
    const view_mark *mark = find_mark(handle);
    if (!mark)
        return false;
    *x = (double)mark->at[0][0];
    *y = (double)mark->at[0][1];
    if (mark->shape == UI_FILLED)
        middle_of(mark, x, y);
    press_at(*x, *y);
    return state.drag == VIEW_DRAG_HANDLE && state.grip.handle == handle;
}

static void let_go(void) {
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

/* --- moves ------------------------------------------------------------------------------------ */

/* Returns the parameter at which a line is nearest to a pixel in the image. */
static double parameter_at(lmp_vec3 from, lmp_vec3 axis, double x, double y) {
    double low = -3, high = 3, nearest = 0;
    for (int round = 0; round < 4; round++) {
        double best = HUGE_VAL;
        const double step = (high - low) / 400;
        for (int i = 0; i <= 400; i++) {
            double px, py;
            const double t = low + i * step;
            if (project(vec_add(from, vec_scale(axis, (float)t)), &px, &py) &&
                hypot(px - x, py - y) < best) {
                best = hypot(px - x, py - y);
                nearest = t;
            }
        }
        low = nearest - 2 * step;
        high = nearest + 2 * step;
    }
    return nearest;
}

static void arrows_move_lights_along_axes_by_pixels(void **unused) {
    (void)unused;
    double worst = 0, x, y, end_x, end_y, x0, y0, x1, y1;
    int count = 0;
    for (int i = 0; i < check_count(120, 3000); i++) {
        const lmp_light *light = look(i, LMP_LIGHT_SPHERE);
        const lmp_vec3 before = light->position;
        const int k = i % 3;
        lmp_vec3 axis = { 0, 0, 0 };
        (&axis.x)[k] = 1;
        if (!grab(VIEW_HANDLE_X + (unsigned)k, &x, &y)) {
            let_go();
            continue;
        }
        const double grabbed = parameter_at(before, axis, x, y);
        assert_true(project(vec_add(before, vec_scale(axis, (float)grabbed)), &x0, &y0));
        assert_true(project(vec_add(before, vec_scale(axis, (float)grabbed + 0.1f)), &x1, &y1));
        const double length = hypot(x1 - x0, y1 - y0), pixels = check_random_between(-60, 60);
        end_x = x + pixels * (x1 - x0) / length;
        end_y = y + pixels * (y1 - y0) / length;
        at(77, 33); /* its way does not count */
        at(end_x, end_y);
        let_go();
        for (int other = 0; other < 3; other++)
            if (other != k)
                CHECK_NEAR((&before.x)[other], (&light->position.x)[other], 0);
        const float moved = (&light->position.x)[k] - (&before.x)[k];
        if (fabsf(moved) > 2) /* nearly along the view */
            continue;
        assert_true(project(vec_add(before, vec_scale(axis, (float)grabbed + moved)), &x1, &y1));
        worst = fmax(worst, hypot(x1 - end_x, y1 - end_y));
        count++;
        assert_true(project(before, &x0, &y0) && project(light->position, &x1, &y1));
        if (state.now.camera.height > 0)
            CHECK_NEAR(fabs(pixels), hypot(x1 - x0, y1 - y0), 0.1);
    }
    print_message("within %.3f pixels, %d drags\n", worst, count);
    assert_true(count > 80);
    CHECK_WITHIN(worst, 1);
}

static void squares_follow_the_pointer_exactly(void **unused) {
    (void)unused;
    int count = 0;
    for (int i = 0; i < check_count(120, 3000); i++) {
        const lmp_light *light = look(i, LMP_LIGHT_SPHERE);
        const lmp_vec3 before = light->position;
        const int k = i % 3;
        double x, y, x1, y1;
        if (!grab(VIEW_HANDLE_YZ + (unsigned)k, &x, &y)) {
            let_go();
            continue;
        }
        const view_ray ray = view_ray_through(&state.now.camera, 640, 480, x, y);
        const float along =
            ((&before.x)[k] - (&ray.from.x)[k]) / (&ray.direction.x)[k]; /* to the plane */
        const lmp_vec3 point = vec_add(ray.from, vec_scale(ray.direction, along));
        const double to_x = x + check_random_between(-20, 20),
                     to_y = y + check_random_between(-20, 20);
        at(to_x, to_y);
        let_go();
        CHECK_NEAR((&before.x)[k], (&light->position.x)[k], 1e-5);
        assert_true(project(vec_add(point, vec_sub(light->position, before)), &x1, &y1));
        CHECK_NEAR(to_x, x1, 0.05);
        CHECK_NEAR(to_y, y1, 0.05);
        count++;
    }
    assert_true(count > 60);
}

/* --- sizes ------------------------------------------------------------------------------------ */

/* Returns whether the light is met by the ray through a pixel. */
static bool is_met(double x, double y) {
    float distance;
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, x, y);
    return view_pick_light(&ray, state.now.lights, 1, 0, &distance) == 0;
}

static void the_ring_gives_the_radius_that_is_seen_at_the_pointer(void **unused) {
    (void)unused;
    int count = 0;
    for (int i = 0; i < check_count(60, 2000); i++) {
        lmp_light *light = look(i, LMP_LIGHT_SPHERE);
        light->radius = between(0.5, 1.5);
        const float power = light->radiance.r * light->radius * light->radius;
        double x, y, cx, cy;
        if (!grab(VIEW_HANDLE_SIZE, &x, &y)) { /* an arrow crosses the ring there */
            let_go();
            continue;
        }
        count++;
        assert_true(is_met(x + 0.5, y - 0.5) && !is_met(x - 0.5, y + 0.5)); /* at lower left */
        assert_true(project(light->position, &cx, &cy));
        const double angle = check_random_between(0, 6.28), far = check_random_between(40, 150);
        const double out_x = cos(angle), out_y = sin(angle);
        at(cx + far * out_x, cy + far * out_y);
        let_go();
        assert_true(is_met(cx + (far - 0.5) * out_x, cy + (far - 0.5) * out_y));
        assert_false(is_met(cx + (far + 0.5) * out_x, cy + (far + 0.5) * out_y));
        CHECK_NEAR(power, light->radiance.r * light->radius * light->radius, 1e-4 * (double)power);
        key("Ctrl+Z");
        CHECK_NEAR(0.096f, light->radius, 1e-6); /* the model's, as it was kept */
    }
    assert_true(count > 40);
}

/* A light too small to see has a ring that can be grabbed, and grows with it in proportion. */
static void small_lights_have_a_ring_too(void **unused) {
    (void)unused;
    double x, y, cx, cy;
    lmp_light *light = put_light(LMP_LIGHT_SPHERE, vec(0, 1, 2));
    light->radius = 0.01f;
    assert_true(grab(VIEW_HANDLE_SIZE, &x, &y));
    assert_true(project(light->position, &cx, &cy));
    at(cx + 3 * (x - cx), cy + 3 * (y - cy));
    CHECK_NEAR(0.03f, light->radius, 0.001);
    at(cx, cy);
    assert_true(light->radius > 0);
    let_go();
    press_at(cx, cy); /* within the ring the light itself is dragged */
    assert_int_equal(state.drag, VIEW_DRAG_LIGHT);
    let_go();
}

/* Returns the distance of the ray through the pointer from a tube's axis. */
static double miss_axis(const lmp_light *tube) {
    const view_ray ray = view_pointer_ray(&state);
    double nearest = HUGE_VAL;
    for (int i = -20000; i <= 20000; i++) {
        const lmp_vec3 point = vec_add(tube->position, vec_scale(tube->half[0], (float)i / 10000));
        const lmp_vec3 way = vec_cross(vec_sub(point, ray.from), ray.direction);
        nearest = fmin(nearest, (double)vec_length(way));
    }
    return nearest;
}

/* Sides, axes and radii end under the pointer, whatever else of the light stays. */
static void knobs_follow_the_pointer(void **unused) {
    (void)unused;
    static const struct {
        lmp_light_kind kind;
        view_handle_kind handle;
    } knobs[] = { { LMP_LIGHT_RECTANGLE, VIEW_HANDLE_WIDTH },
                  { LMP_LIGHT_RECTANGLE, VIEW_HANDLE_HEIGHT },
                  { LMP_LIGHT_TUBE, VIEW_HANDLE_WIDTH },
                  { LMP_LIGHT_TUBE, VIEW_HANDLE_RADIUS } };
    for (size_t i = 0; i < sizeof knobs / sizeof *knobs; i++) {
        lmp_light *light = put_light(knobs[i].kind, vec(0, 0, 2));
        light->half[0] = vec(0.6f, 0.2f, 0);
        if (light->kind == LMP_LIGHT_RECTANGLE)
            light->half[1] = vec(-0.2f, 0.5f, 0.1f);
        light->radius = 0.6f;
        const lmp_light before = *light;
        double x, y, cx, cy, x1, y1;
        state.now.camera.eye[2] = 7;
        assert_true(grab(knobs[i].handle, &x, &y));
        assert_true(project(light->position, &cx, &cy));
        at(cx + 1.5 * (x - cx), cy + 1.5 * (y - cy));
        let_go();
        if (knobs[i].handle == VIEW_HANDLE_RADIUS) { /* where the tube's outline is seen */
            CHECK_NEAR(light->radius, miss_axis(light), 1e-3);
        } else {
            view_find_marks(&state, &marks);
            double nearest = HUGE_VAL;
            for (int m = 0; m < marks.count; m++)
                if (marks.of[m].handle == knobs[i].handle) {
                    middle_of(&marks.of[m], &x1, &y1);
                    nearest = fmin(nearest, hypot(x1 - state.x, y1 - state.y));
                }
            CHECK_WITHIN(nearest, 1);
        }
        CHECK_NEAR(1,
                   light->radiance.r / before.radiance.r *
                       lmp_light_radiance_from_power(&before, 1) /
                       lmp_light_radiance_from_power(light, 1),
                   1e-4);
        if (knobs[i].handle != VIEW_HANDLE_WIDTH)
            assert_memory_equal(&before.half[0], &light->half[0], sizeof before.half[0]);
        if (knobs[i].handle != VIEW_HANDLE_RADIUS)
            CHECK_NEAR(before.radius, light->radius, 0);
    }
}

/* --- directions and angles -------------------------------------------------------------------- */

/* Lights of every kind with a direction turn to where the tip is dragged. */
static void tips_are_dragged_to_any_direction(void **unused) {
    (void)unused;
    scene_light_error wrong;
    int kinds = 0;
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++) {
        const lmp_light *light = put_light((lmp_light_kind)kind, vec(0.3f, 1, 2));
        double x, y, x1, y1;
        if (!find_mark(VIEW_HANDLE_DIRECTION))
            continue;
        kinds++;
        state.now.camera.eye[1] = 3; /* no axis along the view */
        scene_light_rotate_between(&state.now.lights[0].emitter, scene_light_axis(light),
                                   vec_normalize(vec(0.4f, 0.5f, 0.9f), vec(0, 1, 0)));
        const float extent = scene_light_extent(light);
        assert_true(grab(VIEW_HANDLE_DIRECTION, &x, &y));
        at(x + 30, y + 25);
        let_go();
        middle_of(find_mark(VIEW_HANDLE_DIRECTION), &x1, &y1);
        CHECK_WITHIN(hypot(x + 30 - x1, y + 25 - y1), 5); /* a head's middle is before its tip */
        assert_true(scene_light_axis(light).z > 0);
        assert_true(scene_light_check(&state.now.lights[0], &wrong));
        CHECK_NEAR(extent, scene_light_extent(light), 1e-5);
        assert_true(grab(VIEW_HANDLE_DIRECTION, &x, &y)); /* around to the other side */
        at(x + 250, y);
        let_go();
        assert_true(scene_light_axis(light).z < 0);
        assert_true(scene_light_check(&state.now.lights[0], &wrong));
    }
    assert_int_equal(kinds, 8);
}

static void a_sun_is_exactly_where_its_tip_is(void **unused) {
    (void)unused;
    double x, y, x1, y1;
    put_light(LMP_LIGHT_DIRECTIONAL, vec(0, 0, 0));
    for (int i = 0; i < 50; i++) {
        const double to_x = 320 + check_random_between(-80, 80);
        const double to_y = 240 + check_random_between(-80, 80);
        assert_true(grab(VIEW_HANDLE_DIRECTION, &x, &y));
        at(to_x, to_y);
        let_go();
        middle_of(find_mark(VIEW_HANDLE_DIRECTION), &x1, &y1);
        CHECK_NEAR(to_x, x1, 0.05);
        CHECK_NEAR(to_y, y1, 0.05);
    }
}

/* Returns the distance of the pointer from the circle of a handle. */
static double off_circle(view_handle_kind handle) {
    const view_mark *mark = find_mark(handle);
    double nearest = HUGE_VAL;
    for (int i = 0; i < mark->count; i++)
        nearest = fmin(nearest,
                       hypot((double)mark->at[i][0] - state.x, (double)mark->at[i][1] - state.y));
    return nearest;
}

static void cones_open_to_the_pointer(void **unused) {
    (void)unused;
    double x, y;
    lmp_light *light = put_light(LMP_LIGHT_SPOT, vec(0, 1, 2));
    assert_true(grab(VIEW_HANDLE_OUTER, &x, &y));
    const float before = light->outer;
    double cx, cy;
    assert_true(project(light->position, &cx, &cy));
    at(x - 0.3 * (x - cx), y);
    CHECK_WITHIN(off_circle(VIEW_HANDLE_OUTER), 4); /* between two of its points */
    assert_true(fabsf(light->outer - before) > 0.05f);
    at(cx + 140, cy + 140); /* farther out than the circle can be, by the direction alone */
    CHECK_NEAR(0.25 * 3.14159265, light->outer, 0.05);
    at(cx, cy + 160);
    CHECK_WITHIN(light->outer, 0.3);
    assert_true(light->inner <= light->outer); /* pushed by the outer one */
    let_go();
    light->outer = 0.8f;
    light->inner = 0.5f;
    assert_true(grab(VIEW_HANDLE_INNER, &x, &y));
    at(x + 0.1 * (x - cx), y - 30);
    CHECK_WITHIN(off_circle(VIEW_HANDLE_INNER), 4);
    assert_true(light->inner > 0.55f);
    at(x + 5 * (x - cx), y);
    CHECK_NEAR(0.8, light->inner, 1e-6); /* no farther than the outer one */
    let_go();
    light = put_light(LMP_LIGHT_CAP, vec(0, 0, 0));
    light->angle = 0;
    assert_true(grab(VIEW_HANDLE_ANGLE, &x, &y));
    at(x - 20, y);
    assert_true(light->angle > 0.05f && light->angle < 0.3f);
    let_go();
}

/* --- steps ------------------------------------------------------------------------------------ */

static bool is_multiple(double value, double step) {
    return fabs(value / step - round(value / step)) < 1e-3;
}

static void hold_ctrl(bool down) {
    view_handle(&state, &(view_event) { .kind = down ? VIEW_HOLD : VIEW_FREE, .letter = 'c' });
}

static void ctrl_gives_multiples(void **unused) {
    (void)unused;
    double x, y;
    const double step = view_handle_step(&state);
    lmp_light *light = put_light(LMP_LIGHT_SPHERE, vec(0.123f, 1.234f, 2.345f));
    state.now.camera.eye[0] = 3;
    state.now.origin[0] = 1000.04;
    const lmp_vec3 before = light->position;
    const int moments = state.history.count;
    assert_true(grab(VIEW_HANDLE_X, &x, &y));
    at(x + 33, y);
    assert_false(is_multiple(1000.04 + (double)light->position.x, step));
    hold_ctrl(true); /* without a move of the pointer */
    assert_true(is_multiple(1000.04 + (double)light->position.x, step));
    CHECK_NEAR(before.x, light->position.x, 1);
    CHECK_NEAR(before.y, light->position.y, 0);
    hold_ctrl(false);
    assert_false(is_multiple(1000.04 + (double)light->position.x, step));
    hold_ctrl(true);
    let_go();
    assert_int_equal(state.history.count, moments + 1);
    key("Ctrl+Z");
    assert_memory_equal(&before, &light->position, sizeof before);
    assert_true(grab(VIEW_HANDLE_XY, &x, &y));
    at(x + 33, y + 12);
    let_go();
    assert_true(is_multiple(1000.04 + (double)light->position.x, step) &&
                is_multiple((double)light->position.y, step));
    CHECK_NEAR(before.z, light->position.z, 1e-6);
    assert_true(grab(VIEW_HANDLE_SIZE, &x, &y));
    at(x - 33, y);
    let_go();
    assert_true(is_multiple((double)light->radius, step) && light->radius > 0);
    light = put_light(LMP_LIGHT_SPOT, vec(0, 1, 2));
    assert_true(grab(VIEW_HANDLE_DIRECTION, &x, &y));
    at(x + 70, y - 40);
    let_go();
    assert_true(is_multiple(asin((double)light->direction.y) * 36, 3.14159265));
    assert_true(is_multiple(atan2((double)light->direction.z, (double)light->direction.x) * 36,
                            3.14159265));
    assert_true(grab(VIEW_HANDLE_OUTER, &x, &y));
    at(x + 23, y);
    let_go();
    assert_true(is_multiple((double)light->outer * 36, 3.14159265));
    view_handle(&state, &(view_event) { .kind = VIEW_FREE }); /* the window lost the focus */
    assert_false(state.held[6]);
}

/* The step follows the scene's size: a tenth of its unit. */
static void steps_suit_the_scene(void **unused) {
    (void)unused;
    static const double sizes[][2] = { { 0.01, 1e-4 }, { 1, 0.01 }, { 9, 0.1 }, { 400, 10 } };
    for (int i = 0; i < 4; i++) {
        const scene sized = { .maximum = { (float)sizes[i][0], 0, 0 } };
        state.world = &sized;
        CHECK_NEAR(sizes[i][1], view_handle_step(&state), 1e-9);
    }
    state.world = &world;
}

/* Wherever a handle is dragged, a file written then can be read again, and one step undoes it. */
static void any_drag_leaves_a_light_that_files_take(void **unused) {
    (void)unused;
    scene_light_error wrong;
    int grabbed[VIEW_HANDLES] = { 0 };
    for (int i = 0; i < check_count(600, 20000); i++) {
        const scene_light *light = &state.now.lights[0];
        look(i, (lmp_light_kind)(i % SCENE_LIGHT_KIND_COUNT));
        const scene_light before = *light;
        view_find_marks(&state, &marks);
        const view_mark *mark = &marks.of[(int)check_random_between(0, marks.count)];
        const int point = (int)check_random_between(0, mark->count);
        press_at((double)mark->at[point][0], (double)mark->at[point][1]);
        if (state.drag == VIEW_DRAG_HANDLE)
            grabbed[state.grip.handle]++;
        for (int step = 0; step < 8 && state.drag == VIEW_DRAG_HANDLE; step++) {
            hold_ctrl(step % 3 == 0);
            at(check_random_between(-300, 940), check_random_between(-300, 780));
            if (!scene_light_check(light, &wrong))
                fail_msg("%s%s, by its %s", scene_light_kinds[light->emitter.kind].name, wrong.text,
                         view_handle_names[state.grip.handle]);
        }
        let_go();
        hold_ctrl(false);
        if (memcmp(&before, light, sizeof before) != 0)
            key("Ctrl+Z");
        assert_memory_equal(&before, light, sizeof before);
    }
    for (int handle = 1; handle < VIEW_HANDLES; handle++)
        if (grabbed[handle] == 0)
            fail_msg("the %s was never dragged", view_handle_names[handle]);
}

/* --- whose drag it is ------------------------------------------------------------------------- */

static void handles_come_before_lights_and_lights_before_surfaces(void **unused) {
    (void)unused;
    double x, y;
    put_light(LMP_LIGHT_SPHERE, vec(0, 1, 2));
    state.now.camera.eye[0] = 2;
    assert_true(grab(VIEW_HANDLE_X, &x, &y));
    let_go();
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, x, y);
    state.now.light_count = 2; /* another one under the arrow */
    state.now.lights[1] = state.now.lights[0];
    state.now.lights[1].emitter.position = vec_add(ray.from, vec_scale(ray.direction, 6));
    press_at(x, y);
    assert_int_equal(state.drag, VIEW_DRAG_HANDLE);
    assert_int_equal(state.selected, 0);
    let_go();
    key("Ctrl+H");
    assert_false(state.handles);
    view_find_marks(&state, &marks);
    assert_int_equal(marks.count, 1); /* the ring is there, but no handle */
    assert_int_equal(marks.of[0].handle, VIEW_HANDLE_NONE);
    press_at(x, y);
    assert_int_equal(state.drag, VIEW_DRAG_LIGHT);
    assert_int_equal(state.selected, 1);
    let_go();
    key("Ctrl+H");
    state.selected = 0;
    key("1"); /* what an aim drags lies under the handles */
    view_find_marks(&state, &marks);
    assert_int_equal(view_handle_at_pointer(&state, &marks), VIEW_HANDLE_NONE);
    key("1");
    assert_true(grab(VIEW_HANDLE_X, &x, &y));
    const float before = state.now.lights[0].emitter.position.x;
    key("+"); /* what changes the light otherwise lets go of it */
    at(x + 40, y);
    CHECK_NEAR(before, state.now.lights[0].emitter.position.x, 0);
    let_go();
    assert_true(grab(VIEW_HANDLE_X, &x, &y));
    at(x + 40, y);
    let_go();
    assert_true(state.now.lights[0].emitter.position.x > before);
}

/* Returns the length of the shaft, which is before the arrow's head. */
static double arrow_length(void) {
    const view_mark *head = find_mark(VIEW_HANDLE_Y), *shaft = head ? head - 1 : NULL;
    return head ? hypot((double)(shaft->at[1][0] - shaft->at[0][0]),
                        (double)(shaft->at[1][1] - shaft->at[0][1]))
                : 0;
}

static void handles_have_the_same_pixels_at_any_distance(void **unused) {
    (void)unused;
    memset(state.now.camera.target, 0, sizeof state.now.camera.target);
    put_light(LMP_LIGHT_SPHERE, vec(0, 0, 2));
    const double near = arrow_length();
    state.now.lights[0].emitter.position.z = -60;
    CHECK_NEAR(near, arrow_length(), 0.1);
    CHECK_NEAR(66, near, 0.1);
    state.scale = 2;
    CHECK_NEAR(132, arrow_length(), 0.1);
    state.now.lights[0].emitter.position.z = 30; /* behind the eye */
    CHECK_NEAR(0, arrow_length(), 0);
    assert_int_equal(marks.count, 0);
}

static void hidden_lights_are_told_and_stand_over_a_surface(void **unused) {
    (void)unused;
    double x, y, foot_x, foot_y;
    view_tree_wait(tree);
    put_light(LMP_LIGHT_POINT, vec(0, 0, 6));
    view_find_marks(&state, &marks);
    assert_false(marks.hidden);
    const lmp_vec3 over = vec(0.2f, world.maximum[1] + 1, 0);
    const view_ray down = { over, { 0, -1, 0 }, .far = INFINITY };
    const view_hit hit = view_pick_surface(&down, tree);
    assert_true(hit.mesh >= 0);
    put_light(LMP_LIGHT_POINT, over);
    view_find_marks(&state, &marks);
    assert_true(project(over, &x, &y));
    assert_true(project(vec(over.x, over.y - hit.distance, 0), &foot_x, &foot_y));
    CHECK_NEAR(x, marks.of[0].at[0][0], 1e-3);
    CHECK_NEAR(foot_x, marks.of[0].at[1][0], 1e-2);
    CHECK_NEAR(foot_y, marks.of[0].at[1][1], 1e-2);
    const view_ray middle = view_ray_through(&state.now.camera, 640, 480, 320, 240);
    const view_hit front = view_pick_surface(&middle, tree);
    assert_true(front.mesh >= 0);
    put_light(LMP_LIGHT_POINT,
              vec_add(middle.from, vec_scale(middle.direction, front.distance + 0.2f)));
    view_find_marks(&state, &marks);
    assert_true(marks.hidden);
    assert_true(grab(VIEW_HANDLE_X, &x, &y)); /* through the surface */
    let_go();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(arrows_move_lights_along_axes_by_pixels),
        TEST(squares_follow_the_pointer_exactly),
        TEST(the_ring_gives_the_radius_that_is_seen_at_the_pointer),
        TEST(small_lights_have_a_ring_too),
        TEST(knobs_follow_the_pointer),
        TEST(tips_are_dragged_to_any_direction),
        TEST(a_sun_is_exactly_where_its_tip_is),
        TEST(cones_open_to_the_pointer),
        TEST(ctrl_gives_multiples),
        TEST(steps_suit_the_scene),
        TEST(any_drag_leaves_a_light_that_files_take),
        TEST(handles_come_before_lights_and_lights_before_surfaces),
        TEST(handles_have_the_same_pixels_at_any_distance),
        TEST(hidden_lights_are_told_and_stand_over_a_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
