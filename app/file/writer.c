/* SPDX-License-Identifier: MIT */
#include "app/file/file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Temporaries to remove when the program is interrupted: the handler may only read them. */
#define PENDING_MAX 8
static char pending_path[PENDING_MAX][4096];
static volatile sig_atomic_t pending_used[PENDING_MAX];

static void remove_pending(int number) {
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending_used[i])
            unlink(pending_path[i]);
    signal(number, SIG_DFL);
    raise(number);
}

static void catch_interrupts(void) {
    static const int signals[] = { SIGINT, SIGTERM, SIGHUP };
    static bool done;
    for (size_t i = 0; !done && i < sizeof signals / sizeof *signals; i++) {
        struct sigaction old;
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL)
            signal(signals[i], remove_pending);
    }
    done = true;
}

static void remember(const char *temporary) {
    catch_interrupts();
    for (int i = 0; i < PENDING_MAX; i++)
        if (!pending_used[i]) {
            strcpy(pending_path[i], temporary);
            pending_used[i] = 1;
            return;
        }
}

static void forget(const char *temporary) {
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending_used[i] && strcmp(pending_path[i], temporary) == 0)
            pending_used[i] = 0;
}

bool file_write_begin(file_writer *writer, const char *path, cli_error *error) {
    *writer = (file_writer) { 0 };
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode))
        return cli_fail(error, path, "is a directory, not a file");
    if (exists && !S_ISREG(status.st_mode))
        return cli_fail(error, path, "is not a regular file");
    const int size = (int)sizeof writer->temporary;
    if (snprintf(writer->temporary, sizeof writer->temporary, "%s.XXXXXX", path) >= size) {
        writer->temporary[0] = 0;
        return cli_fail(error, path, "is too long a name");
    }
    strcpy(writer->path, path);
    const int fd = mkostemp(writer->temporary, O_CLOEXEC);
    if (fd < 0) {
        writer->temporary[0] = 0;
        return cli_fail(error, path, "cannot be written: %s", strerror(errno));
    }
    remember(writer->temporary);
    /* mkostemp makes it private: give it the mode of any new file. */
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(fd, exists ? status.st_mode & 0777 : 0666 & ~mask);
    writer->stream = fdopen(fd, "wb");
    if (!writer->stream) {
        close(fd);
        file_write_abort(writer);
        return cli_fail(error, path, "cannot be written: %s", strerror(errno));
    }
    return true;
}

bool file_write_commit(file_writer *writer, cli_error *error) {
    errno = 0;
    bool ok = !ferror(writer->stream);
    ok = fclose(writer->stream) == 0 && ok;
    writer->stream = NULL;
    if (ok)
        ok = rename(writer->temporary, writer->path) == 0;
    if (!ok) {
        const int reason = errno ? errno : EIO;
        file_write_abort(writer);
        return cli_fail(error, writer->path, "cannot be written: %s", strerror(reason));
    }
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
