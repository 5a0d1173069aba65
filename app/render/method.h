/* SPDX-License-Identifier: MIT */
/* method.h - how a frame is shaded: one table row per method. Options and their help, checks, the
 * viewer's keys, benchmarks and shaders follow from the rows. */
#ifndef LAMPION_RENDER_METHOD_H
#define LAMPION_RENDER_METHOD_H

#include "app/base/cli.h"
#include "app/render/device.h"

#include <lampion/shade.h>

#include <stdbool.h>

/* Returns the names of the windowing filters (lmp_window), NULL-terminated. */
const char *const *method_window_names(void);

/* --- methods ---------------------------------------------------------------------------------- */

typedef enum method_kind {
    METHOD_ZONAL,
    METHOD_COEFFICIENTS,
    METHOD_PREINTEGRATED,
    METHOD_FIELD,
    METHODS,
    /* for benchmarks alone, the paper's own methods */
    METHOD_PAPER = METHODS, /* its fragment shader */
    METHOD_TABULATED_Z,     /* its tabulated Z_l (§4.2) in the method of coefficients */
    METHODS_TIMED
} method_kind;

/* What a method reads besides the scene, as bits. */
enum {
    METHOD_READS_PREINTEGRATED = 1, /* lobes and BRDFs; its cost is that of one band */
    METHOD_READS_TABULATED_Z = 2,
    METHOD_READS_FIELD = 4 /* of all lights; its cost does not depend on their number */
};

/* The cost of a method on the CPU, measured on two cores: nanoseconds per pixel, then per pixel and
 * coefficient, light, or light and band; then milliseconds per frame and coefficient, and per
 * frame, coefficient and light. */
typedef struct method_cost {
    float pixel, pixel_value, light, light_band, frame_value, frame_light;
} method_cost;

typedef struct method_row {
    const char *name, *help;
    lmp_shade_method method; /* the library's */
    int bands_max[DEVICES];  /* 0: does not run there; DEVICE_AUTO: the most of all devices */
    bool batched;            /* whether the CPU has batch kernels for it */
    bool sums_areas;    /* whether it sums areas itself; on the CPU, zonal does so beside others */
    bool tabulated;     /* whether it also shades tabulated materials */
    bool baseline;      /* whether benchmarks give the others' speed relative to it */
    unsigned reads;     /* METHOD_READS_… */
    const char *shader; /* file name */
    bool fragment;      /* a full-screen fragment shader rather than a compute shader */
    const char *function; /* that the shader calls per pixel */
    const char *defines;  /* put before the shader, or NULL */
    const char *speedup;  /* NULL, or the statistic of its speed relative to this method's */
    method_kind compared;
    method_cost cost; /* all 0: unknown */
} method_row;

extern const method_row method_table[METHODS_TIMED];

#define METHOD_GPU_BANDS_MAX 32 /* LMP_BANDS_GLSL_MAX of lampion.glsl */

/* Returns the names of the rows, NULL-terminated. */
const char *const *method_names(void);

/* Return the choices of --method in every command, auto followed by the rows, and its help, which
 * explains auto and the limits of the devices. */
const char *const *method_choices(void);
const char *method_help(void);

#define METHOD_OPTION_ROW(choice)                                                                  \
    { "method", 0, CLI_CHOICE, &(choice), "METHOD", method_help(), 0, 0, method_choices(), NULL }

/* Returns the row of a choice. auto means zonal, the exact sum, while every device supports that
 * many bands, and preintegrated, whose cost does not grow with them, beyond. */
method_kind method_chosen(int choice, int bands);

/* The size of a shading job. */
typedef struct method_work {
    size_t lights;
    int bands;
    double pixels;
} method_work;

/* Estimates the milliseconds on the CPU, which differ between machines; returns 0 for a method that
 * does not support that many bands there or has no known cost. */
double method_estimate(method_kind method, const method_work *work);

/* For auto on the CPU: returns METHOD_FIELD instead of the chosen row if it costs at most half. Its
 * images are not quite those of exact sums, so a smaller gain is not worth it. */
method_kind method_for_lights(method_kind chosen, const method_work *work);

/* What decides, besides the method, where a frame is shaded. */
typedef struct method_needs {
    int bands;
    bool tables;   /* under an environment, which are summed by bands, whatever the method */
    bool areas;    /* whether a light is an area */
    bool software; /* whether OpenGL is software */
} method_needs;

/* Chooses where a frame is shaded. DEVICE_AUTO means the GPU, except where OpenGL is software and
 * the CPU has batch kernels, and for areas and more bands than a shader sums. */
device_kind method_device(method_kind method, device_kind wanted, const method_needs *needs);

#endif
