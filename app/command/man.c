/* SPDX-License-Identifier: MIT */
/* man.c - lampion man: the manual pages. */
#include "app/base/cli.h"
#include "app/command/command.h"

static const char *const environment[][2] = {
    { "XDG_CACHE_HOME", "The cache is the folder lampion in it, or in ~/.cache if it is not set." },
    { "LAMPION_CACHE_MIB",
      "The most that the cache may hold, in MiB; what was not used for longest is removed first." },
    { "LAMPION_DATA",
      "The folder of the scenes and materials of the paper that lampion paper shows." },
    { "LAMPION_GL_DEBUG", "If it is fatal, OpenGL checks every call and the first complaint ends "
                          "the program." },
    { "TERM", "Progress is shown on terminals alone, and on none that is dumb. There are no "
              "colors." },
    { NULL, NULL },
};

static int run(const cli_command *command, int argc, char **argv) {
    int count, status;
    char **operands;
    if (!cli_parse_operands(command, argc, argv, &count, &operands, &status))
        return status;
    if (count > 1)
        return cli_usage(command, "shows one page, not %d", count);
    if (count == 0) {
        cli_man(command_program_summary, command_table, environment);
        return BASE_OK;
    }
    const cli_command *const wanted = command_find(operands[0]);
    return wanted ? command_print_help(wanted, "--help=man") : command_unknown(operands[0]);
}

const cli_command command_man = {
    .name = "man",
    .operands = "[COMMAND]",
    .summary = "print the manual page of the program or a command",
    .examples = "lampion man render > lampion-render.1\n",
    .run = run,
};
