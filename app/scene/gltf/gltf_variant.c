/* SPDX-License-Identifier: MIT */
/* gltf_variant.c - KHR_materials_variants: the material of a primitive in the chosen variant. */
#include "app/scene/gltf/gltf.h"
#include "app/scene/name.h"

#define EXTENSION "KHR_materials_variants"

static bool add_names(const gltf *document, base_error *error) {
    json_t *names = json_object_get(gltf_extension(document->root, EXTENSION), "variants"), *item;
    size_t i;
    json_array_foreach (names, i, item) {
        scene_variant *variant = builder_append(document->builder, BLOB_VARIANTS, 1);
        if (!variant)
            return base_fail(error, document->subject, "does not fit into memory");
        scene_clean_name(variant->name, gltf_text(item, "name"));
    }
    return true;
}

bool gltf_choose_variant(gltf *document, base_error *error) {
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

static bool is_for(json_t *mapping, long variant) {
    const json_t *numbers = json_object_get(mapping, "variants");
    for (size_t i = 0; i < json_array_size(numbers); i++)
        if (json_number_value(json_array_get(numbers, i)) == (double)variant)
            return true;
    return false;
}

/* Returns the material of the first mapping for the variant, or the primitive's own if there is
 * none. */
long gltf_primitive_material(const gltf *document, json_t *primitive) {
    json_t *mappings = json_object_get(gltf_extension(primitive, EXTENSION), "mappings"), *mapping;
    size_t i;
    json_array_foreach (mappings, i, mapping) {
        if (is_for(mapping, document->variant))
            return gltf_index(mapping, "material");
    }
    return gltf_index(primitive, "material");
}
