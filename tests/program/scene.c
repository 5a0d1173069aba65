/* SPDX-License-Identifier: MIT */
/* Scenes: what is read is what is in the files, lights keep their power, and the cache and the
 * random numbers are exact. */
#include "app/scene/scene.h"
#include "app/scene/instance.h"

#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PI 3.14159265358979
#define CHECK_NEAR(expected, actual, bound)                                                        \
    CHECK_WITHIN(fabs((double)(actual) - (double)(expected)), bound)

/* Loads a scene, from the cache if it is there already. */
static scene load_cached(const char *name) {
    scene loaded;
    base_error error = { 0 };
    if (!scene_load(name, &(scene_options) { 0 }, &loaded, &error))
        fail_msg("%s", error.text);
    return loaded;
}

/* --- files ------------------------------------------------------------------------------------ */

/* A square of side 2 in the plane z = 0, as an OBJ with one quad, without normals. */
static const char square_obj[] = "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                                 "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                 "usemtl glow\nf 1/1 2/2 3/3 4/4\n";

static void an_obj_is_read_with_its_materials(void **state) {
    (void)state;
    folder_write_text("square.obj", square_obj);
    folder_write_text("square.mtl",
                      "newmtl glow\nKd 0.5 0.25 0.125\nKs 0.1 0.1 0.1\nNs 98\nKe 2 3 4\n");
    scene s = load(in_folder("square.obj"));
    assert_int_equal(s.index_count, 6);
    assert_int_equal(s.vertex_count, 4);
    assert_unit_and_inside(&s);
    CHECK_NEAR(1.0, s.vertices[0].normal[2], 1e-6);
    const scene_material *material = &s.materials[s.meshes[0].material];
    assert_string_equal(material->name, "glow");
    CHECK_NEAR(0.25, material->base_color[1], 1e-6);
    /* Ns = 2 / roughness⁴ - 2 */
    CHECK_NEAR(98.0, 2.0 / pow((double)material->roughness, 4.0) - 2.0, 0.01);
    /* The image's v is up, the scene's is down. */
    CHECK_NEAR(1.0, s.vertices[0].uv[0][1], 1e-6);
    /* The emissive square is a light of the same shape that shines from its front. */
    assert_int_equal(s.light_count, 1);
    assert_int_equal(s.lights[0].hidden, 1);
    assert_int_equal(s.lights[0].glow, 1);
    const lmp_light *light = &s.lights[0].emitter;
    assert_int_equal(light->kind, LMP_LIGHT_RECTANGLE);
    assert_int_equal(light->two_sided, 0);
    CHECK_NEAR(1.0, light->half[0].x * light->half[1].y - light->half[0].y * light->half[1].x,
               1e-6);
    for (int k = 0; k < 3; k++)
        CHECK_NEAR(2.0 + k, (&light->radiance.r)[k], 1e-6);
    scene_free(&s);
}

/* A triangle with everything that this importer reads by itself. */
static const char full_gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,2,3]}],"
    "\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_materials_emissive_strength\"],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
    "{\"type\":\"point\",\"intensity\":100,\"color\":[1,0.5,0.25],\"extras\":{\"radius\":0.5}}]}},"
    "\"nodes\":[{\"children\":[1],\"scale\":[-2,2,2]},"
    "{\"mesh\":0,\"translation\":[1,0,0]},"
    "{\"camera\":0,\"translation\":[0,0,5]},"
    "{\"translation\":[1,2,3],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0.1}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
    "\"materials\":[{\"name\":\"m\",\"emissiveFactor\":[0.5,0.5,0.5],\"alphaMode\":\"MASK\","
    "\"alphaCutoff\":0.25,\"doubleSided\":true,"
    "\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":8}},"
    "\"pbrMetallicRoughness\":{\"metallicFactor\":0.75,\"roughnessFactor\":0.5}}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,1,0]}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

static void a_gltf_is_read_with_lights_cameras_and_mirrored_nodes(void **state) {
    (void)state;
    folder_write_text("full.gltf", full_gltf);
    scene s = load(in_folder("full.gltf"));
    assert_int_equal(s.index_count, 3);
    /* x is mirrored: -2 (1 + 0 … 1). The winding follows, so that the front still faces +z. */
    CHECK_NEAR(-4.0, s.minimum[0], 1e-6);
    CHECK_NEAR(-2.0, s.maximum[0], 1e-6);
    CHECK_NEAR(2.0, scene_area(&s), 1e-6);
    scene_vertex corners[3];
    scene_triangle(&s, 0, 0, corners);
    const float *p = corners[0].position, *q = corners[1].position, *r = corners[2].position;
    const float front = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    assert_true(front * corners[0].normal[2] > 0.0f);
    const scene_material *m = &s.materials[s.meshes[0].material];
    assert_int_equal(m->flags, SCENE_DOUBLE_SIDED | SCENE_ALPHA_MASK);
    CHECK_NEAR(0.25, m->alpha_cutoff, 1e-6);
    CHECK_NEAR(4.0, m->emission[1], 1e-6);
    CHECK_NEAR(0.75, m->metallic, 1e-6);
    assert_int_equal(s.camera_count, 1);
    CHECK_NEAR(0.5, s.cameras[0].fov, 1e-6);
    CHECK_NEAR(5.0, s.cameras[0].eye[2], 1e-6);
    assert_true(s.cameras[0].target[2] < 5.0f);
    assert_int_equal(s.light_count, 2);
    CHECK_NEAR(0.5, s.lights[0].emitter.radius, 1e-6);
    CHECK_NEAR(3.0, s.lights[0].emitter.position.z, 1e-6);
    CHECK_NEAR(50.0,
               lmp_sphere_intensity_from_radiance(s.lights[0].emitter.radiance.g,
                                                  s.lights[0].emitter.radius),
               1e-4);
    /* A double-sided lamp has twice area times pi times radiance. */
    CHECK_NEAR(2.0 * 2.0 * PI * 4.0,
               lmp_light_power_from_radiance(&s.lights[1].emitter, s.lights[1].emitter.radiance.r),
               1e-3);
    scene_free(&s);
}

/* A double-sided cube of half edge 1, glowing with radiance 10: 12 triangles, of which `indices`
 * are used. */
static const char cube_gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"mesh\":0,\"scale\":[1,2,3]}],\"extensionsUsed\":[\"KHR_materials_emissive_"
    "strength\"],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}]"
    ","
    "\"materials\":[{\"emissiveFactor\":[1,1,1],\"doubleSided\":true,\"extensions\":{"
    "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":10}}}],\"accessors\":["
    "{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\",\"min\":[-1,-1,-1],"
    "\"max\":[1,1,1]},"
    "{\"bufferView\":1,\"componentType\":5121,\"count\":%d,\"type\":\"SCALAR\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},{\"buffer\":0,\"byteOffset\":96,"
    "\"byteLength\":%d}],"
    "\"buffers\":[{\"byteLength\":132,\"uri\":\"cube.bin\"}]}";

/* Returns the power of the lights that stand for the cube's first `indices`. */
static double power_of_cube(int indices) {
    char text[sizeof cube_gltf + 16];
    snprintf(text, sizeof text, cube_gltf, indices, indices);
    folder_write_text("cube.gltf", text);
    scene s = load(in_folder("cube.gltf"));
    double power = 0;
    assert_int_equal(s.light_count, indices / 6);
    for (size_t i = 0; i < s.light_count; i++) {
        const lmp_light *light = &s.lights[i].emitter;
        assert_int_equal(light->kind, LMP_LIGHT_RECTANGLE);
        power += (double)lmp_light_power_from_radiance(light, light->radiance.r);
    }
    scene_free(&s);
    return power;
}

/* What the inside of a body emits stays inside; of an open surface both sides give light. Faces of
 * 4 x 6, 2 x 6 and 2 x 4, the last of which is left open. */
static void a_closed_lamp_lights_by_its_outside_alone(void **state) {
    (void)state;
    static const unsigned char faces[36] = { 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                             2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6 };
    unsigned char bytes[132];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            memcpy(bytes + 12 * i + 4 * k, &(float) { i >> k & 1 ? 1.0f : -1.0f }, 4);
    memcpy(bytes + 96, faces, sizeof faces);
    folder_write("cube.bin", bytes, sizeof bytes);
    CHECK_NEAR(1.0, power_of_cube(36) / (2 * (24 + 12 + 8) * PI * 10), 1e-6);
    CHECK_NEAR(1.0, power_of_cube(30) / (2 * (2 * (24 + 12) + 8) * PI * 10), 1e-6);
}

/* --- the cache -------------------------------------------------------------------------------- */

static void find_cached(char *path, size_t size) {
    const char *cache = in_folder("cache/lampion");
    DIR *listing = opendir(cache);
    assert_non_null(listing);
    int found = 0;
    for (const struct dirent *entry; (entry = readdir(listing));)
        if (entry->d_name[0] != '.') {
            snprintf(path, size, "%s/%s", cache, entry->d_name);
            found++;
        }
    closedir(listing);
    assert_int_equal(found, 1);
}

static void a_cached_scene_is_the_same_and_damage_is_noticed(void **state) {
    (void)state;
    char cached_path[1024];
    folder_write_text("square.obj", square_obj);
    folder_write_text("square.mtl", "newmtl glow\nKd 0.5 0.25 0.125\n");
    scene first = load_cached(in_folder("square.obj"));
    scene second = load_cached(in_folder("square.obj"));
    assert_false(first.cached);
    assert_true(second.cached);
    assert_int_equal(first.block_size, second.block_size);
    assert_memory_equal(first.block, second.block, first.block_size);
    scene_free(&second);
    /* After a changed byte (outside the padding) the file is imported again, and the cache
     * repaired. */
    find_cached(cached_path, sizeof cached_path);
    for (size_t at = 0; at < first.block_size; at += first.block_size / 6) {
        FILE *file = fopen(cached_path, "r+b");
        assert_non_null(file);
        fseek(file, (long)at, SEEK_SET);
        const int byte = fgetc(file);
        fseek(file, (long)at, SEEK_SET);
        fputc(byte ^ 0x55, file);
        fclose(file);
        scene mended = load_cached(in_folder("square.obj"));
        assert_false(mended.cached);
        assert_memory_equal(first.block, mended.block, first.block_size);
        scene_free(&mended);
    }
    assert_int_equal(truncate(cached_path, 100), 0);
    scene truncated = load_cached(in_folder("square.obj"));
    assert_false(truncated.cached);
    scene_free(&truncated);
    /* A file that the scene refers to changes. */
    folder_write_text("square.mtl", "newmtl glow\nKd 0.5 0.75 0.125\n");
    scene changed = load_cached(in_folder("square.obj"));
    assert_false(changed.cached);
    CHECK_NEAR(0.75, changed.materials[changed.meshes[0].material].base_color[1], 1e-6);
    scene_free(&changed);
    scene_free(&first);
}

/* --- built in --------------------------------------------------------------------------------- */

/* Checks a right-handed rotation: what was +z is +y, what was +y is -z. */
static void check_stands(const float lying[3], const float standing[3]) {
    assert_true(standing[0] == lying[0] && standing[1] == lying[2] && standing[2] == -lying[1]);
}

/* Triangles, cameras and lights are rotated alike, and the cache keeps both scenes. */
static void a_scene_whose_z_is_up_stands(void **state) {
    (void)state;
    base_error error;
    folder_write_text("lying.gltf", full_gltf);
    for (int time = 0; time < 2; time++) {
        scene lying = load_cached(in_folder("lying.gltf")), standing;
        assert_true(scene_load(in_folder("lying.gltf"), &(scene_options) { .up = SCENE_UP_Z },
                               &standing, &error));
        assert_int_equal(standing.cached, time);
        assert_unit_and_inside(&standing);
        for (uint32_t t = 0; t < scene_instance_triangles(&lying, 0); t++) {
            scene_vertex before[3], after[3];
            scene_triangle(&lying, 0, t, before);
            scene_triangle(&standing, 0, t, after);
            for (int i = 0; i < 3; i++) {
                check_stands(before[i].position, after[i].position);
                check_stands(before[i].normal, after[i].normal);
                check_stands(before[i].tangent, after[i].tangent);
                assert_true(before[i].tangent[3] == after[i].tangent[3]);
            }
        }
        assert_true(standing.minimum[1] == lying.minimum[2]);
        assert_true(standing.minimum[2] == -lying.maximum[1]);
        check_stands(lying.cameras[0].eye, standing.cameras[0].eye);
        check_stands(lying.cameras[0].target, standing.cameras[0].target);
        check_stands(lying.cameras[0].up, standing.cameras[0].up);
        assert_int_equal(standing.light_count, 2);
        for (size_t i = 0; i < 2; i++) {
            const lmp_vec3 p = lying.lights[i].emitter.position;
            const lmp_vec3 q = standing.lights[i].emitter.position;
            assert_true(q.x == p.x && q.y == p.z && q.z == -p.y);
        }
        assert_true(scene_area(&standing) == scene_area(&lying));
        scene_free(&lying);
        scene_free(&standing);
    }
}

static void built_in_scenes_are_valid(void **state) {
    (void)state;
    static const char *const names[] = { "builtin:atrium", "builtin:atrium:tiles=2,lanterns=7",
                                         "builtin:balls", "builtin:ball" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        scene s = load_cached(names[i]);
        assert_unit_and_inside(&s);
        assert_int_equal(s.camera_count, 1);
        if (i == 0) {
            assert_true(s.index_count / 3 >= 100000);
            assert_int_equal(s.light_count, 30);
        }
        if (i == 1)
            assert_int_equal(s.light_count, 7);
        scene_free(&s);
    }
}

static void many_lanterns_hang_on_strings(void **state) {
    (void)state;
    scene s = load_cached("builtin:atrium:lanterns=1000");
    assert_unit_and_inside(&s);
    assert_int_equal(s.light_count, 1000);
    for (size_t i = 30; i < s.light_count; i++) {
        const lmp_light *a = &s.lights[i].emitter;
        assert_true(a->radius <= 0.05f);
        for (size_t j = 30; j < i; j++) {
            const lmp_light *b = &s.lights[j].emitter;
            const float x = a->position.x - b->position.x, y = a->position.y - b->position.y;
            assert_true(hypotf(hypotf(x, y), a->position.z - b->position.z) >
                        a->radius + b->radius);
        }
    }
    scene_free(&s);
}

static void the_atrium_is_the_same_for_a_seed_and_another_for_another(void **state) {
    (void)state;
    scene a = load_cached("builtin:atrium:seed=5"), b = load_cached("builtin:atrium:seed=5");
    scene c = load_cached("builtin:atrium:seed=6");
    assert_int_equal(a.block_size, b.block_size);
    assert_memory_equal(a.block, b.block, a.block_size);
    assert_memory_not_equal(a.lights, c.lights, a.light_count * sizeof *a.lights);
    scene_free(&a);
    scene_free(&b);
    scene_free(&c);
}

static void an_atrium_of_less_detail_has_the_same_lights_and_walls(void **state) {
    (void)state;
    scene all = load_cached("builtin:atrium"), same = load_cached("builtin:atrium:detail=100");
    scene few = load_cached("builtin:atrium:detail=25");
    assert_int_equal(all.block_size, same.block_size);
    assert_memory_equal(all.block, same.block, all.block_size);
    assert_unit_and_inside(&few);
    assert_true(3 * few.index_count < all.index_count);
    assert_int_equal(few.light_count, all.light_count);
    assert_memory_equal(few.lights, all.lights, all.light_count * sizeof *all.lights);
    for (int k = 0; k < 3; k++)
        assert_true(few.minimum[k] == all.minimum[k] && few.maximum[k] == all.maximum[k]);
    /* what curves lose as polygons, and fluted columns as smooth ones */
    assert_true(fabs(scene_area(&few) / scene_area(&all) - 1) <= 0.02);
    scene_free(&few);
    scene_free(&same);
    scene_free(&all);
}

/* --- lights ----------------------------------------------------------------------------------- */

static void random_lights_are_the_same_everywhere(void **state) {
    (void)state;
    /* x, y, radius and green, by the same formulas in another language */
    static const float golden[3][4] = {
        { -1.92313314f, 1.69322884f, 0.0358586756f, 96.0288481f },
        { -0.684237242f, -0.598574579f, 0.0385102674f, 105.217925f },
        { 1.47786283f, 1.58333921f, 0.0537860332f, 30.5118532f },
    };
    folder_write_text("square.obj", square_obj);
    folder_write_text("square.mtl", "newmtl glow\n");
    scene s = load(in_folder("square.obj"));
    base_error error = { 0 };
    scene_clear_lights(&s);
    assert_true(scene_add_random_lights(&s, 30, 7, &error));
    assert_int_equal(s.light_count, 30);
    for (size_t i = 0; i < 3; i++) {
        const scene_light *light = &s.lights[i];
        const float found[4] = { light->emitter.position.x, light->emitter.position.y,
                                 light->emitter.radius, light->emitter.radiance.g };
        for (int k = 0; k < 4; k++)
            CHECK_NEAR(golden[i][k], found[k], 2e-6 * fabs((double)golden[i][k]));
    }
    for (size_t i = 0; i < s.light_count; i++)
        for (int k = 0; k < 3; k++) {
            assert_true((&s.lights[i].emitter.position.x)[k] >= s.minimum[k] - 1);
            assert_true((&s.lights[i].emitter.position.x)[k] <= s.maximum[k] + 1);
            assert_true((&s.lights[i].emitter.radiance.r)[k] > 0.0f);
        }
    assert_false(scene_add_random_lights(&s, SCENE_LIGHTS_MAX - 29, 7, &error));
    assert_non_null(strstr(error.text, "65537"));
    assert_int_equal(s.light_count, 30);
    scene_free(&s);
}

/* Lights take the scene's size; a point has none, and the radiance of the smallest lights
 * overflows. */
static void a_point_has_no_room_for_random_lights(void **state) {
    (void)state;
    scene s = load("builtin:ball");
    static const float sides[] = { 0, 1e-25f };
    for (size_t i = 0; i < 2; i++) {
        base_error error;
        const size_t before = s.light_count;
        for (int k = 0; k < 3; k++) {
            s.minimum[k] = 0;
            s.maximum[k] = sides[i];
        }
        assert_false(scene_add_random_lights(&s, 3, 7, &error));
        assert_non_null(strstr(error.text, "too small or too large for random lights"));
        assert_int_equal(s.light_count, before);
    }
    scene_free(&s);
}

static void asked_lights_replace_the_scene_s_own_unless_kept(void **state) {
    (void)state;
    folder_write_text("lights.json",
                      "{\"lights\":[{\"position\":[1,2,3],\"radius\":0.5,\"radiance\":[1,2,3]},"
                      "{\"position\":[0,0,0],\"radius\":2,\"power\":100},"
                      "{\"position\":[0,0,0],\"radius\":2,\"intensity\":[100,0,1]}]}");
    scene s = load_cached("builtin:ball");
    base_error error = { 0 };
    assert_int_equal(s.light_count, 10);
    scene_lights_options options = { .file = in_folder("lights.json"), .keep = true };
    assert_true(scene_apply_lights(&s, &options, &error));
    assert_int_equal(s.light_count, 13);
    options.keep = false;
    options.random_count = 4;
    assert_true(scene_apply_lights(&s, &options, &error));
    assert_int_equal(s.light_count, 7);
    CHECK_NEAR(2.0, s.lights[0].emitter.radiance.g, 0.0);
    CHECK_NEAR(100.0, lmp_sphere_power_from_radiance(s.lights[1].emitter.radiance.b, 2.0f), 1e-4);
    CHECK_NEAR(100.0, lmp_sphere_intensity_from_radiance(s.lights[2].emitter.radiance.r, 2.0f),
               1e-4);
    assert_true(scene_light_is_drawn(&s.lights[0]));
    options.hide = true;
    assert_true(scene_apply_lights(&s, &options, &error));
    for (size_t n = 0; n < s.light_count; n++)
        assert_false(scene_light_is_drawn(&s.lights[n]));
    scene_free(&s);
}

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder) || mkdir(in_folder("cache"), 0700) != 0)
        return -1;
    return setenv("XDG_CACHE_HOME", in_folder("cache"), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_obj_is_read_with_its_materials),
        cmocka_unit_test(a_gltf_is_read_with_lights_cameras_and_mirrored_nodes),
        cmocka_unit_test(a_closed_lamp_lights_by_its_outside_alone),
        cmocka_unit_test(a_cached_scene_is_the_same_and_damage_is_noticed),
        cmocka_unit_test(a_scene_whose_z_is_up_stands),
        cmocka_unit_test(built_in_scenes_are_valid),
        cmocka_unit_test(many_lanterns_hang_on_strings),
        cmocka_unit_test(the_atrium_is_the_same_for_a_seed_and_another_for_another),
        cmocka_unit_test(an_atrium_of_less_detail_has_the_same_lights_and_walls),
        cmocka_unit_test(random_lights_are_the_same_everywhere),
        cmocka_unit_test(a_point_has_no_room_for_random_lights),
        cmocka_unit_test(asked_lights_replace_the_scene_s_own_unless_kept),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
