/* SPDX-License-Identifier: MIT */
/* cli_rows.c - the options that commands take besides those of their own tables. */
#include "app/base/cli.h"
#include "app/base/option.h"

#include <lampion/cpu.h>

cli_option cli_cpu_mask(int *mask) {
    return (cli_option) {
        .name = "cpu-mask",
        .kind = CLI_INT,
        .target = mask,
        .argument = "N",
        .help = "instruction sets: the sum of 1 scalar, 2 SSE2 or NEON, 4 AVX2, 8 AVX-512",
        .minimum = LMP_CPU_SCALAR,
        .maximum = LMP_CPU_ALL,
    };
}

cli_option option_quiet(bool *quiet) {
    return (cli_option) {
        .name = "quiet",
        .letter = 'q',
        .kind = CLI_FLAG,
        .target = quiet,
        .help = "print errors alone: no notes, no progress",
    };
}

int option_rows(const cli_command *command, const cli_option *options, cli_option *rows) {
    static int every = LMP_CPU_ALL;
    static bool quiet;
    int count = 0;
    for (; options[count].name && count < OPTIONS_MAX - 3; count++)
        rows[count] = options[count];
    if (command->kernels)
        rows[count++] = cli_cpu_mask(&every);
    rows[count++] = option_quiet(&quiet);
    rows[count++] = (cli_option) { .name = "help", .letter = 'h', .help = "this text" };
    return count;
}
