/* SPDX-License-Identifier: MIT */
/* reference_part.h - the image of every N-th sample, as a file that can be joined with the
 * others. */
#ifndef LAMPION_TRUTH_REFERENCE_PART_H
#define LAMPION_TRUTH_REFERENCE_PART_H

#include "app/image/image.h"
#include "app/truth/reference.h"

#define REFERENCE_SAMPLES_MAX 1000000
#define REFERENCE_PARTS_MAX   4096

/* Writes radiance and standard error as two layers, and two more with one value in all pixels:
 * "part", its samples, I and N, and "run", three times 24 bits of a hash of the scene and of
 * `words` (of the command line, NULL-terminated) except those for the output and the part. */
bool reference_part_write(const char *path, const reference_settings *settings, const scene *world,
                          char *const *words, const image_layer layers[2], base_error *error);

/* Joins parts of one run, weighted by their samples, into the image of a single run: standard
 * errors come from those of the parts and from the differences between parts. A missing part is an
 * error, unless `partial`. Free both images. */
bool reference_parts_join(char *const *paths, int count, bool partial, image *radiance,
                          image *standard_error, base_error *error);

#endif
