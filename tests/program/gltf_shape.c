/* SPDX-License-Identifier: MIT */
/* The shape of a glTF document: skins, morph targets, instances, colors and coordinates of
 * vertices, against the specification. */
#include "app/scene/instance.h"
#include "tests/program/gltf_document.h"

#include <math.h>

/* Asserts the position of a vertex of the first mesh as an instance of it places it. */
static void assert_instance_position(const scene_builder *builder, size_t instance, size_t vertex,
                                     double x, double y, double z) {
    const double wanted[3] = { x, y, z };
    float found[3];
    scene s;
    builder_geometry(builder, &s);
    assert_true(vertex < s.vertex_count && instance < s.instance_count);
    assert_int_equal(s.instances[instance].mesh, 0);
    scene_instance_point(&s.instances[instance], s.vertices[vertex].position, found);
    for (int k = 0; k < 3; k++)
        CHECK_WITHIN(fabs((double)found[k] - wanted[k]), 1e-6);
}

/* Asserts the position of a vertex. The document's first vertex lies in the origin of its mesh, the
 * second at x = 1; its skin hangs on node 0, at (1, 2, 3). */
static void assert_position(const scene_builder *builder, size_t vertex, double x, double y,
                            double z) {
    assert_instance_position(builder, 0, vertex, x, y, z);
}

static void read_changed(const char *from, const char *to, scene_builder *builder) {
    base_error error;
    char *text = changed(from, to);
    if (!reads(text, builder, &error))
        fail_msg("%s: %s", to, error.text);
    free(text);
}

static void a_skin_follows_its_joints_alone(void **state) {
    (void)state;
    scene_builder builder;
    /* With a skin the node's own transform does not count. */
    read_changed("{\"mesh\":0,\"skin\":0}", "{\"mesh\":0,\"skin\":0,\"translation\":[9,9,9]}",
                 &builder);
    assert_position(&builder, 0, 1, 2, 3);
    assert_position(&builder, 1, 2, 2, 3);
    builder_free(&builder);
    /* Without a skin it counts. */
    read_changed("{\"mesh\":0,\"skin\":0}", "{\"mesh\":0,\"translation\":[9,9,9]}", &builder);
    assert_position(&builder, 0, 10, 11, 12);
    builder_free(&builder);
    /* The joint makes a quarter turn about z, and an inverse bind matrix moves by y. */
    const float along = 1.0f;
    memcpy(bytes + MATRIX + 13 * sizeof along, &along, sizeof along);
    read_changed("\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0.70710678,0.70710678]", &builder);
    assert_position(&builder, 0, 0, 2, 3);
    assert_position(&builder, 1, 0, 3, 3);
    builder_free(&builder);
    fill_bytes();
}

static void joints_share_a_vertex_by_their_weights(void **state) {
    (void)state;
    scene_builder builder;
    /* Half of the second vertex follows a second joint, node 3, in the world's origin. */
    const float half = 0.5f;
    memcpy(bytes + JOINTS + 4, "\0\1", 2);
    memcpy(bytes + WEIGHTS + 16, &half, sizeof half);
    memcpy(bytes + WEIGHTS + 20, &half, sizeof half);
    read_changed("\"joints\":[0],\"inverseBindMatrices\":4", "\"joints\":[0,3]", &builder);
    assert_position(&builder, 0, 1, 2, 3);
    assert_position(&builder, 1, 1.5, 1, 1.5);
    builder_free(&builder);
    fill_bytes();
    memcpy(bytes + JOINTS, "\1", 1);
    expect(document, "an index past what it refers to", "a joint that the skin has not");
    fill_bytes();
}

static void morph_targets_are_added_by_their_weights(void **state) {
    (void)state;
    scene_builder builder;
    base_error error;
    char *text = changed("\"mode\":4", "\"targets\":[{\"POSITION\":0}]");
    assert_true(reads(text, &builder, &error));
    assert_position(&builder, 1, 2, 2, 3);
    builder_free(&builder);
    char *weighted = malloc(strlen(text) + 64),
         *at = strstr(text, "{\"name\":\"m\",\"primitives\"");
    assert_non_null(weighted);
    assert_non_null(at);
    sprintf(weighted, "%.*s{\"weights\":[0.5],%s", (int)(at - text), text, at + 1);
    assert_true(reads(weighted, &builder, &error));
    assert_position(&builder, 1, 2.5, 2, 3);
    builder_free(&builder);
    free(weighted);
    free(text);
}

static void instances_are_meshes_each_by_its_transform(void **state) {
    (void)state;
    scene_builder builder;
    read_changed("{\"mesh\":0,\"skin\":0}",
                 "{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":"
                 "{\"attributes\":{\"TRANSLATION\":6}}}}",
                 &builder);
    /* The mesh exists once. */
    assert_int_equal(builder_count(&builder, BLOB_MESHES), 1);
    assert_int_equal(builder_count(&builder, BLOB_INSTANCES), 2);
    assert_instance_position(&builder, 0, 0, 1, 2, 3);
    assert_instance_position(&builder, 1, 0, 2, 3, 4);
    builder_free(&builder);
}

static void colors_of_vertices_are_read(void **state) {
    (void)state;
    scene_builder builder;
    /* The weights serve as colors, four floats of which the first is 1. */
    read_changed("\"POSITION\":0", "\"POSITION\":0,\"COLOR_0\":8", &builder);
    const scene_vertex *vertex = builder_items(&builder, BLOB_VERTICES);
    const scene_material *material = builder_items(&builder, BLOB_MATERIALS);
    assert_int_equal(vertex->color[0], 65535);
    assert_int_equal(vertex->color[1], 0);
    assert_true(material[0].flags & SCENE_VERTEX_COLORS);
    builder_free(&builder);
    /* Three components leave alpha 1. */
    read_changed("\"POSITION\":0", "\"POSITION\":0,\"COLOR_0\":0", &builder);
    vertex = builder_items(&builder, BLOB_VERTICES);
    assert_int_equal(vertex[0].color[0], 0);
    assert_int_equal(vertex[1].color[0], 65535);
    assert_int_equal(vertex[1].color[3], 65535);
    builder_free(&builder);
}

static void two_sets_of_coordinates_are_kept(void **state) {
    (void)state;
    scene_builder builder;
    /* The base color takes set 1, the normal map set 0. */
    read_changed("\"texCoord\":0", "\"texCoord\":1", &builder);
    const scene_material *material = builder_items(&builder, BLOB_MATERIALS);
    assert_int_equal(material->normal_map.set, 0);
    assert_int_equal(material->base_color_map.set, 1);
    assert_int_equal(material->metallic_roughness_map.set, 0);
    builder_free(&builder);
    /* Both hold unless the transform says otherwise. */
    read_changed("\"offset\":[0,0]", "\"offset\":[0,0],\"texCoord\":4", &builder);
    material = builder_items(&builder, BLOB_MATERIALS);
    assert_int_equal(material->base_color_map.set, 1);
    builder_free(&builder);
}

static void unlit_materials_glow_and_reflect_nothing(void **state) {
    (void)state;
    scene_builder builder;
    read_changed("\"doubleSided\":true", "\"extensions\":{\"KHR_materials_unlit\":{}}", &builder);
    const scene_material *material = builder_items(&builder, BLOB_MATERIALS);
    for (int k = 0; k < 3; k++) {
        CHECK_WITHIN(fabs((double)material->base_color[k]), 0.0);
        CHECK_WITHIN(fabs((double)material->emission[k] - 1.0), 0.0);
    }
    CHECK_WITHIN(fabs((double)material->metallic - 1.0), 0.0);
    assert_int_equal(material->emission_map.texture, material->base_color_map.texture);
    assert_true(material->flags & SCENE_UNLIT);
    builder_free(&builder);
}

/* Nodes without a mesh below them, as of cameras, are left out. */
static void the_tree_of_nodes_is_kept(void **state) {
    (void)state;
    scene_builder builder;
    read_changed("{\"camera\":0,\"matrix\"",
                 "{\"camera\":0,\"mesh\":0,\"name\":\"eye\\n\",\"matrix\"", &builder);
    const scene_node *nodes = builder_items(&builder, BLOB_NODES);
    const char *names = builder_items(&builder, BLOB_NAMES);
    static const scene_node wanted[] = { { 0, SCENE_NO_NODE, 2, 0 },
                                         { SCENE_NO_NODE, 0, 2, 0 },
                                         { 4, SCENE_NO_NODE, 3, 1 } };
    assert_int_equal(builder_count(&builder, BLOB_NODES), 3);
    assert_memory_equal(nodes, wanted, sizeof wanted);
    assert_string_equal(names, "top");
    assert_string_equal(names + 4, "eye?");
    assert_int_equal(builder_count(&builder, BLOB_INSTANCES), 2);
    builder_free(&builder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_skin_follows_its_joints_alone),
        cmocka_unit_test(joints_share_a_vertex_by_their_weights),
        cmocka_unit_test(morph_targets_are_added_by_their_weights),
        cmocka_unit_test(instances_are_meshes_each_by_its_transform),
        cmocka_unit_test(colors_of_vertices_are_read),
        cmocka_unit_test(two_sets_of_coordinates_are_kept),
        cmocka_unit_test(the_tree_of_nodes_is_kept),
        cmocka_unit_test(unlit_materials_glow_and_reflect_nothing),
    };
    fill_bytes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
