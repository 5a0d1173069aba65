/* SPDX-License-Identifier: MIT */
/* brdf_series.c - a table's series rotated to the mirror direction, and truncated to the bands and
 * orders that matter there: a lobe is nearly symmetric around it, so few orders matter except at
 * grazing views. */
#include "src/preintegrated/brdf_series.h"

#include "src/base/host.h"

#define TAIL_BANDS       0.06   /* fraction of the error that the bands left out may reach */
#define TAIL_ORDERS      0.12   /* for orders left out; 0.5 errs by 0.64 % at steel, not by 0.32 */
#define TRUNCATION_VIEWS 32     /* views that decide how many bands matter */
#define STEPS_BANDS      40     /* bands up to which every step of the view is rotated */
#define STEPS_FEW        256    /* steps rotated of more bands, about (128: 1.5 % at steel), and */
#define STEPS_LAST       0.9375 /* all steps past this fraction of them */
#define SAMPLES_MIN      16     /* samples, and two more per band */
#define WIDTH            1.2f   /* size of the finest detail, times the bands */

/* --- the coefficients ------------------------------------------------------------------------- */

/* Expands one channel of a view to the full layout l² + l + m, of `bands` bands. */
static void expand(const lmp_brdf_table_info *info, const float *plane, int bands, float *sh) {
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++) {
            const size_t full = LMP_SH_INDEX(l, m);
            sh[full] = !info->mirrored ? plane[full] : m < 0 ? 0 : plane[LMP_SH_HALF_INDEX(l, m)];
        }
}

/* Where series are sampled: angles g from the mirror direction, with Y_lm at azimuth 0. */
typedef struct samples {
    int bands;
    size_t count;
    float *basis; /* [sample][bands²] */
} samples;

static lmp_result samples_create(const lmp_host *host, int bands, samples *made) {
    *made = (samples) { .bands = bands, .count = (size_t)(2 * bands + SAMPLES_MIN) };
    made->basis = lmpi_allocate(host, made->count * LMP_SH_COUNT(bands) * sizeof *made->basis);
    if (!made->basis)
        return LMP_ERROR_MEMORY;
    for (size_t i = 0; i < made->count; i++) {
        const double g = LMPI_PREINTEGRATED_PI * (double)i / (double)(made->count - 1);
        lmp_sh_eval(bands, (lmp_vec3) { (float)sin(g), 0, (float)cos(g) },
                    made->basis + i * LMP_SH_COUNT(bands));
    }
    return LMP_OK;
}

/* What the rotation of views to their lobes' frames needs and finds. */
typedef struct rotation {
    const lmp_brdf_table *table;
    brdf_series *series;
    float error;
    samples samples;
    float floor; /* the least value by which errors are divided */
    float peaks[BRDF_STEPS_MAX + 1];
    int bands[BRDF_STEPS_MAX + 1]; /* that matter */
} rotation;

/* Rotates the first `bands` bands of a view of the table: [channel][bands²]. */
static lmp_result rotate(const rotation *job, int step, int bands, float *rotated) {
    const brdf_series *series = job->series;
    const lmp_brdf_table_info info = lmp_brdf_table_describe(job->table);
    const size_t count = LMP_SH_COUNT(bands);
    const double theta = LMPI_PREINTEGRATED_PI / 2 * step / series->steps;
    const lmp_quat to_mirror = { 0, (float)sin(theta / 2), 0, (float)cos(theta / 2) };
    float *memory = lmpi_allocate(
        &series->host, (3 * info.count + count + LMP_SH_ROTATION_COUNT(bands)) * sizeof *memory);
    if (!memory)
        return LMP_ERROR_MEMORY;
    float *planes = memory, *sh = planes + 3 * info.count, *matrices = sh + count;
    lmp_sh_make_rotation(bands, to_mirror, matrices);
    lmp_brdf_table_interpolate(job->table, (float)cos(theta), 0, planes);
    for (size_t c = 0; c < 3; c++) {
        expand(&info, planes + c * info.count, bands, sh);
        lmp_sh_rotate(bands, matrices, sh, rotated + c * count);
    }
    lmpi_release(&series->host, memory);
    return LMP_OK;
}

/* Evaluates band l of a channel at a sample, on both sides of the mirror direction. */
static void band_at(const float *sh, const float *basis, int l, float sides[2]) {
    const int at = l * l + l;
    float even = 0, odd = 0;
    for (int m = 0; m <= l; m += 2)
        even += sh[at + m] * basis[at + m];
    for (int m = 1; m <= l; m += 2)
        odd += sh[at + m] * basis[at + m];
    sides[0] = even + odd;
    sides[1] = even - odd;
}

/* Computes peaks[l], the largest sum of the bands from l on where bands fall to 0, for every l. */
static void tails(const rotation *job, const float *rotated, float *peaks) {
    const int bands = job->samples.bands;
    const size_t count = LMP_SH_COUNT(bands);
    for (int l = 0; l < bands; l++)
        peaks[l] = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < job->samples.count; i++) {
            float sums[2] = { 0, 0 }, sides[2];
            for (int l = bands - 1; l >= 0; l--) {
                band_at(rotated + c * count, job->samples.basis + i * count, l, sides);
                sums[0] += sides[0];
                sums[1] += sides[1];
                peaks[l] = fmaxf(peaks[l], fmaxf(fabsf(sums[0]), fabsf(sums[1])));
            }
        }
}

/* Finds how many bands of one view matter. */
static lmp_result truncate_view(size_t index, void *data) {
    rotation *job = data;
    const int bands = job->samples.bands, step = (int)index * job->series->steps / TRUNCATION_VIEWS;
    float peaks[LMP_BANDS_MAX];
    float *rotated = lmpi_allocate(&job->series->host, 3 * LMP_SH_COUNT(bands) * sizeof *rotated);
    const lmp_result result = rotated ? rotate(job, step, bands, rotated) : LMP_ERROR_MEMORY;
    if (result == LMP_OK) {
        tails(job, rotated, peaks);
        job->peaks[index] = peaks[0];
        job->bands[index] = 1;
        for (int l = 1; l < bands; l++)
            if (!(peaks[l] <= (float)TAIL_BANDS * job->error * peaks[0]))
                job->bands[index] = l + 1;
    }
    lmpi_release(&job->series->host, rotated);
    return result;
}

static lmp_result truncate_bands(rotation *job) {
    const size_t views = TRUNCATION_VIEWS + 1;
    const lmp_result result =
        lmpi_host_run(&job->series->host, 0, BRDF_TRUNCATION_DONE, views, truncate_view, job);
    job->series->bands = 1;
    for (size_t i = 0; i < views; i++) {
        if (job->bands[i] > job->series->bands)
            job->series->bands = job->bands[i];
        job->floor = fmaxf(job->floor, (float)LMPI_PREINTEGRATED_BRDF_FLOOR * job->peaks[i]);
    }
    return result;
}

/* Sums what each order of a channel gives at a sample; a mirrored table has no sines. */
static void sum_orders(const float *sh, const float *basis, int bands, bool mirrored,
                       float *cosines, float *sines) {
    for (int m = 0; m < bands; m++)
        cosines[m] = sines[m] = 0;
    for (int l = 0; l < bands; l++) {
        const float *c = sh + l * l + l, *y = basis + l * l + l;
        for (int m = 0; m <= l; m++)
            cosines[m] += c[m] * y[m];
        for (int m = 1; m <= l && !mirrored; m++)
            sines[m] += c[-m] * y[m];
    }
}

/* Finds the largest value of a view, and returns how many of its orders keep its values. */
static int count_orders(const rotation *job, const float *rotated, float *peak) {
    const int bands = job->series->bands;
    const size_t count = LMP_SH_COUNT(bands), all = LMP_SH_COUNT(job->samples.bands);
    float largest[LMP_BANDS_MAX] = { 0 }, cosines[LMP_BANDS_MAX], sines[LMP_BANDS_MAX];
    *peak = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < job->samples.count; i++) {
            float even = 0, odd = 0;
            sum_orders(rotated + c * count, job->samples.basis + i * all, bands,
                       job->series->mirrored, cosines, sines);
            for (int m = 0; m < bands; m++) {
                *(m % 2 ? &odd : &even) += cosines[m];
                largest[m] = fmaxf(largest[m], fmaxf(fabsf(cosines[m]), fabsf(sines[m])));
            }
            *peak = fmaxf(*peak, fmaxf(fabsf(even + odd), fabsf(even - odd)));
        }
    const float limit = (float)TAIL_ORDERS * job->error * fmaxf(*peak, job->floor);
    float rest = 0;
    for (int m = bands - 1; m > 0; m--) {
        rest += largest[m];
        if (!(rest <= limit))
            return m + 1;
    }
    return 1;
}

static lmp_result rotate_view(size_t index, void *data) {
    rotation *job = data;
    brdf_series *series = job->series;
    const size_t count = LMP_SH_COUNT(series->bands);
    float *rotated = series->coefficients + 3 * count * index, ambient[3];
    const lmp_result result = rotate(job, series->step[index], series->bands, rotated);
    if (result != LMP_OK)
        return result;
    for (size_t c = 0; c < 3; c++)
        ambient[c] = rotated[c * count] * (float)sqrt(4 * LMPI_PREINTEGRATED_PI);
    series->ambient[index] = (lmp_rgb) { ambient[0], ambient[1], ambient[2] };
    series->orders[index] = count_orders(job, rotated, &job->peaks[index]);
    return LMP_OK;
}

/* Returns the smallest solid angle, over the views, of a lobe as high as the view's peak that
 * reflects all the view reflects. */
static float lobe_angle(const rotation *job) {
    const brdf_series *series = job->series;
    const int bands = series->bands;
    float angle = (float)(2 * LMPI_PREINTEGRATED_PI);
    for (int i = 0; series->step[i] < series->steps * 3 / 4; i++) {
        const lmp_rgb all = series->ambient[i];
        const float most = fmaxf(all.r, fmaxf(all.g, all.b));
        if (most < angle * job->peaks[i])
            angle = most / job->peaks[i];
    }
    return fmaxf(angle, (float)LMPI_PREINTEGRATED_PI / (float)(bands * bands));
}

/* Returns the number of steps of the view. A table bends at its views, and falls where a fit's
 * shadowing begins: steps divide the views' step, so that no bend lies within one. (Tables of more
 * than 512 views have finer steps, and hardly bend.) */
static int count_steps(int views) {
    const int halves = 2 * views - 1;
    return halves > BRDF_STEPS_MAX ? BRDF_STEPS_MAX : halves * (BRDF_STEPS_MAX / halves);
}

/* Chooses the steps that are rotated, at a cost of bands³ each. For few bands it takes all. For
 * many it takes every so many, the table's own views among them, and all of the last ones, where
 * the light that a fit reflects grows and falls fastest. */
static void choose_steps(brdf_series *series, int views, int bands) {
    const int parts = series->steps / (2 * views - 1); /* parts of half a view's step */
    int stride = 1;
    while (bands > STEPS_BANDS && stride < parts &&
           (series->steps > stride * STEPS_FEW || parts % stride))
        stride++;
    for (int step = 0; step <= series->steps; step++)
        if (step % stride == 0 || step >= (int)(STEPS_LAST * series->steps))
            series->step[series->view_count++] = step;
}

int lmpi_preintegrated_brdf_view_at(const brdf_series *series, int part, int parts) {
    int view = series->view_count - 1;
    while (series->step[view] > series->steps * part / parts)
        view--;
    return view;
}

static lmp_result rotate_all(rotation *job) {
    brdf_series *series = job->series;
    const size_t views = (size_t)series->view_count;
    lmp_result result = truncate_bands(job);
    if (result != LMP_OK)
        return result;
    series->coefficients = lmpi_allocate(&series->host, 3 * LMP_SH_COUNT(series->bands) * views *
                                                            sizeof *series->coefficients);
    if (!series->coefficients)
        return LMP_ERROR_MEMORY;
    result = lmpi_host_run(&series->host, BRDF_TRUNCATION_DONE, BRDF_SERIES_DONE, views,
                           rotate_view, job);
    if (result != LMP_OK)
        return result;
    for (size_t i = 1; i < views; i++)
        if (series->orders[i] < series->orders[i - 1])
            series->orders[i] = series->orders[i - 1];
    series->width = WIDTH / (float)series->bands;
    series->lobe_angle = lobe_angle(job);
    series->radius = sqrtf(series->lobe_angle / (float)LMPI_PREINTEGRATED_PI);
    return LMP_OK;
}

lmp_result lmpi_preintegrated_brdf_series(const lmp_host *host, float error,
                                          const lmp_brdf_table *table, brdf_series *series) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    *series = (brdf_series) { .host = *host,
                              .steps = count_steps(info.views),
                              .mirrored = info.mirrored };
    choose_steps(series, info.views, info.bands);
    rotation *job = lmpi_allocate(&series->host, sizeof *job);
    if (!job)
        return LMP_ERROR_MEMORY;
    *job = (rotation) { .table = table, .series = series, .error = error };
    lmp_result result = samples_create(&series->host, info.bands, &job->samples);
    if (result == LMP_OK)
        result = rotate_all(job);
    if (result != LMP_OK)
        lmpi_preintegrated_brdf_series_free(series);
    lmpi_release(&series->host, job->samples.basis);
    lmpi_release(&series->host, job);
    return result;
}

void lmpi_preintegrated_brdf_series_free(brdf_series *series) {
    lmpi_release(&series->host, series->coefficients);
    series->coefficients = NULL;
}
