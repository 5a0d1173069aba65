/* SPDX-License-Identifier: MIT */
/* material_file.h - materials from untrusted files: each is read in the sandbox first. */
#ifndef LAMPION_SCENE_MATERIAL_FILE_H
#define LAMPION_SCENE_MATERIAL_FILE_H

#include "app/base/error.h"
#include "app/base/file_hash.h"

#include <lampion/brdf.h>

/* A material from a file; either brdf or table is not NULL. */
typedef struct material_file {
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    size_t size;
    file_hash hash; /* of the file's bytes */
} material_file;

/* Reads a .lmpt, MERL or RGL file. The program reads it only after a child process has succeeded:
 * what would crash a reader or exhaust memory ends there. */
bool material_read_file(const char *path, material_file *file, base_error *error);

/* Reads the parameters of a name in a table of SGD fits; the child parses the text and returns only
 * these numbers. */
bool material_read_sgd(const char *path, const char *name, lmp_sgd *sgd, base_error *error);

#endif
