/* SPDX-License-Identifier: MIT */
/* Edges: of surfaces, which samples smooth, and of the image, beyond which meshes are culled. */
#include "tests/gpu/device.h"
#include "tests/oracle/check.h"
#include "tests/oracle/placed.h"

#include <math.h>
#include <string.h>

enum { SIDE = 64, TILES = 12, MESHES = TILES * TILES };

/* Squares that glow, each a mesh of its own, in z = 0 around the origin. */
typedef struct tiles {
    scene_vertex vertices[4 * MESHES];
    uint32_t indices[6 * MESHES];
    scene_mesh meshes[MESHES];
    scene_material material;
    scene_light lights[1];
    scene world;
} tiles;

static void lay_tile(tiles *t, int i, float x, float y, float half_size) {
    static const float corners[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    static const uint32_t order[6] = { 0, 1, 2, 0, 2, 3 };
    for (int k = 0; k < 4; k++)
        t->vertices[4 * i + k] = (scene_vertex) { .position = { x + half_size * corners[k][0],
                                                                y + half_size * corners[k][1], 0 },
                                                  .normal = { 0, 0, 1 },
                                                  .tangent = { 1, 0, 0, 1 } };
    for (int k = 0; k < 6; k++)
        t->indices[6 * i + k] = order[k] + 4 * (uint32_t)i;
    t->meshes[i] = (scene_mesh) { .first_index = 6 * (uint32_t)i,
                                  .index_count = 6,
                                  .minimum = { x - half_size, y - half_size, 0 },
                                  .maximum = { x + half_size, y + half_size, 0 } };
}

static void open_tiles(tiles *t, size_t count) {
    t->material = scene_material_plain();
    t->material.emission[0] = 1;
    t->world = (scene) { .vertices = t->vertices,
                         .indices = t->indices,
                         .meshes = t->meshes,
                         .instances = placed_meshes(count),
                         .materials = &t->material,
                         .vertex_count = 4 * count,
                         .index_count = 6 * count,
                         .mesh_count = count,
                         .instance_count = count,
                         .material_count = 1,
                         .lights = t->lights,
                         .minimum = { -4, -4, 0 },
                         .maximum = { 4, 4, 0 },
                         .name = "tiles" };
}

/* A frame with a field of view, or with parallel rays as high. At this distance 1 is half the
 * image's height. */
static render_frame look_from(const scene *world, float x, float y, bool parallel) {
    return (render_frame) { .width = SIDE,
                            .height = SIDE,
                            .camera = { .eye = { x, y, 2 },
                                        .target = { x, y, 0 },
                                        .up = { 0, 1, 0 },
                                        .fov = 2 * atanf(0.5f),
                                        .height = parallel ? 2 : 0 },
                            .bands = 3,
                            .lights = world->lights };
}

static image draw_tiles(const scene *world, const render_frame *frame) {
    gpu_renderer *renderer = open_renderer(world);
    image pixels = render_image(renderer, frame);
    gpu_renderer_destroy(renderer);
    return pixels;
}

/* The bounds of a mesh decide whether it is drawn, and must not change the image. */
static void meshes_are_culled_only_where_they_are_not_seen(void **state) {
    (void)state;
    static tiles t;
    for (int i = 0; i < MESHES; i++)
        lay_tile(&t, i, 0.6f * (float)(i % TILES) - 3.3f, 0.6f * (float)(i / TILES) - 3.3f, 0.1f);
    open_tiles(&t, MESHES);
    for (int view = 0; view < 10; view++) {
        render_frame frame =
            look_from(&t.world, (float)(view / 2 % 3 - 1), (float)(view / 6), view % 2);
        frame.camera.target[0] += view > 5 ? 1.5f : 0;
        frame.camera.target[1] -= view > 7 ? 1.5f : 0;
        image seen = draw_tiles(&t.world, &frame);
        static scene_mesh tight[MESHES];
        memcpy(tight, t.meshes, sizeof tight);
        for (int i = 0; i < MESHES; i++)
            for (int c = 0; c < 3; c++) {
                t.meshes[i].minimum[c] = -9;
                t.meshes[i].maximum[c] = 9;
            }
        image all = draw_tiles(&t.world, &frame);
        memcpy(t.meshes, tight, sizeof tight);
        int lit = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            lit += all.rgb[3 * i] > 0;
        assert_in_range(lit, SIDE, SIDE * SIDE);
        assert_memory_equal(seen.rgb, all.rgb, 3 * SIDE * SIDE * sizeof *all.rgb);
        image_free(&seen);
        image_free(&all);
    }
}

/* A square that ends in the middle of pixels on each of its four sides. */
static void samples_halve_pixels_on_every_side(void **state) {
    (void)state;
    static tiles t;
    const float pixel = 2.0f / SIDE;
    lay_tile(&t, 0, 0, 0, 16.5f * pixel);
    open_tiles(&t, 1);
    for (int parallel = 0; parallel < 2; parallel++) {
        render_frame frame = look_from(&t.world, 0, 0, parallel);
        frame.samples = 64;
        image pixels = draw_tiles(&t.world, &frame);
        const int edges[2] = { SIDE / 2 - 17, SIDE / 2 + 16 };
        for (int k = 0; k < 2; k++)
            for (int at = edges[0] + 1; at < edges[1]; at++) {
                const float *across = pixels.rgb + 3 * (SIDE * at + edges[k]);
                const float *up = pixels.rgb + 3 * (SIDE * edges[k] + at);
                CHECK_WITHIN(fabs((double)*across - 0.5), 0.05);
                CHECK_WITHIN(fabs((double)*up - 0.5), 0.05);
            }
        image_free(&pixels);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_are_culled_only_where_they_are_not_seen),
        cmocka_unit_test(samples_halve_pixels_on_every_side),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
