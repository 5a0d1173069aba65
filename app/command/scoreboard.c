/* SPDX-License-Identifier: MIT */
/* lampion scoreboard - formulas for spherical lights, compared in accuracy and in speed. */
#include "app/base/cli.h"
#include "app/command/command.h"
#include "app/truth/scoreboard_plates.h"
#include "app/truth/scoreboard_print.h"

#include <stdio.h>

typedef struct scoreboard_arguments {
    cli_list formulas, materials;
    int format, plot_material;
    const char *cosines, *plot, *plates;
} scoreboard_arguments;

typedef void (*scoreboard_printer)(const board *b);
static const char *const format_names[] = { "text", "csv", "json", NULL };
static const scoreboard_printer printers[] = { board_print_text, board_print_csv,
                                               board_print_json };

static bool write_files(const scoreboard_arguments *a, const board *b, base_error *error) {
    return (!a->plot || board_plot(b, (ruler_material)a->plot_material, a->plot, error)) &&
           (!a->plates || plates_write(b, a->plates, error));
}

static int execute(const scoreboard_arguments *a) {
    const cli_list all = { .count = 0 };
    ruler_choice choice;
    ruler_table table;
    cosines_table published = { .size = 0 };
    board b;
    base_error error;
    if (!ruler_choose(&all, &a->materials, &choice, &error) ||
        (a->cosines && !cosines_read(a->cosines, &published, &error)) ||
        !ruler_table_open(&choice, &table, &error)) {
        cosines_free(&published);
        return base_report(&error);
    }
    bool done = board_create(&table, &a->formulas, a->cosines ? &published : NULL, &b, &error);
    if (done) {
        printers[a->format](&b);
        done = write_files(a, &b, &error);
        board_free(&b);
    }
    ruler_table_free(&table);
    cosines_free(&published);
    return done ? BASE_OK : base_report(&error);
}

static int run(const cli_command *command, int argc, char **argv) {
    scoreboard_arguments a = { .plot_material = RULER_METAL };
    const cli_option options[] = {
        { .name = "formula",
          .kind = CLI_LIST,
          .target = &a.formulas,
          .argument = "NAME",
          .help = "only this one; may be repeated" },
        RULER_MATERIAL_OPTION_ROW(a.materials),
        { .name = "cosines",
          .kind = CLI_TEXT,
          .target = &a.cosines,
          .argument = "FILE.js",
          .help = "judge `published` by this table of linearly transformed cosines, as its authors "
                  "and three.js have it" },
        { .name = "format",
          .kind = CLI_CHOICE,
          .target = &a.format,
          .argument = "KIND",
          .help = "what is printed",
          .choices = format_names },
        { .name = "plot",
          .kind = CLI_TEXT,
          .target = &a.plot,
          .argument = "FILE.svg",
          .help = "draw error over cost" },
        { .name = "plot-material",
          .kind = CLI_CHOICE,
          .target = &a.plot_material,
          .argument = "NAME",
          .help = "the material of the plot",
          .choices = ruler_material_names },
        { .name = "plates",
          .kind = CLI_TEXT,
          .target = &a.plates,
          .argument = "FILE.png",
          .help = "draw a metal plate by the truth and each formula, differences below" },
        { .name = NULL },
    };
    int count, status;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    return execute(&a);
}

const cli_command command_scoreboard = {
    .name = "scoreboard",
    .operands = "",
    .summary = "compare formulas for sphere lights: error by the ruler, and time",
    .examples = "lampion scoreboard\n"
                "lampion scoreboard --format csv > scoreboard.csv\n"
                "lampion scoreboard --plot error-cost.svg --plates plates.png\n",
    .run = run,
    .kernels = true,
};
