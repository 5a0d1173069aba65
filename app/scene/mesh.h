/* SPDX-License-Identifier: MIT */
/* mesh.h - triangles on their way into a scene: normals, tangents and sides that a file lacks are
 * computed. */
#ifndef LAMPION_SCENE_MESH_H
#define LAMPION_SCENE_MESH_H

#include "app/scene/builder.h"

#define MESH_CREASE_FLAT 2.0f /* below any cosine: no edge is smooth */
#define MESH_CREASE_60   0.5f

/* Returns a channel of a vertex's color for a stored one in sRGB; outside 0 … 1 the nearer end, for
 * NaN 0. */
uint16_t mesh_color_from_srgb(double stored);

/* A mesh; zero normals and tangents of vertices are computed from the triangles. */
typedef struct mesh_draft {
    const char *subject; /* for messages */
    const char *name;
    uint32_t material;
    scene_vertex *vertices; /* from malloc, as are the corners */
    size_t vertex_count;
    uint32_t *corners; /* 3 per triangle, below vertex_count */
    size_t corner_count;
    bool has_normals;
    bool weld;        /* merge equal vertices: the source repeats them at each corner */
    bool unsided;     /* the order of corners means nothing; it follows the normals, if given */
    bool sided;       /* output, if unsided: normals and the order of corners agree on the front */
    float unit;       /* output: a power of 2 in which edges are about 1 long */
    float crease_cos; /* computed normals are smooth across edges flatter than this */
} mesh_draft;

/* Completes the mesh and appends it to the builder, without an instance; does nothing for a mesh
 * without triangles. */
bool mesh_add(mesh_draft *draft, scene_builder *builder, base_error *error);
void mesh_free(mesh_draft *draft);

/* Gives every corner a vertex of its own. */
bool mesh_split_corners(mesh_draft *draft, base_error *error);

/* Flips every triangle, as a mirroring transform requires. */
void mesh_flip(mesh_draft *draft);

/* An affine map of points, with the maps of normals and tangents that belong to it. */
typedef struct mesh_transform {
    double m[3][4];
    double normal[3][3]; /* cofactors: the map of normals, up to scale */
    bool mirrors;
} mesh_transform;

mesh_transform mesh_transform_make(const double m[16]); /* column-major */
void mesh_transform_vertex(const mesh_transform *transform, scene_vertex *vertex);

#endif
