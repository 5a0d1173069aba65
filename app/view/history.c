/* SPDX-License-Identifier: MIT */
#include "app/view/history.h"

#include <stdlib.h>
#include <string.h>

typedef struct kept_light {
    scene_light light;
    size_t number;
} kept_light;

struct view_moment {
    int hidden_count, material_count;
    view_range hidden[VIEW_HIDDEN_MAX];
    char materials[RENDER_TABLES_MAX][VIEW_MATERIAL_SIZE];
    size_t light_count;
    kept_light lights[];
};

static size_t size_of(size_t light_count) {
    return sizeof(view_moment) + light_count * sizeof(kept_light);
}

static bool is_present(const view_moment *m, const view_settings *now, const size_t *numbers) {
    if (m->light_count != now->light_count || m->material_count != now->material_count ||
        m->hidden_count != now->hidden_count ||
        memcmp(m->hidden, now->hidden, sizeof m->hidden) != 0 ||
        memcmp(m->materials, now->materials, sizeof m->materials) != 0)
        return false;
    for (size_t i = 0; i < m->light_count; i++)
        if (m->lights[i].number != numbers[i] ||
            memcmp(&m->lights[i].light, &now->lights[i], sizeof now->lights[i]) != 0)
            return false;
    return true;
}

static void forget(view_history *h, int index) {
    h->bytes -= size_of(h->moments[index]->light_count);
    free(h->moments[index]);
    h->count--;
    memmove(&h->moments[index], &h->moments[index + 1],
            (size_t)(h->count - index) * sizeof *h->moments);
}

void view_history_keep(view_history *h, const view_settings *now, const size_t *numbers) {
    const size_t size = size_of(now->light_count);
    if (h->count > 0 && is_present(h->moments[h->at], now, numbers))
        return;
    while (h->count > h->at + 1)
        forget(h, h->count - 1);
    while (h->count > 1 && (h->count == VIEW_HISTORY_MAX || h->bytes + size > VIEW_HISTORY_BYTES))
        forget(h, 0);
    view_moment *m = calloc(1, size);
    if (!m) {
        view_history_clear(h); /* undo must not skip a change that could not be kept */
        return;
    }
    m->hidden_count = now->hidden_count;
    memcpy(m->hidden, now->hidden, sizeof m->hidden);
    m->material_count = now->material_count;
    memcpy(m->materials, now->materials, sizeof m->materials);
    m->light_count = now->light_count;
    for (size_t i = 0; i < now->light_count; i++)
        m->lights[i] = (kept_light) { now->lights[i], numbers[i] };
    h->bytes += size;
    h->moments[h->count] = m;
    h->at = h->count++;
}

bool view_history_step(view_history *h, int step, view_settings *now, size_t *numbers) {
    const int to = h->at + step;
    if (to < 0 || to >= h->count)
        return false;
    const view_moment *m = h->moments[to];
    h->at = to;
    now->hidden_count = m->hidden_count;
    memcpy(now->hidden, m->hidden, sizeof m->hidden);
    now->material_count = m->material_count;
    memcpy(now->materials, m->materials, sizeof m->materials);
    memset(now->lights, 0, now->light_count * sizeof *now->lights);
    now->light_count = m->light_count;
    for (size_t i = 0; i < m->light_count; i++) {
        now->lights[i] = m->lights[i].light;
        numbers[i] = m->lights[i].number;
    }
    return true;
}

void view_history_clear(view_history *h) {
    for (int i = 0; i < h->count; i++)
        free(h->moments[i]);
    *h = (view_history) { .count = 0 };
}
