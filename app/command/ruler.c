/* SPDX-License-Identifier: MIT */
/* lampion ruler - proven reference values of light on materials, and how far other values are from
 * them. */
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/truth/ruler_column.h"
#include "app/truth/ruler_report.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct ruler_arguments {
    const char *check;
    cli_list lights, materials;
    int format;
    bool truth;
    float rms, largest;
} ruler_arguments;

typedef enum ruler_format { FORMAT_CSV, FORMAT_JSON } ruler_format;
static const char *const format_names[] = { "csv", "json", NULL };

static void print_csv(const ruler_table *table, bool truth) {
    printf("%s%s\n", ruler_table_header(), truth ? ",value,radius" : "");
    for (int i = 0; i < table->count; i++) {
        const ruler_row *const row = &table->rows[i];
        printf("%.*s", row->length, row->text);
        if (truth)
            printf(",%.17g,%.3g", row->value, row->radius);
        putchar('\n');
    }
}

static void print_json(const ruler_table *table, bool truth) {
    printf("[");
    for (int i = 0; i < table->count; i++) {
        const ruler_row *const row = &table->rows[i];
        printf("%s\n{ \"id\": %d, \"light\": \"%s\", \"size\": %g, \"light_angle\": %g, "
               "\"light_azimuth\": %g, \"view_angle\": %g, \"material\": \"%s\", \"color\": %g, "
               "\"roughness\": %g, \"exponent\": %g",
               i ? "," : "", row->id, ruler_light_names[row->light], row->size, row->light_angle,
               row->light_azimuth, row->view_angle, ruler_material_names[row->material], row->color,
               row->roughness, row->exponent);
        if (truth)
            printf(", \"value\": %.17g, \"radius\": %.3g", row->value, row->radius);
        printf(" }");
    }
    printf("\n]\n");
}

static int check(const ruler_arguments *a, const ruler_table *table, base_error *error) {
    const ruler_limits limits = { (double)a->rms, (double)a->largest };
    double *values;
    if (!ruler_column_read(a->check, table, &values, error))
        return base_report(error);
    const bool within = ruler_report(table, values, &limits);
    free(values);
    return within ? BASE_OK : BASE_FAILURE;
}

static int execute(const ruler_arguments *a) {
    ruler_choice choice;
    ruler_table table;
    base_error error;
    int status = BASE_OK;
    if (!ruler_choose(&a->lights, &a->materials, &choice, &error) ||
        !ruler_table_open(&choice, &table, &error))
        return base_report(&error);
    if (a->check)
        status = check(a, &table, &error);
    else if (a->format == FORMAT_JSON)
        print_json(&table, a->truth);
    else
        print_csv(&table, a->truth);
    ruler_table_free(&table);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    ruler_arguments a = { .rms = 0.01f, .largest = 0.1f };
    const cli_option options[] = {
        { .name = "check",
          .kind = CLI_TEXT,
          .target = &a.check,
          .argument = "MINE.csv",
          .help = "judge the column \"value\" of a table of all rows; status 1 beyond the limits" },
        { .name = "rms",
          .kind = CLI_FLOAT,
          .target = &a.rms,
          .argument = "E",
          .help = "the largest root mean square of the errors that --check allows",
          .minimum = 0,
          .maximum = 1e30 },
        { .name = "max",
          .kind = CLI_FLOAT,
          .target = &a.largest,
          .argument = "E",
          .help = "the largest error of a row that --check allows",
          .minimum = 0,
          .maximum = 1e30 },
        RULER_MATERIAL_OPTION_ROW(a.materials),
        { .name = "light",
          .kind = CLI_LIST,
          .target = &a.lights,
          .argument = "NAME",
          .help = "only rows of sphere, sun, hemisphere, point or spot; may be repeated" },
        { .name = "format",
          .kind = CLI_CHOICE,
          .target = &a.format,
          .argument = "KIND",
          .help = "how rows are printed",
          .choices = format_names },
        { .name = "truth",
          .kind = CLI_FLAG,
          .target = &a.truth,
          .help = "print the proven values too, and the radius that each is within" },
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    return execute(&a);
}

const cli_command command_ruler = {
    .name = "ruler",
    .operands = "",
    .summary = "measure area lights on materials by proven values",
    .examples = "lampion ruler > configurations.csv\n"
                "lampion ruler --material lambert --light sphere --truth\n"
                "lampion ruler --check mine.csv --rms 0.02\n",
    .run = run,
};
