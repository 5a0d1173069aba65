/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_bake.h"

#include "app/render/shadow/transfer_receivers.h"
#include "app/scene/bake.h"

#include <stdlib.h>
#include <string.h>

typedef struct bake_source {
    const scene *world;
    const lmp_rgb *albedos;
    const trace_bvh *bvh;
} bake_source;

/* What the cache keeps. */
typedef struct baked_object {
    transfer_baked baked;                  /* first, for it outlives the rest */
    transfer_lists lists[TRANSFER_LAYERS]; /* unless it was read */
} baked_object;

/* The rays from each point of a layer. Receivers are read together with those around them, which
 * share the noise of their rays. */
static const size_t rays_of[TRANSFER_LAYERS] = {
    [TRANSFER_SURFELS] = 256, [TRANSFER_RECEIVERS] = 64
};

void transfer_baked_destroy(transfer_baked *b) {
    if (!b)
        return;
    for (int i = 0; i < TRANSFER_LAYERS; i++) {
        lmp_transfer_destroy(b->layers[i].transfer);
        transfer_cells_free(&b->layers[i].cells);
        free(b->layers[i].points.at);
    }
    free(b);
}

static void destroy(baked_object *o) {
    for (int i = 0; i < TRANSFER_LAYERS; i++)
        transfer_lists_free(&o->lists[i]);
    transfer_baked_destroy(&o->baked);
}

/* Creates the transfer of a layer; to receivers, surfels are patches of a sky. */
static lmp_result create_transfer(int layer, transfer_baked *b, const uint32_t *hits,
                                  const uint32_t *links) {
    transfer_layer *l = &b->layers[layer];
    const bool receive = layer == TRANSFER_RECEIVERS;
    const lmp_transfer_desc desc = { .surfels = l->points.at,
                                     .surfel_count = l->points.count,
                                     .sky_count =
                                         receive ? b->layers[TRANSFER_SURFELS].points.count : 0,
                                     .hits = hits,
                                     .ray_count = rays_of[layer],
                                     .links = links,
                                     .link_count = TRANSFER_LINKS };
    return l->points.count > 0 ? lmp_transfer_create(NULL, &desc, &l->transfer) : LMP_OK;
}

/* --- making ----------------------------------------------------------------------------------- */

static bool make_points(int layer, const bake_source *from, transfer_baked *b) {
    transfer_layer *l = &b->layers[layer];
    if (layer == TRANSFER_RECEIVERS)
        return transfer_receivers_make(from->world, from->bvh, &b->layers[TRANSFER_SURFELS].points,
                                       &l->points);
    if (!transfer_surfels_make(from->world, from->albedos, &l->points))
        return false;
    transfer_drop_buried(from->world, from->bvh, &l->points);
    return true;
}

static lmp_result make_layer(int layer, const bake_source *from, const lmp_host *host,
                             baked_object *o) {
    transfer_layer *l = &o->baked.layers[layer], *surfels = &o->baked.layers[TRANSFER_SURFELS];
    if (!make_points(layer, from, &o->baked) || !transfer_cells_create(&l->points, &l->cells))
        return LMP_ERROR_MEMORY;
    const transfer_view own = { from->world, from->bvh, &l->cells },
                        hit = { from->world, from->bvh, &surfels->cells };
    const transfer_task task = { .from = &own,
                                 .to = &hit,
                                 .rays = rays_of[layer],
                                 .first = l == surfels ? 0 : l->points.count,
                                 .begin = (double)layer / TRANSFER_LAYERS,
                                 .end = (double)(layer + 1) / TRANSFER_LAYERS };
    if (!transfer_lists_create(&task, host, &o->lists[layer]))
        return LMP_ERROR_MEMORY;
    return create_transfer(layer, &o->baked, o->lists[layer].hits, o->lists[layer].links);
}

static lmp_result make(const lmp_host *host, const void *user, void **object) {
    baked_object *o = calloc(1, sizeof *o);
    lmp_result result = o ? LMP_OK : LMP_ERROR_MEMORY;
    for (int i = 0; i < TRANSFER_LAYERS && result == LMP_OK; i++)
        result = make_layer(i, user, host, o);
    if (result != LMP_OK && o) {
        destroy(o);
        o = NULL;
    }
    *object = o;
    return result;
}

/* --- bytes ------------------------------------------------------------------------------------ */

/* The bytes are, for each layer, this, the points, hits and links. */
typedef struct bytes_head {
    uint64_t count;
    float spacing;
    uint32_t unused;
} bytes_head;

static size_t point_bytes(int layer) {
    return sizeof(lmp_transfer_surfel) + (rays_of[layer] + TRANSFER_LINKS) * sizeof(uint32_t);
}

static size_t size_of(const void *object) {
    const baked_object *o = object;
    size_t size = 0;
    for (int i = 0; i < TRANSFER_LAYERS; i++)
        size += sizeof(bytes_head) + o->baked.layers[i].points.count * point_bytes(i);
    return size;
}

static void *append(void *bytes, const void *from, size_t size) {
    memcpy(bytes, from, size);
    return (unsigned char *)bytes + size;
}

static void write_object(const void *object, void *bytes) {
    const baked_object *o = object;
    for (int i = 0; i < TRANSFER_LAYERS; i++) {
        const transfer_surfels *s = &o->baked.layers[i].points;
        const bytes_head head = { .count = s->count, .spacing = s->spacing };
        bytes = append(bytes, &head, sizeof head);
        bytes = append(bytes, s->at, s->count * sizeof *s->at);
        bytes = append(bytes, o->lists[i].hits, s->count * rays_of[i] * sizeof(uint32_t));
        bytes = append(bytes, o->lists[i].links, s->count * TRANSFER_LINKS * sizeof(uint32_t));
    }
}

/* What is left to read. */
typedef struct bytes_left {
    const unsigned char *at;
    size_t size;
} bytes_left;

static const void *take(bytes_left *left, size_t size) {
    const void *taken = left->at;
    left->at += size;
    left->size -= size;
    return taken;
}

static bool read_layer(int layer, bytes_left *left, transfer_baked *b) {
    transfer_layer *l = &b->layers[layer];
    bytes_head head;
    if (left->size < sizeof head)
        return false;
    memcpy(&head, take(left, sizeof head), sizeof head);
    if (head.count > left->size / point_bytes(layer) ||
        !(head.spacing > 0 && isfinite(head.spacing)))
        return false;
    l->points = (transfer_surfels) { .at = malloc((head.count + 1) * sizeof *l->points.at),
                                     .count = (size_t)head.count,
                                     .spacing = head.spacing };
    if (!l->points.at)
        return false;
    memcpy(l->points.at, take(left, head.count * sizeof *l->points.at),
           head.count * sizeof *l->points.at);
    const uint32_t *hits = take(left, head.count * rays_of[layer] * sizeof *hits),
                   *links = take(left, head.count * TRANSFER_LINKS * sizeof *links);
    return transfer_cells_create(&l->points, &l->cells) &&
           create_transfer(layer, b, hits, links) == LMP_OK;
}

static void *read_object(const void *bytes, size_t size, const void *user) {
    bytes_left left = { bytes, size };
    baked_object *o = calloc(1, sizeof *o);
    bool ok = o != NULL;
    (void)user;
    for (int i = 0; i < TRANSFER_LAYERS && ok; i++)
        ok = read_layer(i, &left, &o->baked);
    if (o && !(ok && left.size == 0)) {
        destroy(o);
        o = NULL;
    }
    return o;
}

/* --- both ------------------------------------------------------------------------------------- */

/* Returns the hash of what surfels and rays depend on. */
static file_hash key_of(const scene *s, const lmp_rgb *albedos) {
    const float sizes[] = { (float)rays_of[TRANSFER_SURFELS],
                            (float)rays_of[TRANSFER_RECEIVERS],
                            TRANSFER_LINKS,
                            TRANSFER_SURFELS_MAX,
                            TRANSFER_SPACINGS,
                            TRANSFER_REACH,
                            TRANSFER_PART,
                            TRANSFER_PART_LEAST };
    file_hash key = { 0, 0 };
    bake_add_settings(&key, sizes, sizeof sizes);
    file_hash_add(&key, s->vertices, s->vertex_count * sizeof *s->vertices);
    file_hash_add(&key, s->indices, s->index_count * sizeof *s->indices);
    file_hash_add(&key, s->meshes, s->mesh_count * sizeof *s->meshes);
    file_hash_add(&key, s->instances, s->instance_count * sizeof *s->instances);
    file_hash_add(&key, s->materials, s->material_count * sizeof *s->materials);
    if (albedos)
        file_hash_add(&key, albedos, s->material_count * sizeof *albedos);
    file_hash_add(&key, s->textures, s->texture_count * sizeof *s->textures);
    file_hash_add(&key, s->encoded, s->encoded_bytes);
    if (s->image_count == 0)
        file_hash_add(&key, s->texels, s->texel_bytes);
    return key;
}

transfer_baked *transfer_bake(const scene *world, const lmp_rgb *albedos, const trace_bvh *bvh) {
    const bake_source source = { world, albedos, bvh };
    const bake_recipe recipe = { .kind = "bounces",
                                 .what = "casting rays between surfaces",
                                 .key = key_of(world, albedos),
                                 .read = read_object,
                                 .make = make,
                                 .size = size_of,
                                 .write = write_object,
                                 .user = &source };
    void *object;
    if (bake(&recipe, &object) != LMP_OK)
        return NULL;
    baked_object *o = object;
    for (int i = 0; i < TRANSFER_LAYERS; i++)
        transfer_lists_free(&o->lists[i]);
    return &o->baked;
}
