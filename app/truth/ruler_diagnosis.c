/* SPDX-License-Identifier: MIT */
#include "app/truth/ruler_diagnosis.h"

#include <math.h>
#include <stdio.h>

/* --- one factor for all rows of a material ---------------------------------------------------- */

#define FACTOR_SPREAD 0.01 /* of the ratios, for a common factor */

/* Returns the factor by which all rows of the material are off, or NAN if there is none. */
static double common_factor(const ruler_table *table, const double *values,
                            ruler_material material) {
    double least = (double)INFINITY, most = 0;
    for (int i = 0; i < table->count; i++) {
        const ruler_row *const row = &table->rows[i];
        if (row->material != material || !(row->value > RULER_DARK * ruler_scale(row)))
            continue;
        least = fmin(least, values[i] / row->value);
        most = fmax(most, values[i] / row->value);
    }
    return most > 0 && most - least <= FACTOR_SPREAD * most ? (least + most) / 2 : (double)NAN;
}

static int print_factors(const ruler_table *table, const double *values) {
    int count = 0;
    for (int m = 0; m < RULER_MATERIALS; m++) {
        const double factor = common_factor(table, values, (ruler_material)m);
        if (!(fabs(factor - 1) > FACTOR_SPREAD))
            continue;
        printf("it looks like a wrong normalization: every value of %s is %.4g times the truth\n",
               ruler_material_names[m], factor);
        count++;
    }
    return count;
}

/* --- right for some rows and wrong for others ------------------------------------------------- */

static bool is_ggx(const ruler_row *row) {
    return row->material >= RULER_METAL;
}
/* Whether a row depends on Fresnel's term, which is 1 in all directions for a white metal. */
static bool has_fresnel(const ruler_row *row) {
    return row->material == RULER_DIELECTRIC || (row->material == RULER_METAL && row->color < 1);
}
static bool is_cut(const ruler_row *row) {
    return row->material != RULER_PHONG &&
           (row->light == RULER_HEMISPHERE || row->light_angle + ruler_half_angle(row) > 90);
}
static bool is_diffuse(const ruler_row *row) {
    return row->material == RULER_LAMBERT;
}

/* The diagnoses in the order of their tests; the first that explains the errors is reported. */
static const struct {
    const char *text;
    bool (*hits)(const ruler_row *row);
} diagnoses[] = {
    { "only lights that the horizon cuts are wrong: it looks like a missing horizon clip", is_cut },
    { "only materials with a Fresnel term are wrong: it looks like a missing or other Fresnel term",
      has_fresnel },
    { "only glTF's GGX is wrong: it looks like another distribution, as Phong's lobe for GGX's",
      is_ggx },
    { "only diffuse reflection is wrong", is_diffuse },
};

typedef struct side {
    bool (*hits)(const ruler_row *row);
    bool wanted;
} side;
static bool on_side(const ruler_row *row, const void *user) {
    const side *const s = user;
    return s->hits(row) == s->wanted;
}

void ruler_diagnosis_print(const ruler_table *table, const double *values,
                           const ruler_limits *limits) {
    if (print_factors(table, values) > 0)
        return;
    for (size_t k = 0; k < sizeof diagnoses / sizeof *diagnoses; k++) {
        const side hit = { diagnoses[k].hits, true }, missed = { diagnoses[k].hits, false };
        const ruler_figures right = ruler_figures_of(table, values, on_side, &missed);
        const ruler_figures wrong = ruler_figures_of(table, values, on_side, &hit);
        if (right.count > 0 && wrong.rms > limits->rms && right.rms <= limits->rms &&
            right.largest <= limits->largest) {
            printf("%s\n", diagnoses[k].text);
            return;
        }
    }
}
