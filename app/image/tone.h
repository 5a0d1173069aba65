/* SPDX-License-Identifier: MIT */
/* tone.h - exposure, and the mapping to a display. */
#ifndef LAMPION_IMAGE_TONE_H
#define LAMPION_IMAGE_TONE_H

#include "app/base/cli.h"
#include "app/image/pixels.h"

/* The lit part of an image: radiance above 0. */
typedef struct image_lit {
    float part;      /* of all pixels */
    float average;   /* log-average of what counts for exposure; 0: nothing does */
    float brightest; /* lower bound of the brightest twentieth */
} image_lit;
image_lit image_measure_lit(const image *image);

/* Returns the exposure (a factor on radiance) that maps the log-average of what is lit to middle
 * gray, or a lower one for which only the brightest twentieth is above 1.5, where the filmic curve
 * ends. The average excludes the brightest and the darkest twentieth, and pixels more than 6 stops
 * darker than the brightest twentieth: the tail of a specular lobe is as good as black. Returns 1
 * for a black image. */
float image_auto_exposure(const image *image);

/* Returns the factor that an exposure of `stops` EV means: 2^stops. */
float image_exposure_of_stops(float stops);

/* The channels of up to IMAGE_TONE_RUN pixels side by side. */
enum { IMAGE_TONE_RUN = 64 };
typedef float image_tone_run[3][IMAGE_TONE_RUN];

/* A tone curve: `apply` maps exposed linear RGB to displayed values, in place; `function` is the
 * same in shaders/program/tone.h. The first row is the default. */
typedef struct image_tone_row {
    const char *name, *help;
    void (*apply)(image_tone_run rgb);
    const char *function;
} image_tone_row;

#define IMAGE_TONES_MAX 8
extern const image_tone_row image_tones[]; /* ended by a row of NULLs */

/* Returns the names of the rows, NULL-terminated; image_tone_help returns the help of the option
 * that chooses among them. */
const char *const *image_tone_names(void);
const char *image_tone_help(void);

/* The option rows for how radiance is displayed. */
#define IMAGE_DISPLAY_OPTION_ROWS(exposure, given, stops, tone)                                    \
    { "exposure",  0,        CLI_FLOAT,                                                            \
      &(exposure), "FACTOR", "multiplies radiance; automatic without it",                          \
      1e-12,       1e12,     NULL,                                                                 \
      &(given) },                                                                                  \
        { "ev", 0,  CLI_FLOAT, &(stops), "STOPS", "brighter or darker by so many stops",           \
          -32,  32, NULL,      NULL },                                                             \
    {                                                                                              \
        "tone", 0, CLI_CHOICE, &(tone), "CURVE", image_tone_help(), 0, 0, image_tone_names(), NULL \
    }

/* How radiance is displayed. */
typedef struct image_display {
    float exposure; /* a factor on radiance */
    int tone;       /* a row of image_tones */
} image_display;

/* Applies exposure, tone curve and sRGB's transfer to 8 bits: rgb8 receives 3 * width * height
 * bytes. */
void image_tone_map(const image *image, const image_display *display, unsigned char *rgb8);

/* Applies exposure and tone curve in place, in float, 0 … 1. */
void image_show(image *image, const image_display *display);

/* Applies sRGB's transfer alone. */
void image_encode(const image *image, unsigned char *rgb8);

#endif
