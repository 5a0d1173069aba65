/* SPDX-License-Identifier: MIT */
#include "app/paper/paper.h"
#include "app/command/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int run_line(int argc, char **argv) {
    const cli_command *const command = argc > 0 ? command_find(argv[0]) : NULL;
    return command ? command->run(command, argc, argv) : CLI_USAGE;
}

/* The path as seen from anywhere. */
static bool make_absolute(const char **path, cli_error *error) {
    if (!*path || strncmp(*path, "builtin:", 8) == 0)
        return true;
    const char *given = *path;
    *path = realpath(given, NULL);
    return *path || cli_fail(error, given, "does not exist");
}

static int run(const cli_command *command, int argc, char **argv) {
    paper_options settings = { .run = run_line };
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &settings.directory, "DIR",
          "the folder to write index.html into", 0, 0, NULL, NULL },
        { "full", 0, CLI_FLAG, &settings.full, NULL, "images as large as the paper's", 0, 0, NULL,
          NULL },
        { "san-miguel", 0, CLI_TEXT, &settings.san_miguel, "FILE", "the scene of figure 1", 0, 0,
          NULL, NULL },
        { "sponza", 0, CLI_TEXT, &settings.sponza, "FILE", "the scene of figure 5", 0, 0, NULL,
          NULL },
        { "step", 0, CLI_LIST, &settings.steps, "NAME",
          "only this step, of: basis lights cap integral operations table san-miguel sponza "
          "materials cost preintegrated gradients fields shadows; "
          "may be repeated",
          0, 0, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    int count, status, failures;
    char **operands;
    cli_error error;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (!settings.directory)
        return cli_usage_output(command, "DIR");
    for (int i = 0; i < settings.steps.count; i++)
        if (!paper_has_step(settings.steps.items[i], &error))
            return cli_usage(command, "%s", error.text);
    if (!make_absolute(&settings.san_miguel, &error) || !make_absolute(&settings.sponza, &error) ||
        !paper_write(&settings, &failures, &error))
        return cli_report(&error);
    printf("%s/index.html\n", settings.directory);
    return failures ? CLI_FAILURE : CLI_OK;
}

const cli_command command_paper = {
    .name = "paper",
    .operands = "",
    .summary = "make the paper's figures and tables again, as one page",
    .examples = "lampion paper -o out\n"
                "lampion paper -o out --full --sponza Sponza.gltf\n",
    .run = run,
    .kernels = true,
};
