/* SPDX-License-Identifier: MIT */
/* run.h - runs any kernel on the same inputs, into guarded memory, in either layout. */
#ifndef LAMPION_RUN_H
#define LAMPION_RUN_H

#include "tests/kernels/nodes.h"
#include "tests/kernels/shading.h"
#include "tests/kernels/sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD = 64 };

typedef enum kind {
    EVAL,
    DOT,
    ROTATE,
    ZONAL,
    PROJECT,
    ACCUMULATE,
    GRADIENT,
    LOBE,
    EVAL_GRADIENT,
    RECONSTRUCT,
    RECONSTRUCT_PHONG,
    IMAGE,
    SHADE_ZONAL,
    SHADE_PREINTEGRATED_LOBE,
    SHADE_PREINTEGRATED_BRDF,
    SHADE_ZONAL_FEW,
    SHADE_PREINTEGRATED_LOBE_FEW,
    SHADE_ZONAL_ALL,
    SHADE_PREINTEGRATED_LOBE_ALL,
    FADING_GRADIENT,
    INTERPOLATE,
    REFINE,
    SHADE_FIELD,
    ACCUMULATE_MORE,
    ACCUMULATE_DIRACS,
    ADD,
    CONE,
    SHADE_POLYGONS,
    SHADE_POLYGONS_ALL,
    SHADE_DISK,
    SHADE_DISK_ALL,
    SHADE_TUBE,
    SHADE_TUBE_ALL,
    KINDS
} kind;
static const char *const kind_names[] = { "eval",
                                          "dot",
                                          "rotate",
                                          "zonal",
                                          "project",
                                          "accumulate",
                                          "gradient",
                                          "lobe",
                                          "eval_gradient",
                                          "reconstruct",
                                          "reconstruct of Phong lobes",
                                          "image",
                                          "shade_zonal",
                                          "shade_preintegrated_lobe",
                                          "shade_preintegrated_brdf",
                                          "shade_zonal of few lobes",
                                          "shade_preintegrated_lobe of few lobes",
                                          "shade_zonal of all lobes",
                                          "shade_preintegrated_lobe of all lobes",
                                          "fading_gradient",
                                          "interpolate",
                                          "refine",
                                          "shade_field",
                                          "accumulate_more",
                                          "accumulate of Diracs",
                                          "add",
                                          "cone",
                                          "shade_polygons",
                                          "shade_polygons of all lobes",
                                          "shade_disk",
                                          "shade_disk of all lobes",
                                          "shade_tube",
                                          "shade_tube of all lobes" };

/* Returns how many Phong lobes a kernel of shading takes. */
static int lobes_of(kind which) {
    switch (which) {
    case SHADE_ZONAL_FEW:
    case SHADE_PREINTEGRATED_LOBE_FEW:
        return 3;
    case SHADE_ZONAL_ALL:
    case SHADE_PREINTEGRATED_LOBE_ALL:
    case SHADE_FIELD:
    case SHADE_POLYGONS_ALL:
    case SHADE_DISK_ALL:
    case SHADE_TUBE_ALL:
        return LMPI_KERNEL_LOBES_MAX;
    default:
        return 1;
    }
}

static bool is_zonal(kind which) {
    return which == SHADE_ZONAL || which == SHADE_ZONAL_FEW || which == SHADE_ZONAL_ALL;
}
enum { PLANES = 3 + 3 * LMPI_KERNEL_LOBES_MAX };

static size_t values_of(kind which, int bands) {
    const size_t n = LMP_SH_COUNT(bands);
    switch (which) {
    case DOT:
    case CONE:
        return 1;
    case ZONAL:
        return (size_t)bands;
    case ACCUMULATE:
    case ACCUMULATE_MORE:
    case ACCUMULATE_DIRACS:
    case ADD:
    case IMAGE:
    case INTERPOLATE:
        return 3 * n;
    case GRADIENT:
    case FADING_GRADIENT:
    case REFINE:
        return 12 * n;
    case EVAL_GRADIENT:
        return 4 * n;
    case LOBE:
    case RECONSTRUCT:
    case RECONSTRUCT_PHONG:
    case SHADE_PREINTEGRATED_BRDF:
        return 3;
    case SHADE_ZONAL:
    case SHADE_PREINTEGRATED_LOBE:
    case SHADE_ZONAL_FEW:
    case SHADE_PREINTEGRATED_LOBE_FEW:
    case SHADE_ZONAL_ALL:
    case SHADE_PREINTEGRATED_LOBE_ALL:
    case SHADE_FIELD:
    case SHADE_POLYGONS:
    case SHADE_POLYGONS_ALL:
    case SHADE_DISK:
    case SHADE_DISK_ALL:
    case SHADE_TUBE:
    case SHADE_TUBE_ALL:
        return 3 + 3 * (size_t)lobes_of(which);
    default:
        return n;
    }
}

/* Makes the lobes and coefficients that kernels take. */
static void make_lambda(int bands, float *lambda) {
    for (int l = 0; l < bands; l++)
        lambda[l] = 1 / (1 + 0.25f * (float)l);
}

static float *make_matrices(int bands) {
    float *matrices = malloc(LMP_SH_ROTATION_COUNT(bands) * sizeof *matrices);
    assert_non_null(matrices);
    set_seed(bands > 0 ? (uint64_t)bands : 1);
    for (size_t i = 0; i < LMP_SH_ROTATION_COUNT(bands); i++)
        matrices[i] = grid(1.0f / 1024);
    return matrices;
}

static void run_vectors(const lmpi_kernels *k, kind which, int bands, size_t count, int planar,
                        const lmpi_kernel_out *out) {
    const size_t values = LMP_SH_COUNT(bands), stride = (planar ? count : values) + 3;
    float *a = make_vectors(values, count, planar, stride, 0);
    const lmpi_kernel_in from_a = { a, stride, planar };
    if (which == DOT) {
        float *b = make_vectors(values, count, planar, stride, 1000);
        const lmpi_kernel_in from_b = { b, stride, planar };
        k->sh.dot(values, &from_a, &from_b, count, out->at);
        free(b);
    } else {
        float *matrices = make_matrices(bands);
        k->sh.rotate(bands, matrices, &from_a, count, out);
        free(matrices);
    }
    free(a);
}

/* Runs with every other factor 0, as for a diffuse lobe, unless the lobes are Phong lobes. */
static void run_reconstruct(const lmpi_kernels *k, kind which, int bands, const inputs *in,
                            size_t count, const lmpi_kernel_out *out) {
    const size_t values = LMP_SH_COUNT(bands);
    const lmpi_kernel_vec3 axis = { in->axis[0], in->axis[1], in->axis[2] };
    float *sh = make_vectors(values, 3, 0, values, 0), lambda[LMP_BANDS_MAX];
    const float *const planes[3] = { sh, sh + values, sh + 2 * values };
    make_lambda(bands, lambda);
    for (int l = 3; which == RECONSTRUCT && l < bands; l += 2)
        lambda[l] = 0;
    k->sh.reconstruct(bands, lambda, which == RECONSTRUCT ? NULL : in->exponent, planes, &axis,
                      count, out);
    free(sh);
}

/* Runs so that element e is an image of e + 1 texels, of three channels. */
static void run_image(const lmpi_kernels *k, int bands, const inputs *in, size_t count,
                      const lmpi_kernel_out *out) {
    const size_t n = LMP_SH_COUNT(bands);
    lmpi_kernel_texels texels = { .direction = { in->axis[0], in->axis[1], in->axis[2] },
                                  .channels = 3 };
    for (size_t e = 0; e < count; e++) {
        _Alignas(64) float value[3][COUNT + 16] = { { 0 } };
        lmpi_kernel_texel_sums sums;
        for (size_t c = 0; c < 3; c++) {
            memcpy(value[c], in->rgb[c], (e + 1) * sizeof(float));
            texels.value[c] = value[c];
        }
        for (int m = 0; m < bands; m++) {
            const int i = m % LMPI_KERNEL_ORDERS, left = bands - m;
            if (i == 0) {
                memset(&sums, 0, sizeof sums);
                k->sh.image(bands, m, left < LMPI_KERNEL_ORDERS ? left : LMPI_KERNEL_ORDERS,
                            &texels, e + 1, &sums);
            }
            for (size_t c = 0; c < 3; c++)
                for (int l = m; l < bands; l++) {
                    const size_t minus = c * n + LMP_SH_INDEX(l, -m),
                                 plus = c * n + LMP_SH_INDEX(l, m);
                    out->at[out->planar ? minus * out->stride + e : e * out->stride + minus] =
                        (float)sums.sine[i][c][l];
                    out->at[out->planar ? plus * out->stride + e : e * out->stride + plus] =
                        (float)sums.cosine[i][c][l];
                }
        }
    }
}

/* The kernels of shading add to planes, up to a whole number of lanes, so this guards what is
 * beside the planes. */
enum { PLANE = (COUNT / LMPI_KERNEL_LANES_MAX + 1) * LMPI_KERNEL_LANES_MAX + 2 * GUARD };

/* Shades under disks or tubes, and adds to red what each leaves. */
static void call_round(const lmpi_kernels *k, bool tubes, const shading *s,
                       const lmpi_kernel_surfaces *surfaces, size_t count,
                       const lmpi_kernel_accumulated *sums) {
    _Alignas(64) float left[COUNT + 16];
    for (int i = 0; i < SHADE_ROUND_COUNT; i++) {
        if (tubes)
            k->shade.tube(s->bands, s->window, surfaces, &s->tubes[i], count, sums, left);
        else
            k->shade.disk(s->bands, s->window, surfaces, &s->disks[i], count, sums, left);
        for (size_t e = 0; e < count; e++)
            sums->diffuse[0][e] += left[e];
    }
}

static void call_shading(const lmpi_kernels *k, kind which, const shading *s, size_t count,
                         float *const planes[PLANES]) {
    const inputs *in = s->in;
    lmpi_kernel_accumulated sums = { .diffuse = { planes[0], planes[1], planes[2] } };
    lmpi_kernel_surfaces surfaces = { { in->point[0], in->point[1], in->point[2] },
                                      { in->normal[0], in->normal[1], in->normal[2] },
                                      { in->view[0], in->view[1], in->view[2] },
                                      .lobe_count = s->lobes };
    lmpi_kernel_lobe_positions positions[LMPI_KERNEL_LOBES_MAX];
    for (int lobe = 0; lobe < s->lobes; lobe++) {
        for (int c = 0; c < 3; c++)
            sums.specular[lobe][c] = planes[3 + 3 * lobe + c];
        surfaces.lobe[lobe] =
            (lmpi_kernel_lobe) { { s->axis[lobe][0], s->axis[lobe][1], s->axis[lobe][2] },
                                 s->exponent[lobe] };
        positions[lobe] =
            (lmpi_kernel_lobe_positions) { s->first[lobe], s->columns[lobe], s->weight[lobe],
                                           s->density[lobe], s->angle[lobe] };
    }
    const lmpi_kernel_preintegrated_lobe table = { s->pairs };
    if (which == SHADE_FIELD)
        k->shade.field(s->bands, s->window, s->diffuse, &surfaces, &s->sh, count, &sums);
    else if (which == SHADE_POLYGONS || which == SHADE_POLYGONS_ALL)
        k->shade.polygons(s->bands, s->window, &surfaces, s->polygons, SHADE_POLYGON_COUNT, count,
                          &sums);
    else if (which == SHADE_DISK || which == SHADE_DISK_ALL)
        call_round(k, false, s, &surfaces, count, &sums);
    else if (which == SHADE_TUBE || which == SHADE_TUBE_ALL)
        call_round(k, true, s, &surfaces, count, &sums);
    else if (is_zonal(which))
        k->shade.zonal(s->bands, s->window, &surfaces, s->lights, SHADE_LIGHTS, count, &sums);
    else if (which != SHADE_PREINTEGRATED_BRDF)
        k->shade.preintegrated_lobe(&table, positions, &surfaces, s->lights, SHADE_LIGHTS, count,
                                    &sums);
    else
        k->shade.preintegrated_brdf(&s->brdf, &surfaces, s->lights, SHADE_LIGHTS, s->ambient, count,
                                    sums.diffuse);
}

static void run_shading(const lmpi_kernels *k, kind which, int bands, const inputs *in,
                        size_t count, const lmpi_kernel_out *out) {
    _Alignas(64) float memory[PLANES][PLANE];
    float *planes[PLANES];
    const size_t whole =
        (count + LMPI_KERNEL_LANES_MAX - 1) / LMPI_KERNEL_LANES_MAX * LMPI_KERNEL_LANES_MAX;
    const size_t values = values_of(which, bands);
    const bool field = which == SHADE_FIELD;
    const int most = field ? LMPI_KERNEL_FIELD_BANDS_MAX : LMP_BANDS_MAX;
    shading *s = shading_create(in, bands < most ? bands : most, lobes_of(which));
    float *sh = make_vectors(field ? 3 * LMP_SH_COUNT(s->bands) : 0, COUNT + 16, 1, COUNT + 16, 0);
    s->sh = (lmpi_kernel_in) { sh, COUNT + 16, 1 };
    for (size_t v = 0; v < PLANES; v++) {
        planes[v] = memory[v] + GUARD;
        for (size_t i = 0; i < PLANE; i++)
            memory[v][i] = (float)v; /* the value that the kernel adds to */
    }
    call_shading(k, which, s, count, planes);
    shading_free(s);
    free(sh);
    for (size_t v = 0; v < PLANES; v++) {
        for (size_t e = 0; v < values && e < count; e++)
            out->at[out->planar ? v * out->stride + e : e * out->stride + v] = planes[v][e];
        for (size_t i = 0; i < PLANE; i++)
            if ((v >= values || i < GUARD || i >= GUARD + whole) &&
                (memory[v][i] < (float)v || memory[v][i] > (float)v))
                out->at[-1] = 0; /* memory that the kernel must not write */
    }
}

/* Runs sums of lights; gradients follow them, further on in a row or in the planes after. */
static void run_sums(const lmpi_kernels *k, kind which, int bands, const inputs *in, size_t count,
                     const lmpi_kernel_out *out) {
    const lmpi_kernel_vec3 point = { in->point[0], in->point[1], in->point[2] };
    const lmpi_kernel_lights lights = lights_of(in);
    lmpi_kernel_out gradient = *out;
    gradient.at += 3 * LMP_SH_COUNT(bands) * (out->planar ? out->stride : 1);
    if (which == ACCUMULATE_MORE)
        run_more(k, bands, in, count, out);
    else if (which == ACCUMULATE_DIRACS)
        run_diracs(k, bands, in, count, out);
    else if (which == ACCUMULATE)
        k->light.accumulate(NULL, bands, &lights, &point, count, out);
    else if (which == GRADIENT)
        k->light.gradient(NULL, bands, &lights, &point, LMP_COS_MIN, count, out, &gradient);
    else
        k->light.fading_gradient(NULL, bands, &lights, &point, LMP_COS_MIN,
                                 (lmpi_kernel_fade) { 0.5f, 0.2f }, count, out, &gradient);
}

static void run(const lmpi_kernels *k, kind which, int bands, const inputs *in, size_t count,
                int planar, const lmpi_kernel_out *out) {
    const lmpi_kernel_vec3 point = { in->point[0], in->point[1], in->point[2] };
    const lmpi_kernel_vec3 center = { in->center[0], in->center[1], in->center[2] };
    const lmpi_kernel_vec3 axis = { in->axis[0], in->axis[1], in->axis[2] };
    const lmpi_kernel_pairs pairs = { center, point, in->radius };
    const lmpi_kernel_lights lights = lights_of(in);
    lmpi_kernel_out gradient = *out;
    gradient.at += LMP_SH_COUNT(bands) * (planar ? out->stride : 1);
    float lambda[LMP_BANDS_MAX];
    make_lambda(bands, lambda);
    switch (which) {
    case EVAL:
        k->sh.eval(bands, &axis, count, out);
        break;
    case DOT:
    case ROTATE:
        run_vectors(k, which, bands, count, planar, out);
        break;
    case ZONAL:
        k->light.zonal(bands, in->radius, in->distance, count, out);
        break;
    case PROJECT:
        k->light.project(bands, &pairs, count, out);
        break;
    case ACCUMULATE:
    case ACCUMULATE_MORE:
    case ACCUMULATE_DIRACS:
    case GRADIENT:
    case FADING_GRADIENT:
        run_sums(k, which, bands, in, count, out);
        break;
    case ADD:
        run_add(k, bands, in, count, out);
        break;
    case CONE:
        run_cone(k, in, count, out);
        break;
    case LOBE:
        k->lobe.response(bands, lambda, &axis, &lights, &point, count, out);
        break;
    case EVAL_GRADIENT:
        k->sh.eval_gradient(bands, &axis, count, out, &gradient);
        break;
    case RECONSTRUCT:
    case RECONSTRUCT_PHONG:
        run_reconstruct(k, which, bands, in, count, out);
        break;
    case IMAGE:
        run_image(k, bands, in, count, out);
        break;
    case INTERPOLATE:
    case REFINE:
        run_nodes(k, which == REFINE, bands, in, count, out);
        break;
    default:
        run_shading(k, which, bands, in, count, out);
        break;
    }
}

/* A NaN that no kernel produces. */
static const uint32_t mark = 0x7fc0beef;

static int is_mark(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits == mark;
}

/* Runs a kernel into guarded memory and returns its values as tight rows, or NULL if it wrote
 * outside the output or left a value unwritten. */
static float *results(const lmpi_kernels *k, kind which, int bands, const inputs *in, size_t count,
                      int planar) {
    const size_t values = values_of(which, bands);
    const size_t pad = which == DOT ? 0 : 5;
    const size_t stride = (planar ? count : values) + pad, rows = planar ? values : count;
    const size_t size = rows * stride + 2 * GUARD;
    float *memory = aligned_alloc(64, (size * sizeof(float) + 63) / 64 * 64);
    float *tight = malloc((count * values + 1) * sizeof(float));
    assert_non_null(memory);
    assert_non_null(tight);
    for (size_t i = 0; i < size; i++)
        memcpy(memory + i, &mark, sizeof mark);
    const lmpi_kernel_out out = { memory + GUARD, stride, planar };
    run(k, which, bands, in, count, planar, &out);
    int clean = 1;
    for (size_t i = 0; i < GUARD; i++)
        clean = clean && is_mark(memory[i]) && is_mark(memory[size - 1 - i]);
    for (size_t row = 0; row < rows; row++)
        for (size_t column = 0; column < stride; column++) {
            const float value = out.at[row * stride + column];
            const int inside = column < stride - pad;
            clean = clean && inside != is_mark(value);
            if (inside)
                tight[planar ? column * values + row : row * values + column] = value;
        }
    free(memory);
    if (!clean) {
        free(tight);
        return NULL;
    }
    return tight;
}

/* Returns the seed, which LAMPION_SEED changes. */
static uint64_t drawn_seed(void) {
    const uint64_t seed = (uint64_t)(check_random() * 1e9);
    printf("inputs of seed %llu\n", (unsigned long long)seed);
    return seed;
}

#endif
