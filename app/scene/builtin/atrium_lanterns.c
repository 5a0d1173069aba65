/* SPDX-License-Identifier: MIT */
/* atrium_lanterns.c - paper lanterns around sphere lights, and strings of small ones. */
#include "app/scene/builtin/atrium.h"

#include "app/scene/random.h"
#include "app/scene/vector.h"

#include <math.h>

/* Adds a round paper lantern: bamboo rings, two collars and a cord around a glowing sphere. */
static void put_lantern(court_plan *court, lmp_vec3 center, float radius, float ceiling) {
    scene_shaper *shaper = &court->shaper;
    const shape_point top[] = { { 0.36f * radius, 0.93f * radius },
                                { 0.36f * radius, 1.06f * radius },
                                { 0.28f * radius, 1.12f * radius },
                                { 0.06f * radius, 1.18f * radius } };
    const shape_point bottom[] = { { 0.0f, -1.24f * radius },
                                   { 0.06f * radius, -1.16f * radius },
                                   { 0.28f * radius, -1.10f * radius },
                                   { 0.34f * radius, -1.04f * radius },
                                   { 0.34f * radius, -0.94f * radius } };
    const shape_point cord[] = { { 0.010f, 1.1f * radius }, { 0.010f, ceiling - center.y } };
    shaper->material = BRONZE;
    atrium_revolve(shaper, top, sizeof top / sizeof *top, center, 24);
    atrium_revolve(shaper, bottom, sizeof bottom / sizeof *bottom, center, 24);
    atrium_revolve(shaper, cord, 2, center, 6);
    enum { RINGS = 7 };
    for (int i = 0; i < RINGS; i++) {
        const float height = 0.78f * radius * (2.0f * (float)i / (RINGS - 1) - 1.0f);
        const float wide = 1.004f * sqrtf(radius * radius - height * height);
        const shape_point ring[] = { { wide, height - 0.009f * radius },
                                     { wide + 0.012f * radius, height },
                                     { wide, height + 0.009f * radius } };
        atrium_revolve(shaper, ring, 3, center, 32);
    }
}

static void add_light(court_plan *court, lmp_vec3 center, float radius, float power,
                      float warm_fraction) {
    const lmp_rgb color = builtin_light_color(&court->random, warm_fraction);
    builder_sphere_light(court->shaper.builder, center, radius, color, power);
}

/* Hangs one lantern over the court: along its length, left, middle, right, at changing heights. */
static void hang_in_court(court_plan *court, int number, int count) {
    uint64_t *random = &court->random;
    const float t = ((float)number + 0.5f) / (float)count;
    const float z = (court->half_length - 1.5f) * (1.0f - 2.0f * t);
    const float x = (float)(number % 3 - 1) * 2.2f + random_between(random, -0.6f, 0.6f);
    const float along = z + random_between(random, -0.3f, 0.3f);
    const lmp_vec3 center = vec(x, random_between(random, 4.6f, 8.4f), along);
    const float radius = random_between(random, 0.24f, 0.38f), r = HALF_WIDTH - 0.1f;
    put_lantern(court, center, radius, CORNICE + sqrtf(r * r - x * x));
    add_light(court, center, radius, 230.0f, 0.85f);
}

/* Hangs one lantern in a bay of an aisle, on either storey; consecutive lanterns are far apart. */
static void hang_in_aisle(court_plan *court, int number) {
    uint64_t *random = &court->random;
    const int bay = (int)(67u * (unsigned)number % (4u * (unsigned)court->bays));
    const storey_plan *s = bay & 1 ? &atrium_upper : &atrium_lower;
    const float side = bay & 2 ? 1.0f : -1.0f;
    const float z = BAY * ((float)(bay / 4) - 0.5f * (float)(court->bays - 1));
    const float along = z + random_between(random, -0.3f, 0.3f);
    const float below = random_between(random, 0.2f, 0.9f);
    const float out = HALF_WIDTH + 1.6f + random_between(random, -0.2f, 0.2f);
    const lmp_vec3 center = vec(side * out, s->springing - below, along);
    const float radius = random_between(random, 0.17f, 0.26f);
    put_lantern(court, center, radius, s->springing + atrium_vault_rise(s));
    add_light(court, center, radius, 190.0f, 0.25f);
}

/* --- strings ---------------------------------------------------------------------------------- */

/* How many large lanterns hang alone, and how many beside strings: more would collide, so the rest
 * are small ones on strings. */
enum { LARGE_ALONE = 200, LARGE_BESIDE = 30 };

/* Strings cross the court in layers, and sag. */
enum { STRING_LANTERNS = 32, LAYERS = 5 };

static void put_small_lantern(court_plan *court, lmp_vec3 center, float radius) {
    const shape_point cap[] = { { 0.5f * radius, 0.9f * radius },
                                { 0.3f * radius, 1.2f * radius },
                                { 0.01f, 1.5f * radius } };
    court->shaper.material = BRONZE;
    atrium_revolve(&court->shaper, cap, sizeof cap / sizeof *cap, center, 8);
    add_light(court, center, radius, 8.0f, 0.85f);
}

static void hang_string(court_plan *court, int number, int strings, int count) {
    uint64_t *random = &court->random;
    const float t = ((float)number + 0.5f) / (float)strings;
    const float z = (court->half_length - 0.6f) * (1.0f - 2.0f * t);
    const float high = 5.0f + 0.9f * (float)(number % LAYERS);
    const float sag = random_between(random, 0.5f, 0.7f), half = HALF_WIDTH - 0.5f;
    for (int i = 0; i < count; i++) {
        const float u = 2.0f * ((float)i + 0.5f) / STRING_LANTERNS - 1.0f;
        const float radius = random_between(random, 0.03f, 0.05f);
        put_small_lantern(court, vec(half * u, high - sag * (1.0f - u * u), z), radius);
    }
}

static void hang_strings(court_plan *court, int count) {
    const int strings = (count + STRING_LANTERNS - 1) / STRING_LANTERNS;
    for (int i = 0; i < strings; i++) {
        const int left = count - i * STRING_LANTERNS;
        hang_string(court, i, strings, left < STRING_LANTERNS ? left : STRING_LANTERNS);
    }
}

/* --- all -------------------------------------------------------------------------------------- */

static void hang_large(court_plan *court, int count) {
    const int over_court = (2 * count + 4) / 5;
    for (int i = 0; i < over_court; i++)
        hang_in_court(court, i, over_court);
    for (int i = over_court; i < count; i++)
        hang_in_aisle(court, i - over_court);
}

void atrium_hang_lanterns(court_plan *court, int count) {
    const int large = count > LARGE_ALONE ? LARGE_BESIDE : count;
    hang_large(court, large);
    hang_strings(court, count - large);
}
