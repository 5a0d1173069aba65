/* SPDX-License-Identifier: MIT */
#include "app/scene/load/emission.h"

#include "app/scene/instance.h"
#include "app/scene/load/patches.h"
#include "app/scene/load/round.h"
#include "app/scene/sides.h"
#include "app/scene/vector.h"

#include <stdlib.h>

/* The most faces that become lights of their own, and triangles that faces are looked for in. */
enum { FACES_MOST = 40, TRIANGLES_MOST = 1 << 16 };

/* An emissive mesh in the world: its triangles that have areas, turned to where they shine. */
typedef struct glowing {
    patch_triangle *triangles;
    size_t count;
    size_t both;    /* triangles that shine from both sides */
    bool closed;    /* whether all belong to bodies and shine outward */
    double shining; /* area of the sides that light the scene */
} glowing;

static double triangle_area(const lmp_vec3 corner[3]) {
    const lmp_vec3 a = vec_sub(corner[1], corner[0]), b = vec_sub(corner[2], corner[0]);
    return 0.5 * (double)vec_length(vec_cross(a, b));
}

/* Adds a triangle. Of a double-sided body the outside shines, whose inside gives its light to
 * itself; another double-sided triangle shines from both sides. */
static void add_triangle(const scene *s, size_t instance, uint32_t number, bool double_sided,
                         sides_of side, glowing *g) {
    float corners[3][3];
    patch_triangle *t = &g->triangles[g->count];
    const bool turned = double_sided && side == SIDES_INWARD;
    scene_triangle_positions(s, instance, number, corners);
    t->both = double_sided && side == SIDES_OPEN;
    for (int i = 0; i < 3; i++)
        t->corner[i] = vec_load(corners[turned ? 2 - i : i]);
    const double area = triangle_area(t->corner);
    g->count += area > 0.0;
    g->both += area > 0.0 && t->both;
    g->closed = g->closed && (turned || side == SIDES_OUTWARD);
    g->shining += t->both ? 2.0 * area : area;
}

/* Collects an emissive mesh; returns false if memory ran out. */
static bool collect(scene_builder *builder, const scene *s, size_t instance, glowing *g) {
    const uint32_t mesh = s->instances[instance].mesh;
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    const bool double_sided = (materials[s->meshes[mesh].material].flags &
                               (SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID)) == SCENE_DOUBLE_SIDED;
    const uint32_t count = scene_instance_triangles(s, instance);
    sides_of *const sides = malloc((count + 1u) * sizeof *sides);
    *g = (glowing) { .triangles = malloc((count + 1u) * sizeof *g->triangles), .closed = true };
    const bool ok = sides && g->triangles && sides_find(builder, mesh, sides);
    for (uint32_t t = 0; ok && t < count; t++)
        add_triangle(s, instance, t, double_sided, sides[t], g);
    free(sides);
    return ok;
}

/* Makes the sphere around the box of the triangles, shrunk to the farthest corner. */
static lmp_light sphere_around(const glowing *g) {
    lmp_vec3 low = vec(INFINITY, INFINITY, INFINITY), high = vec_scale(low, -1.0f);
    lmp_light sphere = { .radius = 0.0f };
    for (size_t i = 0; i < 3 * g->count; i++) {
        const lmp_vec3 p = g->triangles[i / 3].corner[i % 3];
        low = vec(fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z));
        high = vec(fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z));
    }
    sphere.position = vec_scale(vec_add(low, high), 0.5f);
    for (size_t i = 0; i < 3 * g->count; i++)
        sphere.radius = fmaxf(
            sphere.radius, vec_length(vec_sub(g->triangles[i / 3].corner[i % 3], sphere.position)));
    return sphere;
}

/* Makes the shapes of the mesh's light, at most FACES_MOST: a tube, its faces, or a sphere. *around
 * is whether they enclose it, and have its power at a lower radiance. Returns false if memory ran
 * out. */
static bool make_shapes(const glowing *g, lmp_light *shapes, size_t *made, bool *around) {
    *made = g->count > 0;
    *around = true;
    if (g->count == 0 || (g->closed && round_make_tube(g->triangles, g->count, shapes)))
        return true;
    *around = false;
    if (g->count <= TRIANGLES_MOST &&
        !patches_make(g->triangles, g->count, FACES_MOST, shapes, made))
        return false;
    if (*made > 0 && g->count <= TRIANGLES_MOST)
        return true;
    *made = 1;
    *around = true;
    shapes[0] = sphere_around(g);
    return true;
}

/* Returns the radiance, for emission 1, at which a sphere or a tube around the mesh has its power:
 * a sphere has no axis. */
static double dimmed(const glowing *g, const lmp_light *shape) {
    const double r = (double)shape->radius, half = (double)vec_length(shape->half[0]);
    return g->shining / (4.0 * M_PI * r * (r + half));
}

static bool add_lights(scene_builder *builder, const glowing *g, size_t instance,
                       const float *emission, const char *subject, base_error *error) {
    lmp_light shapes[FACES_MOST];
    size_t made;
    bool around;
    if (!make_shapes(g, shapes, &made, &around))
        return base_fail(error, subject, "does not fit into memory");
    for (size_t i = 0; i < made; i++) {
        scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
        if (!light)
            return base_fail(error, subject, "does not fit into memory");
        const double part = around ? dimmed(g, &shapes[i]) : 1.0;
        light->hidden = 1;
        light->glow = (uint32_t)instance + 1;
        light->glows_both = 2 * g->both > g->count;
        light->emitter = shapes[i];
        light->emitter.radiance =
            (lmp_rgb) { (float)(part * (double)emission[0]), (float)(part * (double)emission[1]),
                        (float)(part * (double)emission[2]) };
        scene_light_error wrong;
        if (!scene_light_check(light, &wrong))
            return base_fail(error, subject, "instance %zu of a mesh makes a light: %s", instance,
                             wrong.text);
    }
    return true;
}

/* Checks that no emission is too bright, whether a light stands for it or, because of a texture,
 * none does; the message is that of lights. */
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

bool emission_add_lights(scene_builder *builder, const char *subject, base_error *error) {
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    scene world;
    bool ok = check_emission(builder, subject, error);
    builder_geometry(builder, &world);
    for (size_t i = 0; ok && i < world.instance_count; i++) {
        const scene_material *material = &materials[world.meshes[world.instances[i].mesh].material];
        const float *emission = material->emission;
        if (material->emission_map.texture >= 0 ||
            material->flags & (SCENE_UNLIT | SCENE_GLOWS_ALONE) ||
            !(emission[0] + emission[1] + emission[2] > 0.0f))
            continue;
        glowing g;
        ok = (collect(builder, &world, i, &g) ||
              base_fail(error, subject, "does not fit into memory")) &&
             add_lights(builder, &g, i, emission, subject, error);
        free(g.triangles);
    }
    return ok;
}
