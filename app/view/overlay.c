/* SPDX-License-Identifier: MIT */
#include "app/view/overlay.h"

#include "app/base/shared_library.h"
#include "app/view/state.h"

#include <math.h>
#include <pango/pangocairo.h>
#include <string.h>

#define FAMILY "Sans"
enum { HELP_COLUMNS_MAX = 3, HELP_ROWS_MAX = 80 };

typedef struct color {
    double r, g, b, a;
} color;

static const color paper = { 0.05, 0.06, 0.08, 0.78 }, solid_paper = { 0.05, 0.06, 0.08, 0.93 };
static const color ink = { 0.95, 0.95, 0.94, 1 }, pale = { 0.66, 0.69, 0.74, 1 };
static const color accent = { 1.0, 0.74, 0.38, 1 };

/* What is used of Pango and Cairo, which only drawings open. */
/* clang-format off */
#define TEXT_FUNCTIONS(X)                                                                          \
    X(cairo_arc) X(cairo_close_path) X(cairo_create) X(cairo_destroy) X(cairo_fill)                \
    X(cairo_image_surface_create) X(cairo_image_surface_get_data) X(cairo_move_to)                 \
    X(cairo_new_sub_path) X(cairo_set_line_width) X(cairo_set_source_rgba) X(cairo_status)         \
    X(cairo_stroke) X(cairo_stroke_preserve) X(cairo_surface_destroy) X(cairo_surface_flush)       \
    X(g_free) X(g_object_unref) X(g_utf8_make_valid) X(pango_attr_font_features_new)               \
    X(pango_attr_list_insert) X(pango_attr_list_new) X(pango_attr_list_unref)                      \
    X(pango_cairo_font_map_get_default) X(pango_cairo_show_layout)                                 \
    X(pango_font_description_copy) X(pango_font_description_free)                                  \
    X(pango_font_description_from_string) X(pango_font_description_set_absolute_size)              \
    X(pango_font_description_set_weight) X(pango_font_map_create_context)                          \
    X(pango_layout_get_pixel_size) X(pango_layout_new) X(pango_layout_set_attributes)              \
    X(pango_layout_set_font_description) X(pango_layout_set_text) X(pango_layout_set_width)        \
    X(pango_layout_set_wrap) X(pango_version_string)
/* clang-format on */
static struct { TEXT_FUNCTIONS(SHARED_LIBRARY_POINTER) } lib;
static const char *const functions[] = { TEXT_FUNCTIONS(SHARED_LIBRARY_NAME) };

static bool open_library(base_error *error) {
    return shared_library_open(PANGO_SONAME, functions, sizeof functions / sizeof *functions, &lib,
                               error);
}

/* Whether there is a library to draw by; without it drawings have no pixels. */
static bool can_draw(void) {
    base_error error;
    return open_library(&error);
}

/* --- surfaces --------------------------------------------------------------------------------- */

static cairo_t *begin(view_drawing *drawing, double width, double height) {
    drawing->width = (int)ceil(fmax(width, 1));
    drawing->height = (int)ceil(fmax(height, 1));
    drawing->surface =
        lib.cairo_image_surface_create(CAIRO_FORMAT_ARGB32, drawing->width, drawing->height);
    return lib.cairo_create(drawing->surface);
}

static void end(cairo_t *cairo, view_drawing *drawing) {
    const bool ok = lib.cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
    lib.cairo_destroy(cairo);
    lib.cairo_surface_flush(drawing->surface);
    drawing->pixels = ok ? lib.cairo_image_surface_get_data(drawing->surface) : NULL;
}

void view_drawing_free(view_drawing *drawing) {
    if (drawing->surface)
        lib.cairo_surface_destroy(drawing->surface);
    *drawing = (view_drawing) { .width = 0 };
}

static void set_color(cairo_t *cairo, color c) {
    lib.cairo_set_source_rgba(cairo, c.r, c.g, c.b, c.a);
}

static void rounded_box(cairo_t *cairo, double width, double height, double radius, color fill) {
    const double quarter = 0.5 * G_PI;
    lib.cairo_new_sub_path(cairo);
    lib.cairo_arc(cairo, width - radius, radius, radius, -quarter, 0);
    lib.cairo_arc(cairo, width - radius, height - radius, radius, 0, quarter);
    lib.cairo_arc(cairo, radius, height - radius, radius, quarter, 2 * quarter);
    lib.cairo_arc(cairo, radius, radius, radius, 2 * quarter, 3 * quarter);
    lib.cairo_close_path(cairo);
    set_color(cairo, fill);
    lib.cairo_fill(cairo);
}

/* --- text ------------------------------------------------------------------------------------- */

typedef struct writer {
    PangoContext *context;
    PangoFontDescription *font;
    double size; /* pixels */
} writer;

static writer open_writer(double points, double scale) {
    writer w = { lib.pango_font_map_create_context(lib.pango_cairo_font_map_get_default()),
                 lib.pango_font_description_from_string(FAMILY), points * scale * 96 / 72 };
    lib.pango_font_description_set_absolute_size(w.font, w.size * PANGO_SCALE);
    return w;
}

static void close_writer(writer *w) {
    lib.g_object_unref(w->context);
    lib.pango_font_description_free(w->font);
}

static PangoLayout *write_text(const writer *w, const char *text, bool bold) {
    PangoLayout *layout = lib.pango_layout_new(w->context);
    PangoFontDescription *font = lib.pango_font_description_copy(w->font);
    if (bold)
        lib.pango_font_description_set_weight(font, PANGO_WEIGHT_BOLD);
    lib.pango_layout_set_font_description(layout, font);
    lib.pango_font_description_free(font);
    PangoAttrList *attributes = lib.pango_attr_list_new();
    lib.pango_attr_list_insert(attributes, lib.pango_attr_font_features_new("tnum=1"));
    lib.pango_layout_set_attributes(layout, attributes);
    lib.pango_attr_list_unref(attributes);
    gchar *valid = lib.g_utf8_make_valid(text, -1);
    lib.pango_layout_set_text(layout, valid, -1);
    lib.g_free(valid);
    return layout;
}

static int width_of(const writer *w, const char *text, bool bold) {
    int width, height;
    PangoLayout *layout = write_text(w, text, bold);
    lib.pango_layout_get_pixel_size(layout, &width, &height);
    lib.g_object_unref(layout);
    return width;
}

static void put_text(cairo_t *cairo, const writer *w, double x, double y, const char *text,
                     bool bold, color c) {
    PangoLayout *layout = write_text(w, text, bold);
    set_color(cairo, c);
    lib.cairo_move_to(cairo, x, y);
    lib.pango_cairo_show_layout(cairo, layout);
    lib.g_object_unref(layout);
}

/* --- the panel -------------------------------------------------------------------------------- */

view_drawing view_draw_panel(const view_row *rows, int count, double scale) {
    view_drawing drawing = { .width = 0 };
    if (!can_draw())
        return drawing;
    writer w = open_writer(9.5, scale);
    const double line = 1.55 * w.size, margin = 0.9 * w.size;
    double names = 0, values = 0;
    for (int i = 0; i < count; i++) {
        if (rows[i].value[0])
            names = fmax(names, width_of(&w, rows[i].name, false) + 1.1 * w.size);
        values = fmax(values, width_of(&w, rows[i].value[0] ? rows[i].value : rows[i].name,
                                       !rows[i].value[0]) -
                                  (rows[i].value[0] ? 0 : names));
    }
    const double width = names + values + 2 * margin,
                 height = count * line + 2 * margin - 0.4 * w.size;
    cairo_t *cairo = begin(&drawing, width, height);
    rounded_box(cairo, width, height, 0.7 * w.size, paper);
    for (int i = 0; i < count; i++) {
        const double y = margin + i * line;
        const bool heading = !rows[i].value[0];
        const color name = heading || rows[i].chosen ? accent : pale;
        put_text(cairo, &w, margin, y, rows[i].name, heading, name);
        put_text(cairo, &w, margin + names, y, rows[i].value, false, ink);
    }
    end(cairo, &drawing);
    close_writer(&w);
    return drawing;
}

/* --- the help --------------------------------------------------------------------------------- */

typedef struct help_layout {
    int first[HELP_COLUMNS_MAX + 1]; /* the first row of each column */
    int columns;
    double keys, texts; /* widths */
} help_layout;

static bool is_heading(const view_key *row) {
    return !row->help;
}

static int list_rows(const view_key *rows[HELP_ROWS_MAX]) {
    int count = 0;
    for (const view_key *key = view_keys; key->key || key->shown; key++)
        if (key->shown && count < HELP_ROWS_MAX)
            rows[count++] = key;
    return count;
}

/* Breaks columns at headings so that the longest column is short. */
static void break_columns(const view_key *const *rows, int count, int columns, help_layout *l) {
    l->columns = columns;
    l->first[0] = 0;
    for (int c = 1; c < columns; c++) {
        const int wanted = count * c / columns;
        int best = l->first[c - 1];
        for (int i = l->first[c - 1] + 1; i < count; i++)
            if (is_heading(rows[i]) &&
                (best == l->first[c - 1] || abs(i - wanted) < abs(best - wanted)))
                best = i;
        l->first[c] = best;
    }
    l->first[columns] = count;
}

static int longest_column(const help_layout *l) {
    int longest = 0;
    for (int c = 0; c < l->columns; c++)
        longest = MAX(longest, l->first[c + 1] - l->first[c]);
    return longest;
}

static double help_width(const help_layout *l, double size) {
    return l->columns * (l->keys + l->texts) + (l->columns - 1) * 2.2 * size + 3.2 * size;
}

static void draw_rows(cairo_t *cairo, const writer *w, const view_key *const *rows,
                      const help_layout *l) {
    const double line = 1.5 * w->size, margin = 1.6 * w->size;
    for (int c = 0; c < l->columns; c++) {
        const double x = margin + c * (l->keys + l->texts + 2.2 * w->size);
        for (int i = l->first[c]; i < l->first[c + 1]; i++) {
            const double y = margin + (i - l->first[c] + 2) * line;
            const bool heading = is_heading(rows[i]);
            put_text(cairo, w, x, y, rows[i]->shown, heading, heading ? accent : ink);
            if (!heading)
                put_text(cairo, w, x + l->keys, y, rows[i]->help, false, pale);
        }
    }
}

view_drawing view_draw_help(int width, int height, double scale) {
    view_drawing drawing = { .width = 0 };
    const view_key *rows[HELP_ROWS_MAX];
    const int count = list_rows(rows);
    help_layout l = { .columns = 0 };
    writer w;
    double needed = 0, tall = 0;
    if (!can_draw())
        return drawing;
    /* use the largest font that fits */
    for (double points = 10; points >= 4; points -= 0.5) {
        w = open_writer(points, scale);
        l.keys = l.texts = 0;
        for (int i = 0; i < count; i++) {
            if (is_heading(rows[i]))
                continue;
            l.keys = fmax(l.keys, width_of(&w, rows[i]->shown, false) + w.size);
            l.texts = fmax(l.texts, width_of(&w, rows[i]->help, false));
        }
        bool fits = false;
        for (int columns = 2; columns <= HELP_COLUMNS_MAX && !fits; columns++) {
            break_columns(rows, count, columns, &l);
            needed = help_width(&l, w.size);
            tall = (longest_column(&l) + 2) * 1.5 * w.size + 2.8 * w.size;
            fits = needed <= width && tall <= height;
        }
        if (fits || points <= 4)
            break;
        close_writer(&w);
    }
    cairo_t *cairo = begin(&drawing, fmin(needed, 16384), fmin(tall, 16384));
    rounded_box(cairo, needed, tall, w.size, solid_paper);
    put_text(cairo, &w, 1.6 * w.size, 1.3 * w.size, "lampion view", true, ink);
    draw_rows(cairo, &w, rows, &l);
    end(cairo, &drawing);
    close_writer(&w);
    return drawing;
}

/* --- messages and marks ----------------------------------------------------------------------- */

view_drawing view_draw_message(const char *text, int width, double scale) {
    view_drawing drawing = { .width = 0 };
    if (!can_draw())
        return drawing;
    writer w = open_writer(10.5, scale);
    const double margin = 0.8 * w.size, room = fmax(width - 2 * margin, w.size);
    PangoLayout *layout = write_text(&w, text, false);
    lib.pango_layout_set_width(layout, (int)(room * PANGO_SCALE));
    lib.pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
    int wide, tall;
    lib.pango_layout_get_pixel_size(layout, &wide, &tall);
    cairo_t *cairo = begin(&drawing, wide + 2 * margin, tall + 1.4 * margin);
    rounded_box(cairo, drawing.width, drawing.height, 0.6 * w.size, paper);
    set_color(cairo, ink);
    lib.cairo_move_to(cairo, margin, 0.7 * margin);
    lib.pango_cairo_show_layout(cairo, layout);
    lib.g_object_unref(layout);
    end(cairo, &drawing);
    close_writer(&w);
    return drawing;
}

view_drawing view_draw_ring(double radius, double scale) {
    view_drawing drawing = { .width = 0 };
    if (!can_draw())
        return drawing;
    const double side = 2 * (radius + 4 * scale);
    cairo_t *cairo = begin(&drawing, side, side);
    const double middle = 0.5 * drawing.width;
    lib.cairo_arc(cairo, middle, middle, radius, 0, 2 * G_PI);
    lib.cairo_set_source_rgba(cairo, 0, 0, 0, 0.6);
    lib.cairo_set_line_width(cairo, 4 * scale);
    lib.cairo_stroke_preserve(cairo);
    lib.cairo_set_source_rgba(cairo, 1, 1, 1, 0.95);
    lib.cairo_set_line_width(cairo, 1.8 * scale);
    lib.cairo_stroke(cairo);
    end(cairo, &drawing);
    return drawing;
}

bool view_overlay_version(char *text, size_t size, base_error *error) {
    if (!open_library(error))
        return false;
    snprintf(text, size, "%s", lib.pango_version_string());
    return true;
}
