/* SPDX-License-Identifier: MIT */
#include "app/base/error.h"

#include "app/base/printable.h"
#include "app/base/progress.h"
#include "app/base/terminal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Replaces control characters: names of files are untrusted, and a terminal would obey what is in
 * them. */
static void replace_controls(char *text) {
    while (*text) {
        const size_t length = printable_length(text);
        if (length == 0)
            *text = '?';
        text += length ? length : 1;
    }
}

static void write_text(base_error *error, const char *subject, const char *format,
                       va_list arguments) __attribute__((format(printf, 3, 0)));

static void write_text(base_error *error, const char *subject, const char *format,
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

bool base_fail(base_error *error, const char *subject, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    write_text(error, subject, format, arguments);
    va_end(arguments);
    return false;
}

bool base_is_out_of_memory(const base_error *error) {
    static const char *const endings[] = { " memory", " memory of this machine", " outofmem" };
    const size_t length = strlen(error->text);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t tail = strlen(endings[i]);
        if (length >= tail && strcmp(error->text + length - tail, endings[i]) == 0)
            return true;
    }
    return false;
}

/* Whether color is allowed, as https://no-color.org defines it: NO_COLOR with any value but an
 * empty one forbids it. */
static bool takes_color(void) {
    const char *const refused = getenv("NO_COLOR");
    return !(refused && *refused) && terminal_can_draw();
}

/* Prints "lampion: text"; `color` is a parameter of ANSI's Select Graphic Rendition. */
static void print_line(const char *color, const char *text) {
    progress_end();
    if (takes_color())
        fprintf(stderr, "\033[%smlampion:\033[0m %s\n", color, text);
    else
        fprintf(stderr, "lampion: %s\n", text);
}

int base_report(const base_error *error) {
    print_line("1;31", error->text);
    return BASE_FAILURE;
}

void base_note(const char *subject, const char *format, ...) {
    base_error note;
    va_list arguments;
    if (terminal_is_quiet())
        return;
    va_start(arguments, format);
    write_text(&note, subject, format, arguments);
    va_end(arguments);
    print_line("33", note.text);
}
