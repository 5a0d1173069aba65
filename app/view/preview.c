/* SPDX-License-Identifier: MIT */
/* Vertex clustering (Rossignac and Borrel 1993). */
#include "app/view/preview.h"
#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

typedef struct cluster {
    int32_t cell[3];
    uint32_t octant, mesh, vertex; /* NONE: empty */
} cluster;

typedef struct clusters {
    cluster *slots; /* open addressing */
    size_t mask;
    uint32_t *vertex_of;  /* of each vertex of the scene, or NONE */
    const float *minimum; /* of the current mesh */
    float cell;
    float *cells; /* per mesh, in its own space, for its largest instance */
    scene_vertex *vertices;
    uint32_t *indices;
    scene_mesh *meshes;
    size_t vertex_count, index_count;
} clusters;

static uint32_t octant_of(const float normal[3]) {
    return (normal[0] < 0) | (uint32_t)(normal[1] < 0) << 1 | (uint32_t)(normal[2] < 0) << 2;
}

static size_t hash_of(const cluster *key) {
    uint64_t h = key->octant | (uint64_t)key->mesh << 3;
    for (int k = 0; k < 3; k++)
        h = (h ^ (uint32_t)key->cell[k]) * 0x9e3779b97f4a7c15u;
    return (size_t)(h ^ h >> 29);
}

/* Returns the vertex that represents this one. */
static uint32_t represent(clusters *c, const scene_vertex *vertices, uint32_t index,
                          uint32_t mesh) {
    if (c->vertex_of[index] != NONE)
        return c->vertex_of[index];
    const scene_vertex *v = &vertices[index];
    cluster key = { .octant = octant_of(v->normal),
                    .mesh = mesh,
                    .vertex = (uint32_t)c->vertex_count };
    for (int k = 0; k < 3; k++)
        key.cell[k] = (int32_t)((v->position[k] - c->minimum[k]) / c->cell);
    size_t slot = hash_of(&key) & c->mask;
    while (c->slots[slot].vertex != NONE &&
           (memcmp(c->slots[slot].cell, key.cell, sizeof key.cell) != 0 ||
            c->slots[slot].octant != key.octant || c->slots[slot].mesh != key.mesh))
        slot = (slot + 1) & c->mask;
    if (c->slots[slot].vertex == NONE) {
        c->slots[slot] = key;
        c->vertices[c->vertex_count++] = *v;
    }
    return c->vertex_of[index] = c->slots[slot].vertex;
}

static void simplify_mesh(clusters *c, const scene *world, size_t number) {
    scene_mesh *mesh = &c->meshes[number];
    const uint32_t *from = world->indices + mesh->first_index;
    const uint32_t count = mesh->index_count;
    c->minimum = world->meshes[number].minimum;
    c->cell = c->cells[number];
    mesh->first_index = (uint32_t)c->index_count;
    for (uint32_t i = 0; i < count; i += 3) {
        uint32_t corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = represent(c, world->vertices, from[i + (uint32_t)k], (uint32_t)number);
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
            continue;
        memcpy(c->indices + c->index_count, corner, sizeof corner);
        c->index_count += 3;
    }
    mesh->index_count = (uint32_t)c->index_count - mesh->first_index;
    /* Let the next mesh have vertices of its own. Only what this mesh touched is cleared, so that
     * many small meshes cost no more than one large mesh. */
    for (uint32_t i = 0; i < count; i++)
        c->vertex_of[from[i]] = NONE;
}

static void set_cells(clusters *c, const scene *world, float cell) {
    for (size_t i = 0; i < world->mesh_count; i++)
        c->cells[i] = 0;
    for (size_t i = 0; i < world->instance_count; i++) {
        const scene_instance *instance = &world->instances[i];
        /* an unscaled instance has the root of 3 */
        const float scale = scene_instance_scale(instance) / sqrtf(3);
        c->cells[instance->mesh] = fmaxf(c->cells[instance->mesh], scale);
    }
    for (size_t i = 0; i < world->mesh_count; i++)
        c->cells[i] = c->cells[i] > 0 ? fmaxf(cell / c->cells[i], 1e-30f) : INFINITY;
}

static bool allocate(clusters *c, const scene *world) {
    size_t slots = 16;
    while (slots < 2 * world->index_count)
        slots *= 2;
    c->mask = slots - 1;
    c->slots = malloc(slots * sizeof *c->slots);
    c->vertex_of = malloc((world->vertex_count + 1) * sizeof *c->vertex_of);
    /* a vertex that two meshes use is copied for each: never more than there are corners */
    c->vertices = malloc((world->index_count + 1) * sizeof *c->vertices);
    c->indices = malloc((world->index_count + 1) * sizeof *c->indices);
    c->meshes = malloc((world->mesh_count + 1) * sizeof *c->meshes);
    c->cells = malloc((world->mesh_count + 1) * sizeof *c->cells);
    if (!c->cells || !c->slots || !c->vertex_of || !c->vertices || !c->indices || !c->meshes)
        return false;
    memset(c->slots, 0xff, slots * sizeof *c->slots);
    memset(c->vertex_of, 0xff, world->vertex_count * sizeof *c->vertex_of);
    return true;
}

bool view_preview_make(const scene *world, int cells, scene *preview, base_error *error) {
    clusters c = { .slots = NULL };
    const float diagonal = scene_diagonal(world);
    const bool ok = allocate(&c, world);
    if (ok)
        set_cells(&c, world, diagonal / (float)cells);
    if (ok)
        memcpy(c.meshes, world->meshes, world->mesh_count * sizeof *c.meshes);
    for (size_t i = 0; i < world->mesh_count && ok; i++)
        simplify_mesh(&c, world, i);
    free(c.slots);
    free(c.vertex_of);
    free(c.cells);
    *preview = *world;
    preview->vertices = c.vertices;
    preview->indices = c.indices;
    preview->meshes = c.meshes;
    preview->vertex_count = c.vertex_count;
    preview->index_count = c.index_count;
    preview->lights = NULL;
    preview->light_count = preview->motion_count = 0;
    preview->block = NULL;
    if (ok)
        return true;
    view_preview_free(preview);
    return base_fail(error, NULL, "out of memory");
}

void view_preview_free(scene *preview) {
    free((void *)(uintptr_t)preview->vertices);
    free((void *)(uintptr_t)preview->indices);
    free((void *)(uintptr_t)preview->meshes);
    memset(preview, 0, sizeof *preview);
}
