/* SPDX-License-Identifier: MIT */
/* part.h - an image of every N-th sample, as a file that can be joined with the others. */
#ifndef LAMPION_REFERENCE_PART_H
#define LAMPION_REFERENCE_PART_H

#include "app/image/image.h"
#include "app/reference/reference.h"

#define REFERENCE_SAMPLES_MAX 1000000
#define REFERENCE_PARTS_MAX   4096

/* Writes radiance and standard error, two layers, and two more, of one value in all pixels:
 * "part", its samples, I and N, and "run", three times 24 bits of a hash of the scene and of
 * `words` (of the command line, NULL-terminated) but those that say where it goes and which part it
 * is. */
bool reference_part_write(const char *path, const reference_settings *settings, const scene *world,
                          char *const *words, const image_layer layers[2], cli_error *error);

/* Joins parts of one run, weighted by their samples, as it would have been at once: standard errors
 * come from the parts' own and from how far the parts are from each other. A part that is missing
 * is an error, unless `partial`. Free both images. */
bool reference_parts_join(char *const *paths, int count, bool partial, image *radiance,
                          image *standard_error, cli_error *error);

#endif
