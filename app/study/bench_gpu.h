/* SPDX-License-Identifier: MIT */
/* bench_gpu.h - what the files of `lampion bench gpu` share: the plan and its rows. */
#ifndef LAMPION_STUDY_BENCH_GPU_H
#define LAMPION_STUDY_BENCH_GPU_H

#include "app/render/renderer/override.h"
#include "app/render/shade_field.h"
#include "app/study/bench.h"

/* A benchmark case: the method and the device that shade. */
typedef struct bench_case {
    method_kind method;
    device_kind device;
} bench_case;

enum { BENCH_CASES_MAX = METHODS_TIMED * DEVICES, BENCH_SETTINGS_MAX = 288 };

/* A row: a frame, and the case that shades it. */
typedef struct bench_row {
    const bench_case *by;
    int bands, lights, width, height;
} bench_row;

typedef struct bench_result {
    double ms;       /* median over `frames` of the shading */
    double frame_ms; /* median of whole frames, from the G-buffer to the tone curve */
    int frames;
    double compile_ms; /* of the shader */
} bench_result;

/* Rows that share a number of bands and of lights and a size. */
typedef struct bench_setting {
    int bands, lights;
    const int *size;
    double paper_ms, frame_ms[BENCH_CASES_MAX]; /* by case; 0: not timed */
} bench_setting;

/* The settings in the order of their interest, and the time for all of them. */
typedef struct bench_plan {
    bench_case cases[BENCH_CASES_MAX];
    int case_count;
    unsigned reads; /* by the methods, as METHOD_READS_… bits */
    bench_setting settings[BENCH_SETTINGS_MAX];
    int setting_count;
    int rows_ahead, rows_skipped;
    char skipped[256]; /* names of the skipped rows */
    double end_ms;     /* as in now_ms */
} bench_plan;

/* A scene opened on the devices, with as many lights as any row asks for. */
typedef struct bench_scene {
    const bench_options *options;
    bench_plan *plan;
    const char *name;
    scene world;
    render_device devices[DEVICES]; /* those of the cases */
    any_renderer *renderers[DEVICES];
    lmp_preintegrated_lobe *lobes[LMP_BANDS_MAX + 1]; /* by bands, made on demand */
    double build_ms[LMP_BANDS_MAX + 1];
    shade_field *field;       /* for the bands requested last, or NULL */
    device_kind field_device; /* for which the field was made */
    override_set materials;   /* for material_bands */
    int material_bands;       /* 0: not made yet */
    double bake_ms, integrate_ms;
    bool first;
} bench_scene;

/* bench_gpu_print.c: the lines above the rows, and a row; paper: the milliseconds of the paper's
 * own method at the same setting, or 0. */
void bench_print_header(const bench_scene *scene);
void bench_print_row(bench_scene *scene, const bench_row *row, const bench_result *result,
                     double paper);

/* Returns the method that fields are compared with. */
method_kind bench_compared(void);

/* Prints whole frames, a line per number of lights, with the speed relative to bench_compared. */
void bench_print_frames(const bench_scene *scene);

#endif
