/* SPDX-License-Identifier: MIT */
/* gltf.h - glTF 2.0: every field, reference and byte range of a document is checked when it is
 * opened and loaded, so that code that reads it may rely on them. */
#ifndef LAMPION_SCENE_GLTF_GLTF_H
#define LAMPION_SCENE_GLTF_GLTF_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

#include <jansson.h>

/* The kinds of arrays in a document. */
typedef enum gltf_kind {
    GLTF_ACCESSORS,
    GLTF_ANIMATIONS,
    GLTF_BUFFERS,
    GLTF_VIEWS,
    GLTF_CAMERAS,
    GLTF_IMAGES,
    GLTF_LIGHTS,
    GLTF_AREA_LIGHTS,
    GLTF_MATERIALS,
    GLTF_MESHES,
    GLTF_NODES,
    GLTF_SAMPLERS,
    GLTF_SCENES,
    GLTF_SKINS,
    GLTF_TEXTURES,
    GLTF_KINDS
} gltf_kind;

typedef struct gltf_bytes {
    const unsigned char *bytes;
    size_t size;
    void *owned; /* decoded bytes, from a data URI or a compressed view */
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
    void *owned; /* decompressed bytes, if any */
    struct {
        size_t count;
        gltf_component component;
        const unsigned char *indices, *values;
    } sparse;
} gltf_accessor;

typedef struct gltf_node {
    long parent;      /* or -1 */
    bool shown;       /* whether it is in the scene, */
    bool filled;      /* and has a mesh, or one below it */
    uint32_t number;  /* then: of the scene's node */
    double world[16]; /* column-major; to the world relative to the builder's origin */
} gltf_node;

typedef struct gltf {
    const char *subject;
    source_set *sources;
    scene_builder *builder; /* also receives notes of unsupported features */
    json_t *root;
    gltf_bytes binary;         /* the BIN chunk of a GLB */
    json_t *lists[GLTF_KINDS]; /* NULL if the document has none */
    gltf_bytes *buffers;
    gltf_bytes *views; /* decompressed views; entries of other views have no bytes */
    gltf_accessor *accessors;
    gltf_node *nodes;
    size_t *order; /* of the nodes: parents first, in the order of the scene */
    long variant;  /* the chosen variant of the materials, or -1 */
} gltf;

/* Appends everything that a .gltf or .glb shows (app/scene/load/origin.h). */
bool gltf_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
              base_error *error);

/* --- stages, in their order ------------------------------------------------------------------- */

/* Parses .gltf or .glb bytes, which must outlive *document, and checks its fields. Close it even
 * after a failure. */
bool gltf_open(const void *data, size_t size, source_set *sources, scene_builder *builder,
               gltf *document, base_error *error);
void gltf_close(gltf *document);

/* Appends the names of the variants of materials, and chooses the one that the sources request. */
bool gltf_choose_variant(gltf *document, base_error *error);

/* Returns the material of a primitive in the chosen variant, or without one; -1: none. */
long gltf_primitive_material(const gltf *document, json_t *primitive);

/* Loads buffers and checks what the functions below rely on. */
bool gltf_load(gltf *document, base_error *error);

/* Appends the triangles of the scene's nodes; materials keep the file's numbers. */
bool gltf_add_meshes(const gltf *document, scene_builder *builder, base_error *error);

/* Appends materials in the file's order, then glTF's default material; and the textures in use. */
bool gltf_add_materials(const gltf *document, scene_builder *builder, base_error *error);

/* Finds which of a material's sets of texture coordinates become a vertex's two sets; -1: none. The
 * first is that of the normal map, which tangents follow. */
void gltf_material_sets(json_t *material, long sets[2]);

/* Appends cameras and lights; the geometry must be there already. */
bool gltf_add_views(const gltf *document, scene_builder *builder, base_error *error);

/* --- checks, each of one part; gltf_open and gltf_load call them all -------------------------- */

/* Unpacks the container and parses its JSON; fails if an object has a name twice. */
bool gltf_parse(gltf *document, const void *data, size_t size, base_error *error);

/* Checks the version before all else, because another version has another schema. */
bool gltf_check_version(const gltf *document, base_error *error);

/* Checks every field against the specification's schema: type, range, number of entries, reference.
 * Unknown extensions are noted as unsupported. */
bool gltf_check_schema(const gltf *document, base_error *error);

/* Checks that the extensions that the file requires are supported. */
bool gltf_check_extensions(const gltf *document, base_error *error);

/* Loads buffers, checks views, unpacks accessors. */
bool gltf_load_buffers(gltf *document, base_error *error);
bool gltf_load_accessors(gltf *document, base_error *error);

/* Whether accessors without data, which are made of zeros, claim little enough memory. */
bool gltf_check_backing(const gltf *document, base_error *error);

/* Decompresses what Draco compressed into accessors that are loaded. */
bool gltf_load_draco(gltf *document, base_error *error);

/* Checks the tree of nodes, one parent at most and no loop; computes parents, order and world
 * transforms. */
bool gltf_load_nodes(gltf *document, base_error *error);

/* Checks primitives, skins, cameras and images for fields that do not fit together. */
bool gltf_check_uses(const gltf *document, base_error *error);

/* Fails with a message of the kind's name, the index and what is wrong with that item. */
bool gltf_fail(const gltf *document, gltf_kind kind, size_t index, const char *wrong,
               base_error *error);

/* --- bytes ------------------------------------------------------------------------------------ */

/* Decodes the bytes of a data URI; *bytes owns them. Returns false if the URI is damaged or of
 * another scheme. */
bool gltf_data_uri(const char *uri, gltf_bytes *bytes);

/* Returns the bytes of a buffer view, which the document owns. */
gltf_bytes gltf_view_bytes(const gltf *document, size_t view);

/* Returns the stored bytes of one element; matrices have padding. */
size_t gltf_element_size(const char *type, gltf_component component);

/* Reads the elements as floats, normalized ones scaled: width x count, to be freed. All are
 * finite. */
bool gltf_read_floats(const gltf *document, size_t accessor, float **numbers, base_error *error);

/* Reads integer elements, all below `limit`: width x count, to be freed. */
bool gltf_read_integers(const gltf *document, size_t accessor, size_t limit, uint32_t **numbers,
                        base_error *error);

/* --- transforms ------------------------------------------------------------------------------- */

/* A node's own transform by its parts, unless it has a matrix. */
typedef struct gltf_transform {
    double translation[3], rotation[4], scale[3];
} gltf_transform;
void gltf_transform_read(json_t *node, gltf_transform *transform);
void gltf_transform_matrix(const gltf_transform *transform, double matrix[16]); /* column-major */

/* The animations of nodes; gltf_motions_open returns NULL on failure. */
typedef struct gltf_motions gltf_motions;
gltf_motions *gltf_motions_open(const gltf *document, base_error *error);
void gltf_motions_close(gltf_motions *motions);
bool gltf_moves(const gltf_motions *motions, size_t node);
bool gltf_rotates(const gltf_motions *motions, size_t node); /* whether its rotation changes */

/* Appends a node's motion, if it has any, as the motion of a light. */
bool gltf_add_motion(const gltf *document, const gltf_motions *motions, size_t node, size_t light,
                     scene_builder *builder, base_error *error);

/* --- reading JSON whose schema is checked ----------------------------------------------------- */

static inline size_t gltf_count(const gltf *document, gltf_kind kind) {
    return json_array_size(document->lists[kind]);
}

static inline json_t *gltf_item(const gltf *document, gltf_kind kind, size_t index) {
    return json_array_get(document->lists[kind], index);
}

static inline json_t *gltf_primitives(const gltf *document, size_t mesh) {
    return json_object_get(gltf_item(document, GLTF_MESHES, mesh), "primitives");
}

/* Returns object.extensions[name], or NULL. */
json_t *gltf_extension(const json_t *object, const char *name);
double gltf_number(const json_t *object, const char *name, double fallback);
/* Returns a reference, or -1 if there is none. */
long gltf_index(const json_t *object, const char *name);
/* Reads an array of numbers; leaves `numbers` alone if there is none of that length. */
void gltf_numbers(const json_t *object, const char *name, size_t count, double *numbers);
const char *gltf_text(const json_t *object, const char *name);

#endif
