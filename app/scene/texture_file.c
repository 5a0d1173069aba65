/* SPDX-License-Identifier: MIT */
#include "app/scene/texture_file.h"

#include "app/scene/texture.h"

#include <stdlib.h>
#include <string.h>

struct texture_name {
    char path[sizeof((source *)0)->path];
    uint32_t srgb, wrap_u, wrap_v;
};

bool texture_file_use(texture_files *files, const char *path, uint32_t srgb, scene_wrap wrap_u,
                      scene_wrap wrap_v, scene_texture_use *use, cli_error *error) {
    const size_t count = builder_count(files->builder, BLOB_TEXTURES);
    texture_name wanted = { .srgb = srgb, .wrap_u = wrap_u, .wrap_v = wrap_v };
    if (strlen(path) >= sizeof wanted.path)
        return cli_fail(error, files->sources->subject, "has a texture with too long a name");
    strcpy(wanted.path, path);
    for (size_t i = 0; i < count; i++)
        if (memcmp(&files->names[i], &wanted, sizeof wanted) == 0) {
            use->texture = (int32_t)i;
            return true;
        }
    const source *found;
    scene_texture decoded = { .srgb = srgb, .wrap_u = wrap_u, .wrap_v = wrap_v };
    if (!sources_read_if_there(files->sources, path, &found, error))
        return false;
    if (!found) {
        builder_left_out(files->builder, path, BUILDER_MISSING_FILE, 1);
        return true;
    }
    if (!texture_decode(files->builder, found->data, found->size, TEXTURE_ANY,
                        files->sources->subject, found->path, &decoded, error))
        return false;
    scene_clean_name(decoded.name, found->path);
    texture_name *names = realloc(files->names, (count + 1) * sizeof *names);
    if (names)
        files->names = names;
    scene_texture *texture = names ? builder_append(files->builder, BLOB_TEXTURES, 1) : NULL;
    if (!texture)
        return cli_fail(error, files->sources->subject, "does not fit into memory");
    names[count] = wanted;
    *texture = decoded;
    use->texture = (int32_t)count;
    return true;
}
