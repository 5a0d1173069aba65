/* SPDX-License-Identifier: MIT */
#include "app/base/sandbox.h"

#include "app/base/number.h"
#include "app/base/sandbox_message.h"
#include "app/base/sandbox_policy.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/pidfd.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* What any input may use, and the additional allowance per byte of input: a small malicious file is
 * stopped early, while a large legitimate scene still loads. */
#define MEMORY_BASE     (1280ull << 20)
#define MEMORY_PER_BYTE 40
#define OUTPUT_BASE     (512ull << 20)
#define OUTPUT_PER_BYTE 24
#define CPU_BASE        4.0  /* seconds */
#define CPU_PER_BYTE    4e-6 /* seconds: Draco packs a million triangles into a megabyte */
#define TICK            20   /* milliseconds between checks of the clock */
#define INPUT_MAX       (8ull << 30)
#define FILES_MAX       4096

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

/* --- limits ----------------------------------------------------------------------------------- */

static void set_limit(pid_t process, __rlimit_resource_t resource, uint64_t soft) {
    struct rlimit limit;
    if (prlimit(process, resource, NULL, &limit) != 0)
        return;
    limit.rlim_cur = soft < limit.rlim_max ? soft : limit.rlim_max;
    prlimit(process, resource, &limit, NULL);
}

static double cpu_seconds(uint64_t input_bytes) {
    return (CPU_BASE + CPU_PER_BYTE * (double)input_bytes) * (SANITIZED ? 8.0 : 1.0);
}

/* Returns how much address space the program already uses, including that of a graphics driver. */
static uint64_t address_space(void) {
    unsigned long long pages = 0;
    FILE *const stream = fopen("/proc/self/statm", "re");
    const bool known = stream && fscanf(stream, "%llu", &pages) == 1;
    if (stream)
        fclose(stream);
    return known ? pages * (uint64_t)sysconf(_SC_PAGESIZE) : 0;
}

/* Limits memory, output and CPU time. Sanitizers reserve terabytes of address space and run many
 * times slower, so under them memory is not limited and the time limit is longer. */
static void set_limits(pid_t process, uint64_t base, uint64_t input_bytes) {
    if (!SANITIZED)
        set_limit(process, RLIMIT_AS, base + MEMORY_BASE + MEMORY_PER_BYTE * input_bytes);
    set_limit(process, RLIMIT_FSIZE, OUTPUT_BASE + OUTPUT_PER_BYTE * input_bytes);
    set_limit(process, RLIMIT_CPU, (uint64_t)cpu_seconds(input_bytes) + 2);
}

/* --- the child -------------------------------------------------------------------------------- */

/* The child's file descriptors: the standard ones, redirected to /dev/null, then these two. */
enum { CHILD_OUTPUT = 3, CHILD_SOCKET = 4 };

static bool close_all_above(int descriptor) {
    if (close_range((unsigned)descriptor + 1, ~0u, 0) == 0)
        return true;
    DIR *const open_ones = opendir("/proc/self/fd"); /* before Linux 5.9 */
    if (!open_ones)
        return false;
    for (const struct dirent *entry; (entry = readdir(open_ones));) {
        const int fd = (int)strtol(entry->d_name, NULL, 10);
        if (fd > descriptor && fd != dirfd(open_ones))
            close(fd);
    }
    closedir(open_ones);
    return true;
}

static bool arrange_descriptors(int output, int socket) {
    const int null = open("/dev/null", O_RDWR);
    if (null < 0)
        return false;
    for (int fd = 0; fd < 3; fd++)
        if (dup2(null, fd) < 0)
            return false;
    /* First move both out of the way, whatever their numbers are. */
    const int high_output = fcntl(output, F_DUPFD, 16), high_socket = fcntl(socket, F_DUPFD, 16);
    return dup2(high_output, CHILD_OUTPUT) >= 0 && dup2(high_socket, CHILD_SOCKET) >= 0 &&
           close_all_above(CHILD_SOCKET);
}

/* Unmaps memory that is shared through a file or a device, such as that of a driver or a window.
 * Anonymous shared memory stays mapped: neither the program nor its libraries create any, and a
 * test that keeps a counter there across the fork would crash without it. */
static bool leave_shared_memory(void) {
    FILE *const maps = fopen("/proc/self/maps", "re");
    char line[4600];
    while (maps && fgets(line, sizeof line, maps)) {
        uintptr_t first, end;
        char permissions[8];
        if (sscanf(line, "%" SCNxPTR "-%" SCNxPTR " %7s", &first, &end, permissions) == 3 &&
            permissions[3] == 's' && !strstr(line, " /dev/zero (deleted)") &&
            munmap((void *)first, end - first) != 0) {
            fclose(maps);
            return false;
        }
    }
    if (maps)
        fclose(maps);
    return maps != NULL;
}

static void forget_environment(void) {
    for (char **variable = environ; variable && *variable; variable++)
        explicit_bzero(*variable, strlen(*variable));
    clearenv();
}

/* Detaches the child into a session of its own: no terminal to write to, no signals from the
 * keyboard. */
static void leave_parent(pid_t parent) {
    static const int signals[] = { SIGINT, SIGTERM, SIGHUP,  SIGSEGV, SIGBUS, SIGABRT,
                                   SIGFPE, SIGILL,  SIGXCPU, SIGXFSZ, SIGPIPE };
    setsid();
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(EXIT_FAILURE);
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
        signal(signals[i], SIG_DFL);
    forget_environment();
}

/* The progress that the child last reported; infinite outside a child, where nothing is
 * reported. */
static double told = (double)INFINITY;

_Noreturn static void child_main(const sandbox_job *job, pid_t parent, int output, int socket) {
    base_error error = { 0 };
    told = 0;
    leave_parent(parent);
    if (!arrange_descriptors(output, socket) || !leave_shared_memory())
        _exit(EXIT_FAILURE);
    const struct rlimit none = { 0, 0 };
    setrlimit(RLIMIT_CORE, &none);
    if (policy_enter(&error) && job->work(job->context, CHILD_OUTPUT, &error))
        _exit(EXIT_SUCCESS);
    message_send(CHILD_SOCKET, MESSAGE_FAILURE, error.text, -1);
    _exit(EXIT_FAILURE);
}

void sandbox_progress(double done) {
    enum { STEPS = 50 };
    char text[32];
    if (!(done >= told + 1.0 / STEPS))
        return;
    told = done;
    snprintf(text, sizeof text, "%.3f", done);
    message_send(CHILD_SOCKET, MESSAGE_PROGRESS, text, -1);
}

bool sandbox_write(int output, const void *data, size_t size) {
    const char *bytes = data;
    for (size_t done = 0; done < size;) {
        const ssize_t written = write(output, bytes + done, size - done);
        if (written == 0 || (written < 0 && errno != EINTR))
            return false;
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}

int sandbox_open(const char *name, int *number, base_error *error) {
    message reply;
    int file;
    if (strlen(name) >= sizeof reply.text)
        base_fail(error, NULL, "%.64s…: is too long a name", name);
    else if (!message_send(CHILD_SOCKET, MESSAGE_OPEN, name, -1) ||
             !message_receive(CHILD_SOCKET, true, &reply, &file))
        base_fail(error, name, "cannot be asked for");
    else if (reply.kind == MESSAGE_FILE && file >= 0) {
        *number = atoi(reply.text);
        return file;
    } else
        base_fail(error, NULL, "%s", reply.text);
    return -1;
}

/* --- the parent ------------------------------------------------------------------------------- */

typedef struct file_identity {
    dev_t device;
    ino_t inode;
} file_identity;

typedef struct guard {
    const sandbox_job *job;
    pid_t child;
    int opened, file_count; /* requests granted, and distinct files among them */
    file_identity files[FILES_MAX];
    int socket, process; /* the latter becomes readable when the child exits */
    uint64_t base, input_bytes;
    bool cancelled;
    char complaint[sizeof((base_error *)0)->text];
} guard;

static double seconds_of(clockid_t clock) {
    struct timespec now = { 0 };
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Assigns a number to a file that is passed to the child. Each new file raises the child's limits,
 * up to those for INPUT_MAX bytes. */
static int count_file(guard *g, int file) {
    struct stat status = { 0 };
    if (fstat(file, &status) != 0)
        return -1;
    for (int i = 0; i < g->file_count; i++)
        if (g->files[i].device == status.st_dev && g->files[i].inode == status.st_ino)
            return i;
    g->files[g->file_count] = (file_identity) { status.st_dev, status.st_ino };
    if (status.st_size > 0 && (uint64_t)status.st_size < INPUT_MAX)
        g->input_bytes += (uint64_t)status.st_size;
    if (g->input_bytes > INPUT_MAX)
        g->input_bytes = INPUT_MAX;
    set_limits(g->child, g->base, g->input_bytes);
    return g->file_count++;
}

static void open_for_child(guard *g, const char *name) {
    char number[16];
    base_error error = { "no file can be opened" };
    const bool may = g->job->open && g->opened < FILES_MAX;
    g->opened += may;
    const int file = may ? g->job->open(g->job->context, name, &error) : -1;
    if (file < 0) {
        message_send(g->socket, MESSAGE_FAILURE, error.text, -1);
        return;
    }
    snprintf(number, sizeof number, "%d", count_file(g, file));
    message_send(g->socket, MESSAGE_FILE, number, file);
    close(file);
}

static void show_progress(const guard *g, const char *text) {
    double done;
    if (g->job->progress && number_read(text, strlen(text), &done) && done >= 0 && done <= 1)
        g->job->progress(g->job->context, done);
}

static bool listen_once(guard *g) {
    message m;
    if (!message_receive(g->socket, false, &m, NULL))
        return false;
    if (m.kind == MESSAGE_OPEN)
        open_for_child(g, m.text);
    else if (m.kind == MESSAGE_PROGRESS)
        show_progress(g, m.text);
    else
        strcpy(g->complaint, m.text);
    return true;
}

/* Serves the child until it exits or its time is up. */
static void attend(guard *g) {
    struct pollfd polled[] = { { .fd = g->process, .events = POLLIN },
                               { .fd = g->socket, .events = POLLIN } };
    const double end =
        seconds_of(CLOCK_MONOTONIC) + (double)(g->job->seconds ? g->job->seconds : SANDBOX_SECONDS);
    clockid_t cpu = CLOCK_MONOTONIC;
    const bool has_cpu = clock_getcpuclockid(g->child, &cpu) == 0;
    while (!polled[0].revents) {
        poll(polled, 2, TICK);
        if (polled[1].revents && !listen_once(g))
            polled[1].fd = -1; /* nothing more to hear from the child, but its time still runs */
        g->cancelled |= g->job->cancelled && g->job->cancelled(g->job->context);
        if (g->cancelled || seconds_of(CLOCK_MONOTONIC) > end ||
            (has_cpu && seconds_of(cpu) > cpu_seconds(g->input_bytes)))
            kill(g->child, SIGKILL);
    }
    while (listen_once(g))
        continue;
}

static bool explain(int status, const guard *g, base_error *error) {
    const char *const complaint = g->complaint, *const subject = g->job->subject;
    if (g->cancelled)
        return base_fail(error, subject, "was cancelled");
    if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
        return true;
    if (WIFEXITED(status) && complaint[0])
        return base_fail(error, NULL, "%s", complaint);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return base_fail(error, subject, "takes too long to read for its size (is it damaged?)");
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ)
        return base_fail(error, subject, "becomes too large for its size (is it damaged?)");
    return base_fail(error, subject, "cannot be read: its reader crashed on it (is it damaged?)");
}

static bool map_output(int output, const char *subject, void **block, size_t *size,
                       base_error *error) {
    struct stat status;
    *block = MAP_FAILED;
    if (fstat(output, &status) == 0 && status.st_size > 0) {
        *size = (size_t)status.st_size;
        *block = mmap(NULL, *size, PROT_READ, MAP_PRIVATE, output, 0);
    }
    return *block != MAP_FAILED || base_fail(error, subject, "does not fit into memory");
}

static bool spawn(const sandbox_job *job, int output, guard *g, base_error *error) {
    int sockets[2];
    *g = (guard) { .job = job, .base = address_space(), .input_bytes = job->input_bytes };
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0)
        return base_fail(error, job->subject, "cannot be read: no sockets: %s", strerror(errno));
    const pid_t parent = getpid();
    g->child = fork();
    if (g->child == 0) {
        set_limits(0, g->base, g->input_bytes);
        child_main(job, parent, output, sockets[1]);
    }
    const int reason = errno;
    close(sockets[1]);
    g->socket = sockets[0];
    g->process = g->child > 0 ? pidfd_open(g->child, 0) : -1;
    if (g->process >= 0)
        return true;
    if (g->child > 0) {
        kill(g->child, SIGKILL);
        waitpid(g->child, NULL, 0);
    }
    close(g->socket);
    return base_fail(error, job->subject, "cannot be read: no child process: %s", strerror(reason));
}

/* A job that has been started. */
typedef struct started_job {
    guard guard;
    int output;
} started_job;

static bool start(const sandbox_job *job, started_job *started, base_error *error) {
    started->output = memfd_create("lampion-sandbox", MFD_CLOEXEC);
    if (started->output < 0)
        return base_fail(error, job->subject, "cannot be read: no memory file: %s",
                         strerror(errno));
    if (spawn(job, started->output, &started->guard, error))
        return true;
    close(started->output);
    return false;
}

/* Waits for the job to end. */
static bool finish(started_job *started, void **block, size_t *size, base_error *error) {
    guard *g = &started->guard;
    int status = 0;
    attend(g);
    while (waitpid(g->child, &status, 0) < 0)
        if (errno != EINTR) {
            /* the child was reaped elsewhere, so its output may be incomplete */
            status = SIGKILL;
            break;
        }
    close(g->process);
    close(g->socket);
    const bool ok = explain(status, g, error) &&
                    map_output(started->output, g->job->subject, block, size, error);
    close(started->output);
    return ok;
}

bool sandbox_run(const sandbox_job *job, void **block, size_t *size, base_error *error) {
    started_job started;
    return start(job, &started, error) && finish(&started, block, size, error);
}

bool sandbox_run_all(const sandbox_job *jobs, size_t count, void **blocks, size_t *sizes,
                     base_error *error) {
    started_job *started = calloc(count, sizeof *started);
    size_t running = 0, done = 0;
    if (!started)
        return base_fail(error, jobs->subject, "does not fit into memory");
    while (running < count && start(&jobs[running], &started[running], error))
        running++;
    bool ok = running == count;
    /* After a failure, wait for the other jobs and keep the first error. */
    for (size_t i = 0; i < running; i++) {
        base_error later;
        const bool fine = finish(&started[i], &blocks[i], &sizes[i], ok ? error : &later);
        if (!fine)
            blocks[i] = NULL;
        ok = ok && fine;
        done++;
    }
    for (size_t i = 0; !ok && i < done; i++)
        if (blocks[i])
            munmap(blocks[i], sizes[i]);
    free(started);
    return ok;
}
