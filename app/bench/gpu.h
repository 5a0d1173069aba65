/* SPDX-License-Identifier: MIT */
/* gpu.h - what the files of `lampion bench gpu` share: what is timed, and its rows. */
#ifndef LAMPION_BENCH_GPU_H
#define LAMPION_BENCH_GPU_H

#include "app/bench/bench.h"
#include "app/override/override.h"
#include "app/render/shade/field.h"

/* What shades. */
typedef struct bench_case {
    method_kind method;
    device_kind device;
} bench_case;

enum { BENCH_CASES_MAX = METHODS_TIMED * DEVICES, BENCH_SETTINGS_MAX = 288 };

/* A row's frame, and what shades it. */
typedef struct bench_row {
    const bench_case *by;
    int bands, lights, width, height;
} bench_row;

typedef struct bench_result {
    double ms;       /* median of the shading of `frames` */
    double frame_ms; /* and of all that they took, from the G-buffer to the tone curve */
    int frames;
    double compile_ms; /* of the shader */
} bench_result;

/* One number of bands and lights, and one size, of the rows of some cases. */
typedef struct bench_setting {
    int bands, lights;
    const int *size;
    double paper_ms, frame_ms[BENCH_CASES_MAX]; /* by case; 0: none */
} bench_setting;

/* The settings in the order of what they tell, and the time for them all. */
typedef struct bench_plan {
    bench_case cases[BENCH_CASES_MAX];
    int case_count;
    unsigned reads; /* what their methods read: METHOD_READS_… */
    bench_setting settings[BENCH_SETTINGS_MAX];
    int setting_count;
    int rows_ahead, rows_left_out;
    char left_out[256]; /* which */
    double end_ms;      /* of now_ms */
} bench_plan;

/* A scene open on the device, with as many lights as any row asks for. */
typedef struct bench_scene {
    const bench_options *options;
    bench_plan *plan;
    const char *name;
    scene world;
    render_device devices[DEVICES]; /* those that cases run on */
    any_renderer *renderers[DEVICES];
    lmp_preintegrated_lobe *lobes[LMP_BANDS_MAX + 1]; /* by bands, made on demand */
    double build_ms[LMP_BANDS_MAX + 1];
    shade_field *field;       /* of the bands asked for last, or NULL */
    device_kind field_device; /* that it was made for */
    override_set materials;   /* of material_bands */
    int material_bands;       /* 0: none yet */
    double bake_ms, integrate_ms;
    bool first;
} bench_scene;

/* gpu_print.c: what stands above the rows, and a row; paper: the milliseconds of the paper's own
 * method at the same setting, or 0. */
void bench_print_header(const bench_scene *scene);
void bench_print_row(bench_scene *scene, const bench_row *row, const bench_result *result,
                     double paper);

/* The method that fields are compared with. */
method_kind bench_compared(void);

/* Whole frames by lights, in a line each, with how many times as fast as by that. */
void bench_print_frames(const bench_scene *scene);

#endif
