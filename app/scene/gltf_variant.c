/* SPDX-License-Identifier: MIT */
/* gltf_variant.c - KHR_materials_variants: which of its materials a primitive shows. */
#include "app/scene/gltf.h"
#include "app/scene/name.h"

#define EXTENSION "KHR_materials_variants"

static bool add_names(const gltf *document, cli_error *error) {
    const cJSON *names = gltf_member(gltf_extension(document->root, EXTENSION), "variants"), *item;
    cJSON_ArrayForEach(item, names) {
        scene_variant *variant = builder_append(document->builder, BLOB_VARIANTS, 1);
        if (!variant)
            return cli_fail(error, document->subject, "does not fit into memory");
        scene_clean_name(variant->name, gltf_text(item, "name"));
    }
    return true;
}

/* The material of the first mapping that is for the variant; NULL: the primitive keeps its own. */
static const cJSON *material_for(const cJSON *primitive, size_t variant) {
    const cJSON *mappings = gltf_member(gltf_extension(primitive, EXTENSION), "mappings");
    const cJSON *mapping, *number;
    cJSON_ArrayForEach(mapping, mappings) {
        cJSON_ArrayForEach(number, gltf_member(mapping, "variants")) {
            if (number->valuedouble == (double)variant)
                return gltf_member(mapping, "material");
        }
    }
    return NULL;
}

static bool show(cJSON *primitive, size_t variant) {
    const cJSON *material = material_for(primitive, variant);
    if (!material)
        return true;
    cJSON_DeleteItemFromObjectCaseSensitive(primitive, "material");
    return cJSON_AddNumberToObject(primitive, "material", material->valuedouble);
}

static bool show_everywhere(const gltf *document, size_t variant, cli_error *error) {
    cJSON *mesh, *primitive;
    cJSON_ArrayForEach(mesh, cJSON_GetObjectItemCaseSensitive(document->root, "meshes")) {
        cJSON_ArrayForEach(primitive, cJSON_GetObjectItemCaseSensitive(mesh, "primitives")) {
            if (!show(primitive, variant))
                return cli_fail(error, document->subject, "does not fit into memory");
        }
    }
    return true;
}

bool gltf_choose_variant(const gltf *document, cli_error *error) {
    const char *wanted = document->sources->variant;
    size_t chosen;
    if (!add_names(document, error))
        return false;
    const scene_variant *variants = builder_items(document->builder, BLOB_VARIANTS);
    const size_t count = builder_count(document->builder, BLOB_VARIANTS);
    return !wanted ||
           (scene_find_name(document->subject, "variant", wanted, count ? variants->name : NULL,
                            sizeof *variants, count, &chosen, error) &&
            show_everywhere(document, chosen, error));
}
