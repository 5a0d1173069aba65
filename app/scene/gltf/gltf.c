/* SPDX-License-Identifier: MIT */
#include "app/scene/gltf/gltf.h"

#include <stdlib.h>
#include <string.h>

bool gltf_open(const void *data, size_t size, source_set *sources, scene_builder *builder,
               gltf *document, base_error *error) {
    *document = (gltf) {
        .subject = sources->subject, .sources = sources, .builder = builder, .variant = -1
    };
    return gltf_parse(document, data, size, error) && gltf_check_version(document, error) &&
           gltf_check_schema(document, error) && gltf_check_extensions(document, error);
}

bool gltf_load(gltf *document, base_error *error) {
    return gltf_load_buffers(document, error) && gltf_load_accessors(document, error) &&
           gltf_load_draco(document, error) && gltf_check_backing(document, error) &&
           gltf_load_nodes(document, error) && gltf_check_uses(document, error);
}

bool gltf_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
              base_error *error) {
    gltf document;
    const bool ok = gltf_open(data, size, sources, builder, &document, error) &&
                    gltf_choose_variant(&document, error) && gltf_load(&document, error) &&
                    gltf_add_meshes(&document, builder, error) &&
                    gltf_add_materials(&document, builder, error) &&
                    gltf_add_views(&document, builder, error);
    gltf_close(&document);
    return ok;
}

void gltf_close(gltf *document) {
    for (size_t i = 0; document->buffers && i < gltf_count(document, GLTF_BUFFERS); i++)
        free(document->buffers[i].owned);
    for (size_t i = 0; document->views && i < gltf_count(document, GLTF_VIEWS); i++)
        free(document->views[i].owned);
    for (size_t i = 0; document->accessors && i < gltf_count(document, GLTF_ACCESSORS); i++)
        free(document->accessors[i].owned);
    free(document->buffers);
    free(document->views);
    free(document->accessors);
    free(document->nodes);
    free(document->order);
    json_decref(document->root);
}
