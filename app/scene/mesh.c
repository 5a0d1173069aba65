/* SPDX-License-Identifier: MIT */
#include "app/scene/mesh.h"

#include "app/scene/vector.h"

#include <assimp/cimport.h>

#include <stdlib.h>
#include <string.h>

#define NODE_DEPTH_MAX 1024
/* more corners at one point than this are not compared with another */
#define SMOOTH_GROUP_MAX 256

/* One mesh being flattened: its triangles' corners, and one vertex per corner or per vertex. */
typedef struct flattening {
    const struct aiMesh *mesh;
    const mesh_options *options;
    scene_vertex *vertices;
    size_t vertex_count;
    uint32_t *corners; /* 3 a triangle, into vertices */
    size_t corner_count;
} flattening;

static float dot3(const float *a, const float *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* --- triangles ----------------------------------------------------------------------------------
 */

static bool collect_corners(flattening *f, cli_error *error) {
    size_t triangles = 0;
    for (unsigned i = 0; i < f->mesh->mNumFaces; i++)
        if (f->mesh->mFaces[i].mNumIndices >= 3)
            triangles += f->mesh->mFaces[i].mNumIndices - 2;
    f->corners = malloc((3 * triangles + 1) * sizeof *f->corners);
    if (!f->corners)
        return cli_fail(error, f->options->subject, "does not fit into memory");
    for (unsigned i = 0; i < f->mesh->mNumFaces; i++) {
        const struct aiFace *face = &f->mesh->mFaces[i];
        for (unsigned k = 2; k < face->mNumIndices; k++) {
            const unsigned fan[3] = { face->mIndices[0], face->mIndices[k - 1], face->mIndices[k] };
            for (int c = 0; c < 3; c++) {
                if (fan[c] >= f->mesh->mNumVertices)
                    return cli_fail(error, f->options->subject,
                                    "has a triangle with a vertex that does not exist");
                f->corners[f->corner_count++] = fan[c];
            }
        }
    }
    return true;
}

/* --- vertices -----------------------------------------------------------------------------------
 */

typedef struct transform {
    double m[3][4];      /* of points */
    double normal[3][3]; /* cofactors: of normals, up to scale */
    bool mirrors;
} transform;

static transform make_transform(const struct aiMatrix4x4 *a) {
    transform t = { .m = { { (double)a->a1, (double)a->a2, (double)a->a3, (double)a->a4 },
                           { (double)a->b1, (double)a->b2, (double)a->b3, (double)a->b4 },
                           { (double)a->c1, (double)a->c2, (double)a->c3, (double)a->c4 } } };
    double determinant = 0.0;
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

static void store_unit(const double v[3], double sign, float out[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const bool ok = length > 0.0 && isfinite(length);
    for (int k = 0; k < 3; k++)
        out[k] = ok ? (float)(sign * v[k] / length) : 0.0f;
}

/* A normal or tangent that is missing or degenerate stays zero for now. */
static void fill_vertex(const struct aiMesh *mesh, const transform *t, unsigned i,
                        scene_vertex *vertex) {
    const struct aiVector3D p = mesh->mVertices[i];
    for (int k = 0; k < 3; k++)
        vertex->position[k] = (float)(t->m[k][0] * (double)p.x + t->m[k][1] * (double)p.y +
                                      t->m[k][2] * (double)p.z + t->m[k][3]);
    if (mesh->mTextureCoords[0]) {
        vertex->uv[0] = mesh->mTextureCoords[0][i].x;
        vertex->uv[1] = 1.0f - mesh->mTextureCoords[0][i].y;
    }
    double turned[3];
    if (mesh->mNormals) {
        const struct aiVector3D n = mesh->mNormals[i];
        for (int k = 0; k < 3; k++)
            turned[k] = t->normal[k][0] * (double)n.x + t->normal[k][1] * (double)n.y +
                        t->normal[k][2] * (double)n.z;
        store_unit(turned, t->mirrors ? -1.0 : 1.0, vertex->normal);
    }
    if (mesh->mNormals && mesh->mTangents && mesh->mBitangents) {
        const struct aiVector3D a = mesh->mTangents[i], b = mesh->mBitangents[i];
        for (int k = 0; k < 3; k++)
            turned[k] =
                t->m[k][0] * (double)a.x + t->m[k][1] * (double)a.y + t->m[k][2] * (double)a.z;
        store_unit(turned, 1.0, vertex->tangent);
        const struct aiVector3D n = mesh->mNormals[i];
        const float side = (n.y * a.z - n.z * a.y) * b.x + (n.z * a.x - n.x * a.z) * b.y +
                           (n.x * a.y - n.y * a.x) * b.z;
        vertex->tangent[3] = (side < 0.0f) != t->mirrors ? -1.0f : 1.0f;
    }
}

static bool make_vertices(flattening *f, const transform *t, cli_error *error) {
    /* Without normals every corner gets a vertex of its own first. */
    const bool split = !f->mesh->mNormals;
    f->vertex_count = split ? f->corner_count : f->mesh->mNumVertices;
    f->vertices = calloc(f->vertex_count + 1, sizeof *f->vertices);
    if (!f->vertices)
        return cli_fail(error, f->options->subject, "does not fit into memory");
    for (size_t i = 0; i < f->vertex_count; i++)
        fill_vertex(f->mesh, t, split ? f->corners[i] : (unsigned)i, &f->vertices[i]);
    for (size_t i = 0; split && i < f->corner_count; i++)
        f->corners[i] = (uint32_t)i;
    for (size_t i = 0; t->mirrors && i < f->corner_count; i += 3) {
        const uint32_t second = f->corners[i + 1];
        f->corners[i + 1] = f->corners[i + 2];
        f->corners[i + 2] = second;
    }
    return true;
}

/* --- missing normals ----------------------------------------------------------------------------
 */

static lmp_vec3 triangle_normal(const flattening *f, size_t triangle) {
    const uint32_t *c = &f->corners[3 * triangle];
    const lmp_vec3 a = vec_load(f->vertices[c[0]].position);
    const lmp_vec3 b = vec_sub(vec_load(f->vertices[c[1]].position), a);
    const lmp_vec3 d = vec_sub(vec_load(f->vertices[c[2]].position), a);
    return vec_cross(b, d);
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

/* Sums the normals of the corners in one place that belong to one smooth surface. */
static void smooth_group(flattening *f, const corner_key *group, size_t count,
                         const lmp_vec3 *faces) {
    for (size_t i = 0; i < count; i++) {
        const lmp_vec3 own = faces[group[i].corner / 3];
        const lmp_vec3 own_unit = vec_normalize(own, vec(0.0f, 0.0f, 0.0f));
        lmp_vec3 sum = own;
        for (size_t k = 0; k < count && count <= SMOOTH_GROUP_MAX; k++) {
            const lmp_vec3 other = faces[group[k].corner / 3];
            const lmp_vec3 unit = vec_normalize(other, vec(0.0f, 0.0f, 0.0f));
            if (k != i && vec_dot(own_unit, unit) > f->options->crease_cos)
                sum = vec_add(sum, other);
        }
        const lmp_vec3 normal = vec_normalize(sum, vec(0.0f, 1.0f, 0.0f));
        vec_store(normal, f->vertices[f->corners[group[i].corner]].normal);
    }
}

static bool make_normals(flattening *f, cli_error *error) {
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
    return ok || cli_fail(error, f->options->subject, "does not fit into memory");
}

/* Zero normals among given ones take their triangle's. */
static void mend_normals(flattening *f) {
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

/* --- missing tangents ---------------------------------------------------------------------------
 */

/* Adds a triangle's dP/du to `along` and its dP/dv to `across` of its vertices. */
static void add_triangle_tangent(const flattening *f, size_t triangle, lmp_vec3 *along,
                                 lmp_vec3 *across) {
    const uint32_t *c = &f->corners[3 * triangle];
    const scene_vertex *a = &f->vertices[c[0]], *b = &f->vertices[c[1]], *d = &f->vertices[c[2]];
    const lmp_vec3 e1 = vec_sub(vec_load(b->position), vec_load(a->position));
    const lmp_vec3 e2 = vec_sub(vec_load(d->position), vec_load(a->position));
    const float u1 = b->uv[0] - a->uv[0], v1 = b->uv[1] - a->uv[1];
    const float u2 = d->uv[0] - a->uv[0], v2 = d->uv[1] - a->uv[1];
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

static bool make_tangents(flattening *f, cli_error *error) {
    lmp_vec3 *along = calloc(2 * f->vertex_count + 1, sizeof *along);
    if (!along)
        return cli_fail(error, f->options->subject, "does not fit into memory");
    lmp_vec3 *across = along + f->vertex_count;
    for (size_t i = 0; f->mesh->mTextureCoords[0] && i < f->corner_count / 3; i++)
        add_triangle_tangent(f, i, along, across);
    for (size_t i = 0; i < f->vertex_count; i++) {
        scene_vertex *vertex = &f->vertices[i];
        const lmp_vec3 n = vec_load(vertex->normal);
        const bool given = dot3(vertex->tangent, vertex->tangent) > 0.5f;
        const lmp_vec3 raw = given ? vec_load(vertex->tangent) : along[i];
        const lmp_vec3 flat = vec_sub(raw, vec_scale(n, vec_dot(n, raw)));
        const bool usable = vec_length(flat) > 1e-4f * vec_length(raw);
        const lmp_vec3 tangent = usable ? vec_normalize(flat, vec_across(n)) : vec_across(n);
        /* The bitangent points along rising v of an image with v up, as glTF defines it. */
        if (!given)
            vertex->tangent[3] = vec_dot(vec_cross(n, tangent), across[i]) > 0.0f ? -1.0f : 1.0f;
        vec_store(tangent, vertex->tangent);
    }
    free(along);
    return true;
}

/* --- welding ------------------------------------------------------------------------------------
 */

/* Merges equal vertices, keeping the order of their first use. */
static bool weld_vertices(flattening *f, cli_error *error) {
    size_t buckets = 64;
    while (buckets < 2 * f->vertex_count)
        buckets *= 2;
    uint32_t *table = malloc(buckets * sizeof *table);
    uint32_t *place = malloc((f->vertex_count + 1) * sizeof *place);
    const bool ok = table && place;
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
        place[i] = table[slot];
    }
    for (size_t i = 0; ok && i < f->corner_count; i++)
        f->corners[i] = place[f->corners[i]];
    f->vertex_count = kept;
    free(table);
    free(place);
    return ok || cli_fail(error, f->options->subject, "does not fit into memory");
}

/* --- the tree -----------------------------------------------------------------------------------
 */

static bool append_flattened(const flattening *f, scene_builder *builder, cli_error *error) {
    const size_t first_vertex = builder_count(builder, BLOB_VERTICES);
    const size_t first_index = builder_count(builder, BLOB_INDICES);
    if (first_vertex + f->vertex_count >= UINT32_MAX || first_index + f->corner_count >= UINT32_MAX)
        return cli_fail(error, f->options->subject, "has more than 4 billion vertices");
    scene_vertex *vertices = builder_append(builder, BLOB_VERTICES, f->vertex_count);
    uint32_t *indices = builder_append(builder, BLOB_INDICES, f->corner_count);
    if (!vertices || !indices)
        return cli_fail(error, f->options->subject, "does not fit into memory");
    memcpy(vertices, f->vertices, f->vertex_count * sizeof *vertices);
    for (size_t i = 0; i < f->corner_count; i++)
        indices[i] = (uint32_t)first_vertex + f->corners[i];
    builder_mesh(builder, f->mesh->mName.data, f->mesh->mMaterialIndex, first_index);
    return true;
}

static bool add_mesh(const struct aiMesh *mesh, const struct aiMatrix4x4 *world,
                     const mesh_options *options, scene_builder *builder, cli_error *error) {
    flattening f = { .mesh = mesh, .options = options };
    const transform t = make_transform(world);
    bool ok = collect_corners(&f, error);
    if (ok && f.corner_count > 0) {
        ok = make_vertices(&f, &t, error) && (mesh->mNormals || make_normals(&f, error));
        if (ok)
            mend_normals(&f);
        ok = ok && (!options->weld || weld_vertices(&f, error)) && make_tangents(&f, error) &&
             append_flattened(&f, builder, error);
    }
    free(f.vertices);
    free(f.corners);
    return ok;
}

static struct aiMatrix4x4 multiplied(const struct aiMatrix4x4 *a, const struct aiMatrix4x4 *b) {
    struct aiMatrix4x4 product = *a;
    aiMultiplyMatrix4(&product, b);
    return product;
}

static bool add_node(const struct aiScene *imported, const struct aiNode *node,
                     const struct aiMatrix4x4 *parent, int depth, const mesh_options *options,
                     scene_builder *builder, cli_error *error) {
    if (depth > NODE_DEPTH_MAX)
        return cli_fail(error, options->subject, "has nodes nested too deep");
    const struct aiMatrix4x4 world = multiplied(parent, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (!add_mesh(imported->mMeshes[node->mMeshes[i]], &world, options, builder, error))
            return false;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!add_node(imported, node->mChildren[i], &world, depth + 1, options, builder, error))
            return false;
    return true;
}

bool mesh_add_tree(const struct aiScene *imported, const mesh_options *options,
                   scene_builder *builder, cli_error *error) {
    struct aiMatrix4x4 identity;
    aiIdentityMatrix4(&identity);
    return add_node(imported, imported->mRootNode, &identity, 0, options, builder, error);
}
