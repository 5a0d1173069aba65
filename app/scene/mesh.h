/* SPDX-License-Identifier: MIT */
/* mesh.h - triangles on their way into a scene: what a file does not say of them is made. */
#ifndef LAMPION_SCENE_MESH_H
#define LAMPION_SCENE_MESH_H

#include "app/scene/builder.h"

#define MESH_CREASE_FLAT 2.0f /* no edge is smooth */
#define MESH_CREASE_60   0.5f

/* A mesh. Normals and tangents of a vertex may be zero: they are then made from its
 * triangles. */
typedef struct mesh_draft {
    const char *subject; /* for messages */
    const char *name;
    uint32_t material;
    scene_vertex *vertices; /* from malloc, as are the corners */
    size_t vertex_count;
    uint32_t *corners; /* 3 a triangle, below vertex_count */
    size_t corner_count;
    bool has_normals;
    bool weld;    /* merge equal vertices: the source has them once a corner */
    bool unsided; /* the order of corners means nothing: it follows given normals */
    bool sided; /* filled in, where unsided: normals and the order of corners agree on the sides */
    float unit; /* filled in: a power of 2, by which its edges are about 1 long */
    float crease_cos; /* missing normals are smooth across edges flatter than this */
} mesh_draft;

/* Makes what is missing and appends the mesh to the builder, without an instance; one without
 * triangles is left out. */
bool mesh_add(mesh_draft *draft, scene_builder *builder, cli_error *error);
void mesh_free(mesh_draft *draft);

/* Gives every corner a vertex of its own. */
bool mesh_split_corners(mesh_draft *draft, cli_error *error);

/* Flips every triangle, as a transform that mirrors needs it. */
void mesh_flip(mesh_draft *draft);

/* An affine map of points, and of the normals and tangents that go with them. */
typedef struct mesh_transform {
    double m[3][4];
    double normal[3][3]; /* cofactors: of normals, up to scale */
    bool mirrors;
} mesh_transform;

mesh_transform mesh_transform_make(const double m[16]); /* column-major */
void mesh_transform_vertex(const mesh_transform *transform, scene_vertex *vertex);

#endif
