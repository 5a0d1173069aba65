/* SPDX-License-Identifier: MIT */
#include "app/view/nodes.h"
#include "app/scene/node.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

/* --- which are hidden ------------------------------------------------------------------------- */

/* Returns how many ranges of hidden instances end before this one. */
static int ranges_before(const view_hidden *h, size_t instance) {
    int at = 0;
    while (at < h->count && h->ranges[at].last < instance)
        at++;
    return at;
}

/* Whether all instances from one to another are hidden. */
static bool are_hidden(const view_hidden *h, size_t first, size_t last) {
    const int at = ranges_before(h, first);
    return at < h->count && h->ranges[at].first <= first && h->ranges[at].last >= last;
}

bool view_node_is_hidden(const view_state *s, size_t node) {
    const size_t first = s->world->nodes[node].first, end = scene_node_end(s->world, node);
    return first < end && are_hidden(&s->now.hidden, first, end - 1);
}

/* Adds a range after those in a list, or joins it to the last one. */
static int add_range(view_range *list, int count, uint32_t first, uint32_t last) {
    if (count > 0 && list[count - 1].last + 1 == first)
        list[--count].last = last;
    else
        list[count] = (view_range) { first, last };
    return count + 1;
}

/* Hides or shows a run of instances; returns false if that takes too many ranges. */
static bool set_hidden(view_hidden *h, view_range run, bool hides) {
    view_range list[VIEW_HIDDEN_MAX + 2];
    int count = 0;
    for (const view_range *r = h->ranges; r < h->ranges + h->count; r++)
        if (r->first < run.first)
            count = add_range(list, count, r->first, r->last < run.first ? r->last : run.first - 1);
    if (hides)
        count = add_range(list, count, run.first, run.last);
    for (const view_range *r = h->ranges; r < h->ranges + h->count; r++)
        if (r->last > run.last)
            count = add_range(list, count, r->first > run.last ? r->first : run.last + 1, r->last);
    if (count > VIEW_HIDDEN_MAX)
        return false;
    *h = (view_hidden) { .count = count };
    memcpy(h->ranges, list, (size_t)count * sizeof *list);
    return true;
}

/* --- actions ---------------------------------------------------------------------------------- */

/* Returns the node under the pointer among those that are seen, or -1. */
static long node_at_pointer(const view_state *s) {
    view_ray ray;
    long instance = view_hit_at_pointer(s, &ray).instance;
    const view_hidden *h = &s->now.hidden;
    for (int i = 0; i < h->count && instance >= (long)h->ranges[i].first; i++)
        instance += (long)h->ranges[i].last - (long)h->ranges[i].first + 1;
    return instance < 0 ? -1 : (long)scene_node_of(s->world, (size_t)instance);
}

/* Finds the instances below the selected node or that under the pointer; else says so and returns
 * -1. */
static long find_node(view_state *s, view_range *run) {
    const long node = s->node >= 0 ? s->node : node_at_pointer(s);
    if (node < 0 || scene_node_end(s->world, (size_t)node) == s->world->nodes[node].first) {
        view_say(s, "Select a node, or point at one");
        return -1;
    }
    *run = (view_range) { s->world->nodes[node].first,
                          (uint32_t)scene_node_end(s->world, (size_t)node) - 1 };
    return node;
}

void view_pick_node(view_state *s, int unused) {
    (void)unused;
    s->node = node_at_pointer(s);
    if (s->node < 0)
        view_say(s, "No node");
    else
        view_say(s, "Node %ld: %s", s->node, scene_node_name(s->world, (size_t)s->node));
}

void view_frame_node(view_state *s, int unused) {
    (void)unused;
    view_range run;
    const long node = find_node(s, &run);
    float lo[3], hi[3];
    if (node < 0 || !scene_node_bounds(s->world, (size_t)node, lo, hi))
        return;
    view_frame_box(s, lo, hi);
}

void view_hide_node(view_state *s, int unused) {
    (void)unused;
    view_range run;
    const long node = find_node(s, &run);
    if (node < 0)
        return;
    const bool hidden = view_node_is_hidden(s, (size_t)node);
    s->requests.nodes = true;
    if (set_hidden(&s->now.hidden, run, !hidden))
        view_say(s, "%s is %s", scene_node_name(s->world, (size_t)node),
                 hidden ? "shown" : "hidden");
    else
        view_say(s, "Too many nodes are hidden one by one");
}

void view_isolate_node(view_state *s, int unused) {
    (void)unused;
    view_range run;
    const long node = find_node(s, &run);
    if (node < 0)
        return;
    s->requests.nodes = true;
    set_hidden(&s->now.hidden, (view_range) { 0, (uint32_t)s->world->instance_count - 1 }, true);
    set_hidden(&s->now.hidden, run, false);
    view_say(s, "%s alone", scene_node_name(s->world, (size_t)node));
}

void view_show_nodes(view_state *s, int unused) {
    (void)unused;
    set_hidden(&s->now.hidden, (view_range) { 0, UINT32_MAX }, false);
    s->requests.nodes = true;
    view_say(s, "All nodes");
}

/* --- what is left ----------------------------------------------------------------------------- */

scene *view_part_make(const scene *whole, const view_settings *settings, base_error *error) {
    scene *part = malloc(sizeof *part);
    scene_instance *instances = malloc((whole->instance_count + 1) * sizeof *instances);
    if (!part || !instances) {
        free(part);
        free(instances);
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    *part = *whole;
    part->instances = instances;
    part->instance_count = part->node_count = 0;
    for (size_t i = 0; i < whole->instance_count; i++)
        if (!settings || !are_hidden(&settings->hidden, i, i))
            instances[part->instance_count++] = whole->instances[i];
    return part;
}

void view_part_free(scene *part) {
    if (part)
        free((void *)(uintptr_t)part->instances);
    free(part);
}
