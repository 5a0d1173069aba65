/* SPDX-License-Identifier: MIT */
/* Scenes as a child process that was taken over may return them: none whose statements about itself
 * are false is accepted. */
#include "app/scene/builder.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static scene_builder builder;

static int make_triangle(void **state) {
    (void)state;
    memset(&builder, 0, sizeof builder);
    scene_vertex *corners = builder_append(&builder, BLOB_VERTICES, 3);
    uint32_t *indices = builder_append(&builder, BLOB_INDICES, 3);
    for (uint32_t i = 0; i < 3; i++) {
        corners[i].position[i] = 1.0f + (float)i;
        corners[i].normal[2] = corners[i].tangent[0] = corners[i].tangent[3] = 1.0f;
        indices[i] = i;
    }
    builder_material(&builder, "clay");
    builder_mesh(&builder, "floor", 0, 0);
    builder_instances(&builder, 0);
    scene_light *light = builder_append(&builder, BLOB_LIGHTS, 1);
    *light = (scene_light) { .emitter = { .radius = 1, .radiance = { 1, 1, 1 } } };
    scene_motion *motion = builder_append(&builder, BLOB_MOTIONS, 1);
    *motion = (scene_motion) { .light = 0, .first = 0, .count = 2, .period = 1 };
    builder_append(&builder, BLOB_OFFSETS, 2);
    return builder.out_of_memory;
}

static int free_builder(void **state) {
    (void)state;
    builder_free(&builder);
    return 0;
}

static bool is_valid(void) {
    void *block;
    size_t size;
    base_error error;
    assert_true(builder_pack(&builder, &block, &size));
    const bool valid = blob_validate(block, size, false, "scene", &error);
    free(block);
    return valid;
}

static void what_the_builder_makes_is_valid(void **state) {
    (void)state;
    assert_true(is_valid());
}

static void positions_are_in_reach(void **state) {
    (void)state;
    scene_vertex *corners = builder_items(&builder, BLOB_VERTICES);
    scene_mesh *mesh = builder_items(&builder, BLOB_MESHES);
    corners[1].position[1] = mesh->maximum[1] = LMP_LENGTH_MAX;
    assert_true(is_valid());
    corners[1].position[1] = mesh->maximum[1] = 1.01f * LMP_LENGTH_MAX;
    assert_false(is_valid());
}

/* Shading and rays take normals and tangents as they are, so they must be unit. */
static void normals_and_tangents_are_unit(void **state) {
    (void)state;
    scene_vertex *corner = builder_items(&builder, BLOB_VERTICES);
    float *const numbers[] = { corner->normal, corner->tangent, corner->tangent + 3 };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        for (int k = 0; k < (i < 2 ? 3 : 1); k++) {
            static const float wrong[] = { 1.1f, 0.5f, 2e19f, 1e38f, NAN, INFINITY };
            const float right = numbers[i][k];
            for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
                numbers[i][k] = wrong[w];
                assert_false(is_valid());
            }
            numbers[i][k] = right;
        }
    assert_true(is_valid());
}

static void motions_are_in_reach(void **state) {
    (void)state;
    lmp_vec3 *offsets = builder_items(&builder, BLOB_OFFSETS);
    offsets[1].z = -LMP_LENGTH_MAX;
    assert_true(is_valid());
    offsets[1].z = -1.01f * LMP_LENGTH_MAX;
    assert_false(is_valid());
}

static void bounds_are_those_of_the_vertices(void **state) {
    (void)state;
    scene_mesh *mesh = builder_items(&builder, BLOB_MESHES);
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++) {
            float *bound = side ? &mesh->maximum[k] : &mesh->minimum[k];
            const float right = *bound;
            *bound = right + 0.5f;
            assert_false(is_valid());
            *bound = right - 0.5f;
            assert_false(is_valid());
            *bound = right;
        }
    assert_true(is_valid());
    mesh->index_count = 0;
    assert_false(is_valid());
}

static void instances_place_meshes_that_are_there(void **state) {
    (void)state;
    scene_instance *instance = builder_items(&builder, BLOB_INSTANCES);
    instance->mesh = 1;
    assert_false(is_valid());
    instance->mesh = 0;
    static const float wrong[] = { NAN, INFINITY, -INFINITY, 1e30f };
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
                float *const number = &instance->world_from_mesh[row][column];
                const float right = *number;
                *number = wrong[w];
                assert_false(is_valid());
                *number = right;
            }
    assert_true(is_valid());
    /* The matrix flattens the mesh, and leaves it without normals. */
    instance->world_from_mesh[1][1] = 0;
    assert_false(is_valid());
    instance->world_from_mesh[1][1] = -1;
    assert_true(is_valid());
    /* The floor's corners are at most 3 away. */
    instance->world_from_mesh[0][3] = 0.9f * LMP_LENGTH_MAX;
    assert_true(is_valid());
    instance->world_from_mesh[0][3] = 1.1f * LMP_LENGTH_MAX;
    assert_false(is_valid());
}

static void nodes_are_a_tree_of_all_instances(void **state) {
    (void)state;
    assert_int_equal(builder_count(&builder, BLOB_NODES), 1);
    builder_append(&builder, BLOB_NODES, 2);
    memcpy(builder_append(&builder, BLOB_NAMES, 8), "top\0leaf", 8);
    builder_append(&builder, BLOB_NAMES, 1);
    scene_node *nodes = builder_items(&builder, BLOB_NODES);
    const scene_node right[3] = { { 0, SCENE_NO_NODE, 3, 0 },
                                  { SCENE_NO_NODE, 0, 2, 0 },
                                  { 4, 0, 3, 1 } };
    const struct {
        int node;
        scene_node wrong;
    } cases[] = {
        { 0, { 1, SCENE_NO_NODE, 3, 0 } }, /* within a name */
        { 0, { 9, SCENE_NO_NODE, 3, 0 } },
        { 0, { 0, 0, 3, 0 } }, /* its own parent */
        { 0, { 0, 2, 3, 0 } },
        { 0, { 0, SCENE_NO_NODE, 0, 0 } },
        { 0, { 0, SCENE_NO_NODE, 4, 0 } },
        { 0, { 0, SCENE_NO_NODE, 1, 0 } }, /* ends before its children */
        { 0, { 0, SCENE_NO_NODE, 3, 1 } }, /* without the first instance */
        { 1, { SCENE_NO_NODE, 0, 1, 0 } }, /* ends where it begins */
        { 1, { SCENE_NO_NODE, 0, 4, 0 } },
        { 2, { 4, 1, 3, 1 } }, /* after its parent's end */
        { 2, { 4, 0, 3, 2 } }, /* an instance that is not there */
    };
    memcpy(nodes, right, sizeof right);
    assert_true(is_valid());
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nodes[cases[i].node] = cases[i].wrong;
        if (is_valid())
            fail_msg("case %zu is accepted", i);
        memcpy(nodes, right, sizeof right);
    }
    char *names = builder_items(&builder, BLOB_NAMES);
    names[8] = 'x'; /* without an end */
    assert_false(is_valid());
    names[8] = 0;
    names[1] = '\n';
    assert_false(is_valid());
    names[1] = 'o';
    builder.arrays[BLOB_NODES].count = 0;
    assert_false(is_valid());
}

/* Texels follow each other, each from a page of its own on: an image that claimed another's bytes
 * would be decoded over it. */
static void images_have_bytes_and_texels_of_their_own(void **state) {
    (void)state;
    scene_image *images = builder_append(&builder, BLOB_IMAGES, 2);
    builder_append(&builder, BLOB_ENCODED, 10);
    for (uint64_t i = 0; i < 2; i++)
        images[i] = (scene_image) {
            .width = 40, .height = 30, .first_byte = 5 * i, .size = 5, .first_texel = 8192 * i
        };
    assert_true(is_valid());
    uint64_t *const numbers[] = { &images[1].first_byte, &images[1].size, &images[1].first_texel };
    static const uint64_t wrong[] = { 6, 6, 4096 };
    for (size_t i = 0; i < 3; i++) {
        const uint64_t right = *numbers[i];
        *numbers[i] = wrong[i];
        assert_false(is_valid());
        *numbers[i] = UINT64_MAX;
        assert_false(is_valid());
        *numbers[i] = right;
    }
    images[1].width = 0;
    assert_false(is_valid());
    images[1].width = 40;
    assert_true(is_valid());
    builder_append(&builder, BLOB_TEXELS, 4);
    assert_false(is_valid());
}

static void the_files_it_was_made_from_are_few(void **state) {
    (void)state;
    builder_append(&builder, BLOB_SOURCES, BLOB_SOURCES_MAX);
    assert_true(is_valid());
    builder_append(&builder, BLOB_SOURCES, 1);
    assert_false(is_valid());
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_the_builder_makes_is_valid, make_triangle,
                                        free_builder),
        cmocka_unit_test_setup_teardown(positions_are_in_reach, make_triangle, free_builder),
        cmocka_unit_test_setup_teardown(normals_and_tangents_are_unit, make_triangle, free_builder),
        cmocka_unit_test_setup_teardown(motions_are_in_reach, make_triangle, free_builder),
        cmocka_unit_test_setup_teardown(bounds_are_those_of_the_vertices, make_triangle,
                                        free_builder),
        cmocka_unit_test_setup_teardown(instances_place_meshes_that_are_there, make_triangle,
                                        free_builder),
        cmocka_unit_test_setup_teardown(nodes_are_a_tree_of_all_instances, make_triangle,
                                        free_builder),
        cmocka_unit_test_setup_teardown(images_have_bytes_and_texels_of_their_own, make_triangle,
                                        free_builder),
        cmocka_unit_test_setup_teardown(the_files_it_was_made_from_are_few, make_triangle,
                                        free_builder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
