/* SPDX-License-Identifier: MIT */
#include "app/view/history.h"

#include <stdlib.h>
#include <string.h>

/* What is undone and redone is the end of the settings, from the hidden nodes on. */
enum { BEGINNING = offsetof(view_settings, hidden) };

struct view_moment {
    size_t light_count;
    unsigned char bytes[]; /* the end of the settings; then the numbers of the lights */
};

static size_t end_size(size_t light_count) {
    return offsetof(view_settings, lights) - BEGINNING + light_count * sizeof(scene_light);
}

static size_t size_of(size_t light_count) {
    return sizeof(view_moment) + end_size(light_count) + light_count * sizeof(size_t);
}

static bool is_present(const view_moment *m, const view_settings *now, const size_t *numbers) {
    const size_t end = end_size(m->light_count);
    return m->light_count == now->light_count &&
           memcmp(m->bytes, (const char *)now + BEGINNING, end) == 0 &&
           memcmp(m->bytes + end, numbers, m->light_count * sizeof *numbers) == 0;
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
    m->light_count = now->light_count;
    memcpy(m->bytes, (const char *)now + BEGINNING, end_size(m->light_count));
    memcpy(m->bytes + end_size(m->light_count), numbers, m->light_count * sizeof *numbers);
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
    memset(now->lights, 0, now->light_count * sizeof *now->lights);
    memcpy((char *)now + BEGINNING, m->bytes, end_size(m->light_count));
    memcpy(numbers, m->bytes + end_size(m->light_count), m->light_count * sizeof *numbers);
    return true;
}

void view_history_clear(view_history *h) {
    for (int i = 0; i < h->count; i++)
        free(h->moments[i]);
    *h = (view_history) { .count = 0 };
}
