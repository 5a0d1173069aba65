/* SPDX-License-Identifier: MIT */
/* glTF documents, with their first variant where they have any: whatever is read is a scene that
 * the program takes. */
#include "app/scene/gltf.h"
#include "fuzz/scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    source_set sources = { .subject = "input", .folder = "/nonexistent" };
    scene_builder builder = { 0 };
    gltf document;
    cli_error error = { "" };
    if (gltf_open(data, size, &sources, &builder, &document, &error) &&
        gltf_add_variants(&document, &error) &&
        (builder_count(&builder, BLOB_VARIANTS) == 0 || gltf_show_variant(&document, 0, &error)) &&
        gltf_load(&document, &error) && gltf_add_meshes(&document, &builder, &error) &&
        gltf_add_materials(&document, &builder, &error) &&
        gltf_add_views(&document, &builder, &error))
        fuzz_scene_check(&builder);
    gltf_close(&document);
    builder_free(&builder);
    sources_free(&sources);
    return 0;
}
