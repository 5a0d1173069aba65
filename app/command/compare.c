/* SPDX-License-Identifier: MIT */
#include "app/image/compare.h"
#include "app/base/choice.h"
#include "app/base/cli.h"
#include "app/base/number.h"
#include "app/command/command.h"
#include "app/image/figure.h"
#include "app/image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct compare_arguments {
    const char *paths[2]; /* image, reference */
    const char *heat_map;
    float heat_scale, heat_percentile;
    cli_list limits; /* METRIC=VALUE */
    bool json;
    int pixels_max;
} compare_arguments;

typedef struct limit {
    compare_metric metric;
    double value;
} limit;

static bool is_exr(const char *path) {
    return image_format_of(path) == IMAGE_EXR;
}

/* Parses a limit such as "rmse=0.01". Returns false after a message. */
static bool parse_limit(const cli_command *command, const char *text, limit *wanted) {
    const size_t length = strcspn(text, "=");
    char name[16];
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    int m = 0;
    while (m < COMPARE_COUNT && strcmp(name, compare_metrics[m]) != 0)
        m++;
    if (m < COMPARE_COUNT && text[length] == '=' &&
        number_read(text + length + 1, strlen(text + length + 1), &wanted->value)) {
        wanted->metric = (compare_metric)m;
        return true;
    }
    base_error error;
    if (m == COMPARE_COUNT)
        choice_fail(&error, "--fail-above METRIC=VALUE", name, compare_metrics);
    else
        base_fail(&error, "--fail-above METRIC=VALUE", "\"%s\" is not a number",
                  text + length + (text[length] == '='));
    cli_usage(command, "%s", error.text);
    return false;
}

/* Whether the metric is within its limit; NaN never is. */
static bool within(const compare_result *result, const limit *wanted) {
    const double value = result->values[wanted->metric];
    return compare_grows_with_likeness(wanted->metric) ? value >= wanted->value
                                                       : value <= wanted->value;
}

static void print_json_number(double value) {
    if (isfinite(value))
        printf("%.9g", value);
    else
        printf(isnan(value) ? "null" : value > 0 ? "\"infinite\"" : "\"-infinite\"");
}

/* The difference that the heat map shows as white, and its origin. */
typedef struct heat_white {
    double value, percentile; /* percentile: 0 if --heatmap-scale gives the difference */
} heat_white;

static void print(const compare_arguments *arguments, const image *pixels,
                  const compare_result *result, const heat_white *white) {
    const char *space = is_exr(arguments->paths[1]) ? "linear" : "display";
    if (arguments->json) {
        printf("{ \"width\": %d, \"height\": %d, \"space\": \"%s\"", pixels->width, pixels->height,
               space);
        for (int m = 0; m < COMPARE_COUNT; m++) {
            printf(", \"%s\": ", compare_metrics[m]);
            print_json_number(result->values[m]);
        }
        if (arguments->heat_map)
            printf(", \"heatmap_white\": %.9g, \"heatmap_percentile\": %.9g", white->value,
                   white->percentile);
        printf(", \"max_pixel\": [%d, %d], \"bad_values\": %zu }\n", result->max_x, result->max_y,
               result->bad_values);
        return;
    }
    printf("%dx%d pixels, %s values\n", pixels->width, pixels->height, space);
    for (int m = 0; m < COMPARE_COUNT; m++) {
        printf("%-7s %.6g", compare_metrics[m], result->values[m]);
        if (m == COMPARE_MAX)
            printf(" at pixel %d,%d", result->max_x, result->max_y);
        printf("\n");
    }
    if (!arguments->heat_map)
        return;
    printf("heatmap black is 0, white %.6g", white->value);
    if (white->percentile > 0)
        printf(", which %g %% of the pixels do not exceed", white->percentile);
    printf("\n");
}

/* --- the heat map ----------------------------------------------------------------------------- */

/* Sizes of the legend below the map: the colors from 0 to the white difference, with numbers below
 * them. */
enum { LEGEND = 28, RAMP_TOP = 6, RAMP_BOTTOM = 14, LEGEND_MARGIN = 4, ROOM_FOR_WORDS = 320 };

/* Draws the numbers; the last tells the percentile if there is room. */
static void draw_numbers(const heat_white *white, image *legend) {
    static const double parts[] = { 0, 0.5, 1 };
    const int ramp = legend->width - 2 * LEGEND_MARGIN;
    for (int i = 0; i < 3; i++) {
        char text[48];
        const int length = snprintf(text, sizeof text, "%.3g", parts[i] * white->value);
        if (i == 2 && white->percentile > 0 && legend->width >= ROOM_FOR_WORDS)
            snprintf(text + length, sizeof text - (size_t)length, ", percentile %g",
                     white->percentile);
        const int width = FIGURE_LETTER_WIDTH * (int)strlen(text);
        const int left = LEGEND_MARGIN + (int)(parts[i] * (ramp - width));
        figure_text(legend, (figure_box) { left, RAMP_BOTTOM, width, LEGEND - RAMP_BOTTOM },
                    FIGURE_LETTER_HEIGHT, (lmp_rgb) { 1, 1, 1 }, text);
    }
}

static bool draw_legend(const heat_white *white, int width, unsigned char *rgb8,
                        base_error *error) {
    image numbers;
    if (!image_create(&numbers, width, LEGEND, error))
        return false;
    memset(numbers.rgb, 0, 3 * sizeof(float) * LEGEND * (size_t)width);
    draw_numbers(white, &numbers);
    for (size_t i = 0; i < 3 * LEGEND * (size_t)width; i++)
        rgb8[i] = numbers.rgb[i] > 0 ? 255 : 0;
    for (int y = RAMP_TOP; y < RAMP_BOTTOM; y++)
        for (int x = LEGEND_MARGIN; x < width - LEGEND_MARGIN; x++)
            compare_heat_color((x - LEGEND_MARGIN + 0.5) / (width - 2 * LEGEND_MARGIN),
                               rgb8 + 3 * ((size_t)y * (size_t)width + (size_t)x));
    image_free(&numbers);
    return true;
}

/* Chooses the white difference. A few pixels, such as the edge of a lamp, would leave all others
 * black if the largest difference were white, so a percentile is, unless it is 0. */
static bool choose_white(const compare_arguments *arguments, const image images[2],
                         heat_white *white) {
    *white = (heat_white) { (double)arguments->heat_scale, 0 };
    if (white->value > 0)
        return true;
    white->percentile = (double)arguments->heat_percentile;
    if (!compare_difference_percentile(&images[0], &images[1], white->percentile, &white->value))
        return false;
    if (white->value > 0)
        return true;
    white->percentile = 100;
    return compare_difference_percentile(&images[0], &images[1], 100, &white->value);
}

static bool write_heat_map(const compare_arguments *arguments, const image images[2],
                           heat_white *white, base_error *error) {
    const int width = images[0].width, height = images[0].height;
    const size_t row = 3 * (size_t)width;
    unsigned char *rgb8 = malloc(row * ((size_t)height + LEGEND));
    if (!rgb8 || !choose_white(arguments, images, white)) {
        free(rgb8);
        return base_fail(error, NULL, "out of memory");
    }
    compare_heat_map(&images[0], &images[1], white->value, rgb8);
    const bool ok = draw_legend(white, width, rgb8 + row * (size_t)height, error) &&
                    image_write_png8(rgb8, width, height + LEGEND, arguments->heat_map, error);
    free(rgb8);
    return ok;
}

/* --- all of it -------------------------------------------------------------------------------- */

/* Compares both images as displayed, with the exposure that suits the reference. */
static bool judge_shown(image images[2], bool linear, compare_result *result, base_error *error) {
    const image_display display = { .exposure = linear ? image_auto_exposure(&images[1]) : 1 };
    for (int i = 0; linear && i < 2; i++)
        image_show(&images[i], &display);
    return compare_shown(&images[0], &images[1], result, error);
}

/* Reads both images, compares them and prints the metrics; *status tells whether the limits
 * hold. */
static bool compare(const compare_arguments *arguments, const limit *limits, image images[2],
                    int *status, base_error *error) {
    compare_result result;
    heat_white white = { 0, 0 };
    const bool linear = is_exr(arguments->paths[1]);
    for (int i = 0; i < 2; i++) {
        if (!image_read(arguments->paths[i], arguments->pixels_max, &images[i], error))
            return false;
        if (!linear)
            compare_to_display(&images[i]);
    }
    if (!compare_images(&images[0], &images[1], linear ? 0 : 1, &result, error))
        return false;
    if (arguments->heat_map && !write_heat_map(arguments, images, &white, error))
        return false;
    if (!result.bad_values && !judge_shown(images, linear, &result, error))
        return false;
    print(arguments, &images[0], &result, &white);
    if (result.bad_values)
        return base_fail(error, NULL, "%zu values are not finite numbers, the first at pixel %d,%d",
                         result.bad_values, result.max_x, result.max_y);
    for (int i = 0; i < arguments->limits.count; i++)
        if (!within(&result, &limits[i])) {
            fprintf(stderr, "lampion: %s is %.6g, limit %g\n", compare_metrics[limits[i].metric],
                    result.values[limits[i].metric], limits[i].value);
            *status = BASE_FAILURE;
        }
    return true;
}

static int execute(const cli_command *command, const compare_arguments *a) {
    limit limits[sizeof a->limits.items / sizeof *a->limits.items];
    image images[2] = { { .rgb = NULL }, { .rgb = NULL } };
    int status = BASE_OK;
    base_error error;
    for (int i = 0; i < a->limits.count; i++)
        if (!parse_limit(command, a->limits.items[i], &limits[i]))
            return BASE_USAGE;
    if (is_exr(a->paths[0]) != is_exr(a->paths[1]))
        return cli_usage(command, "one image is linear (.exr), the other tone-mapped: compare "
                                  "two of a kind");
    if (a->heat_map && image_format_of(a->heat_map) != IMAGE_PNG)
        return cli_usage(command, "%s: --heatmap makes a .png", a->heat_map);
    if (!compare(a, limits, images, &status, &error))
        status = base_report(&error);
    for (int i = 0; i < 2; i++)
        image_free(&images[i]);
    return status;
}

static int run(const cli_command *command, int argc, char **argv) {
    compare_arguments a = { .heat_percentile = 99, .pixels_max = IMAGE_READ_PIXELS };
    const cli_option options[] = {
        { .name = "fail-above",
          .kind = CLI_LIST,
          .target = &a.limits,
          .argument = "METRIC=VALUE",
          .help =
              "exit with status 1 if rmse, relmse, max or flip is above VALUE, or psnr, ssim or "
              "shown below it; may be repeated" },
        { .name = "heatmap",
          .kind = CLI_TEXT,
          .target = &a.heat_map,
          .argument = "FILE.png",
          .help =
              "write the absolute difference as an image, black to white, with its scale below" },
        { .name = "heatmap-scale",
          .kind = CLI_FLOAT,
          .target = &a.heat_scale,
          .argument = "D",
          .help = "the difference shown as white; 0 means that of --heatmap-percentile",
          .minimum = 0,
          .maximum = 1e30 },
        { .name = "heatmap-percentile",
          .kind = CLI_FLOAT,
          .target = &a.heat_percentile,
          .argument = "P",
          .help = "show as white the difference that P percent of the pixels do not exceed",
          .minimum = 1,
          .maximum = 100 },
        { .name = "json", .kind = CLI_FLAG, .target = &a.json, .help = "print JSON" },
        { .name = "max-pixels",
          .kind = CLI_INT,
          .target = &a.pixels_max,
          .argument = "N",
          .help = "refuse larger images, which take 80 bytes per pixel",
          .minimum = 1,
          .maximum = IMAGE_PIXELS_MAX },
        { .name = NULL },
    };
    int count, status = BASE_OK;
    char **operands;
    if (!cli_parse(command, options, argc, argv, &count, &operands, &status))
        return status;
    if (count != 2)
        return cli_usage(command, "expected two images, IMAGE and REFERENCE");
    for (int i = 0; i < 2; i++)
        a.paths[i] = operands[i];
    return execute(command, &a);
}

const cli_command command_compare = {
    .name = "compare",
    .operands = "IMAGE REFERENCE",
    .summary = "say how far an image is from a reference",
    .examples = "lampion compare atrium.exr truth.exr\n"
                "lampion compare a.png b.png --heatmap difference.png --fail-above max=0.01\n",
    .run = run,
};
