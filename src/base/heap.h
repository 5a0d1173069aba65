/* SPDX-License-Identifier: MIT */
/* heap.h - the allocator of an object: the caller's hooks, or malloc and free. */
#ifndef LAMPION_BASE_HEAP_H
#define LAMPION_BASE_HEAP_H

#include <lampion/base.h>

/* The caller's allocator, or the default if it is NULL or sets no hooks. */
lmp_allocator lmp_heap_resolve(const lmp_allocator *allocator);

void *lmp_heap_allocate(const lmp_allocator *resolved, size_t size);
void lmp_heap_release(const lmp_allocator *resolved, void *memory);

#endif
