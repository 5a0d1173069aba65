/* SPDX-License-Identifier: MIT */
#include "src/lobe/generate/node.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static const double dielectric_f0 = 0.04;
static const double weight_of_material[MATERIALS] = { 1, 0.5 };

/* Weights of cap sizes at all views, and along the normal, where three lobes can follow what is
 * seen under small caps to a thousandth, but not their tails, too; halfway to the next column
 * little of this is left. */
static const double weight_of_size[2][SIZES + 1] = { { 1, 1.8, 0.8, 0.4, 3 },
                                                     { 6, 90, 0.1, 0.05, 8 } };

#define ENERGY_WEIGHT 0.3
#define HIDDEN_WEIGHT 0.3  /* weight of caps below the horizon */
#define NEGATIVE      6    /* weight of an error where the lobes reflect less than nothing */
#define ALBEDO        0.25 /* albedo of the diffuse base that a dielectric is seen over */
#define DARK          0.08 /* albedo of the darkest base whose mean Fresnel loss is compensated */

/* --- nodes of the table ----------------------------------------------------------------------- */

double node_cap_size(double alpha, int size) {
    static const double wide[SIZES] = { 1.5, 4, 8, 15 };
    static const double most[SIZES] = { 0.05, 0.13, 0.35, 0.927 };
    return size == SIZES ? pi / 2 : fmin(wide[size] * alpha, most[size]);
}

/* Returns 0 for smooth surfaces, rising to 1 for rough ones. */
static double roughly(const fit_node *node) {
    return fmin(fmax((node->view.alpha - 0.1) / 0.3, 0), 1);
}

/* Returns what counts as a large error, relative to the peak: less of it shows where highlights are
 * small. */
static double large(const fit_node *node) {
    const double alpha = node->view.alpha, smoothly = fmin(fmax((0.1 - alpha) / 0.05, 0), 1);
    return 0.02 - 0.009 * smoothly + 0.03 * roughly(node);
}

/* Sets the targets of a cap from the parts of a value by Fresnel's factor. A dielectric's base
 * receives less light where more is reflected, yet is drawn by the mean of that: the lobes of rough
 * materials compensate for the difference. */
static void set_targets(fit_node *node, int cap, const double value[3], double cosine) {
    for (int m = 0; m < MATERIALS; m++) {
        const double f0 = m == 0 ? 1 : dielectric_f0;
        const double base = m == 0 ? 0 : ALBEDO * (1 - f0);
        const double dark = m == 0 ? 0 : roughly(node) * DARK * (1 - f0);
        node->target[m][cap] = f0 * value[0] + value[1] - dark * (value[2] - node->lost * cosine);
        node->base[m][cap] = base * (1 - node->lost) * cosine;
    }
}

/* Creates cap k of AZIMUTHS on ring i of DISTANCES around the mirror direction. */
static void cap_create(fit_node *node, int size, int i, int k) {
    const double a = node_cap_size(node->view.alpha, size);
    const double reach = fmin(2, a + 7 * node->view.alpha);
    const double rho = reach * (i + 0.5) / DISTANCES, psi = pi * (k + 0.5) / AZIMUTHS;
    const double across = sin(rho) * cos(psi), y = sin(rho) * sin(psi);
    const double x = cos(rho) * node->view.sine + across * node->view.z;
    const double z = cos(rho) * node->view.z - across * node->view.sine;
    const int cap = (size * DISTANCES + i) * AZIMUTHS + k;
    const double t = fmax(acos(fmin(z, 1)), 1e-9);
    double value[3];
    caps_ggx(&node->view, t, atan2(y, x), a, value);
    node->direction[cap][0] = x;
    node->direction[cap][1] = z;
    set_targets(node, cap, value, caps_cosine(t, a));
    node->solid[cap] = z < -sin(a) ? 0 : sin(rho);
    for (int m = 0; m < MATERIALS; m++)
        node->weight[m][cap] =
            pow(sin(rho), (1 + roughly(node)) / 2) * (z < -sin(a) ? HIDDEN_WEIGHT : 1);
}

/* Scales the errors of one size of caps, relative to its peak, by the weights of size and material.
 */
static void scale_weights(fit_node *node, int size, int material) {
    const int count = size == SIZES ? 1 : DISTANCES * AZIMUTHS, first = size * DISTANCES * AZIMUTHS;
    const double toward_normal = pow(node->view.z, 48);
    const double size_weight =
        weight_of_size[0][size] * (1 - toward_normal) + weight_of_size[1][size] * toward_normal;
    double peak = 0, sum = 0, *weight = node->weight[material];
    for (int cap = first; cap < first + count; cap++) {
        peak = fmax(peak, node->target[material][cap] + node->base[material][cap]);
        sum += weight[cap];
    }
    for (int cap = first; cap < first + count; cap++)
        weight[cap] = weight_of_material[material] * size_weight * sqrt(weight[cap] / sum) / peak;
    node->peak[material][size] = peak;
}

void node_create(fit_node *node, double z, double alpha, const caps_table *tables) {
    const double a2 = alpha * alpha;
    double sky[3];
    node->view = (ggx_view) { alpha, z, sqrt(1 - z * z), sqrt(a2 + (1 - a2) * z * z) };
    node->tables = tables;
    node->lost = caps_diffuse(z);
    for (int size = 0; size < SIZES; size++)
        for (int i = 0; i < DISTANCES; i++)
            for (int k = 0; k < AZIMUTHS; k++)
                cap_create(node, size, i, k);
    caps_ggx_sky(&node->view, sky);
    set_targets(node, CAPS - 1, sky, 1);
    node->direction[CAPS - 1][0] = 0;
    node->direction[CAPS - 1][1] = 1;
    for (int m = 0; m < MATERIALS; m++) {
        node->weight[m][CAPS - 1] = 1;
        for (int size = 0; size <= SIZES; size++)
            scale_weights(node, size, m);
    }
}

/* --- how far lobes are from GGX ----------------------------------------------------------------
 */

void equations_add(equations *e, const double row[PARAMETERS], double residual) {
    e->error += residual * residual;
    for (int i = 0; i < PARAMETERS; i++) {
        e->vector[i] -= row[i] * residual;
        for (int k = 0; k <= i; k++)
            e->matrix[i][k] += row[i] * row[k];
    }
}

/* What the lobes give for a cap, and the derivatives of that, for each material. */
typedef struct cap_model {
    double value[MATERIALS], row[MATERIALS][PARAMETERS];
} cap_model;

static void model_cap(const fit_node *node, const double p[PARAMETERS],
                      const double chain[PARAMETERS], int cap, cap_model *to) {
    const double *d = node->direction[cap];
    for (int m = 0; m < MATERIALS; m++)
        to->value[m] = 0;
    for (int k = 0; k < LOBES; k++) {
        const double *q = p + 4 * k;
        const double height = node->view.z + node->view.alpha * q[0];
        const double length = sqrt(node->view.sine * node->view.sine + height * height);
        const double x = node->view.sine / length, z = height / length;
        const double cosine = fmin(fmax(x * d[0] + z * d[1], -1), 1);
        const double sine = fmax(sqrt(1 - cosine * cosine), 1e-9);
        double value[3];
        caps_table_at(&node->tables[cap / (DISTANCES * AZIMUTHS)], acos(cosine), q[1], value);
        /* The axis rotates toward (-z, x) as the height grows */
        const double rotation = value[1] * (z * d[0] - x * d[1]) / sine * node->view.sine *
                                node->view.alpha / (length * length);
        for (int m = 0; m < MATERIALS; m++) {
            const double f0 = m == 0 ? 1 : dielectric_f0, w = f0 * q[2] + (1 - f0) * q[3];
            double *r = to->row[m] + 4 * k;
            to->value[m] += w * value[0];
            r[0] = chain[4 * k + 0] * w * rotation;
            r[1] = chain[4 * k + 1] * w * value[2];
            r[2] = chain[4 * k + 2] * f0 * value[0];
            r[3] = chain[4 * k + 3] * (1 - f0) * value[0];
        }
    }
}

/* Adds the errors of a cap; large ones count by their fourth power. */
static void add_cap(const fit_node *node, int m, int cap, const cap_model *model, double scale,
                    equations *e) {
    const double peak = node->peak[m][cap / (DISTANCES * AZIMUTHS)];
    const double error = model->value[m] - node->target[m][cap];
    const double part = error / peak / large(node), square = part * part, root = sqrt(1 + square);
    const double dark = model->value[m] + node->base[m][cap] < 0 ? NEGATIVE : 1;
    const double weight = scale * node->weight[m][cap] * dark;
    double row[PARAMETERS];
    for (int i = 0; i < PARAMETERS; i++)
        row[i] = weight * model->row[m][i] * (1 + 2 * square) / root;
    equations_add(e, row, weight * error * root);
}

/* Adds the error of the energy that all caps of one size reflect. */
static void add_energy(const fit_node *node, int m, int size, const cap_model *models, double scale,
                       equations *e) {
    double row[PARAMETERS] = { 0 }, error = 0, all = 0;
    const int first = size * DISTANCES * AZIMUTHS;
    for (int i = 0; i < DISTANCES * AZIMUTHS; i++) {
        const double solid = node->solid[first + i];
        all += solid * node->target[m][first + i];
        error += solid * (models[i].value[m] - node->target[m][first + i]);
        for (int k = 0; k < PARAMETERS; k++)
            row[k] += solid * models[i].row[m][k];
    }
    for (int k = 0; k < PARAMETERS; k++)
        row[k] *= scale * ENERGY_WEIGHT / all;
    equations_add(e, row, scale * ENERGY_WEIGHT / all * error);
}

void node_add(const fit_node *node, const double p[PARAMETERS], const double chain[PARAMETERS],
              double weight, equations *e) {
    cap_model models[DISTANCES * AZIMUTHS];
    for (int size = 0; size <= SIZES; size++) {
        const int first = size * DISTANCES * AZIMUTHS;
        const int count = size == SIZES ? 1 : DISTANCES * AZIMUTHS;
        for (int i = 0; i < count; i++)
            model_cap(node, p, chain, first + i, &models[i]);
        for (int m = 0; m < MATERIALS; m++) {
            for (int i = 0; i < count; i++)
                add_cap(node, m, first + i, &models[i], weight, e);
            if (size < SIZES)
                add_energy(node, m, size, models, weight, e);
        }
    }
}

double node_error(const fit_node *node, const double p[PARAMETERS]) {
    equations alone = { 0 };
    const double alike[PARAMETERS] = { 0 }; /* derivatives are not used */
    node_add(node, p, alike, 1, &alone);
    return sqrt(alone.error / (SIZES * MATERIALS));
}
