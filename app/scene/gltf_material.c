/* SPDX-License-Identifier: MIT */
/* gltf_material.c - materials and textures, from the JSON: Assimp knows neither texture transforms
 * nor emissive strength, and doubles textures. */
#include "app/scene/gltf.h"
#include "app/scene/texture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Textures already made: which image, sampler and color space became which texture. */
typedef struct texture_pool {
    const gltf *document;
    scene_builder *builder;
    scene_texture *decoded; /* of each image; width 0: not yet */
    struct made {
        long image, sampler;
        uint32_t srgb;
    } * made;
    cli_error *error;
} texture_pool;

static bool decode_image(texture_pool *pool, size_t image) {
    const gltf *document = pool->document;
    const cJSON *entry = document->images.items[image];
    const char *uri = gltf_text(entry, "uri"), *name = gltf_text(entry, "name");
    char number[32];
    scene_texture *texture = &pool->decoded[image];
    bool ok = true;
    const unsigned char *bytes;
    size_t size;
    void *owned = NULL;
    if (uri[0] && strncmp(uri, "data:", 5) != 0) {
        const source *found;
        if (!sources_read(document->sources, uri, &found, pool->error))
            return false;
        bytes = found->data;
        size = found->size;
        name = name[0] ? name : uri;
    } else if (uri[0]) {
        if (!gltf_data_uri_bytes(uri, &owned, &size))
            return cli_fail(pool->error, document->subject,
                            "is no valid glTF: image %zu is no valid base64", image);
        bytes = owned;
    } else {
        const long view = gltf_index(entry, "bufferView", document->views.count, &ok);
        if (view < 0)
            return cli_fail(pool->error, document->subject,
                            "is no valid glTF: image %zu has no data", image);
        ok = gltf_view_bytes(document, (size_t)view, &bytes, &size, &owned, pool->error);
    }
    snprintf(number, sizeof number, "image %zu", image);
    name = name[0] ? name : number;
    ok = ok &&
         texture_decode(pool->builder, bytes, size, document->subject, name, texture, pool->error);
    builder_name(texture->name, name);
    free(owned);
    return ok;
}

static uint32_t wrap_mode(const cJSON *sampler, const char *name) {
    switch ((int)gltf_number(sampler, name, 10497.0)) {
    case 33071:
        return SCENE_WRAP_CLAMP;
    case 33648:
        return SCENE_WRAP_MIRROR;
    default:
        return SCENE_WRAP_REPEAT;
    }
}

/* The texture for `image` with `sampler`, made if need be; -1 on failure. */
static int32_t find_texture(texture_pool *pool, long image, long sampler, uint32_t srgb) {
    const size_t count = builder_count(pool->builder, BLOB_TEXTURES);
    for (size_t i = 0; i < count; i++)
        if (pool->made[i].image == image && pool->made[i].sampler == sampler &&
            pool->made[i].srgb == srgb)
            return (int32_t)i;
    if (pool->decoded[image].width == 0 && !decode_image(pool, (size_t)image))
        return -1;
    struct made *made = realloc(pool->made, (count + 1) * sizeof *made);
    if (made)
        pool->made = made;
    scene_texture *texture = made ? builder_append(pool->builder, BLOB_TEXTURES, 1) : NULL;
    if (!texture) {
        cli_fail(pool->error, pool->document->subject, "does not fit into memory");
        return -1;
    }
    made[count] = (struct made) { image, sampler, srgb };
    *texture = pool->decoded[image];
    texture->srgb = srgb;
    const cJSON *entry = sampler < 0 ? NULL : pool->document->samplers.items[sampler];
    texture->wrap_u = wrap_mode(entry, "wrapS");
    texture->wrap_v = wrap_mode(entry, "wrapT");
    return (int32_t)count;
}

/* uv' = translation * rotation * scale * uv; the rotation is counter-clockwise with v down. */
static void read_transform(const cJSON *info, scene_texture_use *use) {
    const cJSON *transform = gltf_member(gltf_member(info, "extensions"), "KHR_texture_transform");
    double offset[2] = { 0.0, 0.0 }, scale[2] = { 1.0, 1.0 };
    gltf_numbers(transform, "offset", 2, offset);
    gltf_numbers(transform, "scale", 2, scale);
    const double angle = gltf_number(transform, "rotation", 0.0);
    const double c = cos(angle), s = sin(angle);
    use->matrix[0] = (float)(c * scale[0]);
    use->matrix[1] = (float)(s * scale[1]);
    use->matrix[2] = (float)(-s * scale[0]);
    use->matrix[3] = (float)(c * scale[1]);
    use->offset[0] = (float)offset[0];
    use->offset[1] = (float)offset[1];
}

static bool read_texture(texture_pool *pool, const cJSON *holder, const char *name, uint32_t srgb,
                         scene_texture_use *use) {
    const gltf *document = pool->document;
    const cJSON *info = gltf_member(holder, name);
    bool ok = true;
    const long texture = gltf_index(info, "index", document->textures.count, &ok);
    if (!info)
        return true;
    const cJSON *entry = texture < 0 ? NULL : document->textures.items[texture];
    const long image = gltf_index(entry, "source", document->images.count, &ok);
    const long sampler = gltf_index(entry, "sampler", document->samplers.count, &ok);
    if (!ok || image < 0)
        return cli_fail(pool->error, document->subject,
                        "is no valid glTF: a %s refers to no image that can be read", name);
    read_transform(info, use);
    use->texture = find_texture(pool, image, sampler, srgb);
    return use->texture >= 0;
}

static float clamp_unit(double x) {
    return x >= 0.0 ? (float)fmin(x, 1.0) : 0.0f;
}

static bool read_material(texture_pool *pool, const cJSON *entry) {
    scene_material *material = builder_material(pool->builder, gltf_text(entry, "name"));
    if (!material)
        return cli_fail(pool->error, pool->document->subject, "does not fit into memory");
    const cJSON *pbr = gltf_member(entry, "pbrMetallicRoughness");
    const cJSON *strength =
        gltf_member(gltf_member(entry, "extensions"), "KHR_materials_emissive_strength");
    double color[4] = { 1.0, 1.0, 1.0, 1.0 }, emission[3] = { 0.0, 0.0, 0.0 };
    gltf_numbers(pbr, "baseColorFactor", 4, color);
    gltf_numbers(entry, "emissiveFactor", 3, emission);
    for (int k = 0; k < 4; k++)
        material->base_color[k] = clamp_unit(color[k]);
    const double factor = gltf_number(strength, "emissiveStrength", 1.0);
    for (int k = 0; k < 3; k++)
        material->emission[k] = (float)fmax(0.0, emission[k] * factor);
    material->metallic = clamp_unit(gltf_number(pbr, "metallicFactor", 1.0));
    material->roughness = clamp_unit(gltf_number(pbr, "roughnessFactor", 1.0));
    material->alpha_cutoff = clamp_unit(gltf_number(entry, "alphaCutoff", 0.5));
    material->normal_scale = (float)gltf_number(gltf_member(entry, "normalTexture"), "scale", 1.0);
    if (cJSON_IsTrue(gltf_member(entry, "doubleSided")))
        material->flags |= SCENE_DOUBLE_SIDED;
    /* Blending needs an order of surfaces, which a deferred renderer has not: it is cut instead. */
    const char *mode = gltf_text(entry, "alphaMode");
    if (strcmp(mode, "MASK") == 0 || strcmp(mode, "BLEND") == 0)
        material->flags |= SCENE_ALPHA_MASK;
    return read_texture(pool, pbr, "baseColorTexture", 1, &material->base_color_map) &&
           read_texture(pool, pbr, "metallicRoughnessTexture", 0,
                        &material->metallic_roughness_map) &&
           read_texture(pool, entry, "normalTexture", 0, &material->normal_map) &&
           read_texture(pool, entry, "emissiveTexture", 1, &material->emission_map);
}

bool gltf_add_materials(const gltf *document, scene_builder *builder, cli_error *error) {
    texture_pool pool = { .document = document, .builder = builder, .error = error };
    pool.decoded = calloc(document->images.count + 1, sizeof *pool.decoded);
    bool ok = pool.decoded || cli_fail(error, document->subject, "does not fit into memory");
    for (size_t i = 0; ok && i < document->materials.count; i++)
        ok = read_material(&pool, document->materials.items[i]);
    if (ok) {
        scene_material *fallback = builder_material(builder, "default");
        if (fallback)
            fallback->metallic = 1.0f;
    }
    free(pool.decoded);
    free(pool.made);
    return ok;
}
