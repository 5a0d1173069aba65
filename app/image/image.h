/* SPDX-License-Identifier: MIT */
/* image.h - images: linear RGB in float, written as OpenEXR or tone-mapped to PNG. */
#ifndef LAMPION_IMAGE_H
#define LAMPION_IMAGE_H

#include "app/cli/cli.h"

/* Rows from the top, tightly packed, linear RGB. */
typedef struct image {
    int width, height;
    float *rgb; /* 3 * width * height, malloc'ed */
} image;

#define IMAGE_SIZE_MAX   16384     /* pixels a side */
#define IMAGE_PIXELS_MAX (1 << 26) /* of an image */

bool image_create(image *image, int width, int height, cli_error *error);
void image_free(image *image);

/* The exposure (a factor on radiance) that maps the log-average of what is lit to middle gray:
 * the darkest and brightest twentieth, and pixels 8 stops darker than these, do not count: the tail
 * of a sharp lobe is as good as black. 1 for a black image. */
float image_auto_exposure(const image *image);

/* The factor that an exposure of `stops` EV means: 2^stops. */
float image_exposure_of_stops(float stops);

/* The filmic curve of shaders/shared.h and the sRGB transfer to 8 bits: rgb8 receives 3 * width *
 * height bytes. */
void image_tone_map(const image *image, float exposure, unsigned char *rgb8);

/* Writes by the extension of path: .png (tone-mapped with exposure) or .exr (linear, unexposed). */
bool image_write(const image *image, const char *path, float exposure, cli_error *error);

/* By the extension of path, whatever its case. */
typedef enum image_format { IMAGE_UNKNOWN, IMAGE_PNG, IMAGE_EXR } image_format;
image_format image_format_of(const char *path);

/* The same for a drawing, whose colors (0 … 1) are meant to be seen as they are: no exposure and
 * no filmic curve. */
bool image_write_figure(const image *image, const char *path, cli_error *error);

/* True if image_write will know what to do with path and its folder can be written: ask before the
 * long work. */
bool image_check_path(const char *path, cli_error *error);

/* A named image of an OpenEXR file: channels NAME.R, NAME.G, NAME.B, or R, G, B without name. */
typedef struct image_layer {
    const char *name; /* NULL or "": the main image */
    const image *image;
} image_layer;

/* Writes 1 … IMAGE_LAYERS_MAX layers of one size into one .exr, 32-bit float. */
#define IMAGE_LAYERS_MAX 8
bool image_write_exr_layers(const char *path, const image_layer *layers, int count,
                            cli_error *error);

/* Writes 8-bit RGB as PNG. */
bool image_write_png8(const unsigned char *rgb8, int width, int height, const char *path,
                      cli_error *error);

/* The same with a text chunk (iTXt, UTF-8, compressed), and the text of such a file: the first of
 * that key, at most IMAGE_TEXT_MAX bytes, to be freed. */
#define IMAGE_TEXT_MAX (1 << 22)
typedef struct image_text {
    const char *key, *text;
} image_text;
bool image_write_png8_text(const unsigned char *rgb8, int width, int height, const image_text *text,
                           const char *path, cli_error *error);
bool image_read_png_text(const char *path, const char *key, char **text, cli_error *error);

/* Reads a .exr (R, G, B channels; linear) or an 8-bit .png (sRGB,
 * linearized). */
bool image_read(const char *path, image *image, cli_error *error);

#endif
