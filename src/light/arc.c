/* SPDX-License-Identifier: MIT */
#include "src/light/arc.h"

/* The positive nodes of 4, 8 and 16, and their weights. */
typedef struct gauss_rule {
    int half;
    double node[LMPI_ARC_PAIRS], weight[LMPI_ARC_PAIRS];
} gauss_rule;
static const gauss_rule rules[] = {
    { 2,
      { 0.33998104358485626480, 0.86113631159405257522 },
      { 0.65214515486254614263, 0.34785484513745385737 } },
    { 4,
      { 0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
        0.96028985649753623168 },
      { 0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
        0.10122853629037625915 } },
    { 8,
      { 0.095012509837637440185, 0.28160355077925891323, 0.45801677765722738634,
        0.61787624440264374845, 0.7554044083550030339, 0.86563120238783174388,
        0.94457502307323257608, 0.9894009349916499326 },
      { 0.18945061045506849629, 0.18260341504492358887, 0.16915651939500253819,
        0.14959598881657673208, 0.12462897125553387205, 0.09515851168249278481,
        0.062253523938647892863, 0.027152459411754094852 } }
};

/* Returns the rule whose error on a part of an arc is below 1e-11, NULL if there is none: by how
 * near the next singularity is to half of the part, and by the waves of the highest band on it. */
static const gauss_rule *rule_for(double half, double waves) {
    static const double longest[] = { 1. / 20, 0.2, 0.5 }, most[] = { 0.25, 2.5, 10 };
    for (int i = 0; i < 3; i++)
        if (half <= longest[i] && waves <= most[i])
            return &rules[i];
    return NULL;
}

lmpi_vector lmpi_arc_at(const lmpi_arc *arc, double t) {
    const double per = 1 / (1 + t * t);
    return lmpi_vector_add(arc->center,
                           lmpi_vector_add(lmpi_vector_scale(arc->middle, (1 - t * t) * per),
                                           lmpi_vector_scale(arc->side, 2 * t * per)));
}

/* Returns the rule for a part of an arc. The next singularity is one of t or, but for a straight
 * edge, one where the square of the distance is 0. */
static const gauss_rule *rule_between(const lmpi_arc *arc, double low, double high, int bands) {
    const double half = (high - low) / 2;
    if (arc->straight)
        return rule_for(half, 2 * half * bands);
    const double ends =
        fmin(lmpi_vector_length(lmpi_arc_at(arc, low)), lmpi_vector_length(lmpi_arc_at(arc, high)));
    const double near = fmin(ends, lmpi_vector_length(lmpi_arc_at(arc, low + half)));
    const double seen = 2 * half * lmpi_vector_length(arc->middle) / near;
    return rule_for(fmax(half, seen), seen * bands);
}

static void take_nodes(const lmpi_arc *arc, const gauss_rule *rule, double low, double high,
                       lmpi_arc_nodes *to) {
    const double half = (high - low) / 2, center = low + half;
    to->pairs = rule->half;
    for (int i = 0; i < rule->half; i++)
        for (int k = 0; k < 2; k++) {
            const double t = center + (k ? half : -half) * rule->node[i], per = 1 / (1 + t * t);
            const double c = (1 - t * t) * per, s = 2 * t * per;
            const lmpi_vector p = lmpi_arc_at(arc, t);
            const lmpi_vector along =
                lmpi_vector_sub(lmpi_vector_scale(arc->side, c), lmpi_vector_scale(arc->middle, s));
            const double square = lmpi_vector_dot(p, p), length = sqrt(square);
            const lmpi_vector w = lmpi_vector_scale(p, 1 / length);
            const lmpi_vector g = lmpi_vector_scale(lmpi_vector_cross(p, along),
                                                    2 * per * half * rule->weight[i] / square);
            const double values[2][3] = { { w.x, w.y, w.z }, { g.x, g.y, g.z } };
            to->near[i][k] = 1 / length;
            for (int a = 0; a < 3; a++) {
                to->w[a][i][k] = values[0][a];
                to->g[a][i][k] = values[1][a];
            }
        }
}

void lmpi_arc_visit(const lmpi_arc *arc, double low, double high, int bands,
                    lmpi_arc_nodes_user *use, void *user) {
    const double least = 1e-12;
    lmpi_arc_nodes some;
    double step = high - low;
    while (low < high) {
        const gauss_rule *rule;
        while (!(rule = rule_between(arc, low, low + step, bands)) && step > least)
            step /= 2;
        take_nodes(arc, rule ? rule : rules, low, low + step, &some);
        use(&some, user);
        if (!(low + step > low))
            return;
        low += step;
        step = fmin(2 * step, high - low);
    }
}
