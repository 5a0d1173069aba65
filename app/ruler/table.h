/* SPDX-License-Identifier: MIT */
/* table.h - the proven values of ruler/ruler.csv, which travels inside the program. */
#ifndef LAMPION_RULER_TABLE_H
#define LAMPION_RULER_TABLE_H

#include "app/cli/cli.h"
#include "app/file/embedded.h"

extern const embedded_file ruler_files[];

/* Names as docs/ruler.md has them. */
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
    const char *text; /* the columns of the configuration, up to the comma before value */
    int length;       /* of that text */
    int id;
    ruler_light light;
    ruler_material material;
    double size, light_angle, light_azimuth, view_angle; /* degrees, but the size of a sphere */
    double color, roughness, exponent;
    double value, radius; /* the truth is within radius of value */
} ruler_row;

typedef struct ruler_table {
    ruler_row *rows; /* in the order of their ids */
    int count;
} ruler_table;

/* Which rows: those of the materials and lights named; an empty list means all. */
typedef struct ruler_choice {
    bool light[RULER_LIGHTS], material[RULER_MATERIALS];
} ruler_choice;
bool ruler_choose(const cli_list *lights, const cli_list *materials, ruler_choice *choice,
                  cli_error *error);

/* The row of a command's option table that fills such a list of materials. */
#define RULER_MATERIAL_OPTION_ROW(variable)                                                        \
    {                                                                                              \
        .name = "material", .kind = CLI_LIST, .target = &(variable), .argument = "NAME",           \
        .help = "only rows of lambert, phong, metal or dielectric; may be repeated"                \
    }

bool ruler_table_open(const ruler_choice *choice, ruler_table *table, cli_error *error);
void ruler_table_free(ruler_table *table);

/* The header of a configuration's columns, without that of the value. */
const char *ruler_table_header(void);

/* Half the angle that a light covers, in degrees; 0 of a single direction. */
double ruler_half_angle(const ruler_row *row);

/* What a white diffuse surface that faces the light reflects, at most: the scale of a value. */
double ruler_scale(const ruler_row *row);

#endif
