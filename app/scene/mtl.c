/* SPDX-License-Identifier: MIT */
#include "app/scene/mtl.h"

#include "app/scene/texture.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define METAL_KS_MIN   0.25f /* Ks of a metal, at least, */
#define METAL_KS_TO_KD 2.0f  /* and at least this many times Kd */

static float brightest(const struct aiColor4D *color) {
    return fmaxf(color->r, fmaxf(color->g, color->b));
}

static struct aiColor4D color_of(const struct aiMaterial *from, const char *key, float fallback) {
    struct aiColor4D color = { fallback, fallback, fallback, 1.0f };
    aiGetMaterialColor(from, key, 0, 0, &color);
    return color;
}

static float number_of(const struct aiMaterial *from, const char *key, float fallback) {
    float number = fallback;
    unsigned count = 1;
    return aiGetMaterialFloatArray(from, key, 0, 0, &number, &count) == aiReturn_SUCCESS &&
                   isfinite(number)
               ? number
               : fallback;
}

static void read_factors(const struct aiMaterial *from, scene_material *to) {
    const struct aiColor4D kd = color_of(from, "$clr.diffuse", 0.6f);
    const struct aiColor4D ks = color_of(from, "$clr.specular", 0.0f);
    const struct aiColor4D ke = color_of(from, "$clr.emissive", 0.0f);
    const float exponent = number_of(from, "$mat.shininess", 0.0f);
    const bool metal =
        brightest(&ks) >= METAL_KS_MIN && brightest(&ks) > METAL_KS_TO_KD * brightest(&kd);
    const struct aiColor4D *base = metal ? &ks : &kd;
    to->base_color[0] = fminf(fmaxf(base->r, 0.0f), 1.0f);
    to->base_color[1] = fminf(fmaxf(base->g, 0.0f), 1.0f);
    to->base_color[2] = fminf(fmaxf(base->b, 0.0f), 1.0f);
    to->base_color[3] = fminf(fmaxf(number_of(from, "$mat.opacity", 1.0f), 0.0f), 1.0f);
    to->emission[0] = fmaxf(ke.r, 0.0f);
    to->emission[1] = fmaxf(ke.g, 0.0f);
    to->emission[2] = fmaxf(ke.b, 0.0f);
    to->metallic = metal ? 1.0f : 0.0f;
    to->roughness = 1.0f;
    if (brightest(&ks) > 0.0f && exponent > 0.0f)
        to->roughness = fminf(1.0f, sqrtf(sqrtf(2.0f / (exponent + 2.0f))));
    if (to->base_color[3] < 1.0f)
        to->flags |= SCENE_ALPHA_MASK;
}

/* Textures made so far, by name and color space. */
typedef struct texture_name {
    char path[512];
    uint32_t srgb;
} texture_name;

static bool read_map(const struct aiMaterial *from, enum aiTextureType type, uint32_t srgb,
                     texture_name **names, source_set *sources, scene_builder *builder,
                     scene_texture_use *use, cli_error *error) {
    struct aiString path;
    enum aiTextureMapMode modes[2] = { aiTextureMapMode_Wrap, aiTextureMapMode_Wrap };
    if (aiGetMaterialTexture(from, type, 0, &path, NULL, NULL, NULL, NULL, modes, NULL) !=
            aiReturn_SUCCESS ||
        path.length == 0)
        return true;
    const size_t count = builder_count(builder, BLOB_TEXTURES);
    for (size_t i = 0; i < count; i++)
        if ((*names)[i].srgb == srgb && strcmp((*names)[i].path, path.data) == 0) {
            use->texture = (int32_t)i;
            return true;
        }
    const source *found;
    scene_texture decoded = { .srgb = srgb };
    if (strlen(path.data) >= sizeof(*names)->path)
        return cli_fail(error, sources->subject, "has a texture with too long a name");
    if (!sources_read(sources, path.data, &found, error) ||
        !texture_decode(builder, found->data, found->size, TEXTURE_ANY, sources->subject,
                        found->path, &decoded, error))
        return false;
    texture_name *larger = realloc(*names, (count + 1) * sizeof *larger);
    if (larger)
        *names = larger;
    scene_texture *texture = larger ? builder_append(builder, BLOB_TEXTURES, 1) : NULL;
    if (!texture)
        return cli_fail(error, sources->subject, "does not fit into memory");
    strcpy(larger[count].path, path.data);
    larger[count].srgb = srgb;
    *texture = decoded;
    texture->wrap_u = modes[0] == aiTextureMapMode_Clamp ? SCENE_WRAP_CLAMP : SCENE_WRAP_REPEAT;
    texture->wrap_v = modes[1] == aiTextureMapMode_Clamp ? SCENE_WRAP_CLAMP : SCENE_WRAP_REPEAT;
    scene_clean_name(texture->name, found->path);
    use->texture = (int32_t)count;
    return true;
}

bool mtl_add_materials(const struct aiScene *imported, source_set *sources, scene_builder *builder,
                       cli_error *error) {
    texture_name *names = NULL;
    bool ok = true;
    for (unsigned i = 0; ok && i < imported->mNumMaterials; i++) {
        const struct aiMaterial *from = imported->mMaterials[i];
        struct aiString name = { 0 };
        aiGetMaterialString(from, "?mat.name", 0, 0, &name);
        scene_material *to = builder_material(builder, name.data);
        if (!to) {
            ok = cli_fail(error, sources->subject, "does not fit into memory");
            break;
        }
        read_factors(from, to);
        ok = read_map(from, aiTextureType_DIFFUSE, 1, &names, sources, builder, &to->base_color_map,
                      error) &&
             read_map(from, aiTextureType_NORMALS, 0, &names, sources, builder, &to->normal_map,
                      error) &&
             read_map(from, aiTextureType_EMISSIVE, 1, &names, sources, builder, &to->emission_map,
                      error);
    }
    free(names);
    return ok;
}
