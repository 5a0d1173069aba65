/* SPDX-License-Identifier: MIT */
/* find.c - finds a command by its name. */
#include "app/base/choice.h"
#include "app/base/cli.h"
#include "app/command/command.h"

#include <stdio.h>
#include <string.h>

#define COMMANDS_MAX 32 /* among which a message looks for a similar name */

const cli_command *command_find(const char *name) {
    for (const cli_command *const *command = command_table; *command; command++)
        if (strcmp((*command)->name, name) == 0)
            return *command;
    return NULL;
}

/* Says what an unknown first word may be meant as: a file, an option, or a command. */
static void explain(const char *word, base_error *error) {
    const char *names[COMMANDS_MAX + 2] = { "help" };
    for (size_t i = 0; i < COMMANDS_MAX && command_table[i]; i++)
        names[i + 1] = command_table[i]->name;
    const bool is_option = word[0] == '-';
    const char *const options[] = { "--help", "--version", NULL };
    const char *const kind = is_option ? "option" : "command";
    const char *const nearest = choice_nearest(word, is_option ? options : names);
    if (!is_option && strpbrk(word, "./"))
        base_fail(error, NULL, "%s is not a command: lampion render %s -o image.png draws a scene",
                  word, word);
    else if (nearest)
        base_fail(error, NULL, "unknown %s %s (did you mean %s?); see lampion --help", kind, word,
                  nearest);
    else
        base_fail(error, NULL, "unknown %s %s; see lampion --help", kind, word);
}

int command_unknown(const char *name) {
    base_error error;
    explain(name, &error);
    base_report(&error);
    return BASE_USAGE;
}

int command_print_help(const cli_command *command, const char *word) {
    char name[32], help[32];
    snprintf(name, sizeof name, "%s", command->name);
    snprintf(help, sizeof help, "%s", word);
    char *arguments[] = { name, help, NULL };
    return command->run(command, 2, arguments);
}
