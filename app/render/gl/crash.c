/* SPDX-License-Identifier: MIT */
#include "app/render/gl/crash.h"
#include "app/base/file_writer.h"

#include <signal.h>
#include <stdatomic.h>
#include <sys/resource.h>
#include <unistd.h>

/* Reports the crash and ends the program; several threads of a driver may crash at once, and only
 * the first reports. */
static void say_and_end(int number) {
    static const char text[] =
        "lampion: OpenGL: the driver crashed, as drivers do without memory (see ulimit -v)\n";
    static atomic_flag said = ATOMIC_FLAG_INIT;
    (void)number;
    while (atomic_flag_test_and_set(&said))
        pause();
    file_remove_temporaries();
    const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
    _exit(written < 0 ? BASE_USAGE : BASE_FAILURE);
}

void gpu_expect_crashes(void) {
    static const int signals[] = { SIGSEGV, SIGBUS, SIGABRT, SIGILL };
    struct rlimit space;
    if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY)
        return;
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        struct sigaction old;
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL)
            signal(signals[i], say_and_end);
    }
}
