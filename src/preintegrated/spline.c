/* SPDX-License-Identifier: MIT */
#include "src/preintegrated/spline.h"

static const float pole = -0.26794919243f;

/* Adds factor * from to a row. */
static void add_scaled(float *restrict to, const float *restrict from, size_t width, float factor) {
    for (size_t j = 0; j < width; j++)
        to[j] += factor * from[j];
}

/* Sets the far end from which the anticausal half starts. */
static void begin_back(float *restrict last, const float *restrict before, size_t width) {
    for (size_t j = 0; j < width; j++)
        last[j] = pole / (pole * pole - 1) * (last[j] + pole * before[j]);
}

static void step_back(float *restrict row, const float *restrict next, size_t width) {
    for (size_t j = 0; j < width; j++)
        row[j] = pole * (next[j] - row[j]);
}

/* Computes the coefficients of one series, without the cost of inner loops of one step. */
static void single_coefficients(float *values, size_t count) {
    float power = pole, now = values[0];
    for (size_t k = 1; k < count && k < 20; k++, power *= pole)
        now += power * values[k];
    values[0] = now;
    for (size_t k = 1; k < count; k++)
        values[k] = now = values[k] + pole * now;
    now = values[count - 1] = pole / (pole * pole - 1) * (now + pole * values[count - 2]);
    for (size_t k = count - 1; k-- > 0;)
        values[k] = now = pole * (now - values[k]);
    for (size_t k = 0; k < count; k++)
        values[k] *= 6;
}

void lmpi_spline_coefficients(float *values, size_t count, size_t width) {
    if (width == 1) {
        single_coefficients(values, count);
        return;
    }
    float power = pole;
    /* The mirrored series has its first value once, the others on both sides; the causal half
     * starts from the far side. */
    for (size_t k = 1; k < count && k < 20; k++, power *= pole)
        add_scaled(values, values + k * width, width, power);
    for (size_t k = 1; k < count; k++)
        add_scaled(values + k * width, values + (k - 1) * width, width, pole);
    begin_back(values + (count - 1) * width, values + (count - 2) * width, width);
    for (size_t k = count - 1; k-- > 0;)
        step_back(values + k * width, values + (k + 1) * width, width);
    for (size_t i = 0; i < count * width; i++)
        values[i] *= 6;
}
