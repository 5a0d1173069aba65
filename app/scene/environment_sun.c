/* SPDX-License-Identifier: MIT */
/* environment_sun.c - the bright parts of a latitude-longitude image, as caps: a few bands of a sun
 * that is 1e5 times as bright as its sky ring all over the sphere, whereas a cap is exact and casts
 * shadows.
 *
 * A pixel is bright if it is far above the mean of the pixels that are not. Bright pixels that
 * touch form a part. Among the parts that are small and give much of the light, the largest become
 * caps of the same direction, solid angle and irradiance; in the image they are replaced by their
 * surroundings. */
#include "app/image/srgb.h"
#include "app/scene/environment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

#define BRIGHT     50.0 /* times the mean of the rest */
#define FLUX_LEAST 0.02 /* fraction of all light that a part gives at least */
#define SOLID_MOST 0.06 /* of a cap, steradians: a half angle of 8 degrees */
#define ROUNDS     20   /* iterations of the mean of what is not bright */

/* A connected set of bright pixels. */
typedef struct part {
    double solid, weight, squares; /* sums of solid angles, times luminance, times its square */
    double flux[3], axis[3];       /* sums of color, and of direction weighted by luminance */
    double around[3];              /* of the neighboring pixels */
    int beside;
} part;

typedef struct parts {
    const image *map;
    unsigned char *state; /* of each pixel: 0, not bright; 1, bright; 2, bright and in a part */
    size_t *stack;
} parts;

static double solid_angle(const image *map, int row) {
    return (cos(pi * row / map->height) - cos(pi * (row + 1) / map->height)) * 2 * pi / map->width;
}

static const float *pixel_at(const image *map, size_t i) {
    return map->rgb + 3 * i;
}

/* Sums the light and the solid angle of the pixels below a luminance. */
static void sum_below(const image *map, double threshold, double *light, double *solid) {
    *light = *solid = 0;
    for (int row = 0; row < map->height; row++) {
        const float *rgb = map->rgb + 3 * (size_t)row * (size_t)map->width;
        double sum = 0;
        int count = 0;
        for (int x = 0; x < map->width; x++) {
            const double y = image_luminance(rgb + 3 * x);
            sum += y < threshold ? y : 0;
            count += y < threshold;
        }
        *light += sum * solid_angle(map, row);
        *solid += count * solid_angle(map, row);
    }
}

/* Finds the luminance from which a pixel is bright; `all` receives the sum of all light. */
static double find_threshold(const image *map, double *all) {
    double threshold = (double)INFINITY, light, solid;
    sum_below(map, threshold, all, &solid);
    light = *all;
    for (int round = 0; round < ROUNDS && solid > 0; round++) {
        const double next = BRIGHT * light / solid;
        if (!(next < threshold))
            break;
        threshold = next;
        sum_below(map, threshold, &light, &solid);
    }
    return threshold;
}

/* Computes the direction of a pixel's center, as lmp_latlong does. */
static void direction_of(const environment *e, size_t i, double w[3]) {
    const image *map = &e->light;
    const double theta = pi * ((double)(i / (size_t)map->width) + 0.5) / map->height;
    const double phi =
        2 * pi * (((double)(i % (size_t)map->width) + 0.5) / map->width - 0.5) + (double)e->azimuth;
    w[0] = sin(theta) * cos(phi);
    w[1] = cos(theta);
    w[2] = sin(theta) * sin(phi);
}

static void add_pixel(const environment *e, size_t i, part *to) {
    const float *rgb = pixel_at(&e->light, i);
    const double each = solid_angle(&e->light, (int)(i / (size_t)e->light.width));
    const double y = image_luminance(rgb);
    double w[3];
    direction_of(e, i, w);
    to->solid += each;
    to->weight += each * y;
    to->squares += each * y * y;
    for (int k = 0; k < 3; k++) {
        to->flux[k] += each * (double)rgb[k];
        to->axis[k] += each * y * w[k];
    }
}

/* Collects the part that pixel `first` belongs to: its pixels go to state 2 and onto the stack.
 * Returns how many there are. */
static size_t visit_part(const environment *e, const parts *p, size_t first, part *found) {
    const image *map = p->map;
    const long width = map->width, height = map->height;
    size_t count = 1;
    *found = (part) { 0 };
    p->stack[0] = first;
    p->state[first] = 2;
    for (size_t next = 0; next < count; next++) {
        const long x = (long)(p->stack[next] % (size_t)width), y = (long)p->stack[next] / width;
        add_pixel(e, p->stack[next], found);
        for (long k = 0; k < 9; k++) {
            const long column = (x + k % 3 - 1 + width) % width, row = y + k / 3 - 1;
            const size_t beside = (size_t)(row * width + column);
            if (row < 0 || row >= height)
                continue;
            if (p->state[beside] == 1) {
                p->state[beside] = 2;
                p->stack[count++] = beside;
            } else if (p->state[beside] == 0) {
                for (int c = 0; c < 3; c++)
                    found->around[c] += (double)pixel_at(map, beside)[c];
                found->beside++;
            }
        }
    }
    return count;
}

/* Returns the solid angle of the cap; a blurred edge counts less than the middle. */
static double cap_solid(const part *from) {
    return from->weight * from->weight / from->squares;
}

/* Makes the cap of a part; what remains in the image is subtracted from the cap's light. */
static scene_light cap_of(const part *from) {
    const double solid = cap_solid(from), z = 1 - solid / (2 * pi);
    const double length = sqrt(from->axis[0] * from->axis[0] + from->axis[1] * from->axis[1] +
                               from->axis[2] * from->axis[2]);
    scene_light light = { .emitter = { .kind = LMP_LIGHT_CAP, .angle = (float)acos(z) },
                          .hidden = 1 };
    light.emitter.direction =
        (lmp_vec3) { (float)(from->axis[0] / length), (float)(from->axis[1] / length),
                     (float)(from->axis[2] / length) };
    float *radiance = &light.emitter.radiance.r;
    for (int c = 0; c < 3; c++) {
        const double left = from->solid * from->around[c] / fmax(from->beside, 1);
        radiance[c] = (float)(fmax(from->flux[c] - left, 0) / (pi * (1 - z * z)));
    }
    return light;
}

static void take_part(environment *e, const parts *p, size_t count, const part *found) {
    e->suns[e->sun_count++] = cap_of(found);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            e->light.rgb[3 * p->stack[i] + (size_t)c] =
                (float)(found->around[c] / fmax(found->beside, 1));
}

static void find_suns(environment *e, const parts *p, size_t size) {
    double all = 0;
    const double threshold = find_threshold(p->map, &all);
    for (size_t i = 0; i < size; i++)
        p->state[i] = image_luminance(pixel_at(p->map, i)) >= threshold;
    for (size_t i = 0; i < size && e->sun_count < ENVIRONMENT_SUNS_MAX; i++) {
        part found;
        if (p->state[i] != 1)
            continue;
        const size_t count = visit_part(e, p, i, &found);
        if (found.weight >= FLUX_LEAST * all && cap_solid(&found) <= SOLID_MOST)
            take_part(e, p, count, &found);
    }
}

bool environment_extract_suns(environment *e, base_error *error) {
    const size_t size = (size_t)e->light.width * (size_t)e->light.height;
    e->sun_count = 0;
    if (!environment_shines(e) || e->studio)
        return true;
    parts p = { .map = &e->light, .state = malloc(size), .stack = malloc(size * sizeof *p.stack) };
    image own;
    bool ok = p.state && p.stack && image_create(&own, e->light.width, e->light.height, error);
    if (ok) {
        memcpy(own.rgb, e->light.rgb, 3 * size * sizeof *own.rgb);
        if (e->backdrop.rgb != e->light.rgb)
            image_free(&e->light);
        e->light = own;
        find_suns(e, &p, size);
    } else if (!p.state || !p.stack) {
        ok = base_fail(error, NULL, "out of memory");
    }
    free(p.state);
    free(p.stack);
    return ok;
}

size_t environment_add_suns(const environment *e, scene_light *lights, size_t count) {
    for (int i = 0; i < e->sun_count && count < SCENE_LIGHTS_MAX; i++)
        lights[count++] = e->suns[i];
    return count;
}
