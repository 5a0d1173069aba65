/* SPDX-License-Identifier: MIT */
/* sgd_file.h - tables of SGD fits as text: a line per material, with its two names and 33
 * numbers. */
#ifndef LAMPION_SCENE_SGD_FILE_H
#define LAMPION_SCENE_SGD_FILE_H

#include "app/base/error.h"

#include <lampion/brdf.h>

/* Finds the parameters of the material of that name in a text that ends with a NUL; `subject` is
 * named in the error. */
bool sgd_file_find(const char *text, const char *name, const char *subject, lmp_sgd *sgd,
                   base_error *error);

#endif
