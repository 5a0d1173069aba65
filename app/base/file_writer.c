/* SPDX-License-Identifier: MIT */

#include "app/base/file_writer.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* Temporary files to remove when the program is interrupted; the signal handler only reads the
 * list. */
#define PENDING_MAX 8
#define PATH_SIZE   sizeof((file_writer *)0)->path
static char pending_path[PENDING_MAX][PATH_SIZE];
static volatile sig_atomic_t pending_used[PENDING_MAX];

/* Of what is static here, and of the process's umask: the viewer writes files on two threads. */
static pthread_mutex_t shared = PTHREAD_MUTEX_INITIALIZER;

void file_remove_temporaries(void) {
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending_used[i])
            unlink(pending_path[i]);
}

static const int interrupts[] = { SIGINT, SIGTERM, SIGHUP };

/* Removes pending temporaries from a signal handler, always in the main thread: it writes most
 * files, so it makes none meanwhile. What another thread makes then, a later run removes. */
static void remove_pending(int number) {
    if (gettid() != getpid()) {
        tgkill(getpid(), getpid(), number);
        return;
    }
    file_remove_temporaries();
    signal(number, SIG_DFL);
    raise(number);
}

static void catch_interrupts(void) {
    static bool done;
    for (size_t i = 0; !done && i < sizeof interrupts / sizeof *interrupts; i++) {
        struct sigaction old;
        if (sigaction(interrupts[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL)
            signal(interrupts[i], remove_pending);
    }
    done = true;
}

/* Makes a temporary file and remembers it, with signals blocked, so that no interrupt comes between
 * the two. */
static int make_temporary(char *name) {
    sigset_t held, before;
    sigemptyset(&held);
    for (size_t i = 0; i < sizeof interrupts / sizeof *interrupts; i++)
        sigaddset(&held, interrupts[i]);
    catch_interrupts();
    pthread_sigmask(SIG_BLOCK, &held, &before);
    const int descriptor = mkostemp(name, O_CLOEXEC);
    const int reason = errno;
    for (int i = 0; descriptor >= 0 && i < PENDING_MAX; i++)
        if (!pending_used[i]) {
            strcpy(pending_path[i], name);
            pending_used[i] = 1;
            break;
        }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = reason;
    return descriptor;
}

static void forget(const char *temporary) {
    pthread_mutex_lock(&shared);
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending_used[i] && strcmp(pending_path[i], temporary) == 0)
            pending_used[i] = 0;
    pthread_mutex_unlock(&shared);
}

/* --- what killed runs left -------------------------------------------------------------------- */

#define TEMPORARY_FORMAT ".lampion-%ld-XXXXXX"

/* Returns the process that made a temporary of this name, or 0 if the name is not that of a
 * temporary. */
static pid_t maker_of(const char *name) {
    static const char prefix[] = ".lampion-";
    const size_t length = strlen(prefix);
    char *end;
    if (strncmp(name, prefix, length) != 0 || name[length] < '1' || name[length] > '9')
        return 0;
    const long process = strtol(name + length, &end, 10);
    return *end == '-' && strlen(end) == strlen("-XXXXXX") && process <= INT_MAX ? (pid_t)process
                                                                                 : 0;
}

/* Whether a process has ended or is a zombie, which writes nothing more. */
static bool is_gone(pid_t process) {
    char path[40], state = 0;
    if (kill(process, 0) != 0)
        return errno == ESRCH;
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *const file = fopen(path, "re");
    if (!file)
        return false;
    const bool told = fscanf(file, "%*d (%*[^)]) %c", &state) == 1;
    fclose(file);
    return told && state == 'Z';
}

/* Whether a temporary was abandoned. A process of another machine or container is not visible here,
 * but its lock is. */
static bool is_stale(int folder, const char *name) {
    struct stat status;
    const pid_t maker = maker_of(name);
    if (maker == 0 || !is_gone(maker))
        return false;
    const int fd = openat(folder, name, O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    const bool stale = fd >= 0 && fstat(fd, &status) == 0 && S_ISREG(status.st_mode) &&
                       status.st_uid == geteuid() && flock(fd, LOCK_EX | LOCK_NB) == 0;
    if (fd >= 0)
        close(fd);
    return stale;
}

/* Removes abandoned temporaries from a folder, once per folder rather than before each image of a
 * sequence. */
static void sweep(const char *folder) {
    static char swept[PATH_SIZE];
    if (strcmp(swept, folder) == 0)
        return;
    strcpy(swept, folder);
    DIR *const directory = opendir(folder);
    if (!directory)
        return;
    for (const struct dirent *entry; (entry = readdir(directory));)
        if (is_stale(dirfd(directory), entry->d_name))
            unlinkat(dirfd(directory), entry->d_name, 0);
    closedir(directory);
}

/* --- the stream: like that of a file, but it keeps the reason of a failure
 * ----------------------- */

static ssize_t write_bytes(void *cookie, const char *bytes, size_t size) {
    file_writer *const writer = cookie;
    size_t done = 0;
    while (done < size && !writer->reason) {
        const ssize_t written = write(writer->descriptor, bytes + done, size - done);
        if (written >= 0)
            done += (size_t)written;
        else if (errno != EINTR)
            writer->reason = errno;
    }
    return writer->reason ? 0 : (ssize_t)size;
}

static int seek_to(void *cookie, off64_t *offset, int whence) {
    const file_writer *const writer = cookie;
    *offset = lseek(writer->descriptor, *offset, whence);
    return *offset < 0 ? -1 : 0;
}

static int close_descriptor(void *cookie) {
    file_writer *const writer = cookie;
    const int status = close(writer->descriptor);
    if (status != 0 && !writer->reason)
        writer->reason = errno;
    return status;
}

/* --- writing ---------------------------------------------------------------------------------- */

/* Names the temporary: the folder of path, then a name that tells the process. */
static bool name_temporary(file_writer *writer, const char *path) {
    const char *const slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0;
    if (strlen(path) >= sizeof writer->path ||
        snprintf(writer->temporary, sizeof writer->temporary, "%.*s" TEMPORARY_FORMAT, folder, path,
                 (long)getpid()) >= (int)sizeof writer->temporary)
        return false;
    strcpy(writer->path, path);
    char name[PATH_SIZE];
    snprintf(name, sizeof name, "%.*s", folder ? folder : 2, folder ? path : "./");
    sweep(name);
    return true;
}

/* Opens a descriptor for a stream that the writer keeps. */
static bool open_temporary(file_writer *writer) {
    const cookie_io_functions_t functions = { .write = write_bytes,
                                              .seek = seek_to,
                                              .close = close_descriptor };
    writer->descriptor = make_temporary(writer->temporary);
    if (writer->descriptor < 0) {
        writer->temporary[0] = 0;
        return false;
    }
    flock(writer->descriptor, LOCK_EX | LOCK_NB);
    writer->stream = fopencookie(writer, "wb", functions);
    if (!writer->stream)
        close(writer->descriptor);
    return writer->stream != NULL;
}

bool file_write_begin(file_writer *writer, const char *path, base_error *error) {
    *writer = (file_writer) { 0 };
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode))
        return base_fail(error, path, "is a directory, not a file");
    if (exists && !S_ISREG(status.st_mode))
        return base_fail(error, path, "is not a regular file");
    pthread_mutex_lock(&shared);
    const bool named = name_temporary(writer, path);
    const bool opened = named && open_temporary(writer);
    writer->reason = opened ? 0 : errno;
    /* mkostemp makes the file private: give it the mode of any new file. */
    const mode_t mask = umask(0);
    umask(mask);
    pthread_mutex_unlock(&shared);
    if (!named)
        return base_fail(error, path, "is too long a name");
    if (!opened)
        return file_write_fail(writer, NULL, error);
    fchmod(writer->descriptor, exists ? status.st_mode & 0777 : 0666 & ~mask);
    return true;
}

bool file_write_fail(file_writer *writer, const char *what, base_error *error) {
    file_write_abort(writer);
    return base_fail(error, writer->path, "cannot be written: %s",
                     writer->reason ? strerror(writer->reason)
                     : what         ? what
                                    : strerror(EIO));
}

bool file_write_commit(file_writer *writer, base_error *error) {
    /* The lock is held until the file has its name: a locked file is not swept. */
    const int lock = fcntl(writer->descriptor, F_DUPFD_CLOEXEC, 0);
    bool ok = !ferror(writer->stream);
    ok = fclose(writer->stream) == 0 && ok && !writer->reason;
    writer->stream = NULL;
    if (ok && rename(writer->temporary, writer->path) != 0) {
        writer->reason = errno;
        ok = false;
    }
    if (lock >= 0)
        close(lock);
    if (!ok)
        return file_write_fail(writer, NULL, error);
    forget(writer->temporary);
    writer->temporary[0] = 0;
    return true;
}

void file_write_abort(file_writer *writer) {
    if (writer->stream)
        fclose(writer->stream);
    writer->stream = NULL;
    if (writer->temporary[0]) {
        unlink(writer->temporary);
        forget(writer->temporary);
    }
    writer->temporary[0] = 0;
}

bool file_write_whole(const char *path, const void *data, size_t size, base_error *error) {
    file_writer writer;
    if (!file_write_begin(&writer, path, error))
        return false;
    fwrite(data, 1, size, writer.stream);
    return file_write_commit(&writer, error);
}
