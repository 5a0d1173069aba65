/* SPDX-License-Identifier: MIT */
/* Nodes of the viewer's scene: found, framed, hidden, and what is left then. */
#include "app/scene/instance.h"
#include "app/scene/node.h"
#include "app/view/nodes.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"
#include "tests/program/viewer.h"

#include <jansson.h>
#include <stdlib.h>
#include <time.h>

/* Hides and shows what the settings say, as the viewer does between two frames. */
static scene *part;
static void apply(void) {
    base_error error;
    view_tree *before = v.state.tree;
    scene *fresh = view_part_make(&world, &v.state.now, &error);
    assert_non_null(fresh);
    v.state.tree = view_tree_begin(fresh, &error);
    assert_non_null(v.state.tree);
    if (part)
        view_tree_end(before);
    view_part_free(part);
    part = fresh;
    v.state.requests.nodes = false;
}

static int close_nodes(void **unused) {
    if (part) {
        view_tree_end(v.state.tree);
        view_part_free(part);
    }
    part = NULL;
    v.state.tree = tree;
    return close_viewer(unused);
}

static void act(const char *name) {
    take((view_event) { .kind = VIEW_ACT, .text = name });
    if (v.state.requests.nodes)
        apply();
}

/* Whatever is hidden and shown one by one, ranges say the same, and are the same read back. */
static void ranges_say_which_nodes_are_hidden(void **unused) {
    (void)unused;
    enum { NODES = 40 };
    static view_settings copy;
    bool hidden[NODES] = { false };
    uint32_t seed = 1;
    base_error error;
    scene many = world;
    many.instance_count = NODES;
    scene_instance *instances = calloc(NODES, sizeof *instances);
    scene_node nodes[NODES];
    for (uint32_t i = 0; i < NODES; i++)
        nodes[i] = (scene_node) { SCENE_NO_NODE, SCENE_NO_NODE, i + 1, i };
    many.instances = instances;
    many.nodes = nodes;
    many.node_count = NODES;
    v.state.world = &many;
    for (int i = 0; i < 2000; i++) {
        seed = seed * 1664525u + 1013904223u;
        v.state.node = (long)(seed >> 16) % NODES;
        hidden[v.state.node] = !hidden[v.state.node];
        view_hide_node(&v.state, 0);
        json_t *root = view_settings_to_json(&v.state.now);
        assert_true(view_settings_from_json(root, "x", &copy, &error));
        json_decref(root);
        scene *left = view_part_make(&many, &copy, &error);
        size_t count = 0;
        for (size_t node = 0; node < NODES; node++) {
            assert_int_equal(view_node_is_hidden(&v.state, node), hidden[node]);
            count += !hidden[node];
        }
        assert_int_equal(left->instance_count, count);
        assert_memory_equal(&copy.hidden, &v.state.now.hidden, sizeof copy.hidden);
        view_part_free(left);
    }
    v.state.world = &world;
    free(instances);
}

static void ranges_that_are_none_are_refused(void **unused) {
    (void)unused;
    static const char *const texts[] = { "[[2, 1]]",  "[[1, 2], [3, 4]]", "[[4, 5], [1, 2]]",
                                         "[1]",       "[[-1, 2]]",        "7",
                                         "[[1.5, 2]]" };
    static view_settings copy;
    base_error error;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        json_t *root = view_settings_to_json(&v.state.now);
        json_object_set_new(root, "hidden", json_loads(texts[i], JSON_DECODE_ANY, NULL));
        assert_false(view_settings_from_json(root, "x", &copy, &error));
        assert_non_null(strstr(error.text, "hidden"));
        json_decref(root);
    }
}

/* What is hidden is not there for the pointer; what is behind it has the number that it had. */
static void hidden_nodes_are_not_pointed_at(void **unused) {
    (void)unused;
    long picked[8];
    const size_t count = world.instance_count;
    assert_true(count >= 2 && count < 8);
    for (size_t i = 0; i < count; i++) {
        v.state.node = -1;
        act("Pick");
        picked[i] = v.state.node;
        for (size_t k = 0; k < i; k++)
            assert_int_not_equal(picked[i], picked[k]);
        if (picked[i] < 0)
            break;
        act("Hide");
        assert_non_null(strstr(v.state.message, "is hidden"));
    }
    assert_true(picked[0] >= 0 && picked[1] != picked[0]);
    v.state.node = picked[0];
    act("Hide"); /* again: it is shown */
    v.state.node = -1;
    act("Pick");
    assert_int_equal(v.state.node, picked[0]);
    act("Isolate");
    assert_int_equal(part->instance_count, 1);
    assert_int_equal(v.state.now.hidden.count, (picked[0] > 0) + (picked[0] + 1 < (long)count));
    act("Show all");
    assert_int_equal(part->instance_count, count);
}

/* A node has its number while one before it is hidden. */
static void nodes_keep_their_numbers(void **unused) {
    (void)unused;
    for (double y = 0; y < HEIGHT && v.state.node <= 0; y += 20) {
        take((view_event) { .kind = VIEW_MOVE, .x = MIDDLE, .y = y });
        act("Pick");
    }
    const long picked = v.state.node;
    assert_true(picked > 0);
    v.state.node = 0;
    act("Hide");
    act("Pick");
    assert_int_equal(v.state.node, picked);
}

/* An action without a selected node is for what is pointed at, if anything is. */
static void actions_are_for_what_is_pointed_at(void **unused) {
    (void)unused;
    act("Hide");
    assert_true(v.state.node < 0 && v.state.now.hidden.count == 1);
    act("Show all");
    v.state.now.camera.eye[2] = 1e6f; /* looks past everything */
    v.state.now.camera.target[2] = 2e6f;
    for (int i = 0; i < 3; i++) {
        static const char *const names[] = { "Hide", "Isolate", "Frame the node" };
        act(names[i]);
        assert_non_null(strstr(v.state.message, "Select a node"));
    }
    assert_int_equal(v.state.now.hidden.count, 0);
}

/* Hiding, isolating and showing are steps of undo, among those of lights. */
static void hiding_is_undone(void **unused) {
    (void)unused;
    const size_t count = world.instance_count;
    v.state.node = 0;
    act("Hide");
    act("Larger");
    act("Isolate");
    act("Show all");
    assert_int_equal(part->instance_count, count);
    act("Undo");
    assert_int_equal(part->instance_count, 1);
    act("Undo");
    assert_int_equal(part->instance_count, count - 1);
    assert_true(view_node_is_hidden(&v.state, 0));
    act("Undo"); /* the light's */
    assert_true(!v.state.requests.nodes && view_node_is_hidden(&v.state, 0));
    act("Undo");
    assert_int_equal(part->instance_count, count);
    act("Redo");
    act("Redo");
    act("Redo");
    assert_int_equal(part->instance_count, 1);
    assert_false(view_node_is_hidden(&v.state, 0));
}

static void a_node_is_selected_in_the_list_and_framed(void **unused) {
    (void)unused;
    char item[SCENE_NAME_SIZE + 48];
    double x, y, scale;
    snprintf(item, sizeof item, "%s##node", scene_node_name(&world, 1));
    click_on("Scene");
    click_on(item);
    assert_int_equal(v.state.node, 1);
    v.state.selected = -1;
    const scene_camera before = v.state.now.camera;
    take((view_event) { .kind = VIEW_KEY, .text = "F" }); /* no light is selected */
    const scene_camera framed = v.state.now.camera;
    assert_true(memcmp(&before, &framed, sizeof before) != 0);
    v.state.now.camera = before;
    act("Frame the node");
    assert_memory_equal(&framed, &v.state.now.camera, sizeof framed);
    assert_true(view_project(&framed, WIDTH, HEIGHT,
                             (lmp_vec3) { framed.target[0], framed.target[1], framed.target[2] },
                             &x, &y, &scale));
    CHECK_NEAR(WIDTH / 2, x, 1);
    take((view_event) { .kind = VIEW_MOVE, .x = MIDDLE, .y = HEIGHT / 2 });
    act("Hide");
    view_lay_out(&v, NULL, false);
    snprintf(item, sizeof item, "%s, hidden##node", scene_node_name(&world, 1));
    assert_true(ui_find(item, &x, &y));
    click_on("find##node");
    take((view_event) { .kind = VIEW_TYPE, .text = "no such node" });
    view_lay_out(&v, NULL, false);
    assert_false(ui_find(item, &x, &y));
    take((view_event) { .kind = VIEW_KEY, .text = "Escape" });
    take((view_event) { .kind = VIEW_KEY, .text = "Escape" });
    assert_int_equal(v.state.node, -1);
}

/* Hangs the scene's three instances on a tree: a room with a table, on which lies a book, and a
 * lamp. */
static scene_node tree_of[] = {
    { 0, SCENE_NO_NODE, 4, 0 }, { 5, 0, 3, 0 }, { 11, 1, 3, 1 }, { 16, 0, 4, 2 }
};
static void hang(void) {
    world.nodes = tree_of;
    world.names = "room\0table\0book\0lamp";
    world.node_count = sizeof tree_of / sizeof *tree_of;
    assert_int_equal(world.instance_count, 3);
}

static bool lists(const char *item) {
    double x, y;
    return ui_find(item, &x, &y);
}

static void what_is_below_a_node_is_hidden_with_it(void **unused) {
    (void)unused;
    hang();
    v.state.node = 1;
    act("Hide");
    assert_int_equal(part->instance_count, 1);
    assert_true(view_node_is_hidden(&v.state, 1) && view_node_is_hidden(&v.state, 2));
    assert_false(view_node_is_hidden(&v.state, 0) || view_node_is_hidden(&v.state, 3));
    v.state.node = 2;
    act("Hide"); /* shows it again, but not all of its parent */
    assert_int_equal(part->instance_count, 2);
    assert_false(view_node_is_hidden(&v.state, 1));
    v.state.node = 1;
    act("Isolate");
    assert_int_equal(part->instance_count, 2);
    assert_true(view_node_is_hidden(&v.state, 3));
    v.state.node = 0;
    act("Hide");
    assert_int_equal(part->instance_count, 0);
    act("Hide");
    assert_int_equal(v.state.now.hidden.count, 0);
}

static void an_instance_belongs_to_the_node_that_draws_it(void **unused) {
    (void)unused;
    float low[3], high[3], lamp_low[3], lamp_high[3];
    hang();
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(scene_node_of(&world, i), i + 1);
    assert_true(scene_node_bounds(&world, 0, low, high));
    assert_memory_equal(low, world.minimum, sizeof low);
    assert_memory_equal(high, world.maximum, sizeof high);
    assert_true(scene_node_bounds(&world, 3, lamp_low, lamp_high));
    assert_true(memcmp(low, lamp_low, sizeof low) != 0 || memcmp(high, lamp_high, sizeof high));
}

/* A plate named by its geometry, x to the right, as Collada has it, which Assimp reads. */
#define PLATE(name, x)                                                                             \
    "<geometry id=\"" name "\" name=\"" name "\"><mesh><source id=\"p" name "\">"                  \
    "<float_array id=\"a" name "\" count=\"9\">" x " 0 0 " x " 1 0 " x " 1 1</float_array>"        \
    "<technique_common><accessor source=\"#a" name "\" count=\"3\" stride=\"3\">"                  \
    "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"                         \
    "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"                    \
    "<vertices id=\"v" name "\"><input semantic=\"POSITION\" source=\"#p" name "\"/></vertices>"   \
    "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v" name "\" offset=\"0\"/>"       \
    "<p>0 1 2</p></triangles></mesh></geometry>"
#define SHOW(name) "<node><instance_geometry url=\"#" name "\"/></node>"
static const char plates[] =
    "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
    "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset><library_geometries>" //
    PLATE("left", "-2")
        PLATE("right",
              "2") "</library_geometries><library_visual_scenes>"
                   "<visual_scene id=\"s\">" SHOW("left")
                       SHOW("right") "</visual_scene></library_visual_scenes>"
                                     "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";

/* A file that is not glTF has its meshes by their names, and hides the triangles of the right one.
 */
static void meshes_of_other_formats_are_nodes(void **unused) {
    (void)unused;
    const scene ball = world;
    float corners[3][3];
    folder_write_text("plates.dae", plates);
    world = load(in_folder("plates.dae"));
    apply();
    assert_int_equal(world.instance_count, 2);
    click_on("Scene");
    assert_true(lists("left##node") && lists("right##node"));
    for (int side = 0; side < 2; side++) {
        click_on(side ? "right##node" : "left##node");
        act("Hide");
        assert_int_equal(part->instance_count, 1);
        scene_triangle_positions(part, 0, 0, corners);
        for (int i = 0; i < 3; i++)
            CHECK_NEAR(side ? -2 : 2, corners[i][0], 1e-6);
        view_lay_out(&v, NULL, false);
        assert_true(lists(side ? "right, hidden##node" : "left, hidden##node"));
        act("Show all");
        assert_int_equal(part->instance_count, 2);
        view_lay_out(&v, NULL, false);
    }
    view_tree_wait(v.state.tree); /* it reads the scene until it is built */
    scene_free(&world);
    world = ball;
}

/* The tree is folded at first; a node that is picked, or found by its name, is seen. */
static void the_tree_folds(void **unused) {
    (void)unused;
    double x, y;
    hang();
    click_on("Scene");
    assert_true(lists("room##node") && !lists("table##node"));
    click_on("room##node"); /* selects */
    assert_true(v.state.node == 0 && !lists("table##node"));
    assert_true(ui_find("room##node", &x, &y));
    for (double at = x; at > MIDDLE && !lists("table##node"); at -= 4)
        click(at, y); /* until the arrow opens it */
    assert_true(lists("table##node") && lists("lamp##node") && !lists("book##node"));
    v.state.node = 2;
    view_lay_out(&v, NULL, false);
    view_lay_out(&v, NULL, false);
    assert_true(lists("book##node"));
    click_on("lamp##node");
    assert_int_equal(v.state.node, 3);
    click_on("find##node");
    take((view_event) { .kind = VIEW_TYPE, .text = "BOO" });
    view_lay_out(&v, NULL, false);
    assert_true(lists("book##node") && !lists("room##node") && !lists("lamp##node"));
    click_on("book##node");
    assert_int_equal(v.state.node, 2);
}

/* However many nodes there are, a list takes the time of those that are seen. */
static void a_large_tree_is_fast(void **unused) {
    (void)unused;
    enum { NODES = 200000 };
    scene_node *nodes = calloc(NODES, sizeof *nodes);
    assert_non_null(nodes);
    hang();
    for (uint32_t i = 0; i < NODES; i++)
        nodes[i] = (scene_node) { 0, i ? 0 : SCENE_NO_NODE, i ? i + 1 : NODES, 0 };
    nodes[NODES - 1].name = 16;
    world.nodes = nodes;
    world.node_count = NODES;
    click_on("Scene");
    v.state.node = NODES - 1; /* the last row of all */
    for (int i = 0; i < 3; i++)
        view_lay_out(&v, NULL, false);
    assert_true(lists("lamp##node"));
    const clock_t began = clock();
    for (int i = 0; i < 20; i++)
        view_lay_out(&v, NULL, false);
    const double ms = 1e3 * (double)(clock() - began) / CLOCKS_PER_SEC / 20;
    print_message("%.2f ms a frame\n", ms);
    assert_true(ms < 60);
    hang();
    free(nodes);
}

int main(void) {
#define NODES(test) cmocka_unit_test_setup_teardown(test, open_viewer, close_nodes)
    const struct CMUnitTest tests[] = {
        NODES(ranges_say_which_nodes_are_hidden),
        NODES(ranges_that_are_none_are_refused),
        NODES(hidden_nodes_are_not_pointed_at),
        NODES(nodes_keep_their_numbers),
        NODES(actions_are_for_what_is_pointed_at),
        NODES(a_node_is_selected_in_the_list_and_framed),
        NODES(hiding_is_undone),
        NODES(what_is_below_a_node_is_hidden_with_it),
        NODES(an_instance_belongs_to_the_node_that_draws_it),
        NODES(meshes_of_other_formats_are_nodes),
        NODES(the_tree_folds),
        NODES(a_large_tree_is_fast),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
