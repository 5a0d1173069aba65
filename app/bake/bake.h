/* SPDX-License-Identifier: MIT */
/* bake.h - what takes long to make is made once: it is read from the cache where it was made
 * before, else made on all cores with a progress bar, then stored there. */
#ifndef LAMPION_BAKE_H
#define LAMPION_BAKE_H

#include "app/file/file.h"

#include <lampion/preintegrated.h>

/* How one kind of object is made, and its bytes; `user` is the caller's. */
typedef struct bake_recipe {
    const char *kind; /* the extension of its files in the cache */
    const char *what; /* of the progress bar */
    file_hash key;    /* of all that decides its bytes */
    /* NULL where the bytes are not those of what is asked for: it is then made. */
    void *(*read)(const void *bytes, size_t size, const void *user);
    lmp_result (*make)(const lmp_host *host, const void *user, void **object);
    size_t (*size)(const void *object);
    void (*write)(const void *object, void *bytes);
    const void *user;
} bake_recipe;

/* *object is NULL on failure. */
lmp_result bake(const bake_recipe *recipe, void **object);

/* Adds to a key how a thing is made: by the library's version, and the numbers that were asked for
 * (without padding between them). BAKE_EPOCH rises when the same ones give other bytes. */
#define BAKE_EPOCH 7
void bake_add_settings(file_hash *key, const void *settings, size_t size);

/* The program as the library's host: all cores, and a progress bar whose text is *what. */
lmp_host bake_host(const char **what);

/* Images ask more of lobes than the default: beside a highlight of ten times white, half a percent
 * of it shows. */
#define BAKE_LOBES_ERROR 0.002f

/* The preintegrated lobes of so many bands. Free with lmp_preintegrated_lobe_destroy. */
bool bake_lobes(int bands, lmp_window window, lmp_preintegrated_lobe **lobes, cli_error *error);

#endif
