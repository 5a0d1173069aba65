/* SPDX-License-Identifier: MIT */
#include "app/view/script.h"
#include "app/base/file.h"
#include "app/base/number.h"
#include "app/image/image.h"
#include "app/view/aim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_LIMIT  ((size_t)256 << 10)
#define SECONDS_MAX 1e6
#define PIXEL_MAX   1e6
#define SCROLL_MAX  1e3
enum { WORDS_MAX = 5 };

typedef struct words {
    const char *text[WORDS_MAX];
    int count;
    double numbers[WORDS_MAX]; /* the values of words that are numbers */
    bool is_number[WORDS_MAX];
} words;

/* Whether the second word is the last one, with blanks in it. */
static bool takes_the_rest(const char *what, const char *next) {
    static const char *const names[] = { "drop", "shot", "export", "type", "set" };
    bool takes = next[0] == '"';
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        takes = takes || strcmp(what, names[i]) == 0;
    return takes;
}

/* Splits a line at blanks; the last word of some, and one in quotes, may contain some. */
static void split_words(char *line, words *w) {
    *w = (words) { .count = 0 };
    for (size_t length = strlen(line); length > 0 && strchr(" \t", line[length - 1]); length--)
        line[length - 1] = '\0';
    for (char *at = line + strspn(line, " \t"); *at && w->count < WORDS_MAX;) {
        const bool rest = w->count == 2 && takes_the_rest(w->text[1], at);
        char *end = rest ? at + strlen(at) : at + strcspn(at, " \t");
        w->text[w->count] = at;
        w->is_number[w->count] = number_read(at, (size_t)(end - at), &w->numbers[w->count]);
        w->count++;
        at = end + strspn(end, " \t");
        *end = '\0';
    }
}

static bool numbers_at(const words *w, int first, int count, double most) {
    for (int i = first; i < first + count; i++)
        if (i >= w->count || !w->is_number[i] || !(fabs(w->numbers[i]) <= most))
            return false;
    return w->count == first + count;
}

/* Reads an action's name in quotes. */
static bool read_action(const char *quoted, view_script_line *line) {
    const size_t length = strlen(quoted);
    if (length < 3 || quoted[length - 1] != '"' || length - 2 >= sizeof line->text)
        return false;
    memcpy(line->text, quoted + 1, length - 2);
    line->event.kind = VIEW_ACT;
    return view_find_action(line->text) != NULL;
}

/* Reads the event after the time; returns false if the words are not an event. */
static bool read_event(const words *w, view_script_line *line) {
    static const char *const buttons[] = { "left", "middle", "right", NULL };
    view_event *e = &line->event;
    const char *what = w->text[1];
    if (strcmp(what, "move") == 0 || strcmp(what, "size") == 0) {
        e->kind = what[0] == 'm' ? VIEW_MOVE : VIEW_SIZE;
        e->x = w->numbers[2];
        e->y = w->numbers[3];
        return numbers_at(w, 2, 2, PIXEL_MAX) &&
               (e->kind == VIEW_MOVE || (e->x >= 1 && e->y >= 1 && e->x <= 8192 && e->y <= 8192));
    }
    if (strcmp(what, "scroll") == 0) {
        e->kind = VIEW_SCROLL;
        e->y = w->numbers[2];
        return numbers_at(w, 2, 1, SCROLL_MAX);
    }
    if (strcmp(what, "shares") == 0) {
        e->kind = VIEW_ACT;
        strcpy(line->text, "Shares");
        return w->count == 2;
    }
    if (w->count < 3 || w->count > 4)
        return false;
    if (strcmp(what, "press") == 0 && w->text[2][0] == '"')
        return w->count == 3 && read_action(w->text[2], line);
    e->shift = w->count == 4 && strcmp(w->text[3], "shift") == 0;
    if (w->count == 4 && !e->shift)
        return false;
    if (strcmp(what, "press") == 0 || strcmp(what, "release") == 0) {
        e->kind = what[0] == 'p' ? VIEW_PRESS : VIEW_RELEASE;
        const int button = view_find_name(buttons, w->text[2]);
        e->button = button < 0 ? VIEW_LEFT : (view_button)button;
        return button >= 0;
    }
    if (strcmp(what, "hold") == 0 || strcmp(what, "free") == 0) {
        e->kind = what[0] == 'h' ? VIEW_HOLD : VIEW_FREE;
        e->letter = w->text[2][0];
        return strcmp(w->text[2], "ctrl") == 0 ||
               (strlen(w->text[2]) == 1 && strchr("wasdqe", e->letter));
    }
    if (w->count != 3 || strlen(w->text[2]) >= sizeof line->text)
        return false;
    strcpy(line->text, w->text[2]);
    if (strcmp(what, "aim") == 0) {
        e->kind = VIEW_SET;
        const bool known = view_find_name(view_aim_names, line->text) >= 0;
        snprintf(line->text, sizeof line->text, "view/aim %s", w->text[2]);
        return known;
    }
    if (strcmp(what, "shot") == 0) {
        line->kind = VIEW_SCRIPT_SHOT;
        return image_format_of(line->text) == IMAGE_PNG;
    }
    if (strcmp(what, "export") == 0) {
        const char *dot = strrchr(line->text, '.');
        line->kind = VIEW_SCRIPT_EXPORT;
        return (dot && strcmp(dot, ".json") == 0) || scene_is_gltf(line->text);
    }
    e->kind = what[0] == 'k'   ? VIEW_KEY
              : what[0] == 'd' ? VIEW_DROP
              : what[0] == 's' ? VIEW_SET
                               : VIEW_TYPE;
    if (strcmp(what, "drop") == 0 || strcmp(what, "type") == 0 || strcmp(what, "set") == 0)
        return true;
    return strcmp(what, "key") == 0 && view_find_key(line->text);
}

static bool read_lines(const char *path, char *text, view_script *script, base_error *error) {
    int number = 0;
    double before = 0;
    for (char *line = text, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        number++;
        line[strcspn(line, "#\r")] = '\0';
        words w;
        split_words(line, &w);
        if (w.count == 0)
            continue;
        view_script_line *to = &script->lines[script->count];
        if (w.count < 2 || !w.is_number[0] || !(w.numbers[0] >= before) ||
            !(w.numbers[0] <= SECONDS_MAX))
            return base_fail(
                error, path,
                "line %d is not an event: SECONDS, not less than before, up to 1e6, then "
                "what happens",
                number);
        to->seconds = before = w.numbers[0];
        if (!read_event(&w, to))
            return base_fail(error, path, "line %d: %s is not understood as it is written", number,
                             w.text[1]);
        script->count++;
    }
    /* texts have their final addresses now */
    for (size_t i = 0; i < script->count; i++)
        script->lines[i].event.text = script->lines[i].text;
    return true;
}

bool view_script_read(const char *path, view_script *script, base_error *error) {
    void *data;
    size_t size, lines = 1;
    *script = (view_script) { .count = 0 };
    if (!file_read(path, FILE_LIMIT, &data, &size, error))
        return false;
    char *text = data;
    for (size_t i = 0; i < size; i++)
        lines += text[i] == '\n';
    bool ok = strlen(text) == size || base_fail(error, path, "is not text");
    /* an event has at least "0 key m" */
    script->lines = calloc(lines < size / 7 + 1 ? lines : size / 7 + 1, sizeof *script->lines);
    ok = ok && (script->lines || base_fail(error, path, "out of memory")) &&
         read_lines(path, text, script, error);
    free(data);
    if (!ok)
        view_script_free(script);
    return ok;
}

void view_script_free(view_script *script) {
    free(script->lines);
    *script = (view_script) { .count = 0 };
}
