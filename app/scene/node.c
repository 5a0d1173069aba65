/* SPDX-License-Identifier: MIT */
#include "app/scene/node.h"

#include "app/scene/instance.h"

const char *scene_node_name(const scene *s, size_t number) {
    const scene_node *node = &s->nodes[number];
    if (node->name != SCENE_NO_NODE)
        return s->names + node->name;
    return node->first < scene_node_end(s, number) ? s->meshes[s->instances[node->first].mesh].name
                                                   : "";
}

size_t scene_node_end(const scene *s, size_t node) {
    return s->nodes[node].end < s->node_count ? s->nodes[s->nodes[node].end].first
                                              : s->instance_count;
}

size_t scene_node_of(const scene *s, size_t instance) {
    size_t low = 0, high = s->node_count; /* the last node that begins there or before */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (s->nodes[middle].first <= instance)
            low = middle;
        else
            high = middle;
    }
    return low;
}

bool scene_node_bounds(const scene *s, size_t node, float minimum[3], float maximum[3]) {
    scene below = *s;
    below.instances += s->nodes[node].first;
    below.instance_count = scene_node_end(s, node) - s->nodes[node].first;
    return scene_bounds(&below, minimum, maximum);
}
