/* SPDX-License-Identifier: MIT */
#include "ruler/configuration.h"

#include <stdint.h>
#include <stdlib.h>

const char *const ruler_light_names[RULER_LIGHTS] = { "sphere", "sun", "hemisphere", "point",
                                                      "spot" };
const char *const ruler_material_names[RULER_MATERIALS] = { "lambert", "phong", "metal",
                                                            "dielectric" };

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof *(array)))

/* Sizes of lights, each with about how many degrees the light covers on each side. */
typedef struct light_size {
    int size, degrees;
} light_size;
static const light_size spheres[] = {
    { 1, 0 },    { 3, 0 },    { 10, 1 },   { 30, 2 },    { 100, 6 },   { 200, 12 },
    { 300, 17 }, { 400, 24 }, { 500, 30 }, { 600, 37 },  { 700, 44 },  { 800, 53 },
    { 900, 64 }, { 970, 76 }, { 999, 87 }, { 1000, 90 }, { 1500, 90 },
};
static const light_size suns[] = {
    { 270, 0 },    { 1000, 1 },   { 5000, 5 },   { 15000, 15 },  { 30000, 30 },  { 45000, 45 },
    { 60000, 60 }, { 75000, 75 }, { 90000, 90 }, { 110000, 90 }, { 140000, 90 },
};
static const light_size hemispheres[] = { { 0, 90 } };
static const light_size points[] = { { 0, 0 } };
static const light_size spots[] = {
    { 0, 0 }, { 15000, 0 }, { 22500, 0 }, { 30000, 0 }, { 37500, 0 },
};

/* Kinds of lights, with how many of 20 lights are of that kind. */
static const struct {
    ruler_light light;
    int weight, count;
    const light_size *sizes;
} kinds[] = {
    { RULER_SPHERE, 13, COUNT_OF(spheres), spheres },
    { RULER_SUN, 3, COUNT_OF(suns), suns },
    { RULER_HEMISPHERE, 1, COUNT_OF(hemispheres), hemispheres },
    { RULER_POINT, 2, COUNT_OF(points), points },
    { RULER_SPOT, 1, COUNT_OF(spots), spots },
};
#define WEIGHTS 20

static const int roughnesses[] = {
    173, 200, 225, 250, 300, 350, 400, 500, 600, 700, 800, 900, 1000
};
static const int exponents[] = { 1, 2, 5, 10, 30, 100, 300, 1000, 3000, 10000 };
static const int colors[] = { 100, 70, 30 };

static const int sequence_counts[RULER_MATERIALS] = {
    [RULER_LAMBERT] = 400, [RULER_PHONG] = 900, [RULER_METAL] = 910, [RULER_DIELECTRIC] = 910
};

/* Computes element n of the additive recurrence in five dimensions (Roberts 2018), in units of
 * 2^-32. */
#define DIMENSIONS 5
enum { OF_LIGHT, OF_ANGLE, OF_AZIMUTH, OF_VIEW, OF_AIM };
static void sequence_at(int n, uint32_t u[DIMENSIONS]) {
    static const uint32_t steps[DIMENSIONS] = { 0xe19b01aau, 0xc6d1d6c8u, 0xaf36d01eu, 0x9a69443fu,
                                                0x881403b9u };
    for (int k = 0; k < DIMENSIONS; k++)
        u[k] = 0x80000000u + (uint32_t)n * steps[k];
}

/* Map u to an integer 0 … count - 1, and to one from -reach to reach, dense in the middle. */
static int to_range(uint32_t u, int count) {
    return (int)(((uint64_t)u * (uint64_t)count) >> 32);
}
static int to_middle(uint32_t u, int reach) {
    const int64_t v = (int64_t)(u >> 12) - (1 << 19); /* 20 bits and a sign */
    return (int)(v * v * v / (1 << 19) * reach / ((int64_t)1 << 38));
}

static const light_size *choose_light(uint32_t u, ruler_light *light) {
    uint64_t at = (uint64_t)u * WEIGHTS; /* the integer part is a position among the weights */
    int k = 0;
    for (; at >> 32 >= (uint64_t)kinds[k].weight; k++)
        at -= (uint64_t)kinds[k].weight << 32;
    *light = kinds[k].light;
    return &kinds[k].sizes[at / (uint64_t)kinds[k].weight * (uint64_t)kinds[k].count >> 32];
}

/* Aims a light: of four lights two are near the mirror direction, one is where the horizon cuts it,
 * and one is anywhere above the horizon or a little below. */
static void aim(ruler_configuration *c, const uint32_t u[DIMENSIONS], int degrees) {
    const int where = to_range(u[OF_AIM], 4);
    if (where < 2) {
        c->light_angle = abs(c->view_angle + to_middle(u[OF_ANGLE], 4000));
        c->light_azimuth = abs(to_middle(u[OF_AZIMUTH], 9000));
        return;
    }
    c->light_angle = where == 2 ? 9000 - 100 * degrees + to_range(u[OF_ANGLE], 200 * degrees + 1)
                                : to_range(u[OF_ANGLE], 9000 + 50 * degrees);
    c->light_azimuth = to_range(u[OF_AZIMUTH], 18001);
}

static ruler_configuration of_sequence(ruler_material material, int n) {
    ruler_configuration c = { .material = material, .color = 100 };
    uint32_t u[DIMENSIONS];
    sequence_at(n, u);
    c.view_angle = to_range(u[OF_VIEW], 8901);
    const light_size *const size = choose_light(u[OF_LIGHT], &c.light);
    c.size = size->size;
    aim(&c, u, size->degrees);
    if (material == RULER_PHONG)
        c.exponent = exponents[n % COUNT_OF(exponents)];
    if (material >= RULER_METAL) {
        c.roughness = roughnesses[n % COUNT_OF(roughnesses)];
        c.color = colors[n / COUNT_OF(roughnesses) % COUNT_OF(colors)];
    }
    return c;
}

/* --- corners, each with every material -------------------------------------------------------- */

typedef struct corner {
    ruler_light light;
    int size, light_angle, light_azimuth, view_angle;
} corner;
static const corner corners[] = {
    { RULER_SPHERE, 1, 4500, 0, 4500 },       /* tiny, in the mirror direction */
    { RULER_SPHERE, 100, 0, 0, 0 },           /* everything along the normal */
    { RULER_SPHERE, 300, 8900, 0, 8900 },     /* grazing, cut by the horizon */
    { RULER_SPHERE, 500, 9000, 0, 5500 },     /* half below the horizon */
    { RULER_SPHERE, 500, 11900, 0, 8000 },    /* a degree above it */
    { RULER_SPHERE, 500, 12100, 0, 4500 },    /* wholly below it */
    { RULER_SPHERE, 999, 1000, 18000, 3000 }, /* nearly touching, behind the viewer */
    { RULER_SPHERE, 1000, 3000, 9000, 6000 }, /* touching */
    { RULER_SPHERE, 1500, 0, 0, 7500 },       /* inside */
    { RULER_SUN, 270, 8950, 0, 8900 },        /* the sun as it sets */
};
static const int corner_exponents[] = { 1, 100, 10000 },
                 corner_roughnesses[] = { 173, 300, 600, 1000 };

/* Sets one material of the corners, in the order lambert, phong …, metal …, dielectric … */
#define CORNER_MATERIALS (1 + COUNT_OF(corner_exponents) + 2 * COUNT_OF(corner_roughnesses))
static void set_corner_material(ruler_configuration *c, int k) {
    c->color = 100;
    if (k == 0) {
        c->material = RULER_LAMBERT;
        return;
    }
    k -= 1;
    if (k < COUNT_OF(corner_exponents)) {
        c->material = RULER_PHONG;
        c->exponent = corner_exponents[k];
        return;
    }
    k -= COUNT_OF(corner_exponents);
    c->material = k % 2 ? RULER_DIELECTRIC : RULER_METAL;
    c->color = 70;
    c->roughness = corner_roughnesses[k / 2];
}

static ruler_configuration of_corner(int k) {
    const corner *const at = &corners[k / CORNER_MATERIALS];
    ruler_configuration c = { .light = at->light,
                              .size = at->size,
                              .light_angle = at->light_angle,
                              .light_azimuth = at->light_azimuth,
                              .view_angle = at->view_angle };
    set_corner_material(&c, k % CORNER_MATERIALS);
    return c;
}

int ruler_configuration_count(void) {
    int count = COUNT_OF(corners) * CORNER_MATERIALS;
    for (int m = 0; m < RULER_MATERIALS; m++)
        count += sequence_counts[m];
    return count;
}

ruler_configuration ruler_configuration_at(int id) {
    int k = id - 1, m = 0;
    for (; m < RULER_MATERIALS && k >= sequence_counts[m]; m++)
        k -= sequence_counts[m];
    ruler_configuration c = m < RULER_MATERIALS ? of_sequence((ruler_material)m, k) : of_corner(k);
    c.id = id;
    return c;
}

/* Prints an integer in units of 10^-digits, without trailing zeros. */
static void print_decimal(FILE *stream, int value, int digits) {
    int unit = 1;
    for (int i = 0; i < digits; i++)
        unit *= 10;
    fprintf(stream, ",%d", value / unit);
    for (int rest = value % unit, dot = 1; rest; rest = rest * 10 % unit, dot = 0)
        fprintf(stream, dot ? ".%d" : "%d", rest * 10 / unit);
}

void ruler_configuration_print(FILE *stream, const ruler_configuration *c) {
    fprintf(stream, "%d,%s", c->id, ruler_light_names[c->light]);
    print_decimal(stream, c->size, 3);
    print_decimal(stream, c->light_angle, 2);
    print_decimal(stream, c->light_azimuth, 2);
    print_decimal(stream, c->view_angle, 2);
    fprintf(stream, ",%s", ruler_material_names[c->material]);
    print_decimal(stream, c->color, 2);
    print_decimal(stream, c->roughness, 3);
    fprintf(stream, ",%d", c->exponent);
}
