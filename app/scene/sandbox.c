/* SPDX-License-Identifier: MIT */
#include "app/scene/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* What any input may use, and what each byte of it adds: a small bomb ends soon, a large honest
 * scene loads. */
#define MEMORY_BASE     (1280ull << 20)
#define MEMORY_PER_BYTE 40
#define OUTPUT_BASE     (512ull << 20)
#define OUTPUT_PER_BYTE 24
#define CPU_BASE        1.0    /* seconds */
#define CPU_PER_BYTE    0.5e-6 /* seconds */
#define WALL_SECONDS    600    /* against a child that sleeps */

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

static void limit(__rlimit_resource_t resource, uint64_t soft) {
    struct rlimit current;
    if (getrlimit(resource, &current) != 0)
        return;
    current.rlim_cur = soft < current.rlim_max ? soft : current.rlim_max;
    setrlimit(resource, &current);
}

void sandbox_expect_input(uint64_t bytes) {
    /* Sanitizers reserve terabytes of address space and are many times slower. */
    if (!SANITIZED)
        limit(RLIMIT_AS, MEMORY_BASE + MEMORY_PER_BYTE * bytes);
    limit(RLIMIT_FSIZE, OUTPUT_BASE + OUTPUT_PER_BYTE * bytes);
    const double cpu = (CPU_BASE + CPU_PER_BYTE * (double)bytes) * (SANITIZED ? 20.0 : 1.0);
    /* The timer of CPU time ends the process by SIGPROF, finer than the limit's whole seconds. */
    const struct itimerval timer = {
        .it_value = { .tv_sec = (time_t)cpu,
                      .tv_usec = (suseconds_t)(1e6 * (cpu - (double)(time_t)cpu)) }
    };
    setitimer(ITIMER_PROF, &timer, NULL);
    limit(RLIMIT_CPU, (uint64_t)cpu + 2);
}

/* --- system calls -------------------------------------------------------------------------------
 */

#if defined(__x86_64__)
#define AUDIT_ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define AUDIT_ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

/* Calls that an importer never needs fail with EPERM. */
static void forbid_system_calls(void) {
#ifdef AUDIT_ARCHITECTURE
    static const unsigned denied[] = {
        SYS_socket,
        SYS_connect,
        SYS_bind,
        SYS_sendto,
        SYS_sendmsg,
        SYS_execve,
        SYS_execveat,
        SYS_ptrace,
        SYS_process_vm_readv,
        SYS_process_vm_writev,
        SYS_kill,
        SYS_tkill,
        SYS_clone,
        SYS_clone3,
        SYS_unlinkat,
        SYS_mkdirat,
        SYS_linkat,
        SYS_symlinkat,
        SYS_renameat2,
        SYS_fchmod,
        SYS_fchmodat,
        SYS_fchownat,
        SYS_truncate,
        SYS_mount,
        SYS_chroot,
        SYS_setns,
        SYS_unshare,
        SYS_bpf,
        SYS_perf_event_open,
        SYS_userfaultfd,
        SYS_keyctl,
        SYS_add_key,
        SYS_io_uring_setup,
        SYS_memfd_create,
        SYS_openat2,
        SYS_setxattr,
#ifdef SYS_open
        SYS_open,
        SYS_creat,
        SYS_unlink,
        SYS_rename,
        SYS_mkdir,
        SYS_rmdir,
        SYS_link,
        SYS_symlink,
        SYS_chmod,
        SYS_chown,
        SYS_fork,
        SYS_vfork,
#endif
    };
    enum { DENIED = sizeof denied / sizeof *denied, HEAD = 3, OPENAT = 4 };
    struct sock_filter program[HEAD + OPENAT + DENIED + 2];
    size_t n = 0;
    const struct sock_filter refuse =
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | (EPERM & SECCOMP_RET_DATA));
    program[n++] =
        (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch));
    program[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCHITECTURE, 0,
                                                OPENAT + DENIED + 1);
    program[n++] =
        (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr));
    for (size_t i = 0; i < DENIED; i++)
        program[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, denied[i],
                                                    (unsigned char)(DENIED - i - 1 + OPENAT), 0);
    /* openat only to read */
    program[n++] =
        (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, OPENAT - 2);
    program[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS,
                                                offsetof(struct seccomp_data, args[2]));
    program[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K,
                                                O_WRONLY | O_RDWR | O_CREAT | O_TRUNC, 1, 0);
    program[n++] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    program[n++] = refuse;
    const struct sock_fprog filter = { .len = (unsigned short)n, .filter = program };
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
#endif
}

/* --- the child ----------------------------------------------------------------------------------
 */

/* Descriptors of the child: standard ones on /dev/null, then these two. */
enum { CHILD_OUTPUT = 3, CHILD_ERRORS = 4 };

static void arrange_descriptors(int output, int errors) {
    const int null = open("/dev/null", O_RDWR);
    for (int fd = 0; fd < 3; fd++)
        dup2(null, fd);
    /* Out of the way first, whatever numbers they have. */
    const int high_output = fcntl(output, F_DUPFD, 16), high_errors = fcntl(errors, F_DUPFD, 16);
    dup2(high_output, CHILD_OUTPUT);
    dup2(high_errors, CHILD_ERRORS);
#ifdef SYS_close_range
    if (syscall(SYS_close_range, CHILD_ERRORS + 1, ~0u, 0) == 0)
        return;
#endif
    for (int fd = CHILD_ERRORS + 1; fd < 1024; fd++)
        close(fd);
}

_Noreturn static void child_main(sandbox_work work, void *context, int output, int errors) {
    static const int signals[] = { SIGINT, SIGTERM, SIGHUP,  SIGSEGV, SIGBUS,  SIGABRT,
                                   SIGFPE, SIGILL,  SIGPROF, SIGXCPU, SIGXFSZ, SIGPIPE };
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        signal(signals[i], SIG_DFL);
    arrange_descriptors(output, errors);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
    limit(RLIMIT_CORE, 0);
    sandbox_expect_input(0);
    if (!SANITIZED)
        forbid_system_calls();
    cli_error error = { 0 };
    if (work(context, CHILD_OUTPUT, &error))
        _exit(0);
    const ssize_t written = write(CHILD_ERRORS, error.text, strlen(error.text));
    _exit(written >= 0 ? 1 : 2);
}

/* --- the parent ---------------------------------------------------------------------------------
 */

/* Reads what the child has to say until it ends. */
static void listen(int errors, pid_t child, char *text, size_t size) {
    size_t used = 0;
    struct timespec start, now;
    clock_gettime(CLOCK_MONOTONIC, &start);
    for (;;) {
        struct pollfd poll_for = { .fd = errors, .events = POLLIN };
        poll(&poll_for, 1, 1000);
        clock_gettime(CLOCK_MONOTONIC, &now);
        if (now.tv_sec - start.tv_sec > WALL_SECONDS)
            kill(child, SIGKILL);
        if (!poll_for.revents)
            continue;
        char rest[256];
        const bool room = used + 1 < size;
        const ssize_t got =
            read(errors, room ? text + used : rest, room ? size - 1 - used : sizeof rest);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        used += room ? (size_t)got : 0;
    }
    text[used] = 0;
}

static bool explain(int status, const char *text, const char *subject, cli_error *error) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && text[0])
        return cli_fail(error, NULL, "%s", text);
    if (WIFSIGNALED(status) &&
        (WTERMSIG(status) == SIGPROF || WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return cli_fail(error, subject, "takes too long to read for its size (is it damaged?)");
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ)
        return cli_fail(error, subject, "becomes too large for its size (is it damaged?)");
    return cli_fail(error, subject, "cannot be read: the importer crashed on it (is it damaged?)");
}

bool sandbox_run(sandbox_work work, void *context, const char *subject, int *output,
                 cli_error *error) {
    int errors[2];
    *output = memfd_create("lampion-scene", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    if (*output < 0)
        return cli_fail(error, subject, "cannot be read: no memory file: %s", strerror(errno));
    if (pipe2(errors, O_CLOEXEC) != 0) {
        close(*output);
        return cli_fail(error, subject, "cannot be read: no pipe: %s", strerror(errno));
    }
    const pid_t child = fork();
    if (child == 0)
        child_main(work, context, *output, errors[1]);
    close(errors[1]);
    bool ok = false;
    if (child < 0) {
        cli_fail(error, subject, "cannot be read: no child process: %s", strerror(errno));
    } else {
        char text[sizeof error->text];
        int status = 0;
        listen(errors[0], child, text, sizeof text);
        while (waitpid(child, &status, 0) < 0 && errno == EINTR)
            continue;
        ok = explain(status, text, subject, error);
    }
    close(errors[0]);
    if (ok && fcntl(*output, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE) != 0)
        ok = cli_fail(error, subject, "cannot be read: %s", strerror(errno));
    if (!ok) {
        close(*output);
        *output = -1;
    }
    return ok;
}
