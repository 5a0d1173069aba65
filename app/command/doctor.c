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
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define LABEL "%-14s"

enum { LIBRARIES = 7 };

/* What there is, found once and then printed as text or as JSON. */
typedef struct findings {
    char version[32], cpu[160], kernel[32];
    char kernels[5][32]; /* the instruction sets there are */
    int kernel_count, threads;
    bool opengl, software;
    char device[1024], driver[256]; /* without OpenGL device says why */
    struct {
        const char *name;
        char version[48];
    } libraries[LIBRARIES];
    bool cached;
    char cache[4096];
    file_cache_usage usage;
} findings;

/* The instruction set in use, and those there are. */
static void find_kernels(int mask, findings *f) {
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag <<= 1) {
        if (!(lmp_cpu_flags() & flag))
            continue;
        lmp_cpu_mask(flag);
        snprintf(f->kernels[f->kernel_count++], sizeof *f->kernels, "%s", lmp_cpu_name());
    }
    lmp_cpu_mask((unsigned)mask);
    snprintf(f->kernel, sizeof f->kernel, "%s", lmp_cpu_name());
}

/* Without OpenGL the CPU draws images, and there is no viewer. */
static void find_opengl(const char *device, findings *f) {
    gpu_context context;
    cli_error error;
    f->opengl = gpu_context_create(device, &context, &error);
    f->software = f->opengl && context.software;
    snprintf(f->device, sizeof f->device, "%s", f->opengl ? context.device : error.text);
    snprintf(f->driver, sizeof f->driver, "%s", f->opengl ? context.driver : "");
    gpu_context_destroy(&context);
}

static void add_library(findings *f, int index, const char *name, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void add_library(findings *f, int index, const char *name, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    f->libraries[index].name = name;
    vsnprintf(f->libraries[index].version, sizeof f->libraries->version, format, arguments);
    va_end(arguments);
}

/* As they are loaded, which need not be as they were compiled against. */
static void find_libraries(findings *f) {
    int major, minor, patch;
    const char *extra;
    char embree[32];
    add_library(f, 0, "Assimp", "%u.%u.%u", aiGetVersionMajor(), aiGetVersionMinor(),
                aiGetVersionPatch());
    trace_version(NULL, embree, sizeof embree);
    add_library(f, 1, "Embree", "%s", embree + strcspn(embree, "0123456789"));
    exr_get_library_version(&major, &minor, &patch, &extra);
    add_library(f, 2, "OpenEXR", "%d.%d.%d", major, minor, patch);
    add_library(f, 3, "libpng", "%s", png_get_libpng_ver(NULL));
    add_library(f, 4, "cJSON", "%s", cJSON_Version());
    glfwGetVersion(&major, &minor, &patch);
    add_library(f, 5, "GLFW", "%d.%d.%d", major, minor, patch);
    add_library(f, 6, "Pango", "%s", pango_version_string());
}

static void find_all(int mask, const char *device, findings *f) {
    const uint32_t version = lmp_version();
    snprintf(f->version, sizeof f->version, "%u.%u.%u", version >> 16, version >> 8 & 0xFF,
             version & 0xFF);
    timing_cpu_name(f->cpu, sizeof f->cpu);
    f->threads = omp_get_max_threads();
    find_kernels(mask, f);
    find_opengl(device, f);
    find_libraries(f);
    f->usage = file_cache_measure();
    f->cached = file_cache_directory(f->cache, sizeof f->cache);
}

static void print_text(const findings *f) {
    const double mib = 1 << 20;
    printf(LABEL "%s\n", "lampion", f->version);
    printf(LABEL "%s, %d threads\n", "CPU", f->cpu, f->threads);
    printf(LABEL "%s (of", "kernels", f->kernel);
    for (int i = 0; i < f->kernel_count; i++)
        printf(" %s", f->kernels[i]);
    puts(")");
    if (f->opengl)
        printf(LABEL "%s, %s%s\n", "OpenGL", f->device, f->driver,
               f->software ? "; software: the CPU draws" : "");
    else
        printf(LABEL "none: %s; the CPU draws\n", "OpenGL", f->device);
    printf(LABEL, "libraries");
    for (int i = 0; i < LIBRARIES; i++)
        printf("%s%s %s", i ? ", " : "", f->libraries[i].name, f->libraries[i].version);
    putchar('\n');
    if (f->cached)
        printf(LABEL "%s: %zu files, %.1f of at most %.0f MiB\n", "cache", f->cache, f->usage.files,
               (double)f->usage.bytes / mib, (double)f->usage.limit / mib);
    else
        printf(LABEL "none: neither XDG_CACHE_HOME nor HOME is a folder to write to\n", "cache");
    printf(LABEL "none is read\n", "configuration");
}

static bool print_json(const findings *f, cli_error *error) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "lampion", f->version);
    cJSON_AddStringToObject(root, "cpu", f->cpu);
    cJSON_AddNumberToObject(root, "threads", f->threads);
    cJSON_AddStringToObject(root, "kernels", f->kernel);
    cJSON *sets = cJSON_AddArrayToObject(root, "kernels_available");
    for (int i = 0; i < f->kernel_count; i++)
        cJSON_AddItemToArray(sets, cJSON_CreateString(f->kernels[i]));
    cJSON *opengl = cJSON_AddObjectToObject(root, "opengl");
    cJSON_AddBoolToObject(opengl, "available", f->opengl);
    if (f->opengl) {
        cJSON_AddStringToObject(opengl, "device", f->device);
        cJSON_AddStringToObject(opengl, "driver", f->driver);
        cJSON_AddBoolToObject(opengl, "software", f->software);
    } else {
        cJSON_AddStringToObject(opengl, "reason", f->device);
    }
    cJSON *libraries = cJSON_AddObjectToObject(root, "libraries");
    for (int i = 0; i < LIBRARIES; i++)
        cJSON_AddStringToObject(libraries, f->libraries[i].name, f->libraries[i].version);
    cJSON *cache =
        f->cached ? cJSON_AddObjectToObject(root, "cache") : cJSON_AddNullToObject(root, "cache");
    if (f->cached) {
        cJSON_AddStringToObject(cache, "folder", f->cache);
        cJSON_AddNumberToObject(cache, "files", (double)f->usage.files);
        cJSON_AddNumberToObject(cache, "bytes", (double)f->usage.bytes);
        cJSON_AddNumberToObject(cache, "limit", (double)f->usage.limit);
    }
    return file_json_print(root, "doctor", error);
}

static int run(const cli_command *command, int argc, char **argv) {
    bool clear = false, json = false;
    int mask = LMP_CPU_ALL;
    const char *device = NULL;
    const cli_option options[] = {
        { .name = "clear-cache",
          .kind = CLI_FLAG,
          .target = &clear,
          .help = "remove the files of the cache before looking" },
        { .name = "json", .kind = CLI_FLAG, .target = &json, .help = "print JSON" },
        { .name = "gl-device",
          .kind = CLI_TEXT,
          .target = &device,
          .argument = "DEVICE",
          .help = "the OpenGL device: a number, part of its name, or software" },
        cli_cpu_mask(&mask),
        { .name = NULL },
    };
    int count, status;
    char **operands;
    findings f = { .kernel_count = 0 };
    cli_error error;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (clear)
        file_cache_clear();
    find_all(mask, device, &f);
    if (!json)
        print_text(&f);
    else if (!print_json(&f, &error))
        return cli_report(&error);
    return f.opengl || !device ? CLI_OK : CLI_FAILURE; /* one that was asked for is missed */
}

const cli_command command_doctor = {
    .name = "doctor",
    .operands = "",
    .summary = "tell what this machine offers, and where the cache is",
    .examples = "lampion doctor\n"
                "lampion doctor --json\n"
                "lampion doctor --clear-cache\n",
    .run = run,
};
