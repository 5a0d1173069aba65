/* SPDX-License-Identifier: MIT */
/* mtl.h - the materials of an OBJ's MTL files, as metallic-roughness. */
#ifndef LAMPION_SCENE_LOAD_MTL_H
#define LAMPION_SCENE_LOAD_MTL_H

#include "app/scene/texture_file.h"

typedef struct mtl_name {
    char *name; /* owned */
    uint32_t material;
} mtl_name;

typedef struct mtl_names {
    mtl_name *items;
    size_t count, capacity;
} mtl_names;

/* Appends the materials of a file with their textures, and their names to `names`. */
bool mtl_add(const char *text, size_t size, texture_files *files, mtl_names *names,
             base_error *error);

/* Sorts the names for mtl_find. */
void mtl_sort(mtl_names *names);

/* Returns the first material of that name, or NULL. */
const mtl_name *mtl_find(const mtl_names *names, const char *name);

void mtl_names_free(mtl_names *names);

#endif
