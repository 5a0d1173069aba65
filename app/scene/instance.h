/* SPDX-License-Identifier: MIT */
/* instance.h - the triangles of a scene in the world: those of each mesh, once per instance. */
#ifndef LAMPION_SCENE_INSTANCE_H
#define LAMPION_SCENE_INSTANCE_H

#include "app/scene/scene.h"

/* Returns the instance that leaves its mesh as it is, to the bit. */
scene_instance scene_instance_identity(uint32_t mesh);
bool scene_instance_is_identity(const scene_instance *instance);

/* Multiplies two column-major matrices: the product applies b, then a. */
void scene_multiply(const double a[16], const double b[16], double product[16]);

/* Rounds a column-major matrix to an instance; returns false if it does not fit one. */
bool scene_instance_set(scene_instance *instance, const double matrix[16]);

/* Whether normals and tangents can follow the matrix in float32: it is finite and does not flatten,
 * shear or scale too much. Vertices under any other matrix must be transformed beforehand. */
bool scene_instance_fits(const scene_instance *instance);

/* Whether the instance swaps front and back; scene_triangle then swaps the second and third
 * corner. */
bool scene_instance_mirrors(const scene_instance *instance);

/* Transforms a position into the world. All code that needs world positions uses these operations,
 * so that results agree to the bit. */
static inline void scene_instance_point(const scene_instance *instance, const float p[3],
                                        float world[3]) {
    for (int k = 0; k < 3; k++) {
        const float *row = instance->world_from_mesh[k];
        world[k] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
}

/* Transforms whole vertices into the world; normals and tangents stay unit. */
void scene_instance_vertices(const scene_instance *instance, scene_vertex *vertices, size_t count);

/* Returns an upper bound of the factor by which lengths in the mesh grow. */
float scene_instance_scale(const scene_instance *instance);

/* Finds a box that contains all positions of the instance in the world. */
void scene_instance_box(const scene *scene, size_t instance, float minimum[3], float maximum[3]);

/* Returns the number of the material of the instance's triangles. */
static inline uint32_t scene_instance_material(const scene *s, size_t instance) {
    return s->meshes[s->instances[instance].mesh].material;
}

/* Return the number of triangles of an instance, and of all instances. */
uint32_t scene_instance_triangles(const scene *scene, size_t instance);
size_t scene_triangle_count(const scene *scene);

/* Return the corners of a triangle of an instance, counter-clockwise as seen from its front: as
 * vertices of the mesh; as positions in the world; or as whole vertices in the world, with unit
 * normals and tangents. */
void scene_triangle_vertices(const scene *scene, size_t instance, uint32_t triangle,
                             const scene_vertex *corners[3]);
void scene_triangle_positions(const scene *scene, size_t instance, uint32_t triangle,
                              float corners[3][3]);
void scene_triangle(const scene *scene, size_t instance, uint32_t triangle,
                    scene_vertex corners[3]);

/* Returns the diagonal of the box that the scene says it is in. */
float scene_diagonal(const scene *scene);

/* Finds the bounds of all positions. Returns false and leaves *minimum and *maximum alone if there
 * is no instance. */
bool scene_bounds(const scene *scene, float minimum[3], float maximum[3]);

/* Returns the area of all triangles. */
double scene_area(const scene *scene);

#endif
