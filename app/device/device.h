/* SPDX-License-Identifier: MIT */
/* device.h - where the shading of a frame runs: one table row a device. */
#ifndef LAMPION_DEVICE_H
#define LAMPION_DEVICE_H

#include <stdbool.h>

/* The devices themselves are those from DEVICE_FIRST on. */
typedef enum device_kind {
    DEVICE_AUTO,
    DEVICE_FIRST,
    DEVICE_GPU = DEVICE_FIRST,
    DEVICE_CPU,
    DEVICES
} device_kind;

typedef struct device_row {
    const char *name; /* in options and output */
    const char *help; /* what --device says of it */
    const char *text; /* in sentences */
    bool on_host;     /* the library shades, no shader */
} device_row;

extern const device_row device_table[DEVICES];

/* The names of the rows, NULL-terminated, and the help of the option that chooses among them. */
const char *const *device_names(void);
const char *device_help(void);

#endif
