/* SPDX-License-Identifier: MIT */
#include "src/response/spline.h"

void lmp_spline_coefficients(float *values, size_t count, size_t stride) {
    const float pole = -0.26794919243f;
    float sum = values[0], power = pole;
    for (size_t k = 1; k < count && k < 20; k++, power *= pole)
        sum += power * values[k * stride];
    /* The mirrored series has its first value once, the others on both sides; the causal half
     * starts from the far side. */
    values[0] = sum;
    for (size_t k = 1; k < count; k++)
        values[k * stride] += pole * values[(k - 1) * stride];
    float *last = values + (count - 1) * stride;
    *last = pole / (pole * pole - 1) * (*last + pole * *(last - stride));
    for (size_t k = count - 1; k-- > 0;)
        values[k * stride] = pole * (values[(k + 1) * stride] - values[k * stride]);
    for (size_t k = 0; k < count; k++)
        values[k * stride] *= 6;
}
