/* SPDX-License-Identifier: MIT */
/* instance.h - the triangles of a scene in the world: each mesh as often as it has instances. */
#ifndef LAMPION_SCENE_INSTANCE_H
#define LAMPION_SCENE_INSTANCE_H

#include "app/scene/scene.h"

/* The instance that leaves its mesh as it is: its numbers, to the bit, are those of the mesh. */
scene_instance scene_instance_identity(uint32_t mesh);
bool scene_instance_is_identity(const scene_instance *instance);

/* The product of two column-major matrices, which takes b's space where a takes that of a. */
void scene_multiply(const double a[16], const double b[16], double product[16]);

/* Rounds a column-major matrix. False if that does not fit an instance. */
bool scene_instance_set(scene_instance *instance, const double matrix[16]);

/* Whether normals and tangents can follow the matrix in float32: it is finite, and neither
 * flattens, shears nor scales too much. Of another one the vertices have to be transformed
 * beforehand. */
bool scene_instance_fits(const scene_instance *instance);

/* Whether front and back change sides: scene_triangle then swaps the second and the third corner.
 */
bool scene_instance_mirrors(const scene_instance *instance);

/* A position in the world; everything that looks for triangles there computes it by these
 * operations, so that all of it agrees to the bit. */
static inline void scene_instance_point(const scene_instance *instance, const float p[3],
                                        float world[3]) {
    for (int k = 0; k < 3; k++) {
        const float *row = instance->world_from_mesh[k];
        world[k] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
}

/* Takes whole vertices into the world; normals and tangents are unit there too. */
void scene_instance_vertices(const scene_instance *instance, scene_vertex *vertices, size_t count);

/* What the lengths of a mesh grow by at most. */
float scene_instance_scale(const scene_instance *instance);

/* A box in which all these positions of the instance lie. */
void scene_instance_box(const scene *scene, size_t instance, float minimum[3], float maximum[3]);

/* The number of the material that its triangles have. */
static inline uint32_t scene_instance_material(const scene *s, size_t instance) {
    return s->meshes[s->instances[instance].mesh].material;
}

/* Triangles of an instance, and of all of them. */
uint32_t scene_instance_triangles(const scene *scene, size_t instance);
size_t scene_triangle_count(const scene *scene);

/* The corners of a triangle of an instance, counter-clockwise to who sees its front: the vertices
 * of the mesh; their positions in the world; or whole vertices in world space, normals and tangents
 * unit. */
void scene_triangle_vertices(const scene *scene, size_t instance, uint32_t triangle,
                             const scene_vertex *corners[3]);
void scene_triangle_positions(const scene *scene, size_t instance, uint32_t triangle,
                              float corners[3][3]);
void scene_triangle(const scene *scene, size_t instance, uint32_t triangle,
                    scene_vertex corners[3]);

/* The bounds of all positions. False without an instance: *minimum and *maximum are then left. */
bool scene_bounds(const scene *scene, float minimum[3], float maximum[3]);

/* The area of all triangles. */
double scene_area(const scene *scene);

#endif
