/* SPDX-License-Identifier: MIT */
/* KHR_materials_variants: a primitive takes its material in the chosen variant by the
 * specification's rule, from the mapping whose list of variants has it, or else its own. */
#include "app/base/error.h"
#include "app/base/file_json.h"
#include "app/view/settings.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <jansson.h>

#define MATERIAL(name, color, more)                                                                \
    "{\"name\":\"" name "\",\"pbrMetallicRoughness\":{\"baseColorFactor\":" color "}" more "}"

/* Two triangles: one is green by day and glows at night, with a normal map by the second set of
 * coordinates; the other is always red. Nothing is mapped at dusk. */
static const char two_triangles[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"extensionsUsed\":[\"KHR_materials_variants\"],"
    "\"extensions\":{\"KHR_materials_variants\":{\"variants\":["
    "{\"name\":\"day\"},{\"name\":\"late\\tnight\"},{\"name\":\"dusk\"}]}},"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,"
    "\"TEXCOORD_1\":2},\"material\":0,\"extensions\":{\"KHR_materials_variants\":{\"mappings\":["
    "{\"material\":1,\"variants\":[0]},{\"material\":2,\"variants\":[1]}]}}},"
    "{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
    "\"materials\":[" MATERIAL("red", "[1,0,0,1]", "") "," MATERIAL("green", "[0,1,0,1]", "") "," //
    MATERIAL(
        "glow", "[0,0,1,1]",
        ",\"emissiveFactor\":[1,1,1],\"normalTexture\":"
        "{\"index\":0,\"texCoord\":1}") "],"
                                        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"gone."
                                        "png\"}],"
                                        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
                                        "\"count\":3,\"type\":\"VEC3\","
                                        "\"min\":[0,0,0],\"max\":[1,1,0]},"
                                        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
                                        "\"type\":\"VEC2\"},"
                                        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":"
                                        "5126,\"count\":3,\"type\":\"VEC2\"}],"
                                        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                                        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:"
                                        "application/octet-stream;base64,"
                                        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

static scene load_variant(const char *name, const char *variant) {
    scene loaded;
    base_error error = { 0 };
    if (!scene_load(in_folder(name), &(scene_options) { .variant = variant }, &loaded, &error))
        fail_msg("%s", error.text);
    return loaded;
}

static const char *material_of(const scene *s, size_t mesh) {
    return s->materials[s->meshes[mesh].material].name;
}

/* The file is read twice: parsed, and from the cache, where each variant has an entry of its own.
 */
static void a_primitive_has_its_variants_material(void **state) {
    (void)state;
    static const struct {
        const char *variant, *first;
        size_t lights;
        float v; /* the second vertex's, in the first set that is kept */
    } cases[] = { { NULL, "red", 0, 0 },          { "day", "green", 0, 0 },
                  { "late?night", "glow", 1, 0 }, { "dusk", "red", 0, 0 },
                  { "0", "green", 0, 0 },         { "1", "glow", 1, 0 },
                  { "late?night", "glow", 1, 0 } };
    folder_write_text("two.gltf", two_triangles);
    for (int again = 0; again < 2; again++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            scene s = load_variant("two.gltf", cases[i].variant);
            assert_string_equal(material_of(&s, 0), cases[i].first);
            assert_string_equal(material_of(&s, 1), "red");
            assert_int_equal(s.light_count, cases[i].lights);
            assert_true(s.cached || !again);
            scene_free(&s);
        }
}

/* The glowing material's normal map takes TEXCOORD_1, whose first u is 1; the others have none. */
static void coordinates_are_those_of_the_variants_material(void **state) {
    (void)state;
    folder_write_text("two.gltf", two_triangles);
    for (int night = 0; night < 2; night++) {
        scene s = load_variant("two.gltf", night ? "1" : NULL);
        assert_true(s.vertices[s.indices[s.meshes[0].first_index]].uv[0][0] == (float)night);
        scene_free(&s);
    }
}

static void variants_are_listed_and_none_is_unsupported(void **state) {
    (void)state;
    folder_write_text("two.gltf", two_triangles);
    scene s = load_variant("two.gltf", NULL);
    assert_int_equal(s.variant_count, 3);
    assert_string_equal(s.variants[0].name, "day");
    assert_string_equal(s.variants[1].name, "late?night");
    assert_string_equal(s.variants[2].name, "dusk");
    for (size_t i = 0; i < s.unsupported_count; i++)
        assert_null(strstr(s.unsupported[i].what, "variants"));
    scene_free(&s);
}

static void an_unknown_variant_is_refused_by_those_there_are(void **state) {
    (void)state;
    static const struct {
        const char *name, *variant, *wrong;
    } cases[] = {
        { "two.gltf", "dai",
          "no such variant: \"dai\" is not one of day, late?night, dusk (did you mean day?)" },
        { "two.gltf", "3", "no such variant: \"3\" is not one of day, late?night, dusk" },
        { "two.gltf", "", "no such variant: \"\" is not one of day, late?night, dusk" },
        { "flat.obj", "day", "no such variant: \"day\", for there is none" },
    };
    folder_write_text("two.gltf", two_triangles);
    folder_write_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene s;
        base_error error = { 0 };
        assert_false(scene_load(in_folder(cases[i].name),
                                &(scene_options) { .variant = cases[i].variant }, &s, &error));
        assert_non_null(strstr(error.text, cases[i].wrong));
    }
    scene s;
    base_error error = { 0 };
    assert_false(scene_load("builtin:ball", &(scene_options) { .variant = "day" }, &s, &error));
    assert_string_equal(error.text, "builtin:ball: no such variant: \"day\", for there is none");
}

/* The screenshot of a variant restores that variant. */
static void a_screenshot_keeps_the_variant(void **state) {
    (void)state;
    view_settings *before = calloc(1, sizeof *before), *after = calloc(1, sizeof *after);
    assert_non_null(before);
    assert_non_null(after);
    strcpy(before->scene, "two.gltf");
    strcpy(before->variant, "late?night");
    strcpy(before->environment.name, "none");
    before->width = before->height = before->samples = 1;
    before->exposure = 1;
    before->camera.fov = 1;
    before->shading[0].bands = before->shading[1].bands = 5;
    base_error error = { 0 };
    char *text = file_json_text(view_settings_to_json(before), false, "shot", &error);
    assert_non_null(text);
    json_t *root = file_parse_json("shot", text, strlen(text), &error);
    if (!view_settings_from_json(root, "shot", after, &error))
        fail_msg("%s", error.text);
    assert_string_equal(after->variant, "late?night");
    json_object_set_new(root, "variant", json_integer(1));
    assert_false(view_settings_from_json(root, "shot", after, &error));
    assert_string_equal(error.text, "shot: has settings with invalid \"variant\"");
    free(text);
    json_decref(root);
    free(before);
    free(after);
}

static int make_cache(void **state) {
    return folder_make(state) || setenv("XDG_CACHE_HOME", folder, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_primitive_has_its_variants_material),
        cmocka_unit_test(coordinates_are_those_of_the_variants_material),
        cmocka_unit_test(variants_are_listed_and_none_is_unsupported),
        cmocka_unit_test(an_unknown_variant_is_refused_by_those_there_are),
        cmocka_unit_test(a_screenshot_keeps_the_variant),
    };
    return cmocka_run_group_tests(tests, make_cache, folder_remove);
}
