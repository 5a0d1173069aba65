/* SPDX-License-Identifier: MIT */
/* device.h - where the shading of a frame runs: one table row per device. */
#ifndef LAMPION_RENDER_DEVICE_H
#define LAMPION_RENDER_DEVICE_H

#include <stdbool.h>

/* The choices of a device; from DEVICE_FIRST on they are actual devices. */
typedef enum device_kind {
    DEVICE_AUTO,
    DEVICE_FIRST,
    DEVICE_GPU = DEVICE_FIRST,
    DEVICE_CPU,
    DEVICES
} device_kind;

typedef struct device_row {
    const char *name; /* in options and output */
    const char *help; /* the help of --device */
    const char *text; /* in sentences */
    bool on_cpu;      /* whether the library shades, not shaders */
} device_row;

extern const device_row device_table[DEVICES];

/* Returns the names of the rows, NULL-terminated, for the option that chooses among them;
 * device_help returns its help. */
const char *const *device_names(void);
const char *device_help(void);

#endif
