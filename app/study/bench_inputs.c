/* SPDX-License-Identifier: MIT */
#include "app/study/bench_inputs.h"

#include <math.h>
#include <stdlib.h>

static float uniform(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

/* Makes lights of all kinds: a sun, a sky, six spots, twelve points and as many spheres, in
 * turn. */
static void kinds_create(bench_inputs *in) {
    static const lmp_light_kind kinds[] = { LMP_LIGHT_SPHERE, LMP_LIGHT_POINT };
    for (int i = 0; i < BENCH_LIGHTS; i++) {
        lmp_light *light = &in->kinds[i];
        *light = in->lights[i];
        light->kind = i == 0       ? LMP_LIGHT_DIRECTIONAL
                      : i == 1     ? LMP_LIGHT_HEMISPHERE
                      : i % 5 == 4 ? LMP_LIGHT_SPOT
                                   : kinds[i % 2];
        light->direction = (lmp_vec3) { in->axis[0][i], in->axis[1][i], in->axis[2][i] };
        light->inner = 0.5f;
        light->outer = 2;
    }
}

static lmp_vec3 scaled(lmp_vec3 v, float factor) {
    return (lmp_vec3) { factor * v.x, factor * v.y, factor * v.z };
}

/* Makes rectangles around the spheres' positions that face the points; the same forty times as far;
 * through the points' floor, whose surfaces look up and aside; and disks and tubes. */
static void areas_create(bench_inputs *in) {
    for (int i = 0; i < BENCH_LIGHTS; i++) {
        const lmp_vec3 at = in->lights[i].position;
        const float flat = sqrtf(at.x * at.x + at.y * at.y),
                    far = sqrtf(at.x * at.x + at.y * at.y + at.z * at.z);
        const lmp_vec3 x = { at.y / flat, -at.x / flat, 0 };
        const lmp_vec3 y = { x.y * at.z / far, -x.x * at.z / far, (x.x * at.y - x.y * at.x) / far };
        const float size = 0.2f * far;
        const lmp_light light = { .kind = LMP_LIGHT_RECTANGLE,
                                  .position = at,
                                  .half = { scaled(x, size), scaled(y, size) },
                                  .two_sided = true,
                                  .radiance = in->lights[i].radiance };
        in->areas.large[i] = in->areas.small[i] = in->areas.cut[i] = light;
        in->areas.small[i].position = scaled(at, 40);
        in->areas.cut[i].position = (lmp_vec3) { at.x, at.y, 0 };
        in->areas.disk[i] = light;
        in->areas.disk[i].kind = LMP_LIGHT_DISK;
        in->areas.disk[i].direction = scaled(at, -1 / far);
        in->areas.disk[i].radius = size;
        in->areas.tube[i] = light;
        in->areas.tube[i].kind = LMP_LIGHT_TUBE;
        in->areas.tube[i].two_sided = false;
        in->areas.tube[i].radius = 0.1f * size;
        in->areas.tube_small[i] = in->areas.tube[i];
        in->areas.tube_small[i].position = scaled(at, 40);
    }
}

bool bench_inputs_create(bench_inputs *in) {
    const size_t values =
        12 * (size_t)BENCH_OUTPUT_FLOATS + 16 * 12 * LMP_SH_COUNT(LMP_BANDS_MAX) * 4;
    uint32_t state = 1;
    for (int i = 0; i < BENCH_ELEMENTS_MAX; i++) {
        float length = 0;
        for (int k = 0; k < 3; k++) {
            in->point[k][i] = uniform(&state);
            in->center[k][i] = 2 + 3 * uniform(&state);
            in->axis[k][i] = 2 * uniform(&state) - 1;
            in->radiance[k][i] = 1 + uniform(&state);
            length += in->axis[k][i] * in->axis[k][i];
        }
        for (int k = 0; k < 3; k++)
            in->axis[k][i] /= sqrtf(length);
        in->radius[i] = 0.05f + 0.5f * uniform(&state);
        in->distance[i] = 1 + 3 * uniform(&state);
    }
    for (int i = 0; i < BENCH_ELEMENTS_MAX; i++) {
        /* both axes are on the lights' side, where a surface sees most of them */
        const float x = uniform(&state), y = uniform(&state), z = 0.1f + uniform(&state);
        const float length = sqrtf(x * x + y * y + z * z);
        in->normal[0][i] = x / length;
        in->normal[1][i] = y / length;
        in->normal[2][i] = z / length;
        float facing = 0;
        for (int k = 0; k < 3; k++)
            facing += in->normal[k][i] * in->axis[k][i];
        for (int k = 0; k < 3 && facing < 0; k++) /* the surface is seen from its front */
            in->axis[k][i] = -in->axis[k][i];
        const lmp_rgb color = { in->radiance[0][i], in->radiance[1][i], in->radiance[2][i] };
        in->phong[i] = (lmp_material) { .diffuse = color, .specular = color, .exponent = 20 };
        in->ggx[i] = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                      .base_color = color,
                                      .metallic = 0.5f,
                                      .roughness = 0.5f };
    }
    for (int i = 0; i < BENCH_LIGHTS; i++)
        in->lights[i] =
            (lmp_light) { .position = { in->center[0][i], in->center[1][i], in->center[2][i] },
                          .radius = in->radius[i],
                          .radiance = { in->radiance[0][i], in->radiance[1][i],
                                        in->radiance[2][i] } };
    kinds_create(in);
    areas_create(in);
    lmp_lobe_make_phong(LMP_BANDS_MAX, 20, in->lambda);
    in->out = aligned_alloc(64, values * sizeof(float));
    in->vectors = aligned_alloc(64, values * sizeof(float));
    in->matrices = malloc(LMP_SH_ROTATION_COUNT(LMP_BANDS_MAX) * sizeof(float));
    in->scratch = aligned_alloc(LMP_SCRATCH_ALIGNMENT, LMP_SCRATCH_SIZE);
    if (!in->out || !in->vectors || !in->matrices || !in->scratch)
        return false;
    for (size_t i = 0; i < values; i++) {
        in->out[i] = 0;
        in->vectors[i] = uniform(&state);
    }
    lmp_sh_make_rotation(LMP_BANDS_MAX, (lmp_quat) { 0.5f, 0.5f, -0.5f, 0.5f }, in->matrices);
    return true;
}

void bench_inputs_free(bench_inputs *in) {
    free(in->out);
    free(in->vectors);
    free(in->matrices);
    free(in->scratch);
}

static lmp_vec3_array planes_of(float (*planes)[BENCH_ELEMENTS_MAX]) {
    return (lmp_vec3_array) { planes[0], planes[1], planes[2], sizeof(float) };
}

/* Returns a batch with as many elements as keep the output in the first cache: a multiple of 48
 * lanes or of 16. */
bench_batch bench_batch_of(bench_inputs *in, const bench_kernel *kernel, int bands,
                           lmp_sh_layout layout) {
    const size_t values = kernel->values(bands), fit = BENCH_OUTPUT_FLOATS / values;
    bench_batch b = { .bands = bands, .layout = layout };
    b.count = fit >= BENCH_ELEMENTS_MAX ? BENCH_ELEMENTS_MAX
              : fit >= 48               ? fit / 48 * 48
              : fit >= 32               ? 32
                                        : 16;
    /* an odd number of cache lines, because planes at a distance of a power of two share cache
     * sets */
    b.stride =
        sizeof(float) *
        (layout == LMP_SH_PLANAR ? (b.count / 16 | 1) * 16 + (b.count / 16 % 2 ? 32 : 0) : values);
    b.axes = planes_of(in->axis);
    b.points = planes_of(in->point);
    b.spheres = (lmp_spheres) { planes_of(in->center),
                                { in->radius, sizeof(float) },
                                planes_of(in->radiance) };
    b.distances = in->distance;
    b.lambda = in->lambda;
    b.matrices = in->matrices;
    b.vectors = in->vectors;
    b.scratch = (lmp_scratch) { in->scratch, LMP_SCRATCH_SIZE };
    b.out = in->out;
    b.lights = in->lights;
    b.kinds = in->kinds;
    b.areas = &in->areas;
    b.lobe = in->lobes;
    b.field = in->field;
    b.surfaces = (lmp_surfaces) { .position = b.points,
                                  .normal = planes_of(in->normal),
                                  .view = b.axes,
                                  .material = kernel->ggx ? in->ggx : in->phong,
                                  .material_stride = sizeof *in->phong };
    if (kernel->table == BENCH_TABLE_BRDF) {
        in->tabulated = (lmp_material) { .kind = LMP_MATERIAL_TABLE,
                                         .table = in->table,
                                         .preintegrated = in->preintegrated };
        b.surfaces.material = &in->tabulated;
        b.surfaces.material_stride = 0;
    }
    return b;
}

/* --- outputs larger than the first cache ------------------------------------------------------ */

static const float *repeated(const float *from, size_t count, float *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = from[i % BENCH_ELEMENTS_MAX];
    return to;
}

static lmp_vec3_array vectors_repeated(lmp_vec3_array from, size_t count, float *to) {
    return (lmp_vec3_array) { repeated(from.x, count, to), repeated(from.y, count, to + count),
                              repeated(from.z, count, to + 2 * count), sizeof(float) };
}

bool bench_large_create(bench_inputs *in, const bench_kernel *kernel, int bands,
                        lmp_sh_layout layout, size_t bytes, bench_large *large) {
    bench_batch *b = &large->batch;
    *b = bench_batch_of(in, kernel, bands, layout);
    const size_t values = kernel->values(bands);
    b->count = (bytes / sizeof(float) / values / 16 | 1) * 16;
    b->stride = sizeof(float) * (layout == LMP_SH_PLANAR ? b->count : values);
    large->inputs = aligned_alloc(64, 10 * b->count * sizeof(float));
    large->out = aligned_alloc(64, values * b->count * sizeof(float));
    if (!large->inputs || !large->out)
        return false;
    float *to = large->inputs;
    b->axes = vectors_repeated(b->axes, b->count, to);
    b->points = vectors_repeated(b->points, b->count, to + 3 * b->count);
    b->spheres.center = vectors_repeated(b->spheres.center, b->count, to + 6 * b->count);
    b->spheres.radius.at = repeated(b->spheres.radius.at, b->count, to + 9 * b->count);
    for (size_t i = 0; i < values * b->count; i++)
        large->out[i] = 0;
    b->out = large->out;
    return true;
}

void bench_large_free(bench_large *large) {
    free(large->inputs);
    free(large->out);
}

/* --- tables ----------------------------------------------------------------------------------- */

void bench_tables_free(bench_inputs *in) {
    lmp_preintegrated_lobe_destroy(in->lobes);
    lmp_preintegrated_brdf_destroy(in->preintegrated);
    lmp_brdf_table_destroy(in->table);
    lmp_field_destroy(in->field);
    in->lobes = NULL;
    in->field = NULL;
    in->preintegrated = NULL;
    in->table = NULL;
}

static bool brdf_create(int bands, bench_inputs *in) {
    const lmp_brdf_table_desc desc = { .bands = bands };
    lmp_sgd sgd;
    lmp_brdf *brdf;
    if (lmp_brdf_find_sgd("gold-metallic-paint", &sgd) != LMP_OK ||
        lmp_brdf_create_sgd(NULL, &sgd, &brdf) != LMP_OK)
        return false;
    const bool made =
        lmp_brdf_table_create(NULL, &desc, brdf, &in->table) == LMP_OK &&
        lmp_preintegrated_brdf_create(NULL, NULL, in->table, &in->preintegrated) == LMP_OK;
    lmp_brdf_destroy(brdf);
    return made;
}

/* Makes a field around the points and the lights, which are near some of the nodes and few of the
 * points. */
static bool field_create(int bands, bench_inputs *in) {
    const float cell = 5.0f / (BENCH_FIELD_ROWS - 1);
    const lmp_field_desc desc = { .bands = bands,
                                  .nodes = { BENCH_FIELD, BENCH_FIELD_ROWS, BENCH_FIELD },
                                  .cell = { cell, cell, cell },
                                  .light_max = BENCH_LIGHTS };
    return lmp_field_create(NULL, &desc, &in->field) == LMP_OK &&
           lmp_field_update(NULL, in->field, in->lights, BENCH_LIGHTS) == LMP_OK;
}

bool bench_tables_create(bench_table table, int bands, bench_inputs *in) {
    const lmp_preintegrated_lobe_desc desc = { .bands = bands };
    if (table == BENCH_TABLE_FIELD)
        return field_create(bands, in);
    return table == BENCH_TABLE_NONE ||
           (lmp_preintegrated_lobe_create(NULL, &desc, &in->lobes) == LMP_OK &&
            (table == BENCH_TABLE_LOBES || brdf_create(bands, in)));
}
