/* SPDX-License-Identifier: MIT */
#include "app/base/cli.h"
#include "app/base/option.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TEXT_COLUMN 28
#define LAST_COLUMN 92

/* Prints text from `column` on, broken at blanks and indented to TEXT_COLUMN. */
static void print_wrapped(const char *text, int column) {
    while (*text) {
        const int length = (int)strcspn(text, " ");
        if (column > TEXT_COLUMN && column + 1 + length > LAST_COLUMN) {
            printf("\n%*s", TEXT_COLUMN, "");
            column = TEXT_COLUMN;
        } else if (column > TEXT_COLUMN) {
            putchar(' ');
            column++;
        }
        printf("%.*s", length, text);
        column += length;
        text += length + (int)strspn(text + length, " ");
    }
    putchar('\n');
}

/* Appends the values that the option accepts: its range, or its choices. */
static void describe_values(const cli_option *option, char *text, size_t size) {
    size_t used = strlen(text);
    if (option->choices) {
        for (int i = 0; option->choices[i] && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : ": ",
                                     option->choices[i]);
        return;
    }
    if (option->kind == CLI_PART)
        return; /* the name of its argument tells the values */
    if (option->minimum == -option->maximum && (option->maximum == 0.0 || option->maximum > 1e9))
        return; /* no limits, or none that anybody reaches */
    const int digits = option_digits(option);
    if (option->maximum > 1e9 && option->minimum >= 0.0)
        snprintf(text + used, size - used, "; at least %.*g", digits, option->minimum);
    else
        snprintf(text + used, size - used, "; %.*g to %.*g", digits, option->minimum, digits,
                 option->maximum);
}

/* Appends the default, which the target holds before parsing. */
static void describe_default(const cli_option *option, char *text, size_t size) {
    char value[64] = "";
    switch (option->kind) {
    case CLI_INT:
        snprintf(value, sizeof value, "%d", *(const int *)option->target);
        break;
    case CLI_SEED:
        snprintf(value, sizeof value, "%llu",
                 (unsigned long long)*(const uint64_t *)option->target);
        break;
    case CLI_FLOAT:
        if (isfinite(*(const float *)option->target))
            snprintf(value, sizeof value, "%g", (double)*(const float *)option->target);
        break;
    case CLI_VEC3: {
        const float *const v = option->target;
        snprintf(value, sizeof value, "%g,%g,%g", (double)v[0], (double)v[1], (double)v[2]);
        break;
    }
    case CLI_POSITION: {
        const double *const v = option->target;
        snprintf(value, sizeof value, "%g,%g,%g", v[0], v[1], v[2]);
        break;
    }
    case CLI_SIZE:
        snprintf(value, sizeof value, "%dx%d", ((const int *)option->target)[0],
                 ((const int *)option->target)[1]);
        break;
    case CLI_GRID: {
        const int *const v = option->target;
        snprintf(value, sizeof value, "%dx%dx%d", v[0], v[1], v[2]);
        break;
    }
    case CLI_PART:
        snprintf(value, sizeof value, "%d/%d", ((const int *)option->target)[0],
                 ((const int *)option->target)[1]);
        break;
    case CLI_CHOICE:
        snprintf(value, sizeof value, "%s", option->choices[*(const int *)option->target]);
        break;
    case CLI_TEXT:
        if (*(const char *const *)option->target)
            snprintf(value, sizeof value, "%s", *(const char *const *)option->target);
        break;
    case CLI_FLAG:
    case CLI_RANGE:
    case CLI_NUMBERS:
    case CLI_LIST:
        break;
    }
    const size_t used = strlen(text);
    if (value[0])
        snprintf(text + used, size - used, " [%s]", value);
}

void option_describe(const cli_option *option, char *text, size_t size) {
    snprintf(text, size, "%s", option->help);
    describe_values(option, text, size);
    if (!option->given)
        describe_default(option, text, size);
}

static void print_option(const cli_option *option) {
    char letter[8] = "    ";
    if (option->letter)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    int column = printf("  %s--%s%s%s", letter, option->name, option->argument ? " " : "",
                        option->argument ? option->argument : "");
    char text[OPTION_TEXT_SIZE];
    option_describe(option, text, sizeof text);
    if (column > TEXT_COLUMN - 2) {
        putchar('\n');
        column = 0;
    }
    printf("%*s", TEXT_COLUMN - column, "");
    print_wrapped(text, TEXT_COLUMN);
}

void option_help(const cli_command *command, const cli_option *options) {
    printf("lampion %s: %s\n\nUsage: lampion %s [OPTION…]%s%s\n\nOptions [default]:\n",
           command->name, command->summary, command->name, command->operands[0] ? " " : "",
           command->operands);
    cli_option rows[OPTIONS_MAX];
    const int count = option_rows(command, options, rows);
    for (int i = 0; i < count; i++)
        print_option(&rows[i]);
    printf("\nExamples:\n");
    for (const char *line = command->examples; *line;) {
        const int length = (int)strcspn(line, "\n");
        printf("  %.*s\n", length, line);
        line += length + (line[length] == '\n');
    }
}
