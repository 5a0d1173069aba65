/* SPDX-License-Identifier: MIT */
/* OBJ files with their MTL files: what follows a line of three dashes is the library of
 * materials. */
#include "app/scene/load/obj.h"
#include "app/scene/load/mtl.h"
#include "app/scene/load/origin.h"
#include "fuzz/scene.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *text = (const char *)data, *split = memmem(data, size, "---\n", 4);
    const size_t obj_size = split ? (size_t)(split - text) : size;
    source_set sources = { .subject = "input", .folder = "/nonexistent" };
    scene_builder builder = { 0 };
    texture_files files = { .sources = &sources, .images.builder = &builder };
    mtl_names names = { .items = NULL };
    base_error error = { "" };
    if (origin_read(obj_add, text, obj_size, &sources, &builder, &error))
        fuzz_scene_check(&builder);
    if (split)
        mtl_add(split + 4, size - obj_size - 4, &files, &names, &error);
    mtl_sort(&names);
    mtl_names_free(&names);
    free(files.images.items);
    builder_free(&builder);
    sources_free(&sources);
    return 0;
}
