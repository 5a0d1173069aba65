/* SPDX-License-Identifier: MIT */
/* measured_eval.h - reading a measured material's response: once a surface where its view lies,
 * then once a light. */
#ifndef LAMPION_RESPONSE_MEASURED_EVAL_H
#define LAMPION_RESPONSE_MEASURED_EVAL_H

#include "src/response/measured.h"

/* Where a view lies. */
typedef struct lmp_measured_place {
    const lmp_brdf_response_info *info;
    float cosine, sine; /* of theta_o */
    uint32_t view;
    float share; /* of the view after it */
} lmp_measured_place;

void lmp_measured_seek(const lmp_brdf_response_info *info, float cos_theta_o,
                       lmp_measured_place *place);

/* lmp_brdf_response_eval and lmp_brdf_response_ambient at a place. */
lmp_rgb lmp_measured_at(const lmp_measured_place *place, lmp_vec3 axis, float one_minus);
lmp_rgb lmp_measured_ambient(const lmp_measured_place *place);

#endif
