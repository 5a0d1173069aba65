/* SPDX-License-Identifier: MIT */
/* file_cache.h - the cache of results that take long to compute. */
#ifndef LAMPION_BASE_FILE_CACHE_H
#define LAMPION_BASE_FILE_CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The cache: entries by name in $XDG_CACHE_HOME/lampion or ~/.cache/lampion. An entry may vanish or
 * be damaged at any time, and may have been written by anyone: it counts only if it is a regular
 * file of this user that has the name, version and checksum that it states itself. The size of the
 * cache is limited to LAMPION_CACHE_MIB from the environment, else to FILE_CACHE_MIB. */
#define FILE_CACHE_MIB 2048

/* Finds the directory, which is created on demand; returns false without a home directory (then go
 * on without a cache). */
bool file_cache_directory(char *path, size_t size);

/* Finds the directory of what the program remembers, $XDG_STATE_HOME/lampion or
 * ~/.local/state/lampion, in the same way. */
bool file_state_directory(char *path, size_t size);

/* Maps the bytes of an entry, from the start of a page, without a copy; returns NULL where there is
 * no valid entry. The entry counts as used now. Release the bytes with file_cache_unmap. Entries
 * are replaced or removed, never changed, so mapped bytes stay as they are. */
const void *file_cache_map(const char *name, size_t *size);
void file_cache_unmap(const void *data, size_t size);

/* Stores an entry, then removes the entries unused for longest until the limit holds; does nothing
 * where that is impossible. */
void file_cache_store(const char *name, const void *data, size_t size);

/* Stores the `size` bytes that an object is written to, as file_cache_store does. */
void file_cache_store_object(const char *name, size_t size,
                             void (*write)(const void *object, void *bytes), const void *object);

typedef struct file_cache_usage {
    size_t files;
    uint64_t bytes, limit;
} file_cache_usage;
file_cache_usage file_cache_measure(void);

/* Removes every entry of the cache; other files in the folder stay. */
void file_cache_clear(void);

#endif
