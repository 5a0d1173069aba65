/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_part.h"
#include "app/base/error.h"
#include "app/base/file_hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- writing ---------------------------------------------------------------------------------- */

/* Whether a word is an option in which the parts of one run differ; *value_follows is whether its
 * value is the next word. */
static bool is_of_the_part(const char *word, bool *value_follows) {
    static const char *const options[] = { "--output", "--shard", "--threads" };
    for (size_t k = 0; k < sizeof options / sizeof *options; k++) {
        const size_t length = strlen(options[k]);
        if (strncmp(word, options[k], length) != 0 || (word[length] && word[length] != '='))
            continue;
        *value_follows = !word[length];
        return true;
    }
    *value_follows = strcmp(word, "-o") == 0;
    return strncmp(word, "-o", 2) == 0;
}

static void add_image(file_hash *hash, const image *pixels) {
    if (pixels->rgb)
        file_hash_add(hash, pixels->rgb,
                      3 * sizeof(float) * (size_t)pixels->width * (size_t)pixels->height);
}

/* Hashes everything that was read, because what the words name may change between parts. */
static file_hash hash_of(const reference_settings *settings, const scene *world,
                         char *const *words) {
    file_hash hash = { 0, 0 };
    file_hash_add(&hash, world->block, world->block_size);
    for (size_t i = 0; i < world->light_count; i++) {
        file_hash_add(&hash, &world->lights[i].emitter, sizeof world->lights[i].emitter);
        file_hash_add(&hash, &world->lights[i].hidden, sizeof world->lights[i].hidden);
    }
    if (settings->environment) {
        add_image(&hash, &settings->environment->light);
        add_image(&hash, &settings->environment->backdrop);
    }
    for (size_t i = 0; settings->materials && i < world->material_count; i++)
        file_hash_add(&hash, &settings->materials[i].made_from, sizeof(file_hash));
    for (; *words; words++) {
        bool value_follows;
        if (!is_of_the_part(*words, &value_follows))
            file_hash_add(&hash, *words, strlen(*words) + 1);
        else if (value_follows && words[1])
            words++;
    }
    return hash;
}

static void fill(image *pixels, const float rgb[3]) {
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    for (size_t i = 0; i < count; i++)
        pixels->rgb[i] = rgb[i % 3];
}

bool reference_part_write(const char *path, const reference_settings *settings, const scene *world,
                          char *const *words, const image_layer layers[2], base_error *error) {
    const file_hash hash = hash_of(settings, world, words);
    const uint64_t mask = 0xFFFFFF;
    const float run[3] = { (float)(hash.low & mask), (float)(hash.low >> 24 & mask),
                           (float)(hash.high & mask) };
    const float part[3] = { (float)reference_samples(settings), (float)settings->shard[0],
                            (float)settings->shard[1] };
    image which, from = { .rgb = NULL };
    bool ok = image_create(&which, settings->width, settings->height, error) &&
              image_create(&from, settings->width, settings->height, error);
    if (ok) {
        const image_layer all[] = { layers[0], layers[1], { "part", &which }, { "run", &from } };
        fill(&which, part);
        fill(&from, run);
        ok = image_write_exr_layers(path, all, 4, error);
    }
    image_free(&which);
    image_free(&from);
    return ok;
}

/* --- joining ---------------------------------------------------------------------------------- */

/* The description of a part, stored in all of its pixels. */
typedef struct stamp {
    int width, height;
    float part[3], run[3];
} stamp;

static bool read_constant(const char *path, const char *layer, stamp *of, float rgb[3],
                          base_error *error) {
    image pixels;
    if (!image_read_layer(path, layer, &pixels, error))
        return false;
    of->width = pixels.width;
    of->height = pixels.height;
    memcpy(rgb, pixels.rgb, 3 * sizeof *rgb);
    image_free(&pixels);
    return true;
}

static bool is_whole(float number, float most) {
    return number >= 1 && number <= most && number == floorf(number);
}

static bool read_stamp(const char *path, stamp *of, base_error *error) {
    if (!read_constant(path, "run", of, of->run, error) ||
        !read_constant(path, "part", of, of->part, error))
        return false;
    if (is_whole(of->part[0], REFERENCE_SAMPLES_MAX) &&
        is_whole(of->part[2], REFERENCE_PARTS_MAX) && is_whole(of->part[1], of->part[2]))
        return true;
    return base_fail(error, path, "is not part of a reference (layer \"part\" is damaged)");
}

/* Checks that all parts belong to the run of the first, and that none is repeated. */
static bool check_parts(char *const *paths, int count, stamp *stamps, base_error *error) {
    for (int i = 0; i < count; i++) {
        const stamp *const first = &stamps[0], *const own = &stamps[i];
        if (!read_stamp(paths[i], &stamps[i], error))
            return false;
        if (own->width != first->width || own->height != first->height ||
            own->part[2] != first->part[2] || memcmp(own->run, first->run, sizeof own->run) != 0)
            return base_fail(error, paths[i], "is of another scene or other settings than %s",
                             paths[0]);
        for (int k = 0; k < i; k++)
            if (stamps[k].part[1] == own->part[1])
                return base_fail(error, paths[i], "is part %g of %g, as %s is",
                                 (double)own->part[1], (double)own->part[2], paths[k]);
    }
    return true;
}

/* Checks that no part is missing. */
static bool check_complete(const stamp *stamps, int count, base_error *error) {
    const int parts = (int)stamps[0].part[2];
    for (int part = 1; part <= parts && count < parts; part++) {
        int at = 0;
        while (at < count && (int)stamps[at].part[1] != part)
            at++;
        if (at == count)
            return base_fail(error, NULL, "part %d of %d is missing (--partial joins the others)",
                             part, parts);
    }
    return true;
}

/* For each channel of each pixel, the mean so far and the sum of squared deviations from it. */
typedef struct sums {
    double *mean, *squares, samples;
    size_t count;
} sums;

/* Combines the sums of squares of two sets (Chan, Golub and LeVeque 1979). */
static void add_part(sums *all, const stamp *from, const image *mean, const image *error) {
    const double n = (double)from->part[0], total = all->samples + n;
    for (size_t i = 0; i < all->count; i++) {
        const double apart = (double)mean->rgb[i] - all->mean[i], s = (double)error->rgb[i];
        all->squares[i] += s * s * n * (n - 1) + apart * apart * all->samples * n / total;
        all->mean[i] += apart * n / total;
    }
    all->samples = total;
}

/* Whether all values are finite: any other value would spread to the joined image. */
static bool is_valid(const image *mean, const image *spread) {
    const size_t count = 3 * (size_t)mean->width * (size_t)mean->height;
    for (size_t i = 0; i < count; i++)
        if (!isfinite(mean->rgb[i]) || !isfinite(spread->rgb[i]) || spread->rgb[i] < 0)
            return false;
    return true;
}

static bool add_file(sums *all, const char *path, const stamp *from, base_error *error) {
    image mean, spread = { .rgb = NULL };
    const bool ok = image_read(path, IMAGE_READ_PIXELS, &mean, error) &&
                    image_read_layer(path, "stderr", &spread, error);
    const bool fits = ok && mean.width == from->width && spread.width == from->width &&
                      mean.height == from->height && spread.height == from->height;
    const bool valid = fits && is_valid(&mean, &spread);
    if (valid)
        add_part(all, from, &mean, &spread);
    image_free(&mean);
    image_free(&spread);
    if (ok && !valid)
        return base_fail(error, path,
                         fits ? "has values that are not finite, or negative errors"
                              : "has layers of several sizes");
    return valid;
}

static void store(const sums *all, image *radiance, image *standard_error) {
    const double n = all->samples;
    for (size_t i = 0; i < all->count; i++) {
        radiance->rgb[i] = (float)all->mean[i];
        standard_error->rgb[i] = n > 1 ? (float)sqrt(all->squares[i] / (n * (n - 1))) : 0;
    }
}

bool reference_parts_join(char *const *paths, int count, bool partial, image *radiance,
                          image *standard_error, base_error *error) {
    stamp *const stamps = calloc((size_t)count, sizeof *stamps);
    sums all = { .samples = 0 };
    *radiance = *standard_error = (image) { .rgb = NULL };
    bool ok = (stamps || base_fail(error, NULL, "out of memory")) &&
              check_parts(paths, count, stamps, error) &&
              (partial || check_complete(stamps, count, error)) &&
              image_create(radiance, stamps[0].width, stamps[0].height, error) &&
              image_create(standard_error, stamps[0].width, stamps[0].height, error);
    if (ok) {
        all.count = 3 * (size_t)radiance->width * (size_t)radiance->height;
        all.mean = calloc(all.count, sizeof *all.mean);
        all.squares = calloc(all.count, sizeof *all.squares);
        ok = (all.mean && all.squares) || base_fail(error, NULL, "out of memory");
    }
    for (int i = 0; ok && i < count; i++)
        ok = add_file(&all, paths[i], &stamps[i], error);
    if (ok) {
        store(&all, radiance, standard_error);
    } else {
        image_free(radiance);
        image_free(standard_error);
    }
    free(all.mean);
    free(all.squares);
    free(stamps);
    return ok;
}
