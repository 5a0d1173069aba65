/* SPDX-License-Identifier: MIT */
#include "app/base/progress.h"
#include "app/scene/texture_at.h"
#include "app/truth/reference.h"
#include "app/truth/reference_estimate.h"
#include "app/truth/reference_glow.h"
#include "app/truth/reference_trace.h"

#include <omp.h>
#include <stdlib.h>

/* The data that all pixels share. */
typedef struct frame {
    const scene *scene;
    reference_glow glow; /* what lights it: of emissive meshes the triangles */
    const reference_settings *settings;
    const reference_tracer *tracer;
    const reference_environment *environment; /* NULL: none */
    const reference_sheen_albedos *albedos;   /* if any material has a sheen */
    reference_vec eye, forward, right, up;    /* right and up reach the image's edges */
    double parallel;                          /* 1 for parallel rays, 0 for rays from the eye */
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

static void sample(const frame *f, const scene_texture_use *use, const reference_hit *hit,
                   double rgba[4]) {
    texture_at(f->scene, use, hit->uv + 2 * use->set, rgba);
}

static reference_vec mapped_normal(const frame *f, const reference_hit *hit,
                                   const scene_texture_use *map, double scale) {
    double texel[4];
    if (map->texture < 0)
        return hit->normal;
    sample(f, map, hit, texel);
    const reference_vec bitangent =
        reference_scale(hit->handedness, reference_cross(hit->normal, hit->tangent));
    const reference_vec normal =
        reference_add(reference_scale((2 * texel[0] - 1) * scale, hit->tangent),
                      reference_add(reference_scale((2 * texel[1] - 1) * scale, bitangent),
                                    reference_scale(2 * texel[2] - 1, hit->normal)));
    return reference_normalize(normal);
}

static reference_dielectric dielectric_of(const frame *f, const reference_hit *hit,
                                          const scene_material *material) {
    double weight[4], tint[4];
    sample(f, &material->specular_map, hit, weight);
    sample(f, &material->specular_color_map, hit, tint);
    reference_dielectric d = { .f90 = (double)material->f90 * weight[3] };
    for (int c = 0; c < 3; c++)
        d.f0[c] = fmin((double)material->f0[c] * tint[c], 1) * d.f90;
    return d;
}

/* The data of one thread. */
typedef struct worker {
    reference_estimator estimator;
    reference_tabulated tabulated;
    reference_ggx ggx, coat;
    reference_sheen sheen;
} worker;

static void sheen_surface(const frame *f, worker *own, const reference_hit *hit,
                          reference_vec normal, reference_vec view, reference_surface *surface) {
    const scene_material *material = &f->scene->materials[hit->material];
    double tint[4], rough[4], color[3];
    sample(f, &material->sheen_color_map, hit, tint);
    sample(f, &material->sheen_roughness_map, hit, rough);
    for (int c = 0; c < 3; c++)
        color[c] = tint[c] * (double)material->sheen_color[c];
    reference_sheen_set(&own->sheen, f->albedos, color,
                        rough[3] * (double)material->sheen_roughness, normal, view);
    reference_surface_sheen(surface, &own->sheen);
}

/* Puts a coat over the surface, which also attenuates its emission. */
static void coat_surface(const frame *f, worker *own, const reference_hit *hit, reference_vec view,
                         reference_surface *surface, double emission[3]) {
    const scene_material *material = &f->scene->materials[hit->material];
    double weight[4], rough[4];
    sample(f, &material->coat_map, hit, weight);
    sample(f, &material->coat_roughness_map, hit, rough);
    const reference_vec normal =
        mapped_normal(f, hit, &material->coat_normal_map, (double)material->coat_normal_scale);
    reference_coat_set(&own->coat, weight[0] * (double)material->coat,
                       rough[1] * (double)material->coat_roughness, normal, view);
    reference_surface_coat(surface, &own->coat, normal, view);
    for (int c = 0; c < 3; c++)
        emission[c] *= surface->under;
}

/* Finds the transmitted color, which is taken from the base color except for leaves. */
static void take_transmission(const frame *f, const reference_hit *hit, double metallic,
                              double base[3], double through[3]) {
    const scene_material *material = &f->scene->materials[hit->material];
    double part[4], color[4];
    sample(f, &material->transmission_map, hit, part);
    sample(f, &material->transmission_color_map, hit, color);
    const double left = (double)material->transmission * part[3] * (1 - metallic);
    for (int c = 0; c < 3; c++) {
        if (material->flags & SCENE_LEAF) {
            through[c] = (double)SCENE_LEAF_TRANSMITS * base[c] * (1 - metallic);
        } else {
            through[c] = left * color[c] * (double)material->transmission_color[c];
            base[c] *= 1 - left;
        }
    }
}

/* Describes the surface, and the light that it emits. */
static void describe(const frame *f, worker *own, const reference_hit *hit, reference_vec view,
                     reference_surface *surface, double emission[3]) {
    const scene_material *material = &f->scene->materials[hit->material];
    double color[4], rough[4], glow[4], shade[4], base[3], through[3] = { 0 };
    sample(f, &material->base_color_map, hit, color);
    sample(f, &material->metallic_roughness_map, hit, rough);
    sample(f, &material->emission_map, hit, glow);
    for (int c = 0; c < 3; c++) {
        base[c] = color[c] * hit->color[c] * (double)material->base_color[c];
        emission[c] = glow[c] * (double)material->emission[c] *
                      (material->flags & SCENE_UNLIT ? hit->color[c] : 1);
    }
    sample(f, &material->occlusion_map, hit, shade);
    const reference_vec normal =
        mapped_normal(f, hit, &material->normal_map, (double)material->normal_scale);
    const reference_dielectric dielectric = dielectric_of(f, hit, material);
    const double metallic = rough[2] * (double)material->metallic;
    if (scene_is_translucent(material))
        take_transmission(f, hit, metallic, base, through);
    reference_ggx_set(&own->ggx, base, metallic, rough[1] * (double)material->roughness,
                      &dielectric, normal, view);
    surface->position = hit->position;
    surface->ray_origin = hit->ray_origin;
    reference_surface_shine(surface, &f->settings->band_limit, &own->ggx, normal, view);
    const reference_material_source *source =
        f->settings->materials ? &f->settings->materials[hit->material] : NULL;
    if (source && (source->brdf || source->coefficients)) {
        reference_tabulated_orient(&own->tabulated, source, normal, hit->tangent, view);
        reference_surface_measure(surface, &own->tabulated, normal, view);
    } else {
        if (scene_has_sheen(material))
            sheen_surface(f, own, hit, normal, view, surface);
        if (material->coat > 0)
            coat_surface(f, own, hit, view, surface, emission);
        if (scene_is_translucent(material)) {
            for (int c = 0; c < 3; c++)
                through[c] *= surface->under;
            reference_surface_transmit(surface, through, normal, hit->ray_behind);
        }
    }
    surface->occluded = (double)material->occlusion * (1 - shade[0]);
}

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

static double opacity_of(const frame *f, const reference_hit *hit) {
    const scene_material *material = &f->scene->materials[hit->material];
    double texel[4];
    if (!(material->flags & SCENE_ALPHA_BLEND))
        return 1;
    sample(f, &material->base_color_map, hit, texel);
    return texel[3] * hit->color[3] * (double)material->base_color[3];
}

static void see_surface(const frame *f, worker *own, const reference_hit *hit,
                        reference_vec direction, uint64_t key, ray_radiance *seen) {
    const reference_settings *const s = f->settings;
    const bool whole = s->shard[1] == 0;
    const reference_stop stop = { reference_samples(s), s->error, whole ? 0 : s->shard[0] - 1,
                                  s->shard[1] };
    reference_surface surface;
    double emission[3];
    describe(f, own, hit, reference_scale(-1, direction), &surface, emission);
    const reference_result result = reference_estimate(&own->estimator, &surface, &stop, key);
    for (int c = 0; c < 3; c++) {
        /* renderers clamp the sum of a ringing series at 0 */
        const double mean = surface.band_limited && result.mean[c] < 0 ? 0 : result.mean[c];
        seen->mean[c] = mean + emission[c];
        seen->standard_error[c] = result.standard_error[c];
    }
    seen->opacity = opacity_of(f, hit);
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

/* Traces rows in parallel; each pixel has its own random stream. */
static bool trace_rows(const frame *f, int threads) {
    int done = 0;
    bool ok = true;
#pragma omp parallel num_threads(threads)
    {
        worker own = { .tabulated = { .coefficients = NULL } };
        const bool mine =
            reference_estimator_create(&own.estimator, f->glow.lights, f->glow.count) &&
            reference_tabulated_create(&own.tabulated, f->settings->materials,
                                       f->settings->materials ? f->scene->material_count : 0);
        if (!mine) {
#pragma omp atomic write
            ok = false;
        }
        own.estimator.environment = f->environment;
        own.estimator.emission = reference_glow_emission;
        own.estimator.emission_user = (void *)(uintptr_t)&f->glow;
        if (f->settings->shadows) {
            own.estimator.visibility = reference_tracer_free_path;
            own.estimator.visibility_user = (void *)(uintptr_t)f->tracer;
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
        reference_estimator_free(&own.estimator);
        reference_tabulated_free(&own.tabulated);
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
        f.albedos = prepare_sheen(world, &albedos) ? &albedos : NULL;
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
