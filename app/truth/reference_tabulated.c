/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_tabulated.h"

#include <stdlib.h>
#include <string.h>

bool reference_tabulated_create(reference_tabulated *tabulated,
                                const reference_material_source *sources, size_t count) {
    size_t largest = 1;
    for (size_t i = 0; i < count; i++)
        largest = sources[i].table.count > largest ? sources[i].table.count : largest;
    *tabulated = (reference_tabulated) { .coefficients = malloc(3 * largest * sizeof(double)) };
    return tabulated->coefficients != NULL;
}

void reference_tabulated_free(reference_tabulated *tabulated) {
    free(tabulated->coefficients);
    tabulated->coefficients = NULL;
}

/* --- one view of a table ------------------------------------------------------------------------
 * Read here and not by the library, whose reading is judged: Catmull-Rom's cubic in theta_o and
 * phi_o, as <lampion/brdf.h> defines the table. */

/* Adds weight times the coefficients of a node of the table. The view before the pole is the one
 * after it at the opposite azimuth, in a frame rotated by pi: odd m change sign. Beyond the last
 * view the table is extrapolated linearly. */
static void add_node(const reference_material_source *source, int azimuth, int view, double weight,
                     double *sums) {
    const lmp_brdf_table_info *info = &source->table;
    const int last = info->views - 1, half_circle = info->azimuths / 2;
    if (view > last) {
        add_node(source, azimuth, last, 2 * weight, sums);
        add_node(source, azimuth, last - 1, -weight, sums);
        return;
    }
    const int column = (azimuth + info->azimuths + (view < 0 ? half_circle : 0)) % info->azimuths;
    const size_t node = (size_t)column * (size_t)info->views + (size_t)abs(view);
    const float *from = source->coefficients + node * 3 * info->count;
    for (int c = 0; c < 3; c++)
        for (int l = 0; l < info->bands; l++)
            for (int m = info->mirrored ? 0 : -l; m <= l; m++)
                *sums++ += (view < 0 && m % 2 ? -weight : weight) * (double)*from++;
}

/* Computes the weights of four neighbors in the cubic between the middle two, at t = 0 … 1; its
 * slopes are those of the chords across them. */
static void cubic_weights(double t, double weights[4]) {
    const double rise = t * t * (3 - 2 * t), slope0 = t * (1 - t) * (1 - t);
    const double slope1 = t * t * (t - 1);
    weights[0] = -slope0 / 2;
    weights[1] = 1 - rise - slope1 / 2;
    weights[2] = rise + slope0 / 2;
    weights[3] = slope1 / 2;
}

static void add_azimuth(const reference_material_source *source, double row, int azimuth,
                        double weight, double *sums) {
    const int view = (int)fmin(row, source->table.views - 2);
    double weights[4];
    cubic_weights(row - view, weights);
    for (int k = 0; k < 4; k++)
        add_node(source, azimuth, view - 1 + k, weight * weights[k], sums);
}

static void load_view(reference_tabulated *tabulated, double cosine, double phi) {
    const reference_material_source *source = tabulated->source;
    const lmp_brdf_table_info *info = &source->table;
    const double theta = acos(fmin(fmax(cosine, 0), 1));
    const double row = fmin(theta / (double)info->theta_step, info->views - 1);
    memset(tabulated->coefficients, 0, 3 * info->count * sizeof(double));
    if (info->azimuths == 1) {
        add_azimuth(source, row, 0, 1, tabulated->coefficients);
        return;
    }
    const double part = phi / (2 * REFERENCE_PI), column = (part - floor(part)) * info->azimuths;
    const int first = (int)column;
    double weights[4];
    cubic_weights(column - first, weights);
    for (int k = 0; k < 4; k++)
        add_azimuth(source, row, first - 1 + k, weights[k], tabulated->coefficients);
}

/* --- one surface point ------------------------------------------------------------------------ */

/* Returns the part of v perpendicular to the normal, normalized; if it vanishes, any perpendicular
 * direction. */
static reference_vec flatten(reference_vec v, reference_vec normal) {
    const reference_vec flat =
        reference_subtract(v, reference_scale(reference_dot(v, normal), normal));
    return reference_length(flat) > 1e-7 ? reference_normalize(flat)
                                         : reference_around(normal, 0, 1, 0);
}

/* Sets the direction to the viewer. One that a smoothed normal puts behind the surface, as at
 * silhouettes, is raised to just above the horizon, where <lampion/shade.h> reads a table, too: a
 * BRDF is 0 below. */
static void look(reference_tabulated *tabulated, reference_vec view) {
    static const double least = 0.01;
    const double x = reference_dot(view, tabulated->x), y = reference_dot(view, tabulated->y),
                 z = reference_dot(view, tabulated->z), flat = hypot(x, y);
    const bool raised = z < least && flat > 0;
    const double scale = raised ? sqrt(1 - least * least) / flat : 1;
    tabulated->wo[0] = scale * x;
    tabulated->wo[1] = scale * y;
    tabulated->wo[2] = raised ? least : z;
}

void reference_tabulated_orient(reference_tabulated *tabulated,
                                const reference_material_source *source, reference_vec normal,
                                reference_vec tangent, reference_vec view) {
    const reference_vec x = flatten(tangent, normal), y = reference_cross(normal, x);
    const double phi = atan2(reference_dot(view, y), reference_dot(view, x));
    tabulated->source = source;
    tabulated->z = normal;
    tabulated->x = source->coefficients ? flatten(view, normal) : x;
    tabulated->y = reference_cross(normal, tabulated->x);
    look(tabulated, view);
    if (source->coefficients)
        load_view(tabulated, tabulated->wo[2], phi);
}

/* Adds value times the coefficient of (l, m), which a mirror-symmetric table stores for m >= 0
 * only. */
static void add_term(const reference_tabulated *tabulated, int l, int m, double value,
                     double rgb[3]) {
    const bool mirrored = tabulated->source->table.mirrored;
    const size_t index = mirrored ? LMP_SH_HALF_INDEX(l, m) : LMP_SH_INDEX(l, m);
    if (mirrored && m < 0)
        return;
    for (size_t c = 0; c < 3; c++)
        rgb[c] += value * tabulated->coefficients[c * tabulated->source->table.count + index];
}

/* Evaluates Σ c_lm Y_lm by the paper's Eq. 1, with Legendre functions that include their
 * normalization. */
static void series_at(const reference_tabulated *tabulated, const double w[3], double rgb[3]) {
    const double sine = sqrt(w[0] * w[0] + w[1] * w[1]), phi = atan2(w[1], w[0]);
    double diagonal = sqrt(1 / (4 * REFERENCE_PI));
    for (int m = 0; m < tabulated->source->table.bands; m++) {
        const double norm = m ? sqrt(2.0) : 1, cosine = norm * cos(m * phi);
        const double other = norm * sin(m * phi);
        double before = 0, p = diagonal;
        for (int l = m; l < tabulated->source->table.bands; l++) {
            const double l2 = (double)l * l, m2 = (double)m * m, next2 = (l + 1.0) * (l + 1.0);
            add_term(tabulated, l, m, p * cosine, rgb);
            if (m > 0)
                add_term(tabulated, l, -m, p * other, rgb);
            const double back = l > m ? sqrt((l2 - m2) / (4 * l2 - 1)) : 0;
            const double next = sqrt((4 * next2 - 1) / (next2 - m2)) * (w[2] * p - back * before);
            before = p;
            p = next;
        }
        diagonal *= -sine * sqrt((2 * m + 3.0) / (2 * m + 2.0));
    }
}

void reference_tabulated_at(const reference_tabulated *tabulated, reference_vec w, double rgb[3]) {
    const double wi[3] = { reference_dot(w, tabulated->x), reference_dot(w, tabulated->y),
                           reference_dot(w, tabulated->z) };
    rgb[0] = rgb[1] = rgb[2] = 0;
    if (tabulated->source->coefficients) {
        series_at(tabulated, wi, rgb);
        return;
    }
    if (wi[2] <= 0 || tabulated->wo[2] <= 0)
        return;
    lmp_brdf_eval_double(tabulated->source->brdf, wi, tabulated->wo, rgb);
    for (int c = 0; c < 3; c++)
        rgb[c] *= wi[2];
}
