/* SPDX-License-Identifier: MIT */
/* labels.c - the drawings over the image: statistics, help, messages, the selected light's ring. */
#include "app/view/overlay.h"
#include "app/view/panel.h"
#include "app/view/viewer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define PANEL_SECONDS 0.25 /* between updates of the statistics */
enum { PANEL_ROWS = 16 };

enum {
    DRAWING_PANEL,
    DRAWING_HELP,
    DRAWING_MESSAGE,
    DRAWING_RING,
    DRAWING_LEFT,
    DRAWING_RIGHT,
    DRAWING_VALUES
};

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

static int fill_panel(const viewer *v, view_row rows[PANEL_ROWS]) {
    const view_state *s = &v->state;
    const view_settings *d = v->drawn;
    const render_times *t = &v->statistics.times;
    char shading[96], text[96];
    int count = 0;
    add_row(rows, &count, "Lampion", "%s", "");
    add_row(rows, &count, "Scene", "%.100s", d->scene);
    describe_shading(&d->shading[0], shading, sizeof shading);
    add_row(rows, &count, d->split == GPU_SPLIT_NONE ? "Shading" : "Left", "%s", shading);
    if (d->split != GPU_SPLIT_NONE) {
        describe_shading(&d->shading[1], shading, sizeof shading);
        add_row(rows, &count, "Right", "%s", shading);
    }
    describe_lights(s, text, sizeof text);
    add_row(rows, &count, "Lights", "%s", text);
    add_row(rows, &count, "Time", "%s %.2f s%s", s->path_names[s->path], s->seconds,
            s->playing ? "" : ", paused");
    if (v->frame_seconds > 0)
        add_row(rows, &count, "Moving", "%.0f ms a frame, %.1f a second", 1e3 * v->frame_seconds,
                1 / v->frame_seconds);
    add_row(rows, &count, "Image", "%d × %d, sample %d of %d", v->statistics.width,
            v->statistics.height, v->sample < 0 ? 1 : v->sample + 1,
            v->sample < 0 ? 1 : d->samples);
    add_row(rows, &count, "Geometry", "%.1f ms", t->surfaces);
    add_row(rows, &count, "Shading", "%.1f ms on the %s", t->shade,
            device_table[v->statistics.device].text);
    if (t->shadow > 0)
        add_row(rows, &count, "Shadows", "%.1f ms", t->shadow);
    if (t->bounces > 0)
        add_row(rows, &count, "Bounces", "%.1f ms", t->bounces);
    if (t->transfer > 0)
        add_row(rows, &count, "Transfer", "%.1f ms", t->transfer);
    add_row(rows, &count, "Window", "%.1f ms", 1e3 * v->show_seconds);
    if (s->recording)
        add_row(rows, &count, "Recording", "%s, %d frames", v->record, v->recorded);
    return count;
}

/* Uploads a drawing as `index` and stores its size. */
static void upload(viewer *v, int index, view_drawing *drawing) {
    if (drawing->pixels) {
        gpu_screen_upload(view_compositor_screen(v->compositor), index, drawing->width,
                          drawing->height, drawing->pixels);
        v->labels[index].width = drawing->width;
        v->labels[index].height = drawing->height;
    }
    view_drawing_free(drawing);
}

static void put(viewer *v, int index, int x, int y) {
    const gpu_layout layout = { .width = v->drawn->width, .height = v->drawn->height };
    gpu_screen_draw(view_compositor_screen(v->compositor), &layout, index, x, y);
}

/* Whether a label must be drawn again for this text and this room. */
static bool outdated(label *l, const char *text, double scale, int room) {
    if (l->width > 0 && strcmp(l->text, text) == 0 && l->scale == scale && l->room == room)
        return false;
    snprintf(l->text, sizeof l->text, "%s", text);
    l->scale = scale;
    l->room = room;
    return true;
}

static void draw_panel(viewer *v, double scale) {
    label *l = &v->labels[DRAWING_PANEL];
    if (l->width == 0 || l->scale != scale || v->clock >= v->panel_at + PANEL_SECONDS) {
        view_row rows[PANEL_ROWS];
        view_drawing drawing = view_draw_panel(rows, fill_panel(v, rows), scale);
        l->scale = scale;
        v->panel_at = v->clock;
        upload(v, DRAWING_PANEL, &drawing);
    }
    put(v, DRAWING_PANEL, (int)(12 * scale), (int)(12 * scale));
}

/* Draws a line whose box is centered at x, with its lower edge at y. */
static void draw_line(viewer *v, int index, const char *text, double scale, int room, double x,
                      double y) {
    label *l = &v->labels[index];
    if (outdated(l, text, scale, room)) {
        view_drawing drawing = view_draw_message(text, room, scale);
        upload(v, index, &drawing);
    }
    put(v, index, (int)(x - 0.5 * l->width), (int)(y - l->height));
}

static void draw_sides(viewer *v, double scale) {
    const view_settings *d = v->drawn;
    char text[96];
    if (d->split != GPU_SPLIT_DIVIDED)
        return;
    const double middle = (double)d->divider * d->width, gap = 10 * scale;
    for (int side = 0; side < 2; side++) {
        const int index = side ? DRAWING_RIGHT : DRAWING_LEFT;
        describe_shading(&d->shading[side], text, sizeof text);
        /* its width is known once it is drawn */
        draw_line(v, index, text, scale, d->width, -d->width, 0);
        const double half_width = 0.5 * v->labels[index].width + gap;
        put(v, index,
            (int)(middle + (side ? half_width : -half_width) - 0.5 * v->labels[index].width),
            (int)(d->height - 14 * scale - v->labels[index].height));
    }
}

static void draw_ring(viewer *v, double scale) {
    const view_settings *d = v->drawn;
    double x, y, pixels;
    label *l = &v->labels[DRAWING_RING];
    if (v->state.selected < 0 || (size_t)v->state.selected >= d->light_count)
        return;
    const scene_light *light = &d->lights[v->state.selected];
    if (!scene_light_has(light, SCENE_LIGHT_POSITION) ||
        !view_project(&d->camera, d->width, d->height, light->emitter.position, &x, &y, &pixels))
        return;
    const double radius = (double)scene_light_extent(&light->emitter) * pixels + 5 * scale;
    if (!(radius < d->width))
        return;
    char text[32];
    snprintf(text, sizeof text, "%.0f", radius);
    if (outdated(l, text, scale, 0)) {
        view_drawing drawing = view_draw_ring(radius, scale);
        upload(v, DRAWING_RING, &drawing);
    }
    put(v, DRAWING_RING, (int)lround(x - 0.5 * l->width), (int)lround(y - 0.5 * l->height));
}

static void draw_help(viewer *v, double scale) {
    label *l = &v->labels[DRAWING_HELP];
    char text[48];
    snprintf(text, sizeof text, "%d %d", v->drawn->width, v->drawn->height);
    if (outdated(l, text, scale, 0)) {
        view_drawing drawing = view_draw_help(v->drawn->width, v->drawn->height, scale);
        upload(v, DRAWING_HELP, &drawing);
    }
    put(v, DRAWING_HELP, (v->drawn->width - l->width) / 2, (v->drawn->height - l->height) / 2);
}

/* Draws the panel of values, in the upper right corner. */
static void draw_values(viewer *v, double scale) {
    view_row rows[VIEW_PANEL_ROWS];
    const int count = view_panel_rows(&v->state, rows);
    if (count == 0)
        return;
    view_drawing drawing = view_draw_panel(rows, count, scale);
    upload(v, DRAWING_VALUES, &drawing);
    put(v, DRAWING_VALUES, (int)(v->drawn->width - v->labels[DRAWING_VALUES].width - 12 * scale),
        (int)(12 * scale));
}

void view_draw_labels(viewer *v, const char *announcement) {
    const double scale = view_window_scale(v->window);
    const char *message = announcement ? announcement : v->state.message;
    draw_ring(v, scale);
    if (v->state.overlay && !v->state.help) {
        draw_sides(v, scale);
        draw_panel(v, scale);
    }
    if (v->state.help)
        draw_help(v, scale);
    else
        draw_values(v, scale);
    if (message[0])
        draw_line(v, DRAWING_MESSAGE, message, scale, (int)(0.9 * v->drawn->width),
                  0.5 * v->drawn->width, v->drawn->height - 56 * scale);
}
