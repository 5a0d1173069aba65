/* SPDX-License-Identifier: MIT */
/* doctor.c - lampion doctor: what this machine offers, and where the program keeps things. */
#include "app/command/command.h"
#include "app/file/file.h"
#include "app/render/gl/gpu.h"
#include "app/timing/timing.h"
#include "app/trace/trace.h"

#include <lampion/base.h>
#include <lampion/cpu.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <assimp/version.h>
#include <cjson/cJSON.h>
#include <omp.h>
#include <openexr.h>
#include <pango/pango.h>
#include <png.h>
#include <stdio.h>
#include <string.h>

#define LABEL "%-14s"

/* The instruction set in use, and those there are. */
static void print_kernels(int mask) {
    char names[64] = "";
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag <<= 1) {
        if (!(lmp_cpu_flags() & flag))
            continue;
        lmp_cpu_mask(flag);
        const size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, " %s", lmp_cpu_name());
    }
    lmp_cpu_mask((unsigned)mask);
    printf(LABEL "%s (of%s)\n", "kernels", lmp_cpu_name(), names);
}

/* Whether there is OpenGL: without it the CPU draws images, and there is no viewer. */
static bool print_opengl(const char *device) {
    gpu_context context;
    cli_error error;
    const bool ok = gpu_context_create(device, &context, &error);
    if (ok)
        printf(LABEL "%s, %s%s\n", "OpenGL", context.device, context.driver,
               context.software ? "; software: the CPU draws" : "");
    else
        printf(LABEL "none: %s; the CPU draws\n", "OpenGL", error.text);
    gpu_context_destroy(&context);
    return ok;
}

/* As they are loaded, which need not be as they were compiled against. */
static void print_libraries(void) {
    int major, minor, patch;
    const char *extra;
    char embree[32];
    exr_get_library_version(&major, &minor, &patch, &extra);
    printf(LABEL "Assimp %u.%u.%u", "libraries", aiGetVersionMajor(), aiGetVersionMinor(),
           aiGetVersionPatch());
    trace_version(NULL, embree, sizeof embree);
    printf(", %s, OpenEXR %d.%d.%d, libpng %s, cJSON %s", embree, major, minor, patch,
           png_get_libpng_ver(NULL), cJSON_Version());
    glfwGetVersion(&major, &minor, &patch);
    printf(", GLFW %d.%d.%d, Pango %s\n", major, minor, patch, pango_version_string());
}

static void print_cache(void) {
    char path[4096];
    const file_cache_usage usage = file_cache_measure();
    const double mib = 1 << 20;
    if (file_cache_directory(path, sizeof path))
        printf(LABEL "%s: %zu files, %.1f of at most %.0f MiB\n", "cache", path, usage.files,
               (double)usage.bytes / mib, (double)usage.limit / mib);
    else
        printf(LABEL "none: neither XDG_CACHE_HOME nor HOME is a folder to write to\n", "cache");
}

static int run(const cli_command *command, int argc, char **argv) {
    bool clear = false;
    int mask = LMP_CPU_ALL;
    const char *device = NULL;
    const cli_option options[] = {
        { .name = "clear-cache",
          .kind = CLI_FLAG,
          .target = &clear,
          .help = "remove the files of the cache first" },
        { .name = "gl-device",
          .kind = CLI_TEXT,
          .target = &device,
          .argument = "DEVICE",
          .help = "a number, part of a name, or software" },
        cli_cpu_mask(&mask),
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (clear)
        file_cache_clear();
    const uint32_t version = lmp_version();
    char cpu[160];
    timing_cpu_name(cpu, sizeof cpu);
    printf(LABEL "%u.%u.%u\n", "lampion", version >> 16, version >> 8 & 0xFF, version & 0xFF);
    printf(LABEL "%s, %d threads\n", "CPU", cpu, omp_get_max_threads());
    print_kernels(mask);
    const bool ok = print_opengl(device);
    print_libraries();
    print_cache();
    printf(LABEL "none is read\n", "configuration");
    return ok || !device ? CLI_OK : CLI_FAILURE; /* one that was asked for is missed */
}

const cli_command command_doctor = {
    .name = "doctor",
    .operands = "",
    .summary = "tell what this machine offers, and where the cache is",
    .examples = "lampion doctor\n"
                "lampion doctor --clear-cache\n",
    .run = run,
};
