/* SPDX-License-Identifier: MIT */
#include "app/scene/texture_file.h"

#include "app/base/file.h"

#include <string.h>

const char *texture_file_base_name(const char *path) {
    const char *const backslash = strrchr(path, '\\');
    return file_base_name(backslash ? backslash + 1 : path);
}

bool texture_embedded_use(texture_files *files, const texture_embedded *image, uint32_t srgb,
                          scene_wrap wrap_u, scene_wrap wrap_v, scene_texture_use *use,
                          base_error *error) {
    scene_builder *const builder = files->images.builder;
    const char *const subject = files->sources->subject;
    scene_texture texture = { .srgb = srgb, .wrap_u = wrap_u, .wrap_v = wrap_v };
    if (!texture_keep_once(&files->images, image->data, image->size, TEXTURE_ANY, subject,
                           image->name, &texture, error))
        return false;
    if (texture.width == 0) {
        builder_unsupported_file(builder, image->name, TEXTURE_UNDECODABLE);
        return true;
    }
    scene_clean_name(texture.name, image->name);
    const int32_t number = texture_use(builder, &texture);
    if (number < 0)
        return base_fail(error, subject, "does not fit into memory");
    use->texture = number;
    return true;
}

bool texture_file_use(texture_files *files, const char *path, uint32_t srgb, scene_wrap wrap_u,
                      scene_wrap wrap_v, scene_texture_use *use, base_error *error) {
    const source *found;
    source_state state, beside;
    if (!sources_read_optional(files->sources, path, &found, &state, error))
        return false;
    const char *const name = texture_file_base_name(path);
    if (!found && name > path &&
        !sources_read_optional(files->sources, name, &found, &beside, error))
        return false;
    if (!found) {
        builder_unsupported_file(files->images.builder, path, source_state_nouns[state]);
        return true;
    }
    const texture_embedded image = { found->path, found->data, found->size };
    return texture_embedded_use(files, &image, srgb, wrap_u, wrap_v, use, error);
}
