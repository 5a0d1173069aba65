/* SPDX-License-Identifier: MIT */
/* glTF documents, and their first variant if they have any: whatever is read is a valid scene. */
#include "app/scene/gltf/gltf.h"
#include "app/scene/load/origin.h"
#include "fuzz/scene.h"

/* Reads a scene and checks it; returns whether it has variants. */
static bool read_scene(const uint8_t *data, size_t size, const char *variant) {
    source_set sources = { .subject = "input", .folder = "/nonexistent", .variant = variant };
    scene_builder builder = { 0 };
    base_error error = { "" };
    if (origin_read(gltf_add, data, size, &sources, &builder, &error))
        fuzz_scene_check(&builder);
    const bool varied = builder_count(&builder, BLOB_VARIANTS) > 0;
    builder_free(&builder);
    sources_free(&sources);
    return varied;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (read_scene(data, size, NULL))
        read_scene(data, size, "0");
    return 0;
}
