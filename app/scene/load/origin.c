/* SPDX-License-Identifier: MIT */
#include "app/scene/load/origin.h"

#include "app/scene/center.h"
#include "app/scene/instance.h"

#include <math.h>
#include <string.h>

/* Whether an instance brings its mesh from far away into a scene of that length. */
static bool brings_from_afar(const scene *s, const scene_instance *instance, double length) {
    const scene_mesh *mesh = &s->meshes[instance->mesh];
    for (int k = 0; k < 3; k++) {
        double way = 0.0;
        for (int i = 0; i < 3; i++)
            way += 0.5 * (double)instance->world_from_mesh[k][i] *
                   ((double)mesh->minimum[i] + (double)mesh->maximum[i]);
        if (center_is_far(fabs(way), length))
            return true;
    }
    return false;
}

/* Whether another origin would gain digits, and which. */
static bool find_origin(const scene_builder *builder, double origin[3]) {
    float low[3], high[3];
    scene s;
    builder_geometry(builder, &s);
    if (!scene_bounds(&s, low, high))
        return false;
    bool far = center_find(low, high, origin);
    for (size_t i = 0; i < s.instance_count && !far; i++)
        far = brings_from_afar(&s, &s.instances[i], center_length(low, high));
    return far;
}

bool origin_read(origin_reader *read, const void *data, size_t size, source_set *sources,
                 scene_builder *builder, base_error *error) {
    double origin[3] = { 0.0, 0.0, 0.0 };
    if (!read(data, size, sources, builder, error))
        return false;
    if (!find_origin(builder, origin))
        return true;
    builder_free(builder);
    memcpy(builder->origin, origin, sizeof origin);
    builder->centers_meshes = true;
    return read(data, size, sources, builder, error);
}
