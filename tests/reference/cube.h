/* SPDX-License-Identifier: MIT */
/* cube.h - closed rooms in which what every bounce adds is known. */
#ifndef LAMPION_TESTS_CUBE_H
#define LAMPION_TESTS_CUBE_H

#include "app/truth/reference.h"
#include "tests/oracle/check.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <string.h>

enum { SIDE = 8, PIXELS = SIDE * SIDE };

/* A cube from -1 to 1, seen from inside, whose floor has a material of its own. Its sides overlap a
 * little and share no corners: a reader turns what is closed inside out. */
static const char cube_obj[] =
    "mtllib room.mtl\nusemtl wall\n"
    "v -1 -1.01 -1.01\nv -1 1.01 -1.01\nv -1 1.01 1.01\nv -1 -1.01 1.01\nf 1 2 3 4\n"
    "v 1 -1.01 1.01\nv 1 1.01 1.01\nv 1 1.01 -1.01\nv 1 -1.01 -1.01\nf 5 6 7 8\n"
    "v 1.01 1 -1.01\nv 1.01 1 1.01\nv -1.01 1 1.01\nv -1.01 1 -1.01\nf 9 10 11 12\n"
    "v -1.01 -1.01 -1\nv 1.01 -1.01 -1\nv 1.01 1.01 -1\nv -1.01 1.01 -1\nf 13 14 15 16\n"
    "v -1.01 1.01 1\nv 1.01 1.01 1\nv 1.01 -1.01 1\nv -1.01 -1.01 1\nf 17 18 19 20\n"
    "usemtl floor\n"
    "v -1.01 -1 -1.01\nv -1.01 -1 1.01\nv 1.01 -1 1.01\nv 1.01 -1 -1.01\nf 21 22 23 24\n";

/* A floor and a ceiling that both face up. */
static const char sheets_obj[] = "mtllib room.mtl\nusemtl floor\n"
                                 "v -9 -1 -9\nv -9 -1 9\nv 9 -1 9\nv 9 -1 -9\n"
                                 "v -9 1 -9\nv -9 1 9\nv 9 1 9\nv 9 1 -9\n"
                                 "f 1 2 3 4\nf 5 6 7 8\n";
static const char room_mtl[] = "newmtl wall\nKd 1 1 1\nKs 0 0 0\nNs 0\n%s"
                               "newmtl floor\nKd 1 1 1\nKs 0 0 0\nNs 0\n%s";

typedef struct room {
    scene world;
    scene_material materials[8];
    scene_light light, *lights_of_file;
    reference_settings settings;
} room;

/* Opens the room with walls that reflect as Lambert's law says, and emit what OBJ's Ke says. */
static inline void open_room(const char *obj, const char *emission, double albedo, room *r) {
    char mtl[400];
    snprintf(mtl, sizeof mtl, room_mtl, emission, emission);
    folder_write_text("room.mtl", mtl);
    folder_write_text("room.obj", obj);
    r->world = load(in_folder("room.obj"));
    assert_true(r->world.material_count <= 8);
    memcpy(r->materials, r->world.materials, r->world.material_count * sizeof *r->materials);
    for (size_t i = 0; i < r->world.material_count; i++) {
        r->materials[i].flags = 0;
        r->materials[i].f90 = 0;
        for (int c = 0; c < 3; c++) {
            r->materials[i].base_color[c] = (float)albedo;
            r->materials[i].f0[c] = 0;
        }
    }
    r->world.materials = r->materials;
    r->lights_of_file = NULL;
    r->settings = (reference_settings) {
        .width = SIDE,
        .height = SIDE,
        .camera = { .eye = { 0, 0.3f, 0.6f },
                    .target = { 0.1f, -0.4f, -1 },
                    .up = { 0, 1, 0 },
                    .fov = 1.5f },
        .samples = 512,
        .seed = 3,
        .shadows = true,
    };
}

/* Replaces the lights by another. */
static inline void light_by(room *r, const scene_light *light) {
    r->light = *light;
    r->lights_of_file = r->world.lights;
    r->world.lights = &r->light;
    r->world.light_count = 1;
}

/* Lets radiance 1 come from all directions, without shadows. */
static inline void light_evenly(room *r) {
    const scene_light even = { .emitter = { .kind = LMP_LIGHT_HEMISPHERE,
                                            .direction = { 0, 1, 0 },
                                            .radiance = { 1, 1, 1 },
                                            .ground = { 1, 1, 1 } } };
    light_by(r, &even);
    r->settings.shadows = false;
}

static inline void close_room(room *r) {
    if (r->lights_of_file)
        r->world.lights = r->lights_of_file;
    scene_free(&r->world);
}

#endif
