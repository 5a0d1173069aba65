/* SPDX-License-Identifier: MIT */
#include "src/shade/chunk.h"

/* Whether two surfaces without lobes are shaded from the same source. */
static bool is_alike(const lmp_surfaces *surfaces, bool preintegrated, size_t at,
                     const shade_source *source) {
    const shade_source own = lmpi_shade_source(lmpi_material_at(surfaces, at), preintegrated);
    return own.table == source->table && own.preintegrated == source->preintegrated;
}

/* Returns how many waiting surfaces have as many lobes as the first, if all that a chunk takes do,
 * else 0. Without a branch per surface. */
static size_t same_lobes(const shade_waiting *waiting, size_t most) {
    const size_t count = waiting->count < most ? waiting->count : most;
    unsigned mixed = 0;
    for (size_t i = 0; i < count; i++)
        mixed |= waiting->lobes[i] ^ waiting->lobes[0];
    return mixed ? 0 : count;
}

/* Sets the source of the surfaces at chunk->at, which may come in any order where the caller sorts
 * them. */
static void set_source(shade_source source, int lobes, size_t count, shade_chunk *chunk) {
    size_t gaps = 0;
    for (size_t i = 0; i < count; i++)
        gaps |= (chunk->at[i] - chunk->at[0]) ^ i;
    lmpi_shade_fill(chunk->at, count);
    chunk->source = source;
    chunk->phong_count = lobes;
    chunk->count = count;
    chunk->in_a_row = gaps == 0;
}

void lmpi_shade_take_lobes(const lmp_surfaces *surfaces, int lobes, size_t first,
                           const uint16_t *order, size_t count, shade_chunk *chunk) {
    for (size_t i = 0; i < count; i++)
        chunk->at[i] = first + order[i];
    set_source(lmpi_shade_source(lmpi_material_at(surfaces, chunk->at[0]), false), lobes, count,
               chunk);
}

void lmpi_shade_take_alike(const lmp_surfaces *surfaces, bool preintegrated, shade_waiting *waiting,
                           shade_chunk *chunk) {
    const int lobes = waiting->lobes[0];
    const shade_source source =
        lmpi_shade_source(lmpi_material_at(surfaces, waiting->at[0]), preintegrated);
    const size_t most = lmpi_shade_capacity(lobes);
    size_t others = 0, i = lobes > 0 ? same_lobes(waiting, most) : 0;
    memcpy(chunk->at, waiting->at, i * sizeof *chunk->at);
    size_t taken = i;
    /* Without branches, which alternating surfaces would mispredict. */
    for (; i < waiting->count && taken < most; i++) {
        const size_t at = waiting->at[i];
        bool alike = waiting->lobes[i] == lobes;
        if (lobes == 0 && alike)
            alike = is_alike(surfaces, preintegrated, at, &source);
        chunk->at[taken] = at;
        waiting->at[others] = at;
        waiting->lobes[others] = waiting->lobes[i];
        taken += alike;
        others += !alike;
    }
    const size_t rest = waiting->count - i;
    memmove(waiting->at + others, waiting->at + i, rest * sizeof *waiting->at);
    memmove(waiting->lobes + others, waiting->lobes + i, rest * sizeof *waiting->lobes);
    waiting->count = others + rest;
    set_source(source, lobes, taken, chunk);
}

/* Whether the weights of a lobe are all 0. Without a branch per surface. */
static bool reflects_nothing(const shade_lobe_planes *lobe, size_t count) {
    int any = 0;
    for (size_t i = 0; i < count; i++)
        any |= (lobe->weight.x[i] != 0) | (lobe->weight.y[i] != 0) | (lobe->weight.z[i] != 0);
    return !any;
}

static void load_lobes(const lmp_surfaces *surfaces, shade_chunk *chunk) {
    shade_planes *planes = &chunk->planes;
    const int lobes = chunk->phong_count;
    lmpi_shade_load(surfaces, chunk->at, chunk->count, lobes, &chunk->surfaces.normal,
                    &chunk->surfaces.view, planes);
    chunk->surfaces.lobe_count = lobes;
    chunk->is_matte = lobes == 1 && reflects_nothing(&planes->lobe[0], chunk->count);
    for (int k = 0; k < lobes; k++) {
        shade_lobe_planes *lobe = &planes->lobe[k];
        chunk->surfaces.lobe[k] =
            (lmpi_kernel_lobe) { lmpi_batch_planes(lobe->axis), lobe->exponent };
        for (int c = 0; c < 3; c++) {
            memset(lobe->accumulated[c], 0, planes->stride * sizeof(float));
            chunk->sums.specular[k][c] = lobe->accumulated[c];
        }
    }
}

void lmpi_shade_load_chunk(const lmp_surfaces *surfaces, shade_chunk *chunk) {
    shade_planes *planes = &chunk->planes;
    lmpi_shade_divide(chunk->phong_count, planes);
    chunk->surfaces.point = lmpi_shade_vectors(&surfaces->position, chunk->at, chunk->count,
                                               chunk->in_a_row, planes->point);
    chunk->surfaces.normal = lmpi_shade_vectors(&surfaces->normal, chunk->at, chunk->count,
                                                chunk->in_a_row, planes->normal);
    chunk->surfaces.view =
        lmpi_shade_vectors(&surfaces->view, chunk->at, chunk->count, chunk->in_a_row, planes->view);
    if (!chunk->source.preintegrated)
        load_lobes(surfaces, chunk);
    memset(chunk->ambient, 0, sizeof chunk->ambient);
    for (int c = 0; c < 3; c++) {
        memset(planes->accumulated[c], 0, planes->stride * sizeof(float));
        chunk->sums.diffuse[c] = planes->accumulated[c];
    }
}
