/* SPDX-License-Identifier: MIT */
/* A plate of a glTF material under one sphere light: its image against glTF 2.0, appendix B,
 * integrated over the light in double precision; and how exactly its material comes through. */
#include "app/base/timing.h"
#include "app/render/shade.h"
#include "tests/gpu/device.h"
#include "tests/oracle/check.h"
#include "tests/oracle/gltf.h"
#include "tests/oracle/placed.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 24, HEIGHT = 16 };

/* A square in y = 0, and above it a light that the camera would see in the middle of the plate if
 * that were a mirror. */
typedef struct plate {
    scene_vertex vertices[4];
    uint32_t indices[6];
    scene_mesh mesh;
    scene_material material;
    scene_light light;
    scene world;
    render_frame frame;
} plate;

static void lay_plate(plate *p, double view, double ratio) {
    static const uint32_t order[6] = { 0, 1, 2, 0, 2, 3 };
    static const float corners[4][2] = { { -1, 1 }, { 1, 1 }, { 1, -1 }, { -1, -1 } };
    const float sine = (float)sin(view), cosine = (float)cos(view), size = 60;
    *p = (plate) {
        .mesh = { .index_count = 6, .minimum = { -size, 0, -size }, .maximum = { size, 0, size } },
        .material = scene_material_plain(),
        .light = { .emitter = { .position = { 6 * sine, 6 * cosine, 0 },
                                .radius = 6 * (float)ratio,
                                .radiance = { 1, 1, 1 } },
                   .hidden = 1 }
    };
    memcpy(p->indices, order, sizeof order);
    for (int i = 0; i < 4; i++)
        p->vertices[i] =
            (scene_vertex) { .position = { size * corners[i][0], 0, size * corners[i][1] },
                             .normal = { 0, 1, 0 },
                             .tangent = { 1, 0, 0, 1 } };
    p->world = (scene) { .vertices = p->vertices,
                         .indices = p->indices,
                         .meshes = &p->mesh,
                         .instances = placed_meshes(1),
                         .materials = &p->material,
                         .vertex_count = 4,
                         .index_count = 6,
                         .mesh_count = 1,
                         .instance_count = 1,
                         .material_count = 1,
                         .lights = &p->light,
                         .light_count = 1,
                         .minimum = { -size, 0, -size },
                         .maximum = { size, 0, size },
                         .name = "plate" };
    p->frame = (render_frame) {
        .width = WIDTH,
        .height = HEIGHT,
        .camera = { .eye = { -8 * sine, 8 * cosine, 0 }, .up = { cosine, sine, 0 }, .fov = 0.8f },
        .bands = LMP_BANDS_MAX,
        .lights = &p->light,
        .light_count = 1,
        .cpu_shader = shade_frame
    };
}

/* --- as the specification says ---------------------------------------------------------------- */

/* Finds where the ray through a pixel's center meets y = 0, and the direction from there to the
 * eye; returns false where it does not. */
static bool look(const plate *p, int x, int y, double at[3], double to_eye[3]) {
    const scene_camera *camera = &p->frame.camera;
    const double top = tan((double)camera->fov / 2), length = 8;
    const double across = top * (2 * (x + 0.5) - WIDTH) / HEIGHT;
    const double along = top * (1 - 2 * (y + 0.5) / HEIGHT);
    double ray[3], norm = 0;
    for (int k = 0; k < 3; k++) {
        const double right = k == 2; /* forward x up */
        ray[k] = -(double)camera->eye[k] / length + along * (double)camera->up[k] + across * right;
        norm += ray[k] * ray[k];
    }
    const double distance = -(double)camera->eye[1] / ray[1];
    for (int k = 0; k < 3; k++) {
        at[k] = (double)camera->eye[k] + distance * ray[k];
        to_eye[k] = -ray[k] / sqrt(norm);
    }
    return ray[1] < 0 && fabs(at[0]) < 50 && fabs(at[2]) < 50;
}

/* Returns the exact radiance of a metal with a gray base, or of the dielectric. */
static double exact(const plate *p, const double at[3], const double to_eye[3]) {
    const lmp_light *light = &p->light.emitter;
    const bool metal = p->material.metallic > 0.5f;
    const double base = (double)p->material.base_color[0];
    const oracle_gltf surface = { pow((double)p->material.roughness, 2), acos(to_eye[1]),
                                  metal ? base : 0.04, 1, metal ? 0 : base };
    const double v[3] = { (double)light->position.x - at[0], (double)light->position.y,
                          (double)light->position.z - at[2] };
    const double d = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double flat = fmax(hypot(to_eye[0], to_eye[2]), 1e-9);
    /* x on the mirror side */
    const double x[2] = { -to_eye[0] / flat, -to_eye[2] / flat };
    const double middle[3] = { (v[0] * x[0] + v[2] * x[1]) / d, (v[2] * x[0] - v[0] * x[1]) / d,
                               v[1] / d };
    return d > 1.001 * (double)light->radius
               ? oracle_gltf_cap(&surface, middle, asin((double)light->radius / d))
               : -1;
}

typedef struct apart {
    double rms, largest; /* relative to the peak */
    double energy;       /* energy of the image relative to the exact one's */
} apart;

static apart compare(const plate *p) {
    gpu_renderer *renderer = open_renderer(&p->world);
    image drawn = render_image(renderer, &p->frame);
    double peak = 0, squares = 0, largest = 0, sums[2] = { 0, 0 };
    int count = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double at[3], to_eye[3];
            if (!look(p, x, y, at, to_eye))
                continue;
            const double expected = exact(p, at, to_eye);
            const double actual = (double)drawn.rgb[3 * (y * WIDTH + x)];
            if (expected < 0)
                continue;
            const double error = fabs(actual - expected);
            largest = error <= largest ? largest : error;
            peak = fmax(peak, expected);
            squares += error * error;
            sums[0] += expected;
            sums[1] += actual;
            count++;
        }
    image_free(&drawn);
    gpu_renderer_destroy(renderer);
    return (apart) { sqrt(squares / count) / peak, largest / peak, sums[1] / sums[0] };
}

/* Roughnesses of the plate; at lower ones 128 bands do not hold the highlight of the smallest
 * light. */
static const double plate_roughnesses[] = { 0.4, 1, 0.7, 0.55, 0.85 };
static const double plate_views[] = { 0, 50, 80 };
static const double plate_ratios[] = { 0.8, 0.05, 0.2, 0.1, 0.4 };

static void plates_look_as_the_specification_says(void **state) {
    (void)state;
    check_errors all = { 0 };
    for (int r = 0; r < check_count(3, 5); r++) {
        print_message("| %.2f |", plate_roughnesses[r]);
        for (int i = 0; i < 6; i++) {
            apart worst = { 0, 0, 1 };
            for (int k = 0; k < check_count(2, 5); k++) {
                plate p;
                lay_plate(&p, plate_views[i % 3] * 3.14159265358979 / 180, plate_ratios[k]);
                p.material.metallic = i < 3 ? 1 : 0;
                p.material.roughness = (float)plate_roughnesses[r];
                for (int c = 0; c < 3; c++)
                    p.material.base_color[c] = i < 3 ? 0.9f : 0.5f;
                const apart d = compare(&p);
                check_errors_add(&all, d.rms);
                worst.rms = fmax(worst.rms, d.rms);
                worst.largest = fmax(worst.largest, d.largest);
                worst.energy =
                    fabs(d.energy - 1) > fabs(worst.energy - 1) ? d.energy : worst.energy;
            }
            print_message(" %.3f %.2f %.3f |", worst.rms, worst.largest, worst.energy);
            CHECK_WITHIN(worst.rms, 0.04);
            CHECK_WITHIN(worst.largest, i % 3 < 2 ? 0.15 : 0.4);
            CHECK_WITHIN(fabs(worst.energy - 1), 0.1);
        }
        print_message("\n");
    }
    print_message("rms of %ld plates: %.4f\n", all.count, check_errors_rms(&all));
    CHECK_WITHIN(check_errors_rms(&all), 0.02);
}

/* --- what comes through ----------------------------------------------------------------------- */

static lmp_material seen_by_cpu;
static lmp_rgb emitted_to_cpu;

static bool keep_material(const render_frame *frame, const render_surfaces *surfaces, float *rgba,
                          base_error *error) {
    (void)error;
    render_tile row;
    assert_true(render_tile_create(frame->width, &row));
    render_surfaces_tile(surfaces, 0, frame->height / 2, frame->width, 1, &row);
    seen_by_cpu = row.material[frame->width / 2];
    emitted_to_cpu = render_surfaces_emission(
        surfaces, (size_t)(frame->height / 2) * (size_t)frame->width + (size_t)frame->width / 2);
    render_tile_free(&row);
    memset(rgba, 0, 4 * sizeof *rgba * (size_t)frame->width * (size_t)frame->height);
    return true;
}

static void check_material(const lmp_material *m, const scene_material *from) {
    assert_int_equal(m->kind, LMP_MATERIAL_METALLIC_ROUGHNESS);
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabsf((&m->base_color.r)[c] / from->base_color[c] - 1), 1e-3);
    CHECK_WITHIN(fabsf(m->metallic - from->metallic), 1e-5);
    CHECK_WITHIN(fabsf(m->roughness - from->roughness), 1e-5);
    assert_true(m->dielectric.given); /* defaults: index 1.5, no tint, coat or sheen */
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabsf((&m->dielectric.f0.r)[c] - 0.04f), 1e-6);
    CHECK_WITHIN(fabsf(m->dielectric.f90 - 1), 1e-6);
    CHECK_WITHIN(m->coat.weight, 0);
}

/* Checks emission kept in floats of 11 bits, and blue in 10. */
static void check_emission(lmp_rgb seen, const float emission[3]) {
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabsf((&seen.r)[c] / emission[c] - 1), c < 2 ? 1.0 / 64 : 1.0 / 32);
}

/* Checks albedos from 0.0005 to 1, roughnesses that are multiples of 0.0005, and emissions of 1e-3
 * to 1e4, on both devices. */
static void materials_come_through_exactly(void **state) {
    (void)state;
    const int count = check_count(20, 200), step = 2000 / count;
    for (int i = 0; i < count; i++) {
        const float last = (float)(3 * count - 1);
        plate p;
        lay_plate(&p, 0.5, 0.2);
        for (int c = 0; c < 3; c++)
            p.material.base_color[c] = 0.0005f * powf(2000, (float)(3 * i + c) / last);
        p.material.metallic = (float)i / (float)(count - 1);
        p.material.roughness = 0.0005f * (float)(step * i + 7 * i % step + 1);
        for (int c = 0; c < 3; c++)
            p.material.emission[c] =
                1e-3f * powf(1e7f, (float)((3 * i + 17 * c) % (3 * count)) / last);
        p.frame.cpu_shader = keep_material;
        gpu_renderer *renderer = open_renderer(&p.world);
        render_pixel *pixels = render_pixels(renderer, &p.frame);
        check_material(&pixels[HEIGHT / 2 * WIDTH + WIDTH / 2].material, &p.material);
        check_material(&seen_by_cpu, &p.material);
        check_emission(pixels[HEIGHT / 2 * WIDTH + WIDTH / 2].emission, p.material.emission);
        check_emission(emitted_to_cpu, p.material.emission);
        free(pixels);
        gpu_renderer_destroy(renderer);
    }
}

/* However long they take, the passes of a frame come one after another, and all within its time. */
static void passes_take_no_longer_than_their_frame(void **state) {
    (void)state;
    plate p;
    lay_plate(&p, 0.5, 0.2);
    gpu_renderer *renderer = open_renderer(&p.world);
    base_error error = { "" };
    for (int samples = 1; samples <= 4; samples += 3) {
        render_times times = { 0 };
        p.frame.samples = samples;
        const double began = timing_now();
        expect(gpu_render(renderer, &p.frame, &times, &error), &error);
        const double all = 1000 * (timing_now() - began);
        assert_true(times.surfaces >= 0 && times.shade >= 0 && times.total > 0);
        CHECK_WITHIN(times.surfaces + times.shade, times.total * 1.001 + 0.01);
        CHECK_WITHIN(times.surfaces + times.shade, all + 0.01);
    }
    gpu_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_come_through_exactly),
        cmocka_unit_test(passes_take_no_longer_than_their_frame),
        cmocka_unit_test(plates_look_as_the_specification_says),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
