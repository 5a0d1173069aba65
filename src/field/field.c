/* SPDX-License-Identifier: MIT */
#include "src/field/field.h"

#include "src/field/near.h"
#include "src/field/nodes.h"
#include "src/kernels/arrays.h"

#include <string.h>

/* --- error and reach -------------------------------------------------------------------------- */

/* error = max((joint / (reach + a))³, (scale / (reach + b))⁴): the third derivative of the fade
 * jumps where the fade ends, and the coefficients of many bands grow fast near a light. The
 * constants bound the largest errors that a search finds for reaches of 1.2 to 64 cells, on grids
 * of one to four levels (tests/unit/field_error.c): they lie at least 5 % above them, and from 2
 * cells on at most a third. */
#define JOINT      1.13f
#define JOINT_MORE 0.25f
static const struct {
    float scale, more;
} growths[LMP_FIELD_BANDS_MAX] = {
    { 1.1f, 0.65f }, { 1.1f, 0.65f },  { 1.1f, 0.65f },  { 1.73f, 0.65f }, { 1.99f, 0.7f },
    { 2.29f, 0.8f }, { 2.74f, 1.05f }, { 3.17f, 1.25f }, { 3.61f, 1.45f }, { 4.04f, 1.65f },
};

enum { BANDS_DEFAULT = 5, NODES_DEFAULT = 16, LIGHTS_DEFAULT = 1024 };
#define REACH_MIN 1.0f
#define REACH_MAX 64.0f

/* Computes the cube root by Newton's steps, which give the same bits on every machine. */
static float cube_root(float x) {
    float root = 1;
    for (int i = 0; i < 30; i++)
        root = (root + root + x / (root * root)) / 3;
    return root;
}

static float error_of(const lmp_field_desc *desc) {
    const float joint = JOINT / (desc->reach + JOINT_MORE);
    const float growth =
        growths[desc->bands - 1].scale / (desc->reach + growths[desc->bands - 1].more);
    return fmaxf(joint * joint * joint, growth * growth * growth * growth);
}

static float reach_of(const lmp_field_desc *desc) {
    const float root = sqrtf(sqrtf(desc->error));
    const float joint = JOINT / cube_root(desc->error) - JOINT_MORE;
    const float growth = growths[desc->bands - 1].scale / root - growths[desc->bands - 1].more;
    return fmaxf(fmaxf(joint, growth), REACH_MIN);
}

static bool resolve_error(lmp_field_desc *desc) {
    if (desc->reach == 0) {
        if (desc->error == 0)
            desc->error = LMP_FIELD_ERROR_DEFAULT;
        if (!(desc->error >= 1e-5f && desc->error <= 1))
            return false;
        desc->reach = reach_of(desc);
    }
    desc->error = error_of(desc);
    return desc->reach >= REACH_MIN && desc->reach <= REACH_MAX;
}

static bool is_edge(float edge) {
    return edge >= 1e-12f && edge <= 1e12f;
}

bool lmpi_field_resolve(lmp_field_desc *desc) {
    uint64_t nodes = 1;
    if (desc->bands == 0)
        desc->bands = BANDS_DEFAULT;
    if (desc->light_max == 0)
        desc->light_max = LIGHTS_DEFAULT;
    for (int a = 0; a < 3; a++) {
        if (desc->nodes[a] == 0)
            desc->nodes[a] = NODES_DEFAULT;
        if (desc->nodes[a] < 2 || desc->nodes[a] > LMP_FIELD_NODES_MAX)
            return false;
        nodes *= (uint64_t)desc->nodes[a];
    }
    if (desc->cell.x == 0 && desc->cell.y == 0 && desc->cell.z == 0)
        desc->cell = (lmp_vec3) { 1, 1, 1 };
    return nodes <= FIELD_NODES && desc->bands >= 1 && desc->bands <= LMP_FIELD_BANDS_MAX &&
           desc->light_max >= 1 && desc->light_max <= LMP_FIELD_LIGHTS_MAX &&
           fabsf(desc->origin.x) <= 1e15f && fabsf(desc->origin.y) <= 1e15f &&
           fabsf(desc->origin.z) <= 1e15f && is_edge(desc->cell.x) && is_edge(desc->cell.y) &&
           is_edge(desc->cell.z) && resolve_error(desc);
}

/* --- memory ----------------------------------------------------------------------------------- */

enum { LINE = 64 }; /* bytes of a cache line */

/* Takes a piece of one allocation, rounded up to a multiple of LINE bytes. */
static void *take(unsigned char *memory, size_t *used, size_t size) {
    const size_t at = *used;
    *used += (size + LINE - 1) / LINE * LINE;
    return memory ? memory + at : NULL;
}

/* Returns the list entries that lights of no size need, if their reach is less than most of the
 * grid. The finest level, which points read, gets no more than make lists of 256 lights per block:
 * beyond that a finer grid is what helps. */
static size_t entry_count(const lmp_field *field, bool finest) {
    const lmp_field_desc *desc = &field->info.desc;
    const float edge[3] = { desc->cell.x, desc->cell.y, desc->cell.z };
    size_t around = 1;
    for (int a = 0; a < 3; a++) {
        const float blocks = 2 * field->info.reach / (FIELD_BLOCK * edge[a]) + 2;
        around *= blocks < (float)field->blocks[a] ? (size_t)blocks : field->blocks[a];
    }
    const size_t lights = desc->light_max;
    const size_t most = 256 * field->block_count, all = lights * around;
    return (all < most || !finest ? all : most) / FIELD_ENTRY + field->block_count +
           2 * (lights / FIELD_ENTRY + 1);
}

/* Takes the memory that belongs to one level. */
static size_t divide(lmp_field *field, bool finest, unsigned char *memory, size_t *used) {
    const size_t lights = field->info.desc.light_max;
    const size_t brick = FIELD_BRICK * field->info.node_bytes;
    field->nodes = take(memory, used, field->brick_count * brick);
    field->changes = finest ? NULL : take(memory, used, field->brick_count * brick);
    field->states = take(memory, used, field->brick_count * sizeof *field->states);
    field->everywhere = take(memory, used, lights);
    field->lists = take(memory, used, (field->block_count + 1) * sizeof *field->lists);
    field->entries = take(memory, used, field->entry_count * sizeof *field->entries);
    return *used;
}

/* Plans a level of the grid that desc describes. */
static lmp_field plan_level(const lmp_host *host, const lmp_field_desc *desc, bool finest) {
    static const uint32_t brick[3] = { 4, 2, 2 };
    const float edge = fmaxf(desc->cell.x, fmaxf(desc->cell.y, desc->cell.z));
    lmp_field plan = { .host = lmpi_host_resolve(host), .info = { .desc = *desc } };
    plan.info.reach = desc->reach * edge;
    plan.values = 3 * LMP_SH_COUNT(desc->bands);
    plan.stride =
        (plan.values + LMPI_KERNEL_LANES_MAX - 1) / LMPI_KERNEL_LANES_MAX * LMPI_KERNEL_LANES_MAX;
    plan.info.node_bytes = 4 * plan.stride * sizeof(float);
    plan.per_cell[0] = 1 / desc->cell.x;
    plan.per_cell[1] = 1 / desc->cell.y;
    plan.per_cell[2] = 1 / desc->cell.z;
    plan.brick_count = plan.block_count = 1;
    for (int a = 0; a < 3; a++) {
        const uint32_t nodes = (uint32_t)desc->nodes[a];
        plan.bricks[a] = (nodes + brick[a] - 1) / brick[a];
        plan.blocks[a] = (nodes - 1 + FIELD_BLOCK - 1) / FIELD_BLOCK;
        plan.brick_count *= plan.bricks[a];
        plan.block_count *= plan.blocks[a];
    }
    plan.task_count = plan.brick_count < FIELD_TASKS ? plan.brick_count : FIELD_TASKS;
    plan.entry_count = entry_count(&plan, finest);
    return plan;
}

/* The reach of a coarser field, relative to the finest one's: its own errors then add little to the
 * finest field's. */
#define WIDER 1.15f

/* Makes the grid of twice the cells, large enough to cover all bricks; returns whether it pays. */
static bool is_coarser(const lmp_field_desc *fine, lmp_field_desc *coarse) {
    uint64_t nodes = 1;
    *coarse = *fine;
    for (int a = 0; a < 3; a++) {
        nodes *= (uint64_t)fine->nodes[a];
        coarse->nodes[a] =
            a == 0 ? 2 * ((fine->nodes[a] + 3) / 4) + 1 : (fine->nodes[a] + 1) / 2 + 1;
    }
    coarse->cell = (lmp_vec3) { 2 * fine->cell.x, 2 * fine->cell.y, 2 * fine->cell.z };
    return nodes >= FIELD_COARSE;
}

/* The most levels that a grid has. */
enum { LEVELS = 8 };

static int plan_levels(const lmp_host *host, const lmp_field_desc *desc, lmp_field *levels) {
    lmp_field_desc coarse = *desc, fine;
    int count = 0;
    do {
        fine = coarse;
        levels[count] = plan_level(host, &fine, count == 0);
        count++;
        fine.reach = WIDER * desc->reach;
    } while (count < LEVELS && is_coarser(&fine, &coarse));
    return count;
}

/* Lays the levels out in memory, or only counts the bytes where memory is NULL. Levels share the
 * list of lights, and the scratch of bricks, because they take turns. */
static size_t lay_out(lmp_field *levels, int count, unsigned char *memory) {
    const size_t lights = levels->info.desc.light_max;
    size_t used = (size_t)count * sizeof *levels;
    lmp_field *const at = (lmp_field *)(void *)memory;
    used += LINE - ((uintptr_t)memory + used) % LINE;
    levels->scratch = take(memory, &used, levels->task_count * lmpi_field_scratch(levels));
    levels->lights = take(memory, &used, lights * sizeof *levels->lights);
    levels->spheres = take(memory, &used, lights * sizeof *levels->spheres);
    for (int i = 0; i < count; i++) {
        levels[i].scratch = levels->scratch;
        levels[i].lights = levels->lights;
        levels[i].spheres = levels->spheres;
        divide(&levels[i], i == 0, memory, &used);
        levels[i].coarse = i + 1 < count && at ? at + i + 1 : NULL;
    }
    if (at)
        memcpy(at, levels, (size_t)count * sizeof *levels);
    return used;
}

lmp_result lmpi_field_allocate(const lmp_host *host, const lmp_field_desc *desc,
                               lmp_field **field) {
    lmp_field levels[LEVELS];
    const int count = plan_levels(host, desc, levels);
    levels->info.bytes = lay_out(levels, count, NULL) + LINE;
    unsigned char *memory = lmpi_allocate(&levels->host, levels->info.bytes);
    *field = (lmp_field *)(void *)memory;
    if (!memory)
        return LMP_ERROR_MEMORY;
    lay_out(levels, count, memory);
    for (lmp_field *level = *field; level; level = level->coarse)
        memset(level->nodes, 0, level->brick_count * FIELD_BRICK * level->info.node_bytes);
    lmpi_field_unlist_all(*field);
    lmpi_field_set_states(*field, FIELD_READY);
    return LMP_OK;
}

lmp_result lmp_field_create(const lmp_host *host, const lmp_field_desc *desc, lmp_field **field) {
    lmp_field_desc resolved = desc ? *desc : (lmp_field_desc) { 0 };
    *field = NULL;
    if (!lmpi_field_resolve(&resolved))
        return LMP_ERROR_ARGUMENT;
    return lmpi_field_allocate(host, &resolved, field);
}

void lmp_field_destroy(lmp_field *field) {
    lmpi_release_object(field);
}

lmp_field_info lmp_field_describe(const lmp_field *field) {
    return field->info;
}

const lmp_light *lmp_field_lights(const lmp_field *field) {
    return field->lights;
}
