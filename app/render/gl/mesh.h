/* SPDX-License-Identifier: MIT */
/* mesh.h - a scene's triangles, materials and textures on the device. */
#ifndef LAMPION_RENDER_GL_MESH_H
#define LAMPION_RENDER_GL_MESH_H

#include "app/render/gl/gpu.h"
#include "shaders/program/shared.h"

#include <epoxy/gl.h>

/* An instance as surface.vert reads it, once for all its vertices. */
typedef struct gpu_instance {
    float world_from_mesh[3][4];
    GLuint number; /* among its draw's instances, + SHARED_INSTANCE_MOVES */
} gpu_instance;

/* Bounds in the world. */
typedef struct gpu_box {
    float minimum[3], maximum[3];
} gpu_box;

/* A mesh with all of its instances that mirror it, or all that do not. */
typedef struct gpu_draw {
    GLuint first_index, index_count, material;
    bool mirrors;
    size_t first, count;     /* of instances */
    GLuint seen, first_seen; /* how many of them the frustum may hold, and the first's index */
} gpu_draw;

typedef struct gpu_material {
    GLuint maps[SHARED_MAPS], samplers[SHARED_MAPS]; /* OpenGL's names; map 0 = none */
    bool double_sided, masked, layered;
    bool plain; /* at most double-sided: without maps and vertex colors */
} gpu_material;

typedef struct gpu_mesh {
    GLuint vertices, indices, vertex_array, material_blocks, material_constants;
    GLsizeiptr material_stride;
    gpu_instance *instances, *seen; /* by draws; those that are drawn */
    gpu_box *boxes;                 /* of the instances */
    size_t instance_count;
    GLuint seen_buffer;
    gpu_draw *draws; /* opaque ones first, then by material */
    size_t draw_count;
    gpu_material *materials;
    size_t material_count;
    GLuint *textures; /* one per texture of the scene; equal ones share OpenGL's name */
    GLsizei texture_count;
    GLuint samplers[SCENE_WRAPS * SCENE_WRAPS]; /* by wrap_u + SCENE_WRAPS * wrap_v */
    bool layered, translucent;                  /* whether any material is */
} gpu_mesh;

/* The programs of surface.frag's variants. */
typedef struct gpu_surfaces {
    GLuint plain, opaque, masked, layered, layered_masked;
} gpu_surfaces;

bool gpu_mesh_create(const gpu_context *context, const scene *scene, gpu_mesh *mesh,
                     base_error *error);
void gpu_mesh_destroy(gpu_mesh *mesh);

/* Lets a table shade a material, or -1 its own parameters. */
void gpu_mesh_set_table(const gpu_mesh *mesh, size_t material, int table);

/* Draws the instances that may be in the frustum of clip_from_world. */
void gpu_mesh_draw(const gpu_mesh *mesh, const mat4 clip_from_world, const gpu_surfaces *programs);

#endif
