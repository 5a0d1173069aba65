/* SPDX-License-Identifier: MIT */
/* bench_gpu_print.c - prints the rows of `lampion bench gpu`, as text and as JSON. */
#include "app/base/file_json.h"
#include "app/study/bench_gpu.h"

#include <lampion/cpu.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The tables that a row reads: their bytes, and the time to make or load them. */
typedef struct bench_tables {
    size_t bytes;
    double ms, lobes_ms, preintegrated_ms; /* tables of materials, and their preintegration */
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

static json_t *four_digits(double value) {
    char text[32];
    snprintf(text, sizeof text, "%.4g", value);
    return file_json_real(strtod(text, NULL));
}

static void print_json(const bench_scene *s, const bench_row *c, const bench_result *result,
                       double ns, double paper) {
    const bench_tables tables = tables_of(s, c);
    base_error error;
    json_t *row = json_pack(
        "{s:o, s:s, s:s, s:i, s:i, s:i, s:i, s:o, s:o, s:i, s:o, s:o, s:o, s:I, s:o, s:o, s:o}",
        "scene", file_json_string(s->name), "device", device_table[c->by->device].name, "method",
        method_table[c->by->method].name, "bands", c->bands, "lights", c->lights, "width", c->width,
        "height", c->height, "ms", four_digits(result->ms), "frame_ms",
        four_digits(result->frame_ms), "frames", result->frames, "ns_per_pixel_light",
        four_digits(ns), "vs_paper", paper > 0 ? four_digits(paper / result->ms) : json_null(),
        "compile_ms", four_digits(result->compile_ms), "table_bytes", (json_int_t)tables.bytes,
        "table_ms", four_digits(tables.ms), "lobes_ms", four_digits(tables.lobes_ms),
        "preintegrated_ms", four_digits(tables.preintegrated_ms));
    char *text = file_json_text(row, false, NULL, &error);
    printf("%s    %s", s->first ? "" : ",\n", text ? text : "null");
    free(text);
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
    json_t *root = json_object(), *materials = json_array();
    base_error error;
    for (int i = DEVICE_FIRST; i < DEVICES; i++)
        if (s->renderers[i]) {
            root = file_json_with(root, device_table[i].name, file_json_string(s->devices[i].name));
            root = file_json_with(root, i == DEVICE_GPU ? "driver" : "rays",
                                  file_json_string(s->devices[i].driver));
        }
    for (int i = 0; i < o->materials.count; i++)
        materials = file_json_append(materials, file_json_string(o->materials.items[i]));
    root = file_json_with(root, "cpu_kernels", json_string(lmp_cpu_name()));
    root = file_json_with(root, "commit", json_string(LAMPION_COMMIT));
    root = file_json_with(root, "materials", materials);
    char *text = file_json_text(root, false, NULL, &error);
    if (text) /* the rows follow in place of its closing brace */
        printf("%.*s,\n  \"rows\": [\n", (int)strlen(text) - 1, text);
    free(text);
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

/* Returns the milliseconds of the compared method on the same device; 0 if it was not timed. */
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

/* Whether two settings belong to the same table. */
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
