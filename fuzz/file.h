/* SPDX-License-Identifier: MIT */
/* file.h - for readers that take a path: writes the input to a file in memory. */
#ifndef LAMPION_FUZZ_FILE_H
#define LAMPION_FUZZ_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Writes the input to a file of this process with that extension; path receives its name. */
static inline bool fuzz_file_write(const uint8_t *data, size_t size, const char *ending,
                                   char path[64]) {
    snprintf(path, 64, "/dev/shm/lampion-fuzz-%ld%s", (long)getpid(), ending);
    FILE *stream = fopen(path, "wb");
    if (!stream)
        return false;
    const bool whole = fwrite(data, 1, size, stream) == size;
    return fclose(stream) == 0 && whole;
}

#endif
