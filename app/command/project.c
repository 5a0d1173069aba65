/* SPDX-License-Identifier: MIT */
/* lampion project - spherical-harmonics coefficients of sphere lights, one light or a table of
 * them. */
#include "app/base/cli.h"
#include "app/base/csv.h"
#include "app/command/command.h"

#include <lampion/light.h>

#include <math.h>
#include <stdlib.h>

#define COLUMNS 8 /* the last is optional */
#define HEADER  "light_x,light_y,light_z,radius,recv_x,recv_y,recv_z[,visibility]"

static const char *const column_names[COLUMNS] = { "light_x", "light_y", "light_z", "radius",
                                                   "recv_x",  "recv_y",  "recv_z",  "visibility" };

typedef enum project_format { FORMAT_TEXT, FORMAT_CSV, FORMAT_JSON } project_format;
static const char *const format_names[] = { "text", "csv", "json", NULL };

typedef struct project_options {
    float light[3], radius, point[3], radiance;
    int bands, format;
    const char *batch;
    bool light_given, radius_given, point_given, format_given;
} project_options;

/* A row of the table: a light, and the point from which it is seen. */
typedef struct project_row {
    float center[3], radius, point[3];
    float visibility; /* fraction of the light that arrives */
} project_row;

/* Passes rows to the batch kernels in chunks, on every core. */
static void project_rows(const project_row *rows, size_t count, int bands, float radiance,
                         float *coefficients) {
    enum { SOME = 256 };
    const size_t stride = LMP_SH_COUNT(bands), parts = (count + SOME - 1) / SOME;
#pragma omp parallel for schedule(static)
    for (size_t part = 0; part < parts; part++) {
        const size_t first = part * SOME, some = count - first < SOME ? count - first : SOME;
        const project_row *row = rows + first;
        const lmp_spheres spheres = {
            .center = { &row->center[0], &row->center[1], &row->center[2], sizeof *row },
            .radius = { &row->radius, sizeof *row },
        };
        const lmp_vec3_array points = { &row->point[0], &row->point[1], &row->point[2],
                                        sizeof *row };
        float *sh = coefficients + first * stride;
        lmp_sphere_project_n(bands, &spheres, points, some, lmp_sh_interleaved(sh, 0));
        for (size_t k = 0; k < some * stride; k++)
            sh[k] *= radiance * row[k / stride].visibility;
    }
}

/* --- one light ------------------------------------------------------------------------------- */

static void print_header(size_t count) {
    for (size_t i = 0; i < count; i++)
        printf("%sc_%zu", i ? "," : "", i);
    putchar('\n');
}

static void print_values(const float *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char text[CSV_TEXT_MAX];
        const size_t length = csv_format(values[i], text);
        printf("%s%.*s", i ? "," : "", (int)length, text);
    }
}

static void print_text(const float *sh, int bands) {
    printf("%3s %4s  value\n", "l", "m");
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++) {
            char text[CSV_TEXT_MAX];
            const float value = sh[LMP_SH_INDEX(l, m)];
            const size_t length = csv_format(value, text);
            printf("%3d %4d %s%.*s\n", l, m, value < 0.0f ? "" : " ", (int)length, text);
        }
}

static void print_json(const project_options *o, const float *sh) {
    printf("{\"bands\":%d,\"radiance\":", o->bands);
    print_values(&o->radiance, 1);
    printf(",\"light\":[");
    print_values(o->light, 3);
    printf("],\"radius\":");
    print_values(&o->radius, 1);
    printf(",\"point\":[");
    print_values(o->point, 3);
    printf("],\"coefficients\":[");
    print_values(sh, LMP_SH_COUNT(o->bands));
    printf("]}\n");
}

static int project_one(const project_options *o) {
    float sh[LMP_SH_COUNT(LMP_BANDS_MAX)];
    const project_row row = { { o->light[0], o->light[1], o->light[2] },
                              o->radius,
                              { o->point[0], o->point[1], o->point[2] },
                              1 };
    project_rows(&row, 1, o->bands, o->radiance, sh);
    if (o->format == FORMAT_TEXT) {
        print_text(sh, o->bands);
    } else if (o->format == FORMAT_JSON) {
        print_json(o, sh);
    } else {
        print_header(LMP_SH_COUNT(o->bands));
        print_values(sh, LMP_SH_COUNT(o->bands));
        putchar('\n');
    }
    return BASE_OK;
}

/* --- a table of them, block by block --------------------------------------------------------- */

/* Buffers for a block of rows while it is read, projected and printed. */
typedef struct block {
    size_t room, coefficient_count;
    project_row *rows;
    float *coefficients;
    char *text; /* `room` lines of line_size bytes */
    size_t line_size, *line_lengths;
} block;

static bool block_create(block *b, int bands) {
    const size_t values = 1 << 19; /* per block, for constant memory whatever the bands */
    b->coefficient_count = LMP_SH_COUNT(bands);
    b->room = values / b->coefficient_count < 4096 ? values / b->coefficient_count : 4096;
    b->line_size = b->coefficient_count * (CSV_TEXT_MAX + 1);
    b->rows = malloc(b->room * sizeof *b->rows);
    b->coefficients = malloc(b->room * b->coefficient_count * sizeof *b->coefficients);
    b->text = malloc(b->room * b->line_size);
    b->line_lengths = malloc(b->room * sizeof *b->line_lengths);
    return b->rows && b->coefficients && b->text && b->line_lengths;
}

static void block_free(block *b) {
    free(b->rows);
    free(b->coefficients);
    free(b->text);
    free(b->line_lengths);
}

/* Reads up to b->room rows; returns CSV_ROW if there may be more. */
static csv_result block_read(block *b, csv_reader *reader, size_t *count, base_error *error) {
    const int columns = COLUMNS - !reader->more;
    for (*count = 0; *count < b->room; (*count)++) {
        float v[COLUMNS] = { [COLUMNS - 1] = 1 };
        const csv_result result = csv_read_row(reader, column_names, columns, v, error);
        if (result != CSV_ROW)
            return result;
        for (int i = 0; i < COLUMNS; i++)
            if (!(fabsf(v[i]) <= LMP_LENGTH_MAX))
                return csv_line_error(reader, error, "%s: %g is out of range (up to %g)",
                                      column_names[i], (double)v[i], (double)LMP_LENGTH_MAX);
        if (v[3] < 0.0f)
            return csv_line_error(reader, error, "radius: %g is negative", (double)v[3]);
        if (!(v[7] >= 0.0f && v[7] <= 1.0f))
            return csv_line_error(reader, error, "visibility: %g is out of range (0 to 1)",
                                  (double)v[7]);
        b->rows[*count] = (project_row) { { v[0], v[1], v[2] }, v[3], { v[4], v[5], v[6] }, v[7] };
    }
    return CSV_ROW;
}

static size_t format_line(const float *values, size_t count, char *line) {
    char *out = line;
    for (size_t i = 0; i < count; i++) {
        out += csv_format(values[i], out);
        *out++ = ',';
    }
    out[-1] = '\n';
    return (size_t)(out - line);
}

/* Prints a block; returns false if stdout accepts no more, which main reports. */
static bool block_print(block *b, size_t count) {
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < count; i++)
        b->line_lengths[i] = format_line(b->coefficients + i * b->coefficient_count,
                                         b->coefficient_count, b->text + i * b->line_size);
    for (size_t i = 0; i < count; i++)
        if (fwrite(b->text + i * b->line_size, 1, b->line_lengths[i], stdout) != b->line_lengths[i])
            return false;
    return true;
}

static int project_table(const project_options *o, csv_reader *reader, block *b) {
    base_error error;
    csv_result result;
    print_header(b->coefficient_count);
    do {
        size_t count;
        result = block_read(b, reader, &count, &error);
        project_rows(b->rows, count, o->bands, o->radiance, b->coefficients);
        if (!block_print(b, count))
            return BASE_FAILURE;
    } while (result == CSV_ROW);
    return result == CSV_END ? BASE_OK : base_report(&error);
}

static int project_batch(const project_options *o) {
    base_error error;
    csv_reader *const reader = malloc(sizeof *reader);
    block b;
    int status = BASE_FAILURE;
    if (!block_create(&b, o->bands) || !reader) {
        base_fail(&error, NULL, "out of memory");
        base_report(&error);
    } else if (!csv_open(reader, o->batch, HEADER, &error)) {
        base_report(&error);
    } else {
        status = project_table(o, reader, &b);
        csv_close(reader);
    }
    block_free(&b);
    free(reader);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    project_options o = { .radiance = 1.0f, .bands = 10 };
    const double length_max = (double)LMP_LENGTH_MAX;
    const cli_option options[] = {
        { "light", 'l', CLI_VEC3, o.light, "X,Y,Z", "center of the light", -length_max, length_max,
          NULL, &o.light_given },
        { "radius", 'r', CLI_FLOAT, &o.radius, "R", "its radius, in the same unit", 0, length_max,
          NULL, &o.radius_given },
        { "point", 'p', CLI_VEC3, o.point, "X,Y,Z", "the point that is lit [0,0,0]", -length_max,
          length_max, NULL, &o.point_given },
        { "radiance", 0, CLI_FLOAT, &o.radiance, "L", "radiance of the light", 0, 1e30, NULL,
          NULL },
        { "bands", 'n', CLI_INT, &o.bands, "N", "bands: N*N coefficients", 1, LMP_BANDS_MAX, NULL,
          NULL },
        { "format", 'f', CLI_CHOICE, &o.format, "FORMAT", "of the output [text]", 0, 0,
          format_names, &o.format_given },
        { "batch", 'b', CLI_TEXT, &o.batch, "FILE",
          "reads lights and points from a table (- is standard input) with the header " HEADER
          " and prints a row c_0,c_1,... of coefficients for each",
          0, 0, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    char **operands;
    int operand_count, status;
    if (!cli_parse(command, options, argc, argv, &operand_count, &operands, &status))
        return status;
    if (!o.batch && !(o.light_given && o.radius_given))
        return cli_usage(command, "needs --light X,Y,Z and --radius R, or --batch FILE");
    if (o.batch && (o.light_given || o.radius_given || o.point_given))
        return cli_usage(command, "--batch takes lights and points from its table alone");
    if (o.batch && o.format_given && o.format != FORMAT_CSV)
        return cli_usage(command, "--batch prints csv only");
    return o.batch ? project_batch(&o) : project_one(&o);
}

const cli_command command_project = {
    .name = "project",
    .operands = "",
    .summary = "print the SH coefficients of a sphere light at a point",
    .examples = "lampion project --light 0,3,0 --radius 0.5 --bands 4\n"
                "lampion project --light 0,3,0 --radius 0.5 --format json\n"
                "lampion project --batch lights.csv --bands 8 > coefficients.csv",
    .run = run,
    .kernels = true,
};
