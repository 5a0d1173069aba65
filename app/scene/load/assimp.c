/* SPDX-License-Identifier: MIT */
#include "app/scene/load/assimp.h"

#include "app/base/file.h"
#include "app/scene/instance.h"
#include "app/scene/load/assimp_library.h"
#include "app/scene/load/assimp_material.h"
#include "app/scene/mesh.h"
#include "app/scene/sides.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define NODE_DEPTH_MAX 1024
#define MESH_UNREAD    UINT32_MAX
#define MESH_EMPTY     (UINT32_MAX - 1)

typedef struct assimp_job {
    const char *name;
    const void *data;
    size_t size;
    source_set *sources;
    scene_builder *builder;
    uint32_t *shared;  /* for each of Assimp's meshes, its number in the scene */
    uint32_t *unsided; /* the current node's meshes that do not tell which side is their front */
    size_t unsided_count, unsided_capacity;
    bool flat_normals;  /* whether the format's normals follow from the order of corners */
    bool lost_nodes;    /* whether a node lacks a child that it counts */
    base_error refusal; /* why the first file that Assimp asked for could not be read */
    bool out_of_memory;
} assimp_job;

/* --- files for Assimp: from memory, and only the scene's own ---------------------------------- */

typedef struct open_file {
    struct aiFile face;
    const unsigned char *data;
    size_t size, position;
} open_file;

static open_file *opened(struct aiFile *file) {
    return (open_file *)(void *)file->UserData;
}

static size_t read_file(struct aiFile *file, char *out, size_t item, size_t count) {
    open_file *f = opened(file);
    const size_t left = f->size - f->position;
    const size_t items = item == 0 ? 0 : count < left / item ? count : left / item;
    memcpy(out, f->data + f->position, items * item);
    f->position += items * item;
    return items;
}

static size_t refuse_write(struct aiFile *file, const char *data, size_t item, size_t count) {
    (void)file;
    (void)data;
    (void)item;
    (void)count;
    return 0;
}

static size_t tell_file(struct aiFile *file) {
    return opened(file)->position;
}

static size_t size_file(struct aiFile *file) {
    return opened(file)->size;
}

static enum aiReturn seek_file(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    open_file *f = opened(file);
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f->position : f->size;
    if (base + offset > f->size)
        return aiReturn_FAILURE;
    f->position = base + offset;
    return aiReturn_SUCCESS;
}

static void flush_file(struct aiFile *file) {
    (void)file;
}

/* Whether a file has the scene's own base name, as "knight.skin" for "knight.md3": Assimp looks for
 * such files whether or not the scene refers to them. */
static bool is_probed(const assimp_job *job, const char *path) {
    const char *dot = strrchr(job->name, '.');
    const size_t length = dot ? (size_t)(dot - job->name) : strlen(job->name);
    return strncmp(file_base_name(path), job->name, length) == 0;
}

/* Finds another file that Assimp asks for. One that cannot be read is noted, unless Assimp only
 * probed for it. */
static const source *find_beside(assimp_job *job, const char *path) {
    const source *found = NULL;
    source_state state;
    base_error error;
    if (!sources_read_optional(job->sources, path, &found, &state, &error)) {
        job->out_of_memory = true;
        job->refusal = error;
    } else if (!found) {
        if (!job->refusal.text[0])
            base_fail(&job->refusal, job->sources->subject, "needs \"%.200s\" (%s)", path,
                      source_state_nouns[state]);
        if (!(state == SOURCE_MISSING && is_probed(job, path)))
            builder_unsupported_file(job->builder, path, source_state_nouns[state]);
    }
    return found;
}

static struct aiFile *open_for_assimp(struct aiFileIO *io, const char *path, const char *mode) {
    assimp_job *job = (assimp_job *)(void *)io->UserData;
    while (strncmp(path, "./", 2) == 0)
        for (path += 2; *path == '/';)
            path++;
    const void *data = job->data;
    size_t size = job->size;
    if (mode[0] != 'r')
        return NULL;
    if (strcmp(path, job->name) != 0) {
        const source *const found = find_beside(job, path);
        if (!found)
            return NULL;
        data = found->data;
        size = found->size;
    }
    open_file *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    *f = (open_file) { .face = { .ReadProc = read_file,
                                 .WriteProc = refuse_write,
                                 .TellProc = tell_file,
                                 .FileSizeProc = size_file,
                                 .SeekProc = seek_file,
                                 .FlushProc = flush_file,
                                 .UserData = (aiUserData)f },
                       .data = data,
                       .size = size };
    return &f->face;
}

static void close_for_assimp(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    free(opened(file));
}

static const struct aiScene *run_assimp(assimp_job *job, base_error *error) {
    struct aiFileIO io = { .OpenProc = open_for_assimp,
                           .CloseProc = close_for_assimp,
                           .UserData = (aiUserData)job };
    /* without this, any text named .ase would be a skeleton, drawn by triangles */
    struct aiPropertyStore *const properties = assimp.aiCreatePropertyStore();
    assimp.aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    /* some readers mistake a name alone for its folder, which they then do not find */
    char path[512];
    snprintf(path, sizeof path, "./%s", job->name);
    const struct aiScene *imported =
        assimp.aiImportFileExWithProperties(path, aiProcess_GenUVCoords, &io, properties);
    assimp.aiReleasePropertyStore(properties);
    /* a file that could not be read is the likely cause of Assimp's error; otherwise it was only
     * noted */
    if (job->refusal.text[0] && (job->out_of_memory || !imported || !imported->mRootNode)) {
        *error = job->refusal;
        if (imported)
            assimp.aiReleaseImport(imported);
        return NULL;
    }
    if (!imported || !imported->mRootNode) {
        const char *reason = assimp.aiGetErrorString();
        if (reason && reason[0])
            base_fail(error, job->sources->subject,
                      "is damaged, or of a version or kind that Assimp cannot read: %.300s",
                      reason);
        else
            base_fail(error, job->sources->subject,
                      "is damaged, or of a version or kind that Assimp cannot read");
        return NULL;
    }
    return imported;
}

/* --- triangles -------------------------------------------------------------------------------- */

static bool copy_corners(const struct aiMesh *mesh, mesh_draft *draft, base_error *error) {
    size_t triangles = 0;
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        if (mesh->mFaces[i].mNumIndices >= 3)
            triangles += mesh->mFaces[i].mNumIndices - 2;
    draft->corners = malloc((3 * triangles + 1) * sizeof *draft->corners);
    if (!draft->corners)
        return base_fail(error, draft->subject, "does not fit into memory");
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        for (unsigned k = 2; k < face->mNumIndices; k++) {
            const unsigned fan[3] = { face->mIndices[0], face->mIndices[k - 1], face->mIndices[k] };
            for (int c = 0; c < 3; c++) {
                if (fan[c] >= mesh->mNumVertices)
                    return base_fail(error, draft->subject,
                                     "has a triangle with a vertex that does not exist");
                draft->corners[draft->corner_count++] = fan[c];
            }
        }
    }
    return true;
}

static void copy_vector(struct aiVector3D from, float to[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

static void copy_vertex(const struct aiMesh *mesh, unsigned i, scene_vertex *vertex) {
    copy_vector(mesh->mVertices[i], vertex->position);
    if (mesh->mTextureCoords[0]) {
        vertex->uv[0][0] = mesh->mTextureCoords[0][i].x;
        vertex->uv[0][1] = 1.0f - mesh->mTextureCoords[0][i].y;
    }
    if (mesh->mNormals)
        copy_vector(mesh->mNormals[i], vertex->normal);
    if (mesh->mNormals && mesh->mTangents && mesh->mBitangents) {
        const struct aiVector3D n = mesh->mNormals[i], a = mesh->mTangents[i],
                                b = mesh->mBitangents[i];
        const float side = (n.y * a.z - n.z * a.y) * b.x + (n.z * a.x - n.x * a.z) * b.y +
                           (n.x * a.y - n.y * a.x) * b.z;
        copy_vector(a, vertex->tangent);
        vertex->tangent[3] = side < 0.0f ? -1.0f : 1.0f;
    }
}

static bool add_mesh(assimp_job *job, const struct aiMesh *mesh, const mesh_transform *transform,
                     base_error *error) {
    mesh_draft draft = { .subject = job->sources->subject,
                         .name = mesh->mName.data,
                         .material = mesh->mMaterialIndex,
                         .vertex_count = mesh->mNumVertices,
                         .has_normals = mesh->mNormals != NULL,
                         .weld = true,
                         .unsided = true,
                         .crease_cos = MESH_CREASE_60 };
    draft.vertices = calloc(draft.vertex_count + 1, sizeof *draft.vertices);
    bool ok = draft.vertices || base_fail(error, draft.subject, "does not fit into memory");
    ok = ok && copy_corners(mesh, &draft, error);
    for (unsigned i = 0; ok && i < mesh->mNumVertices; i++) {
        copy_vertex(mesh, i, &draft.vertices[i]);
        mesh_transform_vertex(transform, &draft.vertices[i]);
    }
    if (ok && transform->mirrors)
        mesh_flip(&draft);
    const size_t next = builder_count(job->builder, BLOB_MESHES);
    ok = ok && mesh_add(&draft, job->builder, error);
    if (ok && builder_count(job->builder, BLOB_MESHES) > next &&
        (!draft.sided || job->flat_normals))
        job->unsided[job->unsided_count++] = (uint32_t)next;
    mesh_free(&draft);
    return ok;
}

/* Makes room for the meshes that a node adds. */
static bool begin_meshes(assimp_job *job, size_t count, base_error *error) {
    if (count <= job->unsided_capacity)
        return true;
    uint32_t *const unsided = realloc(job->unsided, count * sizeof *unsided);
    if (!unsided)
        return base_fail(error, job->sources->subject, "does not fit into memory");
    job->unsided = unsided;
    job->unsided_capacity = count;
    return true;
}

/* Finishes the meshes of a node: decides which sides are fronts. */
static bool end_meshes(assimp_job *job, base_error *error) {
    const size_t count = job->unsided_count;
    job->unsided_count = 0;
    return sides_turn_outwards(job->builder, job->unsided, count) ||
           base_fail(error, job->sources->subject, "does not fit into memory");
}

/* Adds a mesh once, however many nodes show it, and an instance of it; a matrix that does not fit
 * an instance gets a mesh of its own. */
static bool place_mesh(assimp_job *job, const struct aiScene *imported, unsigned number,
                       const double world[16], base_error *error) {
    static const double same[16] = { [0] = 1, [5] = 1, [10] = 1, [15] = 1 };
    const struct aiMesh *mesh = imported->mMeshes[number];
    const size_t next = builder_count(job->builder, BLOB_MESHES);
    const bool fits = scene_instance_set(&(scene_instance) { 0 }, world);
    const mesh_transform transform = mesh_transform_make(fits ? same : world);
    if (!fits) {
        const bool ok = add_mesh(job, mesh, &transform, error);
        builder_instances(job->builder, next);
        return ok;
    }
    if (job->shared[number] == MESH_UNREAD) {
        if (!add_mesh(job, mesh, &transform, error))
            return false;
        const bool empty = builder_count(job->builder, BLOB_MESHES) == next;
        job->shared[number] = empty ? MESH_EMPTY : (uint32_t)next;
    }
    const uint32_t shared = job->shared[number];
    return shared == MESH_EMPTY || builder_place(job->builder, shared, world) ||
           base_fail(error, job->sources->subject, "does not fit into memory");
}

static bool add_node(assimp_job *job, const struct aiScene *imported, const struct aiNode *node,
                     const double parent[16], int depth, base_error *error) {
    if (depth > NODE_DEPTH_MAX)
        return base_fail(error, job->sources->subject, "has nodes nested too deep");
    const struct aiMatrix4x4 m = node->mTransformation;
    const double local[16] = { (double)m.a1, (double)m.b1, (double)m.c1, 0.0,
                               (double)m.a2, (double)m.b2, (double)m.c2, 0.0,
                               (double)m.a3, (double)m.b3, (double)m.c3, 0.0,
                               (double)m.a4, (double)m.b4, (double)m.c4, 1.0 };
    double world[16];
    scene_multiply(parent, local, world);
    if (!begin_meshes(job, node->mNumMeshes, error))
        return false;
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (!place_mesh(job, imported, node->mMeshes[i], world, error))
            return false;
    if (!end_meshes(job, error))
        return false;
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        job->lost_nodes |= !node->mChildren[i];
        if (node->mChildren[i] &&
            !add_node(job, imported, node->mChildren[i], world, depth + 1, error))
            return false;
    }
    return true;
}

/* Shows every mesh that no node shows because Assimp lost the node, as it does in RAW files of
 * several objects. */
static bool add_lost(assimp_job *job, const struct aiScene *imported, const double world[16],
                     base_error *error) {
    if (!begin_meshes(job, imported->mNumMeshes, error))
        return false;
    for (unsigned i = 0; job->lost_nodes && i < imported->mNumMeshes; i++)
        if (job->shared[i] == MESH_UNREAD && !place_mesh(job, imported, i, world, error))
            return false;
    return end_meshes(job, error);
}

/* Counts meshes with visible vertex colors. Assimp's readers represent missing colors by
 * transparent ones. */
static size_t count_colored(const struct aiScene *imported) {
    size_t count = 0;
    for (unsigned i = 0; i < imported->mNumMeshes; i++) {
        const struct aiMesh *const mesh = imported->mMeshes[i];
        bool colored = false;
        for (unsigned k = 0; mesh->mColors[0] && k < mesh->mNumVertices && !colored; k++) {
            const struct aiColor4D c = mesh->mColors[0][k];
            colored = c.a >= 1.0f && !(c.r == 1.0f && c.g == 1.0f && c.b == 1.0f);
        }
        count += colored;
    }
    return count;
}

/* Whether z is up in a FBX file, which says so; newer versions of Assimp rotate its root by that.
 */
static bool says_z_is_up(const struct aiScene *imported) {
    const struct aiMetadata *const said = imported->mMetaData;
    for (unsigned i = 0; said && i < said->mNumProperties; i++)
        if (strcmp(said->mKeys[i].data, "UpAxis") == 0 && said->mValues[i].mType == AI_INT32)
            return *(const int32_t *)said->mValues[i].mData == 2 &&
                   imported->mRootNode->mTransformation.b2 != 0.0f;
    return false;
}

/* Whether z is up in the format, and Assimp leaves it so. It rotates 3DS, ASE, DXF, IFC and the
 * models of Quake, and COLLADA by its <up_axis>. */
static bool has_z_up(const char *name) {
    static const char *const endings[] = { ".3mf", ".amf", ".blend", ".cob", ".hmp",
                                           ".scn", ".smd", ".stl",   ".ter", ".vta" };
    const char *const dot = strrchr(name, '.');
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(dot, endings[i]) == 0)
            return true;
    return false;
}

bool assimp_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
                base_error *error) {
    assimp_job job = { .name = file_base_name(sources->subject),
                       .data = data,
                       .size = size,
                       .sources = sources,
                       .builder = builder };
    const double *const origin = builder->origin;
    const double scene_from_file[16] = { 1, 0, 0, 0, 0,          1,          0,          0,
                                         0, 0, 1, 0, -origin[0], -origin[1], -origin[2], 1 };
    /* M_PERTURB fills allocated memory with the complement of the number, and freed memory with the
     * number: what Assimp forgets to set is 0, the same in every run. */
    if (sources->sandboxed)
        mallopt(M_PERTURB, 0xff);
    const struct aiScene *imported = run_assimp(&job, error);
    if (!imported)
        return false;
    if (has_z_up(job.name) || says_z_is_up(imported))
        builder->up = SCENE_UP_Z;
    job.shared = malloc((imported->mNumMeshes + 1) * sizeof *job.shared);
    const char *const dot = strrchr(job.name, '.');
    job.flat_normals = dot && strcasecmp(dot, ".stl") == 0;
    for (unsigned i = 0; job.shared && i < imported->mNumMeshes; i++)
        job.shared[i] = MESH_UNREAD;
    const bool ok =
        (job.shared || base_fail(error, sources->subject, "does not fit into memory")) &&
        add_node(&job, imported, imported->mRootNode, scene_from_file, 0, error) &&
        add_lost(&job, imported, scene_from_file, error) &&
        assimp_add_materials(imported, sources, builder, error);
    free(job.shared);
    free(job.unsided);
    builder_unsupported(builder, "vertex colors", "mesh", count_colored(imported));
    builder_unsupported(builder, NULL, "light", imported->mNumLights);
    builder_unsupported(builder, NULL, "camera", imported->mNumCameras);
    builder_unsupported(builder, NULL, "animation", imported->mNumAnimations);
    /* A child does not free the import, because it ends anyway and some of Assimp's readers leave
     * data that cannot be freed: textures of 3MF would end in an abort. */
    if (!sources->sandboxed)
        assimp.aiReleaseImport(imported);
    return ok;
}
