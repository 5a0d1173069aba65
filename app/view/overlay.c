/* SPDX-License-Identifier: MIT */
#include "app/view/overlay.h"
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

/* --- surfaces --------------------------------------------------------------------------------- */

static cairo_t *begin(view_drawing *drawing, double width, double height) {
    drawing->width = (int)ceil(fmax(width, 1));
    drawing->height = (int)ceil(fmax(height, 1));
    drawing->surface =
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, drawing->width, drawing->height);
    return cairo_create(drawing->surface);
}

static void end(cairo_t *cairo, view_drawing *drawing) {
    const bool ok = cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
    cairo_destroy(cairo);
    cairo_surface_flush(drawing->surface);
    drawing->pixels = ok ? cairo_image_surface_get_data(drawing->surface) : NULL;
}

void view_drawing_free(view_drawing *drawing) {
    if (drawing->surface)
        cairo_surface_destroy(drawing->surface);
    *drawing = (view_drawing) { .width = 0 };
}

static void set_color(cairo_t *cairo, color c) {
    cairo_set_source_rgba(cairo, c.r, c.g, c.b, c.a);
}

static void rounded_box(cairo_t *cairo, double width, double height, double radius, color fill) {
    const double quarter = 0.5 * G_PI;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, width - radius, radius, radius, -quarter, 0);
    cairo_arc(cairo, width - radius, height - radius, radius, 0, quarter);
    cairo_arc(cairo, radius, height - radius, radius, quarter, 2 * quarter);
    cairo_arc(cairo, radius, radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(cairo);
    set_color(cairo, fill);
    cairo_fill(cairo);
}

/* --- text ------------------------------------------------------------------------------------- */

typedef struct writer {
    PangoContext *context;
    PangoFontDescription *font;
    double size; /* pixels */
} writer;

static writer open_writer(double points, double scale) {
    writer w = { pango_font_map_create_context(pango_cairo_font_map_get_default()),
                 pango_font_description_from_string(FAMILY), points * scale * 96 / 72 };
    pango_font_description_set_absolute_size(w.font, w.size * PANGO_SCALE);
    return w;
}

static void close_writer(writer *w) {
    g_object_unref(w->context);
    pango_font_description_free(w->font);
}

static PangoLayout *write_text(const writer *w, const char *text, bool bold) {
    PangoLayout *layout = pango_layout_new(w->context);
    PangoFontDescription *font = pango_font_description_copy(w->font);
    if (bold)
        pango_font_description_set_weight(font, PANGO_WEIGHT_BOLD);
    pango_layout_set_font_description(layout, font);
    pango_font_description_free(font);
    PangoAttrList *attributes = pango_attr_list_new();
    pango_attr_list_insert(attributes, pango_attr_font_features_new("tnum=1"));
    pango_layout_set_attributes(layout, attributes);
    pango_attr_list_unref(attributes);
    gchar *valid = g_utf8_make_valid(text, -1);
    pango_layout_set_text(layout, valid, -1);
    g_free(valid);
    return layout;
}

static int width_of(const writer *w, const char *text, bool bold) {
    int width, height;
    PangoLayout *layout = write_text(w, text, bold);
    pango_layout_get_pixel_size(layout, &width, &height);
    g_object_unref(layout);
    return width;
}

static void put_text(cairo_t *cairo, const writer *w, double x, double y, const char *text,
                     bool bold, color c) {
    PangoLayout *layout = write_text(w, text, bold);
    set_color(cairo, c);
    cairo_move_to(cairo, x, y);
    pango_cairo_show_layout(cairo, layout);
    g_object_unref(layout);
}

/* --- the panel -------------------------------------------------------------------------------- */

view_drawing view_draw_panel(const view_row *rows, int count, double scale) {
    view_drawing drawing = { .width = 0 };
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
    int first[HELP_COLUMNS_MAX + 1]; /* the row that begins a column */
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

/* Breaks columns at headings, so that the longest is short. */
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
    /* as large as fits */
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
    writer w = open_writer(10.5, scale);
    const double margin = 0.8 * w.size, room = fmax(width - 2 * margin, w.size);
    PangoLayout *layout = write_text(&w, text, false);
    pango_layout_set_width(layout, (int)(room * PANGO_SCALE));
    pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
    int wide, tall;
    pango_layout_get_pixel_size(layout, &wide, &tall);
    cairo_t *cairo = begin(&drawing, wide + 2 * margin, tall + 1.4 * margin);
    rounded_box(cairo, drawing.width, drawing.height, 0.6 * w.size, paper);
    set_color(cairo, ink);
    cairo_move_to(cairo, margin, 0.7 * margin);
    pango_cairo_show_layout(cairo, layout);
    g_object_unref(layout);
    end(cairo, &drawing);
    close_writer(&w);
    return drawing;
}

view_drawing view_draw_ring(double radius, double scale) {
    view_drawing drawing = { .width = 0 };
    const double side = 2 * (radius + 4 * scale);
    cairo_t *cairo = begin(&drawing, side, side);
    const double middle = 0.5 * drawing.width;
    cairo_arc(cairo, middle, middle, radius, 0, 2 * G_PI);
    cairo_set_source_rgba(cairo, 0, 0, 0, 0.6);
    cairo_set_line_width(cairo, 4 * scale);
    cairo_stroke_preserve(cairo);
    cairo_set_source_rgba(cairo, 1, 1, 1, 0.95);
    cairo_set_line_width(cairo, 1.8 * scale);
    cairo_stroke(cairo);
    end(cairo, &drawing);
    return drawing;
}
