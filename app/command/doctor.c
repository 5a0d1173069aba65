/* SPDX-License-Identifier: MIT */
/* doctor.c - lampion doctor: reports what this machine offers, and where the program keeps
 * files. */
#include "app/base/cli.h"
#include "app/base/file_cache.h"
#include "app/base/file_json.h"
#include "app/base/timing.h"
#include "app/command/command.h"
#include "app/render/renderer/renderer.h"
#include "app/scene/scene.h"
#include "app/scene/trace/trace.h"
#include "app/view/ui.h"
#include "app/view/window.h"

#include <lampion/base.h>
#include <lampion/cpu.h>

#include <omp.h>
#include <openexr.h>
#include <png.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define LABEL "%-14s"

enum { LIBRARIES = 7 };

/* What was found out, printed as text or as JSON. */
typedef struct findings {
    char version[32], cpu[160], kernel[32];
    char kernels[5][32]; /* the available instruction sets */
    int kernel_count, threads;
    bool opengl, software;
    char device[1024], driver[256]; /* without OpenGL, device says why */
    struct {
        const char *name;
        char version[48];
    } libraries[LIBRARIES];
    bool cached;
    char cache[4096];
    file_cache_usage usage;
} findings;

/* Finds the instruction set in use, and the available ones. */
static void find_kernels(int mask, findings *f) {
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag <<= 1) {
        if (!(lmp_cpu_flags() & flag))
            continue;
        lmp_cpu_limit(flag);
        snprintf(f->kernels[f->kernel_count++], sizeof *f->kernels, "%s", lmp_cpu_name());
    }
    lmp_cpu_limit((unsigned)mask);
    snprintf(f->kernel, sizeof f->kernel, "%s", lmp_cpu_name());
}

/* Finds OpenGL's device. Without OpenGL, the CPU draws images and there is no viewer. */
static void find_opengl(const char *device, findings *f) {
    render_device gpu;
    base_error error;
    f->opengl = render_device_open(DEVICE_GPU, device, NULL, &gpu, &error);
    f->software = gpu.gl.software;
    snprintf(f->device, sizeof f->device, "%s", f->opengl ? gpu.name : error.text);
    snprintf(f->driver, sizeof f->driver, "%s", gpu.driver);
    render_device_close(&gpu);
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

typedef bool version_finder(char *text, size_t size, base_error *error);

/* Adds a library that is opened only when it is needed. */
static void add_late_library(findings *f, int index, const char *name, version_finder *find) {
    base_error error;
    f->libraries[index].name = name;
    if (!find(f->libraries[index].version, sizeof f->libraries->version, &error))
        add_library(f, index, name, "missing");
}

/* Finds the versions of the loaded libraries, which may differ from those compiled against. */
static void find_libraries(findings *f) {
    int major, minor, patch;
    const char *extra;
    char embree[32];
    add_late_library(f, 0, "Assimp", scene_assimp_version);
    trace_version(NULL, embree, sizeof embree);
    add_library(f, 1, "Embree", "%s", embree + strcspn(embree, "0123456789"));
    exr_get_library_version(&major, &minor, &patch, &extra);
    add_library(f, 2, "OpenEXR", "%d.%d.%d", major, minor, patch);
    add_library(f, 3, "libpng", "%s", png_get_libpng_ver(NULL));
    add_library(f, 4, "jansson", "%s", jansson_version_str());
    add_late_library(f, 5, "GLFW", view_window_version);
    add_library(f, 6, "Dear ImGui", "%s", ui_version());
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

static json_t *opengl_to_json(const findings *f) {
    if (!f->opengl)
        return json_pack("{s:b, s:o}", "available", f->opengl, "reason",
                         file_json_string(f->device));
    return json_pack("{s:b, s:o, s:o, s:b}", "available", f->opengl, "device",
                     file_json_string(f->device), "driver", file_json_string(f->driver), "software",
                     f->software);
}

static json_t *cache_to_json(const findings *f) {
    if (!f->cached)
        return json_null();
    return json_pack("{s:o, s:I, s:I, s:I}", "folder", file_json_string(f->cache), "files",
                     (json_int_t)f->usage.files, "bytes", (json_int_t)f->usage.bytes, "limit",
                     (json_int_t)f->usage.limit);
}

static bool print_json(const findings *f, base_error *error) {
    json_t *sets = json_array(), *libraries = json_object();
    for (int i = 0; i < f->kernel_count; i++)
        sets = file_json_append(sets, json_string(f->kernels[i]));
    for (int i = 0; i < LIBRARIES; i++)
        libraries = file_json_with(libraries, f->libraries[i].name,
                                   file_json_string(f->libraries[i].version));
    json_t *root = json_pack("{s:s, s:o, s:i, s:s, s:o, s:o, s:o, s:o}", "lampion", f->version,
                             "cpu", file_json_string(f->cpu), "threads", f->threads, "kernels",
                             f->kernel, "kernels_available", sets, "opengl", opengl_to_json(f),
                             "libraries", libraries, "cache", cache_to_json(f));
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
    base_error error;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (clear)
        file_cache_clear();
    find_all(mask, device, &f);
    if (!json)
        print_text(&f);
    else if (!print_json(&f, &error))
        return base_report(&error);
    return f.opengl || !device ? BASE_OK : BASE_FAILURE; /* a named device must exist */
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
