/* SPDX-License-Identifier: MIT */
#include "app/command/command.h"

#include <stdio.h>
#include <string.h>

extern const cli_command command_basis;
extern const cli_command command_bench;
extern const cli_command command_brdf;
extern const cli_command command_compare;
extern const cli_command command_completion;
extern const cli_command command_doctor;
extern const cli_command command_info;
extern const cli_command command_man;
extern const cli_command command_paper;
extern const cli_command command_project;
extern const cli_command command_reference;
extern const cli_command command_render;
extern const cli_command command_view;

const cli_command *const command_table[] = {
    &command_render,     &command_view,  &command_info,      &command_project,
    &command_brdf,       &command_basis, &command_reference, &command_compare,
    &command_paper,      &command_bench, &command_doctor,    &command_man,
    &command_completion, NULL,
};

const char command_program_summary[] =
    "lights scenes with glowing spheres through spherical harmonics";

const cli_command *command_find(const char *name) {
    for (const cli_command *const *command = command_table; *command; command++)
        if (strcmp((*command)->name, name) == 0)
            return *command;
    return NULL;
}

int command_unknown(const char *name) {
    const char *names[sizeof command_table / sizeof *command_table + 1] = { "help" };
    for (size_t i = 0; command_table[i]; i++)
        names[i + 1] = command_table[i]->name;
    const char *const nearest = cli_nearest(name, names);
    cli_error error;
    if (nearest)
        cli_fail(&error, NULL, "unknown command %s (did you mean %s?); see lampion --help", name,
                 nearest);
    else
        cli_fail(&error, NULL, "unknown command %s; see lampion --help", name);
    cli_report(&error);
    return CLI_USAGE;
}

int command_print_help(const cli_command *command, const char *word) {
    char name[32], help[32];
    snprintf(name, sizeof name, "%s", command->name);
    snprintf(help, sizeof help, "%s", word);
    char *arguments[] = { name, help, NULL };
    return command->run(command, 2, arguments);
}
