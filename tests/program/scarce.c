/* SPDX-License-Identifier: MIT */
/* An allocator to load before the C library's (LD_PRELOAD): it refuses request number
 * LAMPION_REFUSE of those made by the program itself, or by the library whose name contains
 * LAMPION_REFUSE_TO, or the first request made at LAMPION_REFUSE_AT. With LAMPION_REQUESTS it
 * writes their number to that file at the end, followed by the addresses of the calls. All other
 * requests are granted. */
#define _GNU_SOURCE /* dl_iterate_phdr */
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static uintptr_t code_start, code_end;
static long refused;
static uintptr_t refused_at; /* as an offset from the start of the code */

/* Calls of the program and of its children. */
enum { CALLS = 4096 };
static struct {
    atomic_long requests;
    atomic_uintptr_t calls[CALLS]; /* a hash table; 0 marks a free slot */
} * shared;

/* The first object listed is the program. */
static int find_code(struct dl_phdr_info *info, size_t size, void *library) {
    (void)size;
    if (library && !strstr(info->dlpi_name, library))
        return 0;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X)) {
            code_start = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            code_end = code_start + info->dlpi_phdr[i].p_memsz;
        }
    return 1;
}

__attribute__((constructor)) static void begin(void) {
    const char *const number = getenv("LAMPION_REFUSE");
    refused = number ? atol(number) : 0;
    const char *const call = getenv("LAMPION_REFUSE_AT");
    refused_at = call ? strtoul(call, NULL, 16) : 0;
    void *const memory =
        mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED)
        shared = memory;
    dl_iterate_phdr(find_code, getenv("LAMPION_REFUSE_TO"));
}

__attribute__((destructor)) static void end(void) {
    const char *const path = getenv("LAMPION_REQUESTS");
    FILE *const file = path ? fopen(path, "w") : NULL;
    if (file) {
        fprintf(file, "%ld\n", shared ? atomic_load(&shared->requests) : 0);
        for (int i = 0; shared && i < CALLS; i++)
            if (atomic_load(&shared->calls[i]))
                fprintf(file, "%lx\n", (unsigned long)atomic_load(&shared->calls[i]));
        fclose(file);
    }
}

static int is_new_call(uintptr_t call) {
    for (uintptr_t i = 0; i < CALLS; i++) {
        uintptr_t there = 0;
        if (atomic_compare_exchange_strong(&shared->calls[(call + i) % CALLS], &there, call))
            return 1;
        if (there == call)
            return 0;
    }
    return 0;
}

static int refuses(const void *caller) {
    const uintptr_t address = (uintptr_t)caller;
    if (!shared || address < code_start || address >= code_end)
        return 0;
    const int number_is_it = atomic_fetch_add(&shared->requests, 1) + 1 == refused;
    const int call_is_it = is_new_call(address - code_start) && address - code_start == refused_at;
    if (!number_is_it && !call_is_it)
        return 0;
    errno = ENOMEM;
    return 1;
}

#define FROM_CALLER(call) (refuses(__builtin_return_address(0)) ? NULL : (call))

void *malloc(size_t size) {
    return FROM_CALLER(__libc_malloc(size));
}

void *calloc(size_t count, size_t size) {
    return FROM_CALLER(__libc_calloc(count, size));
}

void *realloc(void *memory, size_t size) {
    return FROM_CALLER(__libc_realloc(memory, size));
}

void *aligned_alloc(size_t alignment, size_t size) {
    return FROM_CALLER(__libc_memalign(alignment, size));
}

int posix_memalign(void **memory, size_t alignment, size_t size) {
    *memory = FROM_CALLER(__libc_memalign(alignment, size));
    return *memory ? 0 : ENOMEM;
}
