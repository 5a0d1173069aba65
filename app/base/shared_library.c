/* SPDX-License-Identifier: MIT */
#include "app/base/shared_library.h"

#include <dlfcn.h>

bool shared_library_open(const char *name, const char *const *functions, size_t count,
                         void *pointers, base_error *error) {
    void **const to = pointers;
    if (to[0])
        return true;
    void *const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return base_fail(error, NULL, "the library %s is missing: %s", name, dlerror());
    /* The first one comes last, because it says that the others are there. */
    for (size_t i = count; i-- > 0;) {
        to[i] = dlsym(library, functions[i]);
        if (!to[i])
            return base_fail(error, NULL, "the library %s has no %s", name, functions[i]);
    }
    return true;
}
