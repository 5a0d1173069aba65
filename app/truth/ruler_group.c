/* SPDX-License-Identifier: MIT */
#include "app/truth/ruler_group.h"

#include <math.h>
#include <stdio.h>

static double material_of(const ruler_row *row) {
    return row->material;
}
static double light_of(const ruler_row *row) {
    return row->light;
}
static double roughness_of(const ruler_row *row) {
    return row->material >= RULER_METAL ? row->roughness : (double)NAN;
}
static double exponent_of(const ruler_row *row) {
    return row->material == RULER_PHONG ? row->exponent : (double)NAN;
}
static double distance_of(const ruler_row *row) {
    return row->light == RULER_SPHERE ? 1 / row->size : (double)NAN;
}
static double view_of(const ruler_row *row) {
    return row->view_angle;
}

const ruler_grouping ruler_groupings[RULER_GROUPINGS] = {
    [RULER_BY_MATERIAL] = { "material",
                            material_of,
                            RULER_MATERIALS,
                            { 0, 1, 2, 3 },
                            ruler_material_names },
    [RULER_BY_EXPONENT] = { "exponent", exponent_of, 4, { 1, 10, 100, 1000 }, NULL },
    [RULER_BY_ROUGHNESS] = { "roughness",
                             roughness_of,
                             7,
                             { 0.17, 0.22, 0.3, 0.4, 0.6, 0.8, 1 },
                             NULL },
    [RULER_BY_LIGHT] = { "light", light_of, RULER_LIGHTS, { 0, 1, 2, 3, 4 }, ruler_light_names },
    [RULER_BY_ANGLE] = { "half angle, degrees",
                         ruler_half_angle,
                         6,
                         { 0, 0.01, 1, 10, 40, 90 },
                         NULL },
    [RULER_BY_DISTANCE] = { "distance, radii", distance_of, 6, { 0, 1, 1.2, 2, 10, 100 }, NULL },
    [RULER_BY_VIEW] = { "view angle, degrees", view_of, 5, { 0, 30, 60, 75, 85 }, NULL },
};

static double end_of(const ruler_grouping *by, int group) {
    return group + 1 < by->count ? by->from[group + 1] : (double)INFINITY;
}

bool ruler_in_group(const ruler_grouping *by, int group, const ruler_row *row) {
    const double number = by->of(row);
    return number >= by->from[group] && number < end_of(by, group);
}

void ruler_group_name(const ruler_grouping *by, int group, char *name, size_t size) {
    if (by->names)
        snprintf(name, size, "%s", by->names[group]);
    else if (isinf(end_of(by, group)))
        snprintf(name, size, "from %g", by->from[group]);
    else
        snprintf(name, size, "%g to %g", by->from[group], end_of(by, group));
}
