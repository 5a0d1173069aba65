/* SPDX-License-Identifier: MIT */
/* labels.c - what the drawings over the image say: statistics, help, messages, the handles of the
 * selected light. */
#include "app/base/file.h"
#include "app/view/handles.h"
#include "app/view/overlay.h"
#include "app/view/panel.h"
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define STATISTICS_SECONDS 0.25 /* between updates, in which they can be read */
enum { STATISTICS_ROWS = 11 + VIEW_PASSES };

static void add_row(view_row *rows, int *count, const char *name, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void add_row(view_row *rows, int *count, const char *name, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    view_row *row = &rows[(*count)++];
    row->chosen = false;
    snprintf(row->name, sizeof row->name, "%s", name);
    vsnprintf(row->value, sizeof row->value, format, arguments);
    va_end(arguments);
}

static void describe_shading(const view_shading *shading, char *text, size_t size) {
    snprintf(text, size, "%s, %d band%s%s%s", method_table[shading->method].name, shading->bands,
             shading->bands == 1 ? "" : "s", shading->window == LMP_WINDOW_NONE ? "" : ", ",
             shading->window == LMP_WINDOW_NONE ? "" : lmp_sh_window_name(shading->window));
}

/* Describes the lights, such as "30, number 4: sphere, radius 0.2". */
static void describe_lights(const view_state *s, char *text, size_t size) {
    int used = snprintf(text, size, "%zu", s->now.light_count);
    if (s->selected < 0)
        return;
    const lmp_light *light = &s->now.lights[s->selected].emitter;
    used += snprintf(text + used, size - (size_t)used, ", number %d: %s", s->selected,
                     scene_light_kinds[light->kind].name);
    if (light->radius > 0)
        snprintf(text + used, size - (size_t)used, ", radius %.3g", (double)light->radius);
}

/* Takes the times to be shown: those of an image, but not more often than can be read. */
static void take_statistics(viewer *v, bool fresh) {
    if (!fresh || (v->told.sample >= 0 && v->clock < v->told.at + STATISTICS_SECONDS &&
                   v->sample < v->drawn->samples - 1))
        return;
    v->told = (view_told) { .statistics = v->statistics,
                            .frame_seconds = v->frame_seconds,
                            .show_seconds = v->show_seconds,
                            .at = v->clock,
                            .sample = v->sample < 0 ? 0 : v->sample,
                            .samples = v->sample < 0 ? 1 : v->drawn->samples };
}

static int fill_statistics(const viewer *v, view_row rows[STATISTICS_ROWS]) {
    const view_state *s = &v->state;
    const view_settings *d = v->drawn;
    const view_told *told = &v->told;
    view_pass passes[VIEW_PASSES];
    const int pass_count = view_passes(v, passes);
    char shading[96], text[96];
    int count = 0;
    add_row(rows, &count, "Lampion", "%s", "");
    add_row(rows, &count, "Scene", "%.60s", file_base_name(d->scene));
    describe_shading(&d->shading[0], shading, sizeof shading);
    add_row(rows, &count, d->split == GPU_SPLIT_NONE ? "Shading" : "Left", "%s", shading);
    if (d->split != GPU_SPLIT_NONE) {
        describe_shading(&d->shading[1], shading, sizeof shading);
        add_row(rows, &count, "Right", "%s", shading);
    }
    describe_lights(s, text, sizeof text);
    add_row(rows, &count, "Lights", "%s", text);
    add_row(rows, &count, "Time", "%s %.2f s%s", s->paths.names[s->paths.at], s->seconds,
            s->playing ? "" : ", paused");
    if (told->frame_seconds > 0)
        add_row(rows, &count, "Moving", "%.0f ms a frame, %.1f a second", 1e3 * told->frame_seconds,
                1 / told->frame_seconds);
    if (v->percent > 0)
        add_row(rows, &count, "In work", "%d %%", v->percent);
    if (told->samples == 0) /* nothing was drawn yet */
        return count;
    add_row(rows, &count, "Image", "%d × %d, sample %d of %d", told->statistics.width,
            told->statistics.height, told->sample + 1, told->samples);
    add_row(rows, &count, "Device", "%s", device_table[told->statistics.device].text);
    for (int i = 0; i < pass_count; i++)
        add_row(rows, &count, passes[i].name, "%.1f ms", passes[i].ms);
    if (s->recording)
        add_row(rows, &count, "Recording", "%s, %d frames", v->record, v->recorded);
    return count;
}

/* Says at the divider how each side is shaded. */
static void draw_sides(const viewer *v, double scale) {
    const view_settings *d = v->drawn;
    const double middle = (double)d->divider * d->width, gap = 10 * scale;
    char text[96];
    for (int side = 0; side < 2 && d->split == GPU_SPLIT_DIVIDED; side++) {
        describe_shading(&d->shading[side], text, sizeof text);
        view_draw_message(text, d->width, middle + (side ? gap : -gap), d->height - 14 * scale,
                          side ? 0 : 1);
    }
}

static ui_color color_of(view_handle_kind handle) {
    static const ui_color of_axes[] = { UI_RED, UI_GREEN, UI_BLUE };
    const bool moves = handle >= VIEW_HANDLE_X && handle <= VIEW_HANDLE_XY;
    return moves ? of_axes[(handle - VIEW_HANDLE_X) % 3] : UI_INK;
}

/* Draws the handles of the selected light, or the ring around it; the one under the pointer stands
 * out. */
static void draw_handles(const view_state *s, bool covered) {
    view_marks marks;
    view_find_marks(s, &marks);
    const view_handle_kind chosen = s->drag == VIEW_DRAG_HANDLE ? s->grip.handle
                                    : s->drag == VIEW_DRAG_NONE && !covered
                                        ? view_handle_at_pointer(s, &marks)
                                        : VIEW_HANDLE_NONE;
    for (int i = 0; i < marks.count; i++) {
        const view_mark *mark = &marks.of[i];
        const bool stands_out = chosen != VIEW_HANDLE_NONE && mark->handle == chosen;
        const bool pale = mark->handle == VIEW_HANDLE_NONE && mark->shape == UI_OPEN;
        ui_path(mark->at, mark->count, mark->shape, stands_out ? 3 : 1.8,
                stands_out ? UI_ACCENT : color_of(mark->handle),
                (marks.hidden ? 0.45 : 0.95) * (pale ? 0.6 : 1));
    }
}

/* Tells beside the pointer what the drag of a handle does. */
static void draw_drag(const view_state *s) {
    const bool is_right = s->x > 0.5 * s->now.width;
    const double gap = 20 * s->scale;
    char text[64];
    if (s->drag != VIEW_DRAG_HANDLE)
        return;
    view_handle_describe(s, text, sizeof text);
    view_draw_message(text, s->now.width, s->x + (is_right ? -gap : gap), fmax(s->y, 2 * gap),
                      is_right);
}

/* Draws the panel of values, its upper right corner at x, y. */
static void draw_values(const viewer *v, double x, double y) {
    view_row rows[VIEW_PANEL_ROWS];
    const int count = view_panel_rows(&v->state, rows);
    if (count > 0)
        view_draw_rows(rows, count, x, y, 1, UI_SOLID_PAPER); /* over the statistics */
}

/* Describes the window while the first scene is read. */
static void lay_out_waiting(viewer *v) {
    char text[64], percent[16] = "";
    bool open = true;
    ui_begin(v->state.now.width, v->state.now.height, v->state.scale, 0.01);
    if (ui_sidebar_begin(VIEW_SIDEBAR_TITLE, VIEW_SIDEBAR_WIDTH * v->state.scale, &open)) {
        ui_text(file_base_name(v->state.now.scene));
        if (v->percent > 0)
            snprintf(percent, sizeof percent, "  %d %%", v->percent);
        snprintf(text, sizeof text, "%s%s", v->announcement, percent);
        ui_text(text);
        if (ui_button("Cancel", "Close the window (Escape)", false))
            v->state.requests.quit = true;
    }
    ui_sidebar_end();
    v->laid = ui_end();
}

void view_lay_out(viewer *v, const char *announcement, bool fresh) {
    if (!v->state.world) {
        lay_out_waiting(v);
        return;
    }
    const double scale = v->state.scale;
    const char *message = announcement ? announcement : v->state.message;
    const int width = v->state.now.width, height = v->state.now.height;
    const bool covered = ui_covered();
    view_row rows[STATISTICS_ROWS];
    take_statistics(v, fresh);
    ui_begin(width, height, scale, v->clock - v->laid_at);
    v->laid_at = v->clock;
    if (!v->state.help) {
        draw_handles(&v->state, covered);
        draw_drag(&v->state);
    }
    if (v->state.overlay && !v->state.help) {
        draw_sides(v, scale);
        view_draw_rows(rows, fill_statistics(v, rows), 12 * scale, 12 * scale, 0, UI_PAPER);
    }
    const double right = v->uncovered = v->state.help ? width : view_draw_sidebar(v);
    if (v->state.help)
        view_draw_help(width, height, &v->state.help_scroll);
    else
        draw_values(v, right - 12 * scale, (v->state.sidebar ? 12 : 32) * scale);
    if (message[0])
        view_draw_message(message, 0.9 * right, 0.5 * right, height - 56 * scale, 0.5);
    v->laid = ui_end();
}
