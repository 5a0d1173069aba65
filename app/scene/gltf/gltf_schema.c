/* SPDX-License-Identifier: MIT */
/* gltf_schema.c - the schema of glTF 2.0 and of the extensions that are read. */
#include "app/scene/gltf/gltf_schema.h"

#include "app/scene/gltf/gltf_schema_material.h"

/* --- bytes ------------------------------------------------------------------------------------ */

static const gltf_object fallback = {
    "buffer",
    (const gltf_field[]) { { "fallback", FLAG }, END },
    NULL,
};
static const gltf_object buffer = {
    "buffer",
    (const gltf_field[]) {
        { "uri", TEXT }, { "byteLength", COUNT, .minimum = 1, .required = true }, NAME, END },
    (const gltf_field[]) { { "EXT_meshopt_compression", OBJECT(fallback) },
                           { "KHR_meshopt_compression", OBJECT(fallback) },
                           END },
};
static const gltf_object compressed_view = {
    "buffer view",
    (const gltf_field[]) {
        { "buffer", REFERENCE(GLTF_BUFFERS), .required = true },
        { "byteOffset", COUNT },
        { "byteLength", COUNT, .minimum = 1, .required = true },
        { "byteStride", .type = GLTF_TYPE_INTEGER, .minimum = 2, .maximum = 256, .required = true },
        { "count", COUNT, .minimum = 1, .required = true },
        { "mode", TEXT, CHOICE("ATTRIBUTES TRIANGLES INDICES"), .required = true },
        { "filter", TEXT, CHOICE("NONE OCTAHEDRAL QUATERNION EXPONENTIAL COLOR") },
        END },
    NULL,
};
static const gltf_object view = {
    "buffer view",
    (const gltf_field[]) {
        { "buffer", REFERENCE(GLTF_BUFFERS), .required = true },
        { "byteOffset", COUNT },
        { "byteLength", COUNT, .minimum = 1, .required = true },
        { "byteStride", .type = GLTF_TYPE_INTEGER, .minimum = 4, .maximum = 252 },
        { "target", INTEGER_CHOICE("34962 34963"), FORGIVEN },
        NAME,
        END },
    (const gltf_field[]) { { "EXT_meshopt_compression", OBJECT(compressed_view) },
                           { "KHR_meshopt_compression", OBJECT(compressed_view) },
                           END },
};
static const gltf_object sparse_indices = {
    "accessor",
    (const gltf_field[]) { { "bufferView", REFERENCE(GLTF_VIEWS), .required = true },
                           { "byteOffset", COUNT },
                           { "componentType", INTEGER_CHOICE("5121 5123 5125"), .required = true },
                           END },
    NULL,
};
static const gltf_object sparse_values = {
    "accessor",
    (const gltf_field[]) {
        { "bufferView", REFERENCE(GLTF_VIEWS), .required = true }, { "byteOffset", COUNT }, END },
    NULL,
};
static const gltf_object sparse = {
    "accessor",
    (const gltf_field[]) { { "count", COUNT, .minimum = 1, .required = true },
                           { "indices", OBJECT(sparse_indices), .required = true },
                           { "values", OBJECT(sparse_values), .required = true },
                           END },
    NULL,
};
static const gltf_object accessor = {
    "accessor",
    (const gltf_field[]) {
        { "bufferView", REFERENCE(GLTF_VIEWS) },
        { "byteOffset", COUNT },
        { "componentType", INTEGER_CHOICE("5120 5121 5122 5123 5125 5126"), .required = true },
        { "normalized", FLAG },
        { "count", COUNT, .minimum = 1, .required = true },
        { "type", TEXT, CHOICE("SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4"), .required = true },
        { "max", .array = true, .least = 1, .most = 16 },
        { "min", .array = true, .least = 1, .most = 16 },
        { "sparse", OBJECT(sparse) },
        NAME,
        END },
    NULL,
};

/* --- meshes and nodes ------------------------------------------------------------------------- */

#define ATTRIBUTES .type = GLTF_TYPE_REFERENCES, .kind = GLTF_ACCESSORS
static const gltf_object names = { "mesh", (const gltf_field[]) { END }, NULL };
static const gltf_object draco = {
    "mesh",
    (const gltf_field[]) { { "bufferView", REFERENCE(GLTF_VIEWS), .required = true },
                           { "attributes", OBJECT(names), .required = true },
                           END },
    NULL,
};
static const gltf_object variant_mapping = {
    "mesh",
    (const gltf_field[]) { { "material", REFERENCE(GLTF_MATERIALS), .required = true },
                           { "variants", .array = true, COUNT, .required = true },
                           NAME,
                           END },
    NULL,
};
static const gltf_object variant_mappings = {
    "mesh",
    (const gltf_field[]) { { "mappings", LIST_OF(variant_mapping) }, END },
    NULL,
};
static const gltf_object primitive = {
    "mesh",
    (const gltf_field[]) { { "attributes", ATTRIBUTES, .required = true },
                           { "indices", REFERENCE(GLTF_ACCESSORS) },
                           { "material", REFERENCE(GLTF_MATERIALS) },
                           { "mode", .type = GLTF_TYPE_INTEGER, .maximum = 6 },
                           { "targets", .array = true, ATTRIBUTES },
                           END },
    (const gltf_field[]) { { "KHR_draco_mesh_compression", OBJECT(draco) },
                           { "KHR_materials_variants", OBJECT(variant_mappings) },
                           END },
};
static const gltf_object mesh = {
    "mesh",
    (const gltf_field[]) { { "primitives", LIST_OF(primitive), .least = 1, .required = true },
                           { "weights", .array = true },
                           NAME,
                           END },
    NULL,
};
static const gltf_object skin = {
    "skin",
    (const gltf_field[]) { { "inverseBindMatrices", REFERENCE(GLTF_ACCESSORS) },
                           { "skeleton", REFERENCE(GLTF_NODES) },
                           { "joints", .array = true, REFERENCE(GLTF_NODES), .least = 1,
                             .distinct = true, .required = true },
                           NAME,
                           END },
    NULL,
};
static const gltf_object light_use = {
    "node",
    (const gltf_field[]) { { "light", REFERENCE(GLTF_LIGHTS), .required = true }, END },
    NULL,
};
static const gltf_object area_light_use = {
    "node",
    (const gltf_field[]) { { "light", REFERENCE(GLTF_AREA_LIGHTS), .required = true }, END },
    NULL,
};
static const gltf_object instancing = {
    "node",
    (const gltf_field[]) { { "attributes", ATTRIBUTES, .required = true }, END },
    NULL,
};
static const gltf_object node = {
    "node",
    (const gltf_field[]) { { "camera", REFERENCE(GLTF_CAMERAS) },
                           { "children", .array = true, REFERENCE(GLTF_NODES), .distinct = true },
                           { "skin", REFERENCE(GLTF_SKINS) },
                           { "matrix", VECTOR(16) },
                           { "mesh", REFERENCE(GLTF_MESHES) },
                           { "rotation", VECTOR(4) },
                           { "scale", VECTOR(3) },
                           { "translation", VECTOR(3) },
                           { "weights", .array = true },
                           NAME,
                           END },
    (const gltf_field[]) { { "KHR_lights_punctual", OBJECT(light_use) },
                           { "EXT_lights_area", OBJECT(area_light_use) },
                           { "EXT_mesh_gpu_instancing", OBJECT(instancing) },
                           END },
};
static const gltf_object scene_object = {
    "scene",
    (const gltf_field[]) {
        { "nodes", .array = true, REFERENCE(GLTF_NODES), .distinct = true }, NAME, END },
    NULL,
};

/* --- cameras and lights ----------------------------------------------------------------------- */

static const gltf_object orthographic = {
    "camera",
    (const gltf_field[]) { { "xmag", .type = GLTF_TYPE_NUMBER, .required = true },
                           { "ymag", .type = GLTF_TYPE_NUMBER, .required = true },
                           { "zfar", POSITIVE, .required = true },
                           { "znear", NOT_NEGATIVE, .required = true },
                           END },
    NULL,
};
static const gltf_object perspective = {
    "camera",
    (const gltf_field[]) { { "aspectRatio", POSITIVE },
                           { "yfov", POSITIVE, .required = true },
                           { "zfar", POSITIVE },
                           { "znear", POSITIVE, .required = true },
                           END },
    NULL,
};
static const gltf_object camera = {
    "camera",
    (const gltf_field[]) {
        { "orthographic", OBJECT(orthographic) },
        { "perspective", OBJECT(perspective) },
        { "type", TEXT, CHOICE("orthographic perspective"), FORGIVEN, .required = true },
        NAME,
        END },
    NULL,
};
static const gltf_object spot = {
    "light",
    (const gltf_field[]) {
        { "innerConeAngle", .maximum = M_PI_2 }, { "outerConeAngle", .maximum = M_PI_2 }, END },
    NULL,
};
static const gltf_object light = {
    "light",
    (const gltf_field[]) {
        { "color", VECTOR(3), NOT_NEGATIVE },
        { "intensity", NOT_NEGATIVE },
        { "range", POSITIVE },
        { "spot", OBJECT(spot) },
        { "type", TEXT, CHOICE("directional point spot"), FORGIVEN, .required = true },
        NAME,
        END },
    NULL,
};
static const gltf_object rectangle = {
    "area light",
    (const gltf_field[]) { { "aspect", POSITIVE }, END },
    NULL,
};
static const gltf_object area_light = {
    "area light",
    (const gltf_field[]) { { "color", VECTOR(3), NOT_NEGATIVE },
                           { "intensity", NOT_NEGATIVE },
                           { "rect", OBJECT(rectangle) },
                           { "size", POSITIVE },
                           { "type", TEXT, CHOICE("rect disk"), FORGIVEN, .required = true },
                           NAME,
                           END },
    NULL,
};
static const gltf_object area_lights = {
    "file",
    (const gltf_field[]) { { "lights", LIST_OF(area_light), .required = true }, END },
    NULL,
};
static const gltf_object lights = {
    "file",
    (const gltf_field[]) { { "lights", LIST_OF(light), .required = true }, END },
    NULL,
};

/* --- animations ------------------------------------------------------------------------------- */

static const gltf_object channel_target = {
    "animation",
    (const gltf_field[]) {
        { "node", REFERENCE(GLTF_NODES) }, { "path", TEXT, .required = true }, END },
    NULL,
};
static const gltf_object channel = {
    "animation",
    (const gltf_field[]) { { "sampler", COUNT, .required = true },
                           { "target", OBJECT(channel_target), .required = true },
                           END },
    NULL,
};
static const gltf_object animation_sampler = {
    "animation",
    (const gltf_field[]) { { "input", REFERENCE(GLTF_ACCESSORS), .required = true },
                           { "interpolation", TEXT, CHOICE("LINEAR STEP CUBICSPLINE"), FORGIVEN },
                           { "output", REFERENCE(GLTF_ACCESSORS), .required = true },
                           END },
    NULL,
};
static const gltf_object animation = {
    "animation",
    (const gltf_field[]) { { "channels", LIST_OF(channel), .least = 1, .required = true },
                           { "samplers", LIST_OF(animation_sampler), .least = 1, .required = true },
                           NAME,
                           END },
    NULL,
};

/* --- the document ----------------------------------------------------------------------------- */

static const gltf_object variant = {
    "file",
    (const gltf_field[]) { { "name", TEXT, .required = true }, END },
    NULL,
};
static const gltf_object variants = {
    "file",
    (const gltf_field[]) { { "variants", LIST_OF(variant) }, END },
    NULL,
};

static const gltf_object asset = {
    "file",
    (const gltf_field[]) { { "copyright", TEXT },
                           { "generator", TEXT },
                           { "version", TEXT, .required = true },
                           { "minVersion", TEXT },
                           END },
    NULL,
};
const gltf_object gltf_schema = {
    "file",
    (const gltf_field[]) { { "extensionsUsed", .array = true, TEXT },
                           { "extensionsRequired", .array = true, TEXT },
                           { "accessors", LIST_OF(accessor) },
                           { "animations", LIST_OF(animation) },
                           { "asset", OBJECT(asset), .required = true },
                           { "buffers", LIST_OF(buffer) },
                           { "bufferViews", LIST_OF(view) },
                           { "cameras", LIST_OF(camera) },
                           { "images", LIST_OF(gltf_schema_image) },
                           { "materials", LIST_OF(gltf_schema_material) },
                           { "meshes", LIST_OF(mesh) },
                           { "nodes", LIST_OF(node) },
                           { "samplers", LIST_OF(gltf_schema_sampler) },
                           { "scene", REFERENCE(GLTF_SCENES) },
                           { "scenes", LIST_OF(scene_object) },
                           { "skins", LIST_OF(skin) },
                           { "textures", LIST_OF(gltf_schema_texture) },
                           END },
    (const gltf_field[]) { { "KHR_lights_punctual", OBJECT(lights) },
                           { "EXT_lights_area", OBJECT(area_lights) },
                           { "KHR_materials_variants", OBJECT(variants) },
                           END },
};
