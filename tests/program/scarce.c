/* SPDX-License-Identifier: MIT */
/* An allocator to load before the C library's (LD_PRELOAD): request number LAMPION_REFUSE of those
 * that the program itself makes is refused, and with LAMPION_REQUESTS their number is written to
 * that file at the end. Libraries have all they want: what they do without it is not for us to
 * mend. */
#define _GNU_SOURCE /* dl_iterate_phdr */
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static uintptr_t program_start, program_end;
static long refused;
static atomic_long *requests; /* of the program and of its children */

static int find_program(struct dl_phdr_info *info, size_t size, void *user) {
    (void)size;
    (void)user;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD && (info->dlpi_phdr[i].p_flags & PF_X)) {
            program_start = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            program_end = program_start + info->dlpi_phdr[i].p_memsz;
        }
    return 1; /* the first is the program */
}

__attribute__((constructor)) static void begin(void) {
    const char *const number = getenv("LAMPION_REFUSE");
    refused = number ? atol(number) : 0;
    void *const shared =
        mmap(NULL, sizeof *requests, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared != MAP_FAILED)
        requests = shared;
    dl_iterate_phdr(find_program, NULL);
}

__attribute__((destructor)) static void end(void) {
    const char *const path = getenv("LAMPION_REQUESTS");
    FILE *const file = path ? fopen(path, "w") : NULL;
    if (file) {
        fprintf(file, "%ld\n", requests ? atomic_load(requests) : 0);
        fclose(file);
    }
}

static int refuses(const void *caller) {
    const uintptr_t address = (uintptr_t)caller;
    if (!requests || address < program_start || address >= program_end ||
        atomic_fetch_add(requests, 1) + 1 != refused)
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
