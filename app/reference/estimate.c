/* SPDX-License-Identifier: MIT */
#include "app/reference/estimate.h"

#include <stdlib.h>

/* A light that can contribute. */
struct reference_candidate {
    reference_vec axis;
    double limit; /* w is in the cap if w·axis >= limit */
    double radiance[3];
    double density;    /* of the directions sampled for it, per steradian */
    double cumulative; /* of the probabilities, itself included */
    double one_minus_cos;
    const scene_light *light;
};

/* The ways to sample a direction and how often each is taken; the probabilities add up to 1. */
typedef struct plan {
    const reference_surface *surface;
    const struct reference_candidate *candidates;
    int count;
    double by_lobe[REFERENCE_LOBES];
} plan;

bool reference_estimator_create(reference_estimator *estimator, const scene_light *lights,
                                size_t count) {
    *estimator = (reference_estimator) { .lights = lights, .light_count = count };
    estimator->candidates = malloc((count ? count : 1) * sizeof *estimator->candidates);
    return estimator->candidates != NULL;
}

void reference_estimator_free(reference_estimator *estimator) {
    free(estimator->candidates);
    *estimator = (reference_estimator) { .candidates = NULL };
}

/* An upper bound of the mean of the lobe over the cap; of a cut series a guess that is never 0. */
static double lobe_bound(const reference_lobe *lobe, bool cut, const reference_cap *cap) {
    const double nearest = fmax(reference_angle(lobe->axis, cap->axis) - cap->angle, 0);
    const double there = reference_lobe_at(lobe, nearest < REFERENCE_PI ? cos(nearest) : -1);
    if (!cut)
        return there;
    return fabs(there) + 0.05 * fabs(reference_lobe_at(lobe, 1));
}

static double mean_of_product(const double a[3], lmp_rgb b) {
    return (a[0] * (double)b.r + a[1] * (double)b.g + a[2] * (double)b.b) / 3;
}

/* The part of the samples of a lobe and a light that the lobe should draw: it is the better source
 * where it is narrower than the light. One that is rarely drawn from would only add rare values
 * that the standard error does not know of, so it is left out. Of a cut series there is nothing to
 * sample. */
static double lobe_part(const reference_lobe *lobe, bool cut, const reference_cap *cap) {
    const double width = 2 * REFERENCE_PI / (lobe->exponent + 1);
    const double part = cap->solid_angle / (cap->solid_angle + width);
    if (cut || part < 0.02)
        return 0;
    return part > 0.98 ? 1 : part;
}

/* What the light can give at most through each lobe, parted between sampling the light and the
 * lobe. Returns the light's part; *any if there is something to sample. */
static double share(const reference_surface *surface, const scene_light *light,
                    const reference_cap *cap, double by_lobe[REFERENCE_LOBES], bool *any) {
    double by_light = 0;
    *any = false;
    for (int k = 0; k < REFERENCE_LOBES; k++) {
        const reference_lobe *lobe = &surface->lobes[k];
        const double strength = mean_of_product(lobe->weight, light->emitter.radiance);
        const double part = lobe_part(lobe, surface->cut, cap);
        if (!(strength > 0))
            continue;
        const double most =
            strength * fmin(cap->solid_angle * lobe_bound(lobe, surface->cut, cap), 1);
        by_light += most * (1 - part);
        by_lobe[k] += most * part;
        *any = *any || most > 0;
    }
    return by_light;
}

static void plan_samples(const reference_estimator *estimator, const reference_surface *surface,
                         plan *p) {
    double total = 0;
    *p = (plan) { .surface = surface, .candidates = estimator->candidates };
    for (size_t i = 0; i < estimator->light_count; i++) {
        const scene_light *light = &estimator->lights[i];
        const reference_cap cap = reference_cap_of(light, surface->position, surface->cut);
        bool any;
        const double part = share(surface, light, &cap, p->by_lobe, &any);
        if (!any)
            continue;
        total += part;
        estimator->candidates[p->count++] = (struct reference_candidate) {
            .axis = cap.axis,
            .limit = 1 - cap.one_minus_cos,
            .one_minus_cos = cap.one_minus_cos,
            .radiance = { (double)light->emitter.radiance.r, (double)light->emitter.radiance.g,
                          (double)light->emitter.radiance.b },
            .density = part / cap.solid_angle,
            .cumulative = total,
            .light = light,
        };
    }
    for (int k = 0; k < REFERENCE_LOBES; k++)
        total += p->by_lobe[k];
    for (int i = 0; i < p->count; i++) {
        estimator->candidates[i].density /= total;
        estimator->candidates[i].cumulative /= total;
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

/* A direction by one of the plan's ways; *sampled is the light it was drawn for, or -1. */
static reference_vec draw(const plan *p, const double u[3], int *sampled) {
    double way = u[0];
    *sampled = -1;
    for (int k = 0; k < REFERENCE_LOBES; k++) {
        if (way < p->by_lobe[k]) {
            const reference_lobe *lobe = &p->surface->lobes[k];
            const double cosine = pow(1 - u[1], 1 / (lobe->exponent + 1));
            return reference_around(lobe->axis, cosine, sqrt((1 - cosine) * (1 + cosine)), u[2]);
        }
        way -= p->by_lobe[k];
    }
    *sampled = find_candidate(p, way);
    const struct reference_candidate *c = &p->candidates[*sampled];
    const double t = u[1] * c->one_minus_cos;
    return reference_around(c->axis, 1 - t, sqrt(t * (2 - t)), u[2]);
}

/* The density of `w` over all ways (the balance heuristic's denominator, but for the lobes) and
 * the radiance that arrives from it. */
static double gather(const reference_estimator *estimator, const plan *p, reference_vec w,
                     int sampled, double radiance[3]) {
    double density = 0, free_path = (double)INFINITY;
    if (estimator->visibility)
        free_path = estimator->visibility(p->surface->ray_origin, w, estimator->visibility_user);
    for (int i = 0; i < p->count; i++) {
        const struct reference_candidate *c = &p->candidates[i];
        if (!(reference_dot(w, c->axis) >= c->limit) && i != sampled)
            continue;
        density += c->density;
        if (estimator->visibility &&
            reference_light_distance(c->light, p->surface->position, w) > free_path)
            continue;
        for (int k = 0; k < 3; k++)
            radiance[k] += c->radiance[k];
    }
    return density;
}

static void take_sample(const reference_estimator *estimator, const plan *p, uint64_t key,
                        int number, double value[3]) {
    double u[3], reflected[3] = { 0 }, radiance[3] = { 0 }, density = 0;
    int sampled;
    for (int k = 0; k < 3; k++)
        u[k] = reference_random(key, 3 * (uint64_t)number + (uint64_t)k);
    const reference_vec w = draw(p, u, &sampled);
    for (int k = 0; k < REFERENCE_LOBES; k++) {
        const reference_lobe *lobe = &p->surface->lobes[k];
        const double at = reference_lobe_at(lobe, reference_dot(lobe->axis, w));
        density += p->by_lobe[k] * at;
        for (int c = 0; c < 3; c++)
            reflected[c] += lobe->weight[c] * at;
    }
    if (p->surface->tabulated)
        reference_tabulated_at(p->surface->tabulated, w, reflected);
    value[0] = value[1] = value[2] = 0;
    if (reflected[0] == 0 && reflected[1] == 0 && reflected[2] == 0)
        return;
    density += gather(estimator, p, w, sampled, radiance);
    for (int c = 0; c < 3 && density > 0; c++)
        value[c] = reflected[c] * radiance[c] / density;
}

static double variance_of_mean(double sum, double sum2, int n) {
    const double squares = sum2 - sum * sum / n;
    if (n < 2 || squares < 0) /* a NaN stays one */
        return 0;
    return squares / n / (n - 1);
}

#define SAMPLES_BETWEEN_CHECKS 16

reference_result reference_estimate(const reference_estimator *estimator,
                                    const reference_surface *surface, const reference_stop *stop,
                                    uint64_t key) {
    reference_result result = { .samples = 0 };
    double sum[3] = { 0 }, sum2[3] = { 0 };
    plan p;
    plan_samples(estimator, surface, &p);
    if (p.count == 0)
        return result;
    for (int n = 0; n < stop->samples;) {
        double value[3], error = 0, mean = 0;
        take_sample(estimator, &p, key, n++, value);
        for (int c = 0; c < 3; c++) {
            sum[c] += value[c];
            sum2[c] += value[c] * value[c];
        }
        result.samples = n;
        if (stop->error <= 0 || n % SAMPLES_BETWEEN_CHECKS != 0)
            continue;
        for (int c = 0; c < 3; c++) {
            error += sqrt(variance_of_mean(sum[c], sum2[c], n));
            mean += fabs(sum[c]) / n;
        }
        if (mean > 0 && error <= stop->error * mean)
            break;
    }
    for (int c = 0; c < 3; c++) {
        result.mean[c] = sum[c] / result.samples;
        result.standard_error[c] = sqrt(variance_of_mean(sum[c], sum2[c], result.samples));
    }
    return result;
}
