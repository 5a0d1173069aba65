/* SPDX-License-Identifier: MIT */
/* OFF files: every index refers to a vertex. */
#include "app/scene/load/off.h"
#include "app/scene/load/origin.h"
#include "fuzz/scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    source_set sources = { .subject = "input", .folder = "/nonexistent" };
    scene_builder builder = { 0 };
    base_error error = { "" };
    if (origin_read(off_add, data, size, &sources, &builder, &error))
        fuzz_scene_check(&builder);
    builder_free(&builder);
    sources_free(&sources);
    return 0;
}
