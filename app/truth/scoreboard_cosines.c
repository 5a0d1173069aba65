/* SPDX-License-Identifier: MIT */
/* Heitz et al., Real-Time Polygonal-Light Shading with Linearly Transformed Cosines (SIGGRAPH
 * 2016), and Heitz and Hill, Real-Time Line- and Disk-Light Shading (SIGGRAPH 2017 course): the
 * inverse matrix turns the lobe into a clamped cosine and the disk of directions into an ellipse,
 * whose vector irradiance has a closed form; a sphere of the same irradiance is clipped by the
 * horizon. */
#include "app/truth/scoreboard_cosines.h"
#include "app/truth/scoreboard_gltf.h"

static double dot(const cosines_vector a, const cosines_vector b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void lookup(const cosines_table *table, float roughness, float nv,
                   float node[COSINES_MEMBERS]) {
    const int last = table->size - 1;
    const float x = gltf_clamp(roughness) * (float)last;
    const float y = sqrtf(1 - gltf_clamp(nv)) * (float)last;
    const int i = (int)fminf(x, (float)last - 1), j = (int)fminf(y, (float)last - 1);
    const float u = x - (float)i, v = y - (float)j;
    const float(*const here)[COSINES_MEMBERS] = &table->nodes[i * table->size + j];
    const float(*const rougher)[COSINES_MEMBERS] = here + table->size;
    for (int k = 0; k < COSINES_MEMBERS; k++)
        node[k] = (1 - u) * ((1 - v) * here[0][k] + v * here[1][k]) +
                  u * ((1 - v) * rougher[0][k] + v * rougher[1][k]);
}

/* Integrates over the ellipse: P = u u' - sin2 B B', u = B axis, has the axes of its cone. Its one
 * positive eigenvalue is found by Newton's method from |u|², which is an upper bound. */
float cosines_over_disk(cosines_vector rows[3], const cosines_vector axis, double sin2) {
    const cosines_vector u = { dot(rows[0], axis), dot(rows[1], axis), dot(rows[2], axis) };
    cosines_vector p[3], once, twice, mean;
    double trace = 0, squares = 0, largest = dot(u, u);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            p[i][j] = u[i] * u[j] - sin2 * dot(rows[i], rows[j]);
        trace += p[i][i];
        squares += dot(p[i], p[i]);
    }
    const double volume = rows[1][1] * (rows[0][0] * rows[2][2] - rows[0][2] * rows[2][0]);
    const double minors = (trace * trace - squares) / 2;
    const double determinant = volume * volume * sin2 * sin2 * (1 - sin2);
    for (int k = 0; k < 8; k++)
        largest -= (((largest - trace) * largest + minors) * largest - determinant) /
                   ((3 * largest - 2 * trace) * largest + minors);
    const double sum = trace - largest, product = determinant / largest; /* of the other two */
    for (int i = 0; i < 3; i++)
        once[i] = dot(p[i], u);
    for (int i = 0; i < 3; i++)
        twice[i] = dot(p[i], once);
    for (int i = 0; i < 3; i++)
        mean[i] = twice[i] - sum * once[i] + product * u[i];
    const double form = sqrt(product / (largest * (largest - sum) + product));
    return gltf_sphere((float)(mean[2] / sqrt(dot(mean, mean))), (float)form);
}

float formula_cosines(const formula_query *q, const formula_reads *reads) {
    const float sin2 = q->sine * q->sine, nv = vec_dot(q->normal, q->view);
    const float diffuse = gltf_sphere(vec_dot(q->normal, q->light), sin2);
    if (q->material == RULER_LAMBERT)
        return q->color * diffuse;
    float node[COSINES_MEMBERS];
    lookup(reads->cosines, q->roughness, nv, node);
    const lmp_vec3 x =
        vec_normalize(vec_sub(q->view, vec_scale(q->normal, nv)), vec_across(q->normal));
    const lmp_vec3 y = vec_cross(q->normal, x);
    const cosines_vector axis = { (double)vec_dot(q->light, x), (double)vec_dot(q->light, y),
                                  (double)vec_dot(q->light, q->normal) };
    cosines_vector rows[3] = { { (double)node[0], 0, (double)node[1] },
                               { 0, 1, 0 },
                               { (double)node[2], 0, (double)node[3] } };
    const float weight = gltf_f0(q) * node[4] + (1 - gltf_f0(q)) * node[5];
    return gltf_layers(q, weight * cosines_over_disk(rows, axis, (double)sin2), diffuse, q->light);
}
