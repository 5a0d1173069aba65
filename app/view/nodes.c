/* SPDX-License-Identifier: MIT */
#include "app/view/nodes.h"
#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

/* --- which are hidden ------------------------------------------------------------------------- */

/* Returns how many ranges of hidden nodes end before this node. */
static int ranges_before(const view_settings *s, size_t node) {
    int at = 0;
    while (at < s->hidden_count && s->hidden[at].last < node)
        at++;
    return at;
}

bool view_node_is_hidden(const view_settings *s, size_t node) {
    const int at = ranges_before(s, node);
    return at < s->hidden_count && s->hidden[at].first <= node;
}

static void remove_range(view_settings *s, int at) {
    s->hidden_count--;
    memmove(s->hidden + at, s->hidden + at + 1, (size_t)(s->hidden_count - at) * sizeof *s->hidden);
    memset(s->hidden + s->hidden_count, 0, sizeof *s->hidden);
}

static bool insert_range(view_settings *s, int at, uint32_t first, uint32_t last) {
    if (s->hidden_count == VIEW_HIDDEN_MAX)
        return false;
    memmove(s->hidden + at + 1, s->hidden + at,
            (size_t)(s->hidden_count++ - at) * sizeof *s->hidden);
    s->hidden[at] = (view_range) { first, last };
    return true;
}

/* Hides a node that is seen; returns false if there is no room for another range. */
static bool hide(view_settings *s, uint32_t node) {
    const int at = ranges_before(s, node);
    const bool after = at > 0 && s->hidden[at - 1].last + 1 == node;
    const bool before = at < s->hidden_count && s->hidden[at].first == node + 1;
    if (after)
        s->hidden[at - 1].last = before ? s->hidden[at].last : node;
    else if (before)
        s->hidden[at].first = node;
    if (after && before)
        remove_range(s, at);
    return after || before || insert_range(s, at, node, node);
}

/* Shows a hidden node; returns false as hide does. */
static bool unhide(view_settings *s, uint32_t node) {
    const int at = ranges_before(s, node);
    view_range *range = &s->hidden[at];
    if (range->first == node && range->last == node)
        remove_range(s, at);
    else if (range->first == node)
        range->first++;
    else if (range->last == node)
        range->last--;
    else if (insert_range(s, at, range->first, node - 1))
        range[1].first = node + 1;
    else
        return false;
    return true;
}

/* --- actions ---------------------------------------------------------------------------------- */

/* Returns the node under the pointer among those that are seen, or -1. */
static long node_at_pointer(const view_state *s) {
    view_ray ray;
    long node = view_hit_at_pointer(s, &ray).instance;
    for (int i = 0; i < s->now.hidden_count && node >= (long)s->now.hidden[i].first; i++)
        node += (long)s->now.hidden[i].last - (long)s->now.hidden[i].first + 1;
    return node;
}

/* Returns the selected node or that under the pointer; else says so and returns -1. */
static long find_node(view_state *s) {
    const long node = s->node >= 0 ? s->node : node_at_pointer(s);
    if (node < 0)
        view_say(s, "Select a node, or point at one");
    return node;
}

static const char *name_of(const view_state *s, long node) {
    return s->world->meshes[s->world->instances[node].mesh].name;
}

void view_pick_node(view_state *s, int unused) {
    (void)unused;
    s->node = node_at_pointer(s);
    if (s->node < 0)
        view_say(s, "No node");
    else
        view_say(s, "Node %ld: %s", s->node, name_of(s, s->node));
}

void view_frame_node(view_state *s, int unused) {
    (void)unused;
    const long node = find_node(s);
    float lo[3], hi[3];
    if (node < 0)
        return;
    scene_instance_box(s->world, (size_t)node, lo, hi);
    const lmp_vec3 a = vec_load(lo), b = vec_load(hi);
    view_frame(&s->now.camera, vec_scale(vec_add(a, b), 0.5f), 0.5f * vec_length(vec_sub(b, a)),
               (float)s->now.width / (float)s->now.height);
}

void view_hide_node(view_state *s, int unused) {
    (void)unused;
    const long node = find_node(s);
    if (node < 0)
        return;
    const bool hidden = view_node_is_hidden(&s->now, (size_t)node);
    s->requests.nodes = true;
    if ((hidden ? unhide : hide)(&s->now, (uint32_t)node))
        view_say(s, "%s is %s", name_of(s, node), hidden ? "shown" : "hidden");
    else
        view_say(s, "Too many nodes are hidden one by one");
}

void view_isolate_node(view_state *s, int unused) {
    (void)unused;
    const long node = find_node(s);
    const uint32_t count = (uint32_t)s->world->instance_count;
    if (node < 0)
        return;
    view_show_nodes(s, 0);
    if (node > 0)
        insert_range(&s->now, 0, 0, (uint32_t)node - 1);
    if ((uint32_t)node + 1 < count)
        insert_range(&s->now, s->now.hidden_count, (uint32_t)node + 1, count - 1);
    view_say(s, "%s alone", name_of(s, node));
}

void view_show_nodes(view_state *s, int unused) {
    (void)unused;
    memset(s->now.hidden, 0, sizeof s->now.hidden);
    s->now.hidden_count = 0;
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
    part->instance_count = 0;
    for (size_t i = 0; i < whole->instance_count; i++)
        if (!settings || !view_node_is_hidden(settings, i))
            instances[part->instance_count++] = whole->instances[i];
    return part;
}

void view_part_free(scene *part) {
    if (part)
        free((void *)(uintptr_t)part->instances);
    free(part);
}
