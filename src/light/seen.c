/* SPDX-License-Identifier: MIT */
#include "src/light/seen.h"

void lmpi_seen_add(int low, int high, const lmpi_seen *seen, float *const planes[3]) {
    const lmp_rgb color = seen->radiance;
    if (seen->is_loop)
        lmpi_loop_add(low, high, &seen->loop, (const float[3]) { color.r, color.g, color.b },
                      planes);
    else
        lmpi_cap_add(low, high, &seen->cap, planes);
}

void lmpi_seen_add_loop_irradiance(const lmpi_seen *seen, lmp_vec3 normal, lmp_rgb *sum) {
    const float all =
        (float)lmpi_loop_irradiance(&seen->loop, lmpi_vector_unit(lmpi_vector_of(normal)));
    sum->r += seen->radiance.r * all;
    sum->g += seen->radiance.g * all;
    sum->b += seen->radiance.b * all;
}

static lmpi_vector into(const lmpi_vector frame[3], lmpi_vector v) {
    return (lmpi_vector) { lmpi_vector_dot(v, frame[0]), lmpi_vector_dot(v, frame[1]),
                           lmpi_vector_dot(v, frame[2]) };
}

void lmpi_seen_rotate(const lmp_vec3 frame[3], lmpi_seen *seen) {
    const lmpi_vector axes[3] = { lmpi_vector_of(frame[0]), lmpi_vector_of(frame[1]),
                                  lmpi_vector_of(frame[2]) };
    if (!seen->is_loop) {
        seen->cap.axis = lmpi_vector_rounded(into(axes, lmpi_vector_of(seen->cap.axis)));
        return;
    }
    seen->loop.inner = into(axes, seen->loop.inner);
    for (int i = 0; i < seen->loop.count; i++) {
        lmpi_arc *arc = &seen->loop.arc[i];
        arc->center = into(axes, arc->center);
        arc->middle = into(axes, arc->middle);
        arc->side = into(axes, arc->side);
        if (arc->straight) {
            arc->from = into(axes, arc->from);
            arc->to = into(axes, arc->to);
            arc->pole = into(axes, arc->pole);
        }
    }
}
