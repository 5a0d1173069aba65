/* SPDX-License-Identifier: MIT */
/* gpu_print.c - the rows of `lampion bench gpu`, for reading and as JSON. */
#include "app/bench/gpu.h"

#include <lampion/cpu.h>

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

/* What a row reads besides the scene: its bytes, and what making or loading it took. */
typedef struct bench_tables {
    size_t bytes;
    double ms, lobes_ms, preintegrated_ms; /* tables of materials, and these preintegrated */
} bench_tables;

static bench_tables tables_of(const bench_scene *s, const bench_row *c) {
    const unsigned reads = method_table[c->by->method].reads;
    const bool preintegrated = reads & METHOD_READS_PREINTEGRATED;
    const override_set *all = &s->materials;
    bench_tables sum = { .ms = s->bake_ms };
    if (reads & METHOD_READS_TABULATED_Z)
        sum.bytes = gpu_zonal_bytes(c->bands);
    if (preintegrated) {
        sum.bytes = lmp_preintegrated_lobe_describe(s->lobes[c->bands]).bytes;
        sum.lobes_ms = s->build_ms[c->bands];
        sum.preintegrated_ms = s->integrate_ms;
    }
    for (int i = 0; i < all->count; i++)
        sum.bytes += preintegrated && all->preintegrated[i]
                         ? lmp_preintegrated_brdf_describe(all->preintegrated[i]).bytes
                         : lmp_brdf_table_size(all->tables[i]);
    return sum;
}

/* Four digits. */
static void add_number(cJSON *row, const char *name, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.4g", value);
    cJSON_AddRawToObject(row, name, text);
}

static void print_json(const bench_scene *s, const bench_row *c, const bench_result *result,
                       double ns, double paper) {
    const bench_tables tables = tables_of(s, c);
    cJSON *row = cJSON_CreateObject();
    cJSON_AddStringToObject(row, "scene", s->name);
    cJSON_AddStringToObject(row, "device", device_table[c->by->device].name);
    cJSON_AddStringToObject(row, "method", method_table[c->by->method].name);
    cJSON_AddNumberToObject(row, "bands", c->bands);
    cJSON_AddNumberToObject(row, "lights", c->lights);
    cJSON_AddNumberToObject(row, "width", c->width);
    cJSON_AddNumberToObject(row, "height", c->height);
    add_number(row, "ms", result->ms);
    add_number(row, "frame_ms", result->frame_ms);
    cJSON_AddNumberToObject(row, "frames", result->frames);
    add_number(row, "ns_per_pixel_light", ns);
    if (paper > 0)
        add_number(row, "vs_paper", paper / result->ms);
    else
        cJSON_AddNullToObject(row, "vs_paper");
    add_number(row, "compile_ms", result->compile_ms);
    cJSON_AddNumberToObject(row, "table_bytes", (double)tables.bytes);
    add_number(row, "table_ms", tables.ms);
    add_number(row, "lobes_ms", tables.lobes_ms);
    add_number(row, "preintegrated_ms", tables.preintegrated_ms);
    char *text = cJSON_PrintUnformatted(row);
    printf("%s    %s", s->first ? "" : ",\n", text ? text : "null");
    cJSON_free(text);
    cJSON_Delete(row);
}

void bench_print_row(bench_scene *s, const bench_row *c, const bench_result *result, double paper) {
    const double ns = 1e6 * result->ms / ((double)c->width * c->height * c->lights);
    if (s->options->json) {
        print_json(s, c, result, ns, paper);
    } else {
        const bench_tables tables = tables_of(s, c);
        char ratio[32] = "-";
        if (paper > 0)
            snprintf(ratio, sizeof ratio, "%.2f", paper / result->ms);
        printf(
            "%-15s %-4s %-14s %5d %6d  %4dx%-4d %10.3f %10.3f %6d %9.3f %9s %9.0f %9zu %8.0f %8.0f "
            "%8.0f\n",
            s->name, device_table[c->by->device].name, method_table[c->by->method].name, c->bands,
            c->lights, c->width, c->height, result->ms, result->frame_ms, result->frames, ns, ratio,
            result->compile_ms, tables.bytes / 1024, tables.ms, tables.lobes_ms,
            tables.preintegrated_ms);
    }
    s->first = false;
    fflush(stdout);
}

static void print_json_header(const bench_scene *s) {
    const bench_options *o = s->options;
    cJSON *root = cJSON_CreateObject();
    for (int i = DEVICE_FIRST; i < DEVICES; i++)
        if (s->renderers[i]) {
            cJSON_AddStringToObject(root, device_table[i].name, s->devices[i].name);
            cJSON_AddStringToObject(root, i == DEVICE_GPU ? "driver" : "rays",
                                    s->devices[i].driver);
        }
    cJSON_AddStringToObject(root, "cpu_kernels", lmp_cpu_name());
    cJSON_AddStringToObject(root, "commit", LAMPION_COMMIT);
    cJSON_AddItemToObject(
        root, "materials",
        cJSON_CreateStringArray((const char *const *)o->materials.items, o->materials.count));
    char *text = cJSON_PrintUnformatted(root);
    if (text) /* the rows go on where it would end */
        printf("%.*s,\n  \"rows\": [\n", (int)strlen(text) - 1, text);
    cJSON_free(text);
    cJSON_Delete(root);
}

void bench_print_header(const bench_scene *s) {
    const bench_options *o = s->options;
    if (o->json) {
        print_json_header(s);
        return;
    }
    for (int i = DEVICE_FIRST; i < DEVICES; i++)
        if (s->renderers[i])
            printf("%s: %s (%s, %s); ", device_table[i].name, s->devices[i].name,
                   s->devices[i].driver, render_device_clock(&s->devices[i]));
    printf("CPU kernels: %s; commit %s\n", lmp_cpu_name(), LAMPION_COMMIT);
    for (int i = 0; i < o->materials.count; i++)
        printf("%s%s", i ? ", " : "materials: ", o->materials.items[i]);
    printf(
        "%s"
        "ms: from surfaces to radiance, median of the "
        "frames; whole: with finding the surfaces and the tone curve; x paper: against the paper's "
        "fragment shader in the same run; ms at the "
        "end: making or reading the materials' tables, the lobes, preintegrating the materials' "
        "tables\n",
        o->materials.count ? "\n" : "");
    printf("%-15s %-4s %-14s %5s %6s  %9s %10s %10s %6s %9s %9s %9s %9s %8s %8s %8s\n", "scene",
           "dev", "method", "bands", "lights", "size", "ms", "whole", "frames", "ns/pair",
           "x paper", "compile", "table KB", "table", "lobes", "preint.");
}

/* --- whole frames ----------------------------------------------------------------------------- */

method_kind bench_compared(void) {
    int m = 0;
    while (!(method_table[m].reads & METHOD_READS_FIELD))
        m++;
    return method_table[m].compared;
}

/* What others are compared with, on the same device; 0: it was not timed. */
static double compared_ms(const bench_plan *plan, const bench_setting *setting, int i) {
    for (int k = 0; k < plan->case_count; k++)
        if (plan->cases[k].device == plan->cases[i].device &&
            plan->cases[k].method == bench_compared())
            return setting->frame_ms[k];
    return 0;
}

static void print_line(const bench_plan *plan, const bench_setting *setting) {
    printf("%6d", setting->lights);
    for (int i = 0; i < plan->case_count; i++) {
        const double ms = setting->frame_ms[i], compared = compared_ms(plan, setting, i);
        char ratio[32] = "", text[64] = "-";
        if (ms > 0 && compared > 0)
            snprintf(ratio, sizeof ratio, " (%.3g)", compared / ms);
        if (ms > 0)
            snprintf(text, sizeof text, "%.4g%s", ms, ratio);
        printf("  %18s", text);
    }
    putchar('\n');
}

/* Whether they stand in one table. */
static bool is_together(const bench_setting *a, const bench_setting *b) {
    return a->bands == b->bands && a->size == b->size;
}

void bench_print_frames(const bench_scene *s) {
    const bench_plan *plan = s->plan;
    for (int i = 0; i < plan->setting_count; i++) {
        const bench_setting *first = &plan->settings[i];
        bool printed = false;
        for (int k = 0; k < i; k++)
            printed = printed || is_together(&plan->settings[k], first);
        if (printed)
            continue;
        printf("\nwhole frames, %d bands, %dx%d: ms (times as fast as %s)\n%6s", first->bands,
               first->size[0], first->size[1], method_table[bench_compared()].name, "lights");
        for (int k = 0; k < plan->case_count; k++)
            printf("  %3s %14s", device_table[plan->cases[k].device].name,
                   method_table[plan->cases[k].method].name);
        putchar('\n');
        for (int k = i; k < plan->setting_count; k++)
            if (is_together(&plan->settings[k], first))
                print_line(plan, &plan->settings[k]);
    }
}
