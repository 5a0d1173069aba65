/* SPDX-License-Identifier: MIT */
/* PLY files: every index refers to a vertex. */
#include "app/scene/load/ply.h"
#include "app/scene/load/origin.h"
#include "app/scene/load/ply_header.h"
#include "fuzz/scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    source_set sources = { .subject = "input", .folder = "/nonexistent" };
    scene_builder builder = { 0 };
    ply_header header;
    base_error error = { "" };
    if (ply_header_parse((const char *)data, size, "input", &header, &error) && header.size > size)
        abort();
    if (origin_read(ply_add, data, size, &sources, &builder, &error))
        fuzz_scene_check(&builder);
    builder_free(&builder);
    sources_free(&sources);
    return 0;
}
