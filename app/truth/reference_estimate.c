/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_estimate.h"

#include <stdlib.h>

/* Rays end by this factor before an area, so that the triangle that it is does not hide it. */
#define BEFORE_AREA (1 - 1e-4)

/* A source that can contribute from a cap of directions. */
struct reference_candidate {
    reference_source source;
    double limit;      /* w is in the cap if w·axis >= limit */
    double density;    /* of directions sampled for this source, per steradian; for an area, the
                        * probability that one is */
    double cumulative; /* sum of the probabilities up to this source's */
    const scene_light *light;
    double series[LMP_BANDS_MAX]; /* in place of all these, if lights are truncated series */
};

/* The sampling strategies of a point and their probabilities, which add up to 1. */
typedef struct plan {
    const reference_surface *surface;
    struct reference_candidate *candidates;
    int count;
    double by_lobe[REFERENCE_LOBES], by_environment;
    double direction[LMP_BANDS_MAX]; /* a direction of the environment as a truncated series */
    double known[3];                 /* light from single directions, which needs no samples */
} plan;

bool reference_estimator_create(reference_estimator *estimator, const scene_light *lights,
                                size_t count) {
    *estimator = (reference_estimator) { .lights = lights, .light_count = count };
    estimator->candidates =
        calloc(REFERENCE_SOURCES_MAX * count + 1, sizeof *estimator->candidates);
    return estimator->candidates != NULL;
}

void reference_estimator_free(reference_estimator *estimator) {
    free(estimator->candidates);
    *estimator = (reference_estimator) { .candidates = NULL };
}

/* Returns an upper bound of the lobe's mean over the cap; for a truncated series, an estimate that
 * is never 0. */
static double lobe_bound(const reference_lobe *lobe, bool truncated, const reference_source *cap) {
    const double nearest = fmax(reference_angle(lobe->axis, cap->axis) - cap->angle, 0);
    const double there = reference_lobe_at(lobe, nearest < REFERENCE_PI ? cos(nearest) : -1);
    if (!truncated)
        return there;
    return fabs(there) + 0.05 * fabs(reference_lobe_at(lobe, 1));
}

static double mean_of_product(const double a[3], const double b[3]) {
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / 3;
}

/* Returns the fraction of a lobe's and a light's samples that the lobe should draw: it is the
 * better strategy where it is narrower than the light. A strategy that is rarely used would only
 * add rare large values that the standard error misses, so it is dropped; but GGX has such long
 * tails that a light beside its peak counts. A truncated series cannot be sampled. */
static double lobe_fraction(const reference_lobe *lobe, bool truncated,
                            const reference_source *cap) {
    const double width = 2 * REFERENCE_PI / (lobe->exponent + 1);
    const double part = cap->solid_angle / (cap->solid_angle + width);
    if (truncated || part < 0.02)
        return 0;
    if (lobe->ggx)
        return fmin(part, 0.9);
    return part > 0.98 ? 1 : part;
}

/* Estimates the most that the source can give through each lobe, and divides it between sampling
 * the source and the lobe. Returns the source's part; *any is whether there is anything to
 * sample. */
static double divide(const reference_surface *surface, const reference_source *cap,
                     double by_lobe[REFERENCE_LOBES], bool *any) {
    double by_source = 0;
    *any = false;
    for (int k = 0; k < surface->lobe_count; k++) {
        const reference_lobe *lobe = &surface->lobes[k];
        const double strength = mean_of_product(lobe->weight, cap->color);
        const double fraction = lobe_fraction(lobe, surface->band_limited, cap);
        if (!(strength > 0))
            continue;
        const double most =
            strength * fmin(cap->solid_angle * lobe_bound(lobe, surface->band_limited, cap), 1);
        by_source += most * (1 - fraction);
        by_lobe[k] += most * fraction;
        *any = *any || most > 0;
    }
    return by_source;
}

/* Evaluates GGX and the layers over it. */
static void reflect_layers(const reference_surface *surface, reference_vec w, double reflected[3]) {
    const double left = surface->sheen ? surface->sheen->under : 1;
    double sheen[3] = { 0 }, over[3] = { 0 };
    reference_ggx_at(surface->ggx, w, reflected);
    if (surface->sheen)
        reference_sheen_at(surface->sheen, w, sheen);
    if (surface->coat)
        reference_ggx_at(surface->coat, w, over);
    for (int c = 0; c < 3; c++)
        reflected[c] = surface->under * (left * reflected[c] + sheen[c]) + over[c];
}

static void let_through(const reference_surface *surface, reference_vec w, double reflected[3]) {
    const double along = reference_dot(surface->behind[0], w);
    for (int c = 0; along > 0 && c < 3; c++)
        reflected[c] += surface->transmitted[c] * along / REFERENCE_PI;
}

/* Evaluates what the surface reflects from `w`; returns the density of w over the plan's lobes. */
static double reflect(const plan *p, reference_vec w, double reflected[3]) {
    double density = 0;
    reflected[0] = reflected[1] = reflected[2] = 0;
    for (int k = 0; k < p->surface->lobe_count; k++) {
        const reference_lobe *lobe = &p->surface->lobes[k];
        const double at = lobe->ggx ? reference_ggx_density(lobe->ggx, w)
                                    : reference_lobe_at(lobe, reference_dot(lobe->axis, w));
        density += p->by_lobe[k] * at;
        for (int c = 0; c < 3; c++)
            reflected[c] += lobe->weight[c] * at;
    }
    if (p->surface->tabulated)
        reference_tabulated_at(p->surface->tabulated, w, reflected);
    else if (p->surface->ggx)
        reflect_layers(p->surface, w, reflected);
    if (p->surface->translucent)
        let_through(p->surface, w, reflected);
    return density;
}

reference_vec reference_ray_origin(const reference_surface *surface, reference_vec w) {
    const bool behind = surface->translucent && reference_dot(surface->behind[0], w) > 0;
    return behind ? surface->behind[1] : surface->ray_origin;
}

static double free_path(const reference_estimator *estimator, const reference_surface *surface,
                        reference_vec w) {
    return estimator->visibility ? estimator->visibility(reference_ray_origin(surface, w), w,
                                                         estimator->visibility_user)
                                 : (double)INFINITY;
}

static void add_known(const reference_estimator *estimator, const reference_source *source,
                      plan *p) {
    double reflected[3];
    if (source->distance > free_path(estimator, p->surface, source->axis))
        return;
    reflect(p, source->axis, reflected);
    for (int c = 0; c < 3; c++)
        p->known[c] += reflected[c] * source->color[c];
}

/* Adds a source to the plan; returns its weight among the strategies, not yet normalized. */
static double add_candidate(const reference_source *source, const scene_light *light, double before,
                            plan *p) {
    bool any;
    const double part = divide(p->surface, source, p->by_lobe, &any);
    if (any)
        p->candidates[p->count++] = (struct reference_candidate) {
            .source = *source,
            .limit = 1 - source->one_minus_cos - (source->is_area ? 1e-9 : 0),
            .density = source->is_area ? part : part / source->solid_angle,
            .cumulative = before + part,
            .light = light,
        };
    return any ? part : 0;
}

/* Gives half of the samples of a lobe and the environment to the lobe, or none if the lobe is a
 * truncated series, which cannot be sampled. */
static void add_environment(const reference_environment *e, plan *p) {
    for (int k = 0; k < p->surface->lobe_count; k++) {
        const double strength = mean_of_product(p->surface->lobes[k].weight, e->mean);
        const double part = p->surface->band_limited ? 0 : 0.5;
        p->by_environment += strength * (1 - part);
        p->by_lobe[k] += strength * part;
    }
}

static bool is_light_a_series(const reference_surface *surface) {
    return surface->ggx && surface->band_limited;
}

/* Whether a source that is a series is sampled in one direction per sample, which is itself made a
 * series: one that may be occluded, and an area, whose own series is that of no cap. */
static bool is_sampled(const reference_estimator *estimator, const reference_source *source) {
    return estimator->visibility || source->is_area;
}

/* Plans samples of the material, whatever the lights: these are series over the whole sphere. */
static void plan_series(const reference_estimator *estimator, const reference_surface *surface,
                        plan *p) {
    double total = 0;
    reference_series_of_direction(&surface->limit, p->direction);
    for (size_t i = 0; i < estimator->light_count; i++) {
        const scene_light *light = &estimator->lights[i];
        reference_source sources[REFERENCE_SOURCES_MAX];
        const int count = reference_light_sources(light, surface->position, true, sources);
        for (int k = 0; k < count; k++) {
            struct reference_candidate *c = &p->candidates[p->count++];
            c->source = sources[k];
            c->light = light;
            if (is_sampled(estimator, &sources[k]))
                reference_series_of_direction(&surface->limit, c->series);
            else
                reference_series_of_source(&sources[k], &surface->limit, c->series);
        }
    }
    for (int k = 0; k < surface->lobe_count; k++) {
        const double *weight = surface->lobes[k].weight;
        p->by_lobe[k] = weight[0] + weight[1] + weight[2];
        total += p->by_lobe[k];
    }
    for (int k = 0; k < REFERENCE_LOBES; k++)
        p->by_lobe[k] /= total;
}

static void plan_samples(const reference_estimator *estimator, const reference_surface *surface,
                         plan *p) {
    double total = 0;
    *p = (plan) { .surface = surface, .candidates = estimator->candidates };
    if (is_light_a_series(surface)) {
        plan_series(estimator, surface, p);
        return;
    }
    for (size_t i = 0; i < estimator->light_count; i++) {
        const scene_light *light = &estimator->lights[i];
        reference_source sources[REFERENCE_SOURCES_MAX];
        const int count =
            reference_light_sources(light, surface->position, surface->band_limited, sources);
        for (int k = 0; k < count; k++)
            if (sources[k].solid_angle > 0)
                total += add_candidate(&sources[k], light, total, p);
            else
                add_known(estimator, &sources[k], p);
    }
    if (estimator->environment)
        add_environment(estimator->environment, p);
    total += p->by_environment;
    for (int k = 0; k < REFERENCE_LOBES; k++)
        total += p->by_lobe[k];
    p->by_environment /= total > 0 ? total : 1;
    for (int i = 0; i < p->count; i++) {
        p->candidates[i].density /= total;
        p->candidates[i].cumulative /= total;
    }
    for (int k = 0; k < REFERENCE_LOBES; k++)
        p->by_lobe[k] /= total > 0 ? total : 1;
}

static int find_candidate(const plan *p, double u) {
    int low = 0, high = p->count - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (u < p->candidates[middle].cumulative)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static reference_vec draw_lobe(const reference_lobe *lobe, double u, double v) {
    if (lobe->ggx)
        return reference_ggx_draw(lobe->ggx, u, v);
    const double cosine = pow(1 - u, 1 / (lobe->exponent + 1));
    return reference_around(lobe->axis, cosine, sqrt((1 - cosine) * (1 + cosine)), v);
}

/* Samples a direction by one of the plan's strategies; *sampled is the light that it was sampled
 * for, or -1. */
static reference_vec draw(const reference_estimator *estimator, const plan *p, const double u[3],
                          int *sampled) {
    double way = u[0];
    *sampled = -1;
    for (int k = 0; k < p->surface->lobe_count; k++) {
        if (way < p->by_lobe[k])
            return draw_lobe(&p->surface->lobes[k], u[1], u[2]);
        way -= p->by_lobe[k];
    }
    if (p->by_environment > 0 && (way < p->by_environment || p->count == 0))
        return reference_environment_draw(estimator->environment, u[1], u[2]);
    *sampled = find_candidate(p, way - p->by_environment);
    const struct reference_candidate *c = &p->candidates[*sampled];
    if (c->source.is_area)
        return reference_area_draw(&c->source.area, p->surface->position, u[1], u[2]);
    const double t = u[1] * c->source.one_minus_cos;
    return reference_around(c->source.axis, 1 - t, sqrt(t * (2 - t)), u[2]);
}

/* Finds the density with which a source, whose sample w may be, is sampled there, and how far its
 * light travels: INFINITY if it comes from no surface or none comes. Returns false if the source is
 * not there. */
static bool meet(const struct reference_candidate *c, reference_vec point, reference_vec w,
                 bool sampled, double *density, double *distance) {
    if (!(reference_dot(w, c->source.axis) >= c->limit) && !sampled)
        return false;
    if (c->source.is_area) {
        const reference_area_hit hit = reference_area_meet(&c->source.area, point, w);
        *distance = hit.distance;
        *density = c->density * hit.density;
        return hit.density > 0;
    }
    *distance = reference_light_distance(c->light, point, w);
    *density = c->density;
    return true;
}

/* Whether a ray along w, which ends after `path`, ends before a source at a distance from the
 * surface. An area may be a triangle itself, to which the ray must have come from its own origin:
 * off the surface, the way to what faces it is shorter. */
static bool is_hidden(const struct reference_candidate *c, const reference_surface *surface,
                      reference_vec w, double distance, double path) {
    if (!c->source.is_area || isinf(path))
        return distance > path;
    const reference_area_hit hit =
        reference_area_meet(&c->source.area, reference_ray_origin(surface, w), w);
    return BEFORE_AREA * (isfinite(hit.distance) ? hit.distance : distance) > path;
}

/* Adds what arrives from a candidate in a direction, which it meets at a distance of `meet`. */
static void add_radiance(const reference_estimator *estimator, const struct reference_candidate *c,
                         reference_vec point, reference_vec w, double distance, double scale,
                         double radiance[3]) {
    const double *color = c->source.color;
    double there[3] = { color[0], color[1], color[2] };
    if (c->source.is_area && estimator->emission)
        estimator->emission((size_t)(c->light - estimator->lights),
                            reference_add(point, reference_scale(distance, w)), there,
                            estimator->emission_user);
    for (int k = 0; k < 3; k++)
        radiance[k] += scale * there[k];
}

/* Returns the density of `w` over all sources (the balance heuristic's denominator, without the
 * lobes); *radiance receives the light that arrives from it. */
static double accumulate(const reference_estimator *estimator, const plan *p, reference_vec w,
                         int sampled, double radiance[3]) {
    const double path = free_path(estimator, p->surface, w);
    double density = 0;
    for (int i = 0; i < p->count; i++) {
        const struct reference_candidate *c = &p->candidates[i];
        double here, distance;
        if (!meet(c, p->surface->position, w, i == sampled, &here, &distance))
            continue;
        density += here;
        if ((c->source.is_area && isinf(distance)) ||
            (estimator->visibility && is_hidden(c, p->surface, w, distance, path)))
            continue;
        add_radiance(estimator, c, p->surface->position, w, distance, 1, radiance);
    }
    if (estimator->environment) {
        double all_around[3] = { 0 };
        density +=
            p->by_environment * reference_environment_at(estimator->environment, w, all_around);
        for (int k = 0; isinf(path) && k < 3; k++)
            radiance[k] += all_around[k] * (1 - p->surface->occluded);
    }
    return density;
}

/* Adds the environment, estimated from one direction, which is made a series around itself. */
static void add_environment_series(const reference_estimator *estimator, const plan *p,
                                   reference_vec w, uint64_t key, double radiance[3]) {
    const reference_environment *e = estimator->environment;
    const uint64_t first = 2 * (uint64_t)p->count;
    double from_there[3] = { 0 };
    const reference_vec axis = reference_environment_draw(e, reference_random(key, first),
                                                          reference_random(key, first + 1));
    const double density = reference_environment_at(e, axis, from_there);
    const double scale =
        reference_series_at(p->surface->limit.bands, p->direction, reference_dot(w, axis)) /
        density;
    for (int k = 0; isinf(free_path(estimator, p->surface, axis)) && k < 3; k++)
        radiance[k] += scale * from_there[k] * (1 - p->surface->occluded);
}

/* Samples a direction to a source and finds how far its light travels from there; returns the solid
 * angle that the direction stands for, or 1 for a single direction. */
static double draw_source(const struct reference_candidate *c, reference_vec point, double u,
                          double v, reference_vec *axis, double *distance) {
    if (c->source.is_area) {
        *axis = reference_area_draw(&c->source.area, point, u, v);
        const reference_area_hit hit = reference_area_meet(&c->source.area, point, *axis);
        *distance = hit.distance;
        return isfinite(hit.distance) && hit.density > 0 ? 1 / hit.density : 0;
    }
    const double t = c->source.one_minus_cos * u;
    *axis = reference_around(c->source.axis, 1 - t, sqrt(t * (2 - t)), v);
    *distance = c->source.solid_angle > 0 ? reference_light_distance(c->light, point, *axis)
                                          : c->source.distance;
    return c->source.solid_angle > 0 ? c->source.solid_angle : 1;
}

/* Adds the lights as series; `key` samples the directions of those that may be occluded. */
static void accumulate_series(const reference_estimator *estimator, const plan *p, reference_vec w,
                              uint64_t key, double radiance[3]) {
    for (int i = 0; i < p->count; i++) {
        const struct reference_candidate *c = &p->candidates[i];
        reference_vec axis = c->source.axis;
        double scale = 1, distance = 0;
        if (is_sampled(estimator, &c->source)) {
            scale = draw_source(c, p->surface->position, reference_random(key, 2 * (uint64_t)i),
                                reference_random(key, 2 * (uint64_t)i + 1), &axis, &distance);
            if (!(scale > 0) ||
                is_hidden(c, p->surface, axis, distance, free_path(estimator, p->surface, axis)))
                continue;
        }
        scale *= reference_series_at(p->surface->limit.bands, c->series, reference_dot(w, axis));
        add_radiance(estimator, c, p->surface->position, axis, distance, scale, radiance);
    }
    if (estimator->environment)
        add_environment_series(estimator, p, w, key, radiance);
}

static void take_sample(const reference_estimator *estimator, const plan *p, uint64_t key,
                        int number, double value[3]) {
    double u[3], reflected[3], radiance[3] = { 0 };
    int sampled;
    for (int k = 0; k < 3; k++)
        u[k] = reference_random(key, 3 * (uint64_t)number + (uint64_t)k);
    const reference_vec w = draw(estimator, p, u, &sampled);
    double density = reflect(p, w, reflected);
    value[0] = value[1] = value[2] = 0;
    if (reflected[0] == 0 && reflected[1] == 0 && reflected[2] == 0)
        return;
    if (is_light_a_series(p->surface))
        accumulate_series(estimator, p, w, reference_hash(key, ~(uint64_t)number), radiance);
    else
        density += accumulate(estimator, p, w, sampled, radiance);
    for (int c = 0; c < 3 && density > 0; c++)
        value[c] = reflected[c] * radiance[c] / density;
}

static double variance_of_mean(double sum, double sum2, int n) {
    const double squares = sum2 - sum * sum / n;
    if (n < 2 || squares < 0) /* keeps a NaN */
        return 0;
    return squares / n / (n - 1);
}

#define SAMPLES_BETWEEN_CHECKS 16

reference_result reference_estimate(const reference_estimator *estimator,
                                    const reference_surface *surface, const reference_stop *stop,
                                    uint64_t key) {
    const int step = stop->step ? stop->step : 1;
    reference_result result = { .samples = 0 };
    double sum[3] = { 0 }, sum2[3] = { 0 };
    plan p;
    plan_samples(estimator, surface, &p);
    for (int c = 0; c < 3; c++)
        result.mean[c] = p.known[c];
    const bool is_sampled_directly = p.count > 0 || estimator->environment;
    if (!is_sampled_directly && !estimator->indirect)
        return result;
    for (int n = 0; n < stop->samples;) {
        double value[3] = { 0 }, error = 0, mean = 0;
        const int number = stop->first + n++ * step;
        if (is_sampled_directly)
            take_sample(estimator, &p, key, number, value);
        if (estimator->indirect)
            estimator->indirect(surface, reference_hash(key, (uint64_t)number), value,
                                estimator->indirect_user);
        for (int c = 0; c < 3; c++) {
            sum[c] += value[c];
            sum2[c] += value[c] * value[c];
        }
        result.samples = n;
        if (stop->error <= 0 || n % SAMPLES_BETWEEN_CHECKS != 0)
            continue;
        for (int c = 0; c < 3; c++) {
            error += sqrt(variance_of_mean(sum[c], sum2[c], n));
            mean += fabs(sum[c] / n + p.known[c]);
        }
        if (mean > 0 && error <= stop->error * mean)
            break;
    }
    for (int c = 0; c < 3; c++) {
        result.mean[c] += sum[c] / result.samples;
        result.standard_error[c] = sqrt(variance_of_mean(sum[c], sum2[c], result.samples));
    }
    return result;
}

/* --- bounces ---------------------------------------------------------------------------------- */

reference_vec reference_scatter(const reference_surface *surface, const double u[3],
                                double weight[3]) {
    plan p = { .surface = surface };
    double total = 0, way = u[0];
    int chosen = 0;
    for (int k = 0; k < surface->lobe_count; k++) {
        const double *lobe = surface->lobes[k].weight;
        p.by_lobe[k] = lobe[0] + lobe[1] + lobe[2];
        total += p.by_lobe[k];
    }
    for (int k = 0; k < surface->lobe_count; k++)
        p.by_lobe[k] /= total > 0 ? total : 1;
    while (chosen < surface->lobe_count - 1 && way >= p.by_lobe[chosen])
        way -= p.by_lobe[chosen++];
    const reference_vec w = draw_lobe(&surface->lobes[chosen], u[1], u[2]);
    const double density = reflect(&p, w, weight);
    for (int c = 0; c < 3; c++)
        weight[c] = density > 0 ? weight[c] / density : 0;
    return w;
}
