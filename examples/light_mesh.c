/* SPDX-License-Identifier: MIT */
/* light_mesh.c - colors of a mesh's vertices under sphere lights, as an engine bakes them.
 *
 *     cc light_mesh.c $(pkg-config --cflags --libs lampion) -lm -o light_mesh */
#include <lampion/lampion.h>

#include <math.h>
#include <stdio.h>

enum { COLUMNS = 60, ROWS = 26, VERTICES = COLUMNS * ROWS };

/* An engine's vertex: lampion reads its members where they are. */
typedef struct vertex {
    lmp_vec3 position, normal;
    lmp_rgb color;
} vertex;

/* Makes the half of a unit sphere that is seen along -z, one vertex per character; other vertices
 * keep normal 0. */
static void make_sphere(vertex *vertices) {
    for (int i = 0; i < VERTICES; i++) {
        const float x = ((float)(i % COLUMNS) + 0.5f) / (COLUMNS / 2) - 1.0f;
        const float y = 1.0f - ((float)(i / COLUMNS) + 0.5f) / (ROWS / 2);
        const float z2 = 1.0f - x * x - y * y;
        const lmp_vec3 normal = { x, y, sqrtf(fmaxf(z2, 0.0f)) };
        vertices[i] = (vertex) { .position = normal, .normal = normal };
        if (z2 < 0.0f)
            vertices[i] = (vertex) { .normal = { 0, 0, 1 } };
    }
}

static void light(vertex *vertices, const lmp_light *lights, size_t light_count) {
    static const lmp_vec3 viewer = { 0, 0, 1 };
    static const lmp_material clay = { .diffuse = { 0.6f, 0.6f, 0.6f },
                                       .specular = { 0.3f, 0.3f, 0.3f },
                                       .exponent = 60 };
    const size_t stride = sizeof *vertices;
    const lmp_surfaces surfaces = {
        .position = { &vertices->position.x, &vertices->position.y, &vertices->position.z, stride },
        .normal = { &vertices->normal.x, &vertices->normal.y, &vertices->normal.z, stride },
        .view = lmp_vec3_array_same(&viewer),
        .material = &clay, /* stride 0: one material for all */
    };
    const lmp_shade_settings settings = { .bands = 16, .window = LMP_WINDOW_HANNING };
    lmp_shade_n(&settings, &surfaces, VERTICES, lights, light_count,
                (lmp_rgb_array) { &vertices->color.r, stride });
}

int main(void) {
    static vertex vertices[VERTICES];
    const lmp_light lights[] = {
        { .position = { -2, 2, 2 }, .radius = 0.5f, .radiance = { 40, 40, 40 } },
        { .position = { 3, 0, 1 }, .radius = 1.0f, .radiance = { 4, 4, 4 } },
        { .position = { 0, -4, 0 }, .radius = 2.0f, .radiance = { 1, 1, 1 } },
    };
    make_sphere(vertices);
    light(vertices, lights, sizeof lights / sizeof *lights);

    static const char ramp[] = " .:-=+*#%@";
    for (int i = 0; i < VERTICES; i++) {
        const int level = (int)(8.0f * sqrtf(vertices[i].color.g)) + 1;
        const int on_sphere = vertices[i].position.z > 0.0f;
        putchar(on_sphere ? ramp[level < 9 ? level : 9] : ' ');
        if (i % COLUMNS == COLUMNS - 1)
            putchar('\n');
    }
    return 0;
}
