/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/source.h"

#include "app/render/shadow/area.h"
#include "app/render/shadow/toward.h"
#include "app/render/shadow/turn.h"
#include "app/scene/trace/wide.h"

/* --- the sources ------------------------------------------------------------------------------ */

static shadow_source source_of(shadow_kind kind, lmp_rgb color) {
    return (shadow_source) { .kind = kind,
                             .color = color,
                             .brightness = (color.r + color.g + color.b) / 3 };
}

static shadow_source near_source(const lmpi_packed_light *light) {
    const bool sphere = light->form == LMPI_FORM_SPHERE;
    shadow_source source = source_of(sphere ? SHADOW_SPHERE : SHADOW_POINT, light->color);
    source.light = *light;
    return source;
}

static shadow_source far_source(lmp_vec3 axis, float one_minus_cos, lmp_rgb color) {
    shadow_source source = source_of(SHADOW_FAR, color);
    source.axis = axis;
    source.one_minus_cos = one_minus_cos;
    return source;
}

/* Adds the sources of a cap: the light inside it, and the light around it. */
static size_t add_cap(const lmpi_packed_light *cap, shadow_source *sources) {
    const lmp_rgb far = cap->ambient,
                  near = { cap->color.r + far.r, cap->color.g + far.g, cap->color.b + far.b };
    const shadow_source inside = far_source(cap->at, cap->size, near);
    const shadow_source outside = far_source(vec_scale(cap->at, -1), 2 - cap->size, far);
    size_t count = 0;
    if (inside.brightness > 0 || !(outside.brightness > 0))
        sources[count++] = inside;
    if (outside.brightness > 0)
        sources[count++] = outside;
    return count;
}

static shadow_source area_source(const lmp_light *light, scene_emitter *area) {
    shadow_source source = source_of(SHADOW_AREA, light->radiance);
    scene_emitter_set(light, area);
    source.area = area;
    return source;
}

static size_t add_light(const lmp_light *light, scene_emitter *area, shadow_source *sources) {
    lmpi_packed_light packed;
    if (scene_light_is_area(light)) {
        sources[0] = area_source(light, area);
        return 1;
    }
    lmpi_light_pack(light, &packed);
    if (packed.form == LMPI_FORM_CAP)
        return add_cap(&packed, sources);
    sources[0] = packed.fixed ? far_source(packed.at, 0, packed.color) : near_source(&packed);
    return 1;
}

size_t shadow_sources_make(const scene_light *lights, size_t count, const shadow_around *around,
                           scene_emitter *areas, shadow_source *sources) {
    size_t made = 0;
    for (size_t i = 0; i < count; i++)
        made += add_light(&lights[i].emitter, &areas[i], sources + made);
    if (around) {
        sources[made] = source_of(SHADOW_AROUND, around->mean);
        sources[made++].around = around;
    }
    return made;
}

/* --- from a point ----------------------------------------------------------------------------- */

static float falloff_of(const lmpi_packed_light *light, lmp_vec3 axis) {
    return light->form == LMPI_FORM_CONE ? lmpi_cone_falloff(light, vec_scale(axis, -1)) : 1;
}

static float sine_of(float one_minus_cos) {
    return one_minus_cos < 1 ? sqrtf(one_minus_cos * (2 - one_minus_cos)) : 1;
}

/* Returns the maximum without a branch, so that loops are vectorized. */
static float larger(float a, float b) {
    return 0.5f * (a + b + fabsf(a - b));
}

/* Caps side by side, and their irradiance over pi. */
typedef struct cap_lanes {
    shadow_vectors axis;
    shadow_lanes sine, power;
} cap_lanes;

static void see_sphere(const shadow_source *source, const shadow_points *p, cap_lanes *caps) {
    const lmp_vec3 center = source->light.at;
    const float r = source->light.size, least = LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float x = center.x - p->position.of[0][i], y = center.y - p->position.of[1][i];
        const float z = center.z - p->position.of[2][i];
        const float scale = 1 / sqrtf(larger(x * x + y * y + z * z, least));
        const float sine = 1 - larger(1 - r * scale, 0);
        caps->axis.of[0][i] = x * scale;
        caps->axis.of[1][i] = y * scale;
        caps->axis.of[2][i] = z * scale;
        caps->sine[i] = sine;
        caps->power[i] = source->brightness * sine * sine; /* inside up to four times as much */
    }
}

static void see_point(const shadow_source *source, const shadow_points *p, cap_lanes *caps) {
    const lmp_vec3 center = source->light.at;
    const float least = LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 to =
            vec_sub(center, vec(p->position.of[0][i], p->position.of[1][i], p->position.of[2][i]));
        const float d2 = fmaxf(vec_dot(to, to), least);
        const lmp_vec3 axis = vec_scale(to, 1 / sqrtf(d2));
        caps->axis.of[0][i] = axis.x;
        caps->axis.of[1][i] = axis.y;
        caps->axis.of[2][i] = axis.z;
        caps->sine[i] = 0;
        caps->power[i] = source->brightness / (PI * d2) * falloff_of(&source->light, axis);
    }
}

static void see_area(const shadow_source *source, const shadow_points *p, cap_lanes *caps) {
    const scene_emitter *area = source->area;
    const float least = LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 to = vec_sub(area->center, shadow_lane(&p->position, i));
        const float scale = 1 / sqrtf(larger(vec_dot(to, to), least));
        shadow_set_lane(&caps->axis, i, vec_scale(to, scale));
        caps->sine[i] = 1 - larger(1 - area->extent * scale, 0);
        caps->power[i] = source->brightness * shadow_area_power(area, to);
    }
}

static void see_far(const shadow_source *source, cap_lanes *caps) {
    const float solid_angle = 2 * PI * source->one_minus_cos;
    for (int i = 0; i < SHADOW_LANES; i++) {
        caps->axis.of[0][i] = source->axis.x;
        caps->axis.of[1][i] = source->axis.y;
        caps->axis.of[2][i] = source->axis.z;
        caps->sine[i] = sine_of(source->one_minus_cos);
        caps->power[i] = source->brightness / PI * (solid_angle > 0 ? solid_angle : 1);
    }
}

/* Computes weights of caps: the part above the horizon, about (cos + sine) / (1 + sine), and the
 * specular lobe, widened by the cap. */
static void weigh_caps(const cap_lanes *caps, const shadow_points *p, float *weights) {
    const shadow_lanes *n = p->normal.of, *m = p->mirror.of, *axis = caps->axis.of;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float along = n[0][i] * axis[0][i] + n[1][i] * axis[1][i] + n[2][i] * axis[2][i];
        const float mirrored = m[0][i] * axis[0][i] + m[1][i] * axis[1][i] + m[2][i] * axis[2][i];
        const float s = caps->sine[i], a2 = p->alpha2[i] + 0.25f * s * s;
        const float off = a2 + larger(0.5f - 0.5f * mirrored, 0);
        const float facing = larger(along + s, 0) * (1 - 0.5f * s);
        const float specular = p->shine[i] * a2 / (4 * off * off);
        const float weight = caps->power[i] * (p->albedo[i] * facing + specular);
        weights[i] = facing > 0 ? weight : 0;
    }
}

/* Adds the light that coats reflect. */
static void weigh_coats(const cap_lanes *caps, const shadow_points *p, float *weights) {
    const shadow_lanes *n = p->coat_normal.of, *m = p->coat_mirror.of, *axis = caps->axis.of;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float along = n[0][i] * axis[0][i] + n[1][i] * axis[1][i] + n[2][i] * axis[2][i];
        const float mirrored = m[0][i] * axis[0][i] + m[1][i] * axis[1][i] + m[2][i] * axis[2][i];
        const float s = caps->sine[i], a2 = p->coat_alpha2[i] + 0.25f * s * s;
        const float off = a2 + larger(0.5f - 0.5f * mirrored, 0);
        const float weight = caps->power[i] * p->coat[i] * a2 / (4 * off * off);
        weights[i] += p->coat[i] > 0 && along + s > 0 ? weight : 0;
    }
}

/* Adds the light that is transmitted from behind. */
static void weigh_backs(const cap_lanes *caps, const shadow_points *p, float *weights) {
    const shadow_lanes *n = p->normal.of, *axis = caps->axis.of;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float along = n[0][i] * axis[0][i] + n[1][i] * axis[1][i] + n[2][i] * axis[2][i];
        const float s = caps->sine[i], facing = larger(s - along, 0) * (1 - 0.5f * s);
        weights[i] += caps->power[i] * p->through[i] * facing;
    }
}

static void weigh(const shadow_source *source, const shadow_points *p, float *weights) {
    cap_lanes caps;
    if (source->kind == SHADOW_AROUND) {
        for (int i = 0; i < SHADOW_LANES; i++)
            weights[i] =
                source->brightness * PI * (p->albedo[i] + p->shine[i] + p->coat[i] + p->through[i]);
        return;
    }
    if (source->kind == SHADOW_SPHERE)
        see_sphere(source, p, &caps);
    else if (source->kind == SHADOW_POINT)
        see_point(source, p, &caps);
    else if (source->kind == SHADOW_AREA)
        see_area(source, p, &caps);
    else
        see_far(source, &caps);
    weigh_caps(&caps, p, weights);
    if (p->coated)
        weigh_coats(&caps, p, weights);
    if (p->translucent)
        weigh_backs(&caps, p, weights);
}

TRACE_WIDE void shadow_sources_weigh(const shadow_source *sources, size_t count,
                                     const shadow_points *points, shadow_lanes *sums) {
    static const shadow_lanes none = { 0 };
    for (size_t s = 0; s < count; s++) {
        const float *before = s > 0 ? sums[s - 1] : none;
        shadow_lanes weights;
        weigh(&sources[s], points, weights);
#pragma omp simd
        for (int i = 0; i < SHADOW_LANES; i++)
            sums[s][i] = before[i] + (weights[i] > 0 ? weights[i] : 0);
    }
}

/* --- directions ------------------------------------------------------------------------------- */

/* Sources side by side. */
typedef struct source_lanes {
    shadow_vectors at, color; /* the position of near sources, the axis of far ones */
    shadow_lanes radius;
    shadow_lanes far; /* one_minus_cos of far sources, -1 for near ones */
} source_lanes;

/* The caps that sources subtend at the points. */
typedef struct seen_lanes {
    shadow_vectors axis;
    shadow_lanes distance, one_minus_cos;
} seen_lanes;

static void collect(const shadow_source *const sources[SHADOW_LANES], source_lanes *lanes) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const shadow_source *s = sources[i];
        const bool near = s->kind <= SHADOW_AREA;
        const lmp_vec3 at = s->area ? s->area->center : near ? s->light.at : s->axis;
        lanes->at.of[0][i] = at.x;
        lanes->at.of[1][i] = at.y;
        lanes->at.of[2][i] = at.z;
        lanes->color.of[0][i] = s->color.r;
        lanes->color.of[1][i] = s->color.g;
        lanes->color.of[2][i] = s->color.b;
        lanes->radius[i] = s->kind == SHADOW_SPHERE ? s->light.size : 0;
        lanes->far[i] = near ? -1 : s->one_minus_cos;
    }
}

/* Finds the subtended caps. Inside a sphere the cap goes on growing, as in <lampion/light.h>. */
static void see(const source_lanes *lanes, const shadow_vectors *positions, seen_lanes *seen) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float x = lanes->at.of[0][i] - positions->of[0][i];
        const float y = lanes->at.of[1][i] - positions->of[1][i];
        const float z = lanes->at.of[2][i] - positions->of[2][i];
        const float r = lanes->radius[i], far = lanes->far[i];
        const float distance = sqrtf(x * x + y * y + z * z);
        const float less = distance < r ? distance : r, more = distance < r ? r : distance;
        const float s = less / (more > 0 ? more : 1), root = sqrtf((1 - s) * (1 + s));
        const float inside = 1 + root, outside = s * s / (1 + root);
        const float near = distance < r ? inside : outside;
        const float scale = 1 / (distance > 0 ? distance : 1),
                    upward = distance > 0 ? z * scale : 1;
        seen->axis.of[0][i] = far < 0 ? x * scale : lanes->at.of[0][i];
        seen->axis.of[1][i] = far < 0 ? y * scale : lanes->at.of[1][i];
        seen->axis.of[2][i] = far < 0 ? upward : lanes->at.of[2][i];
        seen->one_minus_cos[i] = far < 0 ? near : far;
        seen->distance[i] = distance;
    }
}

/* Samples directions in the caps: off the axis by the fraction u, around it by the fraction v. */
static void leave_axis(const seen_lanes *seen, const shadow_lanes u, const shadow_lanes v,
                       shadow_vectors *direction) {
    for (int i = 0; i < SHADOW_LANES; i++)
        shadow_set_lane(
            direction, i,
            shadow_leave(shadow_lane(&seen->axis, i), u[i] * seen->one_minus_cos[i], v[i]));
}

/* Finds the rays' lengths: to the near side of a sphere or, from inside it, to the far side. */
static void end_rays(const source_lanes *lanes, const seen_lanes *seen, const shadow_lanes u,
                     float *length) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float distance = seen->distance[i], r = lanes->radius[i];
        const float t = u[i] * seen->one_minus_cos[i], along = distance * (1 - t);
        const float off = distance * sqrtf(t * (2 - t));
        const float half_chord = sqrtf(larger((r - off) * (r + off), 0));
        const float near = larger(distance < r ? along + half_chord : along - half_chord, 0);
        length[i] = lanes->far[i] < 0 ? near : INFINITY;
    }
}

static void bring_light(const source_lanes *lanes, const seen_lanes *seen,
                        shadow_samples *samples) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float t = seen->one_minus_cos[i];
        const float solid_angle = lanes->far[i] == 0 ? 1 : 2 * PI * t;
        samples->size[i] = sine_of(t);
        for (int c = 0; c < 3; c++)
            samples->arrives.of[c][i] = lanes->color.of[c][i] * solid_angle;
    }
}

static TRACE_WIDE void draw_caps(const source_lanes *lanes, const shadow_vectors *positions,
                                 const float *u, const float *v, seen_lanes *seen,
                                 shadow_samples *samples) {
    see(lanes, positions, seen);
    leave_axis(seen, u, v, &samples->direction);
    end_rays(lanes, seen, u, samples->length);
    bring_light(lanes, seen, samples);
}

/* Samples a point light, whose cap is a single direction. */
static void draw_point(const shadow_source *source, const seen_lanes *seen, int lane,
                       shadow_samples *samples) {
    const float held = fmaxf(seen->distance[lane], LMP_POINT_DISTANCE_MIN);
    const float falloff = falloff_of(&source->light, shadow_lane(&seen->axis, lane));
    const lmp_rgb arrives = rgb_scale(source->color, falloff / (held * held));
    shadow_set_lane(&samples->arrives, lane, vec(arrives.r, arrives.g, arrives.b));
}

static void draw_area(const shadow_source *source, const shadow_vectors *positions, float u,
                      float v, int lane, shadow_samples *samples) {
    const shadow_area_sample drawn =
        shadow_area_draw(source->area, shadow_lane(positions, lane), u, v);
    const lmp_rgb arrives = rgb_scale(source->color, drawn.solid_angle);
    shadow_set_lane(&samples->direction, lane, drawn.direction);
    shadow_set_lane(&samples->arrives, lane, vec(arrives.r, arrives.g, arrives.b));
    samples->length[lane] = drawn.length;
    samples->size[lane] = drawn.size;
}

static void draw_around(const shadow_source *source, const shadow_points *points, float u, float v,
                        int lane, shadow_samples *samples) {
    shadow_arrival arrival;
    shadow_set_lane(&samples->direction, lane,
                    points ? shadow_draw_toward(source->around, points, lane, u, v, &arrival)
                           : shadow_around_draw(source->around, u, v, &arrival));
    const lmp_rgb arrives =
        rgb_scale(arrival.radiance, arrival.density > 0 ? 1 / arrival.density : 0);
    shadow_set_lane(&samples->arrives, lane, vec(arrives.r, arrives.g, arrives.b));
    samples->length[lane] = INFINITY;
    samples->size[lane] = 1;
}

void shadow_sources_draw(const shadow_source *const sources[SHADOW_LANES],
                         const shadow_vectors *positions, const shadow_points *points,
                         const shadow_lanes u, const shadow_lanes v, shadow_samples *samples) {
    source_lanes lanes;
    seen_lanes seen;
    collect(sources, &lanes);
    draw_caps(&lanes, positions, u, v, &seen, samples);
    for (int i = 0; i < SHADOW_LANES; i++) {
        if (sources[i]->kind == SHADOW_POINT)
            draw_point(sources[i], &seen, i, samples);
        if (sources[i]->kind == SHADOW_AREA)
            draw_area(sources[i], positions, u[i], v[i], i, samples);
        if (sources[i]->kind == SHADOW_AROUND)
            draw_around(sources[i], points, u[i], v[i], i, samples);
    }
}

void shadow_end_at_area(lmp_vec3 position, int lane, trace_rays *rays) {
    float way[3], length2 = 0;
    const float from[3] = { position.x, position.y, position.z };
    for (int c = 0; c < 3; c++) {
        way[c] = from[c] + rays->direction[c][lane] * rays->length[lane] - rays->origin[c][lane];
        length2 += way[c] * way[c];
    }
    const float length = sqrtf(length2);
    for (int c = 0; c < 3 && length > 0; c++)
        rays->direction[c][lane] = way[c] / length;
    rays->length[lane] = length;
}
