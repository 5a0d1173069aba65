/* SPDX-License-Identifier: MIT */
/* gltf.h - what the importer reads from the JSON of a glTF file itself: a check that nothing
 * reaches outside its buffers before Assimp gets it, materials, textures, cameras and lights. */
#ifndef LAMPION_SCENE_GLTF_H
#define LAMPION_SCENE_GLTF_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

#include <cjson/cJSON.h>

/* The entries of one of the document's arrays. */
typedef struct gltf_list {
    const cJSON **items;
    size_t count;
} gltf_list;

typedef struct gltf {
    const char *subject;
    source_set *sources;
    cJSON *root;
    const unsigned char *binary; /* the BIN chunk of a GLB, or NULL */
    size_t binary_size;
    gltf_list nodes, meshes, materials, textures, images, samplers;
    gltf_list buffers, views, accessors, cameras, lights;
    double (*world)[16]; /* of each node, column-major; zero for nodes outside the scene */
} gltf;

/* Parses .gltf or .glb bytes, which must outlive *document, and checks the whole structure. */
bool gltf_open(const void *data, size_t size, source_set *sources, gltf *document,
               cli_error *error);
void gltf_close(gltf *document);

/* The bytes of a buffer view, decoded into *owned (to be freed) if they are base64. */
bool gltf_view_bytes(const gltf *document, size_t view, const unsigned char **bytes, size_t *size,
                     void **owned, cli_error *error);

/* Decodes the base64 of a data URI into *owned, to be freed. */
bool gltf_data_uri_bytes(const char *uri, void **owned, size_t *size);

/* Appends materials in the file's order, then glTF's default material; and the textures in use. */
bool gltf_add_materials(const gltf *document, scene_builder *builder, cli_error *error);

/* Appends cameras and punctual lights; to be called when the geometry is there. */
bool gltf_add_views(const gltf *document, scene_builder *builder, cli_error *error);

/* A node's own transform, but for a matrix it may have instead. */
typedef struct gltf_transform {
    double translation[3], rotation[4], scale[3];
} gltf_transform;
void gltf_transform_read(const cJSON *node, gltf_transform *transform);
void gltf_transform_matrix(const gltf_transform *transform, double matrix[16]); /* column-major */

/* The animations of nodes; NULL without memory. Channels that are damaged or not in float are left
 * out. */
typedef struct gltf_motions gltf_motions;
gltf_motions *gltf_motions_open(const gltf *document);
void gltf_motions_close(gltf_motions *motions);

/* Appends how a node moves, if it does, as the motion of a light. */
bool gltf_add_motion(const gltf *document, const gltf_motions *motions, size_t node, size_t light,
                     scene_builder *builder, cli_error *error);

/* --- reading JSON -------------------------------------------------------------------------------
 */

/* object[name]; NULL if there is none, or no object. */
const cJSON *gltf_member(const cJSON *object, const char *name);
double gltf_number(const cJSON *object, const char *name, double fallback);
/* An index below `count`, or -1: then *ok is set to false unless the member is simply absent. */
long gltf_index(const cJSON *object, const char *name, size_t count, bool *ok);
/* Reads an array of exactly `count` numbers; leaves `numbers` alone otherwise. */
void gltf_numbers(const cJSON *object, const char *name, size_t count, double *numbers);
const char *gltf_text(const cJSON *object, const char *name);

#endif
