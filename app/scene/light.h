/* SPDX-License-Identifier: MIT */
/* light.h - a light of a scene: its kinds, their members, and lights as JSON (docs/lights.md). One
 * table of kinds decides what is read, written, checked and moved. */
#ifndef LAMPION_SCENE_LIGHT_H
#define LAMPION_SCENE_LIGHT_H

#include <lampion/light.h>

#include <stdbool.h>

/* No color of a light or an emissive material exceeds this, whoever reads it: sums over all lights,
 * and what materials make of them, stay finite, because the library promises so for numbers whose
 * squares are finite. */
#define SCENE_COLOR_MAX 1e19f

/* A light and whether it is visible; of all kinds only spheres and areas can be. */
typedef struct scene_light {
    lmp_light emitter;
    uint32_t hidden; /* 1: lights the scene but is not drawn: its emissive mesh is, or nothing */
    uint32_t glow;   /* 1 + the number of the instance whose emission it stands for; 0: none */
    uint32_t glows_both; /* 1: that instance shines from both sides of its triangles */
} scene_light;

/* The type of a member, which decides its range. */
typedef enum scene_light_type {
    SCENE_LIGHT_POSITION,  /* coordinates up to LMP_LENGTH_MAX */
    SCENE_LIGHT_RADIUS,    /* above 0, up to LMP_LENGTH_MAX */
    SCENE_LIGHT_DIRECTION, /* not 0; normalized when read */
    SCENE_LIGHT_EXTENT,    /* a vector from the position, not 0, its parts up to LMP_LENGTH_MAX */
    SCENE_LIGHT_CORNERS,   /* 3 to LMP_LIGHT_CORNERS_MAX vectors from the position */
    SCENE_LIGHT_FLAG,      /* true or false */
    SCENE_LIGHT_ANGLE,     /* 0 … pi */
    SCENE_LIGHT_COLOR      /* 0 … SCENE_COLOR_MAX */
} scene_light_type;

typedef struct scene_light_member {
    const char *name;
    scene_light_type type;
    size_t offset; /* in lmp_light */
    bool optional; /* whether it is 0 when not given */
    /* NULL, or computes the value at this offset from another quantity, which is what the member
     * gives, and the light's shape. */
    float (*convert)(const lmp_light *light, float given);
} scene_light_member;

#define SCENE_LIGHT_MEMBERS_MAX 7
typedef struct scene_light_kind {
    const char *name;
    scene_light_member members[SCENE_LIGHT_MEMBERS_MAX + 1]; /* ended by a member without a name */
    /* NULL, or returns what is wrong with members that are each in range but do not fit together,
     * NULL for nothing. */
    const char *(*wrong)(const lmp_light *light);
    /* Gives a point a radius or a sun a half angle at the same intensity or irradiance; 0 leaves
     * it. May be NULL. */
    void (*widen)(lmp_light *light, float radius, float angle);
    const char *widened_by; /* the option that gives this size, where there is `widen` */
    /* Fills in the light of scene_light_model. */
    void (*model)(lmp_light *light, float irradiance, float diagonal);
} scene_light_kind;

/* Indexed by lmp_light_kind. */
#define SCENE_LIGHT_KIND_COUNT LMP_LIGHT_KIND_COUNT
extern const scene_light_kind scene_light_kinds[SCENE_LIGHT_KIND_COUNT];

/* The kind of a light whose JSON names none. */
extern const lmp_light_kind scene_light_kind_default;

/* Returns a light to start with, as the viewer adds it: warm, at the origin, directed downward, and
 * bright enough to give a scene of this diagonal about the irradiance. */
lmp_light scene_light_model(lmp_light_kind kind, float irradiance, float diagonal);

/* Returns a light of irradiance 1 from a single direction. */
lmp_light scene_light_from(lmp_vec3 direction);

/* Returns how many members of the type lights of this kind have. */
int scene_light_members_of(const lmp_light *light, scene_light_type type);

/* Whether lights of this kind have a member of the type. */
bool scene_light_has(const scene_light *light, scene_light_type type);

/* Whether the light is drawn, not only what it lights. */
bool scene_light_is_drawn(const scene_light *light);

/* Whether a light is an area: a rectangle, a disk, a tube or a polygon. */
bool scene_light_is_area(const lmp_light *light);

/* Whether a light is far away, and narrow enough that one may face it: not a hemisphere. */
bool scene_light_is_sun(const lmp_light *light);

/* Returns the first of the lights that is an area, or NULL. */
const scene_light *scene_find_area(const scene_light *lights, size_t count);

size_t scene_count_areas(const scene_light *lights, size_t count);

/* Return areas, one-sided and without their radiance: a rectangle by the ways from its center to
 * the middles of two sides, a disk by its normal, a tube by the way to an end of its axis, a
 * polygon by corners relative to a position. */
lmp_light scene_light_rectangle(lmp_vec3 center, lmp_vec3 x, lmp_vec3 y);
lmp_light scene_light_disk(lmp_vec3 center, lmp_vec3 normal, float radius);
lmp_light scene_light_tube(lmp_vec3 center, lmp_vec3 half, float radius);
lmp_light scene_light_polygon(lmp_vec3 position, const lmp_vec3 *corner, int count);

/* Returns the distance of a light's farthest point from its position; 0 if it has no size. */
float scene_light_extent(const lmp_light *light);

/* Scales the size of a sphere or an area; its power stays, so a larger one is dimmer. */
void scene_light_resize(lmp_light *light, float by);

/* Rotates a light around its position, or, if it has none, where it comes from. */
void scene_light_rotate(lmp_light *light, lmp_vec3 (*rotate)(lmp_vec3 v, const void *user),
                        const void *user);

/* Rotates a light by the smallest rotation from one unit direction to another. */
void scene_light_rotate_between(lmp_light *light, lmp_vec3 from, lmp_vec3 to);

/* Returns the unit direction of a light: to where a spot or a flat area shines, along a tube, to a
 * light without a position; 0 if it has none. */
lmp_vec3 scene_light_axis(const lmp_light *light);

/* Rotates a light with a position as little as it takes to shine in a unit direction: a spot or a
 * flat area by its front, two-sided ones by the nearer side, a tube across its axis. */
void scene_light_face(lmp_light *light, lmp_vec3 direction);

/* Returns the number of floats of a light's member; a flag has none. */
int scene_light_count(const lmp_light *light, const scene_light_member *member);
float *scene_light_value(lmp_light *light, const scene_light_member *member);
bool *scene_light_flag(lmp_light *light, const scene_light_member *member);

/* Whether three numbers are a valid color, 0 … SCENE_COLOR_MAX. */
bool scene_color_fits(const float *rgb);

/* What is wrong with a light, to follow its name: ".radius is not above 0". */
typedef struct scene_light_error {
    char text[224];
} scene_light_error;

/* Checks that the kind exists and every member is in its range; all lights that come from outside
 * pass this check. */
bool scene_light_check(const scene_light *light, scene_light_error *error);

/* Checks that one member is in its range. */
bool scene_light_check_member(const lmp_light *emitter, const scene_light_member *member,
                              scene_light_error *error);

struct json_t;

/* Reads { "kind": …, members …, "hidden": … } strictly; without a kind the light is a sphere. Its
 * position is in the world and becomes relative to the scene's origin. */
bool scene_light_from_json(struct json_t *object, const double origin[3], scene_light *light,
                           scene_light_error *error);

/* Writes a light as scene_light_from_json reads it with this origin; returns NULL if memory ran
 * out. */
struct json_t *scene_light_to_json(const scene_light *light, const double origin[3]);

#endif
