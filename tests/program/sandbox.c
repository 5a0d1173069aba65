/* SPDX-License-Identifier: MIT */
/* The sandbox: what the child may do, what ends it with one line of error, and every escape that an
 * attacker who has taken over the child would try. */
#include "app/base/sandbox.h"

#include "tests/program/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1 /* where the address space is not limited */
#else
#define SANITIZED 0
#endif

static char subject[] = "SCENE";

static bool say(int output, const char *text) {
    return write(output, text, strlen(text)) == (ssize_t)strlen(text);
}

/* Returns the text that a job's work wrote; the test fails if the job does. */
static const char *run(const sandbox_job *job) {
    static char text[256];
    base_error error = { 0 };
    void *block;
    size_t size;
    if (!sandbox_run(job, &block, &size, &error))
        fail_msg("%s", error.text);
    snprintf(text, sizeof text, "%.*s", (int)size, (const char *)block);
    munmap(block, size);
    return text;
}

static void assert_error(const sandbox_job *job, const char *expected) {
    base_error error = { 0 };
    void *block;
    size_t size;
    assert_false(sandbox_run(job, &block, &size, &error));
    if (!strstr(error.text, expected))
        fail_msg("\"%s\" is not \"%s\"", error.text, expected);
    assert_null(strchr(error.text, '\n'));
}

/* --- what the work may do --------------------------------------------------------------------- */

static bool write_greeting(void *context, int output, base_error *error) {
    (void)error;
    return say(output, context);
}

static void what_the_work_writes_comes_back(void **state) {
    (void)state;
    static char greeting[] = "hello";
    const sandbox_job job = { .subject = subject, .context = greeting, .work = write_greeting };
    assert_string_equal(run(&job), "hello");
}

static int open_in_folder(void *context, const char *name, base_error *error) {
    (void)context;
    const int file = strchr(name, '/') ? -1 : open(in_folder(name), O_RDONLY);
    if (file < 0)
        base_fail(error, name, "does not exist");
    return file;
}

static bool copy_file(void *context, int output, base_error *error) {
    char bytes[64];
    int number;
    const int file = sandbox_open(context, &number, error);
    const ssize_t got = file < 0 ? -1 : read(file, bytes, sizeof bytes);
    return got > 0 && write(output, bytes, (size_t)got) == got;
}

static void files_come_from_the_parent_alone(void **state) {
    (void)state;
    static char page[] = "page", none[] = "none", outside[] = "../page";
    folder_write_text("page", "a page");
    sandbox_job job = {
        .subject = subject, .context = page, .work = copy_file, .open = open_in_folder
    };
    assert_string_equal(run(&job), "a page");
    job.context = none;
    assert_error(&job, "none: does not exist");
    job.context = outside;
    assert_error(&job, "../page: does not exist");
    job.open = NULL;
    assert_error(&job, "no file can be opened");
}

/* Asks for the file again and again until it is refused; writes how often it was opened. */
static bool open_until_refused(void *context, int output, base_error *error) {
    int number, times = 0;
    for (int file; (file = sandbox_open(context, &number, error)) >= 0; times++)
        close(file);
    char text[16];
    snprintf(text, sizeof text, "%d", times);
    return strstr(error->text, "no file can be opened") && say(output, text);
}

static void files_are_opened_so_many_times(void **state) {
    (void)state;
    static char page[] = "page";
    folder_write_text("page", "a page");
    const sandbox_job job = {
        .subject = subject, .context = page, .work = open_until_refused, .open = open_in_folder
    };
    assert_string_equal(run(&job), "4096");
}

/* --- what ends it ----------------------------------------------------------------------------- */

static bool report(void *context, int output, base_error *error) {
    (void)output;
    return base_fail(error, context, "is not\nwanted");
}

static bool crash(void *context, int output, base_error *error) {
    (void)context;
    (void)output;
    (void)error;
    return raise(SIGSEGV) == 0;
}

static bool say_nothing(void *context, int output, base_error *error) {
    (void)context;
    (void)output;
    (void)error;
    return true;
}

static void failures_and_crashes_are_errors(void **state) {
    (void)state;
    assert_error(&(sandbox_job) { .subject = subject, .context = subject, .work = report },
                 "SCENE: is not");
    assert_error(&(sandbox_job) { .subject = subject, .work = crash },
                 "SCENE: cannot be read: its reader crashed");
    assert_error(&(sandbox_job) { .subject = subject, .work = say_nothing },
                 "SCENE: does not fit into memory");
}

static bool run_forever(void *context, int output, base_error *error) {
    (void)output;
    (void)error;
    const volatile char *never_empty = context;
    while (*never_empty)
        continue;
    return true;
}

/* Asks for memory without touching all of it, as the next job does: on a slow machine touching it
 * would outlast the time limit. */
static bool fill_memory(void *context, int output, base_error *error) {
    (void)output;
    for (int i = 0; i < 4096; i++) {
        volatile char *memory = malloc((size_t)1 << 20);
        if (!memory)
            return base_fail(error, context, "out of memory");
        memory[0] = 1;
    }
    return true;
}

static bool fill_output(void *context, int output, base_error *error) {
    (void)context;
    (void)error;
    for (off_t i = 0; i < 4096; i++)
        if (pwrite(output, "", 1, i << 20) < 0)
            return false;
    return true;
}

/* Closes all its descriptors, so that nobody can hear from it, and waits for ever. */
static bool hide_and_wait(void *context, int output, base_error *error) {
    (void)context;
    (void)output;
    (void)error;
    for (int fd = 0; fd < 64; fd++)
        close(fd);
    int word = 0;
    for (;;)
        syscall(SYS_futex, &word, 0 /* FUTEX_WAIT */, 0, NULL, NULL, 0);
    return true;
}

/* Takes as much CPU time as a mesh that is packed into a small file may need. */
static bool run_for_seconds(void *context, int output, base_error *error) {
    (void)context;
    (void)error;
    while (clock() < 3 * CLOCKS_PER_SEC)
        continue;
    return say(output, "done");
}

static void a_small_file_may_take_seconds(void **state) {
    (void)state;
    const sandbox_job job = { .subject = subject, .work = run_for_seconds };
    assert_string_equal(run(&job), "done");
}

static void limits_end_the_work(void **state) {
    (void)state;
    sandbox_job job = { .subject = subject, .context = subject, .work = run_forever };
    assert_error(&job, "SCENE: takes too long");
    job.work = fill_output;
    assert_error(&job, "SCENE: becomes too large");
    job.work = fill_memory;
    if (!SANITIZED)
        assert_error(&job, "SCENE: out of memory");
    job.work = hide_and_wait;
    job.seconds = 1;
    assert_error(&job, "SCENE: takes too long");
}

/* --- a kernel that refuses -------------------------------------------------------------------- */

static bool no_filter, no_promise;

/* Replace the libraries' functions, which the linker leaves under the other names. */
int __real_seccomp_load(const void *filter);
int __wrap_seccomp_load(const void *filter);
int __wrap_seccomp_load(const void *filter) {
    return no_filter ? -EFAULT : __real_seccomp_load(filter);
}

int __real_prctl(int option, unsigned long a, unsigned long b, unsigned long c, unsigned long d);
int __wrap_prctl(int option, unsigned long a, unsigned long b, unsigned long c, unsigned long d);
int __wrap_prctl(int option, unsigned long a, unsigned long b, unsigned long c, unsigned long d) {
    errno = EINVAL;
    return no_promise && option == PR_SET_NO_NEW_PRIVS ? -1 : __real_prctl(option, a, b, c, d);
}

/* Where the sandbox cannot be set up, not a byte is read. */
static void without_walls_no_work_is_done(void **state) {
    (void)state;
    const sandbox_job job = { .subject = subject, .context = subject, .work = write_greeting };
    no_filter = true;
    assert_error(&job, "no sandbox: ");
    no_filter = false;
    no_promise = true;
    assert_error(&job, "no sandbox: ");
    no_promise = false;
    assert_string_equal(run(&job), subject);
}

/* --- escapes ---------------------------------------------------------------------------------- */

typedef struct attempt {
    const char *name;
    long number, arguments[6];
} attempt;

#define TEXT(text) (long)(uintptr_t)(text)

static bool goes_through(const attempt *a) {
    const long *const x = a->arguments;
    errno = 0;
    return syscall(a->number, x[0], x[1], x[2], x[3], x[4], x[5]) != -1 || errno != EPERM;
}

/* Returns the first attempt that was not refused by EPERM, the sandbox's own refusal, whatever the
 * caller may do elsewhere. */
static const char *first_through(const attempt *attempts, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (goes_through(&attempts[i]))
            return attempts[i].name;
    return NULL;
}

static pid_t tester;
static char made[] = "/tmp/lampion-made", word[] = "x", buffer[4096];

static const char *reach_files(const char *file) {
    const long victim = TEXT(file), here = AT_FDCWD;
    const attempt attempts[] = {
        { "open to read", SYS_openat, { here, victim, O_RDONLY } },
        { "open to write", SYS_openat, { here, victim, O_WRONLY } },
        { "create", SYS_openat, { here, TEXT(made), O_RDWR | O_CREAT, 0600 } },
        { "openat2", SYS_openat2, { here, victim, TEXT(buffer), 24 } },
        { "open the parent's memory", SYS_openat, { here, TEXT("/proc/1/mem"), O_RDONLY } },
        { "open by handle", SYS_open_by_handle_at, { here, TEXT(buffer), O_RDONLY } },
        { "rename", SYS_renameat, { here, victim, here, TEXT(made) } },
        { "rename by flags", SYS_renameat2, { here, victim, here, TEXT(made), 0 } },
        { "remove", SYS_unlinkat, { here, victim, 0 } },
        { "link", SYS_linkat, { here, victim, here, TEXT(made), 0 } },
        { "symlink", SYS_symlinkat, { victim, here, TEXT(made) } },
        { "make a folder", SYS_mkdirat, { here, TEXT(made), 0700 } },
        { "make a node", SYS_mknodat, { here, TEXT(made), 0010600, 0 } },
        { "change the mode", SYS_fchmodat, { here, victim, 0777 } },
        { "change the owner", SYS_fchownat, { here, victim, 1, 1, 0 } },
        { "change the times", SYS_utimensat, { here, victim, 0, 0 } },
        { "truncate", SYS_truncate, { victim, 0 } },
        { "set an attribute", SYS_setxattr, { victim, TEXT("user.x"), TEXT(word), 1, 0 } },
        { "look at a file", SYS_newfstatat, { here, victim, TEXT(buffer), 0 } },
        { "read a link", SYS_readlinkat, { here, TEXT("/proc/self/exe"), TEXT(buffer), 64 } },
        { "change the folder", SYS_chdir, { TEXT("/") } },
        { "change the root", SYS_chroot, { TEXT("/") } },
        { "mount", SYS_mount, { TEXT("none"), TEXT("/tmp"), TEXT("tmpfs"), 0, 0 } },
        { "memory file", SYS_memfd_create, { TEXT(word), 0 } },
        { "watch files", SYS_inotify_init1, { 0 } },
    };
    return first_through(attempts, sizeof attempts / sizeof *attempts);
}

static const char *reach_processes(void) {
    const long parent = tester, self = getpid(), here = AT_FDCWD;
    struct rlimit much = { RLIM_INFINITY, RLIM_INFINITY };
    struct iovec part = { buffer, sizeof buffer };
    const attempt attempts[] = {
        { "signal the parent", SYS_kill, { parent, SIGTERM } },
        { "signal a thread of it", SYS_tgkill, { parent, parent, SIGTERM } },
        { "signal any thread", SYS_tkill, { parent, SIGTERM } },
        { "queue a signal", SYS_rt_sigqueueinfo, { parent, SIGTERM, TEXT(buffer) } },
        { "signal by descriptor", SYS_pidfd_send_signal, { 4, SIGTERM, 0, 0 } },
        { "descriptor of a process", SYS_pidfd_open, { parent, 0 } },
        { "take a descriptor", SYS_pidfd_getfd, { 4, 0, 0 } },
        { "read its memory", SYS_process_vm_readv, { parent, TEXT(&part), 1, TEXT(&part), 1, 0 } },
        { "write its memory",
          SYS_process_vm_writev,
          { parent, TEXT(&part), 1, TEXT(&part), 1, 0 } },
        { "trace it", SYS_ptrace, { PTRACE_ATTACH, parent, 0, 0 } },
        { "compare with it", SYS_kcmp, { parent, self, 0, 0, 0 } },
        { "limit it", SYS_prlimit64, { parent, RLIMIT_AS, TEXT(&much), 0 } },
        { "raise own limits", SYS_setrlimit, { RLIMIT_AS, TEXT(&much) } },
        { "raise own limits, too", SYS_prlimit64, { 0, RLIMIT_CPU, TEXT(&much), 0 } },
        { "slow the parent", SYS_setpriority, { 0, parent, 19 } },
        { "bind it to a CPU", SYS_sched_setaffinity, { parent, 8, TEXT(buffer) } },
        { "fork", SYS_clone, { SIGCHLD } },
        { "fork by clone3", SYS_clone3, { TEXT(buffer), 64 } },
        { "execute", SYS_execve, { TEXT("/bin/true"), 0, 0 } },
        { "execute by descriptor", SYS_execveat, { here, TEXT("/bin/true"), 0, 0, 0 } },
        { "dumpable again", SYS_prctl, { PR_SET_DUMPABLE, 1 } },
        { "outlive the parent", SYS_prctl, { PR_SET_PDEATHSIG, 0 } },
        { "own namespaces", SYS_unshare, { 0x10000000 } },
        { "another's namespaces", SYS_setns, { 4, 0 } },
        { "another user", SYS_setuid, { 1 } },
        { "capabilities", SYS_capset, { TEXT(buffer), TEXT(buffer) } },
    };
    return first_through(attempts, sizeof attempts / sizeof *attempts);
}

static const char *reach_kernel(void) {
    const attempt attempts[] = {
        { "keys into the terminal", SYS_ioctl, { 0, TIOCSTI, TEXT(word) } },
        { "socket", SYS_socket, { AF_INET, SOCK_STREAM, 0 } },
        { "pair of sockets", SYS_socketpair, { AF_UNIX, SOCK_STREAM, 0, TEXT(buffer) } },
        { "connect", SYS_connect, { 4, TEXT(buffer), 16 } },
        { "duplicate", SYS_dup, { 4 } },
        { "pipe", SYS_pipe2, { TEXT(buffer), 0 } },
        { "io_uring", SYS_io_uring_setup, { 8, TEXT(buffer) } },
        { "bpf", SYS_bpf, { 0, TEXT(buffer), 64 } },
        { "keyring", SYS_add_key, { TEXT("user"), TEXT(word), TEXT(word), 1, -2 } },
        { "performance counters", SYS_perf_event_open, { TEXT(buffer), 0, -1, -1, 0 } },
        { "page faults", SYS_userfaultfd, { 0 } },
        { "shared memory", SYS_shmget, { 0, 4096, 01600 } },
        { "executable memory", SYS_mmap, { 0, 4096, PROT_READ | PROT_EXEC, 0x22, -1, 0 } },
        { "code from data", SYS_mprotect, { TEXT(buffer) & -4096L, 4096, PROT_EXEC | PROT_READ } },
        { "another filter", SYS_seccomp, { 1, 0, TEXT(buffer) } },
    };
    return first_through(attempts, sizeof attempts / sizeof *attempts);
}

static bool try_all(void *context, int output, base_error *error) {
    const char *const reached[] = { reach_files(context), reach_processes(), reach_kernel() };
    for (size_t i = 0; i < sizeof reached / sizeof *reached; i++)
        if (reached[i])
            return base_fail(error, NULL, "\"%s\" was not refused", reached[i]);
    return say(output, "held");
}

static void every_escape_fails(void **state) {
    (void)state;
    char victim[512];
    tester = getpid();
    folder_write_text("victim", "untouched");
    snprintf(victim, sizeof victim, "%s", in_folder("victim"));
    const sandbox_job job = { .subject = subject, .context = victim, .work = try_all };
    assert_string_equal(run(&job), "held");
    assert_int_equal(access("/tmp/lampion-made", F_OK), -1);
    char text[16] = "";
    FILE *file = fopen(victim, "r");
    assert_non_null(file);
    assert_int_equal(fread(text, 1, sizeof text, file), 9);
    fclose(file);
    assert_string_equal(text, "untouched");
}

/* The context is a descriptor of the parent's, and the address of a secret in its environment. */
typedef struct belongings {
    int descriptor;
    const char *secret;
} belongings;

static bool look_around(void *context, int output, base_error *error) {
    const belongings *const parent = context;
    char byte;
    if (getenv("LAMPION_SECRET") || parent->secret[0])
        return base_fail(error, NULL, "sees the environment");
    for (int fd = 5; fd < 1024; fd++)
        if (read(fd, &byte, 1) >= 0 || errno != EBADF)
            return base_fail(error, NULL, "holds the descriptor %d", fd);
    return say(output, "blind");
}

static void nothing_is_inherited_but_memory(void **state) {
    (void)state;
    folder_write_text("page", "a page");
    assert_int_equal(setenv("LAMPION_SECRET", "key", 1), 0);
    belongings parent = { open(in_folder("page"), O_RDONLY), getenv("LAMPION_SECRET") };
    assert_true(parent.descriptor >= 0);
    const sandbox_job job = { .subject = subject, .context = &parent, .work = look_around };
    assert_string_equal(run(&job), "blind");
    assert_string_equal(getenv("LAMPION_SECRET"), "key");
    close(parent.descriptor);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_the_work_writes_comes_back),
        cmocka_unit_test(files_come_from_the_parent_alone),
        cmocka_unit_test(files_are_opened_so_many_times),
        cmocka_unit_test(failures_and_crashes_are_errors),
        cmocka_unit_test(a_small_file_may_take_seconds),
        cmocka_unit_test(limits_end_the_work),
        cmocka_unit_test(without_walls_no_work_is_done),
        cmocka_unit_test(every_escape_fails),
        cmocka_unit_test(nothing_is_inherited_but_memory),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
