/* SPDX-License-Identifier: MIT */
#include "app/scene/load/import.h"

#include "app/base/choice.h"
#include "app/base/file.h"
#include "app/base/file_hash.h"
#include "app/base/progress.h"
#include "app/base/sandbox.h"
#include "app/scene/builder.h"
#include "app/scene/gltf/gltf.h"
#include "app/scene/instance.h"
#include "app/scene/load/assimp.h"
#include "app/scene/load/assimp_library.h"
#include "app/scene/load/cache.h"
#include "app/scene/load/collada.h"
#include "app/scene/load/emission.h"
#include "app/scene/load/obj.h"
#include "app/scene/load/off.h"
#include "app/scene/load/origin.h"
#include "app/scene/load/ply.h"
#include "app/scene/load/text.h"
#include "app/scene/load/up.h"

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

/* One import; the child works on a copy of it. */
typedef struct import_job {
    const char *path;      /* as the user wrote it */
    const char *name;      /* without the folder */
    char folder[PATH_MAX]; /* real path */
    void *data;
    size_t size;
    origin_reader *read;
    int up, mesh_lights; /* as in scene_options */
    source_set sources;
} import_job;

/* --- the child's work ------------------------------------------------------------------------- */

/* Records the files that were read and those that could not be: the scene depends on both. */
static bool add_sources(const import_job *job, scene_builder *builder) {
    const source_set *sources = &job->sources;
    for (size_t i = 0; i < sources->absent_count && sources->count + i < BLOB_SOURCES_MAX; i++) {
        blob_source *item = builder_append(builder, BLOB_SOURCES, 1);
        if (!item)
            return false;
        strcpy(item->path, sources->absent[i]);
        item->size = BLOB_SOURCE_ABSENT;
    }
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

/* Whether any triangle has an area, which in double precision is above 0 even for the smallest. */
static bool has_area(const scene_builder *builder) {
    const scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    const uint32_t *indices = builder_items(builder, BLOB_INDICES);
    for (size_t i = 0; i + 2 < builder_count(builder, BLOB_INDICES); i += 3) {
        const float *a = vertices[indices[i]].position, *b = vertices[indices[i + 1]].position,
                    *c = vertices[indices[i + 2]].position;
        double u[3], v[3];
        for (int k = 0; k < 3; k++) {
            u[k] = (double)b[k] - (double)a[k];
            v[k] = (double)c[k] - (double)a[k];
        }
        if (u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0])
            return true;
    }
    return false;
}

static bool check_instances(const import_job *job, const scene_builder *builder,
                            base_error *error) {
    scene s;
    builder_geometry(builder, &s);
    if (scene_triangle_count(&s) > UINT32_MAX / 3)
        return base_fail(error, job->path, "has more than 4 billion vertices");
    for (size_t i = 0; i < s.instance_count; i++) {
        float box[2][3];
        scene_instance_box(&s, i, box[0], box[1]);
        for (int k = 0; k < 6; k++)
            if (!(fabsf(box[k / 3][k % 3]) <= LMP_LENGTH_MAX))
                return base_fail(error, job->path,
                                 "has a vertex that has no finite position (up to %g)",
                                 (double)LMP_LENGTH_MAX);
    }
    return true;
}

/* Names the first thing that was left out, which tells what the file has instead. */
static bool fail_without_triangles(const import_job *job, const scene_builder *builder,
                                   base_error *error) {
    char left_out[256];
    if (builder_count(builder, BLOB_UNSUPPORTED) == 0)
        return base_fail(error, job->path, "has no triangles");
    scene_unsupported_text(builder_items(builder, BLOB_UNSUPPORTED), left_out, sizeof left_out);
    return base_fail(error, job->path, "has no triangles (left out: %s)", left_out);
}

/* Rejects what a valid file never contains, so that the parent's validation finds damage alone. */
static bool check_made(const import_job *job, const scene_builder *builder, base_error *error) {
    const scene_mesh *meshes = builder_items(builder, BLOB_MESHES);
    const scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    const lmp_vec3 *offsets = builder_items(builder, BLOB_OFFSETS);
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++)
        if (meshes[i].material >= builder_count(builder, BLOB_MATERIALS))
            return base_fail(error, job->path, "has a mesh whose material does not exist");
    for (size_t i = 0; i < builder_count(builder, BLOB_VERTICES); i++) {
        for (int k = 0; k < 3; k++)
            if (!(fabsf(vertices[i].position[k]) <= LMP_LENGTH_MAX))
                return base_fail(error, job->path,
                                 "has a vertex that has no finite position (up to %g)",
                                 (double)LMP_LENGTH_MAX);
    }
    if (!check_instances(job, builder, error))
        return false;
    for (size_t i = 0; i < builder_count(builder, BLOB_OFFSETS); i++)
        if (!(fabsf(offsets[i].x) <= LMP_LENGTH_MAX && fabsf(offsets[i].y) <= LMP_LENGTH_MAX &&
              fabsf(offsets[i].z) <= LMP_LENGTH_MAX))
            return base_fail(error, job->path, "has a light that moves beyond reach (up to %g)",
                             (double)LMP_LENGTH_MAX);
    if (builder_count(builder, BLOB_LIGHTS) > SCENE_LIGHTS_MAX)
        return base_fail(error, job->path, "has %zu lights (at most %d)",
                         builder_count(builder, BLOB_LIGHTS), SCENE_LIGHTS_MAX);
    if (builder_count(builder, BLOB_INDICES) == 0)
        return fail_without_triangles(job, builder, error);
    if (!has_area(builder))
        return base_fail(error, job->path, "has no triangles but those without an area");
    return true;
}

static bool write_blob(const scene_builder *builder, int output) {
    static const char zeros[16];
    blob_header header;
    builder_header(builder, true, &header);
    uint64_t at = sizeof header;
    bool ok = sandbox_write(output, &header, sizeof header);
    for (int i = 0; ok && i < BLOB_SECTIONS; i++) {
        const size_t bytes = builder_count(builder, (blob_section)i) * blob_item_size[i];
        ok = sandbox_write(output, zeros, header.sections[i].offset - at) &&
             sandbox_write(output, builder_items(builder, (blob_section)i), bytes);
        at = header.sections[i].offset + bytes;
    }
    return ok;
}

/* Converts the text so that Assimp can read it: Assimp supports UTF-16 in few formats, and in
 * COLLADA no number after a blank. */
static bool make_readable(import_job *job, base_error *error) {
    const char *const dot = strrchr(job->name, '.');
    if (!text_to_utf8(&job->data, &job->size))
        return base_fail(error, job->path, "does not fit into memory");
    if (!dot || strcasecmp(dot, ".dae") != 0)
        return true;
    job->size = text_trim_xml(job->data, job->size);
    return collada_check(job->data, job->size, job->path, error);
}

static bool import_in_child(void *context, int output, base_error *error) {
    import_job *job = context;
    job->sources.sandboxed = true;
    scene_builder builder = { 0 };
    if (!make_readable(job, error) ||
        !origin_read(job->read, job->data, job->size, &job->sources, &builder, error))
        return false;
    up_stand(&builder, job->up);
    if (!check_made(job, &builder, error) ||
        !emission_add_lights(&builder, (size_t)job->mesh_lights, job->path, error) ||
        !check_made(job, &builder, error))
        return false;
    if (!add_sources(job, &builder) || builder.out_of_memory || !write_blob(&builder, output))
        return base_fail(error, job->path, "does not fit into memory");
    return true;
}

/* --- the parent ------------------------------------------------------------------------------- */

/* Returns our own reader of a file, by its first bytes or its name, or NULL. */
static origin_reader *own_reader_of(const char *path, const void *data, size_t size) {
    const char *bytes = data, *dot = strrchr(path, '.');
    if (size >= 4 && memcmp(bytes, "glTF", 4) == 0)
        return gltf_add;
    size_t start = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (start < size && strchr(" \t\r\n", bytes[start]) && bytes[start])
        start++;
    if (start < size && bytes[start] == '{')
        return gltf_add;
    if (dot && (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0))
        return gltf_add;
    if (dot && strcasecmp(dot, ".obj") == 0)
        return obj_add;
    if (dot && strcasecmp(dot, ".ply") == 0)
        return ply_add;
    if (dot && strcasecmp(dot, ".off") == 0)
        return off_add;
    return NULL;
}

/* Finds the reader of a file: our own or Assimp, which is opened only for a file that needs it. */
static bool find_reader(const char *path, import_job *job, base_error *error) {
    const char *const dot = strrchr(path, '.');
    job->read = own_reader_of(path, job->data, job->size);
    if (job->read)
        return true;
    if (!assimp_open(error))
        return false;
    if (dot && assimp_knows(dot)) {
        job->read = assimp_add;
        return true;
    }
    return base_fail(error, path,
                     "is not a scene that can be read: give a .gltf, .glb, .obj, .ply, .off, .stl "
                     "or .fbx file");
}

/* Splits the path, reads the file and finds its reader. */
static bool prepare(const char *path, import_job *job, base_error *error) {
    const char *slash = strrchr(path, '/');
    char folder[PATH_MAX] = ".";
    *job = (import_job) { .path = path, .name = slash ? slash + 1 : path };
    if (strlen(path) >= sizeof folder)
        return base_fail(error, NULL, "%.64s…: is too long a name", path);
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    if (!file_read(path, SCENE_SIZE_LIMIT, &job->data, &job->size, error))
        return false;
    if (job->size == 0)
        return base_fail(error, path, "is empty");
    if (!find_reader(path, job, error))
        return false;
    if (!realpath(folder, job->folder))
        return base_fail(error, path, "is in a folder that cannot be opened: %s", strerror(errno));
    /* the file was inside, but its folder may have been swapped since */
    if (!file_may_lead_to(path, job->folder))
        return base_fail(error, path, FILE_LEADS_OUT);
    job->sources.subject = path;
    job->sources.folder = job->folder;
    return true;
}

static int open_source(void *context, const char *name, base_error *error) {
    import_job *job = context;
    return sources_open(&job->sources, name, error);
}

static void show_progress(void *context, double done) {
    (void)context;
    progress_show("reading", done);
}

static bool import_fresh(import_job *job, void **block, size_t *size, base_error *error) {
    const sandbox_job work = { .subject = job->path,
                               .input_bytes = job->size,
                               .context = job,
                               .work = import_in_child,
                               .open = open_source,
                               .progress = show_progress,
                               .cancelled = progress_cancelled };
    const bool ok = sandbox_run(&work, block, size, error);
    progress_end();
    if (!ok)
        return false;
    if (blob_validate(*block, *size, true, job->path, error))
        return true;
    munmap(*block, *size);
    return false;
}

/* Whether a block's list of sources is full. Names may be missing from it, so the cache could not
 * notice that one of these files has appeared. */
static bool has_too_many_sources(const void *block) {
    const blob_header *header = block;
    return header->sections[BLOB_SOURCES].count >= BLOB_SOURCES_MAX;
}

/* Fails if a variant is requested of a format without variants: only glTF has them. */
static bool may_have_variants(const import_job *job, base_error *error) {
    const char *variant = job->sources.variant;
    return !variant || job->read == gltf_add ||
           choice_fail_member(error, job->path, "variant", variant, NULL, 0, 0);
}

bool import_scene(const char *path, const scene_options *options, scene *s, base_error *error) {
    const bool no_cache = options->no_cache;
    import_job job;
    void *block = NULL;
    size_t size = 0;
    bool ok = prepare(path, &job, error), cached = false;
    job.up = options->up;
    job.mesh_lights = options->mesh_lights;
    job.sources.variant = options->variant;
    ok = ok && may_have_variants(&job, error);
    if (ok) {
        const file_hash key = cache_key(job.folder, job.name, job.data, job.size, options);
        cached = !no_cache && cache_load(&key, &job.sources, &block, &size);
        sources_free(&job.sources);
        ok = cached || import_fresh(&job, &block, &size, error);
        if (ok && !cached && !no_cache && !has_too_many_sources(block))
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
