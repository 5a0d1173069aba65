/* SPDX-License-Identifier: MIT */
/* Shaders compute the nodes of a field as the library does. */
#include "app/base/timing.h"
#include "app/render/gl/state.h"
#include "app/render/shade.h"
#include "app/render/shade_field.h"
#include "tests/gpu/difference.h"
#include "tests/oracle/kinds.h"

enum { LIGHTS_MAX = 6000 };

typedef struct fixture {
    scene world;
    gpu_renderer *renderer;
    scene_light lights[LIGHTS_MAX];
    lmp_light emitters[LIGHTS_MAX]; /* the same lights for the library */
    size_t count;
    lmp_field *field;
    uint64_t stamp;
} fixture;
static fixture f;

/* Opens a renderer that computes nodes, on software devices too. */
static void open_fixture(const char *name) {
    base_error error = { "" };
    gpu_context context = device;
    context.computes_fields = true;
    expect(scene_load(name, &(scene_options) { .no_cache = true }, &f.world, &error), &error);
    f.renderer = gpu_renderer_create(&context, &f.world, &error);
    expect(f.renderer != NULL, &error);
    f.count = 0;
}

static void close_fixture(void) {
    gpu_renderer_destroy(f.renderer);
    scene_free(&f.world);
}

static void push(lmp_light light) {
    assert_true(f.count < LIGHTS_MAX);
    f.emitters[f.count] = light;
    f.lights[f.count++] = (scene_light) { .emitter = light };
}

static void push_sphere(lmp_vec3 position, float radius, float radiance) {
    push((lmp_light) { .position = position,
                       .radius = radius,
                       .radiance = { radiance, 0.7f * radiance, 0.2f * radiance } });
}

static lmp_vec3 random_position(float low, float high) {
    return (lmp_vec3) { (float)check_random_between((double)low, (double)high),
                        (float)check_random_between((double)low, (double)high),
                        (float)check_random_between((double)low, (double)high) };
}

/* Adds lights of every kind, on and beside nodes, around some, outside the grid and far away. */
static void push_all(void) {
    for (int i = 0; i < KINDS; i++)
        push(one_of_each_kind[i]);
    for (int i = 0; i < 20; i++)
        push_sphere(random_position(-5, 5), 0.05f, 40);
    push_sphere((lmp_vec3) { 0.2f, 0.1f, -0.1f }, 1.6f, 3);
    push_sphere((lmp_vec3) { 2, 2, 2 }, 0.1f, 20);
    push_sphere((lmp_vec3) { -9, 3, 2 }, 1, 20);
    push_sphere((lmp_vec3) { 60, -80, 300 }, 20, 10);
}

static const lmp_field *the_field(const render_frame *frame, bool nodes, uint64_t *stamp) {
    (void)frame;
    assert_false(nodes);
    *stamp = f.stamp;
    return f.field;
}

static float *read_nodes(size_t bytes, double *milliseconds) {
    base_error error = { "" };
    float *texels = malloc(bytes);
    assert_non_null(texels);
    const render_frame frame = { .lights = f.lights,
                                 .light_count = f.count,
                                 .whole_field = the_field };
    gpu_lights_upload(&f.renderer->lights, frame.lights, frame.light_count);
    expect(gpu_field_bind(&f.renderer->field, &f.renderer->context, &f.renderer->lights, &frame,
                          milliseconds, &error),
           &error);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(f.renderer->field.levels[0].nodes.buffer, 0, (GLsizeiptr)bytes, texels);
    return texels;
}

/* Compares values, and derivatives, by their largest difference relative to the largest value. */
static void compare(const float *library, const float *shader, size_t texels, double error[2]) {
    double largest[2] = { 0, 0 };
    error[0] = error[1] = 0;
    for (size_t i = 0; i < 4 * texels; i++) {
        const int slope = i % 4 > 0;
        assert_true(isfinite(shader[i]));
        error[slope] = fmax(error[slope], fabs((double)shader[i] - (double)library[i]));
        largest[slope] = fmax(largest[slope], fabs((double)library[i]));
    }
    assert_true(largest[0] > 0 && largest[1] > 0);
    error[0] /= largest[0];
    error[1] /= largest[1];
}

/* Checks a grid around the origin, by its levels and bands. */
static void check_nodes(lmp_field_desc desc, int levels) {
    const int *n = desc.nodes;
    const size_t nodes = (size_t)n[0] * (size_t)n[1] * (size_t)n[2];
    const size_t texels = nodes * 3 * LMP_SH_COUNT(desc.bands), bytes = 4 * texels * sizeof(float);
    double error[2], milliseconds;
    int count = 0;
    desc.light_max = f.count;
    assert_int_equal(lmp_field_create(NULL, &desc, &f.field), LMP_OK);
    for (const lmp_field *level = f.field; level; level = lmp_field_coarser_level(level))
        count++;
    assert_int_equal(count, levels);
    const double start = timing_now();
    assert_int_equal(lmp_field_update(NULL, f.field, f.emitters, f.count), LMP_OK);
    const double update = 1e3 * (timing_now() - start);
    f.stamp++;
    float *library = malloc(bytes), *shader = read_nodes(bytes, &milliseconds);
    assert_non_null(library);
    lmp_field_copy_nodes(f.field, 0, nodes, library);
    compare(library, shader, texels, error);
    print_message("%zu nodes in %d levels, %d bands, %zu lights: values %.1e, derivatives %.1e of "
                  "the largest; %.1f ms, the library on one thread %.1f\n",
                  nodes, levels, desc.bands, f.count, error[0], error[1], milliseconds, update);
    CHECK_WITHIN(error[0], 1e-5);
    CHECK_WITHIN(error[1], 1e-5);
    free(library);
    free(shader);
    lmp_field_destroy(f.field);
}

static lmp_field_desc grid(int bands, int x, int y, int z, float cell) {
    return (lmp_field_desc) { .bands = bands,
                              .nodes = { x, y, z },
                              .origin = { -4, -2, -3 },
                              .cell = { cell, 1.1f * cell, 0.9f * cell },
                              .reach = 2 };
}

static void nodes_without_a_coarser_field_are_the_library_s(void **state) {
    (void)state;
    static const int bands[] = { 1, 3, 5, 10 };
    open_fixture("builtin:ball");
    push_all();
    for (int i = 0; i < 4; i++)
        check_nodes(grid(bands[i], 9, 7, 6, 1), 1);
    close_fixture();
}

/* Adds large lights, so many that a coarser field's lists have no room for each in every block. */
static void push_large(void) {
    for (int i = 0; i < 30; i++)
        push_sphere(random_position(-2, 2), 2.5f, 2);
}

/* Counts the lights that fade but are near everywhere in a coarser field. */
static size_t count_everywhere(const lmp_field_desc *desc) {
    static uint32_t begin[4096], lights[1 << 16];
    lmp_field *field;
    assert_int_equal(lmp_field_create(NULL, desc, &field), LMP_OK);
    assert_int_equal(lmp_field_reset(field, f.emitters, f.count), LMP_OK);
    const lmp_field *coarse = lmp_field_coarser_level(field);
    const lmp_field_info info = lmp_field_describe(coarse);
    const int *n = info.desc.nodes, blocks = n[0] / 2 * (n[1] / 2) * (n[2] / 2);
    size_t count = 0;
    assert_true(blocks + 2 <= 4096 &&
                lmp_field_copy_lists(coarse, 1 << 16, begin, lights) <= 1 << 16);
    for (uint32_t i = begin[blocks]; i < begin[blocks + 1]; i++)
        count += f.emitters[lights[i]].kind == LMP_LIGHT_SPHERE;
    lmp_field_destroy(field);
    return count;
}

static void nodes_of_coarser_fields_are_the_library_s(void **state) {
    (void)state;
    static const int bands[] = { 1, 3, 5, 10 };
    open_fixture("builtin:ball");
    push_all();
    for (int i = 0; i < 4; i++)
        check_nodes(grid(bands[i], 15, 14, 13, 0.6f), 2);
    push_large();
    lmp_field_desc fine = grid(3, 30, 27, 25, 0.3f);
    fine.light_max = f.count;
    assert_true(count_everywhere(&fine) > 0);
    check_nodes(fine, 3);
    close_fixture();
}

static void no_light_and_lights_of_other_kinds_leave_nodes_dark(void **state) {
    (void)state;
    const lmp_field_desc desc = grid(2, 14, 14, 13, 1);
    enum { TEXELS = 14 * 14 * 13 * 3 * 4 };
    open_fixture("builtin:ball");
    for (int lit = 0; lit < 2; lit++) {
        assert_int_equal(lmp_field_create(NULL, &desc, &f.field), LMP_OK);
        if (lit)
            push(one_of_each_kind[LMP_LIGHT_HEMISPHERE]);
        assert_int_equal(lmp_field_reset(f.field, f.emitters, f.count), LMP_OK);
        f.stamp++;
        float *shader = read_nodes(4 * TEXELS * sizeof(float), NULL);
        for (size_t i = 0; i < (size_t)4 * TEXELS; i++)
            assert_true(shader[i] == 0);
        free(shader);
        lmp_field_destroy(f.field);
    }
    close_fixture();
}

/* There are more lights than a thread takes at once, in all and in one list. */
static void thousands_of_lights_all_count(void **state) {
    (void)state;
    open_fixture("builtin:ball");
    for (int i = 0; i < LIGHTS_MAX; i++)
        push_sphere(random_position(-4, -3), 0.01f, 5);
    check_nodes(grid(2, 4, 4, 4, 1), 1);
    check_nodes(grid(2, 13, 13, 13, 1), 2);
    close_fixture();
}

static void a_grid_of_full_size_is_the_library_s(void **state) {
    (void)state;
    open_fixture("builtin:ball");
    for (int i = 0; i < check_count(100, 4000); i++)
        push_sphere(random_position(-4, 12), 0.05f, 5);
    check_nodes(grid(5, 40, 32, 32, 0.4f), 3);
    close_fixture();
}

/* Lights at rest cost nothing: the nodes of a stamp are kept, whatever the lights are. */
static void nodes_are_computed_where_lights_have_changed(void **state) {
    (void)state;
    const lmp_field_desc desc = grid(3, 9, 7, 6, 1);
    const size_t bytes = (size_t)9 * 7 * 6 * 27 * 4 * sizeof(float);
    open_fixture("builtin:ball");
    push_all();
    assert_int_equal(lmp_field_create(NULL, &desc, &f.field), LMP_OK);
    assert_int_equal(lmp_field_reset(f.field, f.emitters, f.count), LMP_OK);
    f.stamp++;
    float *before = read_nodes(bytes, NULL);
    for (size_t i = 0; i < f.count; i++)
        f.lights[i].emitter.position.x += 0.3f;
    float *kept = read_nodes(bytes, NULL);
    assert_memory_equal(before, kept, bytes);
    f.stamp++;
    float *after = read_nodes(bytes, NULL);
    assert_memory_not_equal(before, after, bytes);
    free(before);
    free(kept);
    free(after);
    lmp_field_destroy(f.field);
    close_fixture();
}

/* Both devices read one field, of which the library computes the nodes that it needs. */
static void frames_by_computed_nodes_are_those_of_the_library(void **state) {
    (void)state;
    base_error error = { "" };
    const shade_field_options options = { .error = SHADE_FIELD_ERROR, .moves = true };
    open_fixture("builtin:balls");
    push_all();
    render_frame frame = frame_of(&f.world, 120, 68);
    frame.bands = 3;
    frame.method = METHOD_FIELD;
    frame.lights = f.lights;
    shade_field *field = shade_field_create(&f.world, &options, frame.bands, &error);
    expect(field != NULL, &error);
    shade_field_attach(field, &frame);
    for (size_t step = 0; step < 3; step++) {
        frame.light_count = f.count - (step == 2 ? 1 : 0);
        f.lights[10 + step].emitter.position.y += 0.5f;
        image on_device = render_image(f.renderer, &frame);
        image again = render_image(f.renderer, &frame);
        frame.cpu_shader = shade_frame;
        image on_cpu = render_image(f.renderer, &frame);
        frame.cpu_shader = NULL;
        assert_memory_equal(on_device.rgb, again.rgb, sizeof(float[3 * 120 * 68]));
        expect_same("computed nodes", differ(&on_device, &on_cpu));
        image_free(&on_device);
        image_free(&again);
        image_free(&on_cpu);
    }
    shade_field_destroy(field);
    close_fixture();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_without_a_coarser_field_are_the_library_s),
        cmocka_unit_test(nodes_of_coarser_fields_are_the_library_s),
        cmocka_unit_test(no_light_and_lights_of_other_kinds_leave_nodes_dark),
        cmocka_unit_test(thousands_of_lights_all_count),
        cmocka_unit_test(a_grid_of_full_size_is_the_library_s),
        cmocka_unit_test(nodes_are_computed_where_lights_have_changed),
        cmocka_unit_test(frames_by_computed_nodes_are_those_of_the_library),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
