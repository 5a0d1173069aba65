/* SPDX-License-Identifier: MIT */
#include "app/scene/assimp_material.h"

#include "app/scene/phong.h"
#include "app/scene/texture_file.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <math.h>
#include <stdlib.h>

static void read_color(const struct aiMaterial *from, const char *key, float color[3]) {
    struct aiColor4D found;
    if (aiGetMaterialColor(from, key, 0, 0, &found) != aiReturn_SUCCESS)
        return;
    const float numbers[3] = { found.r, found.g, found.b };
    for (int k = 0; k < 3; k++)
        if (isfinite(numbers[k]))
            color[k] = numbers[k];
}

static float number_of(const struct aiMaterial *from, const char *key, float fallback) {
    float number = fallback;
    unsigned count = 1;
    return aiGetMaterialFloatArray(from, key, 0, 0, &number, &count) == aiReturn_SUCCESS &&
                   isfinite(number)
               ? number
               : fallback;
}

static scene_wrap wrap_of(enum aiTextureMapMode mode) {
    return mode == aiTextureMapMode_Clamp    ? SCENE_WRAP_CLAMP
           : mode == aiTextureMapMode_Mirror ? SCENE_WRAP_MIRROR
                                             : SCENE_WRAP_REPEAT;
}

static bool read_map(const struct aiMaterial *from, enum aiTextureType type, uint32_t srgb,
                     texture_files *files, scene_texture_use *use, cli_error *error) {
    struct aiString path;
    enum aiTextureMapMode modes[2] = { aiTextureMapMode_Wrap, aiTextureMapMode_Wrap };
    if (aiGetMaterialTexture(from, type, 0, &path, NULL, NULL, NULL, NULL, modes, NULL) !=
            aiReturn_SUCCESS ||
        path.length == 0)
        return true;
    if (path.data[0] == '*') {
        builder_left_out(files->images.builder, "embedded texture", "material", 1);
        return true;
    }
    return texture_file_use(files, path.data, srgb, wrap_of(modes[0]), wrap_of(modes[1]), use,
                            error);
}

static bool read_material(const struct aiMaterial *from, texture_files *files, cli_error *error) {
    struct aiString name = { 0 };
    phong factors = { .diffuse = { 0.6f, 0.6f, 0.6f },
                      .exponent = number_of(from, "$mat.shininess", 0.0f),
                      .opacity = number_of(from, "$mat.opacity", 1.0f) };
    aiGetMaterialString(from, "?mat.name", 0, 0, &name);
    read_color(from, "$clr.diffuse", factors.diffuse);
    read_color(from, "$clr.specular", factors.specular);
    read_color(from, "$clr.emissive", factors.emission);
    scene_material *to = builder_material(files->images.builder, name.data);
    if (!to)
        return cli_fail(error, files->sources->subject, "does not fit into memory");
    phong_apply(&factors, to);
    return read_map(from, aiTextureType_DIFFUSE, 1, files, &to->base_color_map, error) &&
           read_map(from, aiTextureType_NORMALS, 0, files, &to->normal_map, error) &&
           read_map(from, aiTextureType_EMISSIVE, 1, files, &to->emission_map, error);
}

bool assimp_add_materials(const struct aiScene *imported, source_set *sources,
                          scene_builder *builder, cli_error *error) {
    texture_files files = { .sources = sources, .images.builder = builder };
    bool ok = true;
    for (unsigned i = 0; ok && i < imported->mNumMaterials; i++)
        ok = read_material(imported->mMaterials[i], &files, error);
    free(files.images.items);
    return ok;
}
