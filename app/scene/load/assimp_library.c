/* SPDX-License-Identifier: MIT */
#include "app/scene/load/assimp_library.h"

#include "app/scene/scene.h"

#include <stdio.h>

assimp_functions assimp;

bool assimp_open(base_error *error) {
    static const char *const names[] = { ASSIMP_FUNCTIONS(SHARED_LIBRARY_NAME) };
    return shared_library_open(ASSIMP_SONAME, names, sizeof names / sizeof *names, &assimp, error);
}

bool scene_assimp_version(char *text, size_t size, base_error *error) {
    if (!assimp_open(error))
        return false;
    snprintf(text, size, "%u.%u.%u", assimp.aiGetVersionMajor(), assimp.aiGetVersionMinor(),
             assimp.aiGetVersionPatch());
    return true;
}

bool assimp_knows(const char *ending) {
    return assimp.aiIsExtensionSupported(ending) == AI_TRUE;
}
