/* SPDX-License-Identifier: MIT */
/* gltf_use.c - whether accessors suit what refers to them, and whether fields fit together. */
#include "app/scene/gltf/gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- attributes ------------------------------------------------------------------------------- */

/* Component types, as bits. */
enum {
    B = 1,   /* signed byte */
    UB = 2,  /* unsigned byte */
    S = 4,   /* short */
    US = 8,  /* unsigned short */
    UI = 16, /* unsigned int */
    F = 32,  /* float */
    NORMALIZED = B | UB | S | US
};

static unsigned bit_of(gltf_component component) {
    return 1u << (component == GLTF_FLOAT     ? 5
                  : component - GLTF_BYTE > 4 ? 4
                                              : component - GLTF_BYTE);
}

/* The allowed accessors of an attribute: component types that are not normalized, and those that
 * are. */
typedef struct attribute {
    const char *name; /* '_' at its end: a number follows */
    int least_width, most_width;
    unsigned plain, normalized;
    /* with KHR_mesh_quantization */
    unsigned quantized_plain, quantized_normalized;
} attribute;

static const attribute vertex_attributes[] = {
    { "POSITION", 3, 3, F, 0, F | NORMALIZED, NORMALIZED },
    { "NORMAL", 3, 3, F, 0, F, B | S },
    { "TANGENT", 4, 4, F, 0, F, B | S },
    { "TEXCOORD_", 2, 2, F, UB | US, F | NORMALIZED, NORMALIZED },
    { "COLOR_", 3, 4, F, UB | US, F, UB | US },
    { "JOINTS_", 4, 4, UB | US, 0, UB | US, 0 },
    { "WEIGHTS_", 4, 4, F, UB | US, F, UB | US },
    { NULL, 0, 0, 0, 0, 0, 0 },
};
static const attribute target_attributes[] = {
    { "POSITION", 3, 3, F, 0, F | B | S, B | S },
    { "NORMAL", 3, 3, F, 0, F, B | S },
    { "TANGENT", 3, 3, F, 0, F, B | S },
    { "TEXCOORD_", 2, 2, F, B | UB | S | US, F | NORMALIZED, NORMALIZED },
    { "COLOR_", 3, 4, F, B | UB | S | US, F, NORMALIZED },
    { NULL, 0, 0, 0, 0, 0, 0 },
};
static const attribute instance_attributes[] = {
    { "TRANSLATION", 3, 3, F, 0, F, 0 },
    { "ROTATION", 4, 4, F, B | S, F, B | S },
    { "SCALE", 3, 3, F, 0, F, 0 },
    { NULL, 0, 0, 0, 0, 0, 0 },
};

static bool is_named(const attribute *known, const char *name) {
    const size_t length = strlen(known->name);
    if (known->name[length - 1] != '_')
        return strcmp(known->name, name) == 0;
    const char *number = name + length;
    return strncmp(known->name, name, length) == 0 && number[0] &&
           strspn(number, "0123456789") == strlen(number) && (number[0] != '0' || !number[1]);
}

static bool uses_quantization(const gltf *document) {
    const json_t *used = json_object_get(document->root, "extensionsUsed");
    for (size_t i = 0; i < json_array_size(used); i++)
        if (strcmp(json_string_value(json_array_get(used, i)), "KHR_mesh_quantization") == 0)
            return true;
    return false;
}

/* Checks all attributes of an object against a table: equal counts (*count, or the first's if that
 * is 0), allowed widths and types. Types that KHR_mesh_quantization adds are accepted, and noted,
 * without its declaration. Names that begin with an underscore are an application's own; other
 * unknown names are noted as unsupported. */
static bool check_attributes(const gltf *document, json_t *attributes, const attribute *table,
                             size_t *count) {
    const bool quantized = uses_quantization(document);
    const char *name;
    json_t *item;
    json_object_foreach (attributes, name, item) {
        const gltf_accessor *a = &document->accessors[(size_t)json_number_value(item)];
        const attribute *known = table;
        while (known->name && !is_named(known, name))
            known++;
        if (*count == 0)
            *count = a->count;
        if (a->count != *count)
            return false;
        if (!known->name) {
            if (name[0] != '_')
                builder_unsupported(document->builder, name, "attribute", 1);
            continue;
        }
        const unsigned bit = bit_of(a->component);
        if (a->width < known->least_width || a->width > known->most_width ||
            !((a->normalized ? known->quantized_normalized : known->quantized_plain) & bit))
            return false;
        if (!quantized && !((a->normalized ? known->normalized : known->plain) & bit))
            builder_unsupported(document->builder, "undeclared KHR_mesh_quantization", "attribute",
                                1);
    }
    return true;
}

/* --- meshes ----------------------------------------------------------------------------------- */

static bool check_indices(const gltf *document, long index) {
    if (index < 0)
        return true;
    const gltf_accessor *a = &document->accessors[index];
    return a->width == 1 && (bit_of(a->component) & (UB | US | UI)) &&
           a->stride == gltf_element_size("SCALAR", a->component);
}

static const char *primitive_wrong(const gltf *document, json_t *primitive) {
    json_t *attributes = json_object_get(primitive, "attributes");
    json_t *targets = json_object_get(primitive, "targets"), *target;
    size_t count = 0, i;
    if (!check_attributes(document, attributes, vertex_attributes, &count))
        return "has attributes that do not fit together, or are of no type they may be";
    if (!check_indices(document, gltf_index(primitive, "indices")))
        return "has indices that are no unsigned integers, or are interleaved";
    json_array_foreach (targets, i, target) {
        if (!check_attributes(document, target, target_attributes, &count))
            return "has a morph target that does not fit its vertices";
    }
    return NULL;
}

static bool check_mesh(const gltf *document, size_t i, base_error *error) {
    json_t *primitives = gltf_primitives(document, i), *primitive;
    json_t *weights = json_object_get(gltf_item(document, GLTF_MESHES, i), "weights");
    const size_t targets =
        json_array_size(json_object_get(json_array_get(primitives, 0), "targets"));
    size_t number;
    json_array_foreach (primitives, number, primitive) {
        const char *wrong = primitive_wrong(document, primitive);
        if (wrong)
            return gltf_fail(document, GLTF_MESHES, i, wrong, error);
        if (json_array_size(json_object_get(primitive, "targets")) != targets)
            return gltf_fail(document, GLTF_MESHES, i, "has primitives of unlike morph targets",
                             error);
    }
    return !weights || json_array_size(weights) == targets ||
           gltf_fail(document, GLTF_MESHES, i, "has not one weight a morph target", error);
}

/* --- nodes and skins -------------------------------------------------------------------------- */

static bool check_node(const gltf *document, size_t i, base_error *error) {
    json_t *node = gltf_item(document, GLTF_NODES, i);
    json_t *instances =
        json_object_get(gltf_extension(node, "EXT_mesh_gpu_instancing"), "attributes");
    json_t *weights = json_object_get(node, "weights");
    const long mesh = gltf_index(node, "mesh");
    size_t count = 0;
    if (mesh < 0) /* there is no mesh that a skin or weights would deform */
        weights = NULL;
    const json_t *first =
        mesh < 0 ? NULL : json_array_get(gltf_primitives(document, (size_t)mesh), 0);
    if (weights && json_array_size(weights) != json_array_size(json_object_get(first, "targets")))
        return gltf_fail(document, GLTF_NODES, i, "has not one weight a morph target", error);
    return check_attributes(document, instances, instance_attributes, &count) ||
           gltf_fail(document, GLTF_NODES, i, "has instances that do not fit together", error);
}

static bool check_skin(const gltf *document, size_t i, base_error *error) {
    json_t *skin = gltf_item(document, GLTF_SKINS, i);
    const long matrices = gltf_index(skin, "inverseBindMatrices");
    const gltf_accessor *a = matrices < 0 ? NULL : &document->accessors[matrices];
    const size_t joints = json_array_size(json_object_get(skin, "joints"));
    return !a || (a->width == 16 && a->component == GLTF_FLOAT && a->count >= joints) ||
           gltf_fail(document, GLTF_SKINS, i, "has no matrix for every joint", error);
}

/* --- cameras, images, animations -------------------------------------------------------------- */

/* Whether an entry is a camera of a known type; other cameras are noted as unsupported where they
 * are used. */
static bool is_camera(json_t *camera) {
    const char *type = gltf_text(camera, "type");
    return strcmp(type, "perspective") == 0 || strcmp(type, "orthographic") == 0;
}

static bool check_camera(const gltf *document, size_t i, base_error *error) {
    json_t *camera = gltf_item(document, GLTF_CAMERAS, i);
    json_t *view = json_object_get(camera, gltf_text(camera, "type"));
    if (!is_camera(camera))
        return true;
    if (!view ||
        (json_object_get(camera, "perspective") && json_object_get(camera, "orthographic")))
        return gltf_fail(document, GLTF_CAMERAS, i, "is not what its type says", error);
    return true;
}

/* Checks an image. Its bytes tell its format; an image without bytes is noted as unsupported where
 * it is used. */
static bool check_image(const gltf *document, size_t i, base_error *error) {
    json_t *image = gltf_item(document, GLTF_IMAGES, i);
    return !json_object_get(image, "bufferView") || !json_object_get(image, "uri") ||
           gltf_fail(document, GLTF_IMAGES, i, "has both a uri and a bufferView", error);
}

static bool check_light(const gltf *document, size_t i, base_error *error) {
    json_t *light = gltf_item(document, GLTF_LIGHTS, i);
    if (strcmp(gltf_text(light, "type"), "spot") == 0 && !json_object_get(light, "spot"))
        return gltf_fail(document, GLTF_LIGHTS, i, "is a spot without its cone", error);
    return true;
}

/* Returns the width of a property's values, or 0 if it does not belong to a node. */
static int path_width(const char *path) {
    return strcmp(path, "rotation") == 0                                    ? 4
           : strcmp(path, "translation") == 0 || strcmp(path, "scale") == 0 ? 3
           : strcmp(path, "weights") == 0                                   ? 1
                                                                            : 0;
}

static const char *channel_wrong(const gltf *document, json_t *channel, json_t *samplers,
                                 size_t sampler_count) {
    const double number = gltf_number(channel, "sampler", 0.0);
    if (!(number < (double)sampler_count))
        return "has a channel whose sampler is not there";
    json_t *sampler = json_array_get(samplers, (size_t)number);
    const gltf_accessor *times = &document->accessors[gltf_index(sampler, "input")];
    const gltf_accessor *values = &document->accessors[gltf_index(sampler, "output")];
    const char *path = gltf_text(json_object_get(channel, "target"), "path");
    const size_t a_key = strcmp(gltf_text(sampler, "interpolation"), "CUBICSPLINE") == 0 ? 3 : 1;
    const int width = path_width(path);
    if (times->width != 1 || times->component != GLTF_FLOAT)
        return "has times that are no floats";
    if (width == 0)
        return strcmp(path, "pointer") == 0 ? NULL : "has a channel of an unknown path";
    if (values->width != width || values->component == GLTF_UNSIGNED_INT ||
        (values->component != GLTF_FLOAT && !values->normalized))
        return "has values of another type than its path";
    if (width > 1 && values->count != times->count * a_key)
        return "has not one value a time";
    return NULL;
}

static bool check_animation(const gltf *document, size_t i, base_error *error) {
    json_t *animation = gltf_item(document, GLTF_ANIMATIONS, i);
    json_t *channels = json_object_get(animation, "channels"), *channel;
    json_t *samplers = json_object_get(animation, "samplers");
    const size_t count = json_array_size(samplers);
    size_t number;
    json_array_foreach (channels, number, channel) {
        const char *wrong = channel_wrong(document, channel, samplers, count);
        if (wrong)
            return gltf_fail(document, GLTF_ANIMATIONS, i, wrong, error);
    }
    return true;
}

bool gltf_check_uses(const gltf *document, base_error *error) {
    static const struct {
        gltf_kind kind;
        bool (*check)(const gltf *document, size_t i, base_error *error);
    } checks[] = { { GLTF_MESHES, check_mesh },         { GLTF_NODES, check_node },
                   { GLTF_SKINS, check_skin },          { GLTF_CAMERAS, check_camera },
                   { GLTF_IMAGES, check_image },        { GLTF_LIGHTS, check_light },
                   { GLTF_ANIMATIONS, check_animation } };
    for (size_t k = 0; k < sizeof checks / sizeof *checks; k++)
        for (size_t i = 0; i < gltf_count(document, checks[k].kind); i++)
            if (!checks[k].check(document, i, error))
                return false;
    return true;
}
