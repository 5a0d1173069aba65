/* SPDX-License-Identifier: MIT */
#include "app/scene/load/assimp_material.h"

#include "app/scene/load/assimp_library.h"
#include "app/scene/phong.h"
#include "app/scene/texture_file.h"
#include "app/scene/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static void read_color(const struct aiMaterial *from, const char *key, float color[3]) {
    struct aiColor4D found;
    if (assimp.aiGetMaterialColor(from, key, 0, 0, &found) != aiReturn_SUCCESS)
        return;
    const float numbers[3] = { found.r, found.g, found.b };
    for (int k = 0; k < 3; k++)
        if (isfinite(numbers[k]))
            color[k] = numbers[k];
}

static float number_of(const struct aiMaterial *from, const char *key, float fallback) {
    float number = fallback;
    unsigned count = 1;
    return assimp.aiGetMaterialFloatArray(from, key, 0, 0, &number, &count) == aiReturn_SUCCESS &&
                   isfinite(number)
               ? number
               : fallback;
}

/* Reads a text in Assimp's representation: its length, its bytes and a 0. Assimp's own function
 * ends the process if the data are anything else. */
static bool read_text(const struct aiMaterial *from, const char *key, unsigned type,
                      char text[MAXLEN]) {
    const struct aiMaterialProperty *found;
    uint32_t length;
    if (assimp.aiGetMaterialProperty(from, key, type, 0, &found) != aiReturn_SUCCESS ||
        found->mType != aiPTI_String || found->mDataLength < sizeof length)
        return false;
    memcpy(&length, found->mData, sizeof length);
    if (length >= MAXLEN || length > found->mDataLength - sizeof length)
        return false;
    memcpy(text, found->mData + sizeof length, length);
    text[length] = 0;
    return true;
}

static scene_wrap wrap_of(const struct aiMaterial *from, const char *key, unsigned type) {
    int mode = aiTextureMapMode_Wrap;
    unsigned count = 1;
    assimp.aiGetMaterialIntegerArray(from, key, type, 0, &mode, &count);
    return mode == aiTextureMapMode_Clamp    ? SCENE_WRAP_CLAMP
           : mode == aiTextureMapMode_Mirror ? SCENE_WRAP_MIRROR
                                             : SCENE_WRAP_REPEAT;
}

/* Returns the image in the scene's file that a material means, by its number after a star or by the
 * last part of its name, or NULL. */
static const struct aiTexture *find_embedded(const struct aiScene *imported, const char *path) {
    if (path[0] == '*') {
        char *end;
        const unsigned long number = strtoul(path + 1, &end, 10);
        return end > path + 1 && number < imported->mNumTextures ? imported->mTextures[number]
                                                                 : NULL;
    }
    const char *const name = texture_file_base_name(path);
    for (unsigned i = 0; i < imported->mNumTextures; i++)
        if (strcmp(texture_file_base_name(imported->mTextures[i]->mFilename.data), name) == 0)
            return imported->mTextures[i];
    return NULL;
}

/* What a material is read from. */
typedef struct material_source {
    const struct aiScene *imported;
    const struct aiMaterial *material;
    texture_files *files;
} material_source;

static bool read_map(const material_source *from, enum aiTextureType type, uint32_t srgb,
                     scene_texture_use *use, base_error *error) {
    char path[MAXLEN];
    if (!read_text(from->material, "$tex.file", type, path) || !path[0])
        return true;
    const struct aiTexture *const found = find_embedded(from->imported, path);
    const scene_wrap wrap_u = wrap_of(from->material, "$tex.mapmodeu", type),
                     wrap_v = wrap_of(from->material, "$tex.mapmodev", type);
    if (!found && path[0] != '*')
        return texture_file_use(from->files, path, srgb, wrap_u, wrap_v, use, error);
    if (!found || !found->pcData || found->mHeight > 0) { /* height: texels, not an encoded image */
        builder_unsupported(from->files->images.builder, "embedded texture", "material", 1);
        return true;
    }
    const texture_embedded image = { path, found->pcData, found->mWidth };
    return texture_embedded_use(from->files, &image, srgb, wrap_u, wrap_v, use, error);
}

/* Treats emission up to 1 as a part of how a surface looks, as fixed-function pipelines do: the
 * base color's texture applies to it, and it lights nothing else. */
static void soften_emission(scene_material *material) {
    float most = 0.0f;
    for (int k = 0; k < 3; k++)
        most = fmaxf(most, material->emission[k]);
    if (!(most > 0.0f && most <= 1.0f))
        return;
    material->flags |= SCENE_GLOWS_ALONE;
    if (material->emission_map.texture < 0)
        material->emission_map = material->base_color_map;
}

static float opacity_of(const struct aiMaterial *from) {
    return number_of(from, "$mat.opacity", 1.0f);
}

/* Whether the file inverts opacity: in COLLADA, transparency 1 means opaque, but many exporters
 * write 0 for that. One such material decides for the file. */
static bool is_opacity_inverted(const struct aiScene *imported, const char *name) {
    const char *const dot = strrchr(name, '.');
    bool found = false;
    for (unsigned i = 0; i < imported->mNumMaterials; i++)
        found |= opacity_of(imported->mMaterials[i]) == 0.0f;
    return found && dot && strcasecmp(dot, ".dae") == 0;
}

/* Lets a texture show that has a black diffuse color, which it replaces in many formats. */
static void whiten_textured(const struct aiMaterial *from, float diffuse[3]) {
    char path[MAXLEN];
    if (!(rgb_brightest(diffuse) > 0.0f) &&
        read_text(from, "$tex.file", aiTextureType_DIFFUSE, path) && path[0])
        diffuse[0] = diffuse[1] = diffuse[2] = 1.0f;
}

static bool read_material(const material_source *parts, bool inverted, base_error *error) {
    const struct aiMaterial *const from = parts->material;
    scene_builder *const builder = parts->files->images.builder;
    char name[MAXLEN] = "";
    phong factors = { .diffuse = { 0.6f, 0.6f, 0.6f },
                      .exponent = number_of(from, "$mat.shininess", 0.0f),
                      .opacity = opacity_of(from) };
    if (inverted && factors.opacity < 1.0f)
        factors.opacity = 1.0f - factors.opacity;
    read_text(from, "?mat.name", 0, name);
    read_color(from, "$clr.diffuse", factors.diffuse);
    whiten_textured(from, factors.diffuse);
    read_color(from, "$clr.specular", factors.specular);
    read_color(from, "$clr.emissive", factors.emission);
    scene_material *to = builder_material(builder, name);
    if (!to)
        return base_fail(error, parts->files->sources->subject, "does not fit into memory");
    phong_apply(&factors, to);
    const bool ok = read_map(parts, aiTextureType_DIFFUSE, 1, &to->base_color_map, error) &&
                    read_map(parts, aiTextureType_NORMALS, 0, &to->normal_map, error) &&
                    read_map(parts, aiTextureType_EMISSIVE, 1, &to->emission_map, error);
    soften_emission(to);
    return ok;
}

/* Removes maps that no mesh has coordinates for, which would show a single texel. */
static void drop_maps_without_coordinates(const struct aiScene *imported, scene_builder *builder) {
    scene_material *const materials = builder_items(builder, BLOB_MATERIALS);
    for (unsigned i = 0; i < imported->mNumMaterials; i++) {
        size_t with = 0, without = 0;
        for (unsigned k = 0; k < imported->mNumMeshes; k++)
            if (imported->mMeshes[k]->mMaterialIndex == i)
                *(imported->mMeshes[k]->mTextureCoords[0] ? &with : &without) += 1;
        scene_texture_use *const maps[] = { &materials[i].base_color_map, &materials[i].normal_map,
                                            &materials[i].emission_map };
        bool dropped = false;
        for (size_t k = 0; with == 0 && k < sizeof maps / sizeof *maps; k++) {
            dropped |= maps[k]->texture >= 0;
            maps[k]->texture = -1;
        }
        if (dropped)
            builder_unsupported(builder, "missing texture coordinates", "mesh", without);
    }
}

bool assimp_add_materials(const struct aiScene *imported, source_set *sources,
                          scene_builder *builder, base_error *error) {
    texture_files files = { .sources = sources, .images.builder = builder };
    bool ok = true;
    const bool inverted = is_opacity_inverted(imported, sources->subject);
    for (unsigned i = 0; ok && i < imported->mNumMaterials; i++) {
        const material_source parts = { imported, imported->mMaterials[i], &files };
        ok = read_material(&parts, inverted, error);
    }
    free(files.images.items);
    if (ok)
        drop_maps_without_coordinates(imported, builder);
    if (ok && !phong_tell_invisible(builder, "invisible by opacity 0"))
        ok = base_fail(error, sources->subject, "does not fit into memory");
    return ok;
}
