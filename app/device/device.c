/* SPDX-License-Identifier: MIT */
#include "app/device/device.h"
#include "app/cli/cli.h"

#include <stdio.h>
#include <string.h>

const device_row device_table[DEVICES] = {
    [DEVICE_AUTO] = { "auto", "is the CPU where OpenGL is software", "automatic" },
    [DEVICE_GPU] = { "gpu", "a compute pass", "GPU" },
    [DEVICE_CPU] = { "cpu", "the library's kernels on all cores", "CPU" },
};

const char *const *device_names(void) {
    static const char *names[DEVICES + 1];
    cli_row_names(&device_table[0].name, sizeof *device_table, DEVICES, names);
    return names;
}

const char *device_help(void) {
    static char text[256];
    size_t used = (size_t)snprintf(text, sizeof text, "where to shade");
    for (int d = 0; d < DEVICES; d++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s %s", d ? ", " : ": ",
                                 device_table[d].name, device_table[d].help);
    return text;
}
