/* SPDX-License-Identifier: MIT */
#include "app/base/timing.h"

#include <stdio.h>
#include <string.h>

void timing_cpu_name(char *name, size_t size) {
    char line[256];
    FILE *file = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown CPU");
    while (file && fgets(line, sizeof line, file))
        if (strncmp(line, "model name", 10) == 0 && strchr(line, ':')) {
            snprintf(name, size, "%.*s", (int)strcspn(strchr(line, ':') + 2, "\n\""),
                     strchr(line, ':') + 2);
            break;
        }
    if (file)
        fclose(file);
}
