/* SPDX-License-Identifier: MIT */
#include "app/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail_too_large(const char *path, size_t limit, base_error *error) {
    return base_fail(error, path, "is too large (limit: %zu MiB)", limit >> 20);
}

/* Reads to the end of fd; `expected` is a guess of the size. */
static bool read_all(int fd, const char *path, size_t expected, size_t limit, void **data,
                     size_t *size, base_error *error) {
    size_t capacity = expected + 1, used = 0;
    char *bytes = malloc(capacity + 1);
    while (bytes) {
        const ssize_t got = read(fd, bytes + used, capacity - used);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0) {
            free(bytes);
            return base_fail(error, path, "cannot be read: %s", strerror(errno));
        }
        if (got == 0) {
            bytes[used] = 0;
            *data = bytes;
            *size = used;
            return true;
        }
        used += (size_t)got;
        if (used > limit) {
            free(bytes);
            return fail_too_large(path, limit, error);
        }
        if (used == capacity) {
            capacity *= 2;
            char *larger = realloc(bytes, capacity + 1);
            if (!larger)
                free(bytes);
            bytes = larger;
        }
    }
    return base_fail(error, path, "is too large for the memory of this machine");
}

static bool is_standard_input(const struct stat *file) {
    struct stat input;
    return fstat(STDIN_FILENO, &input) == 0 && input.st_dev == file->st_dev &&
           input.st_ino == file->st_ino;
}

/* Opens without blocking, so that a FIFO opened by mistake does not wait for a writer. */
int file_open_descriptor(const char *path, base_error *error) {
    struct stat status = { 0 };
    const int fd = file_open_confined(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const bool regular = fd >= 0 && fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
    if (regular && !is_standard_input(&status))
        return fd;
    if (fd < 0 && errno == ENOENT)
        base_fail(error, path, "does not exist");
    else if (fd < 0 && errno == EXDEV)
        base_fail(error, path, FILE_LEADS_OUT);
    else if (fd < 0)
        base_fail(error, path, "cannot be opened: %s", strerror(errno));
    else if (regular)
        base_fail(error, path, "is standard input, which is read by the name - alone");
    else if (S_ISDIR(status.st_mode))
        base_fail(error, path, "is a directory, not a file");
    else
        base_fail(error, path, "is not a regular file");
    if (fd >= 0)
        close(fd);
    return -1;
}

FILE *file_open(const char *path, base_error *error) {
    const int fd = file_open_descriptor(path, error);
    FILE *stream = fd < 0 ? NULL : fdopen(fd, "rb");
    if (fd >= 0 && !stream) {
        close(fd);
        base_fail(error, path, "cannot be opened: %s", strerror(errno));
    }
    return stream;
}

bool file_read_descriptor(int fd, const char *path, size_t limit, void **data, size_t *size,
                          base_error *error) {
    const off_t end = lseek(fd, 0, SEEK_END);
    if (end > 0 && (uint64_t)end > limit)
        return fail_too_large(path, limit, error);
    lseek(fd, 0, SEEK_SET);
    return read_all(fd, path, end > 0 ? (size_t)end : 0, limit, data, size, error);
}

const char *file_base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool file_is_standard_input(const char *name) {
    for (const char *part = name; part; part = strchr(part, ':')) {
        part += *part == ':';
        if (part[0] == '-' && (part[1] == ':' || part[1] == '\0'))
            return true;
    }
    return false;
}

bool file_read(const char *path, size_t limit, void **data, size_t *size, base_error *error) {
    *data = NULL;
    *size = 0;
    if (strcmp(path, "-") == 0)
        return read_all(STDIN_FILENO, "standard input", 65536, limit, data, size, error);
    const int fd = file_open_descriptor(path, error);
    const bool ok = fd >= 0 && file_read_descriptor(fd, path, limit, data, size, error);
    if (fd >= 0)
        close(fd);
    return ok;
}
