/* SPDX-License-Identifier: MIT */
/* light.h - a light of a scene: what kinds there are, what each of them has, and all that as JSON
 * (docs/lights.md). One table of kinds decides what is read, written, checked and moved. */
#ifndef LAMPION_SCENE_LIGHT_H
#define LAMPION_SCENE_LIGHT_H

#include <lampion/light.h>

#include <stdbool.h>

/* No color of a light or of an emissive material is above this, whoever reads it: sums over all
 * lights and what materials make of them stay finite, as the library promises of numbers whose
 * squares are finite. */
#define SCENE_COLOR_MAX 1e19f

/* A light and whether it is seen: of all kinds only spheres can be. */
typedef struct scene_light {
    lmp_light emitter;
    uint32_t hidden; /* 1: it shades, but is not drawn (an emissive mesh is, or nothing) */
} scene_light;

/* What a member is, which decides its range. */
typedef enum scene_light_type {
    SCENE_LIGHT_POSITION,  /* coordinates up to LMP_LENGTH_MAX */
    SCENE_LIGHT_RADIUS,    /* above 0, up to LMP_LENGTH_MAX */
    SCENE_LIGHT_DIRECTION, /* not 0; made a unit vector */
    SCENE_LIGHT_ANGLE,     /* 0 … pi */
    SCENE_LIGHT_COLOR      /* 0 … SCENE_COLOR_MAX */
} scene_light_type;

typedef struct scene_light_member {
    const char *name;
    scene_light_type type;
    size_t offset; /* in lmp_light */
    bool optional; /* 0 where it is not given */
    /* NULL, or the member is another quantity that the value at this offset is made from. */
    float (*convert)(float given, float radius);
} scene_light_member;

#define SCENE_LIGHT_MEMBERS_MAX 5
typedef struct scene_light_kind {
    const char *name;
    scene_light_member members[SCENE_LIGHT_MEMBERS_MAX + 1]; /* ended by one without a name */
    /* NULL, or what is wrong with members together that are each in its range; NULL: nothing. */
    const char *(*wrong)(const lmp_light *light);
    /* NULL, or makes it as large as a point's radius or a sun's half angle says, of the same
     * intensity or irradiance; 0 leaves it. */
    void (*widen)(lmp_light *light, float radius, float angle);
    const char *widened_by; /* the option that says how large, where there is `widen` */
    /* Makes scene_light_model's. */
    void (*model)(lmp_light *light, float irradiance, float diagonal);
} scene_light_kind;

extern const scene_light_kind scene_light_kinds[LMP_LIGHT_KINDS]; /* by lmp_light_kind */

/* That of a light that names none. */
extern const lmp_light_kind scene_light_kind_default;

/* A light to begin with, as the viewer adds it: warm, at the origin, directed at what is below, and
 * about so bright that it gives a scene of this diagonal the irradiance. */
lmp_light scene_light_model(lmp_light_kind kind, float irradiance, float diagonal);

/* One of irradiance 1 from a single direction. */
lmp_light scene_light_from(lmp_vec3 direction);

/* Whether lights of this one's kind have a member of a type. */
bool scene_light_has(const scene_light *light, scene_light_type type);

/* Whether it is seen, not only what it lights. */
bool scene_light_is_drawn(const scene_light *light);

/* A member's floats, and how many there are: 1 or 3. */
int scene_light_count(const scene_light_member *member);
float *scene_light_value(lmp_light *light, const scene_light_member *member);

/* Whether three numbers are such a color. */
bool scene_color_fits(const float *rgb);

/* What is wrong with a light, to follow its name: ".radius is not above 0". */
typedef struct scene_light_error {
    char text[224];
} scene_light_error;

/* Whether the kind is one and every member of it is in its range: the one check for all lights that
 * come from outside. */
bool scene_light_check(const scene_light *light, scene_light_error *error);

/* The same of one member. */
bool scene_light_check_member(const lmp_light *emitter, const scene_light_member *member,
                              scene_light_error *error);

struct cJSON;

/* Reads { "kind": …, members …, "hidden": … } strictly; without a kind it is a sphere. Its position
 * is in the world, and becomes relative to the origin of a scene. */
bool scene_light_from_json(const struct cJSON *object, const double origin[3], scene_light *light,
                           scene_light_error *error);

/* The same light as from_json reads it with the same origin; NULL without memory. */
struct cJSON *scene_light_to_json(const scene_light *light, const double origin[3]);

#endif
