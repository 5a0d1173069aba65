/* SPDX-License-Identifier: MIT */
#include "app/scene/import.h"

#include "app/scene/builder.h"
#include "app/scene/cache.h"
#include "app/scene/emission.h"
#include "app/scene/gltf.h"
#include "app/scene/mesh.h"
#include "app/scene/mtl.h"
#include "app/scene/sandbox.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#define SCENE_SIZE_LIMIT ((size_t)4 << 30)
#define OBJ_CREASE_COS   0.5f /* 60° */
#define FLAT_CREASE_COS  2.0f /* glTF: without normals, faces are flat */

typedef enum scene_format { FORMAT_NONE, FORMAT_GLTF, FORMAT_GLB, FORMAT_OBJ } scene_format;

/* One import; the child gets a copy of it. */
typedef struct import_job {
    const char *path;      /* as the user wrote it */
    const char *name;      /* without its folder */
    char folder[PATH_MAX]; /* real path */
    void *data;
    size_t size;
    scene_format format;
    source_set sources;
    cli_error *refusal; /* set when Assimp asked for a file it may not have */
} import_job;

/* --- files for Assimp: from memory, and only the scene's own ------------------------------------
 */

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

static struct aiFile *open_for_assimp(struct aiFileIO *io, const char *path, const char *mode) {
    import_job *job = (import_job *)(void *)io->UserData;
    while (strncmp(path, "./", 2) == 0)
        path += 2;
    const void *data = job->data;
    size_t size = job->size;
    if (mode[0] != 'r')
        return NULL;
    if (strcmp(path, job->name) != 0) {
        const source *found;
        cli_error error;
        if (!sources_read(&job->sources, path, &found, &error)) {
            if (!job->refusal->text[0])
                *job->refusal = error;
            return NULL;
        }
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

static const struct aiScene *run_assimp(import_job *job, cli_error *error) {
    struct aiFileIO io = { .OpenProc = open_for_assimp,
                           .CloseProc = close_for_assimp,
                           .UserData = (aiUserData)job };
    const struct aiScene *imported = aiImportFileEx(job->name, 0, &io);
    /* A file refused is the cause of what Assimp says, or something silently left out. */
    if (job->refusal->text[0]) {
        *error = *job->refusal;
        return NULL;
    }
    if (!imported || !imported->mRootNode) {
        const char *reason = aiGetErrorString();
        cli_fail(error, job->path, "cannot be read: %.300s",
                 reason && reason[0] ? reason : "it is damaged");
        return NULL;
    }
    return imported;
}

/* --- the child's work ---------------------------------------------------------------------------
 */

static bool add_gltf(import_job *job, scene_builder *builder, cli_error *error) {
    gltf document;
    bool ok = gltf_open(job->data, job->size, &job->sources, &document, error);
    const bool has_meshes = ok && document.meshes.count > 0;
    if (has_meshes) {
        const mesh_options options = { .subject = job->path, .crease_cos = FLAT_CREASE_COS };
        const struct aiScene *imported = run_assimp(job, error);
        ok = imported && mesh_add_tree(imported, &options, builder, error);
        if (imported)
            aiReleaseImport(imported);
    }
    ok = ok && gltf_add_materials(&document, builder, error) &&
         gltf_add_views(&document, builder, error);
    gltf_close(&document);
    return ok;
}

static bool add_obj(import_job *job, scene_builder *builder, cli_error *error) {
    sandbox_expect_input(job->size);
    const mesh_options options = { .subject = job->path,
                                   .weld = true,
                                   .crease_cos = OBJ_CREASE_COS };
    const struct aiScene *imported = run_assimp(job, error);
    if (!imported)
        return false;
    const bool ok = mesh_add_tree(imported, &options, builder, error) &&
                    mtl_add_materials(imported, &job->sources, builder, error);
    aiReleaseImport(imported);
    return ok;
}

static bool add_sources(const import_job *job, scene_builder *builder) {
    for (size_t i = 0; i < job->sources.count; i++) {
        blob_source *item = builder_append(builder, BLOB_SOURCES, 1);
        if (!item)
            return false;
        strcpy(item->path, job->sources.items[i].path);
        item->size = job->sources.items[i].size;
        file_hash_add(&item->hash, job->sources.items[i].data, job->sources.items[i].size);
    }
    return true;
}

/* Clears what a sound file never has, so that the parent's validation is about damage alone. */
static bool check_made(const import_job *job, const scene_builder *builder, cli_error *error) {
    const scene_mesh *meshes = builder_items(builder, BLOB_MESHES);
    const scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++)
        if (meshes[i].material >= builder_count(builder, BLOB_MATERIALS))
            return cli_fail(error, job->path, "has a mesh whose material does not exist");
    for (size_t i = 0; i < builder_count(builder, BLOB_VERTICES); i++) {
        for (int k = 0; k < 3; k++)
            if (!(fabsf(vertices[i].position[k]) <= LMP_LENGTH_MAX))
                return cli_fail(error, job->path,
                                "has a vertex that is not at a finite place (up to %g)",
                                (double)LMP_LENGTH_MAX);
    }
    if (builder_count(builder, BLOB_LIGHTS) > SCENE_LIGHTS_MAX)
        return cli_fail(error, job->path, "has %zu lights (at most %d)",
                        builder_count(builder, BLOB_LIGHTS), SCENE_LIGHTS_MAX);
    if (builder_count(builder, BLOB_INDICES) == 0)
        return cli_fail(error, job->path, "has no triangles");
    return true;
}

static bool write_all(int fd, const void *data, size_t size) {
    const char *bytes = data;
    while (size > 0) {
        const ssize_t written = write(fd, bytes, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        bytes += written;
        size -= (size_t)written;
    }
    return true;
}

static bool write_blob(const scene_builder *builder, int output) {
    static const char zeros[16];
    blob_header header;
    builder_header(builder, true, &header);
    uint64_t at = sizeof header;
    bool ok = write_all(output, &header, sizeof header);
    for (int i = 0; ok && i < BLOB_SECTIONS; i++) {
        const size_t bytes = builder_count(builder, (blob_section)i) * blob_item_size[i];
        ok = write_all(output, zeros, header.sections[i].offset - at) &&
             write_all(output, builder_items(builder, (blob_section)i), bytes);
        at = header.sections[i].offset + bytes;
    }
    return ok;
}

static bool import_in_child(void *context, int output, cli_error *error) {
    import_job *job = context;
    cli_error refusal = { 0 };
    job->refusal = &refusal;
    scene_builder builder = { 0 };
    const bool made =
        job->format == FORMAT_OBJ ? add_obj(job, &builder, error) : add_gltf(job, &builder, error);
    if (!made || !check_made(job, &builder, error) ||
        !emission_add_lights(&builder, job->path, error) || !check_made(job, &builder, error))
        return false;
    if (!add_sources(job, &builder) || builder.out_of_memory || !write_blob(&builder, output))
        return cli_fail(error, job->path, "does not fit into memory");
    return true;
}

/* --- the parent ---------------------------------------------------------------------------------
 */

static scene_format format_of(const char *path, const void *data, size_t size) {
    const char *bytes = data, *dot = strrchr(path, '.');
    if (size >= 4 && memcmp(bytes, "glTF", 4) == 0)
        return FORMAT_GLB;
    size_t start = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (start < size && strchr(" \t\r\n", bytes[start]) && bytes[start])
        start++;
    if (start < size && bytes[start] == '{')
        return FORMAT_GLTF;
    return dot && strcasecmp(dot, ".obj") == 0 ? FORMAT_OBJ : FORMAT_NONE;
}

/* Splits the path, reads the file, tells its format. */
static bool prepare(const char *path, import_job *job, cli_error *error) {
    const char *slash = strrchr(path, '/');
    char folder[PATH_MAX] = ".";
    *job = (import_job) { .path = path, .name = slash ? slash + 1 : path };
    if (strlen(path) >= sizeof folder)
        return cli_fail(error, NULL, "%.64s…: is too long a name", path);
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    if (!file_read(path, SCENE_SIZE_LIMIT, &job->data, &job->size, error))
        return false;
    job->format = format_of(path, job->data, job->size);
    if (job->size == 0)
        return cli_fail(error, path, "is empty");
    if (job->format == FORMAT_NONE)
        return cli_fail(error, path, "is no scene: a .gltf, .glb or .obj file is wanted");
    if (!realpath(folder, job->folder))
        return cli_fail(error, path, "is in a folder that cannot be opened: %s", strerror(errno));
    job->sources.subject = path;
    job->sources.folder = job->folder;
    return true;
}

static void free_sources(source_set *set) {
    for (size_t i = 0; i < set->count; i++)
        free(set->items[i].data);
    free(set->items);
    set->items = NULL;
    set->count = 0;
}

static bool map_output(int fd, const char *path, void **block, size_t *size, cli_error *error) {
    struct stat status;
    *block = MAP_FAILED;
    if (fstat(fd, &status) == 0 && status.st_size > 0) {
        *size = (size_t)status.st_size;
        *block = mmap(NULL, *size, PROT_READ, MAP_PRIVATE, fd, 0);
    }
    return *block != MAP_FAILED || cli_fail(error, path, "does not fit into memory");
}

static bool import_fresh(import_job *job, void **block, size_t *size, cli_error *error) {
    int output;
    if (!sandbox_run(import_in_child, job, job->path, &output, error))
        return false;
    const bool mapped = map_output(output, job->path, block, size, error);
    close(output);
    if (!mapped)
        return false;
    if (blob_validate(*block, *size, true, job->path, error))
        return true;
    munmap(*block, *size);
    return false;
}

bool import_scene(const char *path, bool no_cache, scene *s, cli_error *error) {
    import_job job;
    void *block = NULL;
    size_t size = 0;
    bool ok = prepare(path, &job, error), cached = false;
    if (ok) {
        const file_hash key = cache_key(job.folder, job.name, job.data, job.size);
        cached = !no_cache && cache_load(&key, &job.sources, &block, &size);
        free_sources(&job.sources);
        ok = cached || import_fresh(&job, &block, &size, error);
        if (ok && !cached && !no_cache)
            cache_store(&key, block, size);
    }
    free(job.data);
    if (!ok)
        return false;
    if (!blob_open(block, size, path, s, error)) {
        munmap(block, size);
        return false;
    }
    s->mapped = true;
    s->cached = cached;
    return true;
}
