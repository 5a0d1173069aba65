/* SPDX-License-Identifier: MIT */
/* allocator.h - the allocator of an object: the caller's hooks, or malloc and free. */
#ifndef LAMPION_BASE_ALLOCATOR_H
#define LAMPION_BASE_ALLOCATOR_H

#include <lampion/base.h>

/* The caller's allocator, or the default if it is NULL or sets no hooks. */
lmp_allocator lmp_allocator_resolve(const lmp_allocator *allocator);

void *lmp_allocate(const lmp_allocator *resolved, size_t size);
void lmp_release(const lmp_allocator *resolved, void *memory);

#endif
