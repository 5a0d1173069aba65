/* SPDX-License-Identifier: MIT */
#include "app/reference/measured.h"

#include <stdlib.h>

bool reference_tabulated_create(reference_tabulated *measured,
                                const reference_material_source *sources, size_t count) {
    size_t largest = 1;
    for (size_t i = 0; i < count; i++) {
        const lmp_brdf_table *table = sources[i].table;
        const size_t needed = table ? lmp_brdf_table_describe(table).count : 0;
        largest = needed > largest ? needed : largest;
    }
    *measured = (reference_tabulated) { .coefficients = malloc(3 * largest * sizeof(float)) };
    return measured->coefficients != NULL;
}

void reference_tabulated_free(reference_tabulated *measured) {
    free(measured->coefficients);
    measured->coefficients = NULL;
}

/* The part of v square to the normal, unit; where there is none, any such direction. */
static reference_vec flatten(reference_vec v, reference_vec normal) {
    const reference_vec flat =
        reference_subtract(v, reference_scale(reference_dot(v, normal), normal));
    return reference_length(flat) > 1e-7 ? reference_normalize(flat)
                                         : reference_around(normal, 0, 1, 0);
}

void reference_tabulated_aim(reference_tabulated *measured, const reference_material_source *source,
                             reference_vec normal, reference_vec tangent, reference_vec view) {
    const reference_vec x = flatten(tangent, normal), y = reference_cross(normal, x);
    const double turn = atan2(reference_dot(view, y), reference_dot(view, x));
    measured->source = source;
    measured->z = normal;
    measured->x = source->table ? flatten(view, normal) : x;
    measured->y = reference_cross(normal, measured->x);
    measured->wo[0] = reference_dot(view, measured->x);
    measured->wo[1] = reference_dot(view, measured->y);
    measured->wo[2] = reference_dot(view, normal);
    if (!source->table)
        return;
    measured->info = lmp_brdf_table_describe(source->table);
    lmp_brdf_table_view(source->table, (float)measured->wo[2], (float)turn, measured->coefficients);
}

/* Adds value times the coefficient of (l, m), which a mirrored table holds for m >= 0 alone. */
static void add_term(const reference_tabulated *measured, int l, int m, double value,
                     double rgb[3]) {
    const bool mirrored = measured->info.mirrored;
    const int index = mirrored ? l * (l + 1) / 2 + m : l * l + l + m;
    if (mirrored && m < 0)
        return;
    for (size_t c = 0; c < 3; c++)
        rgb[c] += value * (double)measured->coefficients[c * measured->info.count + (size_t)index];
}

/* Σ c_lm Y_lm, by the paper's Eq. 1 with Legendre functions that carry their own norm. */
static void series_at(const reference_tabulated *measured, const double w[3], double rgb[3]) {
    const double sine = sqrt(w[0] * w[0] + w[1] * w[1]), phi = atan2(w[1], w[0]);
    double diagonal = sqrt(1 / (4 * REFERENCE_PI));
    for (int m = 0; m < measured->info.bands; m++) {
        const double norm = m ? sqrt(2.0) : 1, cosine = norm * cos(m * phi);
        const double other = norm * sin(m * phi);
        double before = 0, p = diagonal;
        for (int l = m; l < measured->info.bands; l++) {
            const double l2 = (double)l * l, m2 = (double)m * m, next2 = (l + 1.0) * (l + 1.0);
            add_term(measured, l, m, p * cosine, rgb);
            if (m > 0)
                add_term(measured, l, -m, p * other, rgb);
            const double back = l > m ? sqrt((l2 - m2) / (4 * l2 - 1)) : 0;
            const double next = sqrt((4 * next2 - 1) / (next2 - m2)) * (w[2] * p - back * before);
            before = p;
            p = next;
        }
        diagonal *= -sine * sqrt((2 * m + 3.0) / (2 * m + 2.0));
    }
}

void reference_tabulated_at(const reference_tabulated *measured, reference_vec w, double rgb[3]) {
    const double wi[3] = { reference_dot(w, measured->x), reference_dot(w, measured->y),
                           reference_dot(w, measured->z) };
    rgb[0] = rgb[1] = rgb[2] = 0;
    if (measured->source->table) {
        series_at(measured, wi, rgb);
        return;
    }
    if (wi[2] <= 0 || measured->wo[2] <= 0)
        return;
    lmp_brdf_eval_double(measured->source->brdf, wi, measured->wo, rgb);
    for (int c = 0; c < 3; c++)
        rgb[c] *= wi[2];
}
