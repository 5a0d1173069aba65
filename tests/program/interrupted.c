/* SPDX-License-Identifier: MIT */
/* A writer of a file, interrupted or killed at each of its system calls in turn: the old file is
 * whole or the new one is, and an interrupt leaves nothing beside it. */
#include "app/base/error.h"
#include "app/base/file_writer.h"
#include "tests/program/folder.h"

#include <dirent.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

static const char old_text[] = "old", new_text[] = "the new one";

enum { NO_TRACING = 2 };

static _Noreturn void write_traced(void) {
    base_error error;
    if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0)
        _exit(NO_TRACING);
    raise(SIGSTOP);
    _exit(file_write_whole(in_folder("file"), new_text, sizeof new_text - 1, &error) ? 0 : 1);
}

/* Returns the status of a writer that gets the signal at the stop of this index (two stops per
 * system call: before and after); *reached is false if it had fewer stops. */
static int interrupt_at(int index, int number, bool *reached) {
    int status;
    const pid_t writer = fork();
    if (writer == 0)
        write_traced();
    assert_int_equal(waitpid(writer, &status, 0), writer);
    if (WIFEXITED(status) && WEXITSTATUS(status) == NO_TRACING) {
        print_message("skipped: tracing a process is not allowed here\n");
        skip();
    }
    for (int stop = 0; stop <= index && WIFSTOPPED(status); stop++) {
        assert_int_equal(ptrace(PTRACE_SYSCALL, writer, NULL, NULL), 0);
        assert_int_equal(waitpid(writer, &status, 0), writer);
    }
    *reached = WIFSTOPPED(status);
    if (*reached)
        kill(writer, number);
    while (WIFSTOPPED(status)) {
        const int signal = WSTOPSIG(status) == SIGTRAP ? 0 : WSTOPSIG(status);
        ptrace(PTRACE_CONT, writer, NULL, (void *)(intptr_t)signal);
        assert_int_equal(waitpid(writer, &status, 0), writer);
    }
    return status;
}

static bool holds(const char *text) {
    char bytes[64] = "";
    FILE *const file = fopen(in_folder("file"), "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    return size == strlen(text) && memcmp(bytes, text, size) == 0;
}

static int count_temporaries(void) {
    int count = 0;
    DIR *const directory = opendir(folder);
    assert_non_null(directory);
    for (const struct dirent *entry; (entry = readdir(directory));)
        count += strncmp(entry->d_name, ".lampion-", 9) == 0;
    closedir(directory);
    return count;
}

/* Interrupts every stop of a writer; returns how many there are. */
static int sweep(int number) {
    int index = 0, kept = 0, replaced = 0;
    for (bool reached = true; reached; index++) {
        folder_write_text("file", old_text);
        const int status = interrupt_at(index, number, &reached);
        if (number != SIGKILL && count_temporaries() != 0)
            fail_msg("signal %d at stop %d left a temporary", number, index);
        const bool is_old = holds(old_text), ended = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        assert_true(ended || (reached && WIFSIGNALED(status) && WTERMSIG(status) == number));
        assert_true(holds(new_text) || (is_old && !ended));
        kept += is_old;
        replaced += !is_old;
    }
    assert_true(kept > 0 && replaced > 1); /* both sides of the renaming were seen */
    return index - 1;
}

static void interrupts_leave_one_whole_file(void **state) {
    (void)state;
    static const int numbers[] = { SIGINT, SIGTERM, SIGHUP };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        print_message("tried: signal %d at %d stops of a writer\n", numbers[i], sweep(numbers[i]));
}

static void what_killed_runs_left_is_removed_by_the_next(void **state) {
    (void)state;
    print_message("tried: SIGKILL at %d stops of a writer\n", sweep(SIGKILL));
    assert_int_equal(count_temporaries(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interrupts_leave_one_whole_file),
        cmocka_unit_test(what_killed_runs_left_is_removed_by_the_next),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
