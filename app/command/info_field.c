/* SPDX-License-Identifier: MIT */
/* info_field.c - lampion info of a .lmpf. */
#include "app/cli/printable.h"
#include "app/command/info.h"
#include "app/file/file.h"
#include "app/volume/volume.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

static const char layout[] = "interleaved", precision[] = "float";

bool info_is_field(const char *path) {
    return volume_file_of(path) == VOLUME_LMPF;
}

/* The node opposite the first. */
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
    cli_print_name(path);
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
    for (int kind = 0; kind < LMP_LIGHT_KINDS; kind++)
        if (facts->of_kind[kind]) {
            printf("%s%zu %s", separator, facts->of_kind[kind], scene_light_kinds[kind].name);
            separator = ", ";
        }
    printf(" (room for %d)\n", desc->light_max);
    printf("%-10s %s, values and derivatives\n%-10s %s\n%-10s %zu\n", "layout", layout, "precision",
           precision, "bytes", facts->bytes);
}

static int print_json(const char *path, const volume_facts *facts) {
    const lmp_field_desc *desc = &facts->info.desc;
    float last[3];
    cli_error error;
    cJSON *root = cJSON_CreateObject();
    find_last(desc, last);
    cJSON_AddStringToObject(root, "field", path);
    cJSON_AddItemToObject(root, "nodes", cJSON_CreateIntArray(desc->nodes, 3));
    file_json_add_floats(root, "minimum", &desc->origin.x, 3);
    file_json_add_floats(root, "maximum", last, 3);
    file_json_add_floats(root, "cell", &desc->cell.x, 3);
    cJSON_AddNumberToObject(root, "bands", desc->bands);
    file_json_add_floats(root, "reach", &facts->info.reach, 1);
    file_json_add_floats(root, "error", &desc->error, 1);
    cJSON *lights = cJSON_AddObjectToObject(root, "lights");
    for (int kind = 0; kind < LMP_LIGHT_KINDS; kind++)
        if (facts->of_kind[kind])
            cJSON_AddNumberToObject(lights, scene_light_kinds[kind].name,
                                    (double)facts->of_kind[kind]);
    cJSON_AddNumberToObject(root, "light_count", (double)facts->info.light_count);
    cJSON_AddNumberToObject(root, "light_max", desc->light_max);
    cJSON_AddStringToObject(root, "layout", layout);
    cJSON_AddStringToObject(root, "precision", precision);
    cJSON_AddNumberToObject(root, "bytes", (double)facts->bytes);
    return file_json_print(root, path, &error) ? CLI_OK : cli_report(&error);
}

int info_print_field(const char *path, bool json) {
    volume_facts facts;
    cli_error error = { 0 };
    if (!volume_describe_field(path, &facts, &error))
        return cli_report(&error);
    if (json)
        return print_json(path, &facts);
    print_text(path, &facts);
    return CLI_OK;
}
