/* SPDX-License-Identifier: MIT */
#include "app/truth/ruler_table.h"
#include "app/base/choice.h"
#include "app/base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define HEADER                                                                                     \
    "id,light,size,light_angle,light_azimuth,view_angle,material,color,roughness,exponent"
#define COLUMNS 12

const char *const ruler_light_names[] = { "sphere", "sun", "hemisphere", "point", "spot", NULL };
const char *const ruler_material_names[] = { "lambert", "phong", "metal", "dielectric", NULL };

const char *ruler_table_header(void) {
    return HEADER;
}

static int find_name(const char *const *names, const char *text, size_t length) {
    for (int k = 0; names[k]; k++)
        if (strlen(names[k]) == length && memcmp(names[k], text, length) == 0)
            return k;
    return -1;
}

/* Marks the names in the list as chosen, or all if the list is empty. */
static bool choose(const cli_list *list, const char *option, const char *const *names, bool *chosen,
                   base_error *error) {
    for (int k = 0; names[k]; k++)
        chosen[k] = list->count == 0;
    for (int i = 0; i < list->count; i++) {
        const int k = find_name(names, list->items[i], strlen(list->items[i]));
        if (k < 0)
            return choice_fail(error, option, list->items[i], names);
        chosen[k] = true;
    }
    return true;
}

bool ruler_choose(const cli_list *lights, const cli_list *materials, ruler_choice *choice,
                  base_error *error) {
    return choose(lights, "--light", ruler_light_names, choice->light, error) &&
           choose(materials, "--material", ruler_material_names, choice->material, error);
}

/* Parses a line of the table, which the generator has written; a damaged line is rejected. */
static bool parse_row(const char *line, const char *end, ruler_row *row) {
    double numbers[COLUMNS];
    const char *at = line;
    for (int column = 0; column < COLUMNS; column++) {
        const char *const comma = memchr(at, ',', (size_t)(end - at));
        const char *const stop = comma ? comma : end;
        const size_t length = (size_t)(stop - at);
        if ((comma == NULL) != (column == COLUMNS - 1))
            return false;
        if (column == 1 || column == 6)
            numbers[column] =
                find_name(column == 1 ? ruler_light_names : ruler_material_names, at, length);
        else if (!number_read(at, length, &numbers[column]))
            return false;
        if (!(numbers[column] >= 0))
            return false;
        if (column == COLUMNS - 3)
            row->length = (int)(stop - line);
        at = stop + 1;
    }
    row->text = line;
    row->id = (int)numbers[0];
    row->light = (ruler_light)numbers[1];
    row->size = numbers[2];
    row->light_angle = numbers[3];
    row->light_azimuth = numbers[4];
    row->view_angle = numbers[5];
    row->material = (ruler_material)numbers[6];
    row->color = numbers[7];
    row->roughness = numbers[8];
    row->exponent = numbers[9];
    row->value = numbers[10];
    row->radius = numbers[11];
    return true;
}

bool ruler_table_open(const ruler_choice *choice, ruler_table *table, base_error *error) {
    const char *const text = ruler_files[0].text, *line = strchr(text, '\n') + 1;
    size_t lines = 0;
    for (const char *at = line; *at; at++)
        lines += *at == '\n';
    table->count = 0;
    table->rows = malloc((lines + 1) * sizeof *table->rows);
    if (!table->rows)
        return base_fail(error, NULL, "out of memory");
    for (const char *end; (end = strchr(line, '\n')); line = end + 1) {
        ruler_row *const row = &table->rows[table->count];
        if (!parse_row(line, end, row)) {
            ruler_table_free(table);
            return base_fail(error, ruler_files[0].name, "was damaged before it was built in");
        }
        table->count += choice->light[row->light] && choice->material[row->material];
    }
    return true;
}

void ruler_table_free(ruler_table *table) {
    free(table->rows);
    table->rows = NULL;
    table->count = 0;
}

double ruler_half_angle(const ruler_row *row) {
    switch (row->light) {
    case RULER_SPHERE:
        return row->size > 1 ? 180 : asin(row->size) * 180 / PI;
    case RULER_SUN:
        return row->size;
    case RULER_HEMISPHERE:
        return 90;
    default:
        return 0;
    }
}

double ruler_scale(const ruler_row *row) {
    const double angle = ruler_half_angle(row) * PI / 180;
    if (angle >= PI / 2)
        return 1;
    return angle > 0 ? sin(angle) * sin(angle) : 1 / PI;
}
