/* SPDX-License-Identifier: MIT */
/* tone.h - exposure, and what a display shows. */
#ifndef LAMPION_IMAGE_TONE_H
#define LAMPION_IMAGE_TONE_H

#include "app/image/pixels.h"

/* What is lit in an image: radiance above 0. */
typedef struct image_lit {
    float part;      /* of all pixels */
    float average;   /* of the logarithm of what counts for exposure; 0: nothing does */
    float brightest; /* the brightest twentieth is above */
} image_lit;
image_lit image_measure_lit(const image *image);

/* The exposure (a factor on radiance) that maps the log-average of what is lit to middle gray, or
 * less, so that the brightest twentieth alone is above 1.5, where the filmic curve ends. That, the
 * darkest twentieth, and pixels 6 stops darker than it do not count: the tail of a specular lobe is
 * as good as black. 1 for a black image. */
float image_auto_exposure(const image *image);

/* The factor that an exposure of `stops` EV means: 2^stops. */
float image_exposure_of_stops(float stops);

/* The channels of some pixels side by side. */
enum { IMAGE_TONE_RUN = 64 };
typedef float image_tone_run[3][IMAGE_TONE_RUN];

/* A tone curve: `apply` takes exposed linear RGB to what is displayed of it, in place, `function`
 * is the same in shaders/tone.h. The first row is the default. */
typedef struct image_tone_row {
    const char *name, *help;
    void (*apply)(image_tone_run rgb);
    const char *function;
} image_tone_row;

#define IMAGE_TONES_MAX 8
extern const image_tone_row image_tones[]; /* ended by a row of NULLs */

/* The names of the rows, NULL-terminated, and the help of the option that chooses among them. */
const char *const *image_tone_names(void);
const char *image_tone_help(void);

/* The rows of the options that say how radiance is shown. */
#define IMAGE_DISPLAY_OPTION_ROWS(exposure, given, stops, tone)                                    \
    { "exposure", 0,    CLI_FLOAT, &(exposure), "FACTOR", "of radiance; without it, automatic",    \
      1e-12,      1e12, NULL,      &(given) },                                                     \
        { "ev", 0,  CLI_FLOAT, &(stops), "STOPS", "brighter or darker by so many stops",           \
          -32,  32, NULL,      NULL },                                                             \
    {                                                                                              \
        "tone", 0, CLI_CHOICE, &(tone), "CURVE", image_tone_help(), 0, 0, image_tone_names(), NULL \
    }

/* How radiance is shown. */
typedef struct image_display {
    float exposure; /* a factor */
    int tone;       /* a row of image_tones */
} image_display;

/* Exposure, tone curve and the sRGB transfer to 8 bits: rgb8 receives 3 * width * height bytes. */
void image_tone_map(const image *image, const image_display *display, unsigned char *rgb8);

/* The same in place and in float, 0 … 1. */
void image_show(image *image, const image_display *display);

/* The sRGB transfer alone. */
void image_encode(const image *image, unsigned char *rgb8);

#endif
