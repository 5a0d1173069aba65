/* SPDX-License-Identifier: MIT */
/* rows.h - rows of the ruler's table as lights, materials and surfaces: z is the normal, the viewer
 * is at azimuth 0, and a light's azimuth is counted from the mirror direction's, 180 degrees. */
#ifndef LAMPION_RULER_ROWS_H
#define LAMPION_RULER_ROWS_H

#include "app/base/cli.h"
#include "app/truth/ruler_table.h"
#include "tests/oracle/check.h"

#include <lampion/shade.h>

#include <math.h>

#define RADIANS (acos(-1) / 180)

static inline void ruler_direction(double angle, double azimuth, double direction[3]) {
    direction[0] = -sin(angle * RADIANS) * cos(azimuth * RADIANS);
    direction[1] = sin(angle * RADIANS) * sin(azimuth * RADIANS);
    direction[2] = cos(angle * RADIANS);
}

static inline lmp_vec3 to_floats(const double v[3]) {
    return (lmp_vec3) { (float)v[0], (float)v[1], (float)v[2] };
}

static inline void view_of_row(const ruler_row *row, double view[3]) {
    ruler_direction(row->view_angle, 180, view);
}

/* Returns a spot's axis for a light in `direction` from the point, so that the point is `off`
 * degrees off the axis. */
static inline lmp_vec3 spot_axis(const double direction[3], double off) {
    double side[3] = { -direction[1], direction[0], 0 }, axis[3];
    const double length = hypot(side[0], side[1]);
    if (!(length > 0))
        side[0] = 1;
    for (int k = 0; k < 3; k++)
        axis[k] = -cos(off * RADIANS) * direction[k] +
                  sin(off * RADIANS) * side[k] / (length > 0 ? length : 1);
    return to_floats(axis);
}

/* Returns a row's light. A sphere that is touched, or seen from inside, becomes a cap: its radius
 * as a float would decide which it is. */
static inline lmp_light light_of_row(const ruler_row *row) {
    double direction[3];
    ruler_direction(row->light_angle, row->light_azimuth, direction);
    lmp_light light = { .position = to_floats(direction),
                        .direction = to_floats(direction),
                        .radius = (float)row->size,
                        .angle = (float)(ruler_half_angle(row) * RADIANS),
                        .inner = (float)(20 * RADIANS),
                        .outer = (float)(40 * RADIANS),
                        .radiance = { 1, 1, 1 },
                        .ground = { 0.25f, 0.25f, 0.25f } };
    static const lmp_light_kind kinds[RULER_LIGHTS] = { LMP_LIGHT_SPHERE, LMP_LIGHT_CAP,
                                                        LMP_LIGHT_HEMISPHERE, LMP_LIGHT_POINT,
                                                        LMP_LIGHT_SPOT };
    light.kind = row->light == RULER_SPHERE && row->size >= 1 ? LMP_LIGHT_CAP : kinds[row->light];
    if (row->light == RULER_SPOT)
        light.direction = spot_axis(direction, row->size);
    return light;
}

static inline lmp_material material_of_row(const ruler_row *row) {
    const float color = (float)row->color;
    lmp_material material = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS };
    if (row->material == RULER_PHONG)
        return (lmp_material) { .specular = { color, color, color },
                                .exponent = (float)row->exponent };
    material.diffuse = (lmp_rgb) { color, color, color };
    if (row->material == RULER_LAMBERT) {
        material.kind = LMP_MATERIAL_LOBES;
        return material;
    }
    material.metallic = row->material == RULER_METAL ? 1 : 0;
    material.roughness = (float)row->roughness;
    return material;
}

static inline lmp_surface surface_of_row(const ruler_row *row) {
    double view[3];
    view_of_row(row, view);
    return (lmp_surface) { .normal = { 0, 0, 1 }, .view = to_floats(view) };
}

static inline ruler_table open_table(void) {
    const cli_list none = { .count = 0 };
    ruler_choice choice;
    ruler_table table;
    base_error error;
    assert_true(ruler_choose(&none, &none, &choice, &error));
    assert_true(ruler_table_open(&choice, &table, &error));
    return table;
}

#endif
