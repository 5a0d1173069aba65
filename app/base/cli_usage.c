/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* strsep */
#include "app/base/choice.h"
#include "app/base/cli.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int cli_usage(const cli_command *command, const char *format, ...) {
    char text[sizeof(base_error)];
    base_error error;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    base_fail(&error, NULL, "%s", text);
    fprintf(stderr, "lampion %s: %s; see lampion %s --help\n", command->name, error.text,
            command->name);
    return BASE_USAGE;
}

int cli_usage_operand(const cli_command *command, const char *word) {
    char words[128];
    const char *names[16] = { NULL };
    base_error error;
    snprintf(words, sizeof words, "%.*s", (int)strcspn(command->operands, " "), command->operands);
    char *rest = words;
    for (size_t i = 0; i < sizeof names / sizeof *names - 1 && rest; i++)
        names[i] = strsep(&rest, "|");
    choice_fail(&error, NULL, word, names);
    return cli_usage(command, "%s", error.text);
}

int cli_usage_output(const cli_command *command, const char *argument) {
    return cli_usage(command, "-o %s is needed", argument);
}
