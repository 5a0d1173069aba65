/* SPDX-License-Identifier: MIT */
#include "app/scene/load/emission.h"

#include "app/scene/instance.h"
#include "app/scene/load/emission_map.h"
#include "app/scene/load/patches.h"
#include "app/scene/load/round.h"
#include "app/scene/sides.h"
#include "app/scene/vector.h"

#include <stdlib.h>

/* Unless asked for another number, the most lights of a mesh, and of all meshes that are more than
 * one light each; the most faces of one of its pieces, and the most triangles of a piece whose
 * faces are looked for. */
enum { LIGHTS_MOST = 40, LIGHTS_MOST_ALL = 1024, FACES_MOST = 8, TRIANGLES_MOST = 1 << 16 };

/* A triangle emits nothing below this part of the mesh's brightest: compression blurs black. */
static const float darkest = 1.0f / 500;

/* The part of a mesh's power that the strongest of its pieces have, and of the strongest piece's
 * that each of the others has at most; these add theirs to it. */
static const double strongest_part = 0.99, weak_part = 0.1;

/* How much of a piece's surface faces one way if a rectangle stands for it, not a sphere. */
static const double flat_part = 0.9;

/* An emissive mesh in the world: its triangles that have areas and shine, turned to where. */
typedef struct glowing {
    piece_triangle *triangles;
    size_t count;
    size_t both; /* triangles that shine from both sides */
} glowing;

/* --- triangles -------------------------------------------------------------------------------- */

/* Adds a triangle. Of a double-sided body the outside shines, whose inside gives its light to
 * itself; another double-sided triangle shines from both sides. */
static void add_triangle(const emission_maps *maps, const scene_material *material, size_t instance,
                         uint32_t number, bool double_sided, sides_of side, glowing *g) {
    float corners[3][3];
    piece_triangle *t = &g->triangles[g->count];
    const bool turned = double_sided && side == SIDES_INWARD;
    scene_triangle_positions(maps->geometry, instance, number, corners);
    t->both = double_sided && side == SIDES_OPEN;
    t->outward = turned || side == SIDES_OUTWARD;
    for (int i = 0; i < 3; i++)
        t->corner[i] = vec_load(corners[turned ? 2 - i : i]);
    emission_maps_mean(maps, material, instance, number, t->radiance);
    g->count += piece_triangle_area(t) > 0.0;
}

/* Removes the triangles that are dark beside the brightest. */
static void remove_dark(glowing *g) {
    float most = 0.0f;
    size_t left = 0;
    for (size_t i = 0; i < g->count; i++)
        most = fmaxf(most, rgb_brightest(g->triangles[i].radiance));
    for (size_t i = 0; i < g->count; i++) {
        const piece_triangle t = g->triangles[i];
        if (!(rgb_brightest(t.radiance) > darkest * most))
            continue;
        g->triangles[left++] = t;
        g->both += t.both;
    }
    g->count = left;
}

/* Collects an emissive mesh; returns false if memory ran out. */
static bool collect(scene_builder *builder, const emission_maps *maps,
                    const scene_material *material, size_t instance, glowing *g) {
    const scene *s = maps->geometry;
    const bool double_sided =
        (material->flags & (SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID)) == SCENE_DOUBLE_SIDED;
    const uint32_t count = scene_instance_triangles(s, instance);
    sides_of *const sides = malloc((count + 1u) * sizeof *sides);
    *g = (glowing) { .triangles = malloc((count + 1u) * sizeof *g->triangles) };
    const bool ok =
        sides && g->triangles && sides_find(builder, s->instances[instance].mesh, sides);
    for (uint32_t t = 0; ok && t < count; t++)
        add_triangle(maps, material, instance, t, double_sided, sides[t], g);
    free(sides);
    remove_dark(g);
    return ok;
}

/* --- the light of a piece --------------------------------------------------------------------- */

/* Adds up the radiance of all sides that shine, times their areas. */
static void sum_power(const piece *p, double power[3]) {
    power[0] = power[1] = power[2] = 0;
    for (size_t i = 0; i < p->count; i++) {
        const piece_triangle *t = &p->triangles[i];
        for (int c = 0; c < 3; c++)
            power[c] += (t->both ? 2 : 1) * piece_triangle_area(t) * (double)t->radiance[c];
    }
}

/* Gives a light the piece's power, spread over a surface. */
static void spread(const piece *p, double surface, lmp_light *light) {
    double power[3];
    sum_power(p, power);
    light->radiance = (lmp_rgb) { (float)(power[0] / surface), (float)(power[1] / surface),
                                  (float)(power[2] / surface) };
}

/* Makes the sphere around the box of the triangles, shrunk to the farthest corner. */
static lmp_light sphere_around(const piece *p) {
    lmp_vec3 low = vec(INFINITY, INFINITY, INFINITY), high = vec_scale(low, -1.0f);
    lmp_light sphere = { .radius = 0.0f };
    for (size_t i = 0; i < 3 * p->count; i++) {
        const lmp_vec3 at = p->triangles[i / 3].corner[i % 3];
        low = vec(fminf(low.x, at.x), fminf(low.y, at.y), fminf(low.z, at.z));
        high = vec(fmaxf(high.x, at.x), fmaxf(high.y, at.y), fmaxf(high.z, at.z));
    }
    sphere.position = vec_scale(vec_add(low, high), 0.5f);
    for (size_t i = 0; i < 3 * p->count; i++)
        sphere.radius = fmaxf(
            sphere.radius, vec_length(vec_sub(p->triangles[i / 3].corner[i % 3], sphere.position)));
    return sphere;
}

static bool is_body(const piece *p) {
    for (size_t i = 0; i < p->count; i++)
        if (!p->triangles[i].outward)
            return false;
    return true;
}

/* What is found of a piece from its triangles, relative to its first corner: the vector of their
 * areas, the sum of them, and their moment. */
typedef struct spread_area {
    lmp_vec3 facing, moment;
    double whole;
} spread_area;

static spread_area measure(const piece *p) {
    const lmp_vec3 first = p->triangles[0].corner[0];
    spread_area sum = { .whole = 0 };
    for (size_t i = 0; i < p->count; i++) {
        const piece_triangle *t = &p->triangles[i];
        const lmp_vec3 a = vec_sub(t->corner[0], first), b = vec_sub(t->corner[1], first),
                       c = vec_sub(t->corner[2], first);
        const double area = piece_triangle_area(t);
        sum.whole += area;
        sum.facing = vec_add(sum.facing, vec_scale(vec_cross(vec_sub(b, a), vec_sub(c, a)), 0.5f));
        sum.moment = vec_add(sum.moment, vec_scale(vec_add(a, vec_add(b, c)), (float)area / 3));
    }
    return sum;
}

/* Turns two perpendicular directions to where the triangles spread most and least around a point,
 * and finds how much longer that is: the root of the ratio of their second moments. */
static double turn_to_spread(const piece *p, lmp_vec3 middle, lmp_vec3 *x, lmp_vec3 *y) {
    double xx = 0, xy = 0, yy = 0;
    for (size_t i = 0; i < p->count; i++) {
        const piece_triangle *t = &p->triangles[i];
        const double part = piece_triangle_area(t) / 12;
        double sum[2] = { 0, 0 };
        for (int k = 0; k < 4; k++) { /* the corners, and then their sum */
            const lmp_vec3 from = vec_sub(t->corner[k % 3], middle);
            const double u = k < 3 ? (double)vec_dot(from, *x) : sum[0],
                         v = k < 3 ? (double)vec_dot(from, *y) : sum[1];
            xx += part * u * u;
            xy += part * u * v;
            yy += part * v * v;
            sum[0] += u;
            sum[1] += v;
        }
    }
    const double angle = 0.5 * atan2(2 * xy, xx - yy), mean = 0.5 * (xx + yy),
                 half = hypot(0.5 * (xx - yy), xy);
    const lmp_vec3 along =
        vec_add(vec_scale(*x, (float)cos(angle)), vec_scale(*y, (float)sin(angle)));
    *y = vec_sub(vec_scale(*y, (float)cos(angle)), vec_scale(*x, (float)sin(angle)));
    *x = along;
    return sqrt((mean + half) / fmax(mean - half, 1e-12 * mean));
}

/* Makes a rectangle of a piece that is nearly flat and shines to one side: of the area that faces
 * its way, spread as that is, and before all of it, so that nothing of it is in its light. */
static bool make_rectangle(const piece *p, lmp_light *rectangle) {
    const spread_area found = measure(p);
    const double facing = (double)vec_length(found.facing);
    for (size_t i = 0; i < p->count; i++)
        if (p->triangles[i].both)
            return false;
    if (!(facing > flat_part * found.whole))
        return false;
    const lmp_vec3 normal = vec_normalize(found.facing, vec(0, 1, 0)),
                   middle = vec_add(p->triangles[0].corner[0],
                                    vec_scale(found.moment, (float)(1 / found.whole)));
    float before = 0;
    for (size_t i = 0; i < 3 * p->count; i++)
        before = fmaxf(before, vec_dot(vec_sub(p->triangles[i / 3].corner[i % 3], middle), normal));
    lmp_vec3 x = vec_across(normal), y = vec_cross(normal, x);
    const double longer = turn_to_spread(p, middle, &x, &y);
    *rectangle = scene_light_rectangle(vec_add(middle, vec_scale(normal, before)),
                                       vec_scale(x, (float)(0.5 * sqrt(facing * longer))),
                                       vec_scale(y, (float)(0.5 * sqrt(facing / longer))));
    spread(p, facing, rectangle);
    return true;
}

/* Makes the lights of a piece, at most `most`: a tube, its faces, a rectangle, or a sphere. One of
 * several is a rectangle rather than faces. Returns false if memory ran out. */
static bool make_piece(const piece *p, bool several, size_t most, lmp_light *lights, size_t *made) {
    *made = 1;
    if (is_body(p) && round_make_tube(p->triangles, p->count, lights)) {
        const double r = (double)lights->radius, half = (double)vec_length(lights->half[0]);
        spread(p, 4 * (double)PI * r * (r + half), lights);
        return true;
    }
    *made = 0;
    if (p->count <= TRIANGLES_MOST) {
        if (!patches_make(p->triangles, p->count, several ? 1 : most, lights, made))
            return false;
        if (*made == 0 && several && !make_rectangle(p, lights) &&
            !patches_make(p->triangles, p->count, most, lights, made))
            return false;
    }
    if (*made > 0)
        return true;
    *made = 1;
    if (make_rectangle(p, lights))
        return true;
    *lights = sphere_around(p);
    spread(p, 4 * (double)PI * (double)lights->radius * (double)lights->radius, lights);
    return true;
}

/* --- the lights of a mesh --------------------------------------------------------------------- */

static double whole_power(const piece *p) {
    double power[3];
    sum_power(p, power);
    return power[0] + power[1] + power[2];
}

/* A piece and its power, by which pieces are sorted, and its number, by which equal ones are. */
typedef struct ranked {
    piece piece;
    double power;
    size_t number;
} ranked;

static int compare_ranked(const void *a, const void *b) {
    const ranked *p = a, *q = b;
    if (p->power != q->power)
        return p->power > q->power ? -1 : 1;
    return (p->number > q->number) - (p->number < q->number);
}

/* Moves the strongest pieces to the front, up to `most` or nearly all power, and finds *kept, how
 * many these are, and *factor, by which their power is that of all. Returns false if memory ran
 * out. */
static bool find_strongest(piece *pieces, size_t count, size_t most, size_t *kept, double *factor) {
    double sum = 0, all = 0;
    ranked *rank = malloc((count + 1) * sizeof *rank);
    if (!rank)
        return false;
    for (size_t i = 0; i < count; i++) {
        rank[i] = (ranked) { pieces[i], whole_power(&pieces[i]), i };
        all += rank[i].power;
    }
    qsort(rank, count, sizeof *rank, compare_ranked);
    for (*kept = 0; *kept < count && *kept < most; ++*kept) {
        if (sum >= strongest_part * all && rank[*kept].power < weak_part * rank[0].power)
            break;
        pieces[*kept] = rank[*kept].piece;
        sum += rank[*kept].power;
    }
    *factor = sum > 0 ? all / sum : 1;
    free(rank);
    return true;
}

static lmp_rgb scaled(lmp_rgb radiance, double factor) {
    return (lmp_rgb) { (float)(factor * (double)radiance.r), (float)(factor * (double)radiance.g),
                       (float)(factor * (double)radiance.b) };
}

/* Makes the lights of a mesh, at most `most`. Returns false if memory ran out. */
static bool make_lights(glowing *g, size_t most, lmp_light *lights, size_t *made) {
    piece *pieces;
    size_t count;
    *made = 0;
    if (!pieces_sort(g->triangles, g->count, &pieces, &count))
        return false;
    size_t kept = 0;
    double factor = 1;
    bool ok = find_strongest(pieces, count, most, &kept, &factor);
    for (size_t i = 0; ok && i < kept; i++) {
        const size_t room = most - *made - (kept - 1 - i);
        size_t more;
        ok = make_piece(&pieces[i], kept > 1, kept > 1 && room > FACES_MOST ? FACES_MOST : room,
                        lights + *made, &more);
        *made += ok ? more : 0;
    }
    for (size_t i = 0; kept < count && i < *made; i++)
        lights[i].radiance = scaled(lights[i].radiance, factor);
    free(pieces);
    return ok;
}

/* Adds lights that stand for an instance. */
static bool add_made(scene_builder *builder, const glowing *g, size_t instance,
                     const lmp_light *lights, size_t made, const char *subject, base_error *error) {
    for (size_t i = 0; i < made; i++) {
        scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
        if (!light)
            return base_fail(error, subject, "does not fit into memory");
        light->hidden = 1;
        light->glow = (uint32_t)instance + 1;
        light->glows_both = 2 * g->both > g->count;
        light->emitter = lights[i];
        scene_light_error wrong;
        if (!scene_light_check(light, &wrong))
            return base_fail(error, subject, "instance %zu of a mesh makes a light: %s", instance,
                             wrong.text);
    }
    return true;
}

static bool add_lights(scene_builder *builder, glowing *g, size_t instance, size_t most,
                       const char *subject, base_error *error) {
    lmp_light *lights = malloc(most * sizeof *lights);
    size_t made = 0;
    const bool ok = (lights && make_lights(g, most, lights, &made)) ||
                    base_fail(error, subject, "does not fit into memory");
    const bool added = ok && add_made(builder, g, instance, lights, made, subject, error);
    free(lights);
    return added;
}

/* --- all meshes ------------------------------------------------------------------------------- */

/* Checks that no emission is too bright, whether or not a light stands for it; the message is that
 * of lights. */
static bool check_emission(const scene_builder *builder, const char *subject, base_error *error) {
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    for (size_t i = 0; i < builder_count(builder, BLOB_MATERIALS); i++)
        if (!scene_color_fits(materials[i].emission))
            return base_fail(error, subject,
                             "material %zu (\"%s\"): its emission is negative, not finite or above "
                             "1e19",
                             i, materials[i].name);
    return true;
}

static bool shines(const scene *world, const scene_material *materials, size_t instance) {
    const scene_material *m = &materials[world->meshes[world->instances[instance].mesh].material];
    return !(m->flags & (SCENE_UNLIT | SCENE_GLOWS_ALONE)) && rgb_brightest(m->emission) > 0.0f;
}

/* Returns the most lights of each mesh where so many shine. */
static size_t most_of_each(const scene *world, const scene_material *materials) {
    size_t count = 0;
    for (size_t i = 0; i < world->instance_count; i++)
        count += shines(world, materials, i);
    const size_t each = LIGHTS_MOST_ALL / (count + 1);
    return each < 1 ? 1 : each > LIGHTS_MOST ? LIGHTS_MOST : each;
}

bool emission_add_lights(scene_builder *builder, size_t most, const char *subject,
                         base_error *error) {
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    scene world;
    emission_maps maps;
    if (!check_emission(builder, subject, error))
        return false;
    builder_geometry(builder, &world);
    if (!emission_maps_create(builder, &world, &maps))
        return base_fail(error, subject, "does not fit into memory");
    if (most == 0)
        most = most_of_each(&world, materials);
    bool ok = true;
    for (size_t i = 0; ok && i < world.instance_count; i++) {
        const scene_material *material = &materials[world.meshes[world.instances[i].mesh].material];
        if (!shines(&world, materials, i) || !emission_maps_ready(&maps, material))
            continue;
        glowing g;
        ok = (collect(builder, &maps, material, i, &g) ||
              base_fail(error, subject, "does not fit into memory")) &&
             add_lights(builder, &g, i, most, subject, error);
        free(g.triangles);
    }
    emission_maps_free(&maps);
    return ok;
}
