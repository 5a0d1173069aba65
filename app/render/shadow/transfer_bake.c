/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_bake.h"

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
    transfer_baked baked; /* first, for it outlives the rest */
    transfer_lists lists; /* unless it was read */
} baked_object;

void transfer_baked_destroy(transfer_baked *b) {
    if (!b)
        return;
    lmp_transfer_destroy(b->transfer);
    transfer_cells_free(&b->cells);
    free(b->surfels.at);
    free(b);
}

static void destroy(baked_object *o) {
    transfer_lists_free(&o->lists);
    transfer_baked_destroy(&o->baked);
}

static lmp_result create_transfer(transfer_baked *b, const uint32_t *hits, const uint32_t *links) {
    const lmp_transfer_desc desc = { .surfels = b->surfels.at,
                                     .surfel_count = b->surfels.count,
                                     .hits = hits,
                                     .ray_count = TRANSFER_RAYS,
                                     .links = links,
                                     .link_count = TRANSFER_LINKS };
    return b->surfels.count > 0 ? lmp_transfer_create(NULL, &desc, &b->transfer) : LMP_OK;
}

/* --- making ----------------------------------------------------------------------------------- */

static lmp_result make_parts(const lmp_host *host, const bake_source *from, baked_object *o) {
    transfer_baked *b = &o->baked;
    const transfer_view view = { from->world, from->bvh, &b->cells };
    if (!transfer_surfels_make(from->world, from->albedos, &b->surfels))
        return LMP_ERROR_MEMORY;
    transfer_drop_buried(from->world, from->bvh, &b->surfels);
    if (!transfer_cells_create(&b->surfels, &b->cells) ||
        !transfer_lists_create(&view, host, &o->lists))
        return LMP_ERROR_MEMORY;
    return create_transfer(b, o->lists.hits, o->lists.links);
}

static lmp_result make(const lmp_host *host, const void *user, void **object) {
    baked_object *o = calloc(1, sizeof *o);
    const lmp_result result = o ? make_parts(host, user, o) : LMP_ERROR_MEMORY;
    if (result != LMP_OK && o) {
        destroy(o);
        o = NULL;
    }
    *object = o;
    return result;
}

/* --- bytes ------------------------------------------------------------------------------------ */

/* The bytes are this, the surfels, hits and links. */
typedef struct bytes_head {
    uint64_t count;
    float spacing;
    uint32_t unused;
} bytes_head;

static size_t bytes_of(size_t count) {
    return sizeof(bytes_head) + count * (sizeof(lmp_transfer_surfel) +
                                         (TRANSFER_RAYS + TRANSFER_LINKS) * sizeof(uint32_t));
}

static size_t size_of(const void *object) {
    const baked_object *o = object;
    return bytes_of(o->baked.surfels.count);
}

static void write_object(const void *object, void *bytes) {
    const baked_object *o = object;
    const transfer_surfels *s = &o->baked.surfels;
    const bytes_head head = { .count = s->count, .spacing = s->spacing };
    lmp_transfer_surfel *surfels =
        (lmp_transfer_surfel *)(void *)((unsigned char *)bytes + sizeof head);
    uint32_t *hits = (uint32_t *)(void *)(surfels + s->count);
    memcpy(bytes, &head, sizeof head);
    memcpy(surfels, s->at, s->count * sizeof *surfels);
    memcpy(hits, o->lists.hits, s->count * TRANSFER_RAYS * sizeof *hits);
    memcpy(hits + s->count * TRANSFER_RAYS, o->lists.links,
           s->count * TRANSFER_LINKS * sizeof *hits);
}

static bool read_parts(const void *bytes, const bytes_head *head, transfer_baked *b) {
    const lmp_transfer_surfel *surfels =
        (const lmp_transfer_surfel *)(const void *)((const unsigned char *)bytes + sizeof *head);
    const uint32_t *hits = (const uint32_t *)(const void *)(surfels + head->count);
    b->surfels.spacing = head->spacing;
    b->surfels.count = (size_t)head->count;
    b->surfels.at = malloc((b->surfels.count + 1) * sizeof *surfels);
    if (!b->surfels.at)
        return false;
    memcpy(b->surfels.at, surfels, b->surfels.count * sizeof *surfels);
    return transfer_cells_create(&b->surfels, &b->cells) &&
           create_transfer(b, hits, hits + head->count * TRANSFER_RAYS) == LMP_OK;
}

static void *read_object(const void *bytes, size_t size, const void *user) {
    bytes_head head;
    (void)user;
    if (size < sizeof head)
        return NULL;
    memcpy(&head, bytes, sizeof head);
    if (head.count > 2 * TRANSFER_SURFELS_MAX || size != bytes_of((size_t)head.count) ||
        !(head.spacing > 0 && isfinite(head.spacing)))
        return NULL;
    baked_object *o = calloc(1, sizeof *o);
    if (o && !read_parts(bytes, &head, &o->baked)) {
        destroy(o);
        o = NULL;
    }
    return o;
}

/* --- both ------------------------------------------------------------------------------------- */

/* Returns the hash of what surfels and rays depend on. */
static file_hash key_of(const scene *s, const lmp_rgb *albedos) {
    static const float sizes[] = { TRANSFER_RAYS, TRANSFER_LINKS, TRANSFER_SURFELS_MAX,
                                   TRANSFER_SPACINGS, TRANSFER_REACH };
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
    transfer_lists_free(&o->lists);
    return &o->baked;
}
