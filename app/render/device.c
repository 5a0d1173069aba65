/* SPDX-License-Identifier: MIT */
#include "app/render/device.h"
#include "app/base/choice.h"

const device_row device_table[DEVICES] = {
    [DEVICE_AUTO] = { .name = "auto",
                      .help = "is the CPU where OpenGL is software",
                      .text = "automatic" },
    [DEVICE_GPU] = { .name = "gpu", .help = "a compute pass", .text = "GPU" },
    [DEVICE_CPU] = { .name = "cpu",
                     .help = "the library's kernels on all cores",
                     .text = "CPU",
                     .on_cpu = true },
};

const char *const *device_names(void) {
    static const char *names[DEVICES + 1];
    choice_names(&device_table[0].name, sizeof *device_table, DEVICES, names);
    return names;
}

const char *device_help(void) {
    static char text[256];
    return choice_help("where to shade", &device_table[0].name, &device_table[0].help,
                       sizeof *device_table, DEVICES, text, sizeof text);
}
