/* SPDX-License-Identifier: MIT */
/* One bad detail loses that detail, not the scene: what is drawn without it, and what is said. */
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/gltf_document.h"
#include "tests/program/load.h"

#include <unistd.h>

/* All that is left out, as the line on stderr has it. */
static void said_of(const scene_left_out *items, size_t count, char *text, size_t size) {
    text[0] = 0;
    for (size_t i = 0; i < count; i++) {
        char one[256];
        scene_left_out_text(&items[i], one, sizeof one);
        snprintf(text + strlen(text), size - strlen(text), "%s%s", i ? ", " : "", one);
    }
}

/* --- glTF: changes to a valid document -------------------------------------------------------- */

/* What is said of the document as it is. */
#define USUAL       "missing texture coordinates (1 primitive), "
#define USUAL_AFTER "range (1 light)"

typedef struct forgiven {
    const char *from, *to;
    const char *said; /* beside the usual; NULL: nothing */
} forgiven;

static const forgiven gltf_changes[] = {
    { "{\"asset\"", "{\"asset\"", NULL },
    /* images */
    { "\"bufferView\":9,", "\"bufferView\":6,", "image 0 (1 undecodable image)" },
    { "\"bufferView\":9,", "\"uri\":\"data:image/png;base64,!!!!\",",
      "image 0 (1 undecodable image)" },
    { "\"bufferView\":9,",
      "\"uri\":\"data:image/gif;base64,R0lGODdhAQABAIAAAP///////ywAAAAAAQABAAACAkQBADs=\",",
      "image 0 (1 undecodable image)" },
    { "\"bufferView\":9,", "", "image 0 (1 image without data)" },
    { "\"bufferView\":9,\"mimeType\":\"image/png\"", "\"bufferView\":9", NULL },
    { "\"bufferView\":9,", "\"uri\":\"gone.png\",", "gone.png (1 missing file)" },
    { "\"bufferView\":9,", "\"uri\":\"../up.png\",", "../up.png (1 file outside the folder)" },
    { "\"bufferView\":9,", "\"uri\":\"file:///C:/a.png\",",
      "file:///C:/a.png (1 file outside the folder)" },
    { "\"bufferView\":9,",
      "\"uri\":\"C:\\\\Users\\\\somebody\\\\Documents\\\\a project of long "
      "ago\\\\Textures\\\\a.png\",",
      "...sers\\somebody\\Documents\\a project of long ago\\Textures\\a.png (1 file outside the "
      "folder)" },
};

static void a_gltf_is_read_but_for_the_detail(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof gltf_changes / sizeof *gltf_changes; i++) {
        const forgiven *c = &gltf_changes[i];
        char *text = changed(c->from, c->to), said[1024], expected[1024];
        scene_builder builder;
        cli_error error;
        if (!reads(text, &builder, &error))
            fail_msg("%s: %s", c->to, error.text);
        said_of(builder_items(&builder, BLOB_LEFT_OUT), builder_count(&builder, BLOB_LEFT_OUT),
                said, sizeof said);
        snprintf(expected, sizeof expected, USUAL "%s%s" USUAL_AFTER, c->said ? c->said : "",
                 c->said ? ", " : "");
        if (strcmp(said, expected) != 0)
            fail_msg("%s: says \"%s\" instead of \"%s\"", c->to, said, expected);
        builder_free(&builder);
        free(text);
    }
}

static const scene_material *material_of(const scene *world) {
    return &world->materials[world->meshes[0].material];
}

#define TRIANGLE                                                                                   \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"            \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","       \
    "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"        \
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"              \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}"
#define HEAD                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"

/* The factor alone is what is drawn of a base color whose image is not there; as soon as it is, the
 * scene is another. */
static void an_image_that_appears_is_drawn(void **state) {
    (void)state;
    const scene_options by_cache = { 0 };
    scene world;
    cli_error error;
    folder_write_text("late.gltf",
                      HEAD "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                           "[0.25,0.5,0.75,1],\"baseColorTexture\":{\"index\":0}}}],"
                           "\"textures\":[{\"source\":0}],"
                           "\"images\":[{\"uri\":\"sub/../late.png\"}]," TRIANGLE);
    for (int i = 0; i < 4; i++) {
        if (i == 2)
            folder_write("late.png", pixel_png, sizeof pixel_png);
        if (!scene_load(in_folder("late.gltf"), &by_cache, &world, &error))
            fail_msg("%s", error.text);
        assert_int_equal(world.cached, i % 2);
        assert_int_equal(world.left_out_count, i < 2 ? 2 : 1); /* and coordinates */
        assert_int_equal(material_of(&world)->base_color_map.texture, i < 2 ? -1 : 0);
        CHECK_WITHIN(fabs((double)material_of(&world)->base_color[2] - 0.75), 1e-7);
        scene_free(&world);
    }
}

/* --- other formats ---------------------------------------------------------------------------- */

#define MD5                                                                                        \
    "MD5Version 10\ncommandline \"\"\n\nnumJoints 1\nnumMeshes 1\n\njoints {\n"                    \
    "\t\"origin\" -1 ( 0 0 0 ) ( 0 0 0 )\n}\n\nmesh {\n\tshader \"stone\"\n\tnumverts 3\n"         \
    "\tvert 0 ( 0 0 ) 0 1\n\tvert 1 ( 1 0 ) 1 1\n\tvert 2 ( 0 1 ) 2 1\n\tnumtris 1\n"              \
    "\ttri 0 0 1 2\n\tnumweights 3\n\tweight 0 0 1 ( 0 0 0 )\n\tweight 1 0 1 ( 1 0 0 )\n"          \
    "\tweight 2 0 1 ( 0 1 0 )\n}\n"

/* Assimp looks for an animation beside every such mesh. */
static void a_file_that_is_only_looked_for_may_be_missing(void **state) {
    (void)state;
    cli_error error;
    scene world;
    folder_write_text("man.md5mesh", MD5);
    if (!scene_load(in_folder("man.md5mesh"), &(scene_options) { .no_cache = true }, &world,
                    &error))
        fail_msg("%s", error.text);
    assert_int_equal(world.index_count, 3);
    for (size_t i = 0; i < world.left_out_count; i++)
        assert_null(strstr(world.left_out[i].what, "md5anim"));
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gltf_is_read_but_for_the_detail),
        cmocka_unit_test(an_image_that_appears_is_drawn),
        cmocka_unit_test(a_file_that_is_only_looked_for_may_be_missing),
    };
    fill_bytes();
    if (folder_make(NULL) != 0 || setenv("XDG_CACHE_HOME", in_folder("cache"), 1) != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, folder_remove);
}
