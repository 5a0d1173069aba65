/* SPDX-License-Identifier: MIT */
/* gltf.h - glTF 2.0: a document whose every field, reference and byte range is checked when it is
 * opened and loaded, so that what reads it may trust it. */
#ifndef LAMPION_SCENE_GLTF_H
#define LAMPION_SCENE_GLTF_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

#include <cjson/cJSON.h>

/* The document's arrays. */
typedef enum gltf_kind {
    GLTF_ACCESSORS,
    GLTF_ANIMATIONS,
    GLTF_BUFFERS,
    GLTF_VIEWS,
    GLTF_CAMERAS,
    GLTF_IMAGES,
    GLTF_LIGHTS,
    GLTF_MATERIALS,
    GLTF_MESHES,
    GLTF_NODES,
    GLTF_SAMPLERS,
    GLTF_SCENES,
    GLTF_SKINS,
    GLTF_TEXTURES,
    GLTF_KINDS
} gltf_kind;

typedef struct gltf_list {
    const cJSON **items;
    size_t count;
} gltf_list;

typedef struct gltf_bytes {
    const unsigned char *bytes;
    size_t size;
    void *owned; /* bytes that were decoded, from a data URI or a compressed view */
} gltf_bytes;

typedef enum gltf_component {
    GLTF_BYTE = 5120,
    GLTF_UNSIGNED_BYTE = 5121,
    GLTF_SHORT = 5122,
    GLTF_UNSIGNED_SHORT = 5123,
    GLTF_UNSIGNED_INT = 5125,
    GLTF_FLOAT = 5126,
} gltf_component;

typedef struct gltf_accessor {
    size_t count;
    int width; /* components of an element */
    gltf_component component;
    bool normalized;
    const unsigned char *bytes; /* NULL: zeros */
    size_t stride;
    long view;   /* or -1 */
    void *owned; /* bytes that were decompressed for it */
    struct {
        size_t count;
        gltf_component component;
        const unsigned char *indices, *values;
    } sparse;
} gltf_accessor;

typedef struct gltf_node {
    long parent;      /* or -1 */
    bool shown;       /* it is in the scene */
    double world[16]; /* column-major; to the world relative to the builder's origin */
} gltf_node;

typedef struct gltf {
    const char *subject;
    source_set *sources;
    scene_builder *builder; /* is told what is left out */
    cJSON *root;
    gltf_bytes binary; /* the BIN chunk of a GLB */
    gltf_list lists[GLTF_KINDS];
    gltf_bytes *buffers;
    gltf_bytes *views; /* those that were compressed; without bytes, the others */
    gltf_accessor *accessors;
    gltf_node *nodes;
    size_t *order; /* of the nodes: parents first, as the scene lists them */
    long variant;  /* of the materials that is shown, or -1 */
} gltf;

/* Appends all that a .gltf or .glb shows (app/scene/origin.h). */
bool gltf_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
              cli_error *error);

/* --- its parts, in their order ---------------------------------------------------------------- */

/* Parses .gltf or .glb bytes, which must outlive *document, and checks its fields. Close it even
 * after a failure. */
bool gltf_open(const void *data, size_t size, source_set *sources, scene_builder *builder,
               gltf *document, cli_error *error);
void gltf_close(gltf *document);

/* Appends the names of the variants of materials, and chooses the one that the sources want. */
bool gltf_choose_variant(gltf *document, cli_error *error);

/* The material that a primitive has in the chosen variant, or without one; -1: none. */
long gltf_primitive_material(const gltf *document, const cJSON *primitive);

/* Loads buffers and checks what the functions below rely on. */
bool gltf_load(gltf *document, cli_error *error);

/* Appends the triangles of the scene's nodes; materials keep the file's numbers. */
bool gltf_add_meshes(const gltf *document, scene_builder *builder, cli_error *error);

/* Appends materials in the file's order, then glTF's default material; and the textures in use. */
bool gltf_add_materials(const gltf *document, scene_builder *builder, cli_error *error);

/* Which of a material's sets of texture coordinates become a vertex's two, -1: none. The first is
 * that of the normal map, which tangents follow. */
void gltf_material_sets(const cJSON *material, long sets[2]);

/* Appends cameras and punctual lights; to be called when the geometry is there. */
bool gltf_add_views(const gltf *document, scene_builder *builder, cli_error *error);

/* --- checks, each of one part; gltf_open and gltf_load call all
 * ----------------------------------------------
 */

/* Unpacks the container and parses its JSON; no name is there twice in an object. */
bool gltf_parse(gltf *document, const void *data, size_t size, cli_error *error);

/* First of all: another version has another schema. */
bool gltf_check_version(const gltf *document, cli_error *error);

/* Every field against the specification's schema: type, range, number of entries, reference. What
 * extensions say and nothing here reads is noted as left out. */
bool gltf_check_schema(const gltf *document, cli_error *error);

/* Those that the file requires. */
bool gltf_check_extensions(const gltf *document, cli_error *error);

/* Loads buffers, checks views, unpacks accessors. */
bool gltf_load_buffers(gltf *document, cli_error *error);
bool gltf_load_accessors(gltf *document, cli_error *error);

/* Whether accessors that have no data claim little enough to be made up of zeros. */
bool gltf_check_backing(const gltf *document, cli_error *error);

/* Decompresses what Draco compressed into accessors that are loaded. */
bool gltf_load_draco(gltf *document, cli_error *error);

/* The tree of nodes: one parent at most, no loop; parents, order and world transforms. */
bool gltf_load_nodes(gltf *document, cli_error *error);

/* Primitives, skins, cameras, images: what fields must be to one another. */
bool gltf_check_uses(const gltf *document, cli_error *error);

/* Fails with the kind's name, the index and what is wrong with it. */
bool gltf_fail(const gltf *document, gltf_kind kind, size_t index, const char *wrong,
               cli_error *error);

/* --- bytes ------------------------------------------------------------------------------------ */

/* The bytes of a data URI; *bytes owns them. Without a URI of that scheme, or damaged: false. */
bool gltf_data_uri(const char *uri, gltf_bytes *bytes);

/* The bytes of a buffer view, which the document owns. */
gltf_bytes gltf_view_bytes(const gltf *document, size_t view);

/* Bytes of one element as it is stored, matrices with their padding. */
size_t gltf_element_size(const char *type, gltf_component component);

/* The elements as floats, normalized ones scaled: width x count, to be freed. All are finite. */
bool gltf_read_floats(const gltf *document, size_t accessor, float **numbers, cli_error *error);

/* The elements of integers, all below `limit`: width x count, to be freed. */
bool gltf_read_integers(const gltf *document, size_t accessor, size_t limit, uint32_t **numbers,
                        cli_error *error);

/* --- transforms ------------------------------------------------------------------------------- */

/* A node's own transform, but for a matrix it may have instead. */
typedef struct gltf_transform {
    double translation[3], rotation[4], scale[3];
} gltf_transform;
void gltf_transform_read(const cJSON *node, gltf_transform *transform);
void gltf_transform_matrix(const gltf_transform *transform, double matrix[16]); /* column-major */

/* The animations of nodes; NULL on failure. */
typedef struct gltf_motions gltf_motions;
gltf_motions *gltf_motions_open(const gltf *document, cli_error *error);
void gltf_motions_close(gltf_motions *motions);
bool gltf_moves(const gltf_motions *motions, size_t node);
bool gltf_rotates(const gltf_motions *motions, size_t node); /* its rotation changes */

/* Appends how a node moves, if it does, as the motion of a light. */
bool gltf_add_motion(const gltf *document, const gltf_motions *motions, size_t node, size_t light,
                     scene_builder *builder, cli_error *error);

/* --- reading JSON whose schema is checked ----------------------------------------------------- */

static inline size_t gltf_count(const gltf *document, gltf_kind kind) {
    return document->lists[kind].count;
}

static inline const cJSON *gltf_item(const gltf *document, gltf_kind kind, size_t index) {
    return document->lists[kind].items[index];
}

/* object[name]; NULL if there is none, or no object. */
const cJSON *gltf_member(const cJSON *object, const char *name);
/* object.extensions[name] */
const cJSON *gltf_extension(const cJSON *object, const char *name);
double gltf_number(const cJSON *object, const char *name, double fallback);
/* A reference; -1 without one. */
long gltf_index(const cJSON *object, const char *name);
/* Reads an array of numbers; leaves `numbers` alone where there is none of that length. */
void gltf_numbers(const cJSON *object, const char *name, size_t count, double *numbers);
const char *gltf_text(const cJSON *object, const char *name);

#endif
