/* SPDX-License-Identifier: MIT */
#include "src/lobe/generate/node.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static const double dielectric_f0 = 0.04;
static const double weight_of_size[SIZES + 1] = { 1, 0.8, 0.5, 4 };
static const double weight_of_material[MATERIALS] = { 1, 0.8 };

#define LARGE         0.03 /* in parts of the peak: a large error */
#define ENERGY_WEIGHT 0.3

/* --- nodes of the table ----------------------------------------------------------------------- */

double node_cap_size(double alpha, int size) {
    static const double wide[SIZES] = { 1.5, 5, 15 }, most[SIZES] = { 0.06, 0.2, 0.7 };
    return size == SIZES ? pi / 2 : fmin(wide[size] * alpha, most[size]);
}

/* By Fresnel's factor of a value's two parts. */
static void set_targets(fit_node *node, int cap, const double value[2]) {
    for (int m = 0; m < MATERIALS; m++) {
        const double f0 = m == 0 ? 1 : dielectric_f0;
        node->target[m][cap] = f0 * value[0] + value[1];
    }
}

/* Cap k of AZIMUTHS on ring i of DISTANCES around the mirror direction. */
static void cap_create(fit_node *node, int size, int i, int k) {
    const double a = node_cap_size(node->view.alpha, size);
    const double reach = fmin(0.7 * pi, a + 8 * node->view.alpha);
    const double rho = reach * (i + 0.5) / DISTANCES, psi = pi * (k + 0.5) / AZIMUTHS;
    const double across = sin(rho) * cos(psi), y = sin(rho) * sin(psi);
    const double x = cos(rho) * node->view.sine + across * node->view.z;
    const double z = cos(rho) * node->view.z - across * node->view.sine;
    const int cap = (size * DISTANCES + i) * AZIMUTHS + k;
    const double hidden = z < -sin(a) ? 0.3 : 1;
    double value[2];
    caps_ggx(&node->view, fmax(acos(fmin(z, 1)), 1e-9), atan2(y, x), a, value);
    node->direction[cap][0] = x;
    node->direction[cap][1] = z;
    set_targets(node, cap, value);
    node->solid[cap] = hidden < 1 ? 0 : sin(rho);
    for (int m = 0; m < MATERIALS; m++)
        node->weight[m][cap] = hidden * sqrt(sin(rho));
}

/* Makes the errors of a size of caps, in parts of its peak, weigh what the size and the material
 * do. */
static void scale_weights(fit_node *node, int size, int material) {
    const int count = size == SIZES ? 1 : DISTANCES * AZIMUTHS, first = size * DISTANCES * AZIMUTHS;
    double peak = 0, sum = 0, *weight = node->weight[material];
    for (int cap = first; cap < first + count; cap++) {
        peak = fmax(peak, node->target[material][cap]);
        sum += weight[cap];
    }
    for (int cap = first; cap < first + count; cap++)
        weight[cap] =
            weight_of_material[material] * weight_of_size[size] * sqrt(weight[cap] / sum) / peak;
    node->peak[material][size] = peak;
}

void node_create(fit_node *node, double z, double alpha, double extra_max,
                 const caps_table *tables) {
    const double a2 = alpha * alpha;
    double sky[2];
    node->view = (ggx_view) { alpha, z, sqrt(1 - z * z), sqrt(a2 + (1 - a2) * z * z) };
    node->tables = tables;
    node->extra_max = extra_max;
    for (int size = 0; size < SIZES; size++)
        for (int i = 0; i < DISTANCES; i++)
            for (int k = 0; k < AZIMUTHS; k++)
                cap_create(node, size, i, k);
    caps_ggx_sky(&node->view, sky);
    set_targets(node, CAPS - 1, sky);
    node->direction[CAPS - 1][0] = 0;
    node->direction[CAPS - 1][1] = 1;
    for (int m = 0; m < MATERIALS; m++) {
        node->weight[m][CAPS - 1] = 1;
        for (int size = 0; size <= SIZES; size++)
            scale_weights(node, size, m);
    }
}

/* --- the fit ---------------------------------------------------------------------------------- */

typedef struct equations {
    double matrix[PARAMETERS][PARAMETERS], vector[PARAMETERS], error;
} equations;

static void equations_add(equations *e, const double row[PARAMETERS], double residual) {
    e->error += residual * residual;
    for (int i = 0; i < PARAMETERS; i++) {
        e->vector[i] -= row[i] * residual;
        for (int k = 0; k <= i; k++)
            e->matrix[i][k] += row[i] * row[k];
    }
}

/* What the lobes give of a cap, and its derivatives, for each material. */
typedef struct cap_model {
    double value[MATERIALS], row[MATERIALS][PARAMETERS];
} cap_model;

static void model_cap(const fit_node *node, const double p[PARAMETERS], int cap, cap_model *to) {
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
        /* the axis rotates toward (-z, x) as the height grows */
        const double rotation = value[1] * (z * d[0] - x * d[1]) / sine * node->view.sine *
                                node->view.alpha / (length * length);
        for (int m = 0; m < MATERIALS; m++) {
            const double f0 = m == 0 ? 1 : dielectric_f0, w = f0 * q[2] + (1 - f0) * q[3];
            double *r = to->row[m] + 4 * k;
            to->value[m] += w * value[0];
            r[0] = w * rotation;
            r[1] = w * value[2];
            r[2] = f0 * value[0];
            r[3] = (1 - f0) * value[0];
        }
    }
}

/* Adds the errors of a cap: beyond LARGE they count by their fourth power, and by their
 * sixth on rough metals, whose reflection ends at the horizon as no lobe does; that of a dielectric
 * is seen over a diffuse base. */
static void add_cap(const fit_node *node, int m, int cap, const cap_model *model, equations *e) {
    const double peak = node->peak[m][cap / (DISTANCES * AZIMUTHS)];
    const double error = model->value[m] - node->target[m][cap];
    const double square = (error / peak / LARGE) * (error / peak / LARGE);
    const double rough = m == 0 ? 0.3 * pow(node->view.alpha, 4) : 0;
    const double steep = rough * square * square, root = sqrt(1 + square + steep);
    double row[PARAMETERS];
    for (int i = 0; i < PARAMETERS; i++)
        row[i] = node->weight[m][cap] * model->row[m][i] * (1 + 2 * square + 3 * steep) / root;
    equations_add(e, row, node->weight[m][cap] * error * root);
}

/* Adds the error of the energy that all caps of a size reflect. */
static void add_energy(const fit_node *node, int m, int size, const cap_model *models,
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
        row[k] *= ENERGY_WEIGHT / all;
    equations_add(e, row, ENERGY_WEIGHT / all * error);
}

static void accumulate(const fit_node *node, const double p[PARAMETERS],
                       const double toward[PARAMETERS], double pull, equations *e) {
    static const double scale[4] = { 1, 0.5, 2, 2 };
    cap_model models[DISTANCES * AZIMUTHS];
    memset(e, 0, sizeof *e);
    for (int size = 0; size <= SIZES; size++) {
        const int first = size * DISTANCES * AZIMUTHS;
        const int count = size == SIZES ? 1 : DISTANCES * AZIMUTHS;
        for (int i = 0; i < count; i++)
            model_cap(node, p, first + i, &models[i]);
        for (int m = 0; m < MATERIALS; m++) {
            for (int i = 0; i < count; i++)
                add_cap(node, m, first + i, &models[i], e);
            if (size < SIZES)
                add_energy(node, m, size, models, e);
        }
    }
    for (int i = 0; i < PARAMETERS; i++) {
        double row[PARAMETERS] = { 0 };
        row[i] = pull * scale[i % 4];
        equations_add(e, row, row[i] * (p[i] - toward[i]));
    }
}

/* x with (matrix + damping diagonal) x = vector, by Cholesky; false if it is not definite. */
static bool solve(const equations *e, double damping, double x[PARAMETERS]) {
    double l[PARAMETERS][PARAMETERS];
    for (int i = 0; i < PARAMETERS; i++)
        for (int k = 0; k <= i; k++) {
            double sum = e->matrix[i][k] * (i == k ? 1 + damping : 1) + (i == k ? 1e-15 : 0);
            for (int j = 0; j < k; j++)
                sum -= l[i][j] * l[k][j];
            if (i == k && !(sum > 0))
                return false;
            l[i][k] = i == k ? sqrt(sum) : sum / l[k][k];
        }
    for (int i = 0; i < PARAMETERS; i++) {
        x[i] = e->vector[i];
        for (int k = 0; k < i; k++)
            x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
    for (int i = PARAMETERS - 1; i >= 0; i--) {
        for (int k = i + 1; k < PARAMETERS; k++)
            x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
    return true;
}

/* Least values of a lobe's parameters: weights are not negative. */
static const double least[4] = { -10, CAPS_SPREAD_LOG_MIN + 0.3, 0, 0 };

static double most(const fit_node *node, int i) {
    static const double of_all[4] = { 80, CAPS_SPREAD_LOG_MAX - 0.3, 3, 3 };
    return i % 4 >= 2 && i / 4 >= LMP_GGX_LOBES_FEW ? node->extra_max : of_all[i % 4];
}

/* Parameters at a bound that want to go beyond stay where they are. */
static void equations_bound(const fit_node *node, equations *e, const double p[PARAMETERS]) {
    for (int i = 0; i < PARAMETERS; i++) {
        const bool low = p[i] <= least[i % 4] && e->vector[i] < 0;
        const bool high = p[i] >= most(node, i) && e->vector[i] > 0;
        if (!low && !high)
            continue;
        for (int k = 0; k < PARAMETERS; k++)
            e->matrix[i > k ? i : k][i > k ? k : i] = i == k;
        e->vector[i] = 0;
    }
}

/* Improves p; the sum of squares, pull included. */
double node_fit(const fit_node *node, double p[PARAMETERS], const double toward[PARAMETERS],
                double pull, int steps) {
    equations now, next;
    double damping = 1e-3, step[PARAMETERS], tried[PARAMETERS];
    for (int k = 0; k < PARAMETERS; k++)
        p[k] = fmin(p[k], most(node, k));
    accumulate(node, p, toward, pull, &now);
    equations_bound(node, &now, p);
    for (int i = 0; i < steps && damping < 1e6; i++) {
        if (!solve(&now, damping, step)) {
            damping *= 10;
            continue;
        }
        for (int k = 0; k < PARAMETERS; k++)
            tried[k] = fmin(fmax(p[k] + step[k], least[k % 4]), most(node, k));
        accumulate(node, tried, toward, pull, &next);
        if (next.error < now.error) {
            const bool done = next.error > now.error * (1 - 1e-7);
            memcpy(p, tried, sizeof tried);
            equations_bound(node, &next, p);
            now = next;
            damping = fmax(damping / 5, 1e-9);
            if (done)
                break;
        } else {
            damping *= 4;
        }
    }
    return now.error;
}

double node_error(const fit_node *node) {
    equations alone;
    accumulate(node, node->fit, node->fit, 0, &alone);
    return sqrt(alone.error / (SIZES * MATERIALS));
}
