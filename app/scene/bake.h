/* SPDX-License-Identifier: MIT */
/* bake.h - objects that take long to compute are computed once: read from the cache if they are
 * there, else computed on all cores with a progress bar, then stored in the cache. */
#ifndef LAMPION_SCENE_BAKE_H
#define LAMPION_SCENE_BAKE_H

#include "app/base/error.h"
#include "app/base/file_hash.h"

#include <lampion/preintegrated.h>

/* How one kind of object is computed, written to bytes and read back; `user` is the caller's. */
typedef struct bake_recipe {
    const char *kind; /* the extension of its files in the cache */
    const char *what; /* text of the progress bar */
    file_hash key;    /* of all that determines the bytes */
    /* Reads an object; returns NULL where the bytes are not those of the wanted one, which is then
     * computed. */
    void *(*read)(const void *bytes, size_t size, const void *user);
    lmp_result (*make)(const lmp_host *host, const void *user, void **object);
    size_t (*size)(const void *object);
    void (*write)(const void *object, void *bytes);
    const void *user;
} bake_recipe;

/* Reads or computes an object; *object is NULL on failure. */
lmp_result bake(const bake_recipe *recipe, void **object);

/* Adds to a key what determines an object: the library's version and the parameters asked for
 * (without padding between them). BAKE_EPOCH rises when the same parameters give other bytes. */
#define BAKE_EPOCH 9
void bake_add_settings(file_hash *key, const void *settings, size_t size);

/* Returns the program's host for the library: all cores, and a progress bar with the text *what. */
lmp_host bake_host(const char **what);

/* The error of lobes for images, less than the default: beside a highlight of ten times white, half
 * a percent of it shows. */
#define BAKE_LOBES_ERROR 0.002f

/* Makes the preintegrated lobes of so many bands. Free with lmp_preintegrated_lobe_destroy. */
bool bake_lobes(int bands, lmp_window window, lmp_preintegrated_lobe **lobes, base_error *error);

#endif
