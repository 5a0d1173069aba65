/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* MAP_POPULATE */
#include "app/base/file_cache.h"
#include "app/base/file_hash.h"
#include "app/base/file_writer.h"
#include "app/base/number.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#define CACHE_MAGIC "LAMPCCH"
enum { CACHE_VERSION = 1, NAME_MAX_LENGTH = 63 };

/* The trailer of an entry, which follows its bytes. */
typedef struct trailer {
    char magic[8];
    uint32_t version, reserved;
    uint64_t size; /* of the bytes */
    char name[NAME_MAX_LENGTH + 1];
    file_hash checksum; /* of the bytes and of the fields above */
} trailer;

static trailer trailer_of(const char *name, const void *data, size_t size) {
    trailer t = { .magic = CACHE_MAGIC, .version = CACHE_VERSION, .size = size };
    memcpy(t.name, name, strnlen(name, NAME_MAX_LENGTH));
    file_hash_add(&t.checksum, data, size);
    const trailer above = t;
    file_hash_add(&t.checksum, &above, offsetof(trailer, checksum));
    return t;
}

/* --- entries ---------------------------------------------------------------------------------- */

/* Whether path is a directory of this user. A link is not one: it leads to what was not made for
 * the cache. */
static bool is_own_directory(const char *path) {
    struct stat status;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
           access(path, R_OK | X_OK) == 0;
}

/* Finds the program's directory within the one that the environment names, or else in the home
 * directory, and makes it. */
static bool find_directory(const char *variable, const char *in_home, char *path, size_t size) {
    const char *given = getenv(variable), *home = getenv("HOME");
    const bool chosen = given && given[0] == '/';
    if (!chosen && (!home || home[0] != '/'))
        return false;
    const int length = snprintf(path, size, "%s%s", chosen ? given : home, chosen ? "" : in_home);
    if (length < 0 || (size_t)length + sizeof "/lampion" > size)
        return false;
    strcpy(path + length, "/lampion");
    char *slash = path + (chosen ? (size_t)length : strlen(home) + 1);
    for (; (slash = strchr(slash, '/')); *slash++ = '/') {
        *slash = '\0';
        mkdir(path, 0700);
    }
    mkdir(path, 0700);
    return is_own_directory(path);
}

bool file_cache_directory(char *path, size_t size) {
    return find_directory("XDG_CACHE_HOME", "/.cache", path, size);
}

bool file_state_directory(char *path, size_t size) {
    return find_directory("XDG_STATE_HOME", "/.local/state", path, size);
}

static int open_directory(void) {
    char path[3072];
    return file_cache_directory(path, sizeof path)
               ? open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW)
               : -1;
}

static bool path_of(const char *name, char *path, size_t size) {
    char directory[3072];
    return strlen(name) <= NAME_MAX_LENGTH && file_cache_directory(directory, sizeof directory) &&
           snprintf(path, size, "%s/%s", directory, name) < (int)size;
}

/* Opens a regular file of this user whose trailer is that of an entry of this name, of any version;
 * returns -1 for any other file, which may belong to something else. */
static int open_entry(int directory, const char *name, trailer *end, struct stat *status) {
    const int fd = openat(directory, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (fd >= 0 && fstat(fd, status) == 0 && S_ISREG(status->st_mode) &&
        status->st_uid == geteuid() && status->st_size > (off_t)sizeof *end &&
        pread(fd, end, sizeof *end, status->st_size - (off_t)sizeof *end) == sizeof *end &&
        memcmp(end->magic, CACHE_MAGIC, sizeof end->magic) == 0 &&
        strncmp(end->name, name, sizeof end->name) == 0)
        return fd;
    if (fd >= 0)
        close(fd);
    return -1;
}

/* Maps an open entry of `size` bytes; returns NULL if the bytes do not match the trailer. */
static const void *map_entry(int fd, const char *name, const trailer *end, size_t size) {
    void *const data = mmap(NULL, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, fd, 0);
    if (data == MAP_FAILED)
        return NULL;
    const trailer expected = trailer_of(name, data, size);
    if (memcmp(end, &expected, sizeof expected) == 0)
        return data;
    munmap(data, size);
    return NULL;
}

const void *file_cache_map(const char *name, size_t *size) {
    struct stat status;
    trailer end;
    const int directory = open_directory();
    const int fd = directory < 0 ? -1 : open_entry(directory, name, &end, &status);
    if (directory >= 0)
        close(directory);
    if (fd < 0)
        return NULL;
    *size = (size_t)status.st_size - sizeof end;
    const void *const data = map_entry(fd, name, &end, *size);
    if (data)
        futimens(fd, NULL);
    close(fd);
    return data;
}

void file_cache_unmap(const void *data, size_t size) {
    if (data)
        munmap((void *)(uintptr_t)data, size);
}

/* --- what is in it ---------------------------------------------------------------------------- */

typedef struct cached_file {
    char name[NAME_MAX_LENGTH + 1];
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

/* Adds a file to the list if it is an entry: no other file in the folder is ours. */
static bool add_file(cached_files *list, const char *name) {
    struct stat status;
    trailer end;
    const int fd = strlen(name) < sizeof list->items->name
                       ? open_entry(dirfd(list->directory), name, &end, &status)
                       : -1;
    if (fd < 0)
        return true;
    close(fd);
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
    const int directory = open_directory();
    *list = (cached_files) { 0 };
    list->directory = directory < 0 ? NULL : fdopendir(directory);
    if (directory >= 0 && !list->directory)
        close(directory);
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

/* Removes the entries unused for longest until no more than `limit` bytes are left. */
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
    if (text && (!number_read(text, strlen(text), &mib) || mib < 0.0 || mib > 1e9))
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

void file_cache_store(const char *name, const void *data, size_t size) {
    char path[4096];
    base_error ignored;
    file_writer writer;
    const trailer end = trailer_of(name, data, size);
    if (!path_of(name, path, sizeof path) || !file_write_begin(&writer, path, &ignored))
        return;
    fwrite(data, 1, size, writer.stream);
    fwrite(&end, 1, sizeof end, writer.stream);
    if (file_write_commit(&writer, &ignored))
        trim(limit_of_cache());
}

void file_cache_store_object(const char *name, size_t size,
                             void (*write)(const void *object, void *bytes), const void *object) {
    void *bytes = malloc(size);
    if (bytes) {
        write(object, bytes);
        file_cache_store(name, bytes, size);
    }
    free(bytes);
}
