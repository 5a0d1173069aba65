/* SPDX-License-Identifier: MIT */
/* gltf_check.c - a document against the schema's tables. */
#include "app/scene/gltf_schema.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where in the document the walk is, as "materials[2].alphaMode". */
typedef struct walk {
    const gltf *document;
    char path[200];
    size_t length;
    const char *noun; /* of the object */
    cli_error *error;
} walk;

static bool fail(const walk *w, const char *wrong) {
    return cli_fail(w->error, w->document->subject, "is not valid glTF: %s %s", w->path, wrong);
}

/* Steps into a member or, with name NULL, an entry; returns the length to step back to. */
static size_t step(walk *w, const char *name, size_t index) {
    const size_t before = w->length, room = sizeof w->path - before;
    const int written = name ? snprintf(w->path + before, room, "%s%.60s", before ? "." : "", name)
                             : snprintf(w->path + before, room, "[%zu]", index);
    w->length += (size_t)written < room ? (size_t)written : room - 1;
    return before;
}

static void step_back(walk *w, size_t length) {
    w->length = length;
    w->path[length] = 0;
}

/* How far past a bound a number may be that was rounded, or went through float32. */
#define ROUNDING 1e-5

/* Says what of an object is not as the specification wants it, and yet harms nothing. */
static void note(const walk *w, const char *name, const char *what) {
    char text[SCENE_NAME_SIZE];
    snprintf(text, sizeof text, "%.40s %s", name, what);
    builder_left_out(w->document->builder, text, w->noun, 1);
}

/* Brings a number into its range, as viewers do: a material's or a light's is no reason to see
 * nothing of the scene. A bound that is none itself is up to who reads it. */
static void clamp_number(const walk *w, const gltf_field *field, cJSON *value) {
    const double given = value->valuedouble;
    const double bound = fmin(fmax(given, field->minimum), field->maximum);
    if (fabs(given - bound) > ROUNDING * fmax(1.0, fabs(bound)) ||
        (field->above && bound == field->minimum))
        note(w, field->name, "out of range");
    value->valuedouble = bound;
}

static bool is_choice(const char *choices, const cJSON *value) {
    char wanted[64];
    if (cJSON_IsString(value))
        snprintf(wanted, sizeof wanted, " %.60s ", value->valuestring);
    else
        snprintf(wanted, sizeof wanted, " %.0f ", value->valuedouble);
    return strstr(choices, wanted) != NULL && !strchr(wanted + 1, ' ')[1];
}

static bool check_number(const walk *w, const gltf_field *field, cJSON *value) {
    if (!cJSON_IsNumber(value))
        return fail(w, "is not a number");
    const double number = value->valuedouble;
    if (!isfinite(number))
        return fail(w, "is not a finite number");
    if (field->type == GLTF_TYPE_INTEGER && number != floor(number))
        return fail(w, "is not a whole number");
    const bool any = field->minimum == 0.0 && field->maximum == 0.0;
    if (!any && field->type == GLTF_TYPE_NUMBER) {
        clamp_number(w, field, value);
        return true;
    }
    if (!any && !(number >= field->minimum && number <= field->maximum))
        return fail(w, "is out of range");
    return true;
}

static bool check_reference(const walk *w, const gltf_field *field, cJSON *value) {
    const gltf_field index = { .type = GLTF_TYPE_INTEGER, .maximum = 9e15 };
    if (!check_number(w, &index, value))
        return false;
    return value->valuedouble < (double)gltf_count(w->document, field->kind) ||
           fail(w, "refers to what is not there");
}

static bool check_object(walk *w, const gltf_object *object, cJSON *value);

static bool check_references(walk *w, const gltf_field *field, cJSON *value) {
    cJSON *item;
    if (!cJSON_IsObject(value))
        return fail(w, "is not an object");
    cJSON_ArrayForEach(item, value) {
        const size_t before = step(w, item->string, 0);
        if (!check_reference(w, field, item))
            return false;
        step_back(w, before);
    }
    return true;
}

static bool check_value(walk *w, const gltf_field *field, cJSON *value) {
    bool ok = true;
    switch (field->type) {
    case GLTF_TYPE_NUMBER:
    case GLTF_TYPE_INTEGER:
        ok = check_number(w, field, value);
        break;
    case GLTF_TYPE_TEXT:
        ok = cJSON_IsString(value) || fail(w, "is not text");
        break;
    case GLTF_TYPE_FLAG:
        ok = cJSON_IsBool(value) || fail(w, "is neither true nor false");
        break;
    case GLTF_TYPE_OBJECT:
        ok = check_object(w, field->object, value);
        break;
    case GLTF_TYPE_REFERENCE:
        ok = check_reference(w, field, value);
        break;
    case GLTF_TYPE_REFERENCES:
        ok = check_references(w, field, value);
        break;
    }
    return ok && (!field->choices || field->forgiven || is_choice(field->choices, value) ||
                  fail(w, "is not one of the values that glTF knows"));
}

/* --- arrays ----------------------------------------------------------------------------------- */

static int compare_items(const void *a, const void *b) {
    const cJSON *x = *(const cJSON *const *)a, *y = *(const cJSON *const *)b;
    if (x->valuestring && y->valuestring)
        return strcmp(x->valuestring, y->valuestring);
    return (x->valuedouble > y->valuedouble) - (x->valuedouble < y->valuedouble);
}

static bool check_distinct(const walk *w, const cJSON *array, size_t count) {
    const cJSON **items = malloc((count + 1) * sizeof *items), *item;
    bool ok = items || cli_fail(w->error, w->document->subject, "does not fit into memory");
    size_t i = 0;
    if (ok)
        cJSON_ArrayForEach(item, array) items[i++] = item;
    if (ok)
        qsort(items, count, sizeof *items, compare_items);
    for (i = 1; i < count && ok; i++)
        ok = compare_items(&items[i - 1], &items[i]) != 0 || fail(w, "has an entry twice");
    free(items);
    return ok;
}

static bool check_array(walk *w, const gltf_field *field, cJSON *array) {
    cJSON *item;
    size_t count = 0;
    if (!cJSON_IsArray(array))
        return fail(w, "is not an array");
    cJSON_ArrayForEach(item, array) {
        const size_t before = step(w, NULL, count++);
        if (!check_value(w, field, item))
            return false;
        step_back(w, before);
    }
    if (count < field->least || (field->most && count > field->most))
        return fail(w, "has the wrong number of entries");
    return !field->distinct || check_distinct(w, array, count);
}

/* --- objects ---------------------------------------------------------------------------------- */

/* Takes a field out that has another than the known values, and says so. */
static cJSON *forgive(const walk *w, const gltf_field *field, cJSON *value, cJSON *item) {
    const bool of_its_type =
        field->type == GLTF_TYPE_TEXT ? cJSON_IsString(item) : cJSON_IsNumber(item);
    if (!field->forgiven || !of_its_type || is_choice(field->choices, item))
        return item;
    note(w, "unknown", field->name);
    if (field->required)
        return item;
    cJSON_Delete(cJSON_DetachItemViaPointer(value, item));
    return NULL;
}

static bool check_fields(walk *w, const gltf_field *fields, cJSON *value) {
    for (const gltf_field *field = fields; field->name; field++) {
        cJSON *item = cJSON_GetObjectItemCaseSensitive(value, field->name);
        item = forgive(w, field, value, item);
        const size_t before = step(w, field->name, 0);
        if (!item && field->required)
            return fail(w, "is missing");
        if (item && !(field->array ? check_array(w, field, item) : check_value(w, field, item)))
            return false;
        step_back(w, before);
    }
    return true;
}

/* Texts that say who made the file and how: nothing to be seen. */
static bool is_metadata(const char *extension) {
    return strcmp(extension, "KHR_xmp_json_ld") == 0 || strcmp(extension, "KHR_xmp") == 0;
}

static bool check_extensions(walk *w, const gltf_object *object, cJSON *value) {
    static const gltf_field none = { .name = NULL };
    static const char prefix[] = "KHR_materials_";
    cJSON *extensions = cJSON_GetObjectItemCaseSensitive(value, "extensions");
    const cJSON *item;
    const gltf_field *known = object->extensions ? object->extensions : &none;
    if (!extensions)
        return true;
    const size_t before = step(w, "extensions", 0);
    if (!cJSON_IsObject(extensions))
        return fail(w, "is not an object");
    if (!check_fields(w, known, extensions))
        return false;
    cJSON_ArrayForEach(item, extensions) {
        const gltf_field *field = known;
        while (field->name && strcmp(field->name, item->string) != 0)
            field++;
        const bool shorten = strncmp(item->string, prefix, sizeof prefix - 1) == 0;
        if (!field->name && !is_metadata(item->string))
            builder_left_out(w->document->builder, item->string + (shorten ? sizeof prefix - 1 : 0),
                             object->noun, 1);
    }
    step_back(w, before);
    return true;
}

static bool check_object(walk *w, const gltf_object *object, cJSON *value) {
    const char *const holder = w->noun;
    if (!cJSON_IsObject(value))
        return fail(w, "is not an object");
    w->noun = object->noun;
    const bool ok = check_fields(w, object->fields, value) && check_extensions(w, object, value);
    w->noun = holder;
    return ok;
}

bool gltf_check_schema(const gltf *document, cli_error *error) {
    walk w = { .document = document, .error = error };
    if (!cJSON_IsObject(document->root))
        return cli_fail(error, document->subject, "is not valid glTF: it is not a JSON object");
    return check_object(&w, &gltf_schema, document->root);
}

/* --- version and extensions ------------------------------------------------------------------- */

/* "2.0" as 2 and 0. */
static bool parse_version(const char *text, int *major, int *minor) {
    char rest;
    return strspn(text, "0123456789.") == strlen(text) && strlen(text) < 10 &&
           sscanf(text, "%d.%d%c", major, minor, &rest) == 2;
}

bool gltf_check_version(const gltf *document, cli_error *error) {
    const cJSON *asset = gltf_member(document->root, "asset");
    const char *version = gltf_text(asset, "version"), *least = gltf_text(asset, "minVersion");
    int major, minor, least_major = 2, least_minor = 0;
    if (!parse_version(version, &major, &minor))
        return cli_fail(error, document->subject,
                        "is not valid glTF: asset.version is not a version such as 2.0");
    if (major != 2)
        return cli_fail(error, document->subject, "is glTF %.16s (version 2.0 is read)", version);
    if (least[0] && !parse_version(least, &least_major, &least_minor))
        return cli_fail(error, document->subject,
                        "is not valid glTF: asset.minVersion is not a version such as 2.0");
    if (least_major != 2 || least_minor > 0)
        return cli_fail(error, document->subject,
                        "needs a reader of glTF %.16s (version 2.0 is read)", least);
    return true;
}

/* Extensions that a file may require: what they say is read, or a surface without them is still
 * that surface, and they are named as left out. */
static bool may_be_required(const char *name) {
    static const char *const known[] = {
        "KHR_texture_transform",      "KHR_mesh_quantization",
        "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",
        "KHR_draco_mesh_compression", "KHR_meshopt_compression",
        "EXT_texture_webp",           "KHR_texture_basisu",
        "KHR_lights_punctual",        "KHR_materials_emissive_strength",
        "KHR_materials_unlit",        "KHR_materials_sheen",
        "KHR_materials_clearcoat",    "KHR_materials_ior",
        "KHR_materials_specular",     "KHR_materials_transmission",
        "KHR_materials_volume",       "KHR_materials_anisotropy",
        "KHR_materials_iridescence",  "KHR_materials_dispersion",
        "KHR_materials_variants",     NULL
    };
    size_t i = 0;
    while (known[i] && strcmp(known[i], name) != 0)
        i++;
    return known[i] != NULL;
}

bool gltf_check_extensions(const gltf *document, cli_error *error) {
    const cJSON *item;
    cJSON_ArrayForEach(item, gltf_member(document->root, "extensionsRequired")) {
        if (!may_be_required(item->valuestring))
            return cli_fail(error, document->subject,
                            "requires the extension %.100s, which is not supported (export it "
                            "without)",
                            item->valuestring);
    }
    return true;
}
