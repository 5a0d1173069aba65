/* SPDX-License-Identifier: MIT */
/* shadow.h - a scene of thin poles, a pierced screen and a box, and its image with shadows. */
#ifndef LAMPION_TESTS_GPU_SHADOW_H
#define LAMPION_TESTS_GPU_SHADOW_H

#include "app/render/shade.h"
#include "app/render/shadow/shadow.h"
#include "app/scene/builtin/shape.h"
#include "app/scene/vector.h"
#include "tests/gpu/device.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 64, PIXELS = WIDTH * HEIGHT, BANDS = 20 };

static void add_coated(scene_builder *builder, const char *name, float gray, float coat) {
    scene_material *material = builder_material(builder, name);
    assert_non_null(material);
    for (int c = 0; c < 3; c++)
        material->base_color[c] = gray;
    material->metallic = 0;
    material->roughness = 1;
    material->coat = coat;
    material->coat_roughness = 1;
}

static void add_material(scene_builder *builder, const char *name, float gray) {
    add_coated(builder, name, gray, 0);
}

/* A texture of 8 x 8 holes and bars. */
static void add_screen(scene_builder *builder) {
    enum { SIZE = 32 };
    scene_material *material = builder_material(builder, "screen");
    scene_texture *texture = builder_append(builder, BLOB_TEXTURES, 1);
    unsigned char *texels = builder_append(builder, BLOB_TEXELS, 4 * SIZE * SIZE);
    assert_true(material && texture && texels);
    material->metallic = 0;
    material->flags = SCENE_ALPHA_MASK | SCENE_DOUBLE_SIDED;
    material->alpha_cutoff = 0.5f;
    material->base_color_map =
        (scene_texture_use) { .texture = 0, .matrix = { 1, 0, 0, 1 }, .offset = { 0, 0 } };
    *texture = (scene_texture) { .name = "holes", .width = SIZE, .height = SIZE };
    for (int i = 0; i < SIZE * SIZE; i++) {
        memset(texels + 4 * i, 200, 3);
        texels[4 * i + 3] = i % SIZE % 4 < 2 || i / SIZE % 4 < 2 ? 255 : 0;
    }
}

/* A pierced screen that stands on the floor; it is a mesh of its own. */
static void stand_screen(scene_builder *builder) {
    static const float at[4][2] = { { -1, 0 }, { 0.6f, 0 }, { 0.6f, 1.2f }, { -1, 1.2f } };
    const uint32_t first = (uint32_t)builder_count(builder, BLOB_VERTICES);
    const size_t first_index = builder_count(builder, BLOB_INDICES);
    scene_vertex *corners = builder_append(builder, BLOB_VERTICES, 4);
    uint32_t *indices = builder_append(builder, BLOB_INDICES, 6);
    assert_true(corners && indices);
    for (int i = 0; i < 4; i++) {
        corners[i] = (scene_vertex) { .position = { at[i][0], at[i][1], -0.8f },
                                      .normal = { 0, 0, 1 },
                                      .uv = { { at[i][0], -at[i][1] } },
                                      .tangent = { 1, 0, 0, 1 } };
    }
    for (uint32_t i = 0; i < 6; i++)
        indices[i] = first + (uint32_t[]) { 0, 1, 2, 0, 2, 3 }[i];
    const size_t first_mesh = builder_count(builder, BLOB_MESHES);
    builder_mesh(builder, "screen", 2, first_index);
    builder_instances(builder, first_mesh);
}

static void open_scene(scene_builder *builder, scene *world) {
    base_error error = { "" };
    void *block;
    size_t size;
    assert_true(builder_pack(builder, &block, &size));
    builder_free(builder);
    expect(blob_validate(block, size, false, "held", &error), &error);
    expect(blob_open(block, size, "held", world, &error), &error);
    world->name = "held";
}

/* A floor with a box, three thin poles and the screen on it, before a wall. */
static void make_things(scene *world, float gray, float coat) {
    scene_builder builder = { .out_of_memory = false };
    add_coated(&builder, "floor", gray, coat);
    add_coated(&builder, "things", 0.75f * gray, coat);
    add_screen(&builder);
    scene_shaper shaper = { .builder = &builder };
    shape_quad(&shaper, vec(-3, 0, 3), vec(3, 0, 3), vec(3, 0, -3), vec(-3, 0, -3));
    shape_quad(&shaper, vec(-3, 0, -2), vec(3, 0, -2), vec(3, 3, -2), vec(-3, 3, -2));
    shaper.material = 1;
    shape_box(&shaper, vec(0.9f, 0, -0.6f), vec(1.5f, 0.7f, 0));
    for (int i = 0; i < 3; i++) {
        const float x = 0.4f * (float)i - 0.9f;
        shape_box(&shaper, vec(x, 0, 0.5f), vec(x + 0.03f, 1.1f, 0.53f));
    }
    shaper_finish(&shaper);
    stand_screen(&builder);
    open_scene(&builder, world);
}

static void make_scene(scene *world) {
    make_things(world, 0.8f, 0);
}

static const scene_camera camera = {
    .eye = { 0.3f, 1.6f, 4 }, .target = { 0.1f, 0.5f, 0 }, .up = { 0, 1, 0 }, .fov = 0.8f
};

typedef struct stage {
    scene world;
    gpu_renderer *renderer;
    render_frame frame;
} stage;

static void open_scene_stage(stage *s, void (*make)(scene *world)) {
    make(&s->world);
    s->renderer = open_renderer(&s->world);
    s->frame = frame_of(&s->world, WIDTH, HEIGHT);
    s->frame.camera = camera;
    s->frame.bands = BANDS;
    s->frame.cpu_shader = shade_frame;
}

static inline void open_stage(stage *s) {
    open_scene_stage(s, make_scene);
}

static void set_lights(stage *s, const lmp_light *lights, int count) {
    for (int i = 0; i < count; i++)
        s->world.lights[i] = (scene_light) { .emitter = lights[i], .hidden = 1 };
    s->world.light_count = s->frame.light_count = (size_t)count;
    s->frame.lights = s->world.lights;
}

static void close_stage(stage *s) {
    gpu_renderer_destroy(s->renderer);
    scene_free(&s->world);
}

static image draw_shadows(stage *s, const environment *around, const shadow_settings *settings) {
    base_error error = { "" };
    trace_bvh *bvh = trace_create(&s->world);
    shadow *all = shadow_create(&s->world, bvh, around, settings, &error);
    expect(all != NULL, &error);
    s->frame.shadow = shadow_pass(all);
    image pixels = render_image(s->renderer, &s->frame);
    s->frame.shadow = (render_pass) { .user = NULL };
    shadow_destroy(all);
    trace_destroy(bvh);
    return pixels;
}

#endif
