/* SPDX-License-Identifier: MIT */
#include "src/base/allocator.h"

#include <assert.h>
#include <stdlib.h>

static void *default_allocate(size_t size, void *user) {
    (void)user;
    return malloc(size);
}

static void default_release(void *memory, void *user) {
    (void)user;
    free(memory);
}

lmp_allocator lmp_allocator_resolve(const lmp_allocator *allocator) {
    if (allocator && allocator->allocate) {
        assert(allocator->release);
        return *allocator;
    }
    return (lmp_allocator) { default_allocate, default_release, NULL };
}

void *lmp_allocate(const lmp_allocator *resolved, size_t size) {
    return resolved->allocate(size, resolved->user);
}

void lmp_release(const lmp_allocator *resolved, void *memory) {
    resolved->release(memory, resolved->user);
}
