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

bool gltf_choose_variant(gltf *document, cli_error *error) {
    const char *wanted = document->sources->variant;
    size_t chosen;
    if (!add_names(document, error))
        return false;
    const scene_variant *variants = builder_items(document->builder, BLOB_VARIANTS);
    const size_t count = builder_count(document->builder, BLOB_VARIANTS);
    if (!wanted)
        return true;
    if (!scene_find_name(document->subject, "variant", wanted, count ? variants->name : NULL,
                         sizeof *variants, count, &chosen, error))
        return false;
    document->variant = (long)chosen;
    return true;
}

static bool is_for(const cJSON *mapping, long variant) {
    const cJSON *number;
    cJSON_ArrayForEach(number, gltf_member(mapping, "variants")) {
        if (number->valuedouble == (double)variant)
            return true;
    }
    return false;
}

/* By the first mapping that is for the variant; without one the primitive keeps its own. */
long gltf_primitive_material(const gltf *document, const cJSON *primitive) {
    const cJSON *mapping;
    cJSON_ArrayForEach(mapping, gltf_member(gltf_extension(primitive, EXTENSION), "mappings")) {
        if (is_for(mapping, document->variant))
            return gltf_index(mapping, "material");
    }
    return gltf_index(primitive, "material");
}
