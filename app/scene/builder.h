/* SPDX-License-Identifier: MIT */
/* builder.h - growing arrays a scene is made in, then packed into one blob. */
#ifndef LAMPION_SCENE_BUILDER_H
#define LAMPION_SCENE_BUILDER_H

#include "app/scene/blob.h"

typedef struct builder_array {
    void *items;
    size_t count, capacity;
} builder_array;

/* Zero-initialize; the arrays are those of the blob, texels in bytes. */
typedef struct scene_builder {
    builder_array arrays[BLOB_SECTIONS];
    double origin[3];     /* that all positions are relative to, in the file's world */
    bool centers_meshes;  /* those far from 0 in their own space are moved there */
    double (*centers)[3]; /* if so, of each mesh: where it was, for its instances */
    bool out_of_memory;   /* sticky: the functions below then do nothing */
} scene_builder;

void builder_free(scene_builder *builder);

/* Appends `count` zeroed items to a section and returns the first, or NULL without memory. */
void *builder_append(scene_builder *builder, blob_section section, size_t count);

size_t builder_count(const scene_builder *builder, blob_section section);
void *builder_items(const scene_builder *builder, blob_section section);

/* Appends a material of glTF's defaults (white, rough, opaque, no textures). */
scene_material *builder_material(scene_builder *builder, const char *name);

/* Appends the mesh of all indices from first_index on, its bounds computed, without an instance;
 * nothing if there are none. Where meshes are centered, no other has its vertices. */
void builder_mesh(scene_builder *builder, const char *name, uint32_t material, size_t first_index);

/* Appends an instance of a mesh that a matrix, which fits one, takes into the scene. */
bool builder_place(scene_builder *builder, size_t mesh, const double matrix[16]);

/* Appends an instance of every mesh from first_mesh on, where it is. */
void builder_instances(scene_builder *builder, size_t first_mesh);

/* Points *scene at what the builder holds of geometry; the rest is zero. */
void builder_geometry(const scene_builder *builder, scene *scene);

/* Appends a sphere light of that power, in watts, times the color. */
void builder_sphere_light(scene_builder *builder, lmp_vec3 center, float radius, lmp_rgb color,
                          float power);

/* Notes that `count` of `noun` (in the singular) are read without something that they have, or,
 * with `what` NULL, not at all. */
void builder_left_out(scene_builder *builder, const char *what, const char *noun, size_t count);

/* Notes a file, an image or the like by its path; of a long one the end, which tells most. */
void builder_left_out_file(scene_builder *builder, const char *path, const char *noun);

/* Fills the header of the packed blob; with `checksum` its content hash too. */
void builder_header(const scene_builder *builder, bool checksum, blob_header *header);

/* Packs into one malloc'ed block. */
bool builder_pack(const scene_builder *builder, void **block, size_t *size);

#endif
