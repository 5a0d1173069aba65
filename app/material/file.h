/* SPDX-License-Identifier: MIT */
/* file.h - materials from files that others made: each is tried in the sandbox first. */
#ifndef LAMPION_MATERIAL_FILE_H
#define LAMPION_MATERIAL_FILE_H

#include "app/file/file.h"

#include <lampion/brdf.h>

/* One of brdf and table is there. */
typedef struct material_file {
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    size_t size;
    file_hash hash; /* of its bytes */
} material_file;

/* Reads a .lmpt, MERL or RGL file. The program reads it only after a child could: what would crash
 * a reader, or use up memory, ends there. */
bool material_read_file(const char *path, material_file *file, cli_error *error);

/* The parameters of a name in a table of SGD fits: the child reads the text, these numbers are all
 * that comes of it. */
bool material_read_sgd(const char *path, const char *name, lmp_sgd *sgd, cli_error *error);

#endif
