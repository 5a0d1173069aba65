/* SPDX-License-Identifier: MIT */
#include "app/base/progress.h"
#include "app/truth/reference.h"
#include "app/truth/reference_glow.h"
#include "app/truth/reference_path.h"

#include <omp.h>
#include <stdlib.h>

/* The data that all pixels share. */
typedef struct frame {
    const scene *scene;
    reference_glow glow; /* what lights it: of emissive meshes the triangles */
    const reference_settings *settings;
    const reference_tracer *tracer;
    const reference_environment *environment; /* NULL: none */
    reference_materials materials;
    reference_vec eye, forward, right, up; /* right and up reach the image's edges */
    double parallel;                       /* 1 for parallel rays, 0 for rays from the eye */
    image *radiance, *standard_error;
} frame;

static void set_camera(frame *f) {
    const scene_camera *camera = &f->settings->camera;
    const double top =
        camera->height > 0 ? (double)camera->height / 2 : tan((double)camera->fov / 2);
    const double side = top * f->settings->width / f->settings->height;
    f->parallel = camera->height > 0;
    f->eye = reference_from_floats(camera->eye);
    f->forward =
        reference_normalize(reference_subtract(reference_from_floats(camera->target), f->eye));
    const reference_vec right =
        reference_normalize(reference_cross(f->forward, reference_from_floats(camera->up)));
    f->right = reference_scale(side, right);
    f->up = reference_scale(top, reference_cross(right, f->forward));
}

typedef struct pixel_ray {
    reference_vec from, direction;
} pixel_ray;

/* Returns the ray through the point (x, y) of the image, in pixels. */
static pixel_ray ray_through(const frame *f, double x, double y) {
    const double across = 2 * x / f->settings->width - 1;
    const double along = 1 - 2 * y / f->settings->height;
    const reference_vec aside =
        reference_add(reference_scale(across, f->right), reference_scale(along, f->up));
    const reference_vec direction =
        reference_normalize(reference_add(f->forward, reference_scale(1 - f->parallel, aside)));
    const double start = (double)f->settings->camera.near / reference_dot(direction, f->forward);
    const reference_vec eye = reference_add(f->eye, reference_scale(f->parallel, aside));
    return (pixel_ray) { reference_add(eye, reference_scale(start, direction)), direction };
}

/* Returns the length of the ray up to the camera's far plane. */
static double length_of(const frame *f, const pixel_ray *ray) {
    const double far = (double)f->settings->camera.far;
    const double depth = reference_dot(reference_subtract(ray->from, f->eye), f->forward);
    return far > 0 ? (far - depth) / reference_dot(ray->direction, f->forward) : (double)INFINITY;
}

/* Returns the nearest visible sphere light before `distance`, or NULL. */
static const scene_light *seen_light(const frame *f, const pixel_ray *ray, double distance) {
    const scene_light *nearest = NULL;
    for (size_t i = 0; i < f->scene->light_count; i++) {
        const scene_light *light = &f->scene->lights[i];
        if (!scene_light_is_drawn(light) ||
            !reference_light_is_hit(light, ray->from, ray->direction))
            continue;
        const double at = reference_light_distance(light, ray->from, ray->direction);
        if (at < distance) {
            distance = at;
            nearest = light;
        }
    }
    return nearest;
}

/* The data of one thread. */
typedef struct worker {
    reference_estimator estimator;
    reference_description seen;
    reference_path path; /* of the light that bounces */
} worker;

static void see_backdrop(const frame *f, reference_vec direction, double emission[3]) {
    const environment *e = f->settings->environment;
    if (!e || !e->backdrop.rgb)
        return;
    const lmp_rgb seen = environment_seen(
        e, (float[]) { (float)direction.x, (float)direction.y, (float)direction.z });
    emission[0] = (double)seen.r;
    emission[1] = (double)seen.g;
    emission[2] = (double)seen.b;
}

static void store(image *pixels, size_t pixel, int channel, double value) {
    pixels->rgb[3 * pixel + (size_t)channel] = (float)value;
}

/* The radiance seen along a ray, and its opacity. */
typedef struct ray_radiance {
    double mean[3], standard_error[3], opacity;
    reference_vec behind; /* where the ray continues */
} ray_radiance;

static void see_surface(const frame *f, worker *own, const reference_hit *hit,
                        reference_vec direction, uint64_t key, ray_radiance *seen) {
    const reference_settings *const s = f->settings;
    const bool whole = s->shard[1] == 0;
    const reference_stop stop = { reference_samples(s), s->error, whole ? 0 : s->shard[0] - 1,
                                  s->shard[1] };
    const reference_description *d = &own->seen;
    reference_describe(&f->materials, hit, reference_scale(-1, direction), &own->seen);
    const reference_result result = reference_estimate(&own->estimator, &d->surface, &stop, key);
    for (int c = 0; c < 3; c++) {
        /* renderers clamp the sum of a ringing series at 0 */
        const double mean = d->surface.band_limited && result.mean[c] < 0 ? 0 : result.mean[c];
        seen->mean[c] = mean + d->emission[c];
        seen->standard_error[c] = result.standard_error[c];
    }
    seen->opacity = reference_opacity(&f->materials, hit);
    seen->behind = hit->behind;
}

static ray_radiance see(const frame *f, worker *own, const pixel_ray *ray, uint64_t key) {
    const reference_hit hit = reference_tracer_see(f->tracer, ray->from, ray->direction);
    const double length = length_of(f, ray);
    const scene_light *light = seen_light(f, ray, fmin(hit.distance, length));
    ray_radiance seen = { .opacity = 1 };
    if (light) {
        const float *radiance = &light->emitter.radiance.r;
        for (int c = 0; c < 3; c++)
            seen.mean[c] = (double)radiance[c];
    } else if (isfinite(hit.distance) && hit.distance <= length) {
        see_surface(f, own, &hit, ray->direction, key, &seen);
    } else {
        see_backdrop(f, ray->direction, seen.mean);
    }
    return seen;
}

/* Composites front to back while anything shows through; adds to mean and variance. */
#define SURFACES_MAX 64
static void trace_ray(const frame *f, worker *own, pixel_ray ray, size_t pixel, uint64_t key,
                      double mean[3], double variance[3]) {
    double through = 1;
    for (int i = 0; i < SURFACES_MAX && through > 1e-4; i++) {
        const ray_radiance seen = see(f, own, &ray, key);
        for (int c = 0; c < 3; c++) {
            const double error = through * seen.opacity * seen.standard_error[c];
            mean[c] += through * seen.opacity * seen.mean[c];
            variance[c] += error * error;
        }
        through *= 1 - seen.opacity;
        ray.from = seen.behind;
        key = reference_hash(key, pixel);
    }
}

/* Places ray `index` of `count` in its pixel: each has a row and a column of its own, spread by the
 * golden ratio. A single ray goes through the center. */
static void place_ray(int index, int count, double at[2]) {
    const double column = 0.5 + index * 0.6180339887498949;
    at[0] = (index + 0.5) / count;
    at[1] = (floor((column - floor(column)) * count) + 0.5) / count;
}

static void trace_pixel(const frame *f, worker *own, int x, int y) {
    const size_t pixel = (size_t)y * (size_t)f->settings->width + (size_t)x;
    const int rays = f->settings->rays > 1 ? f->settings->rays : 1;
    double mean[3] = { 0 }, variance[3] = { 0 };
    for (int i = 0; i < rays; i++) {
        const uint64_t key = reference_hash(f->settings->seed, pixel);
        double at[2];
        place_ray(i, rays, at);
        trace_ray(f, own, ray_through(f, x + at[0], y + at[1]), pixel,
                  i == 0 ? key : reference_hash(key, (uint64_t)i), mean, variance);
    }
    for (int c = 0; c < 3; c++) {
        store(f->radiance, pixel, c, mean[c] / rays);
        store(f->standard_error, pixel, c, sqrt(variance[c]) / rays);
    }
}

static bool create_estimator(const frame *f, bool shadows, reference_estimator *estimator) {
    const bool made = reference_estimator_create(estimator, f->glow.lights, f->glow.count);
    estimator->environment = f->environment;
    estimator->emission = reference_glow_emission;
    estimator->emission_user = (void *)(uintptr_t)&f->glow;
    if (shadows) {
        estimator->visibility = reference_tracer_free_path;
        estimator->visibility_user = (void *)(uintptr_t)f->tracer;
    }
    return made;
}

/* Makes the data of a thread; returns false if memory ran out. Free it in any case. */
static bool create_worker(const frame *f, worker *own) {
    *own = (worker) {
        .path = { .materials = &f->materials, .tracer = f->tracer, .bounces = f->settings->bounces }
    };
    const bool shadows = f->settings->shadows;
    const bool made = create_estimator(f, shadows && !f->settings->metering, &own->estimator) &&
                      create_estimator(f, shadows, &own->path.estimator) &&
                      reference_description_create(&f->materials, &own->seen) &&
                      reference_description_create(&f->materials, &own->path.met);
    if (f->settings->bounces > 0) {
        own->estimator.indirect = reference_path_sample;
        own->estimator.indirect_user = &own->path;
    }
    return made;
}

static void free_worker(worker *own) {
    reference_estimator_free(&own->estimator);
    reference_estimator_free(&own->path.estimator);
    reference_description_free(&own->seen);
    reference_description_free(&own->path.met);
}

/* Traces rows in parallel; each pixel has its own random stream. */
static bool trace_rows(const frame *f, int threads) {
    int done = 0;
    bool ok = true;
#pragma omp parallel num_threads(threads)
    {
        worker own;
        const bool mine = create_worker(f, &own);
        if (!mine) {
#pragma omp atomic write
            ok = false;
        }
#pragma omp for schedule(dynamic)
        for (int y = 0; y < f->settings->height; y++) {
            for (int x = 0; mine && x < f->settings->width; x++)
                trace_pixel(f, &own, x, y);
            int rows;
#pragma omp atomic capture
            rows = ++done;
            if (omp_get_thread_num() == 0)
                progress_show("tracing", (double)rows / f->settings->height);
        }
        free_worker(&own);
    }
    progress_end();
    return ok;
}

int reference_samples(const reference_settings *settings) {
    const int step = settings->shard[1];
    return step ? (settings->samples - settings->shard[0] + step) / step : settings->samples;
}

/* Fills *albedos if any material has a sheen; returns whether one has. */
static bool prepare_sheen(const scene *world, reference_sheen_albedos *albedos) {
    for (size_t i = 0; i < world->material_count; i++)
        if (scene_has_sheen(&world->materials[i])) {
            reference_sheen_albedos_fill(albedos);
            return true;
        }
    return false;
}

bool reference_render(const scene *world, const reference_settings *settings, image *radiance,
                      image *standard_error, base_error *error) {
    frame f = {
        .scene = world, .settings = settings, .radiance = radiance, .standard_error = standard_error
    };
    reference_tracer *tracer = NULL;
    reference_environment around;
    reference_sheen_albedos albedos;
    *radiance = *standard_error = (image) { .rgb = NULL };
    bool ok = (reference_environment_create(settings->environment, &around) ||
               base_fail(error, NULL, "out of memory")) &&
              (reference_glow_create(world, &f.glow) || base_fail(error, NULL, "out of memory")) &&
              reference_tracer_create(world, &tracer, error) &&
              image_create(radiance, settings->width, settings->height, error) &&
              image_create(standard_error, settings->width, settings->height, error);
    if (ok) {
        f.tracer = tracer;
        f.environment = reference_environment_shines(&around) ? &around : NULL;
        f.materials =
            (reference_materials) { .scene = world,
                                    .sources = settings->materials,
                                    .albedos = prepare_sheen(world, &albedos) ? &albedos : NULL,
                                    .band_limit = settings->band_limit };
        set_camera(&f);
        ok = trace_rows(&f, settings->threads ? settings->threads : omp_get_num_procs()) ||
             base_fail(error, NULL, "out of memory");
    }
    reference_tracer_destroy(tracer);
    reference_environment_free(&around);
    reference_glow_free(&f.glow);
    if (!ok) {
        image_free(radiance);
        image_free(standard_error);
    }
    return ok;
}
