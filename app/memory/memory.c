/* SPDX-License-Identifier: MIT */
#include "app/memory/memory.h"

#include <stdlib.h>
#include <sys/mman.h>

/* The size of large pages almost everywhere, and how many of them are worth rounding up to. */
static const size_t page = (size_t)1 << 21, least_pages = 4;

void *memory_large(size_t size) {
#ifdef MADV_HUGEPAGE
    void *memory = NULL;
    if (size >= least_pages * page && size <= (size_t)-1 - page) {
        const size_t rounded = (size + page - 1) / page * page;
        if (posix_memalign(&memory, page, rounded) != 0)
            return NULL;
        madvise(memory, rounded, MADV_HUGEPAGE); /* a wish: without it pages are small */
        return memory;
    }
#endif
    return malloc(size > 0 ? size : 1);
}
