/* SPDX-License-Identifier: MIT */
/* assimp_library.h - what is used of Assimp, which only formats without a reader of our own open.
 */
#ifndef LAMPION_SCENE_LOAD_ASSIMP_LIBRARY_H
#define LAMPION_SCENE_LOAD_ASSIMP_LIBRARY_H

#include "app/base/shared_library.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/version.h>

/* clang-format off */
#define ASSIMP_FUNCTIONS(X)                                                                        \
    X(aiCreatePropertyStore) X(aiGetErrorString) X(aiGetMaterialColor) X(aiGetMaterialFloatArray)  \
    X(aiGetMaterialIntegerArray) X(aiGetMaterialProperty) X(aiGetVersionMajor)                     \
    X(aiGetVersionMinor) X(aiGetVersionPatch) X(aiImportFileExWithProperties)                      \
    X(aiIsExtensionSupported) X(aiReleaseImport) X(aiReleasePropertyStore)                         \
    X(aiSetImportPropertyInteger)
/* clang-format on */

typedef struct assimp_functions {
    ASSIMP_FUNCTIONS(SHARED_LIBRARY_POINTER)
} assimp_functions;

/* The functions, once assimp_open returned true. */
extern assimp_functions assimp;

/* Opens Assimp, before a child loses the right to; returns false if it is not installed. */
bool assimp_open(base_error *error);

/* Whether Assimp, which is open, reads files with this extension, as ".stl". */
bool assimp_knows(const char *ending);

#endif
