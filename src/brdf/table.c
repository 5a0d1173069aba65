/* SPDX-License-Identifier: MIT */
#include "src/brdf/table.h"
#include "src/brdf/quadrature.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#define TOLERANCE_DEFAULT 1e-4f
#define RINGS_MIN         16
#define RINGS_DEFAULT     512
#define RINGS_MAX         2048

lmp_result lmpi_brdf_table_new(const lmp_host *host, const lmp_brdf_table_info *info,
                               lmp_brdf_table **table) {
    *table = NULL;
    const size_t count =
        info->mirrored ? LMP_SH_HALF_COUNT(info->bands) : LMP_SH_COUNT(info->bands);
    const size_t head = (sizeof **table + 15) & ~(size_t)15;
    const size_t floats = 3 * count * (size_t)info->views * (size_t)info->azimuths;
    const lmp_host resolved = lmpi_host_resolve(host);
    lmp_brdf_table *made = lmpi_allocate(&resolved, head + floats * sizeof(float));
    if (!made)
        return LMP_ERROR_MEMORY;
    made->host = resolved;
    made->info = *info;
    made->info.count = count;
    made->info.theta_step = (float)(BRDF_PI / 2 / (info->views - 0.5));
    made->coefficients = (float *)(void *)((unsigned char *)made + head);
    *table = made;
    return LMP_OK;
}

void lmp_brdf_table_destroy(lmp_brdf_table *table) {
    lmpi_release_object(table);
}

lmp_brdf_table_info lmp_brdf_table_describe(const lmp_brdf_table *table) {
    return table->info;
}

const float *lmp_brdf_table_coefficients(const lmp_brdf_table *table) {
    return table->coefficients;
}

/* --- making ----------------------------------------------------------------------------------- */

/* One doubling of the nodes over all views; task i is view i % views of azimuth i / views. */
typedef struct table_job {
    const lmp_brdf *brdf;
    lmp_brdf_table *table;
    const brdf_quadrature *quadrature;
    float tolerance;
    float *change; /* [azimuth][view]: at the last doubling; INFINITY before the first */
} table_job;

/* Writes a view's coefficients in the order of the table; returns the relative change. Values are
 * compared by hand because gcc 12 for AArch64 fails on the vectors that it makes of fmax. */
static float store_view(const lmp_brdf_table_info *info, const double *cosine, const double *sine,
                        float *row) {
    const size_t half_count = LMP_SH_HALF_COUNT(info->bands);
    double largest = 0, change = 0;
    for (size_t channel = 0; channel < 3; channel++, row += info->count)
        for (int l = 0; l < info->bands; l++)
            for (int m = info->mirrored ? 0 : -l; m <= l; m++) {
                const size_t from = channel * half_count + brdf_half_index(info->bands, l, abs(m));
                const double value = m < 0 ? sine[from] : cosine[from];
                float *to = row + (info->mirrored ? LMP_SH_HALF_INDEX(l, m) : LMP_SH_INDEX(l, m));
                const double size = fabs(value), moved = fabs(value - (double)*to);
                largest = size > largest ? size : largest;
                change = moved > change ? moved : change;
                *to = (float)value;
            }
    return largest > 0 ? (float)(change / largest) : 0;
}

static lmp_result make_view(size_t index, void *data) {
    const table_job *job = data;
    lmp_brdf_table *table = job->table;
    const lmp_brdf_table_info *info = &table->info;
    if (job->change[index] <= job->tolerance)
        return LMP_OK;
    const size_t half_count = LMP_SH_HALF_COUNT(info->bands);
    double *parts = lmpi_allocate(&table->host, 6 * half_count * sizeof *parts);
    if (!parts)
        return LMP_ERROR_MEMORY;
    const double theta = (double)info->theta_step * (double)(index % (size_t)info->views);
    const double phi = 2 * BRDF_PI * (double)(index / (size_t)info->views) / (double)info->azimuths;
    const brdf_projection projection = {
        .brdf = job->brdf,
        .view = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) },
        .rotation = { cos(phi), sin(phi) },
        .mirrored = info->mirrored,
    };
    lmpi_brdf_project_view(&projection, job->quadrature, parts, parts + 3 * half_count);
    const float change = store_view(info, parts, parts + 3 * half_count,
                                    table->coefficients + index * 3 * info->count);
    job->change[index] = isinf(job->change[index]) ? 1e30f : change;
    lmpi_release(&table->host, parts);
    return LMP_OK;
}

static float largest_change(const table_job *job, size_t total) {
    float largest = 0;
    for (size_t i = 0; i < total; i++)
        largest = fmaxf(largest, job->change[i]);
    return largest;
}

/* Doubles the nodes until no view changes by more than the tolerance. */
static lmp_result refine(table_job *job, int rings_max) {
    lmp_brdf_table_info *info = &job->table->info;
    const size_t total = (size_t)info->views * (size_t)info->azimuths;
    int rings = 32;
    while (rings < info->bands)
        rings *= 2;
    rings = rings < rings_max / 2 ? rings : rings_max / 2;
    for (;;) {
        brdf_quadrature quadrature;
        lmp_result result =
            lmpi_brdf_quadrature_create(&job->table->host, info->bands, rings, &quadrature);
        if (result != LMP_OK)
            return result;
        job->quadrature = &quadrature;
        /* each doubling costs four times the one before: a quarter of what is left */
        const double done = (double)rings * rings / ((double)rings_max * rings_max);
        result = lmpi_host_run(&job->table->host, done / 4, done, total, make_view, job);
        lmpi_brdf_quadrature_destroy(&job->table->host, &quadrature);
        if (result != LMP_OK)
            return result;
        info->rings = rings;
        info->change = largest_change(job, total);
        if (info->change <= job->tolerance || rings >= rings_max)
            return lmpi_host_report(&job->table->host, 1);
        rings = 2 * rings < rings_max ? 2 * rings : rings_max;
    }
}

static void apply_window(lmp_brdf_table *table) {
    const lmp_brdf_table_info *info = &table->info;
    float weights[LMP_BANDS_MAX];
    lmp_sh_make_window(info->bands, info->window, info->window_size, weights);
    const size_t planes = 3 * (size_t)info->views * (size_t)info->azimuths;
    float *value = table->coefficients;
    for (size_t plane = 0; plane < planes; plane++)
        for (int l = 0; l < info->bands; l++)
            for (int i = 0; i < (info->mirrored ? l + 1 : 2 * l + 1); i++)
                *value++ *= weights[l];
}

/* Whether mirroring an isotropic BRDF changes it by no more than measurement noise: 5 % on average
 * over a fixed lattice of directions. */
static bool is_nearly_mirrored(const lmp_brdf *brdf) {
    double difference = 0, sum = 0;
    for (int o = 1; o < 8; o++)
        for (int i = 1; i < 8; i++)
            for (int k = 1; k < 16; k++) {
                const double theta_o = o * BRDF_PI / 16, theta_i = i * BRDF_PI / 16;
                const double phi = k * BRDF_PI / 16;
                const double view[3] = { sin(theta_o), 0, cos(theta_o) };
                double light[3] = { sin(theta_i) * cos(phi), sin(theta_i) * sin(phi),
                                    cos(theta_i) };
                double left[3], right[3];
                brdf->eval(brdf, view, light, left);
                light[1] = -light[1];
                brdf->eval(brdf, view, light, right);
                for (int c = 0; c < 3; c++) {
                    difference += fabs(left[c] - right[c]);
                    sum += (left[c] + right[c]) / 2;
                }
            }
    return difference <= 0.05 * sum;
}

static bool is_mirrored(const lmp_brdf *brdf, lmp_brdf_symmetry symmetry) {
    if (brdf->info.anisotropic || symmetry == LMP_BRDF_SYMMETRY_NONE)
        return false;
    return symmetry == LMP_BRDF_SYMMETRY_MIRROR || brdf->info.mirrored || is_nearly_mirrored(brdf);
}

static bool within(int value, int minimum, int maximum) {
    return value >= minimum && value <= maximum;
}

/* Returns the default number of views: at least five to the wavelength of the last band, 2 pi /
 * bands. With fewer, the cubic between two views shows a narrow lobe twice. (An anisotropic table
 * would take a gigabyte.) */
static int default_views(const lmp_brdf *brdf, int bands) {
    const int fine = (5 * bands + 3) / 4;
    return fine > LMP_BRDF_VIEWS_DEFAULT && !brdf->info.anisotropic ? fine : LMP_BRDF_VIEWS_DEFAULT;
}

/* Fills in the desc's defaults; returns false if a value is out of range. */
static bool resolve(const lmp_brdf *brdf, lmp_brdf_table_desc *desc) {
    desc->bands = desc->bands ? desc->bands : LMP_BRDF_BANDS_DEFAULT;
    desc->views = desc->views ? desc->views : default_views(brdf, desc->bands);
    desc->azimuths = desc->azimuths ? desc->azimuths : LMP_BRDF_AZIMUTHS_DEFAULT;
    desc->azimuths = brdf->info.anisotropic ? desc->azimuths : 1;
    desc->tolerance = desc->tolerance != 0 ? desc->tolerance : TOLERANCE_DEFAULT;
    if (!desc->rings_max) {
        desc->rings_max = brdf->info.rings ? brdf->info.rings : RINGS_DEFAULT;
        while (desc->rings_max < brdf->rings_per_band * desc->bands)
            desc->rings_max *= 2;
    }
    const bool azimuths = desc->azimuths == 1 ||
                          (within(desc->azimuths, 4, BRDF_AZIMUTHS_MAX) && desc->azimuths % 2 == 0);
    return within(desc->bands, 1, LMP_BANDS_MAX) && within(desc->views, 2, BRDF_VIEWS_MAX) &&
           azimuths && desc->tolerance > 0 && within(desc->rings_max, RINGS_MIN, RINGS_MAX) &&
           within((int)desc->window, LMP_WINDOW_NONE, LMP_WINDOW_COUNT - 1) &&
           within((int)desc->symmetry, LMP_BRDF_SYMMETRY_AUTO, LMP_BRDF_SYMMETRY_NONE) &&
           desc->window_size >= 0 && isfinite(desc->window_size);
}

lmp_result lmp_brdf_table_create(const lmp_host *host, const lmp_brdf_table_desc *desc,
                                 const lmp_brdf *brdf, lmp_brdf_table **table) {
    *table = NULL;
    lmp_brdf_table_desc own = desc ? *desc : (lmp_brdf_table_desc) { 0 };
    if (!resolve(brdf, &own))
        return LMP_ERROR_ARGUMENT;
    const lmp_brdf_table_info info = {
        .bands = own.bands,
        .views = own.views,
        .azimuths = own.azimuths,
        .mirrored = is_mirrored(brdf, own.symmetry),
        .window = own.window,
        .window_size = own.window_size > 0 ? own.window_size : (float)own.bands,
    };
    lmp_brdf_table *made = NULL;
    lmp_result result = lmpi_brdf_table_new(host, &info, &made);
    if (result != LMP_OK)
        return result;
    const size_t total = (size_t)own.views * (size_t)own.azimuths;
    table_job job = { .brdf = brdf, .table = made, .tolerance = own.tolerance };
    job.change = lmpi_allocate(&made->host, total * sizeof *job.change);
    if (job.change) {
        for (size_t i = 0; i < total; i++)
            job.change[i] = INFINITY;
        result = refine(&job, own.rings_max);
        lmpi_release(&made->host, job.change);
    } else
        result = LMP_ERROR_MEMORY;
    if (result != LMP_OK) {
        lmp_brdf_table_destroy(made);
        return result;
    }
    apply_window(made);
    *table = made;
    return LMP_OK;
}

lmp_result lmp_brdf_project(const lmp_host *host, int bands, int rings, const lmp_brdf *brdf,
                            lmp_vec3 wo, float *rgb) {
    if (!within(bands, 1, LMP_BANDS_MAX) || !within(rings, 1, RINGS_MAX) || !(wo.z > 0))
        return LMP_ERROR_ARGUMENT;
    const double x = (double)wo.x, y = (double)wo.y, z = (double)wo.z;
    const double length = sqrt(x * x + y * y + z * z);
    const lmp_host resolved = lmpi_host_resolve(host);
    const size_t half_count = LMP_SH_HALF_COUNT(bands);
    brdf_quadrature quadrature;
    const lmp_result result = lmpi_brdf_quadrature_create(&resolved, bands, rings, &quadrature);
    if (result != LMP_OK)
        return result;
    double *parts = lmpi_allocate(&resolved, 6 * half_count * sizeof *parts);
    if (parts) {
        const brdf_projection projection = {
            .brdf = brdf,
            .view = { x / length, y / length, z / length },
            .rotation = { 1, 0 },
        };
        lmpi_brdf_project_view(&projection, &quadrature, parts, parts + 3 * half_count);
        const lmp_brdf_table_info info = { .bands = bands, .count = LMP_SH_COUNT(bands) };
        store_view(&info, parts, parts + 3 * half_count, rgb);
        lmpi_release(&resolved, parts);
    }
    lmpi_brdf_quadrature_destroy(&resolved, &quadrature);
    return parts ? LMP_OK : LMP_ERROR_MEMORY;
}

/* --- reading ---------------------------------------------------------------------------------- */

/* Computes the weights of four neighbors (Catmull-Rom), with t in 0 … 1 from the second to the
 * third. */
static void cubic_weights(float t, float weights[4]) {
    const float t2 = t * t, t3 = t2 * t;
    weights[0] = (-t3 + 2 * t2 - t) / 2;
    weights[1] = (3 * t3 - 5 * t2 + 2) / 2;
    weights[2] = (-3 * t3 + 4 * t2 + t) / 2;
    weights[3] = (t3 - t2) / 2;
}

/* The coefficients of a view that are read: bands low … high-1, `count` of each channel from
 * `first` on. */
typedef struct band_part {
    int low, high;
    size_t first, count;
} band_part;

static band_part part_of(const lmp_brdf_table_info *info, int low, int high) {
    const size_t first = info->mirrored ? LMP_SH_HALF_COUNT(low) : LMP_SH_COUNT(low);
    const size_t end = info->mirrored ? LMP_SH_HALF_COUNT(high) : LMP_SH_COUNT(high);
    return (band_part) { low, high, first, end - first };
}

/* Adds weight * the row of a view to rgb, odd m negated if `rotated`. */
static void add_row(const lmp_brdf_table *table, band_part part, int azimuth, int view,
                    float weight, bool rotated, float *rgb) {
    const lmp_brdf_table_info *info = &table->info;
    const float *row = table->coefficients +
                       ((size_t)azimuth * (size_t)info->views + (size_t)view) * 3 * info->count;
    for (size_t channel = 0; channel < 3; channel++) {
        const float *from = row + channel * info->count + part.first;
        if (!rotated)
            for (size_t i = 0; i < part.count; i++)
                *rgb++ += weight * from[i];
        else
            for (int l = part.low; l < part.high; l++)
                for (int m = info->mirrored ? 0 : -l; m <= l; m++)
                    *rgb++ += (m & 1 ? -weight : weight) * *from++;
    }
}

/* Adds one azimuth's part. Past the pole the views go on at the opposite azimuth, in a frame
 * rotated by pi; past the last view the table is continued linearly. */
static void add_azimuth(const lmp_brdf_table *table, band_part part, float theta, int azimuth,
                        float weight, float *rgb) {
    const lmp_brdf_table_info *info = &table->info;
    const int last = info->views - 1;
    const float position = fminf(theta / info->theta_step, (float)last);
    const int first = (int)position < last ? (int)position : last - 1;
    float weights[4];
    cubic_weights(position - (float)first, weights);
    if (first + 2 > last) {
        weights[2] += 2 * weights[3];
        weights[1] -= weights[3];
        weights[3] = 0;
    }
    for (int k = 0; k < 4; k++) {
        const int view = first - 1 + k;
        if (weights[k] == 0)
            continue;
        if (view >= 0)
            add_row(table, part, azimuth, view, weight * weights[k], false, rgb);
        else
            add_row(table, part, (azimuth + info->azimuths / 2) % info->azimuths, 1,
                    weight * weights[k], true, rgb);
    }
}

size_t lmpi_brdf_table_bands(const lmp_brdf_table *table, float cos_theta_o, float phi_o, int low,
                             int high, float *rgb) {
    const lmp_brdf_table_info *info = &table->info;
    const float theta = acosf(fminf(fmaxf(cos_theta_o, 0), 1));
    const band_part part = part_of(info, low, high);
    const bool is_view = !isnan(cos_theta_o) && (info->azimuths == 1 || isfinite(phi_o));
    assert(is_view);
    for (size_t i = 0; i < 3 * part.count; i++)
        rgb[i] = is_view ? 0 : NAN;
    if (!is_view)
        return part.count;
    if (info->azimuths == 1) {
        add_azimuth(table, part, theta, 0, 1, rgb);
        return part.count;
    }
    const float turns = phi_o / (float)(2 * BRDF_PI);
    const float position = (turns - floorf(turns)) * (float)info->azimuths;
    const int first = (int)position;
    float weights[4];
    cubic_weights(position - (float)first, weights);
    for (int k = 0; k < 4; k++)
        add_azimuth(table, part, theta, (first - 1 + k + info->azimuths) % info->azimuths,
                    weights[k], rgb);
    return part.count;
}

void lmp_brdf_table_interpolate(const lmp_brdf_table *table, float cos_theta_o, float phi_o,
                                float *rgb) {
    lmpi_brdf_table_bands(table, cos_theta_o, phi_o, 0, table->info.bands, rgb);
}

void lmp_brdf_table_find_albedo(const lmp_brdf_table *table, int view, int azimuth,
                                lmp_rgb *whole_rgb, lmp_rgb *series) {
    const lmp_brdf_table_info *info = &table->info;
    const float *row = table->coefficients +
                       ((size_t)azimuth * (size_t)info->views + (size_t)view) * 3 * info->count;
    double whole[3], upper[3];
    for (int channel = 0; channel < 3; channel++, row += info->count) {
        whole[channel] = sqrt(4 * BRDF_PI) * (double)row[0];
        upper[channel] = sqrt(BRDF_PI) * (double)row[0];
        /* the hemisphere's coefficients are pi R_l(0) Y_l0 of odd l, R_l(0) = -R_(l-2)(0)
         * (l-2)/(l+1) */
        double r = 1;
        for (int l = 1; l < info->bands; l += 2) {
            if (l > 1)
                r *= -(l - 2.0) / (l + 1);
            const float value = row[info->mirrored ? LMP_SH_HALF_INDEX(l, 0) : LMP_SH_INDEX(l, 0)];
            upper[channel] += BRDF_PI * r * sqrt((2 * l + 1) / (4 * BRDF_PI)) * (double)value;
        }
    }
    *whole_rgb = (lmp_rgb) { (float)whole[0], (float)whole[1], (float)whole[2] };
    *series = (lmp_rgb) { (float)upper[0], (float)upper[1], (float)upper[2] };
}
