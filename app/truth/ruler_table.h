/* SPDX-License-Identifier: MIT */
/* ruler_table.h - the proven values of ruler/ruler.csv, which is embedded in the program. */
#ifndef LAMPION_TRUTH_RULER_TABLE_H
#define LAMPION_TRUTH_RULER_TABLE_H

#include "app/base/cli.h"
#include "app/base/embedded.h"

extern const embedded_file ruler_files[];

/* The lights, with the names of docs/ruler.md. */
typedef enum ruler_light {
    RULER_SPHERE,
    RULER_SUN,
    RULER_HEMISPHERE,
    RULER_POINT,
    RULER_SPOT,
    RULER_LIGHTS
} ruler_light;
typedef enum ruler_material {
    RULER_LAMBERT,
    RULER_PHONG,
    RULER_METAL,
    RULER_DIELECTRIC,
    RULER_MATERIALS
} ruler_material;
extern const char *const ruler_light_names[RULER_LIGHTS + 1]; /* NULL-terminated */
extern const char *const ruler_material_names[RULER_MATERIALS + 1];

typedef struct ruler_row {
    const char *text; /* the configuration's columns, up to the comma before the value */
    int length;       /* of that text */
    int id;
    ruler_light light;
    ruler_material material;
    double size, light_angle, light_azimuth, view_angle; /* degrees, except the size of a sphere */
    double color, roughness, exponent;
    double value, radius; /* the truth is within radius of value */
} ruler_row;

typedef struct ruler_table {
    ruler_row *rows; /* in the order of their ids */
    int count;
} ruler_table;

/* A selection of rows, by the materials and lights named; an empty list means all. */
typedef struct ruler_choice {
    bool light[RULER_LIGHTS], material[RULER_MATERIALS];
} ruler_choice;
bool ruler_choose(const cli_list *lights, const cli_list *materials, ruler_choice *choice,
                  base_error *error);

/* The row of a command's option table that fills the list of materials in a selection. */
#define RULER_MATERIAL_OPTION_ROW(variable)                                                        \
    {                                                                                              \
        .name = "material", .kind = CLI_LIST, .target = &(variable), .argument = "NAME",           \
        .help = "only rows of lambert, phong, metal or dielectric; may be repeated"                \
    }

bool ruler_table_open(const ruler_choice *choice, ruler_table *table, base_error *error);
void ruler_table_free(ruler_table *table);

/* Returns the header of a configuration's columns, without that of the value. */
const char *ruler_table_header(void);

/* Returns half the angle that a light subtends, in degrees; 0 for a single direction. */
double ruler_half_angle(const ruler_row *row);

/* Returns the scale of a row's values: the most that a white diffuse surface facing the light
 * reflects. */
double ruler_scale(const ruler_row *row);

#endif
