/* SPDX-License-Identifier: MIT */
/* atrium_plan.c - helpers with which every part of the court is made. */
#include "app/scene/builtin/atrium.h"

#include "app/scene/vector.h"

const storey_plan atrium_lower = { 0.0f, 3.20f, GALLERY, 1.14f };
const storey_plan atrium_upper = { GALLERY, GALLERY + 2.55f, CORNICE, 1.22f };

void atrium_revolve(scene_shaper *shaper, const shape_point *profile, int point_count,
                    lmp_vec3 origin, int segments) {
    shape_revolve(shaper, &(shape_revolution) { .profile = profile,
                                                .point_count = point_count,
                                                .origin = origin,
                                                .axis = 'y',
                                                .segments = segments });
}

void atrium_revolve_arch(scene_shaper *shaper, const shape_point *profile, int point_count, float y,
                         int segments) {
    shape_revolve(shaper, &(shape_revolution) { .profile = profile,
                                                .point_count = point_count,
                                                .origin = vec(0.0f, y, 0.0f),
                                                .axis = 'z',
                                                .from = 0.0f,
                                                .to = PI,
                                                .segments = segments });
}
