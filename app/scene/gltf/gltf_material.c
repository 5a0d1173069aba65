/* SPDX-License-Identifier: MIT */
/* gltf_material.c - materials and textures, read from the JSON: Assimp supports neither texture
 * transforms nor emissive strength, and duplicates textures. */
#include "app/scene/gltf/gltf.h"
#include "app/scene/texture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILTER_NEAREST 9728

typedef struct texture_pool {
    const gltf *document;
    scene_builder *builder;
    scene_texture *decoded; /* of each image that was tried; width 0: unusable */
    bool *tried;
    texture_images images; /* images whose bytes lie in a file */
    base_error *error;
} texture_pool;

/* Finds the bytes of an image, and a name for messages; *lost says what is wrong if there are
 * none. */
static bool find_image(const texture_pool *pool, size_t image, gltf_bytes *bytes, char *name,
                       size_t size, const char **lost) {
    const gltf *document = pool->document;
    json_t *entry = gltf_item(document, GLTF_IMAGES, image);
    const char *uri = gltf_text(entry, "uri"), *own = gltf_text(entry, "name");
    const bool embedded = !uri[0] || strncmp(uri, "data:", 5) == 0;
    if (own[0] || !embedded)
        snprintf(name, size, "%s", embedded ? own : uri);
    else
        snprintf(name, size, "image %zu", image);
    if (!uri[0] && !json_object_get(entry, "bufferView")) {
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

/* Keeps an image, or notes that it is unsupported. */
static bool keep_image(texture_pool *pool, size_t image) {
    scene_texture *texture = &pool->decoded[image];
    gltf_bytes bytes = { 0 };
    char name[512];
    const char *const subject = pool->document->subject, *lost = NULL;
    pool->tried[image] = true;
    bool ok = find_image(pool, image, &bytes, name, sizeof name, &lost);
    if (ok && !lost && bytes.owned) {
        base_error reason;
        if (!texture_keep(pool->builder, bytes.bytes, bytes.size, TEXTURE_GLTF, subject, name,
                          texture, &reason)) {
            ok = !base_is_out_of_memory(&reason) || base_fail(pool->error, NULL, "%s", reason.text);
            texture->width = 0;
        }
    } else if (ok && !lost) {
        ok = texture_keep_once(&pool->images, bytes.bytes, bytes.size, TEXTURE_GLTF, subject, name,
                               texture, pool->error);
    }
    if (ok && texture->width == 0)
        builder_unsupported_file(pool->builder, name, lost ? lost : TEXTURE_UNDECODABLE);
    if (ok)
        scene_clean_name(texture->name, name);
    free(bytes.owned);
    return ok;
}

static uint32_t wrap_mode(json_t *sampler, const char *name) {
    switch ((int)gltf_number(sampler, name, 10497.0)) {
    case 33071:
        return SCENE_WRAP_CLAMP;
    case 33648:
        return SCENE_WRAP_MIRROR;
    default:
        return SCENE_WRAP_REPEAT;
    }
}

/* Finds or makes the texture for `image` with `sampler`; it is -1 for an unusable image. */
static bool find_texture(texture_pool *pool, long image, long sampler, uint32_t srgb,
                         int32_t *number) {
    if (!pool->tried[image] && !keep_image(pool, (size_t)image))
        return false;
    if (pool->decoded[image].width == 0)
        return true;
    json_t *entry = sampler < 0 ? NULL : gltf_item(pool->document, GLTF_SAMPLERS, (size_t)sampler);
    scene_texture texture = pool->decoded[image];
    texture.srgb = srgb;
    texture.wrap_u = wrap_mode(entry, "wrapS");
    texture.wrap_v = wrap_mode(entry, "wrapT");
    *number = texture_use(pool->builder, &texture);
    return *number >= 0 ||
           base_fail(pool->error, pool->document->subject, "does not fit into memory");
}

/* Computes uv' = translation * rotation * scale * uv; the rotation is counter-clockwise with v
 * down. */
static void read_transform(json_t *info, scene_texture_use *use) {
    json_t *transform = gltf_extension(info, "KHR_texture_transform");
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

static long set_of(json_t *info) {
    json_t *transform = gltf_extension(info, "KHR_texture_transform");
    const double own = gltf_number(info, "texCoord", 0.0);
    return (long)gltf_number(transform, "texCoord", own);
}

/* The maps of a material, in the order of scene_material. */
typedef struct gltf_map {
    const char *name;
    const char *holder; /* an extension or a member; NULL: the material itself */
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
    { "diffuseTransmissionTexture", "KHR_materials_diffuse_transmission", false },
    { "diffuseTransmissionColorTexture", "KHR_materials_diffuse_transmission", true },
};

static json_t *map_info(json_t *material, const gltf_map *map) {
    json_t *holder = map->holder ? json_object_get(material, map->holder) : material;
    if (!holder)
        holder = gltf_extension(material, map->holder);
    return json_object_get(holder, map->name);
}

static void add_set(json_t *info, long sets[2]) {
    const long set = info ? set_of(info) : -1;
    if (set < 0 || set == sets[0] || set == sets[1])
        return;
    if (sets[0] < 0)
        sets[0] = set;
    else if (sets[1] < 0)
        sets[1] = set;
}

/* Finds a material's sets, that of the normal map first, because tangents are computed from it. */
void gltf_material_sets(json_t *material, long sets[2]) {
    sets[0] = sets[1] = -1;
    add_set(json_object_get(material, "normalTexture"), sets);
    for (size_t i = 0; i < SCENE_MAPS; i++)
        add_set(map_info(material, &maps[i]), sets);
}

/* --- materials -------------------------------------------------------------------------------- */

static bool read_map(texture_pool *pool, json_t *info, bool srgb, const long sets[2],
                     scene_texture_use *use) {
    const gltf *document = pool->document;
    if (!info)
        return true;
    json_t *entry = gltf_item(document, GLTF_TEXTURES, (size_t)gltf_index(info, "index"));
    json_t *webp = gltf_extension(entry, "EXT_texture_webp");
    const long image = gltf_index(webp ? webp : entry, "source");
    /* only an unsupported extension names the image, and it has been noted */
    if (image < 0)
        return true;
    const long set = set_of(info);
    if (set != sets[0] && set != sets[1]) {
        builder_unsupported(pool->builder, "map of a third set of coordinates", "material", 1);
        return true;
    }
    use->set = set == sets[0] ? 0 : 1;
    read_transform(info, use);
    return find_texture(pool, image, gltf_index(entry, "sampler"), srgb, &use->texture);
}

static float clamp_unit(double x) {
    return x >= 0.0 ? (float)fmin(x, 1.0) : 0.0f;
}

/* Reads KHR_materials_ior and KHR_materials_specular. */
static void read_dielectric(json_t *entry, scene_material *material) {
    json_t *ior = gltf_extension(entry, "KHR_materials_ior");
    json_t *specular = gltf_extension(entry, "KHR_materials_specular");
    const double most = 1e6; /* far more than any F0 needs */
    const double n = fmin(gltf_number(ior, "ior", 1.5), most), root = (n - 1.0) / (n + 1.0);
    double color[3] = { 1.0, 1.0, 1.0 };
    gltf_numbers(specular, "specularColorFactor", 3, color);
    for (int k = 0; k < 3; k++)
        material->f0[k] = (float)(root * root * fmin(color[k], most));
    material->f90 = clamp_unit(gltf_number(specular, "specularFactor", 1.0));
}

static void read_coat(json_t *entry, scene_material *material) {
    json_t *coat = gltf_extension(entry, "KHR_materials_clearcoat");
    material->coat = clamp_unit(gltf_number(coat, "clearcoatFactor", 0.0));
    material->coat_roughness = clamp_unit(gltf_number(coat, "clearcoatRoughnessFactor", 0.0));
    material->coat_normal_scale =
        (float)gltf_number(json_object_get(coat, "clearcoatNormalTexture"), "scale", 1.0);
}

/* Reads a color in 0 … 1, clamping values outside. */
static void read_unit_color(json_t *entry, const char *name, double usual, float color[3]) {
    double given[3] = { usual, usual, usual };
    gltf_numbers(entry, name, 3, given);
    for (int k = 0; k < 3; k++)
        color[k] = clamp_unit(given[k]);
}

static void read_sheen(json_t *entry, scene_material *material) {
    json_t *sheen = gltf_extension(entry, "KHR_materials_sheen");
    read_unit_color(sheen, "sheenColorFactor", 0.0, material->sheen_color);
    material->sheen_roughness = clamp_unit(gltf_number(sheen, "sheenRoughnessFactor", 0.0));
}

static void read_transmission(json_t *entry, scene_material *material) {
    json_t *through = gltf_extension(entry, "KHR_materials_diffuse_transmission");
    material->transmission = clamp_unit(gltf_number(through, "diffuseTransmissionFactor", 0.0));
    read_unit_color(through, "diffuseTransmissionColorFactor", 1.0, material->transmission_color);
}

/* Makes a material reflect nothing and emit its base color; alpha stays as it is. */
static void make_unlit(scene_material *material) {
    material->flags |= SCENE_UNLIT;
    material->emission_map = material->base_color_map;
    for (int i = 1; i < SCENE_MAPS; i++)
        if (&material->maps[i] != &material->emission_map)
            material->maps[i].texture = -1;
    material->coat = material->transmission = 0.0f;
    memset(material->sheen_color, 0, sizeof material->sheen_color);
    material->metallic = material->roughness = 1.0f;
    for (int k = 0; k < 3; k++) {
        material->emission[k] = material->base_color[k];
        material->base_color[k] = 0.0f;
    }
}

static bool read_material(texture_pool *pool, json_t *entry) {
    scene_material *material = builder_material(pool->builder, gltf_text(entry, "name"));
    if (!material)
        return base_fail(pool->error, pool->document->subject, "does not fit into memory");
    json_t *pbr = json_object_get(entry, "pbrMetallicRoughness");
    json_t *strength = gltf_extension(entry, "KHR_materials_emissive_strength");
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
    /* above 1 it hides the surface completely, as the specification says */
    material->alpha_cutoff = (float)fmin(gltf_number(entry, "alphaCutoff", 0.5), 2.0);
    material->normal_scale =
        (float)gltf_number(json_object_get(entry, "normalTexture"), "scale", 1.0);
    if (json_is_true(json_object_get(entry, "doubleSided")))
        material->flags |= SCENE_DOUBLE_SIDED;
    const char *mode = gltf_text(entry, "alphaMode");
    if (strcmp(mode, "MASK") == 0)
        material->flags |= SCENE_ALPHA_MASK;
    if (strcmp(mode, "BLEND") == 0)
        material->flags |= SCENE_ALPHA_BLEND;
    material->occlusion =
        clamp_unit(gltf_number(json_object_get(entry, "occlusionTexture"), "strength", 1.0));
    read_dielectric(entry, material);
    read_coat(entry, material);
    read_sheen(entry, material);
    read_transmission(entry, material);
    long sets[2];
    gltf_material_sets(entry, sets);
    for (size_t i = 0; i < SCENE_MAPS; i++)
        if (!read_map(pool, map_info(entry, &maps[i]), maps[i].srgb, sets, &material->maps[i]))
            return false;
    if (gltf_extension(entry, "KHR_materials_unlit"))
        make_unlit(material);
    return true;
}

/* Marks the materials that use vertex colors: those of which any primitive has them. Vertices of
 * the material's other primitives are white. */
static void note_vertex_colors(const gltf *document, scene_builder *builder) {
    scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    for (size_t i = 0; i < gltf_count(document, GLTF_MESHES); i++) {
        json_t *primitives = gltf_primitives(document, i), *primitive;
        size_t k;
        json_array_foreach (primitives, k, primitive) {
            const long number = gltf_primitive_material(document, primitive);
            scene_material *material =
                &materials[number < 0 ? gltf_count(document, GLTF_MATERIALS) : (size_t)number];
            if (!json_object_get(json_object_get(primitive, "attributes"), "COLOR_0"))
                continue;
            material->flags |= SCENE_VERTEX_COLORS;
        }
    }
}

static void note_filters(const gltf *document, scene_builder *builder) {
    for (size_t i = 0; i < gltf_count(document, GLTF_SAMPLERS); i++)
        if (gltf_number(gltf_item(document, GLTF_SAMPLERS, i), "magFilter", 0.0) == FILTER_NEAREST)
            builder_unsupported(builder, "nearest filter", "sampler", 1);
}

bool gltf_add_materials(const gltf *document, scene_builder *builder, base_error *error) {
    texture_pool pool = {
        .document = document, .builder = builder, .images.builder = builder, .error = error
    };
    pool.decoded = calloc(gltf_count(document, GLTF_IMAGES) + 1, sizeof *pool.decoded);
    pool.tried = calloc(gltf_count(document, GLTF_IMAGES) + 1, sizeof *pool.tried);
    bool ok = (pool.decoded && pool.tried) ||
              base_fail(error, document->subject, "does not fit into memory");
    for (size_t i = 0; ok && i < gltf_count(document, GLTF_MATERIALS); i++)
        ok = read_material(&pool, gltf_item(document, GLTF_MATERIALS, i));
    if (ok) {
        scene_material *fallback = builder_material(builder, "default");
        ok = fallback || base_fail(error, document->subject, "does not fit into memory");
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
