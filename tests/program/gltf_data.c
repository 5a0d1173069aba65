/* SPDX-License-Identifier: MIT */
/* The bytes behind a glTF document, and its containers. */
#include "app/scene/instance.h"
#include "tests/program/gltf_document.h"

#include <math.h>

/* --- the bytes -------------------------------------------------------------------------------- */

/* The document takes its mesh's indices from accessor 1 (bytes), 2 (shorts) or 3 (words). */
static void an_index_past_the_vertices_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *accessor;
        size_t at, size;
        uint32_t index;
        bool good;
    } cases[] = { { "\"indices\":1", BYTES, 1, 3, true },
                  { "\"indices\":1", BYTES, 1, 4, false },
                  { "\"indices\":1", BYTES, 1, 255, false },
                  { "\"indices\":2", SHORTS, 2, 3, true },
                  { "\"indices\":2", SHORTS, 2, 4, false },
                  { "\"indices\":2", SHORTS, 2, 65535, false },
                  { "\"indices\":3", INTS, 4, 3, true },
                  { "\"indices\":3", INTS, 4, 4, false },
                  { "\"indices\":3", INTS, 4, 4294967295u, false } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = changed("\"indices\":1", cases[i].accessor);
        memcpy(bytes + cases[i].at, &cases[i].index, cases[i].size);
        expect(text, cases[i].good ? NULL : "an index past what it refers to", cases[i].accessor);
        free(text);
        fill_bytes();
    }
}

static void a_number_that_is_not_finite_is_refused(void **state) {
    (void)state;
    static const size_t offsets[] = { POSITIONS, TIMES, TRANSLATIONS };
    const float numbers[] = { NAN, INFINITY, -INFINITY };
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++)
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
            memcpy(bytes + offsets[i], &numbers[k], sizeof *numbers);
            expect(document, "not finite", "a number");
            fill_bytes();
        }
    const float late = 1.0f;
    memcpy(bytes + TIMES, &late, sizeof late);
    expect(document, NULL, "times that do not rise");
    fill_bytes();
}

/* Accessors hold the positions of one triangle in every component type, by KHR_mesh_quantization
 * where they are not floats. */
static void every_component_type_is_read(void **state) {
    (void)state;
    static const struct {
        int type;
        bool normalized;
        size_t size;
        long one; /* the integer that stands for 1, or 0 for floats */
    } types[] = { { 5120, false, 1, 1 },  { 5121, false, 1, 1 },    { 5122, false, 2, 1 },
                  { 5123, false, 2, 1 },  { 5126, false, 4, 0 },    { 5120, true, 1, 127 },
                  { 5121, true, 1, 255 }, { 5122, true, 2, 32767 }, { 5123, true, 2, 65535 } };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        char json[2048];
        const size_t stride = (3 * types[i].size + 3) & ~(size_t)3;
        snprintf(json, sizeof json,
                 "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
                 "\"extensionsUsed\":[\"KHR_mesh_quantization\"],"
                 "\"extensionsRequired\":[\"KHR_mesh_quantization\"],"
                 "\"nodes\":[{\"mesh\":0}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":%d,\"normalized\":%s,"
                 "\"count\":3,\"type\":\"VEC3\"}],"
                 "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":%zu}],"
                 "\"buffers\":[{\"byteLength\":320}]}",
                 types[i].type, types[i].normalized ? "true" : "false", 3 * stride, stride);
        memset(bytes, 0, sizeof bytes);
        for (size_t k = 1; k < 3; k++) {
            const float one = 1.0f;
            memcpy(bytes + k * stride + (k - 1) * types[i].size,
                   types[i].one ? (const void *)&types[i].one : &one, types[i].size);
        }
        scene_builder builder;
        base_error error;
        if (!reads(json, &builder, &error))
            fail_msg("type %d: %s", types[i].type, error.text);
        const scene_vertex *vertices = builder_items(&builder, BLOB_VERTICES);
        assert_int_equal(builder_count(&builder, BLOB_VERTICES), 3);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                CHECK_WITHIN(fabs((double)vertices[v].position[k] - (v == k + 1 ? 1.0 : 0.0)), 0.0);
        builder_free(&builder);
    }
    fill_bytes();
}

static void sparse_accessors_replace_their_elements(void **state) {
    (void)state;
    static const char format[] =
        "{\"bufferView\":0,\"byteOffset\":0,\"sparse\":{\"count\":%d,\"indices\":{\"bufferView\":1,"
        "\"componentType\":5121},\"values\":{\"bufferView\":6}},";
    char to[300];
    scene_builder builder;
    base_error error;
    /* The second translation is (1, 1, 1). */
    snprintf(to, sizeof to, format, 2);
    char *text = changed("{\"bufferView\":0,\"byteOffset\":0,", to);
    assert_true(reads(text, &builder, &error));
    const scene_vertex *vertices = builder_items(&builder, BLOB_VERTICES);
    const scene_instance *instances = builder_items(&builder, BLOB_INSTANCES);
    float second[3];
    scene_instance_point(&instances[0], vertices[1].position, second);
    CHECK_WITHIN(fabs((double)second[2] - (3.0 + 1.0)), 1e-6);
    builder_free(&builder);
    memcpy(bytes + BYTES, "\1\1\2", 3);
    expect(text, "do not rise", "sparse indices");
    memcpy(bytes + BYTES, "\0\4\2", 3);
    expect(text, "do not rise", "sparse indices");
    fill_bytes();
    free(text);
    snprintf(to, sizeof to, format, 5);
    text = changed("{\"bufferView\":0,\"byteOffset\":0,", to);
    expect(text, "invalid sparse data", "sparse count");
    free(text);
}

/* --- the container ---------------------------------------------------------------------------- */

static void expect_bytes(const void *data, size_t size, const char *refusal) {
    scene_builder builder;
    base_error error;
    const bool ok = reads_bytes(data, size, &builder, &error);
    if (ok != (refusal == NULL) || (refusal && !strstr(error.text, refusal)))
        fail_msg("\"%s\" instead of \"%s\"", ok ? "read" : error.text, refusal ? refusal : "read");
    builder_free(&builder);
}

static void damaged_containers_are_refused(void **state) {
    (void)state;
    size_t size;
    unsigned char *glb = pack_glb(document, &size);
    expect_bytes(glb, size, NULL);
    static const struct {
        size_t at;
        unsigned char value;
        const char *refusal;
    } damages[] = { { 4, 1, "version 2" },
                    { 8, 0, "is" },
                    { 16, 'X', "not JSON" },
                    { 12, 0xff, "an impossible length" },
                    { 20, ' ', "is not valid JSON" } };
    for (size_t i = 0; i < sizeof damages / sizeof *damages; i++) {
        const unsigned char kept = glb[damages[i].at];
        glb[damages[i].at] = damages[i].value;
        expect_bytes(glb, size, damages[i].refusal);
        glb[damages[i].at] = kept;
    }
    for (size_t length = 4; length < size; length += 7)
        expect_bytes(glb, length, "is ");
    unsigned char *longer = calloc(size + 4, 1);
    assert_non_null(longer);
    memcpy(longer, glb, size);
    expect_bytes(longer, size + 4, NULL);
    free(longer);
    free(glb);
}

static void what_is_no_json_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *refusal;
    } cases[] = {
        { "{\"asset\":{\"version\":\"2.0\"}}", NULL },
        { " \t\r\n{\"asset\":{\"version\":\"2.0\"}}\n", NULL },
        { "\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"}}", NULL },
        { "{\"asset\":{\"version\":\"2.0\"}} more",
          "is not valid JSON: line 1, column 32: end of file expected near 'more'" },
        { "{\"asset\":{\"version\":\"2.0\"}}\n}", "is not valid JSON: line 2" },
        { "{\"asset\":{\"version\":\"2.0\"},}", "a comma stands before the bracket that closes" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":01}", "invalid token near '0'" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":+1}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":1.}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":.5}", "a number begins with a digit or -" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":0x1}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":nan}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":-0.5e-3}", NULL },
        { "{\"asset\\u0000zzz\":{\"version\":\"2.0\"}}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\\u0000\"}}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":\"\\u00e9\\n\"}", NULL },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":\"\\x\"}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":\"\\ud83c\"}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},\"Z\xfcrich\":\"Z\xfcrich\"}", NULL },
        { "{\"asset\":{\"version\":\"2.0\"},\"a\":\"\n\"}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"},'a':1}", "is not valid JSON" },
        { "{\"asset\":{\"version\":\"2.0\"}", "is not valid JSON" },
        { "[]", "is not valid glTF" },
        { "", "is not valid JSON" }
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_bytes(cases[i].text, strlen(cases[i].text), cases[i].refusal);
}

/* --- what is unsupported ---------------------------------------------------------------------- */

#define MATERIAL(name)                                                                             \
    {                                                                                              \
        "\"doubleSided\":true", "\"extensions\":{\"KHR_materials_" name "\":{}}",                  \
            name " (1 material)"                                                                   \
    }

static void what_is_unsupported_is_named(void **state) {
    (void)state;
    static const struct {
        const char *from, *to, *named;
    } cases[] = {
        MATERIAL("transmission"),
        MATERIAL("anisotropy"),
        MATERIAL("volume"),
        MATERIAL("iridescence"),
        MATERIAL("dispersion"),
        { "\"scale\":[1,1,1]", "\"scale\":[1,1,1],\"extensions\":{\"MSFT_lod\":{}}",
          "MSFT_lod (1 node)" },
        { "\"mode\":4,", "\"mode\":4,\"extensions\":{\"EXT_mesh_features\":{}},",
          "EXT_mesh_features (1 mesh)" },
        { "\"source\":0,", "\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}},",
          "KHR_texture_basisu (1 texture)" },
        { "\"mode\":4", "\"mode\":1", "points and lines (1 primitive)" },
        { "\"source\":0,", "\"extensions\":{\"EXT_texture_avif\":{\"source\":0}},",
          "EXT_texture_avif (1 texture)" },
        { "\"intensity\":4", "\"intensity\":5", "range (1 light)" },
        { "\"path\":\"translation\"", "\"path\":\"translation\"", NULL },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = changed(cases[i].from, cases[i].to), line[200] = "";
        scene_builder builder;
        base_error error;
        assert_true(reads(text, &builder, &error));
        bool found = cases[i].named == NULL;
        const scene_unsupported *items = builder_items(&builder, BLOB_UNSUPPORTED);
        for (size_t k = 0; k < builder_count(&builder, BLOB_UNSUPPORTED); k++) {
            scene_unsupported_text(&items[k], line, sizeof line);
            found = found || strcmp(line, cases[i].named) == 0;
        }
        if (!found)
            fail_msg("\"%s\" is not named, but \"%s\"", cases[i].named, line);
        builder_free(&builder);
        free(text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_index_past_the_vertices_is_refused),
        cmocka_unit_test(a_number_that_is_not_finite_is_refused),
        cmocka_unit_test(every_component_type_is_read),
        cmocka_unit_test(sparse_accessors_replace_their_elements),
        cmocka_unit_test(damaged_containers_are_refused),
        cmocka_unit_test(what_is_no_json_is_refused),
        cmocka_unit_test(what_is_unsupported_is_named),
    };
    fill_bytes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
