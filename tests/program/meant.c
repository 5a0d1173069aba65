/* SPDX-License-Identifier: MIT */
/* A file is drawn as its author meant it: sides, opacity and light where formats leave or say
 * little. */
#include "app/scene/scene.h"
#include "app/scene/trace/trace.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <math.h>

#define CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* Whether a ray along z, from this side, hits the triangle. */
static bool is_seen(const scene *world, float from) {
    trace_bvh *bvh = trace_create(world);
    assert_non_null(bvh);
    const trace_hit hit = trace_nearest(bvh, TRACE_CAMERA, (const float[3]) { 0.2f, 0.2f, from },
                                        (const float[3]) { 0, 0, -from });
    trace_destroy(bvh);
    return hit.instance != TRACE_NOTHING;
}

/* Returns the z of a triangle's normal by the order of its corners. */
static double facing(const scene *world) {
    const float *a = world->vertices[world->indices[0]].position;
    const float *b = world->vertices[world->indices[1]].position;
    const float *c = world->vertices[world->indices[2]].position;
    return (double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

static void a_format_without_sides_culls_none(void **state) {
    (void)state;
    static const char *const files[] = { CORNERS "f 1 2 3\n", CORNERS "f 1 3 2\n",
                                         "mtllib m.mtl\n" CORNERS "usemtl m\nf 1 3 2\n" };
    folder_write_text("m.mtl", "newmtl m\nKd 1 1 1\n");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        folder_write_text("m.obj", files[i]);
        scene world = load(in_folder("m.obj"));
        assert_true(is_seen(&world, 1) && is_seen(&world, -1));
        scene_free(&world);
    }
    folder_write_text("m.stl", "solid s\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\n"
                               "vertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid s\n");
    scene world = load(in_folder("m.stl"));
    assert_true(is_seen(&world, 1) && is_seen(&world, -1));
    scene_free(&world);
}

/* Both sides are lit by their own normals, so the front must be where the given normals point. */
static void clockwise_triangles_follow_their_normals(void **state) {
    (void)state;
    for (int clockwise = 0; clockwise < 2; clockwise++)
        for (int back = 0; back < 2; back++) {
            char text[256];
            snprintf(text, sizeof text, CORNERS "vn 0 0 %d\nf 1//1 %s\n", back ? -1 : 1,
                     clockwise ? "3//1 2//1" : "2//1 3//1");
            folder_write_text("n.obj", text);
            scene world = load(in_folder("n.obj"));
            assert_true(world.vertices[0].normal[2] == (back ? -1 : 1));
            assert_true(back ? facing(&world) < 0 : facing(&world) > 0);
            scene_free(&world);
        }
}

/* The lamp's power is area · pi · radiance, as before, although both sides are seen. */
static void a_lamp_of_an_obj_shines_by_one_side(void **state) {
    (void)state;
    folder_write_text("m.mtl", "newmtl m\nKe 3 3 3\n");
    folder_write_text("l.obj", "mtllib m.mtl\n" CORNERS "usemtl m\nf 1 2 3\n");
    scene world = load(in_folder("l.obj"));
    assert_int_equal(world.light_count, 1);
    const lmp_light *light = &world.lights[0].emitter;
    const double power = (double)lmp_light_power_from_radiance(light, light->radiance.g);
    assert_false(light->two_sided);
    CHECK_WITHIN(fabs(power / (0.5 * M_PI * 3) - 1), 1e-5);
    scene_free(&world);
}

/* Normals are made from products of edges, which overflow or vanish in float32 long before the
 * coordinates do; and the camera stands as far away as the model is large. */
static void a_model_of_any_size_has_its_normals_and_is_framed(void **state) {
    (void)state;
    static const double sizes[] = { 1, 1e9, 1e12, 1e-7, 1e-12 };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char text[256];
        snprintf(text, sizeof text, "v 0 0 0\nv %g 0 0\nv 0 0 %g\nf 1 2 3\n", sizes[i], -sizes[i]);
        folder_write_text("size.obj", text);
        scene world = load(in_folder("size.obj"));
        const scene_camera camera = scene_default_camera(&world, 1);
        double square = 0;
        for (int k = 0; k < 3; k++)
            square += pow(((double)camera.eye[k] - (double)camera.target[k]) / sizes[i], 2);
        CHECK_WITHIN(fabs((double)world.vertices[0].normal[1] - 1), 1e-6);
        CHECK_WITHIN(fabs((double)world.vertices[0].tangent[1]), 1e-6);
        assert_true(square > 1 && square < 16);
        scene_free(&world);
    }
    /* The triangle is upright, where a default normal would point along it. */
    folder_write_text("size.obj", "v 0 0 0\nv 1e12 0 0\nv 0 1e12 0\nf 1 2 3\n");
    scene world = load(in_folder("size.obj"));
    CHECK_WITHIN(fabs((double)world.vertices[0].normal[2] - 1), 1e-6);
    scene_free(&world);
}

static void a_cutoff_above_1_hides_the_surface(void **state) {
    (void)state;
    static const char *const cutoffs[] = { "1", "1.5", "100" };
    for (size_t i = 0; i < sizeof cutoffs / sizeof *cutoffs; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
                 "\"mesh\":0}],"
                 "\"materials\":[{\"alphaMode\":\"MASK\",\"alphaCutoff\":%s}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
                 "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                 "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
                 "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}",
                 cutoffs[i]);
        folder_write_text("c.gltf", text);
        scene world = load(in_folder("c.gltf"));
        assert_int_equal(is_seen(&world, 1), i == 0);
        scene_free(&world);
    }
}

/* Returns what is reported of a scene in which one thing is unsupported; "" if nothing
 * is. */
static const char *told_of(const scene *world) {
    static char said[256];
    said[0] = 0;
    assert_true(world->unsupported_count <= 1);
    if (world->unsupported_count == 1)
        scene_unsupported_text(world->unsupported, said, sizeof said);
    return said;
}

static void an_opacity_of_0_is_told(void **state) {
    (void)state;
    folder_write_text("m.mtl", "newmtl m\nKd 1 1 1\nd 0\nnewmtl n\n");
    folder_write_text("d.obj", "mtllib m.mtl\n" CORNERS "usemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n");
    scene world = load(in_folder("d.obj"));
    assert_string_equal(told_of(&world), "invisible by d 0 (1 material)");
    assert_true(world.materials[world.meshes[0].material].base_color[3] == 0);
    scene_free(&world);
}

/* An empty image is never meant. */
static void what_would_all_be_invisible_is_opaque(void **state) {
    (void)state;
    folder_write_text("m.mtl", "newmtl m\nKd 1 1 1\nd 0\n");
    folder_write_text("d.obj", "mtllib m.mtl\n" CORNERS "usemtl m\nf 1 2 3\n");
    scene world = load(in_folder("d.obj"));
    assert_string_equal(told_of(&world), "opacity 0 of all there is (1 material)");
    assert_true(is_seen(&world, 1));
    scene_free(&world);
}

/* Tr is 1 - d, but some exporters write 1 for opaque; d is unambiguous. */
static void a_transparency_of_1_is_none(void **state) {
    (void)state;
    static const struct {
        const char *statements;
        float opacity;
    } cases[] = { { "Tr 1", 1 },
                  { "Tr 0.25", 0.75f },
                  { "Tr 0", 1 },
                  { "d 0.5\nTr 1", 0.5f },
                  { "Tr 1\nd 0.5", 0.5f } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[64];
        snprintf(text, sizeof text, "newmtl m\n%s\n", cases[i].statements);
        folder_write_text("m.mtl", text);
        folder_write_text("d.obj", "mtllib m.mtl\n" CORNERS "usemtl m\nf 1 2 3\n");
        scene world = load(in_folder("d.obj"));
        assert_true(world.materials[world.meshes[0].material].base_color[3] == cases[i].opacity);
        assert_string_equal(told_of(&world), "");
        scene_free(&world);
    }
}

/* Colors of vertices are unsupported in any case. */
static void a_color_of_a_vertex_need_be_no_number(void **state) {
    (void)state;
    folder_write_text("v.obj", "v 0 0 0 nan nan nan\nv 1 0 0 1 1 1\nv 0 1 0 inf 0 -\nf 1 2 3\n");
    scene world = load(in_folder("v.obj"));
    assert_string_equal(told_of(&world), "3 vertex colors");
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_format_without_sides_culls_none),
        cmocka_unit_test(clockwise_triangles_follow_their_normals),
        cmocka_unit_test(a_lamp_of_an_obj_shines_by_one_side),
        cmocka_unit_test(a_model_of_any_size_has_its_normals_and_is_framed),
        cmocka_unit_test(a_cutoff_above_1_hides_the_surface),
        cmocka_unit_test(an_opacity_of_0_is_told),
        cmocka_unit_test(what_would_all_be_invisible_is_opaque),
        cmocka_unit_test(a_transparency_of_1_is_none),
        cmocka_unit_test(a_color_of_a_vertex_need_be_no_number),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
