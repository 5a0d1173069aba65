/* SPDX-License-Identifier: MIT */
#include "app/study/paper.h"
#include "app/base/cli.h"
#include "app/command/command.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int run_line(int argc, char **argv) {
    const cli_command *const command = argc > 0 ? command_find(argv[0]) : NULL;
    return command ? command->run(command, argc, argv) : BASE_USAGE;
}

/* Resolves the folders to absolute paths: those given, else that of the environment. */
static bool find_folders(cli_list *folders, base_error *error) {
    const char *const usual = getenv("LAMPION_DATA");
    if (folders->count == 0 && usual && *usual)
        folders->items[folders->count++] = usual;
    for (int i = 0; i < folders->count; i++) {
        const char *const given = folders->items[i];
        folders->items[i] = realpath(given, NULL); /* kept until the program ends */
        if (!folders->items[i])
            return base_fail(error, given, "is no folder: %s", strerror(errno));
    }
    return true;
}

static int run(const cli_command *command, int argc, char **argv) {
    paper_options settings = { .run = run_line };
    char step_help[512];
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &settings.directory, "DIR",
          "the folder to write index.html into", 0, 0, NULL, NULL },
        { "data", 0, CLI_LIST, &settings.data, "DIR",
          "where the paper's scenes and materials are, or in data there (docs/paper.md); without "
          "it the folder in LAMPION_DATA; may be repeated",
          0, 0, NULL, NULL },
        { "quick", 0, CLI_FLAG, &settings.quick, NULL,
          "smaller images, for a reader who waits, instead of the paper's sizes", 0, 0, NULL,
          NULL },
        { "step", 0, CLI_LIST, &settings.steps, "NAME",
          paper_step_help(step_help, sizeof step_help), 0, 0, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    int count, status, failures;
    char **operands;
    base_error error;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (!settings.directory)
        return cli_usage_output(command, "DIR");
    for (int i = 0; i < settings.steps.count; i++)
        if (!paper_has_step(settings.steps.items[i], &error))
            return cli_usage(command, "%s", error.text);
    if (!find_folders(&settings.data, &error) || !paper_write(&settings, &failures, &error))
        return base_report(&error);
    printf("%s/index.html\n", settings.directory);
    return failures ? BASE_FAILURE : BASE_OK;
}

const cli_command command_paper = {
    .name = "paper",
    .operands = "",
    .summary = "make the paper's figures and tables again, as one page",
    .examples = "lampion paper -o out\n"
                "lampion paper -o out --quick\n"
                "lampion paper -o out --data scenes --step sponza\n",
    .run = run,
    .kernels = true,
};
