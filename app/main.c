/* SPDX-License-Identifier: MIT */
/* The program: finds the command, runs it, and makes sure that what it printed arrived. */
#include "app/base/cli.h"
#include "app/command/command.h"

#include <lampion/base.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static int print_help(void) {
    printf("lampion: %s\n\nUsage: lampion COMMAND [OPTION…]\n\nCommands:\n",
           command_program_summary);
    for (const cli_command *const *command = command_table; *command; command++)
        printf("  %-12s%s\n", (*command)->name, (*command)->summary);
    printf("\nlampion COMMAND --help shows a command's options and examples;"
           " lampion --version the version.\n");
    return BASE_OK;
}

static int print_version(void) {
    const uint32_t version = lmp_version();
    printf("lampion %u.%u.%u\n", version >> 16, version >> 8 & 0xFF, version & 0xFF);
    return BASE_OK;
}

static int run_command(int argc, char **argv) {
    const cli_command *const command = command_find(argv[0]);
    return command ? command->run(command, argc, argv) : command_unknown(argv[0]);
}

static int run(int argc, char **argv) {
    if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)
        return print_help();
    if (strcmp(argv[1], "--version") == 0)
        return print_version();
    if (strcmp(argv[1], "help") != 0)
        return run_command(argc - 1, argv + 1);
    if (argc < 3)
        return print_help();
    const cli_command *const command = command_find(argv[2]);
    return command ? command_print_help(command, "--help") : command_unknown(argv[2]);
}

/* Prevents a file opened later from becoming stdout or stderr because the caller closed those. The
 * descriptors are opened for reading, so that printing to a closed stdout still fails. */
static void hold_standard_descriptors(void) {
    int descriptor;
    do
        descriptor = open("/dev/null", O_RDONLY);
    while (descriptor >= 0 && descriptor <= STDERR_FILENO);
    if (descriptor >= 0)
        close(descriptor);
}

static bool reader_is_gone(void) {
    struct pollfd output = { .fd = STDOUT_FILENO };
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/* Closes stdout and reports errors. A reader that has gone away (`| head`) is not reported; a full
 * disk is. */
static int close_output(int status) {
    const bool failed = ferror(stdout) != 0, gone = reader_is_gone();
    /* stdio loses the reason of a failure: another write fails for the same reason */
    const int reason = failed && write(STDOUT_FILENO, "\n", 1) < 0 ? errno : 0;
    errno = 0;
    if (fclose(stdout) == 0 && !failed)
        return status;
    errno = reason ? reason : errno;
    if (!gone && errno != EPIPE) {
        base_error error;
        base_fail(&error, "standard output", "cannot write%s%s", errno ? ": " : "",
                  errno ? strerror(errno) : "");
        base_report(&error);
    }
    return status == BASE_OK ? BASE_FAILURE : status;
}

int main(int argc, char **argv) {
    hold_standard_descriptors();
    /* the calls that fail report a reader that is gone, or a file at the limit of its size */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGCHLD, SIG_DFL); /* if inherited, it may make waiting for a child fail */
    return close_output(run(argc, argv));
}
