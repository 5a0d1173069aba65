/* SPDX-License-Identifier: MIT */
#include "app/base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

/* WebAssembly has no pages. */
#if defined MADV_HUGEPAGE && !defined __EMSCRIPTEN__
#define HAS_HUGE_PAGES 1
/* The size of a huge page on most systems, and the fewest pages for which rounding up pays off. */
static const size_t page = (size_t)1 << 21, least_pages = 4;
#else
#define HAS_HUGE_PAGES 0
#endif

void *memory_large(size_t size) {
#if HAS_HUGE_PAGES
    void *memory = NULL;
    if (size >= least_pages * page && size <= (size_t)-1 - page) {
        const size_t rounded = (size + page - 1) / page * page;
        if (posix_memalign(&memory, page, rounded) != 0)
            return NULL;
        madvise(memory, rounded, MADV_HUGEPAGE); /* only a hint: without it, pages stay small */
        return memory;
    }
#endif
    return malloc(size > 0 ? size : 1);
}

void *memory_large_resize(void *memory, size_t size) {
    void *const resized = realloc(memory, size);
#if HAS_HUGE_PAGES
    if (resized && size >= least_pages * page) {
        /* All of the mapping that such a block is: a hint for a part of it would split it, and it
         * could not grow where it is. */
        const uintptr_t small = (uintptr_t)sysconf(_SC_PAGESIZE), at = (uintptr_t)resized;
        const uintptr_t start = at / small * small, end = (at + size + small - 1) / small * small;
        madvise((void *)start, end - start, MADV_HUGEPAGE);
    }
#endif
    return resized;
}
