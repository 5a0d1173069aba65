/* SPDX-License-Identifier: MIT */
/* The sandbox: what the child may do, and what ends it with one line of error. */
#include "app/scene/sandbox.h"

#include "tests/oracle/check.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1 /* address space and system calls are then not limited */
#else
#define SANITIZED 0
#endif

static char path[] = "/tmp/lampion-sandbox-XXXXXX";

static bool write_greeting(void *context, int output, cli_error *error) {
    (void)error;
    return write(output, context, strlen(context)) > 0;
}

static bool report(void *context, int output, cli_error *error) {
    (void)output;
    return cli_fail(error, context, "is not\nwanted");
}

static bool crash(void *context, int output, cli_error *error) {
    (void)context;
    (void)output;
    (void)error;
    return raise(SIGSEGV) == 0;
}

static bool run_forever(void *context, int output, cli_error *error) {
    (void)output;
    (void)error;
    const volatile char *never_empty = context;
    while (*never_empty)
        continue;
    return true;
}

/* Neither this nor the next touches all it asks for: on a slow machine that would take longer
 * than the time there is. */
static bool fill_memory(void *context, int output, cli_error *error) {
    (void)output;
    for (int i = 0; i < 4096; i++) {
        volatile char *memory = malloc((size_t)1 << 20);
        if (!memory)
            return cli_fail(error, context, "out of memory");
        memory[0] = 1;
    }
    return true;
}

static bool fill_output(void *context, int output, cli_error *error) {
    (void)context;
    (void)error;
    for (off_t i = 0; i < 4096; i++)
        if (pwrite(output, "", 1, i << 20) < 0)
            return false;
    return true;
}

/* Tries what an attacker would; the first thing that works is named. */
static bool break_out(void *context, int output, cli_error *error) {
    (void)output;
    if (open(context, O_WRONLY) >= 0)
        return cli_fail(error, NULL, "wrote a file");
    if (open("/tmp/lampion-created", O_RDWR | O_CREAT, 0600) >= 0)
        return cli_fail(error, NULL, "created a file");
    if (unlink(context) == 0)
        return cli_fail(error, NULL, "removed a file");
    if (socket(AF_INET, SOCK_STREAM, 0) >= 0)
        return cli_fail(error, NULL, "opened a socket");
    if (fork() >= 0)
        return cli_fail(error, NULL, "made a process");
    if (kill(getppid(), 0) == 0)
        return cli_fail(error, NULL, "signalled its parent");
    execl("/bin/true", "true", (char *)NULL);
    return write(output, "held", 4) == 4;
}

static void assert_error(sandbox_work work, const char *expected) {
    cli_error error = { 0 };
    int output;
    static char subject[] = "SCENE";
    assert_false(sandbox_run(work, subject, subject, &output, &error));
    assert_int_equal(output, -1);
    assert_non_null(strstr(error.text, expected));
    assert_null(strchr(error.text, '\n'));
}

static void the_work_s_output_comes_back_sealed(void **state) {
    (void)state;
    static char greeting[] = "hello";
    char text[16] = "";
    cli_error error = { 0 };
    int output;
    assert_true(sandbox_run(write_greeting, greeting, "SCENE", &output, &error));
    assert_int_equal(pread(output, text, sizeof text, 0), 5);
    assert_string_equal(text, "hello");
    assert_int_equal(pwrite(output, "x", 1, 0), -1);
    close(output);
}

static void failures_and_crashes_are_errors(void **state) {
    (void)state;
    assert_error(report, "SCENE: is not");
    assert_error(crash, "SCENE: cannot be read: the importer crashed");
}

static void limits_end_the_work(void **state) {
    (void)state;
    assert_error(run_forever, "SCENE: takes too long");
    assert_error(fill_output, "SCENE: becomes too large");
    if (!SANITIZED)
        assert_error(fill_memory, "SCENE: out of memory");
}

static void the_work_cannot_reach_outside(void **state) {
    (void)state;
    if (SANITIZED) {
        printf("skipped: sanitizers need the system calls\n");
        return;
    }
    char text[16] = "";
    cli_error error = { 0 };
    int output;
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    if (!sandbox_run(break_out, path, "SCENE", &output, &error))
        fail_msg("the child %s", error.text);
    assert_int_equal(pread(output, text, sizeof text, 0), 4);
    close(output);
    assert_int_equal(unlink(path), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_work_s_output_comes_back_sealed),
        cmocka_unit_test(failures_and_crashes_are_errors),
        cmocka_unit_test(limits_end_the_work),
        cmocka_unit_test(the_work_cannot_reach_outside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
