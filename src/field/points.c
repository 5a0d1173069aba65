/* SPDX-License-Identifier: MIT */
/* points.c - evaluates a field at points: interpolated coefficients, and what near lights add. */
#include "src/field/points.h"
#include "src/kernels/dispatch.h"
#include "src/light/cap.h"
#include "src/sh/layout.h"

#include <string.h>

/* --- interpolation ---------------------------------------------------------------------------- */

void lmpi_field_set_place(const lmp_field *field, const field_place *place, size_t at,
                          field_cells *cells) {
    const uint32_t *cell = place->cell;
    for (uint32_t k = 0; k < 8; k++)
        cells->corners[8 * at + k] =
            lmpi_field_node(field, cell[0] + k % 2, cell[1] + k / 2 % 2, cell[2] + k / 4);
    for (int a = 0; a < 3; a++)
        cells->fraction[a][at] = place->fraction[a];
}

lmpi_kernel_cells lmpi_field_cells(const lmp_field *field, const float *nodes,
                                   const field_cells *cells) {
    return (lmpi_kernel_cells) { nodes,
                                 field->stride,
                                 field->info.desc.cell,
                                 cells->corners,
                                 { cells->fraction[0], cells->fraction[1], cells->fraction[2] } };
}

static void note_block(uint32_t block, field_blocks *blocks) {
    if (blocks->count == 0 || blocks->at[blocks->count - 1] != block)
        blocks->at[blocks->count++] = block;
}

/* Interpolates at points; neighbors are often in one cell. Points outside the grid read any cell.
 */
void lmpi_field_interpolate(const lmp_field *field, const lmp_vec3 *points, size_t count,
                            field_blocks *blocks, const lmpi_kernel_out *out) {
    field_cells found;
    field_place place, last = { .cell = { UINT32_MAX } };
    memset(found.fraction, 0, sizeof found.fraction);
    for (size_t i = 0; i < count; i++, last = place) {
        const bool inside = lmpi_field_find(field, points[i], &place);
        if (!inside)
            place = (field_place) { 0 };
        if (i == 0 || !lmpi_field_same_cell(place.cell, last.cell)) {
            lmpi_field_set_place(field, &place, i, &found);
            if (inside && blocks)
                note_block(lmpi_field_block(field, place.cell), blocks);
            continue;
        }
        memcpy(&found.corners[8 * i], &found.corners[8 * (i - 1)], 8 * sizeof *found.corners);
        for (int a = 0; a < 3; a++)
            found.fraction[a][i] = place.fraction[a];
    }
    const lmpi_kernel_cells cells = lmpi_field_cells(field, field->nodes, &found);
    lmpi_kernels_get()->field.interpolate(field->values, &cells, count, out);
}

/* --- near lights ------------------------------------------------------------------------------ */

/* Points of one block that follow one another, or outside the grid, and the lights that may be near
 * some of them, in ascending order: as many at once as there is room for. */
enum { FOUND = 512 };
typedef struct near_run {
    uint32_t block; /* FIELD_NONE outside the grid, where all lights are near */
    field_box box;  /* around the points */
    uint32_t first; /* lights below are not among these; FIELD_NONE before any search */
    uint32_t next;  /* where the next search goes on, or FIELD_NONE if there is no light left */
    size_t count;
    uint32_t lights[FOUND];
} near_run;

static uint32_t block_at(const lmp_field *field, lmp_vec3 point) {
    field_place place;
    return lmpi_field_find(field, point, &place) ? lmpi_field_block(field, place.cell) : FIELD_NONE;
}

/* Begins a run at the first of the points; returns how many it has. */
static size_t begin_run(const lmp_field *field, const lmp_vec3 *points, size_t count,
                        near_run *run) {
    size_t taken = 1;
    run->block = block_at(field, points[0]);
    run->first = FIELD_NONE;
    run->box = (field_box) { points[0], points[0] };
    for (; taken < count && block_at(field, points[taken]) == run->block; taken++)
        lmpi_field_box_grow(&run->box, points[taken]);
    return taken;
}

/* Finds the lights near a run from `first` on. It is a function of its own, because its set would
 * be too much stack under the kernels. */
static __attribute__((noinline)) void find(const lmp_field *field, uint32_t first, near_run *run) {
    field_set set;
    lmpi_field_set_clear(field, &set);
    if (run->block == FIELD_NONE)
        lmpi_field_set_add_all(field, &set);
    else
        lmpi_field_set_add(field, run->block, &set);
    run->first = first;
    run->next = first;
    run->count = lmpi_field_set_find(field, &set, run->block == FIELD_NONE ? NULL : &run->box,
                                     FOUND, &run->next, run->lights);
}

/* What is done with a light near a point and the fraction of it that the field does not hold. */
typedef void near_action(const lmp_field *field, uint32_t light, float fraction, void *data);

static void each_near(const lmp_field *field, lmp_vec3 point, near_run *run, near_action *action,
                      void *data) {
    for (uint32_t first = 0; first != FIELD_NONE; first = run->next) {
        if (run->first != first)
            find(field, first, run);
        for (size_t i = 0; i < run->count; i++) {
            const uint32_t light = run->lights[i];
            const float fraction =
                run->block == FIELD_NONE ? 1 : lmpi_field_residual(field, light, point);
            if (fraction > 0)
                action(field, light, fraction, data);
        }
    }
}

typedef struct near_list {
    size_t capacity, count;
    uint32_t *lights;
    float *fractions;
} near_list;

static void list(const lmp_field *field, uint32_t light, float fraction, void *data) {
    near_list *to = data;
    (void)field;
    if (to->count < to->capacity) {
        to->lights[to->count] = light;
        to->fractions[to->count] = fraction;
    }
    to->count++;
}

size_t lmp_field_find_near(const lmp_field *field, lmp_vec3 point, size_t capacity,
                           uint32_t *lights, float *fractions) {
    near_list to = { capacity, 0, lights, fractions };
    near_run run;
    begin_run(field, &point, 1, &run);
    each_near(field, point, &run, list, &to);
    return to.count;
}

/* --- coefficients of near lights -------------------------------------------------------------- */

/* Spheres near a point that the kernel takes at once, and where it adds them. */
enum { TAKEN = 64 };
typedef struct near_sum {
    lmp_vec3 point;
    lmpi_kernel_out out;
    size_t count;
    float center[3][TAKEN], radius[TAKEN], radiance[3][TAKEN];
} near_sum;

static void flush(const lmp_field *field, near_sum *sum) {
    float at[3][LMPI_KERNEL_LANES_MAX] __attribute__((aligned(64)));
    const lmpi_kernel_vec3 point = { at[0], at[1], at[2] };
    const size_t each = sizeof(float);
    const lmpi_kernel_lights lights = {
        .center = { sum->center[0], sum->center[1], sum->center[2], each },
        .radius = { sum->radius, each },
        .radiance = { sum->radiance[0], sum->radiance[1], sum->radiance[2], each },
        .count = sum->count,
    };
    if (sum->count == 0)
        return;
    for (size_t i = 0; i < LMPI_KERNEL_LANES_MAX; i++) {
        at[0][i] = sum->point.x;
        at[1][i] = sum->point.y;
        at[2][i] = sum->point.z;
    }
    lmpi_kernels_get()->light.accumulate_more(NULL, field->info.desc.bands, &lights, &point, 1,
                                              &sum->out);
    sum->count = 0;
}

/* Adds a light that the kernel does not take. */
static void add_other(const lmp_field *field, const lmp_light *light, const near_sum *sum) {
    float row[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX] = { 0 };
    const size_t n = field->values / 3, step = sum->out.planar ? sum->out.stride : 1;
    float *const planes[3] = { row, row + n, row + 2 * n };
    lmp_cap cap;
    lmp_light_find_cap(light, sum->point, &cap);
    lmpi_cap_add(0, field->info.desc.bands, &cap, planes);
    for (size_t v = 0; v < field->values; v++)
        sum->out.at[v * step] += row[v];
}

static void add(const lmp_field *field, uint32_t light, float fraction, void *data) {
    const field_sphere *sphere = &field->spheres[light];
    near_sum *sum = data;
    const size_t i = sum->count;
    if (!lmpi_field_interpolates(field, light)) {
        add_other(field, &field->lights[light], sum);
        return;
    }
    sum->center[0][i] = sphere->center.x;
    sum->center[1][i] = sphere->center.y;
    sum->center[2][i] = sphere->center.z;
    sum->radius[i] = sphere->radius;
    sum->radiance[0][i] = fraction * sphere->radiance.r;
    sum->radiance[1][i] = fraction * sphere->radiance.g;
    sum->radiance[2][i] = fraction * sphere->radiance.b;
    if (++sum->count == TAKEN)
        flush(field, sum);
}

/* Adds what the field does not hold at a point to an element of the output: all lights, outside the
 * grid. */
static void add_near(const lmp_field *field, lmp_vec3 point, near_run *run,
                     const lmpi_kernel_out *out) {
    near_sum sum = { .point = point, .out = *out };
    each_near(field, point, run, add, &sum);
    flush(field, &sum);
}

/* --- at points -------------------------------------------------------------------------------- */

static size_t load_points(lmp_vec3_array array, size_t first, size_t count, lmp_vec3 *points) {
    const size_t some = count - first < FIELD_BRICK ? count - first : FIELD_BRICK;
    for (size_t i = 0; i < some; i++)
        points[i] = lmpi_vec3_element(&array, first + i);
    return some;
}

static lmpi_kernel_out element(const lmpi_kernel_out *out, size_t i) {
    return (lmpi_kernel_out) { out->at + i * (out->planar ? 1 : out->stride), out->stride,
                               out->planar };
}

static void set_zero(size_t values, const lmpi_kernel_out *out) {
    for (size_t v = 0; v < values; v++)
        out->at[out->planar ? v * out->stride : v] = 0;
}

/* Evaluates up to FIELD_BRICK points. */
static void eval(const lmp_field *field, const lmp_vec3 *points, size_t count,
                 const lmpi_kernel_out *out) {
    lmpi_field_interpolate(field, points, count, NULL, out);
    for (size_t i = 0; i < count;) {
        near_run run;
        for (size_t end = i + begin_run(field, points + i, count - i, &run); i < end; i++) {
            const lmpi_kernel_out to = element(out, i);
            if (run.block == FIELD_NONE)
                set_zero(field->values, &to);
            add_near(field, points[i], &run, &to);
        }
    }
}

void lmpi_field_row(const lmp_field *field, lmp_vec3 point, float *row) {
    const lmpi_kernel_out out = { row, field->values, 0 };
    eval(field, &point, 1, &out);
}

void lmp_field_eval_n(const lmp_field *field, lmp_vec3_array points, size_t count,
                      lmp_sh_array sh) {
    assert(lmpi_are_finite(points, count) && lmpi_is_sh_array(sh, field->values, count));
    const bool planar = sh.layout == LMP_SH_PLANAR;
    const lmpi_kernel_out all = { sh.at,
                                  lmpi_batch_stride(sh.stride, planar ? count : field->values),
                                  planar };
    lmp_vec3 some[FIELD_BRICK];
    for (size_t first = 0; first < count; first += FIELD_BRICK) {
        const size_t n = load_points(points, first, count, some);
        const lmpi_kernel_out out = element(&all, first);
        eval(field, some, n, &out);
    }
}

/* --- lobes ------------------------------------------------------------------------------------ */

/* Points with a lobe each, and the responses of their lobes. */
typedef struct lobe_points {
    const float *lambda;
    lmp_vec3 point[FIELD_BRICK];
    float axis[3][FIELD_BRICK] __attribute__((aligned(64)));
    float sums[3][FIELD_BRICK] __attribute__((aligned(64)));
} lobe_points;

/* Responds to the interpolated coefficients. It is a function of its own, because its planes would
 * be too much stack under the kernels of lights. */
static __attribute__((noinline)) void respond_to_far(const lmp_field *field, size_t count,
                                                     lobe_points *lobes) {
    float planes[FIELD_ROWS] = { 0 }, ones[LMP_FIELD_BANDS_MAX];
    const lmpi_kernel_out out = { planes, FIELD_BRICK, 1 };
    const lmpi_kernel_in in = { planes, FIELD_BRICK, 1 };
    const lmpi_kernel_surfaces surfaces = { .normal = { lobes->axis[0], lobes->axis[1],
                                                        lobes->axis[2] } };
    const lmpi_kernel_accumulated to = { .diffuse = { lobes->sums[0], lobes->sums[1],
                                                      lobes->sums[2] } };
    for (int l = 0; l < LMP_FIELD_BANDS_MAX; l++)
        ones[l] = 1;
    lmpi_field_interpolate(field, lobes->point, count, NULL, &out);
    lmpi_kernels_get()->shade.field(field->info.desc.bands, ones, lobes->lambda, &surfaces, &in,
                                    count, &to);
}

typedef struct near_response {
    lobe_points *lobes;
    size_t i;
} near_response;

static void respond(const lmp_field *field, uint32_t light, float fraction, void *data) {
    const near_response *to = data;
    lobe_points *lobes = to->lobes;
    const lmp_vec3 axis = { lobes->axis[0][to->i], lobes->axis[1][to->i], lobes->axis[2][to->i] };
    const lmp_rgb rgb = lmp_lobe_response(field->info.desc.bands, lobes->lambda, axis,
                                          &field->lights[light], 1, lobes->point[to->i]);
    lobes->sums[0][to->i] += fraction * rgb.r;
    lobes->sums[1][to->i] += fraction * rgb.g;
    lobes->sums[2][to->i] += fraction * rgb.b;
}

/* Responds to what the field does not hold: outside the grid to all lights, and to nothing else. */
static void respond_to_near(const lmp_field *field, size_t count, lobe_points *lobes) {
    near_response to = { lobes, 0 };
    while (to.i < count) {
        near_run run;
        const size_t left = count - to.i;
        const size_t end = to.i + begin_run(field, lobes->point + to.i, left, &run);
        for (; to.i < end; to.i++) {
            for (int c = 0; c < 3 && run.block == FIELD_NONE; c++)
                lobes->sums[c][to.i] = 0;
            each_near(field, lobes->point[to.i], &run, respond, &to);
        }
    }
}

void lmp_field_eval_lobe_n(const lmp_field *field, const float *lambda, lmp_vec3_array axes,
                           lmp_vec3_array points, size_t count, lmp_rgb_array rgb) {
    assert(lmpi_are_finite(points, count) && lmpi_are_unit(axes, count));
    assert(lmpi_is_rgb_array(rgb));
    const size_t step = lmpi_batch_stride(rgb.stride, 3);
    for (size_t first = 0; first < count; first += FIELD_BRICK) {
        lobe_points lobes = { .lambda = lambda };
        const size_t n = load_points(points, first, count, lobes.point);
        for (size_t i = 0; i < n; i++) {
            const lmp_vec3 q = lmpi_vec3_element(&axes, first + i);
            lobes.axis[0][i] = q.x;
            lobes.axis[1][i] = q.y;
            lobes.axis[2][i] = q.z;
        }
        respond_to_far(field, n, &lobes);
        respond_to_near(field, n, &lobes);
        for (size_t i = 0; i < n; i++)
            for (size_t c = 0; c < 3; c++)
                rgb.at[(first + i) * step + c] = lobes.sums[c][i];
    }
}
