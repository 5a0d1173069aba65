/* SPDX-License-Identifier: MIT */
#include "app/scene/load/texels.h"

#include "app/base/progress.h"
#include "app/base/sandbox.h"
#include "app/scene/blob.h"
#include "app/scene/texture.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define CHILDREN_MAX 8

/* A run of consecutive images that one child decodes. */
typedef struct image_run {
    const scene *scene;
    size_t first, end;
    double *shown; /* of all children: the most progress that any has reported */
} image_run;

/* Returns the bytes of a run's texels, up to the end of the last image's last page. The child's
 * output ends with one more byte per image, 1 where it cannot be decoded. */
static uint64_t texels_of(const image_run *run) {
    const scene_image *images = run->scene->images;
    return blob_first_texel(texture_texels_end(&images[run->end - 1])) -
           images[run->first].first_texel;
}

static bool fail_memory(const scene *s, base_error *error) {
    return base_fail(error, s->name, "has textures that do not fit into memory");
}

/* --- in the child ----------------------------------------------------------------------------- */

static bool decode_one(const scene *s, const scene_image *image, int output,
                       unsigned char *undecodable, base_error *error) {
    const uint64_t end = texture_texels_end(image);
    const size_t size = blob_first_texel(end) - image->first_texel;
    unsigned char *texels = calloc(size, 1);
    base_error reason;
    bool ok = texels || fail_memory(s, error);
    if (ok && !texture_decode(image, s->encoded, texels, s->name, &reason)) {
        *undecodable = 1;
        memset(texels, 0, size);
        ok = !base_is_out_of_memory(&reason) || fail_memory(s, error);
    }
    ok = ok && (sandbox_write(output, texels, size) || fail_memory(s, error));
    free(texels);
    return ok;
}

static bool decode_run(void *context, int output, base_error *error) {
    const image_run *run = context;
    const scene *s = run->scene;
    unsigned char *undecodable = calloc(run->end - run->first, 1);
    bool ok = undecodable || fail_memory(s, error);
    for (size_t i = run->first; ok && i < run->end; i++) {
        sandbox_progress((double)(i - run->first) / (double)(run->end - run->first));
        ok = decode_one(s, &s->images[i], output, &undecodable[i - run->first], error);
    }
    ok = ok && (sandbox_write(output, undecodable, run->end - run->first) || fail_memory(s, error));
    free(undecodable);
    return ok;
}

/* --- what cannot be decoded ------------------------------------------------------------------- */

bool scene_own_lists(scene *s, base_error *error) {
    if (s->own_materials)
        return true;
    s->own_materials = malloc((s->material_count + 1) * sizeof *s->own_materials);
    s->own_unsupported = malloc((SCENE_UNSUPPORTED_MAX + 1) * sizeof *s->own_unsupported);
    if (!s->own_materials || !s->own_unsupported)
        return fail_memory(s, error);
    if (s->material_count > 0)
        memcpy(s->own_materials, s->materials, s->material_count * sizeof *s->own_materials);
    if (s->unsupported_count > 0)
        memcpy(s->own_unsupported, s->unsupported,
               s->unsupported_count * sizeof *s->own_unsupported);
    s->materials = s->own_materials;
    s->unsupported = s->own_unsupported;
    return true;
}

/* Removes an image that cannot be decoded from the materials that show it, and notes it. */
static bool leave_out(scene *s, const scene_image *image, base_error *error) {
    if (!scene_own_lists(s, error))
        return false;
    texture_forget(s->own_materials, s->material_count, s->textures, image);
    if (s->unsupported_count < SCENE_UNSUPPORTED_MAX) {
        scene_unsupported *item = &s->own_unsupported[s->unsupported_count++];
        *item = (scene_unsupported) { .noun = TEXTURE_UNDECODABLE, .count = 1 };
        memcpy(item->what, image->name, sizeof item->what);
    }
    return true;
}

/* --- in the parent ---------------------------------------------------------------------------- */

static void show_progress(void *context, double done) {
    const image_run *run = context;
    *run->shown = fmax(*run->shown, done);
    progress_show("decoding", *run->shown);
}

/* Divides the images among the children so that texels are balanced to within one image. */
static size_t share_out(const scene *s, double *shown, image_run runs[CHILDREN_MAX],
                        sandbox_job jobs[CHILDREN_MAX]) {
    const size_t threads = (size_t)omp_get_max_threads();
    const size_t most = threads < CHILDREN_MAX ? threads : CHILDREN_MAX;
    const uint64_t all = texture_texels_end(&s->images[s->image_count - 1]);
    size_t count = 0;
    for (size_t first = 0, end; first < s->image_count; first = end) {
        const uint64_t until = all / most * (count + 1);
        sandbox_job job = { .subject = s->name,
                            .context = &runs[count],
                            .work = decode_run,
                            .progress = show_progress,
                            .cancelled = progress_cancelled };
        for (end = first; end < s->image_count &&
                          (end == first || count + 1 == most || s->images[end].first_texel < until);
             end++)
            job.input_bytes += s->images[end].size;
        runs[count] = (image_run) { s, first, end, shown };
        jobs[count++] = job;
    }
    return count;
}

/* Moves a child's texels into the scene; *block and *size become what remains. */
static bool take_run(scene *s, const image_run *run, char *whole, void **block, size_t *size,
                     base_error *error) {
    const uint64_t texels = texels_of(run);
    char *to = whole + s->images[run->first].first_texel, *from = *block;
    if (*size != texels + (run->end - run->first))
        return base_fail(error, s->name, "has textures that cannot be decoded");
    for (size_t i = run->first; i < run->end; i++)
        if (from[texels + (i - run->first)] && !leave_out(s, &s->images[i], error))
            return false;
    if (mremap(from, texels, texels, MREMAP_MAYMOVE | MREMAP_FIXED, to) == to) {
        *block = from + texels;
        *size -= texels;
    } else { /* pages are larger than BLOB_PAGE */
        memcpy(to, from, texels);
    }
    return true;
}

static bool join_runs(scene *s, const image_run *runs, size_t count, void **blocks, size_t *sizes,
                      base_error *error) {
    const uint64_t end = texture_texels_end(&s->images[s->image_count - 1]);
    const size_t size = blob_first_texel(end);
    bool ok = true;
    void *whole = mmap(NULL, size, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (whole == MAP_FAILED)
        return fail_memory(s, error);
    s->decoded = whole;
    s->decoded_size = size;
    for (size_t i = 0; ok && i < count; i++)
        ok = take_run(s, &runs[i], whole, &blocks[i], &sizes[i], error);
    s->texels = whole;
    s->texel_bytes = end;
    return ok;
}

bool scene_decode_images(scene *s, base_error *error) {
    image_run runs[CHILDREN_MAX];
    sandbox_job jobs[CHILDREN_MAX];
    void *blocks[CHILDREN_MAX] = { NULL };
    size_t sizes[CHILDREN_MAX];
    double shown = 0;
    if (s->image_count == 0)
        return true;
    const size_t count = share_out(s, &shown, runs, jobs);
    const bool decoded = sandbox_run_all(jobs, count, blocks, sizes, error);
    progress_end();
    if (!decoded)
        return false;
    const bool ok = join_runs(s, runs, count, blocks, sizes, error);
    for (size_t i = 0; i < count; i++)
        munmap(blocks[i], sizes[i]);
    return ok;
}
