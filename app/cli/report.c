/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* strsep */
#include "app/cli/cli.h"
#include "app/cli/option.h"
#include "app/cli/printable.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names of files are untrusted: a terminal must not obey what is in them. */
static void replace_controls(char *text) {
    while (*text) {
        const size_t length = cli_printable(text);
        if (length == 0)
            *text = '?';
        text += length ? length : 1;
    }
}

static void write_text(cli_error *error, const char *subject, const char *format, va_list arguments)
    __attribute__((format(printf, 3, 0)));

static void write_text(cli_error *error, const char *subject, const char *format,
                       va_list arguments) {
    const size_t size = sizeof error->text;
    /* a name may take at most half of the line, so that what is wrong is always said */
    const char *name = subject && !*subject ? "\"\"" : subject;
    int length = name ? snprintf(error->text, size, "%.*s: ", (int)size / 2, name) : 0;
    length += vsnprintf(error->text + length, size - (size_t)length, format, arguments);
    if (length >= (int)size)
        memcpy(error->text + size - 4, "...", 4);
    replace_controls(error->text);
}

bool cli_fail(cli_error *error, const char *subject, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_text(error, subject, format, arguments);
    va_end(arguments);
    return false;
}

bool cli_is_out_of_memory(const cli_error *error) {
    static const char *const endings[] = { " memory", " memory of this machine", " outofmem" };
    const size_t length = strlen(error->text);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t tail = strlen(endings[i]);
        if (length >= tail && strcmp(error->text + length - tail, endings[i]) == 0)
            return true;
    }
    return false;
}

bool cli_fail_word(cli_error *error, const char *subject, const char *word,
                   const char *const *names) {
    char known[512] = "";
    size_t length = 0;
    for (size_t i = 0; names[i] && length < sizeof known - 1; i++)
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "",
                                   names[i][0] ? names[i] : "\"\"");
    if (length >= sizeof known)
        memcpy(known + sizeof known - 4, "...", 4);
    const char *const nearest = cli_nearest(word, names);
    return cli_fail(error, subject, "\"%s\" is not one of %s%s%s%s", word, known,
                    nearest ? " (did you mean " : "", nearest ? nearest : "", nearest ? "?)" : "");
}

bool cli_fail_member(cli_error *error, const char *subject, const char *kind, const char *word,
                     const char *first, size_t stride, size_t count) {
    enum { NAMES = 64 };
    const char *names[NAMES + 1] = { NULL };
    char where[512];
    for (size_t i = 0; i < count && i < NAMES; i++)
        names[i] = first + i * stride;
    snprintf(where, sizeof where, "%.400s: no such %s", subject, kind);
    return count ? cli_fail_word(error, where, word, names)
                 : cli_fail(error, where, "\"%s\", for there is none", word);
}

/* A member of the row `index` of a table; `first` is that of its first row. */
static const char *row_member(const char *const *first, size_t stride, int index) {
    return *(const char *const *)(const void *)((const char *)first + (size_t)index * stride);
}

void cli_row_names(const char *const *first, size_t stride, int count, const char **names) {
    for (int i = 0; i < count; i++)
        names[i] = row_member(first, stride, i);
    names[count] = NULL;
}

const char *cli_row_help(const char *what, const char *const *name, const char *const *help,
                         size_t stride, int count, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "%s", what);
    for (int i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s %s", i ? ", " : ": ",
                                 row_member(name, stride, i), row_member(help, stride, i));
    return text;
}

/* As https://no-color.org has it: any value but an empty one. */
static bool takes_color(void) {
    const char *const refused = getenv("NO_COLOR");
    return !(refused && *refused) && cli_is_terminal();
}

/* `color` is a parameter of ANSI's Select Graphic Rendition. */
static void print_line(const char *color, const char *text) {
    cli_progress_end();
    if (takes_color())
        fprintf(stderr, "\033[%smlampion:\033[0m %s\n", color, text);
    else
        fprintf(stderr, "lampion: %s\n", text);
}

int cli_report(const cli_error *error) {
    print_line("1;31", error->text);
    return CLI_FAILURE;
}

void cli_note(const char *subject, const char *format, ...) {
    cli_error note;
    va_list arguments;
    if (cli_is_quiet())
        return;
    va_start(arguments, format);
    write_text(&note, subject, format, arguments);
    va_end(arguments);
    print_line("33", note.text);
}

int cli_usage_operand(const cli_command *command, const char *word) {
    char words[128];
    const char *names[16] = { NULL };
    cli_error error;
    snprintf(words, sizeof words, "%.*s", (int)strcspn(command->operands, " "), command->operands);
    char *rest = words;
    for (size_t i = 0; i < sizeof names / sizeof *names - 1 && rest; i++)
        names[i] = strsep(&rest, "|");
    cli_fail_word(&error, NULL, word, names);
    return cli_usage(command, "%s", error.text);
}

int cli_usage_output(const cli_command *command, const char *argument) {
    return cli_usage(command, "-o %s is needed", argument);
}

int cli_usage(const cli_command *command, const char *format, ...) {
    cli_error error;
    va_list arguments;
    va_start(arguments, format);
    write_text(&error, NULL, format, arguments);
    va_end(arguments);
    fprintf(stderr, "lampion %s: %s; see lampion %s --help\n", command->name, error.text,
            command->name);
    return CLI_USAGE;
}
