/* SPDX-License-Identifier: MIT */
/* shaded.h - what the kernels of shading should give, in double precision and written from
 * lampion/shade.h and lampion/preintegrated.h. */
#ifndef LAMPION_SHADED_H
#define LAMPION_SHADED_H

#include "tests/kernels/shading.h"

#define VECTOR(array) ((const float *const[3]) { (array)[0], (array)[1], (array)[2] })

static void widen(const float *const from[3], int i, double to[3]) {
    for (int k = 0; k < 3; k++)
        to[k] = (double)from[k][i];
}

/* Bounds the rounding of cos a near the surface, alpha2 = cos² a = (d² - r²) / d². With u = 6e-8
 * half a unit, d² is off by up to 3u d² (a product and two sums) and r² by u r²; their difference
 * is then exact. So cos² a is off by 4u, and cos a by 2u / cos a; 3.8u of 4u were seen in 4e7
 * draws. The digits are lost in the squares: no form of the difference in floats restores them. */
static double surface_bound(double alpha2) {
    return fmin(1.2e-7 / sqrt(fmax(alpha2, 1e-30)), 3e-4);
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A surface and what it sees. */
typedef struct seen {
    double point[3], normal[3], view[3], axis[LMPI_KERNEL_LOBES_MAX][3];
} seen;

static void see(const shading *s, int i, seen *surface) {
    const inputs *in = s->in;
    widen(VECTOR(in->point), i, surface->point);
    widen(VECTOR(in->normal), i, surface->normal);
    widen(VECTOR(in->view), i, surface->view);
    for (int k = 0; k < s->lobes; k++)
        widen(VECTOR(s->axis[k]), i, surface->axis[k]);
}

/* A light seen from a surface, as lmp_light_find_cap returns it: a cap of at most a hemisphere, and
 * inside a sphere ambient light less the cap. */
typedef struct seen_light {
    double center[3], point[3], radius; /* for oracle_sphere */
    double axis[3], t;                  /* 1 - cos a */
    double solid_angle;                 /* of the cap; for a Dirac, what makes it as strong */
    double rounded;                     /* size of what is rounded: for a cone, all of it */
    double alpha2;                      /* cos² a */
    bool inside, nothing, dirac;
} seen_light;

/* Returns the fraction of a Dirac's light that leaves in a direction. */
static double falloff_of(const lmpi_packed_light *l, const double axis[3]) {
    if (l->form != LMPI_FORM_CONE)
        return 1;
    const double cosine =
        -(axis[0] * (double)l->axis.x + axis[1] * (double)l->axis.y + axis[2] * (double)l->axis.z);
    return pow(fmin(fmax((cosine - (double)l->outer) / (double)l->width, 0), 1), 2);
}

static void see_light(const shading *s, const seen *surface, int light, seen_light *to) {
    const lmpi_packed_light *l = &s->lights[light];
    const double center[3] = { (double)l->at.x, (double)l->at.y, (double)l->at.z };
    double v[3];
    for (int k = 0; k < 3; k++) {
        to->center[k] = center[k];
        to->point[k] = l->fixed ? 0 : surface->point[k];
        v[k] = center[k] - to->point[k];
    }
    const double size = (double)l->size, d2 = dot3(v, v), d = sqrt(d2);
    const bool cap = l->form == LMPI_FORM_CAP;
    to->dirac = l->form == LMPI_FORM_DIRAC || l->form == LMPI_FORM_CONE;
    const double r = to->dirac ? 0 : cap ? sqrt(size * (2 - size) * d2) : size;
    to->radius = r;
    to->inside = d < r;
    to->nothing = d2 == 0 && r == 0 && !to->dirac;
    const double sine2 = d2 == 0 && r == 0 ? 0 : to->inside ? d2 / (r * r) : r * r / d2;
    to->alpha2 = cap ? 1 : 1 - sine2; /* given by its cosine */
    to->t = cap ? size : sine2 / (1 + sqrt(1 - sine2));
    for (int k = 0; k < 3; k++)
        to->axis[k] = d2 > 0 ? (to->inside ? -v[k] : v[k]) / d : k == 2;
    const double least = (double)LMPI_DIRAC_DISTANCE_MIN;
    const double strength = l->fixed ? 1 : 1 / fmax(d2, least * least);
    to->solid_angle = to->dirac ? strength * falloff_of(l, to->axis) : 2 * ORACLE_PI * to->t;
    to->rounded = to->dirac ? fmax(strength, 1) : 1;
}

/* The expected value of an element, and how far rounding may move it. */
typedef struct shaded {
    double values[3 + 3 * LMPI_KERNEL_LOBES_MAX], bound;
} shaded;

static void shaded_add(shaded *sum, int first, lmp_rgb rgb, const double response[3]) {
    sum->values[first] += (double)rgb.r * response[0];
    sum->values[first + 1] += (double)rgb.g * response[1];
    sum->values[first + 2] += (double)rgb.b * response[2];
}

/* Computes the coefficients of a light of color 1. */
static void light_sh(int bands, const seen_light *one, double *sh) {
    if (!one->dirac) {
        oracle_sphere(bands, one->center, one->radius, one->point, sh, NULL);
        return;
    }
    oracle_sh_eval(bands, one->axis, sh);
    for (size_t j = 0; j < LMP_SH_COUNT(bands); j++)
        sh[j] *= one->solid_angle;
}

/* Returns a lobe's response by its definition, Σ lambda_l L_lm Y_lm(axis). */
static double lobe_of(int bands, const double *lambda, const double *sh, const double *axis) {
    double sum = 0;
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            sum += lambda[l] * sh[LMP_SH_INDEX(l, m)] * axis[LMP_SH_INDEX(l, m)];
    return sum;
}

/* Computes lambda_l of the lobe of integral 1. */
static void phong_of(int bands, double e, double *lambda) {
    for (int l = 0; l < bands; l++)
        lambda[l] = l == 0   ? 1
                    : l == 1 ? (e + 1) / (e + 2)
                             : lambda[l - 2] * (e - l + 2) / (e + l + 1);
}

/* Adds the response of the diffuse lobe of integral 1. */
static void add_diffuse(const seen *surface, const seen_light *one, lmp_rgb color, shaded *to) {
    const double cosine = dot3(surface->normal, one->axis);
    double value = one->solid_angle * fmax(cosine, 0) / ORACLE_PI;
    if (!one->dirac) {
        const double cap = oracle_irradiance(cosine, one->t) / ORACLE_PI;
        value = one->inside ? 1 - cap : cap;
    }
    shaded_add(to, 0, color, (double[3]) { value, value, value });
    to->bound += one->rounded * 1e-6 + surface_bound(one->alpha2);
}

/* Computes the responses of Phong lobes by bands: dot products with their coefficients. */
static void expect_zonal(const shading *s, int i, shaded *to) {
    static double sh[128 * 128], around[LMPI_KERNEL_LOBES_MAX][128 * 128];
    static double lambda[LMPI_KERNEL_LOBES_MAX][128];
    seen surface;
    double size = 0;
    see(s, i, &surface);
    for (int k = 0; k < s->lobes; k++) {
        oracle_sh_eval(s->bands, surface.axis[k], around[k]);
        phong_of(s->bands, (double)s->exponent[k][i], lambda[k]);
        for (int l = 0; l < s->bands; l++) {
            lambda[k][l] *= (double)s->window[l];
            size += fabs(lambda[k][l]) * (2 * l + 1);
        }
    }
    *to = (shaded) { { 0 }, 0 };
    for (int light = 0; light < SHADE_LIGHTS; light++) {
        seen_light one;
        see_light(s, &surface, light, &one);
        if (one.nothing)
            continue;
        light_sh(s->bands, &one, sh);
        add_diffuse(&surface, &one, s->lights[light].color, to);
        for (int k = 0; k < s->lobes; k++) {
            const double value = lobe_of(s->bands, lambda[k], sh, around[k]);
            shaded_add(to, 3 + 3 * k, s->lights[light].color, (double[3]) { value, value, value });
        }
        to->bound += 4e-7 + (1e-9 + 0.05 * surface_bound(one.alpha2)) * size;
        if (one.dirac) /* no band of a Dirac is damped: the peak that shade.h describes */
            to->bound += one.rounded * size / (4 * ORACLE_PI) * (3e-6 + 2e-7 * s->bands * s->bands);
    }
}

static void spline(double x, double w[4]) {
    const double y = 1 - x;
    w[0] = y * y * y / 6;
    w[1] = (4 - 6 * x * x + 3 * x * x * x) / 6;
    w[2] = (4 - 6 * y * y + 3 * y * y * y) / 6;
    w[3] = x * x * x / 6;
}

/* The steepest slope of splines whose coefficients lie in -1 … 1, and the integers' part of the
 * error: weights in units of 1/32767. */
#define STEEPEST 2.0
#define WHOLE    4e-5

/* Returns one reading of a lobe: its mean over the cap. */
static double read_lobe(const shading *s, uint32_t first, uint32_t columns, const float position[3],
                        double cosine, double t) {
    const double weight = (double)position[0], density = (double)position[1];
    const double x = acos(fmin(fmax(cosine, -1), 1)) * density, y = acos(1 - t) * density;
    const size_t column = (size_t)x, row = (size_t)y;
    double wx[4], wy[4], sum = 0;
    spline(x - (double)column, wx);
    spline(y - (double)row, wy);
    for (size_t k = 0; k < 4; k++)
        for (size_t j = 0; j < 4; j++) {
            const int16_t *pair = s->pairs + 2 * (first + (row + k) * columns + column + j);
            sum += wy[k] * wx[j] * ((1 - weight) * pair[0] + weight * pair[1]);
        }
    return sum * 2 / 32767 / (2 * ORACLE_PI * t + (double)position[2]);
}

/* Adds the mean, or ambient light less the mean, times the cap's solid angle. */
static void add_mean(const seen_light *one, const lmpi_packed_light *light, int first,
                     const double mean[3], const double ambient[3], shaded *to) {
    double value[3];
    for (int c = 0; c < 3; c++) {
        const double covered = one->solid_angle * mean[c];
        value[c] = one->inside ? ambient[c] - covered : covered;
    }
    shaded_add(to, first, light->color, value);
}

static void expect_preintegrated_lobe(const shading *s, int i, shaded *to) {
    seen surface;
    see(s, i, &surface);
    *to = (shaded) { { 0 }, 0 };
    for (int light = 0; light < SHADE_LIGHTS; light++) {
        seen_light one;
        see_light(s, &surface, light, &one);
        if (one.nothing)
            continue;
        add_diffuse(&surface, &one, s->lights[light].color, to);
        for (int k = 0; k < s->lobes; k++) {
            const float position[3] = { s->weight[k][i], s->density[k][i], s->angle[k][i] };
            const double cosine = dot3(surface.axis[k], one.axis);
            const double mean =
                read_lobe(s, s->first[k][i], s->columns[k][i], position, cosine, one.t);
            add_mean(&one, &s->lights[light], 3 + 3 * k, (double[3]) { mean, mean, mean },
                     (double[3]) { 1, 1, 1 }, to);
            /* acos near 1 keeps half of the digits, where the response is flat */
            const double density = (double)position[1];
            to->bound += one.rounded * (WHOLE + STEEPEST * density * surface_bound(one.alpha2) +
                                        STEEPEST * density * density * 1e-7);
        }
    }
}

/* Looks up a fraction in a remap: returns the slice before, and the weight of the next. */
static size_t lookup_remap(const float *remap, int steps, int count, double position,
                           double *second) {
    const double at = fmin(fmax(position, 0), 1) * steps;
    const size_t i = (size_t)fmin(at, steps - 1);
    const double low = (double)remap[i], high = (double)remap[i + 1];
    const double slice = low + (at - (double)i) * (high - low);
    const size_t first = (size_t)fmin(slice, count - 2);
    *second = slice - (double)first;
    return first;
}

/* Returns the integer part of a coordinate that has a neighbor before and two after. */
static size_t spline_at(double at, uint32_t count, double w[4]) {
    const size_t base = (size_t)fmin(fmax(at, 1), (double)(count - 3));
    spline(fmin(fmax(at - (double)base, 0), 1), w);
    return base;
}

static void add_slice(const shading *s, size_t index, double coordinate, double azimuth,
                      double weight, double rgb[3]) {
    const lmpi_kernel_slice *slice = &s->slices[index];
    double down[4], across[4];
    const size_t row = spline_at(
        coordinate * (double)slice->row_density - (double)slice->row_origin, slice->rows, down);
    const size_t column =
        spline_at(azimuth * (double)slice->column_density + 1, slice->columns, across);
    for (size_t k = 0; k < 4; k++)
        for (size_t j = 0; j < 4; j++)
            for (size_t c = 0; c < 3; c++) {
                const size_t texel = slice->first + (row + k - 1) * slice->columns + column + j - 1;
                rgb[c] +=
                    weight * (double)slice->unit * down[k] * across[j] * s->texels[3 * texel + c];
            }
}

/* Makes the frame of the mirror direction, z along it and x in the plane of incidence; returns
 * theta_o. */
static double mirror_frame(const seen *surface, double frame[3][3]) {
    const double *n = surface->normal, along = dot3(n, surface->view);
    double flat[3], length2 = 0;
    for (int k = 0; k < 3; k++) {
        flat[k] = surface->view[k] - along * n[k];
        length2 += flat[k] * flat[k];
    }
    if (!(length2 > 1e-12)) {
        flat[0] = n[1] * n[1] > 0.5 ? 1 : n[2];
        flat[1] = 0;
        flat[2] = n[1] * n[1] > 0.5 ? 0 : -n[0];
        length2 = dot3(flat, flat);
    }
    for (int k = 0; k < 3; k++)
        flat[k] /= sqrt(length2);
    const double cosine = fmin(fmax(along, 0), 1), sine = sqrt(1 - cosine * cosine);
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        frame[0][k] = cosine * flat[k] + sine * n[k];
        frame[1][k] = n[a] * flat[b] - n[b] * flat[a];
        frame[2][k] = cosine * n[k] - sine * flat[k];
    }
    return acos(cosine);
}

static void read_brdf(const shading *s, const seen_light *one, double frame[3][3], size_t view,
                      double later, double mean[3]) {
    const lmpi_kernel_preintegrated_brdf *m = &s->brdf;
    const double x = dot3(frame[0], one->axis), y = dot3(frame[1], one->axis);
    const double z = dot3(frame[2], one->axis), a = acos(1 - one->t);
    double azimuth = atan2(y, x), larger;
    azimuth = azimuth < 0 ? (m->mirrored ? -azimuth : azimuth + 2 * ORACLE_PI) : azimuth;
    const double rim = a * a / (hypot(a, (double)m->radius) + (double)m->radius);
    const double from_rim = atan2(hypot(x, y), z) - rim;
    const double row =
        from_rim * ((double)m->reach / ((double)m->width * hypot(from_rim, (double)m->reach)) +
                    (double)m->slope);
    const double quarter = ORACLE_PI / 2;
    const size_t cap = lookup_remap(s->cap_remap, CAP_STEPS, CAPS,
                                    a / (a + 0.5) * (quarter + 0.5) / quarter, &larger);
    memset(mean, 0, 3 * sizeof *mean);
    for (size_t k = 0; k < 4; k++)
        add_slice(s, (view + k / 2) * CAPS + cap + k % 2, row, azimuth,
                  (k / 2 ? later : 1 - later) * (k % 2 ? larger : 1 - larger), mean);
    for (int c = 0; c < 3; c++)
        mean[c] /= 2 * ORACLE_PI * one->t + (double)m->lobe_angle;
}

static void expect_preintegrated_brdf(const shading *s, int i, shaded *to) {
    seen surface;
    double frame[3][3], later;
    see(s, i, &surface);
    const double theta = mirror_frame(&surface, frame);
    const size_t view =
        lookup_remap(s->view_remap, VIEW_STEPS, VIEWS, theta / (ORACLE_PI / 2), &later);
    const lmp_rgb *color = &s->colors[view];
    const double all[3] = {
        (1 - later) * (double)color[0].r + later * (double)color[1].r,
        (1 - later) * (double)color[0].g + later * (double)color[1].g,
        (1 - later) * (double)color[0].b + later * (double)color[1].b,
    };
    *to = (shaded) { { 0 }, 1e-6 };
    shaded_add(to, 0, s->ambient, all);
    for (int light = 0; light < SHADE_LIGHTS; light++) {
        seen_light one;
        double mean[3];
        see_light(s, &surface, light, &one);
        if (one.nothing)
            continue;
        read_brdf(s, &one, frame, view, later, mean);
        add_mean(&one, &s->lights[light], 0, mean, all, to);
        to->bound += one.rounded * (WHOLE + STEEPEST * surface_bound(one.alpha2));
    }
}

#endif
