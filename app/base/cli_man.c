/* SPDX-License-Identifier: MIT */
/* Manual pages in the macros of man(7), from the tables that make --help. */
#include "app/base/cli.h"
#include "app/base/option.h"

#include <lampion/base.h>

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* Prints text so that roff takes it literally. */
static void print_text(const char *text, int length) {
    if (text[0] == '.' || text[0] == '\'')
        fputs("\\&", stdout);
    for (int i = 0; i < length; i++) {
        if (text[i] == '\\')
            fputs("\\e", stdout);
        else if (text[i] == '-')
            fputs("\\-", stdout);
        else
            putchar(text[i]);
    }
}

static void print_line(const char *text) {
    print_text(text, (int)strlen(text));
    putchar('\n');
}

/* Begins the page of `lampion NAME`, or of lampion itself where name is empty. */
static void print_title(const char *name, const char *summary) {
    const uint32_t version = lmp_version();
    const char *const dash = name[0] ? "\\-" : "";
    printf(".TH LAMPION%s", dash);
    for (const char *c = name; *c; c++)
        putchar(toupper((unsigned char)*c));
    printf(" 1 \"\" \"lampion %u.%u.%u\" \"User Commands\"\n.SH NAME\nlampion%s%s \\- ",
           version >> 16, version >> 8 & 0xFF, version & 0xFF, dash, name);
    print_line(summary);
}

static void print_option(const cli_option *option) {
    char text[OPTION_TEXT_SIZE];
    option_describe(option, text, sizeof text);
    printf(".TP\n");
    if (option->letter)
        printf("\\fB\\-%c\\fR, ", option->letter);
    printf("\\fB\\-\\-");
    print_text(option->name, (int)strlen(option->name));
    printf("\\fR");
    if (option->argument) {
        printf(" \\fI");
        print_text(option->argument, (int)strlen(option->argument));
        printf("\\fR");
    }
    putchar('\n');
    print_line(text);
}

static void print_status(void) {
    printf(".SH \"EXIT STATUS\"\n0 on success, 1 on failure, 2 on wrong usage; "
           "then a line on standard error says why.\n");
}

void option_man(const cli_command *command, const cli_option *options) {
    cli_option rows[OPTIONS_MAX];
    const int count = option_rows(command, options, rows);
    print_title(command->name, command->summary);
    printf(".SH SYNOPSIS\n\\fBlampion %s\\fR [\\fIOPTION\\fR...]", command->name);
    if (command->operands[0]) {
        printf(" \\fI");
        print_text(command->operands, (int)strlen(command->operands));
        printf("\\fR");
    }
    printf("\n.SH OPTIONS\nDefaults are in brackets.\n");
    for (int i = 0; i < count; i++)
        print_option(&rows[i]);
    printf(".SH EXAMPLES\n.nf\n");
    for (const char *line = command->examples; *line;) {
        const int length = (int)strcspn(line, "\n");
        print_text(line, length);
        putchar('\n');
        line += length + (line[length] == '\n');
    }
    printf(".fi\n");
    print_status();
    printf(".SH \"SEE ALSO\"\n\\fBlampion\\fR(1), \\fBlampion\\-formats\\fR(5)\n");
}

void cli_man(const char *summary, const cli_command *const *commands,
             const char *const (*environment)[2]) {
    print_title("", summary);
    printf(".SH SYNOPSIS\n\\fBlampion\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR...]\n"
           ".br\n\\fBlampion\\fR \\fB\\-\\-help\\fR | \\fB\\-\\-version\\fR\n.SH COMMANDS\n"
           "Each has a manual page of its own.\n");
    for (; *commands; commands++) {
        printf(".TP\n\\fBlampion\\-%s\\fR(1)\n", (*commands)->name);
        print_line((*commands)->summary);
    }
    printf(".SH ENVIRONMENT\n");
    for (; (*environment)[0]; environment++) {
        printf(".TP\n\\fB%s\\fR\n", (*environment)[0]);
        print_line((*environment)[1]);
    }
    print_status();
    printf(".SH \"SEE ALSO\"\n\\fBlampion\\-formats\\fR(5) for the files that it reads and writes; "
           "the "
           "package liblampion\\-doc for the documents.\n");
}
