/* SPDX-License-Identifier: MIT */
/* gltf_check.c - checks a document against the schema's tables. */
#include "app/scene/gltf/gltf_schema.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The position of the walk through the document, as "materials[2].alphaMode". */
typedef struct walk {
    const gltf *document;
    char path[200];
    size_t length;
    const char *noun; /* of the object, for messages */
    base_error *error;
} walk;

static bool fail(const walk *w, const char *wrong) {
    return base_fail(w->error, w->document->subject, "is not valid glTF: %s %s", w->path, wrong);
}

/* Steps into a member or, with name NULL, an entry; returns the path length to step back to. */
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

/* How far a number may exceed a bound if it was rounded or went through float32. */
#define ROUNDING 1e-5

/* Notes a harmless violation of the specification in an object. */
static void note(const walk *w, const char *name, const char *what) {
    char text[SCENE_NAME_SIZE];
    snprintf(text, sizeof text, "%.40s %s", name, what);
    builder_unsupported(w->document->builder, text, w->noun, 1);
}

/* Clamps a number to its range, as viewers do: one bad value of a material or light is no reason to
 * reject the scene. A range that excludes its bound is left to the code that reads the number. */
static void clamp_number(const walk *w, const gltf_field *field, json_t *value) {
    const double given = json_number_value(value);
    const double bound = fmin(fmax(given, field->minimum), field->maximum);
    if (fabs(given - bound) > ROUNDING * fmax(1.0, fabs(bound)) ||
        (field->above && bound == field->minimum))
        note(w, field->name, "out of range");
    json_real_set(value, bound);
}

static bool is_choice(const char *choices, json_t *value) {
    char wanted[64];
    if (json_is_string(value))
        snprintf(wanted, sizeof wanted, " %.60s ", json_string_value(value));
    else
        snprintf(wanted, sizeof wanted, " %.0f ", json_number_value(value));
    return strstr(choices, wanted) != NULL && !strchr(wanted + 1, ' ')[1];
}

static bool check_number(const walk *w, const gltf_field *field, json_t *value) {
    if (!json_is_number(value))
        return fail(w, "is not a number");
    const double number = json_number_value(value);
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

static bool check_reference(const walk *w, const gltf_field *field, json_t *value) {
    const gltf_field index = { .type = GLTF_TYPE_INTEGER, .maximum = 9e15 };
    if (!check_number(w, &index, value))
        return false;
    return json_number_value(value) < (double)gltf_count(w->document, field->kind) ||
           fail(w, "refers to what is not there");
}

static bool check_object(walk *w, const gltf_object *object, json_t *value);

static bool check_references(walk *w, const gltf_field *field, json_t *value) {
    const char *name;
    json_t *item;
    if (!json_is_object(value))
        return fail(w, "is not an object");
    json_object_foreach (value, name, item) {
        const size_t before = step(w, name, 0);
        if (!check_reference(w, field, item))
            return false;
        step_back(w, before);
    }
    return true;
}

static bool check_value(walk *w, const gltf_field *field, json_t *value) {
    bool ok = true;
    switch (field->type) {
    case GLTF_TYPE_NUMBER:
    case GLTF_TYPE_INTEGER:
        ok = check_number(w, field, value);
        break;
    case GLTF_TYPE_TEXT:
        ok = json_is_string(value) || fail(w, "is not text");
        break;
    case GLTF_TYPE_FLAG:
        ok = json_is_boolean(value) || fail(w, "is neither true nor false");
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
    const json_t *x = *(json_t *const *)a, *y = *(json_t *const *)b;
    const double p = json_number_value(x), q = json_number_value(y);
    if (json_is_string(x) && json_is_string(y))
        return strcmp(json_string_value(x), json_string_value(y));
    return (p > q) - (p < q);
}

static bool check_distinct(const walk *w, const json_t *array, size_t count) {
    json_t **items = malloc((count + 1) * sizeof *items);
    bool ok = items || base_fail(w->error, w->document->subject, "does not fit into memory");
    for (size_t i = 0; i < count && ok; i++)
        items[i] = json_array_get(array, i);
    if (ok)
        qsort(items, count, sizeof *items, compare_items);
    for (size_t i = 1; i < count && ok; i++)
        ok = compare_items(&items[i - 1], &items[i]) != 0 || fail(w, "has an entry twice");
    free(items);
    return ok;
}

static bool check_array(walk *w, const gltf_field *field, json_t *array) {
    json_t *item;
    size_t i, count = json_array_size(array);
    if (!json_is_array(array))
        return fail(w, "is not an array");
    json_array_foreach (array, i, item) {
        const size_t before = step(w, NULL, i);
        if (!check_value(w, field, item))
            return false;
        step_back(w, before);
    }
    if (count < field->least || (field->most && count > field->most))
        return fail(w, "has the wrong number of entries");
    return !field->distinct || check_distinct(w, array, count);
}

/* --- objects ---------------------------------------------------------------------------------- */

/* Removes a field with an unknown value, and notes that. */
static json_t *forgive(const walk *w, const gltf_field *field, json_t *value, json_t *item) {
    const bool of_its_type =
        field->type == GLTF_TYPE_TEXT ? json_is_string(item) : json_is_number(item);
    if (!field->forgiven || !of_its_type || is_choice(field->choices, item))
        return item;
    note(w, "unknown", field->name);
    if (field->required)
        return item;
    json_object_del(value, field->name);
    return NULL;
}

static bool check_fields(walk *w, const gltf_field *fields, json_t *value) {
    for (const gltf_field *field = fields; field->name; field++) {
        json_t *item = json_object_get(value, field->name);
        item = forgive(w, field, value, item);
        if (!item && !field->required)
            continue;
        const size_t before = step(w, field->name, 0);
        if (!item)
            return fail(w, "is missing");
        if (!(field->array ? check_array(w, field, item) : check_value(w, field, item)))
            return false;
        step_back(w, before);
    }
    return true;
}

/* Whether an extension holds metadata about the file's author and tools, which shows nothing. */
static bool is_metadata(const char *extension) {
    return strcmp(extension, "KHR_xmp_json_ld") == 0 || strcmp(extension, "KHR_xmp") == 0;
}

static bool check_extensions(walk *w, const gltf_object *object, json_t *value) {
    static const gltf_field none = { .name = NULL };
    static const char prefix[] = "KHR_materials_";
    json_t *extensions = json_object_get(value, "extensions");
    const char *name;
    json_t *item;
    const gltf_field *known = object->extensions ? object->extensions : &none;
    if (!extensions)
        return true;
    const size_t before = step(w, "extensions", 0);
    if (!json_is_object(extensions))
        return fail(w, "is not an object");
    if (!check_fields(w, known, extensions))
        return false;
    json_object_foreach (extensions, name, item) {
        const gltf_field *field = known;
        while (field->name && strcmp(field->name, name) != 0)
            field++;
        const bool shorten = strncmp(name, prefix, sizeof prefix - 1) == 0;
        if (!field->name && !is_metadata(name))
            builder_unsupported(w->document->builder, name + (shorten ? sizeof prefix - 1 : 0),
                                object->noun, 1);
    }
    step_back(w, before);
    return true;
}

static bool check_object(walk *w, const gltf_object *object, json_t *value) {
    const char *const holder = w->noun;
    if (!json_is_object(value))
        return fail(w, "is not an object");
    w->noun = object->noun;
    const bool ok = check_fields(w, object->fields, value) && check_extensions(w, object, value);
    w->noun = holder;
    return ok;
}

bool gltf_check_schema(const gltf *document, base_error *error) {
    walk w = { .document = document, .error = error };
    if (!json_is_object(document->root))
        return base_fail(error, document->subject, "is not valid glTF: it is not a JSON object");
    return check_object(&w, &gltf_schema, document->root);
}

/* --- version and extensions ------------------------------------------------------------------- */

/* Parses a version such as "2.0" into 2 and 0. */
static bool parse_version(const char *text, int *major, int *minor) {
    char rest;
    return strspn(text, "0123456789.") == strlen(text) && strlen(text) < 10 &&
           sscanf(text, "%d.%d%c", major, minor, &rest) == 2;
}

bool gltf_check_version(const gltf *document, base_error *error) {
    json_t *asset = json_object_get(document->root, "asset");
    const char *version = gltf_text(asset, "version"), *least = gltf_text(asset, "minVersion");
    int major, minor, least_major = 2, least_minor = 0;
    if (!parse_version(version, &major, &minor))
        return base_fail(error, document->subject,
                         "is not valid glTF: asset.version is not a version such as 2.0");
    if (major != 2)
        return base_fail(error, document->subject, "is glTF %.16s (version 2.0 is read)", version);
    if (least[0] && !parse_version(least, &least_major, &least_minor))
        return base_fail(error, document->subject,
                         "is not valid glTF: asset.minVersion is not a version such as 2.0");
    if (least_major != 2 || least_minor > 0)
        return base_fail(error, document->subject,
                         "needs a reader of glTF %.16s (version 2.0 is read)", least);
    return true;
}

/* Whether a file may require an extension: it is supported, or a surface without it is still that
 * surface and it is noted as unsupported. */
static bool may_be_required(const char *name) {
    static const char *const known[] = { "KHR_texture_transform",
                                         "KHR_mesh_quantization",
                                         "EXT_mesh_gpu_instancing",
                                         "EXT_meshopt_compression",
                                         "KHR_draco_mesh_compression",
                                         "KHR_meshopt_compression",
                                         "EXT_texture_webp",
                                         "KHR_texture_basisu",
                                         "KHR_lights_punctual",
                                         "KHR_materials_emissive_strength",
                                         "KHR_materials_unlit",
                                         "KHR_materials_sheen",
                                         "KHR_materials_clearcoat",
                                         "KHR_materials_ior",
                                         "KHR_materials_specular",
                                         "KHR_materials_transmission",
                                         "KHR_materials_volume",
                                         "KHR_materials_anisotropy",
                                         "KHR_materials_iridescence",
                                         "KHR_materials_dispersion",
                                         "KHR_materials_variants",
                                         "EXT_lights_area",
                                         NULL };
    size_t i = 0;
    while (known[i] && strcmp(known[i], name) != 0)
        i++;
    return known[i] != NULL;
}

bool gltf_check_extensions(const gltf *document, base_error *error) {
    const json_t *required = json_object_get(document->root, "extensionsRequired");
    for (size_t i = 0; i < json_array_size(required); i++) {
        const char *name = json_string_value(json_array_get(required, i));
        if (!may_be_required(name))
            return base_fail(error, document->subject,
                             "requires the extension %.100s, which is not supported (export it "
                             "without)",
                             name);
    }
    return true;
}
