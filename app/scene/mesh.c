/* SPDX-License-Identifier: MIT */
#include "app/scene/mesh.h"

#include "app/base/file_hash.h"
#include "app/image/srgb.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

/* groups of more corners at one point are not smoothed */
#define SMOOTH_GROUP_MAX 256
/* one triangle in so many may face away from its normals where both are taken to agree */
#define DISAGREEING 8

static float dot3(const float *a, const float *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

uint16_t mesh_color_from_srgb(double stored) {
    return stored > 0.0 ? (uint16_t)(65535.0 * image_srgb_to_linear(fmin(stored, 1.0)) + 0.5) : 0;
}

/* --- transforms ------------------------------------------------------------------------------- */

mesh_transform mesh_transform_make(const double m[16]) {
    mesh_transform t;
    double determinant = 0.0;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            t.m[row][column] = m[4 * column + row];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            t.normal[i][k] = t.m[i1][k1] * t.m[i2][k2] - t.m[i1][k2] * t.m[i2][k1];
            if (i == 0)
                determinant += t.m[0][k] * t.normal[0][k];
        }
    t.mirrors = determinant < 0.0;
    return t;
}

/* Stores a vector at unit length; one without a direction becomes zero. */
static void store_unit(const double v[3], double sign, float out[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const bool ok = length > 0.0 && isfinite(length);
    for (int k = 0; k < 3; k++)
        out[k] = ok ? (float)(sign * v[k] / length) : 0.0f;
}

void mesh_transform_vertex(const mesh_transform *t, scene_vertex *vertex) {
    double p[3], n[3], a[3];
    for (int k = 0; k < 3; k++) {
        p[k] = t->m[k][3];
        n[k] = a[k] = 0.0;
        for (int i = 0; i < 3; i++) {
            p[k] += t->m[k][i] * (double)vertex->position[i];
            n[k] += t->normal[k][i] * (double)vertex->normal[i];
            a[k] += t->m[k][i] * (double)vertex->tangent[i];
        }
    }
    for (int k = 0; k < 3; k++)
        vertex->position[k] = (float)p[k];
    store_unit(n, t->mirrors ? -1.0 : 1.0, vertex->normal);
    store_unit(a, 1.0, vertex->tangent);
    vertex->tangent[3] = (vertex->tangent[3] < 0.0f) != t->mirrors ? -1.0f : 1.0f;
}

void mesh_flip(mesh_draft *f) {
    for (size_t i = 0; i < f->corner_count; i += 3) {
        const uint32_t second = f->corners[i + 1];
        f->corners[i + 1] = f->corners[i + 2];
        f->corners[i + 2] = second;
    }
}

/* Finds the mesh's unit of length: in it, products of four edges neither overflow nor vanish, and
 * no bit of a normal depends on it. */
static void find_unit(mesh_draft *f) {
    float size = 0.0f;
    for (int k = 0; k < 3; k++) {
        float lo = INFINITY, hi = -INFINITY;
        for (size_t i = 0; i < f->corner_count; i++) {
            const float x = f->vertices[f->corners[i]].position[k];
            lo = x < lo ? x : lo;
            hi = x > hi ? x : hi;
        }
        size = fmaxf(size, hi - lo);
    }
    const bool usual = size > 0.0f && isfinite(size);
    f->unit = usual ? ldexpf(1.0f, -(ilogbf(size) < -120 ? -120 : ilogbf(size))) : 1.0f;
}

static lmp_vec3 edge(const mesh_draft *f, uint32_t from, uint32_t to) {
    return vec_scale(
        vec_sub(vec_load(f->vertices[to].position), vec_load(f->vertices[from].position)), f->unit);
}

static lmp_vec3 triangle_normal(const mesh_draft *f, size_t triangle) {
    const uint32_t *c = &f->corners[3 * triangle];
    return vec_cross(edge(f, c[0], c[1]), edge(f, c[0], c[2]));
}

/* --- sides ------------------------------------------------------------------------------------ */

/* Makes triangles counter-clockwise as seen along their normals: formats without culling have
 * clockwise meshes as well. Where most triangles agree already, both tell which side is the
 * front. */
static void follow_normals(mesh_draft *f) {
    size_t flipped = 0;
    for (size_t i = 0; i < f->corner_count; i += 3) {
        uint32_t *c = &f->corners[i];
        lmp_vec3 given = vec(0.0f, 0.0f, 0.0f);
        for (int k = 0; k < 3; k++)
            given = vec_add(given, vec_load(f->vertices[c[k]].normal));
        if (vec_dot(given, triangle_normal(f, i / 3)) < 0.0f) {
            const uint32_t second = c[1];
            c[1] = c[2];
            c[2] = second;
            flipped++;
        }
    }
    f->sided = flipped < f->corner_count / 3 / DISAGREEING;
}

/* --- missing normals -------------------------------------------------------------------------- */

bool mesh_split_corners(mesh_draft *f, base_error *error) {
    scene_vertex *vertices = malloc((f->corner_count + 1) * sizeof *vertices);
    if (!vertices)
        return base_fail(error, f->subject, "does not fit into memory");
    for (size_t i = 0; i < f->corner_count; i++) {
        vertices[i] = f->vertices[f->corners[i]];
        f->corners[i] = (uint32_t)i;
    }
    free(f->vertices);
    f->vertices = vertices;
    f->vertex_count = f->corner_count;
    return true;
}

typedef struct corner_key {
    float position[3];
    uint32_t corner;
} corner_key;

static int compare_keys(const void *a, const void *b) {
    const corner_key *x = a, *y = b;
    const int order = memcmp(x->position, y->position, sizeof x->position);
    return order ? order : (x->corner > y->corner) - (x->corner < y->corner);
}

/* Averages the normals of the corners at one position that belong to one smooth surface. */
static void smooth_group(mesh_draft *f, const corner_key *group, size_t count,
                         const lmp_vec3 *faces) {
    for (size_t i = 0; i < count; i++) {
        const lmp_vec3 own = faces[group[i].corner / 3];
        const lmp_vec3 own_unit = vec_normalize(own, vec(0.0f, 0.0f, 0.0f));
        lmp_vec3 sum = own;
        for (size_t k = 0; k < count && count <= SMOOTH_GROUP_MAX; k++) {
            const lmp_vec3 other = faces[group[k].corner / 3];
            const lmp_vec3 unit = vec_normalize(other, vec(0.0f, 0.0f, 0.0f));
            if (k != i && vec_dot(own_unit, unit) > f->crease_cos)
                sum = vec_add(sum, other);
        }
        const lmp_vec3 normal = vec_normalize(sum, vec(0.0f, 1.0f, 0.0f));
        vec_store(normal, f->vertices[f->corners[group[i].corner]].normal);
    }
}

static bool make_normals(mesh_draft *f, base_error *error) {
    corner_key *keys = malloc((f->corner_count + 1) * sizeof *keys);
    lmp_vec3 *faces = malloc((f->corner_count / 3 + 1) * sizeof *faces);
    const bool ok = keys && faces;
    for (size_t i = 0; ok && i < f->corner_count / 3; i++)
        faces[i] = triangle_normal(f, i);
    for (size_t i = 0; ok && i < f->corner_count; i++) {
        memcpy(keys[i].position, f->vertices[f->corners[i]].position, sizeof keys[i].position);
        keys[i].corner = (uint32_t)i;
    }
    if (ok)
        qsort(keys, f->corner_count, sizeof *keys, compare_keys);
    for (size_t start = 0, end; ok && start < f->corner_count; start = end) {
        for (end = start + 1; end < f->corner_count; end++)
            if (memcmp(keys[start].position, keys[end].position, sizeof keys[start].position) != 0)
                break;
        smooth_group(f, keys + start, end - start, faces);
    }
    free(keys);
    free(faces);
    return ok || base_fail(error, f->subject, "does not fit into memory");
}

/* Replaces zero normals by that of the triangle. */
static void mend_normals(mesh_draft *f) {
    for (size_t i = 0; i < f->corner_count; i++) {
        scene_vertex *vertex = &f->vertices[f->corners[i]];
        if (dot3(vertex->normal, vertex->normal) < 0.5f)
            vec_store(vec_normalize(triangle_normal(f, i / 3), vec(0.0f, 1.0f, 0.0f)),
                      vertex->normal);
    }
    for (size_t i = 0; i < f->vertex_count; i++)
        if (dot3(f->vertices[i].normal, f->vertices[i].normal) < 0.5f)
            f->vertices[i].normal[1] = 1.0f;
}

/* --- missing tangents ------------------------------------------------------------------------- */

/* Adds a triangle's dP/du to `along` and its dP/dv to `across` of its vertices. */
static void add_triangle_tangent(const mesh_draft *f, size_t triangle, lmp_vec3 *along,
                                 lmp_vec3 *across) {
    const uint32_t *c = &f->corners[3 * triangle];
    const scene_vertex *a = &f->vertices[c[0]], *b = &f->vertices[c[1]], *d = &f->vertices[c[2]];
    const lmp_vec3 e1 = edge(f, c[0], c[1]), e2 = edge(f, c[0], c[2]);
    const float *p = a->uv[0], *q = b->uv[0], *r = d->uv[0];
    const float u1 = q[0] - p[0], v1 = q[1] - p[1];
    const float u2 = r[0] - p[0], v2 = r[1] - p[1];
    const float area = u1 * v2 - u2 * v1;
    const float sign = area < 0.0f ? -1.0f : 1.0f;
    if (area == 0.0f || !isfinite(area))
        return;
    const lmp_vec3 du = vec_scale(vec_sub(vec_scale(e1, v2), vec_scale(e2, v1)), sign);
    const lmp_vec3 dv = vec_scale(vec_sub(vec_scale(e2, u1), vec_scale(e1, u2)), sign);
    for (int k = 0; k < 3; k++) {
        along[c[k]] = vec_add(along[c[k]], vec_normalize(du, vec(0.0f, 0.0f, 0.0f)));
        across[c[k]] = vec_add(across[c[k]], vec_normalize(dv, vec(0.0f, 0.0f, 0.0f)));
    }
}

static bool make_tangents(mesh_draft *f, base_error *error) {
    lmp_vec3 *along = calloc(2 * f->vertex_count + 1, sizeof *along);
    if (!along)
        return base_fail(error, f->subject, "does not fit into memory");
    lmp_vec3 *across = along + f->vertex_count;
    for (size_t i = 0; i < f->corner_count / 3; i++)
        add_triangle_tangent(f, i, along, across);
    for (size_t i = 0; i < f->vertex_count; i++) {
        scene_vertex *vertex = &f->vertices[i];
        const lmp_vec3 n = vec_load(vertex->normal);
        const bool given = dot3(vertex->tangent, vertex->tangent) > 0.5f;
        const lmp_vec3 raw = given ? vec_load(vertex->tangent) : along[i];
        const lmp_vec3 flat = vec_sub(raw, vec_scale(n, vec_dot(n, raw)));
        const bool usable = vec_length(flat) > 1e-4f * vec_length(raw);
        const lmp_vec3 tangent = usable ? vec_normalize(flat, vec_across(n)) : vec_across(n);
        /* the bitangent points along increasing v of an image with v up, as glTF defines it */
        if (!given)
            vertex->tangent[3] = vec_dot(vec_cross(n, tangent), across[i]) > 0.0f ? -1.0f : 1.0f;
        vec_store(tangent, vertex->tangent);
    }
    free(along);
    return true;
}

/* --- welding ---------------------------------------------------------------------------------- */

/* Merges equal vertices, keeping the order of their first use. */
static bool weld_vertices(mesh_draft *f, base_error *error) {
    size_t buckets = 64;
    while (buckets < 2 * f->vertex_count)
        buckets *= 2;
    uint32_t *table = malloc(buckets * sizeof *table);
    uint32_t *new_index = malloc((f->vertex_count + 1) * sizeof *new_index);
    const bool ok = table && new_index;
    size_t kept = 0;
    if (ok)
        memset(table, 0xff, buckets * sizeof *table);
    for (size_t i = 0; ok && i < f->vertex_count; i++) {
        file_hash hash = { 0 };
        file_hash_add(&hash, &f->vertices[i], sizeof *f->vertices);
        size_t slot = hash.low & (buckets - 1);
        while (table[slot] != UINT32_MAX &&
               memcmp(&f->vertices[table[slot]], &f->vertices[i], sizeof *f->vertices) != 0)
            slot = (slot + 1) & (buckets - 1);
        if (table[slot] == UINT32_MAX) {
            f->vertices[kept] = f->vertices[i];
            table[slot] = (uint32_t)kept++;
        }
        new_index[i] = table[slot];
    }
    for (size_t i = 0; ok && i < f->corner_count; i++)
        f->corners[i] = new_index[f->corners[i]];
    f->vertex_count = kept;
    free(table);
    free(new_index);
    return ok || base_fail(error, f->subject, "does not fit into memory");
}

/* --- into the scene --------------------------------------------------------------------------- */

static bool append_draft(const mesh_draft *f, scene_builder *builder, base_error *error) {
    const size_t first_vertex = builder_count(builder, BLOB_VERTICES);
    const size_t first_index = builder_count(builder, BLOB_INDICES);
    if (first_vertex + f->vertex_count >= UINT32_MAX || first_index + f->corner_count >= UINT32_MAX)
        return base_fail(error, f->subject, "has more than 4 billion vertices");
    scene_vertex *vertices = builder_append(builder, BLOB_VERTICES, f->vertex_count);
    uint32_t *indices = builder_append(builder, BLOB_INDICES, f->corner_count);
    if (!vertices || !indices)
        return base_fail(error, f->subject, "does not fit into memory");
    memcpy(vertices, f->vertices, f->vertex_count * sizeof *vertices);
    for (size_t i = 0; i < f->corner_count; i++)
        indices[i] = (uint32_t)first_vertex + f->corners[i];
    builder_mesh(builder, f->name, f->material, first_index);
    return true;
}

bool mesh_add(mesh_draft *f, scene_builder *builder, base_error *error) {
    bool ok = true;
    if (f->corner_count == 0)
        return true;
    find_unit(f);
    if (f->has_normals && f->unsided)
        follow_normals(f);
    if (!f->has_normals)
        ok = mesh_split_corners(f, error) && make_normals(f, error); /* adjacent faces may differ */
    if (ok)
        mend_normals(f);
    return ok && (!f->weld || weld_vertices(f, error)) && make_tangents(f, error) &&
           append_draft(f, builder, error);
}

void mesh_free(mesh_draft *f) {
    free(f->vertices);
    free(f->corners);
}
