/* SPDX-License-Identifier: MIT */
/* shared_library.h - libraries that few commands need, opened when one does: to load them takes
 * longer than most commands. */
#ifndef LAMPION_BASE_SHARED_LIBRARY_H
#define LAMPION_BASE_SHARED_LIBRARY_H

#include "app/base/error.h"

/* For a list of functions X(…) X(…), declares a pointer to each, and makes its name. */
#define SHARED_LIBRARY_POINTER(function) __typeof__(function) *function;
#define SHARED_LIBRARY_NAME(function)    #function,

/* Opens a library, for as long as the process lives, and stores the addresses of `count` functions
 * of it, or of libraries that it needs itself, in a struct of as many pointers. Does nothing if the
 * first one is there already. Returns false if the library is not installed or lacks one. */
bool shared_library_open(const char *name, const char *const *functions, size_t count,
                         void *pointers, base_error *error);

#endif
