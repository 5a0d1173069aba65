/* SPDX-License-Identifier: MIT */
/* glTF: what the specification forbids is refused, what it allows is read. Every case is one change
 * to a valid document. */
#include "tests/program/gltf_document.h"

/* --- every field by type, range and reference ------------------------------------------------- */

/* Returns the end of the JSON value that begins here. */
static const char *value_end(const char *at) {
    if (*at == '"')
        return strchr(at + 1, '"') + 1;
    if (*at != '{' && *at != '[')
        return at + strcspn(at, ",]}");
    int depth = 0;
    do
        depth += *at == '{' || *at == '[' ? 1 : *at == '}' || *at == ']' ? -1 : 0;
    while (at++, depth > 0);
    return at;
}

static void replace_value(const char *value, const char *to, const char *what) {
    char *text = malloc(sizeof document + strlen(to));
    assert_non_null(text);
    sprintf(text, "%.*s%s%s", (int)(value - document), document, to, value_end(value));
    expect(text, "input: is not valid glTF: ", what);
    free(text);
}

/* Whether two texts begin values of one type of JSON. */
static bool same_type(char a, char b) {
    const char *bools = "tf", *digits = "-0123456789";
    return a == b || (strchr(bools, a) && strchr(bools, b)) ||
           (strchr(digits, a) && strchr(digits, b));
}

static void a_field_of_another_type_is_refused(void **state) {
    (void)state;
    static const char *const values[] = { "null", "true", "\"zzz\"", "{}", "[]", "[[]]", "7" };
    int tried = 0;
    for (const char *at = document; (at = strstr(at, "\":"));) {
        const char *name = at;
        while (name[-1] != '"')
            name--;
        at += 2;
        if (strncmp(name, "extras", 6) == 0)
            break;
        for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
            /* An array of arrays is not one of numbers, names or objects. An object without what it
             * must have is another matter. */
            if (same_type(*at, values[i][0]) && strcmp(values[i], "[[]]") != 0)
                continue;
            replace_value(at, values[i], name);
            tried++;
        }
    }
    assert_true(tried > 700);
}

/* Sizes, references and choices are whole numbers, and small in this document. */
static void a_number_out_of_range_is_refused(void **state) {
    (void)state;
    static const char *const names[] = { "scene",         "light",
                                         "mesh",          "skin",
                                         "camera",        "node",
                                         "sampler",       "source",
                                         "index",         "input",
                                         "output",        "material",
                                         "indices",       "mode",
                                         "skeleton",      "POSITION",
                                         "JOINTS_0",      "WEIGHTS_0",
                                         "buffer",        "bufferView",
                                         "byteOffset",    "count",
                                         "componentType", "byteLength",
                                         "byteStride",    "inverseBindMatrices" };
    static const char *const values[] = {
        "-1", "0.5", "10000", "-2e9", "1e300", "9007199254740993"
    };
    int tried = 0;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char key[64];
        snprintf(key, sizeof key, "\"%s\":", names[k]);
        for (const char *at = document; (at = strstr(at, key));) {
            at += strlen(key);
            for (size_t i = 0; strchr("0123456789", *at) && i < sizeof values / sizeof *values;
                 i++, tried++)
                replace_value(at, values[i], names[k]);
        }
    }
    assert_true(tried > 400);
}

static void what_must_be_there_is_missed(void **state) {
    (void)state;
    static const char *const fields[] = {
        "\"asset\":",         "\"version\":",       "\"type\":\"spot\",",
        "\"yfov\":0.6,",      "\"joints\":",        "\"primitives\":",
        "\"attributes\":",    "\"channels\":",      "\"samplers\":[{\"input\"",
        "\"input\":",         "\"output\":",        "\"target\":{",
        "\"path\":",          "\"componentType\":", "\"count\":",
        "\"type\":\"VEC3\"",  "\"buffer\":0",       "\"byteLength\":48",
        "\"index\":0,",       "\"light\":0",        "\"lights\":[",
        "\"byteLength\":320", "\"spot\":{",         "\"perspective\":{"
    };
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        /* Under another name a member means nothing to a reader. */
        char renamed[64];
        snprintf(renamed, sizeof renamed, "\"_%s", fields[i] + 1);
        char *text = changed(fields[i], renamed);
        expect(text, "input: is not valid glTF: ", fields[i]);
        free(text);
    }
}

/* --- one by one ------------------------------------------------------------------------------- */

typedef struct change {
    const char *from, *to;
    const char *refusal; /* NULL if it is read */
} change;

static const change changes[] = {
    { "{\"asset\"", "{\"asset\"", NULL },
    /* the asset */
    { "\"version\":\"2.0\"", "\"version\":\"1.0\"", "is glTF 1.0" },
    { "\"version\":\"2.0\"", "\"version\":\"2\"", "asset.version" },
    { "\"version\":\"2.0\"", "\"version\":\"2.1\"", NULL },
    { "\"minVersion\":\"2.0\"", "\"minVersion\":\"9.9\"", "needs a reader of glTF 9.9" },
    { "\"minVersion\":\"2.0\"", "\"minVersion\":\"2.1\"", "needs a reader of glTF 2.1" },
    { "[\"KHR_texture_transform\"]", "[\"EXT_never_heard_of\"]",
      "requires the extension EXT_never_heard_of" },
    { "\"generator\":\"test\"", "\"generator\":\"test\",\"generator\":\"other\"",
      "duplicate object key near '\"generator\"'" },
    { "\"scene\":0,", "", NULL },
    { "\"scene\":0", "\"scene\":1", "scene refers to what is not there" },
    { "\"extras\":{", "\"unknown\":{", NULL },
    /* nodes */
    { "\"nodes\":[0,2,3]", "\"nodes\":[0,0]", "twice" },
    { "\"nodes\":[0,2,3]", "\"nodes\":[0,1]", "the child of another node" },
    { "\"nodes\":[0,2,3]", "\"nodes\":[]", NULL },
    { "\"children\":[1]", "\"children\":[0]", "node 0" },
    { "\"children\":[1]", "\"children\":[4]", "nodes[0].children[0]" },
    { "\"children\":[1]", "\"children\":[]", NULL },
    { "\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0.6,0.8]", NULL },
    { "\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,1]", "number of entries" },
    { "\"camera\":0,\"matrix\"", "\"scale\":[1,1,2],\"matrix\"", "a matrix and its parts" },
    { "0,0,9,1]", "0,0,9,2]", "last row" },
    { "\"mesh\":0,\"skin\":0", "\"mesh\":0,\"weights\":[1]", "one weight a morph target" },
    /* cameras and lights */
    { "\"zfar\":10,", "", NULL },
    { "\"type\":\"perspective\"", "\"type\":\"orthographic\"", "camera 0" },
    /* materials and images */
    { "\"alphaCutoff\":0.5", "\"alphaCutoff\":2", NULL },
    { "\"source\":0,", "", NULL },
    { "\"bufferView\":9,", "\"bufferView\":9,\"uri\":\"a.png\",", "both a uri and a bufferView" },
    /* accessors and views */
    { "\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"",
      "\"componentType\":5125,\"count\":4,\"type\":\"VEC3\"", "mesh 0 has attributes" },
    { "\"type\":\"VEC3\",\"min\"", "\"type\":\"VEC2\",\"min\"", "mesh 0 has attributes" },
    { "\"min\":[0,0,0],\"max\":[1,1,0]", "\"name\":\"no bounds\"", NULL },
    { "\"byteStride\":12", "\"byteStride\":8", "elements that overlap" },
    { "\"byteStride\":12", "\"byteStride\":13", "multiple of 4" },
    { "\"byteStride\":12", "\"byteStride\":16", "reaches outside" },
    { "\"byteLength\":48,", "\"byteLength\":47,", "reaches outside" },
    { "\"byteOffset\":52", "\"byteOffset\":53", "not aligned" },
    { "\"bufferView\":0,\"byteOffset\":0", "\"bufferView\":0,\"byteOffset\":2", "accessor 0" },
    { "\"bufferView\":0,\"byteOffset\":0,", "", NULL },
    { "\"byteLength\":320", "\"byteLength\":321", "longer than its data" },
    { "\"byteLength\":3,", "\"byteLength\":9,\"byteStride\":4,", "no unsigned integers" },
    /* primitives */
    { "\"indices\":1", "\"indices\":2", NULL },
    { "\"indices\":1", "\"indices\":3", NULL },
    { "\"indices\":1", "\"indices\":0", "no unsigned integers" },
    { "\"indices\":1,", "", NULL },
    { "\"componentType\":5121,\"count\":3", "\"componentType\":5120,\"count\":3",
      "no unsigned integers" },
    { "\"componentType\":5123,\"count\":3", "\"componentType\":5122,\"count\":3", NULL },
    { "\"JOINTS_0\":7", "\"JOINTS_0\":8", "mesh 0 has attributes" },
    { "\"JOINTS_0\":7", "\"_OWN\":7", NULL },
    { "\"POSITION\":0", "\"POSITION\":6", "mesh 0 has attributes" },
    { "\"mode\":4", "\"mode\":5", NULL },
    { "\"mode\":4", "\"mode\":7", "out of range" },
    { "\"mode\":4", "\"targets\":[{\"POSITION\":0}]", NULL },
    { "\"mode\":4", "\"targets\":[{\"POSITION\":6}]", "morph target" },
    /* skins and animations */
    { "\"joints\":[0]", "\"joints\":[0,1]", "no matrix for every joint" },
    { "\"joints\":[0]", "\"joints\":[]", "number of entries" },
    { "\"sampler\":0,\"target\"", "\"sampler\":1,\"target\"", "whose sampler is not there" },
    { "\"path\":\"translation\"", "\"path\":\"rotation\"", "another type than its path" },
    { "\"path\":\"translation\"", "\"path\":\"color\"", "unknown path" },
    { "\"LINEAR\"", "\"CUBICSPLINE\"", "one value a time" },
    { "\"input\":5", "\"input\":1", "no floats" },
};

static void each_change_is_accepted_or_refused(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char *text = changed(changes[i].from, changes[i].to);
        expect(text, changes[i].refusal, changes[i].to);
        free(text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_of_another_type_is_refused),
        cmocka_unit_test(a_number_out_of_range_is_refused),
        cmocka_unit_test(what_must_be_there_is_missed),
        cmocka_unit_test(each_change_is_accepted_or_refused),
    };
    fill_bytes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
