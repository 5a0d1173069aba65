/* SPDX-License-Identifier: MIT */
#include "app/scene/gltf/gltf_schema_material.h"

const gltf_object gltf_schema_image = {
    "image",
    (const gltf_field[]) {
        { "uri", TEXT }, { "mimeType", TEXT }, { "bufferView", REFERENCE(GLTF_VIEWS) }, NAME, END },
    NULL,
};
const gltf_object gltf_schema_sampler = {
    "sampler",
    (const gltf_field[]) {
        { "magFilter", INTEGER_CHOICE("9728 9729"), FORGIVEN },
        { "minFilter", INTEGER_CHOICE("9728 9729 9984 9985 9986 9987"), FORGIVEN },
        { "wrapS", INTEGER_CHOICE("10497 33071 33648"), FORGIVEN },
        { "wrapT", INTEGER_CHOICE("10497 33071 33648"), FORGIVEN },
        NAME,
        END },
    NULL,
};
static const gltf_object texture_webp = {
    "texture",
    (const gltf_field[]) { { "source", REFERENCE(GLTF_IMAGES), .required = true }, END },
    NULL,
};
const gltf_object gltf_schema_texture = {
    "texture",
    (const gltf_field[]) {
        { "sampler", REFERENCE(GLTF_SAMPLERS) }, { "source", REFERENCE(GLTF_IMAGES) }, NAME, END },
    (const gltf_field[]) { { "EXT_texture_webp", OBJECT(texture_webp) }, END },
};

static const gltf_object texture_transform = {
    "texture",
    (const gltf_field[]) { { "offset", VECTOR(2) },
                           { "rotation", .type = GLTF_TYPE_NUMBER },
                           { "scale", VECTOR(2) },
                           { "texCoord", COUNT },
                           END },
    NULL,
};
#define TEXTURE_FIELDS                                                                             \
    { "index", REFERENCE(GLTF_TEXTURES), .required = true }, {                                     \
        "texCoord", COUNT                                                                          \
    }
static const gltf_field texture_extensions[] = {
    { "KHR_texture_transform", OBJECT(texture_transform) },
    END,
};
static const gltf_object texture_info = {
    "texture",
    (const gltf_field[]) { TEXTURE_FIELDS, END },
    texture_extensions,
};
static const gltf_object normal_texture = {
    "texture",
    (const gltf_field[]) { TEXTURE_FIELDS, { "scale", .type = GLTF_TYPE_NUMBER }, END },
    texture_extensions,
};
static const gltf_object occlusion_texture = {
    "texture",
    (const gltf_field[]) { TEXTURE_FIELDS, { "strength", UNIT }, END },
    texture_extensions,
};
static const gltf_object metallic_roughness = {
    "material",
    (const gltf_field[]) { { "baseColorFactor", VECTOR(4), UNIT },
                           { "baseColorTexture", OBJECT(texture_info) },
                           { "metallicFactor", UNIT },
                           { "roughnessFactor", UNIT },
                           { "metallicRoughnessTexture", OBJECT(texture_info) },
                           END },
    NULL,
};
static const gltf_object emissive_strength = {
    "material",
    (const gltf_field[]) { { "emissiveStrength", NOT_NEGATIVE }, END },
    NULL,
};
static const gltf_object specular = {
    "material",
    (const gltf_field[]) { { "specularFactor", UNIT },
                           { "specularTexture", OBJECT(texture_info) },
                           { "specularColorFactor", VECTOR(3), NOT_NEGATIVE },
                           { "specularColorTexture", OBJECT(texture_info) },
                           END },
    NULL,
};
static const gltf_object clearcoat = {
    "material",
    (const gltf_field[]) { { "clearcoatFactor", UNIT },
                           { "clearcoatTexture", OBJECT(texture_info) },
                           { "clearcoatRoughnessFactor", UNIT },
                           { "clearcoatRoughnessTexture", OBJECT(texture_info) },
                           { "clearcoatNormalTexture", OBJECT(normal_texture) },
                           END },
    NULL,
};
static const gltf_object sheen = {
    "material",
    (const gltf_field[]) { { "sheenColorFactor", VECTOR(3), UNIT },
                           { "sheenColorTexture", OBJECT(texture_info) },
                           { "sheenRoughnessFactor", UNIT },
                           { "sheenRoughnessTexture", OBJECT(texture_info) },
                           END },
    NULL,
};
static const gltf_object diffuse_transmission = {
    "material",
    (const gltf_field[]) { { "diffuseTransmissionFactor", UNIT },
                           { "diffuseTransmissionTexture", OBJECT(texture_info) },
                           { "diffuseTransmissionColorFactor", VECTOR(3), UNIT },
                           { "diffuseTransmissionColorTexture", OBJECT(texture_info) },
                           END },
    NULL,
};
static const gltf_object ior = {
    "material",
    (const gltf_field[]) { { "ior", NOT_NEGATIVE }, END },
    NULL,
};
static const gltf_object unlit = { "material", (const gltf_field[]) { END }, NULL };
const gltf_object gltf_schema_material = {
    "material",
    (const gltf_field[]) { { "pbrMetallicRoughness", OBJECT(metallic_roughness) },
                           { "normalTexture", OBJECT(normal_texture) },
                           { "occlusionTexture", OBJECT(occlusion_texture) },
                           { "emissiveTexture", OBJECT(texture_info) },
                           { "emissiveFactor", VECTOR(3), NOT_NEGATIVE },
                           { "alphaMode", TEXT, CHOICE("OPAQUE MASK BLEND"), FORGIVEN },
                           { "alphaCutoff", NOT_NEGATIVE },
                           { "doubleSided", FLAG },
                           NAME,
                           END },
    (const gltf_field[]) { { "KHR_materials_clearcoat", OBJECT(clearcoat) },
                           { "KHR_materials_diffuse_transmission", OBJECT(diffuse_transmission) },
                           { "KHR_materials_emissive_strength", OBJECT(emissive_strength) },
                           { "KHR_materials_ior", OBJECT(ior) },
                           { "KHR_materials_sheen", OBJECT(sheen) },
                           { "KHR_materials_specular", OBJECT(specular) },
                           { "KHR_materials_unlit", OBJECT(unlit) },
                           END },
};
