/* SPDX-License-Identifier: MIT */
/* gltf_material.c - materials and textures, from the JSON: Assimp knows neither texture transforms
 * nor emissive strength, and doubles textures. */
#include "app/scene/gltf.h"
#include "app/scene/texture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILTER_NEAREST 9728

typedef struct texture_pool {
    const gltf *document;
    scene_builder *builder;
    scene_texture *decoded; /* of each image that was tried; width 0: it is left out */
    bool *tried;
    texture_images images; /* those whose bytes lie in a file */
    cli_error *error;
} texture_pool;

/* The bytes of an image, and a name for messages; *lost is what is wrong with those that are not
 * there. */
static bool find_image(const texture_pool *pool, size_t image, gltf_bytes *bytes, char *name,
                       size_t size, const char **lost) {
    const gltf *document = pool->document;
    const cJSON *entry = gltf_item(document, GLTF_IMAGES, image);
    const char *uri = gltf_text(entry, "uri"), *own = gltf_text(entry, "name");
    const bool embedded = !uri[0] || strncmp(uri, "data:", 5) == 0;
    if (own[0] || !embedded)
        snprintf(name, size, "%s", embedded ? own : uri);
    else
        snprintf(name, size, "image %zu", image);
    if (!uri[0] && !gltf_member(entry, "bufferView")) {
        *lost = "image without data";
    } else if (!uri[0]) {
        *bytes = gltf_view_bytes(document, (size_t)gltf_index(entry, "bufferView"));
    } else if (embedded) {
        if (!gltf_data_uri(uri, bytes))
            *lost = TEXTURE_UNDECODABLE;
    } else {
        const source *found;
        source_state state;
        if (!sources_read_optional(document->sources, uri, &found, &state, pool->error))
            return false;
        if (found)
            *bytes = (gltf_bytes) { .bytes = found->data, .size = found->size };
        else
            *lost = source_state_nouns[state];
    }
    return true;
}

/* Keeps an image, or notes that it is left out. */
static bool keep_image(texture_pool *pool, size_t image) {
    scene_texture *texture = &pool->decoded[image];
    gltf_bytes bytes = { 0 };
    char name[512];
    const char *const subject = pool->document->subject, *lost = NULL;
    pool->tried[image] = true;
    bool ok = find_image(pool, image, &bytes, name, sizeof name, &lost);
    if (ok && !lost && bytes.owned) {
        cli_error reason;
        if (!texture_keep(pool->builder, bytes.bytes, bytes.size, TEXTURE_GLTF, subject, name,
                          texture, &reason)) {
            ok = !cli_is_out_of_memory(&reason) || cli_fail(pool->error, NULL, "%s", reason.text);
            texture->width = 0;
        }
    } else if (ok && !lost) {
        ok = texture_keep_once(&pool->images, bytes.bytes, bytes.size, TEXTURE_GLTF, subject, name,
                               texture, pool->error);
    }
    if (ok && texture->width == 0)
        builder_left_out_file(pool->builder, name, lost ? lost : TEXTURE_UNDECODABLE);
    if (ok)
        scene_clean_name(texture->name, name);
    free(bytes.owned);
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

/* Finds or makes the texture for `image` with `sampler`; of an image that is left out it is -1. */
static bool find_texture(texture_pool *pool, long image, long sampler, uint32_t srgb,
                         int32_t *number) {
    if (!pool->tried[image] && !keep_image(pool, (size_t)image))
        return false;
    if (pool->decoded[image].width == 0)
        return true;
    const cJSON *entry =
        sampler < 0 ? NULL : gltf_item(pool->document, GLTF_SAMPLERS, (size_t)sampler);
    scene_texture texture = pool->decoded[image];
    texture.srgb = srgb;
    texture.wrap_u = wrap_mode(entry, "wrapS");
    texture.wrap_v = wrap_mode(entry, "wrapT");
    *number = texture_use(pool->builder, &texture);
    return *number >= 0 ||
           cli_fail(pool->error, pool->document->subject, "does not fit into memory");
}

/* uv' = translation * rotation * scale * uv; the rotation is counter-clockwise with v down. */
static void read_transform(const cJSON *info, scene_texture_use *use) {
    const cJSON *transform = gltf_extension(info, "KHR_texture_transform");
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

/* --- sets of texture coordinates -------------------------------------------------------------- */

static long set_of(const cJSON *info) {
    const cJSON *transform = gltf_extension(info, "KHR_texture_transform");
    const double own = gltf_number(info, "texCoord", 0.0);
    return (long)gltf_number(transform, "texCoord", own);
}

/* The maps of a material in the order of scene_material. */
typedef struct gltf_map {
    const char *name;
    const char *holder; /* an extension, or a member; NULL: the material itself */
    bool srgb;
} gltf_map;

static const gltf_map maps[SCENE_MAPS] = {
    { "baseColorTexture", "pbrMetallicRoughness", true },
    { "metallicRoughnessTexture", "pbrMetallicRoughness", false },
    { "normalTexture", NULL, false },
    { "emissiveTexture", NULL, true },
    { "occlusionTexture", NULL, false },
    { "specularTexture", "KHR_materials_specular", false },
    { "specularColorTexture", "KHR_materials_specular", true },
    { "clearcoatTexture", "KHR_materials_clearcoat", false },
    { "clearcoatRoughnessTexture", "KHR_materials_clearcoat", false },
    { "clearcoatNormalTexture", "KHR_materials_clearcoat", false },
    { "sheenColorTexture", "KHR_materials_sheen", true },
    { "sheenRoughnessTexture", "KHR_materials_sheen", false },
};

static const cJSON *map_info(const cJSON *material, const gltf_map *map) {
    const cJSON *holder = map->holder ? gltf_member(material, map->holder) : material;
    if (!holder)
        holder = gltf_extension(material, map->holder);
    return gltf_member(holder, map->name);
}

static void add_set(const cJSON *info, long sets[2]) {
    const long set = info ? set_of(info) : -1;
    if (set < 0 || set == sets[0] || set == sets[1])
        return;
    if (sets[0] < 0)
        sets[0] = set;
    else if (sets[1] < 0)
        sets[1] = set;
}

/* The normal map's first: tangents are made of it. */
void gltf_material_sets(const cJSON *material, long sets[2]) {
    sets[0] = sets[1] = -1;
    add_set(gltf_member(material, "normalTexture"), sets);
    for (size_t i = 0; i < SCENE_MAPS; i++)
        add_set(map_info(material, &maps[i]), sets);
}

/* --- materials -------------------------------------------------------------------------------- */

static bool read_map(texture_pool *pool, const cJSON *info, bool srgb, const long sets[2],
                     scene_texture_use *use) {
    const gltf *document = pool->document;
    if (!info)
        return true;
    const cJSON *entry = gltf_item(document, GLTF_TEXTURES, (size_t)gltf_index(info, "index"));
    const cJSON *webp = gltf_extension(entry, "EXT_texture_webp");
    const long image = gltf_index(webp ? webp : entry, "source");
    /* An image that only an extension names, which is then among what is left out. */
    if (image < 0)
        return true;
    const long set = set_of(info);
    if (set != sets[0] && set != sets[1]) {
        builder_left_out(pool->builder, "map of a third set of coordinates", "material", 1);
        return true;
    }
    use->set = set == sets[0] ? 0 : 1;
    read_transform(info, use);
    return find_texture(pool, image, gltf_index(entry, "sampler"), srgb, &use->texture);
}

static float clamp_unit(double x) {
    return x >= 0.0 ? (float)fmin(x, 1.0) : 0.0f;
}

/* KHR_materials_ior and KHR_materials_specular. */
static void read_dielectric(const cJSON *entry, scene_material *material) {
    const cJSON *ior = gltf_extension(entry, "KHR_materials_ior");
    const cJSON *specular = gltf_extension(entry, "KHR_materials_specular");
    const double most = 1e6; /* far more than any F0 can be reached with */
    const double n = fmin(gltf_number(ior, "ior", 1.5), most), root = (n - 1.0) / (n + 1.0);
    double color[3] = { 1.0, 1.0, 1.0 };
    gltf_numbers(specular, "specularColorFactor", 3, color);
    for (int k = 0; k < 3; k++)
        material->f0[k] = (float)(root * root * fmin(color[k], most));
    material->f90 = clamp_unit(gltf_number(specular, "specularFactor", 1.0));
}

static void read_coat(const cJSON *entry, scene_material *material) {
    const cJSON *coat = gltf_extension(entry, "KHR_materials_clearcoat");
    material->coat = clamp_unit(gltf_number(coat, "clearcoatFactor", 0.0));
    material->coat_roughness = clamp_unit(gltf_number(coat, "clearcoatRoughnessFactor", 0.0));
    material->coat_normal_scale =
        (float)gltf_number(gltf_member(coat, "clearcoatNormalTexture"), "scale", 1.0);
}

static void read_sheen(const cJSON *entry, scene_material *material) {
    const cJSON *sheen = gltf_extension(entry, "KHR_materials_sheen");
    double color[3] = { 0.0, 0.0, 0.0 };
    gltf_numbers(sheen, "sheenColorFactor", 3, color);
    for (int k = 0; k < 3; k++)
        material->sheen_color[k] = clamp_unit(color[k]);
    material->sheen_roughness = clamp_unit(gltf_number(sheen, "sheenRoughnessFactor", 0.0));
}

/* What reflects nothing and glows by its base color; alpha stays where it was. */
static void make_unlit(scene_material *material) {
    material->flags |= SCENE_UNLIT;
    material->emission_map = material->base_color_map;
    for (int i = 1; i < SCENE_MAPS; i++)
        if (&material->maps[i] != &material->emission_map)
            material->maps[i].texture = -1;
    material->coat = 0.0f;
    memset(material->sheen_color, 0, sizeof material->sheen_color);
    material->metallic = material->roughness = 1.0f;
    for (int k = 0; k < 3; k++) {
        material->emission[k] = material->base_color[k];
        material->base_color[k] = 0.0f;
    }
}

static bool read_material(texture_pool *pool, const cJSON *entry) {
    scene_material *material = builder_material(pool->builder, gltf_text(entry, "name"));
    if (!material)
        return cli_fail(pool->error, pool->document->subject, "does not fit into memory");
    const cJSON *pbr = gltf_member(entry, "pbrMetallicRoughness");
    const cJSON *strength = gltf_extension(entry, "KHR_materials_emissive_strength");
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
    /* Above 1 it hides the surface wholly, as the specification has it. */
    material->alpha_cutoff = (float)fmin(gltf_number(entry, "alphaCutoff", 0.5), 2.0);
    material->normal_scale = (float)gltf_number(gltf_member(entry, "normalTexture"), "scale", 1.0);
    if (cJSON_IsTrue(gltf_member(entry, "doubleSided")))
        material->flags |= SCENE_DOUBLE_SIDED;
    const char *mode = gltf_text(entry, "alphaMode");
    if (strcmp(mode, "MASK") == 0)
        material->flags |= SCENE_ALPHA_MASK;
    if (strcmp(mode, "BLEND") == 0)
        material->flags |= SCENE_ALPHA_BLEND;
    material->occlusion =
        clamp_unit(gltf_number(gltf_member(entry, "occlusionTexture"), "strength", 1.0));
    read_dielectric(entry, material);
    read_coat(entry, material);
    read_sheen(entry, material);
    long sets[2];
    gltf_material_sets(entry, sets);
    for (size_t i = 0; i < SCENE_MAPS; i++)
        if (!read_map(pool, map_info(entry, &maps[i]), maps[i].srgb, sets, &material->maps[i]))
            return false;
    if (gltf_extension(entry, "KHR_materials_unlit"))
        make_unlit(material);
    return true;
}

/* The colors of vertices count for a material if one of its primitives has them; the others' are
 * then white. */
static void note_vertex_colors(const gltf *document, scene_builder *builder) {
    scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    for (size_t i = 0; i < gltf_count(document, GLTF_MESHES); i++) {
        const cJSON *mesh = gltf_item(document, GLTF_MESHES, i), *primitive;
        cJSON_ArrayForEach(primitive, gltf_member(mesh, "primitives")) {
            const long number = gltf_primitive_material(document, primitive);
            scene_material *material =
                &materials[number < 0 ? gltf_count(document, GLTF_MATERIALS) : (size_t)number];
            if (!gltf_member(gltf_member(primitive, "attributes"), "COLOR_0"))
                continue;
            material->flags |= SCENE_VERTEX_COLORS;
        }
    }
}

static void note_filters(const gltf *document, scene_builder *builder) {
    for (size_t i = 0; i < gltf_count(document, GLTF_SAMPLERS); i++)
        if (gltf_number(gltf_item(document, GLTF_SAMPLERS, i), "magFilter", 0.0) == FILTER_NEAREST)
            builder_left_out(builder, "nearest filter", "sampler", 1);
}

bool gltf_add_materials(const gltf *document, scene_builder *builder, cli_error *error) {
    texture_pool pool = {
        .document = document, .builder = builder, .images.builder = builder, .error = error
    };
    pool.decoded = calloc(gltf_count(document, GLTF_IMAGES) + 1, sizeof *pool.decoded);
    pool.tried = calloc(gltf_count(document, GLTF_IMAGES) + 1, sizeof *pool.tried);
    bool ok = (pool.decoded && pool.tried) ||
              cli_fail(error, document->subject, "does not fit into memory");
    for (size_t i = 0; ok && i < gltf_count(document, GLTF_MATERIALS); i++)
        ok = read_material(&pool, gltf_item(document, GLTF_MATERIALS, i));
    if (ok) {
        scene_material *fallback = builder_material(builder, "default");
        ok = fallback || cli_fail(error, document->subject, "does not fit into memory");
        if (ok)
            fallback->metallic = 1.0f;
    }
    if (ok) {
        note_vertex_colors(document, builder);
        note_filters(document, builder);
    }
    free(pool.decoded);
    free(pool.tried);
    free(pool.images.items);
    return ok;
}
