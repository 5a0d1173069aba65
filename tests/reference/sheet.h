/* SPDX-License-Identifier: MIT */
/* sheet.h - a glTF file of one square that fills an orthographic view, with a material to choose,
 * drawn by both devices and by the ground truth. */
#ifndef LAMPION_TESTS_SHEET_H
#define LAMPION_TESTS_SHEET_H

#include "app/render/renderer/renderer.h"
#include "app/scene/environment.h"
#include "app/truth/reference.h"
#include "tests/program/folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SHEET_SIDE = 8, SHEET_SAMPLES = 4096 };
enum { SHEET_GPU, SHEET_CPU, SHEET_REFERENCE, SHEET_IMAGES };

/* From -1 to 1 in x and y, at z = 0, seen from +z, and once more behind it at z = -1. Texture 0 has
 * two texels, the halves of the square: red, green, blue and alpha of 0.2, 0.4, 1 and 0.4 on the
 * left, white on the right; texture 1 four: red and green above, blue and white below. The second
 * set of coordinates is the first with u and v exchanged. */
static const char sheet_gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],"
    "\"extensionsUsed\":[\"KHR_materials_specular\",\"KHR_materials_ior\"],"
    "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"translation\":[0,0,5]},"
    "{\"mesh\":0,\"translation\":[0,0,-1]}],"
    "\"cameras\":[{\"type\":\"orthographic\","
    "\"orthographic\":{\"xmag\":1,\"ymag\":1,\"znear\":0.1,\"zfar\":9}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_1\":"
    "3},\"indices\":2,"
    "\"material\":0}]}],\"materials\":[%s],"
    "\"textures\":[{\"source\":0,\"sampler\":0},{\"source\":1,\"sampler\":0}],"
    "\"samplers\":[{\"wrapS\":33071,\"wrapT\":33071}],"
    "\"images\":[{\"uri\":\"data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR42mMwTvuf9h8IABZZBftaHCSxAAAAAElFTkSu"
    "QmCC\"},{\"uri\":\"data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3"
    "AAAAAElFTkSuQmCC\"}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\","
    "\"min\":[-1,-1,0],\"max\":[1,1,0]},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
    "{\"bufferView\":2,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"},"
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":32},"
    "{\"buffer\":0,\"byteOffset\":80,\"byteLength\":12},"
    "{\"buffer\":0,\"byteOffset\":92,\"byteLength\":32}],"
    "\"buffers\":[{\"byteLength\":124,\"uri\":\"data:application/octet-stream;base64,"
    "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAAAAAAAgD8AAIA/AACA"
    "PwAAgD8AAAAAAAAAAAAAAAAAAAEAAgAAAAIAAwAAAIA/AAAAAAAAgD8AAIA/AAAAAAAAgD8AAAAAAAAAAA==\"}]}";

typedef struct sheet {
    scene world;
    render_device devices[2]; /* SHEET_GPU, SHEET_CPU */
    any_renderer *renderers[2];
    environment sky; /* white all around */
} sheet;

static inline void sheet_expect(bool ok, const base_error *error) {
    if (!ok)
        fail_msg("%s", error->text);
}

/* Opens the sheet; `material` is the JSON of its only material. */
static inline void sheet_open(sheet *s, const char *material) {
    base_error error = { "" };
    char text[4096];
    snprintf(text, sizeof text, sheet_gltf, material);
    folder_write_text("sheet.gltf", text);
    *s = (sheet) { .sky.azimuth = 0 };
    sheet_expect(scene_load(in_folder("sheet.gltf"), &(scene_options) { .no_cache = true },
                            &s->world, &error),
                 &error);
    sheet_expect(image_create(&s->sky.light, 64, 32, &error), &error);
    for (int i = 0; i < 3 * 64 * 32; i++)
        s->sky.light.rgb[i] = 1;
    sheet_expect(environment_project(&s->sky, LMP_SHADE_BANDS_DEFAULT, &error), &error);
    for (int i = SHEET_GPU; i <= SHEET_CPU; i++) {
        const device_kind kind = i == SHEET_GPU ? DEVICE_GPU : DEVICE_CPU;
        sheet_expect(render_device_open(kind, check_gl_device(), &s->world, &s->devices[i], &error),
                     &error);
        s->renderers[i] = renderer_create(&s->devices[i], &error);
        sheet_expect(s->renderers[i], &error);
    }
}

static inline void sheet_close(sheet *s) {
    for (int i = SHEET_GPU; i <= SHEET_CPU; i++) {
        renderer_destroy(s->renderers[i]);
        render_device_close(&s->devices[i]);
    }
    environment_free(&s->sky);
    scene_free(&s->world);
}

/* Draws the sheet under the sky, or under the scene's lights. The caller frees the images and the
 * ground truth's standard error. */
static inline void sheet_draw(sheet *s, bool under_sky, int samples, image images[SHEET_IMAGES],
                              image *standard_error) {
    base_error error = { "" };
    const render_frame frame = { .width = SHEET_SIDE,
                                 .height = SHEET_SIDE,
                                 .camera = s->world.cameras[0],
                                 .bands = LMP_SHADE_BANDS_DEFAULT,
                                 .lights = s->world.lights,
                                 .light_count = s->world.light_count,
                                 .samples = samples };
    for (int device = SHEET_GPU; device <= SHEET_CPU; device++) {
        any_renderer *renderer = s->renderers[device];
        renderer_set_environment(renderer, under_sky ? &s->sky : NULL);
        sheet_expect(renderer_draw(renderer, &frame, NULL, &error), &error);
        sheet_expect(renderer_read_image(renderer, &images[device], &error), &error);
    }
    const reference_settings settings = { .width = SHEET_SIDE,
                                          .height = SHEET_SIDE,
                                          .camera = s->world.cameras[0],
                                          .samples = SHEET_SAMPLES,
                                          .environment = under_sky ? &s->sky : NULL };
    sheet_expect(
        reference_render(&s->world, &settings, &images[SHEET_REFERENCE], standard_error, &error),
        &error);
}

/* Returns a channel of a pixel in the middle of the left half (0) or the right half (1). */
static inline double sheet_at(const image *drawn, int half, int channel) {
    const int x = half ? SHEET_SIDE - 2 : 1, y = SHEET_SIDE / 2;
    return (double)drawn->rgb[3 * (y * SHEET_SIDE + x) + channel];
}

static inline void sheet_free(image images[SHEET_IMAGES], image *standard_error) {
    for (int i = 0; i < SHEET_IMAGES; i++)
        image_free(&images[i]);
    image_free(standard_error);
}

static inline int sheet_folder(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

#endif
