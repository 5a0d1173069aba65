/* SPDX-License-Identifier: MIT */
/* environment_studio.c - a room for a first image: a hemisphere that brightens upward and three
 * soft boxes, with radiances for an exposure of 1. */
#include "app/scene/environment.h"

#include <math.h>

enum { WIDTH = 256, HEIGHT = WIDTH / 2 };
static const float pi = 3.14159265f;
#define PAPER_UP 4.0f /* elevation where the paper is brightest, degrees */

/* A soft box: its middle, from the front to the right and up, its half sizes and the width of its
 * soft edge, in degrees. */
typedef struct soft_box {
    float right, up, width, height, edge;
    lmp_rgb radiance;
} soft_box;

static const soft_box boxes[] = {
    { -42, 38, 20, 15, 6, { 4.6f, 4.3f, 3.8f } },    /* key light */
    { 62, 12, 16, 32, 10, { 1.05f, 1.12f, 1.25f } }, /* fill light */
    { 152, 42, 22, 12, 6, { 3.3f, 3.4f, 3.6f } },    /* rim light */
};

static float between(float a, float b, float t) {
    return a + (b - a) * t;
}

/* Returns 1 inside, 0 outside, with a smooth step over the edge. */
static float inside(float off, float half_size, float edge) {
    const float t = fminf(fmaxf((half_size + edge - fabsf(off)) / edge, 0), 1);
    return t * t * (3 - 2 * t);
}

/* Returns the radiance of the hemisphere and its floor by the sine of the elevation, -1 … 1. */
static float hemisphere(float sine) {
    return sine < 0 ? between(0.27f, 0.1f, sqrtf(-sine)) : between(0.27f, 0.6f, sine);
}

static lmp_rgb radiance_at(float right, float up) {
    const float base = hemisphere(sinf(up * pi / 180));
    lmp_rgb sum = { base, base, base };
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        const soft_box *box = &boxes[i];
        const float around = remainderf(right - box->right, 360) * cosf(up * pi / 180);
        const float part =
            inside(around, box->width, box->edge) * inside(up - box->up, box->height, box->edge);
        sum.r += part * box->radiance.r;
        sum.g += part * box->radiance.g;
        sum.b += part * box->radiance.b;
    }
    return sum;
}

static float bell(float off, float width) {
    const double part = (double)(off / width);
    return (float)exp(-part * part);
}

/* Returns the backdrop's radiance: not the lamps, but a photographer's roll of gray paper, lit
 * behind the subject and darker toward the floor before it, the ceiling and the sides. */
static lmp_rgb paper_at(float right, float up) {
    const float behind = remainderf(right - 180, 360);
    const float level = up < PAPER_UP ? 0.07f + 0.36f * bell(up - PAPER_UP, 30)
                                      : 0.2f + 0.23f * bell(up - PAPER_UP, 45);
    const float gray = level * (0.5f + 0.5f * bell(behind, 50));
    return (lmp_rgb) { 0.98f * gray, gray, 1.03f * gray };
}

/* Fills a map with radiance_at or paper_at of every direction. */
static void paint(lmp_rgb (*radiance_of)(float right, float up), image *map) {
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            /* columns run from +x toward +z, which is leftward for someone who faces the front */
            const float right = 180 - 360 * ((float)x + 0.5f) / WIDTH;
            const float up = 90 - 180 * ((float)y + 0.5f) / HEIGHT;
            const lmp_rgb radiance = radiance_of(right, up);
            float *pixel = map->rgb + 3 * (y * WIDTH + x);
            pixel[0] = radiance.r, pixel[1] = radiance.g, pixel[2] = radiance.b;
        }
}

bool environment_make_studio(environment *e, base_error *error) {
    if (!image_create(&e->light, WIDTH, HEIGHT, error) ||
        !image_create(&e->backdrop, WIDTH, HEIGHT, error))
        return false;
    paint(radiance_at, &e->light);
    paint(paper_at, &e->backdrop);
    return true;
}
