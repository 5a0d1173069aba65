/* SPDX-License-Identifier: MIT */
/* builder.h - the growing arrays that a scene is made in before they are packed into one blob. */
#ifndef LAMPION_SCENE_BUILDER_H
#define LAMPION_SCENE_BUILDER_H

#include "app/scene/blob.h"

typedef struct builder_array {
    void *items;
    size_t count, capacity;
} builder_array;

/* A scene in the making; zero-initialize. The arrays are the sections of the blob, texels in
 * bytes. */
typedef struct scene_builder {
    builder_array arrays[BLOB_SECTIONS];
    double origin[3];     /* of all positions, in the file's world */
    int up;               /* the file's axis that points up; AUTO: its format does not say */
    bool centers_meshes;  /* whether meshes far from 0 in their own space are moved near it */
    double (*centers)[3]; /* then, for each mesh, where it was, for its instances */
    bool has_tree;        /* whether instances are added to the last node, not each to its own */
    bool out_of_memory;   /* sticky: the functions below then do nothing */
} scene_builder;

void builder_free(scene_builder *builder);

/* Appends `count` zeroed items to a section and returns the first, or NULL if memory ran out. */
void *builder_append(scene_builder *builder, blob_section section, size_t count);

size_t builder_count(const scene_builder *builder, blob_section section);
void *builder_items(const scene_builder *builder, blob_section section);

/* Appends a material with glTF's defaults (white, rough, opaque, no textures). */
scene_material *builder_material(scene_builder *builder, const char *name);

/* Appends the mesh of all indices from first_index on, its bounds computed, without an instance;
 * appends nothing if there are no indices. Where meshes are centered, no other mesh may share its
 * vertices. */
void builder_mesh(scene_builder *builder, const char *name, uint32_t material, size_t first_index);

/* Appends a node below another one, or SCENE_NO_NODE, and returns its number. The instances that
 * are appended next are its own. Call builder_end_nodes after the last. Without these functions
 * every instance has a node of its own. */
uint32_t builder_node(scene_builder *builder, const char *name, uint32_t parent);
void builder_end_nodes(scene_builder *builder);

/* Appends an instance of a mesh, transformed by a matrix that fits an instance. */
bool builder_place(scene_builder *builder, size_t mesh, const double matrix[16]);

/* Appends an instance, untransformed, of every mesh from first_mesh on. */
void builder_instances(scene_builder *builder, size_t first_mesh);

/* Points *scene at the geometry in the builder; zeroes the rest. */
void builder_geometry(const scene_builder *builder, scene *scene);

/* Appends a sphere light of that power, in watts, multiplied by the color. */
void builder_sphere_light(scene_builder *builder, lmp_vec3 center, float radius, lmp_rgb color,
                          float power);

/* Notes a part of the file that is unsupported: `what` of `count` things called `noun` (in the
 * singular) or, with `what` NULL, these things altogether. */
void builder_unsupported(scene_builder *builder, const char *what, const char *noun, size_t count);

/* Notes an unsupported or missing file by its path; a long path is cut to its end, which tells
 * most. */
void builder_unsupported_file(scene_builder *builder, const char *path, const char *noun);

/* Fills in the header of the packed blob, with its content hash if `checksum`. */
void builder_header(const scene_builder *builder, bool checksum, blob_header *header);

/* Packs the builder's arrays into one block from malloc. */
bool builder_pack(const scene_builder *builder, void **block, size_t *size);

#endif
