/* SPDX-License-Identifier: MIT */
#include "app/view/shares.h"

#include "app/base/file_json.h"
#include "app/image/srgb.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Shares that a message names. */
enum { NAMED = 4 };

/* --- finding ---------------------------------------------------------------------------------- */

static double luminance(lmp_rgb color) {
    return image_luminance((const float[3]) { color.r, color.g, color.b });
}

static void add(lmp_rgb *sum, lmp_rgb color) {
    sum->r += color.r;
    sum->g += color.g;
    sum->b += color.b;
}

static void append(view_shares *shares, int light, const char *name, lmp_rgb radiance) {
    if (radiance.r == 0 && radiance.g == 0 && radiance.b == 0)
        return;
    shares->of[shares->count++] = (view_share) { light, name, radiance, 0 };
    add(&shares->radiance, radiance);
}

static const char *kind_of(const view_settings *settings, size_t light) {
    return scene_light_kinds[settings->lights[light].emitter.kind].name;
}

/* Lists what a surface reflects and emits, and counts suns of the environment as parts of it. */
static void list_surface(const view_settings *settings, const cpu_split *split, size_t light_count,
                         view_shares *shares) {
    lmp_rgb around = split->environment;
    for (size_t i = 0; i < light_count; i++)
        if (i < settings->light_count)
            append(shares, (int)i, kind_of(settings, i), split->lights[i]);
        else
            add(&around, split->lights[i]);
    append(shares, -1, "environment", around);
    append(shares, -1, "bounces", split->bounced);
    append(shares, -1, "emission", split->emission);
}

static int compare(const void *a, const void *b) {
    const view_share *first = a, *second = b;
    if (first->percent != second->percent)
        return first->percent > second->percent ? -1 : 1;
    return first->light - second->light;
}

static void sort(view_shares *shares) {
    const double all = luminance(shares->radiance);
    for (size_t i = 0; i < shares->count && all > 0; i++)
        shares->of[i].percent = 100 * luminance(shares->of[i].radiance) / all;
    qsort(shares->of, shares->count, sizeof *shares->of, compare);
}

bool view_shares_find(view_compositor *compositor, const view_settings *settings, int side, int x,
                      int y, view_shares *shares, base_error *error) {
    size_t count = 0;
    cpu_split split = { .lights = calloc(SCENE_LIGHTS_MAX, sizeof *split.lights) };
    view_share *of = calloc(settings->light_count + 3, sizeof *of);
    bool ok = (split.lights && of) || base_fail(error, NULL, "out of memory");
    ok = ok && view_compositor_split(compositor, settings, side, x, y, &split, &count, error);
    view_shares_free(shares);
    if (ok) {
        *shares = (view_shares) { .x = x, .y = y, .side = side, .of = of };
        const size_t light = split.seen - RENDER_SEES_LIGHT;
        if (split.seen < RENDER_SEES_LIGHT)
            list_surface(settings, &split, count, shares);
        else if (split.seen != RENDER_SEES_NOTHING && light < settings->light_count)
            append(shares, (int)light, kind_of(settings, light),
                   settings->lights[light].emitter.radiance);
        sort(shares);
    } else {
        free(of);
    }
    free(split.lights);
    return ok;
}

void view_shares_free(view_shares *shares) {
    free(shares->of);
    memset(shares, 0, sizeof *shares);
}

/* --- showing ---------------------------------------------------------------------------------- */

static void print(const view_share *share, char *text, size_t size) {
    const double percent = round(share->percent) + 0.0; /* not -0 */
    if (share->light >= 0)
        snprintf(text, size, "%.0f %% light %d (%s)", percent, share->light, share->name);
    else
        snprintf(text, size, "%.0f %% %s", percent, share->name);
}

void view_shares_describe(const view_shares *shares, char *text, size_t size) {
    const size_t named = shares->count < NAMED ? shares->count : NAMED;
    char row[64];
    snprintf(text, size, "%s", named > 0 ? "" : "No light reaches what is there");
    for (size_t i = 0; i < named; i++) {
        const size_t used = strlen(text);
        print(&shares->of[i], row, sizeof row);
        snprintf(text + used, size - used, "%s%s", i ? ", " : "", row);
    }
    const size_t used = strlen(text);
    if (shares->count > named)
        snprintf(text + used, size - used, ", %zu more", shares->count - named);
}

static json_t *share_to_json(const view_share *share) {
    json_t *row = json_object();
    if (share->light >= 0)
        row = file_json_with(row, "light", json_integer(share->light));
    row = file_json_with(row, "kind", file_json_string(share->name));
    row = file_json_with(row, "radiance", file_json_floats(&share->radiance.r, 3));
    return file_json_with(row, "percent", file_json_real(share->percent));
}

json_t *view_shares_to_json(const view_shares *shares) {
    json_t *rows = json_array();
    for (size_t i = 0; i < shares->count; i++)
        rows = file_json_append(rows, share_to_json(&shares->of[i]));
    json_t *root =
        json_pack("{s:i, s:i, s:i}", "x", shares->x, "y", shares->y, "side", shares->side);
    root = file_json_with(root, "radiance", file_json_floats(&shares->radiance.r, 3));
    return file_json_with(root, "of", rows);
}
