/* SPDX-License-Identifier: MIT */
/* info_field.c - lampion info for a .lmpf. */
#include "app/base/file_json.h"
#include "app/base/printable.h"
#include "app/command/info.h"
#include "app/study/volume.h"

#include <stdio.h>
#include <stdlib.h>

static const char layout[] = "interleaved", precision[] = "float";

bool info_is_field(const char *path) {
    return volume_file_of(path) == VOLUME_LMPF;
}

/* Finds the position of the node opposite the first. */
static void find_last(const lmp_field_desc *desc, float last[3]) {
    const float first[3] = { desc->origin.x, desc->origin.y, desc->origin.z };
    const float cell[3] = { desc->cell.x, desc->cell.y, desc->cell.z };
    for (int a = 0; a < 3; a++)
        last[a] = first[a] + cell[a] * (float)(desc->nodes[a] - 1);
}

static void print_text(const char *path, const volume_facts *facts) {
    const lmp_field_desc *desc = &facts->info.desc;
    const char *separator = ": ";
    float last[3];
    find_last(desc, last);
    printable_print(path);
    putchar('\n');
    printf("%-10s %dx%dx%d nodes, cells of %.6g %.6g %.6g\n", "grid", desc->nodes[0],
           desc->nodes[1], desc->nodes[2], (double)desc->cell.x, (double)desc->cell.y,
           (double)desc->cell.z);
    printf("%-10s %.6g %.6g %.6g … %.6g %.6g %.6g\n", "bounds", (double)desc->origin.x,
           (double)desc->origin.y, (double)desc->origin.z, (double)last[0], (double)last[1],
           (double)last[2]);
    printf("%-10s %d\n", "bands", desc->bands);
    printf("%-10s %.6g (%.6g cells), an error of %.3g\n", "reach", (double)facts->info.reach,
           (double)desc->reach, (double)desc->error);
    printf("%-10s %zu", "lights", facts->info.light_count);
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++)
        if (facts->of_kind[kind]) {
            printf("%s%zu %s", separator, facts->of_kind[kind], scene_light_kinds[kind].name);
            separator = ", ";
        }
    printf(" (room for %zu)\n", desc->light_max);
    printf("%-10s %s, values and derivatives\n%-10s %s\n%-10s %zu\n", "layout", layout, "precision",
           precision, "bytes", facts->bytes);
}

static json_t *lights_to_json(const volume_facts *facts) {
    json_t *lights = json_object();
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++)
        if (facts->of_kind[kind])
            lights = file_json_with(lights, scene_light_kinds[kind].name,
                                    json_integer((json_int_t)facts->of_kind[kind]));
    return lights;
}

static int print_json(const char *path, const volume_facts *facts) {
    const lmp_field_desc *desc = &facts->info.desc;
    float last[3];
    base_error error;
    find_last(desc, last);
    json_t *root =
        json_pack("{s:o, s:[i, i, i], s:o, s:o, s:o, s:i, s:o, s:o, s:o, s:I, s:i, s:s, s:s, s:I}",
                  "field", file_json_string(path), "nodes", desc->nodes[0], desc->nodes[1],
                  desc->nodes[2], "minimum", file_json_floats(&desc->origin.x, 3), "maximum",
                  file_json_floats(last, 3), "cell", file_json_floats(&desc->cell.x, 3), "bands",
                  desc->bands, "reach", file_json_float(facts->info.reach), "error",
                  file_json_float(desc->error), "lights", lights_to_json(facts), "light_count",
                  (json_int_t)facts->info.light_count, "light_max", (json_int_t)desc->light_max,
                  "layout", layout, "precision", precision, "bytes", (json_int_t)facts->bytes);
    return file_json_print(root, path, &error) ? BASE_OK : base_report(&error);
}

int info_print_field(const char *path, bool json) {
    volume_facts facts;
    base_error error = { 0 };
    if (!volume_describe_field(path, &facts, &error))
        return base_report(&error);
    if (json)
        return print_json(path, &facts);
    print_text(path, &facts);
    return BASE_OK;
}
