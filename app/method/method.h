/* SPDX-License-Identifier: MIT */
/* method.h - how a frame is shaded: one table row a method. Options and their help, checks, the
 * viewer's keys, benchmarks and shaders follow from the rows. */
#ifndef LAMPION_METHOD_H
#define LAMPION_METHOD_H

#include "app/device/device.h"

#include <lampion/shade.h>

#include <stdbool.h>

/* The names of the windowing filters (lmp_window), NULL-terminated. */
const char *const *method_window_names(void);

/* --- methods ---------------------------------------------------------------------------------- */

typedef enum method_kind {
    METHOD_ZONAL,
    METHOD_COEFFICIENTS,
    METHOD_PREINTEGRATED,
    METHOD_FIELD,
    METHODS,
    /* for benchmarks alone: the paper's own */
    METHOD_PAPER = METHODS, /* its fragment shader */
    METHOD_TABULATED_Z,     /* its tabulated Z_l (§4.2) in the method of coefficients */
    METHODS_TIMED
} method_kind;

/* What a method reads besides the scene. */
enum {
    METHOD_READS_PREINTEGRATED = 1, /* lobes and BRDFs, so that its cost is that of one band */
    METHOD_READS_TABULATED_Z = 2,
    METHOD_READS_FIELD = 4 /* of all lights, so that its cost is not that of their number */
};

/* What it costs on the CPU, measured on two cores: nanoseconds of a pixel, of it for each of bands²
 * coefficients, for each light, and for each light and band; then milliseconds of a frame, for each
 * coefficient, and for each of them and each light. */
typedef struct method_cost {
    float pixel, pixel_value, light, light_band, frame_value, frame_light;
} method_cost;

typedef struct method_row {
    const char *name, *help;
    lmp_shade_method method; /* the library's */
    int bands_max[DEVICES];  /* 0: it does not run there; automatically: the most of all devices */
    bool batched;            /* the CPU has batch kernels for it */
    bool tabulated;          /* it shades tabulated materials, too */
    bool baseline;           /* benchmarks tell the others' speed against its */
    unsigned reads;          /* METHOD_READS_… */
    const char *shader;      /* its file */
    bool fragment;        /* the shader is a full screen's fragment shader, not a compute shader */
    const char *function; /* that the shader calls for a pixel */
    const char *defines;  /* put before the shader, or NULL */
    const char *speedup;  /* NULL, or the statistic that tells its speed against this method's: */
    method_kind compared;
    method_cost cost; /* all 0: it is not estimated */
} method_row;

extern const method_row method_table[METHODS_TIMED];

#define METHOD_GPU_BANDS_MAX 32 /* LMP_BANDS_GLSL_MAX of lampion.glsl */

/* The names of the rows, NULL-terminated. */
const char *const *method_names(void);

/* What --method takes in every command: auto, then the rows; and its help, which tells the rule of
 * auto and the limits of the devices. */
const char *const *method_choices(void);
const char *method_help(void);

#define METHOD_OPTION_ROW(choice)                                                                  \
    { "method", 0, CLI_CHOICE, &(choice), "METHOD", method_help(), 0, 0, method_choices(), NULL }

/* The row of a choice. auto: zonal, the exact sum, while every device takes the bands; from there
 * on preintegrated, whose cost does not grow with them. */
method_kind method_chosen(int choice, int bands);

/* What is to be shaded. */
typedef struct method_work {
    size_t lights;
    int bands;
    double pixels;
} method_work;

/* Milliseconds that the CPU takes about, more or fewer on other machines; 0 of a method that takes
 * not so many bands there, or is not estimated. */
double method_estimate(method_kind method, const method_work *work);

/* Of auto, on the CPU: a field in place of the row chosen, where it costs at most half. Its images
 * are not quite those of exact sums, so less is no reason. */
method_kind method_for_lights(method_kind chosen, const method_work *work);

/* Where a frame is shaded. DEVICE_AUTO: on the GPU, but where OpenGL is software on the CPU if it
 * has batch kernels, and where the bands are too many for a shader; tables under an environment are
 * summed by bands, whatever the method. */
device_kind method_device(method_kind method, device_kind wanted, bool tables, bool software,
                          int bands);

#endif
