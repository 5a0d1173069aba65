/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* MAP_POPULATE */
#include "app/file/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

bool file_cache_directory(char *path, size_t size) {
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length;
    if (cache && cache[0] == '/')
        length = snprintf(path, size, "%s", cache);
    else if (home && home[0] == '/')
        length = snprintf(path, size, "%s/.cache", home);
    else
        return false;
    if (length < 0 || (size_t)length + sizeof "/lampion" > size)
        return false;
    mkdir(path, 0700);
    strcpy(path + length, "/lampion");
    struct stat status;
    return (mkdir(path, 0700) == 0 || errno == EEXIST) && stat(path, &status) == 0 &&
           S_ISDIR(status.st_mode) && access(path, R_OK | W_OK | X_OK) == 0;
}

bool file_cache_path(const char *name, char *path, size_t size) {
    char directory[3072];
    if (!file_cache_directory(directory, sizeof directory) ||
        snprintf(path, size, "%s/%s", directory, name) >= (int)size)
        return false;
    utimensat(AT_FDCWD, path, NULL, AT_SYMLINK_NOFOLLOW);
    return true;
}

const void *file_cache_map(const char *path, size_t *size) {
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    struct stat status;
    void *data = MAP_FAILED;
    if (fd >= 0 && fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
        *size = (size_t)status.st_size;
        data = mmap(NULL, *size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, fd, 0);
    }
    if (fd >= 0)
        close(fd);
    return data == MAP_FAILED ? NULL : data;
}

void file_cache_unmap(const void *data, size_t size) {
    if (data)
        munmap((void *)(uintptr_t)data, size);
}

/* --- what is in it -------------------------------------------------------------------------------
 */

typedef struct cached_file {
    char name[256];
    uint64_t bytes;
    struct timespec used;
} cached_file;

typedef struct cached_files {
    DIR *directory;
    cached_file *items;
    size_t count;
    uint64_t bytes;
} cached_files;

static void close_list(cached_files *list) {
    if (list->directory)
        closedir(list->directory);
    free(list->items);
    *list = (cached_files) { 0 };
}

/* Regular files alone: nothing else in there is ours. */
static bool add_file(cached_files *list, const char *name) {
    struct stat status;
    if (fstatat(dirfd(list->directory), name, &status, AT_SYMLINK_NOFOLLOW) != 0 ||
        !S_ISREG(status.st_mode) || strlen(name) >= sizeof list->items->name)
        return true;
    cached_file *const items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (!items)
        return false;
    list->items = items;
    cached_file *const item = &items[list->count++];
    *item = (cached_file) { .bytes = (uint64_t)status.st_size, .used = status.st_mtim };
    strcpy(item->name, name);
    list->bytes += item->bytes;
    return true;
}

static bool open_list(cached_files *list) {
    char path[3072];
    *list = (cached_files) { 0 };
    if (file_cache_directory(path, sizeof path))
        list->directory = opendir(path);
    bool ok = list->directory != NULL;
    for (struct dirent *entry; ok && (entry = readdir(list->directory));)
        ok = add_file(list, entry->d_name);
    if (!ok)
        close_list(list);
    return ok;
}

static int by_use(const void *a, const void *b) {
    const struct timespec x = ((const cached_file *)a)->used, y = ((const cached_file *)b)->used;
    return x.tv_sec != y.tv_sec ? (x.tv_sec > y.tv_sec) - (x.tv_sec < y.tv_sec)
                                : (x.tv_nsec > y.tv_nsec) - (x.tv_nsec < y.tv_nsec);
}

/* Removes those unused for longest until no more than `limit` bytes are left. */
static void trim(uint64_t limit) {
    cached_files list;
    if (!open_list(&list))
        return;
    if (list.count > 0)
        qsort(list.items, list.count, sizeof *list.items, by_use);
    uint64_t bytes = list.bytes;
    for (size_t i = 0; i < list.count && bytes > limit; i++)
        if (unlinkat(dirfd(list.directory), list.items[i].name, 0) == 0)
            bytes -= list.items[i].bytes;
    close_list(&list);
}

static uint64_t limit_of_cache(void) {
    const char *const text = getenv("LAMPION_CACHE_MIB");
    double mib = FILE_CACHE_MIB;
    if (text && (!cli_number(text, strlen(text), &mib) || mib < 0.0 || mib > 1e9))
        mib = FILE_CACHE_MIB;
    return (uint64_t)(mib * (1 << 20));
}

file_cache_usage file_cache_measure(void) {
    cached_files list;
    open_list(&list);
    const file_cache_usage usage = { list.count, list.bytes, limit_of_cache() };
    close_list(&list);
    return usage;
}

void file_cache_clear(void) {
    cached_files list;
    if (!open_list(&list))
        return;
    for (size_t i = 0; i < list.count; i++)
        unlinkat(dirfd(list.directory), list.items[i].name, 0);
    close_list(&list);
}

void file_cache_store(const char *path, const void *data, size_t size) {
    cli_error ignored;
    if (file_write_whole(path, data, size, &ignored))
        trim(limit_of_cache());
}

void file_cache_store_object(const char *path, size_t size,
                             void (*write)(const void *object, void *bytes), const void *object) {
    void *bytes = malloc(size);
    if (bytes) {
        write(object, bytes);
        file_cache_store(path, bytes, size);
    }
    free(bytes);
}
