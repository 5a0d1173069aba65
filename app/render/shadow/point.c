/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/point.h"

#include "app/scene/instance.h"
#include "app/scene/trace/wide.h"
#include "app/scene/vector.h"

/* How far before and behind a pixel's position its triangle is looked for, in units of the rays'
 * lift. */
static const float near_lifts = 10;

/* --- where rays start ------------------------------------------------------------------------- */

/* Triangles side by side, and the points' weights on them. */
typedef struct triangle_lanes {
    shadow_vectors corners[3], normals[3];
    shadow_lanes weights[3];
} triangle_lanes;

static void set_triangle(const scene_vertex corners[3], const trace_hit *hit, int lane,
                         triangle_lanes *t) {
    for (int i = 0; i < 3; i++) {
        shadow_set_lane(&t->corners[i], lane, vec_load(corners[i].position));
        shadow_set_lane(&t->normals[i], lane, vec_load(corners[i].normal));
    }
    t->weights[0][lane] = (float)(1 - (double)hit->u - (double)hit->v);
    t->weights[1][lane] = hit->u;
    t->weights[2][lane] = hit->v;
}

/* Returns how far the smooth surface bulges past the triangle at a point. */
static float bulge(const triangle_lanes *t, int lane, lmp_vec3 at) {
    float height = 0;
    for (int i = 0; i < 3; i++) {
        const lmp_vec3 to_corner = vec_sub(shadow_lane(&t->corners[i], lane), at);
        height +=
            0.5f * t->weights[i][lane] * vec_dot(to_corner, shadow_lane(&t->normals[i], lane));
    }
    return height;
}

static lmp_vec3 mix(const shadow_vectors corners[3], const shadow_lanes weights[3], int lane) {
    return vec_add(vec_scale(shadow_lane(&corners[0], lane), weights[0][lane]),
                   vec_add(vec_scale(shadow_lane(&corners[1], lane), weights[1][lane]),
                           vec_scale(shadow_lane(&corners[2], lane), weights[2][lane])));
}

/* Moves the rays' origins off the triangles. A smooth normal means that the surface bulges past its
 * flat triangle: a ray that starts on the triangle would hit the neighboring ones. So it starts on
 * the quadratic surface with the corners' normals, which is half as far off the triangle as the
 * corners' tangent planes, plus a small lift against rounding. Concave points stay on the triangle;
 * for light from behind they are the ones that bulge. */
static TRACE_WIDE void leave_triangles(const triangle_lanes *t, float whole, shadow_points *p) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 corners[3] = { shadow_lane(&t->corners[0], i),
                                      shadow_lane(&t->corners[1], i),
                                      shadow_lane(&t->corners[2], i) };
        const lmp_vec3 cross =
            vec_cross(vec_sub(corners[1], corners[0]), vec_sub(corners[2], corners[0]));
        const float area = vec_length(cross), scale = 1 / (area > 0 ? area : 1);
        const lmp_vec3 face = { cross.x * scale, area > 0 ? cross.y * scale : 1, cross.z * scale };
        const float side = vec_dot(face, shadow_lane(&p->view, i)) < 0 ? -1.0f : 1.0f;
        const lmp_vec3 at = mix(t->corners, t->weights, i), sum = mix(t->normals, t->weights, i);
        const float length = vec_length(sum), to_unit = side / (length > 0 ? length : 1);
        const lmp_vec3 smooth = { length > 0 ? sum.x * to_unit : side * face.x,
                                  length > 0 ? sum.y * to_unit : side * face.y,
                                  length > 0 ? sum.z * to_unit : side * face.z };
        const float height = side * bulge(t, i, at), off = height > 0 ? height : 0;
        const float hollow = height < 0 ? height : 0, lift = trace_lift_at(whole, at, corners);
        shadow_set_lane(&p->smooth, i, smooth);
        shadow_set_lane(&p->origin, i,
                        vec_add(vec_add(at, vec_scale(smooth, off)), vec_scale(face, side * lift)));
        shadow_set_lane(
            &p->behind, i,
            vec_sub(vec_add(at, vec_scale(smooth, hollow)), vec_scale(face, side * lift)));
    }
}

/* Returns how far off a pixel's position its triangle may be: positions are rounded as they are
 * found from the camera. */
static float reach_of(const shadow_view *view, lmp_vec3 at) {
    const float lift = trace_lift_at(view->lift, at, NULL),
                seen = 1e-5f * vec_length(vec_sub(at, vec_load(view->camera->eye)));
    return near_lifts * (lift > seen ? lift : seen);
}

/* Moves the origin off the pixel's position where rounding makes the ray miss the triangle. */
static void leave_pixel(const shadow_view *view, int lane, shadow_points *p) {
    const lmp_vec3 normal = shadow_lane(&p->normal, lane);
    shadow_set_lane(&p->smooth, lane, normal);
    const lmp_vec3 at = shadow_lane(&p->position, lane),
                   off = vec_scale(normal, reach_of(view, at));
    shadow_set_lane(&p->origin, lane, vec_add(at, off));
    shadow_set_lane(&p->behind, lane, vec_sub(at, off));
}

/* Finds the triangle of each point by a short ray along its view. */
static void find_triangles(const shadow_view *view, const shadow_points *p,
                           trace_hit hits[SHADOW_LANES]) {
    trace_rays rays;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float before = reach_of(view, shadow_lane(&p->position, i));
        rays.start[i] = 0;
        rays.length[i] = p->lit[i] ? 2 * before : -1;
        for (int c = 0; c < 3; c++) {
            rays.origin[c][i] = p->position.of[c][i] + before * p->view.of[c][i];
            rays.direction[c][i] = -p->view.of[c][i];
        }
    }
    trace_nearest_n(view->bvh, TRACE_CAMERA, &rays, hits);
}

/* Finds the origins of rays; neighbors often see the same triangle. */
static void find_origins(const shadow_view *view, const trace_hit hits[SHADOW_LANES],
                         shadow_points *p) {
    triangle_lanes triangles = { 0 };
    scene_vertex corners[3];
    const trace_hit *last = NULL;
    for (int i = 0; i < SHADOW_LANES; i++) {
        if (!p->lit[i] || hits[i].instance == TRACE_NOTHING)
            continue;
        if (!last || last->instance != hits[i].instance || last->triangle != hits[i].triangle)
            scene_triangle(view->scene, hits[i].instance, hits[i].triangle, corners);
        last = &hits[i];
        set_triangle(corners, last, i, &triangles);
    }
    leave_triangles(&triangles, view->lift, p);
    for (int i = 0; i < SHADOW_LANES; i++)
        if (p->lit[i] && hits[i].instance == TRACE_NOTHING)
            leave_pixel(view, i, p);
}

/* --- what they reflect ------------------------------------------------------------------------ */

/* Returns the alpha² of the narrowest GGX lobe that n bands can show. */
static float resolved(const lmp_shade_settings *settings) {
    const float width = settings->window == LMP_WINDOW_NONE ? 1.5f : 2.4f;
    const float alpha = width / (float)settings->bands;
    return alpha * alpha;
}

static const lmp_dielectric plain = { true,
                                      { LMP_DIELECTRIC_F0, LMP_DIELECTRIC_F0, LMP_DIELECTRIC_F0 },
                                      1 };

static void set_material(const lmp_material *m, float least, int i, shadow_points *p) {
    const lmp_dielectric *given = m->dielectric.given ? &m->dielectric : &plain;
    const float dielectric[3] = { given->f0.r, given->f0.g, given->f0.b };
    const float base[3] = { m->base_color.r, m->base_color.g, m->base_color.b };
    float diffuse = 0, specular = 0;
    if (m->kind != LMP_MATERIAL_METALLIC_ROUGHNESS) {
        p->albedo[i] = p->shine[i] = 0.5f;
        p->alpha2[i] = least;
        p->f90[i] = 0;
        shadow_set_lane(&p->diffuse, i, vec(0, 0, 0));
        shadow_set_lane(&p->f0, i, vec(0, 0, 0));
        return;
    }
    for (int c = 0; c < 3; c++) {
        p->diffuse.of[c][i] = base[c] * (1 - m->metallic);
        p->f0.of[c][i] = dielectric[c] + (base[c] - dielectric[c]) * m->metallic;
        diffuse += p->diffuse.of[c][i] / 3;
        specular += p->f0.of[c][i] / 3;
    }
    p->f90[i] = given->f90 + (1 - given->f90) * m->metallic;
    p->albedo[i] = diffuse;
    p->shine[i] = specular;
    p->alpha2[i] = m->roughness * m->roughness * m->roughness * m->roughness + least;
}

/* Sets the coat of a point, which attenuates what is below it; 0 if there is none. */
static void set_coat(const render_tile *row, int x, float least, int i, shadow_points *p) {
    const lmp_coat *coat = &row->material[x].coat;
    const bool coated = p->lit[i] && coat->weight > 0;
    lmp_vec3 normal = { 0, 0, 0 }, mirror = { 0, 0, 0 };
    p->coat[i] = p->coat_alpha2[i] = 0;
    if (coated) {
        const lmp_vec3 view = shadow_lane(&p->view, i);
        normal = vec(row->coat_normal[0][x], row->coat_normal[1][x], row->coat_normal[2][x]);
        p->coat[i] = lmp_material_coat_reflectance(coat, normal, view);
        p->coat_alpha2[i] =
            coat->roughness * coat->roughness * coat->roughness * coat->roughness + least;
        mirror = vec_sub(vec_scale(normal, 2 * vec_dot(normal, view)), view);
        p->albedo[i] *= 1 - p->coat[i];
        p->shine[i] *= 1 - p->coat[i];
        p->coated = true;
    }
    shadow_set_lane(&p->coat_normal, i, normal);
    shadow_set_lane(&p->coat_mirror, i, mirror);
}

static void set_transmission(const render_tile *row, int x, int i, shadow_points *p) {
    p->through[i] = 0;
    for (int c = 0; c < 3; c++) {
        p->transmitted.of[c][i] = p->lit[i] && row->translucent ? row->transmitted[c][x] : 0;
        p->through[i] += p->transmitted.of[c][i] / 3;
    }
    p->translucent |= p->through[i] > 0;
}

void shadow_points_set(const shadow_view *view, const render_tile *row, const trace_hit *hits,
                       const int *pixels, int count, shadow_points *p) {
    static const lmp_material unlit = { 0 }; /* without a surface there is no material */
    const float least = resolved(&view->settings);
    p->settings = &view->settings;
    p->coated = p->translucent = false;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const int x = pixels[i < count ? i : 0];
        p->lit[i] = i < count;
        p->material[i] = p->lit[i] ? &row->material[x] : &unlit;
        float along = 0;
        for (int c = 0; c < 3; c++) {
            p->position.of[c][i] = row->position[c][x];
            p->normal.of[c][i] = row->normal[c][x];
            p->view.of[c][i] = row->view[c][x];
            along += row->normal[c][x] * row->view[c][x];
        }
        for (int c = 0; c < 3; c++)
            p->mirror.of[c][i] = 2 * along * p->normal.of[c][i] - p->view.of[c][i];
        p->footprint[i] = shadow_footprint(view, row, x);
        p->ambient[i] = row->ambient[x];
        set_material(p->material[i], least, i, p);
        set_coat(row, x, least, i, p);
        set_transmission(row, x, i, p);
    }
    trace_hit of[SHADOW_LANES];
    for (int i = 0; hits && i < count; i++)
        of[i] = hits[i];
    if (!hits)
        find_triangles(view, p, of);
    find_origins(view, of, p);
}

static void reflect_series(const shadow_points *p, const shadow_vectors *directions, int lane,
                           shadow_vectors *k) {
    const lmp_light light = scene_light_from(shadow_lane(directions, lane));
    const lmp_surface surface = { .position = shadow_lane(&p->position, lane),
                                  .normal = shadow_lane(&p->normal, lane),
                                  .view = shadow_lane(&p->view, lane),
                                  .coat_normal = shadow_lane(&p->coat_normal, lane) };
    const lmp_rgb rgb = lmp_shade(p->settings, p->material[lane], &surface, &light, 1);
    shadow_set_lane(k, lane, vec(rgb.r, rgb.g, rgb.b));
}

/* Returns GGX with masking, times the cosine of the light; `out` is the cosine of the view, and
 * `half_cosine` that of the half vector. */
static float glossy(float in, float out, float half_cosine, float a2) {
    const float held = out > 1e-3f ? out : 1e-3f, peak = half_cosine * half_cosine * (a2 - 1) + 1;
    const float masking =
        in * sqrtf(held * held * (1 - a2) + a2) + held * sqrtf(in * in * (1 - a2) + a2);
    const float value = in * a2 / (2 * PI * peak * peak * (in > 0 ? masking : 1));
    return in > 0 ? value : 0;
}

/* Returns the half vector of v and w; if they are opposite, the result gives no light. */
static lmp_vec3 half_vector(lmp_vec3 v, lmp_vec3 w) {
    const lmp_vec3 sum = vec_add(v, w);
    const float length = vec_length(sum);
    return vec_scale(sum, 1 / (length > 0 ? length : 1));
}

static TRACE_WIDE void reflect_bare(const shadow_points *p, const shadow_vectors *directions,
                                    shadow_vectors *k) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 n = shadow_lane(&p->normal, i), v = shadow_lane(&p->view, i);
        const lmp_vec3 w = shadow_lane(directions, i), h = half_vector(v, w);
        const float in = vec_dot(n, w), lit = in > 0 ? in / PI : 0;
        const float along = fabsf(vec_dot(v, h)), across = 1 - (along < 1 ? along : 1);
        const float square = across * across, grazing = square * square * across;
        const float specular = glossy(in, vec_dot(n, v), vec_dot(n, h), p->alpha2[i]);
        for (int c = 0; c < 3; c++) {
            const float f0 = p->f0.of[c][i];
            k->of[c][i] = p->diffuse.of[c][i] * lit + specular * (f0 + (p->f90[i] - f0) * grazing);
        }
    }
}

static TRACE_WIDE void add_coats(const shadow_points *p, const shadow_vectors *directions,
                                 shadow_vectors *k) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 n = shadow_lane(&p->coat_normal, i), v = shadow_lane(&p->view, i);
        const lmp_vec3 w = shadow_lane(directions, i), h = half_vector(v, w);
        const float coat = p->coat[i];
        const float over = glossy(vec_dot(n, w), vec_dot(n, v), vec_dot(n, h), p->coat_alpha2[i]);
        for (int c = 0; c < 3; c++)
            k->of[c][i] = (1 - coat) * k->of[c][i] + (coat > 0 ? coat * over : 0);
    }
}

static TRACE_WIDE void add_transmission(const shadow_points *p, const shadow_vectors *directions,
                                        shadow_vectors *k) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float in = -vec_dot(shadow_lane(&p->normal, i), shadow_lane(directions, i));
        const float lit = in > 0 ? in / PI : 0;
        for (int c = 0; c < 3; c++)
            k->of[c][i] += p->transmitted.of[c][i] * lit;
    }
}

lmp_vec3 shadow_origin(const shadow_points *p, int lane, lmp_vec3 w) {
    const bool behind = p->through[lane] > 0 && vec_dot(shadow_lane(&p->normal, lane), w) < 0;
    return shadow_lane(behind ? &p->behind : &p->origin, lane);
}

void shadow_reflect(const shadow_points *p, const shadow_vectors *w, shadow_vectors *k) {
    reflect_bare(p, w, k);
    if (p->coated)
        add_coats(p, w, k);
    if (p->translucent)
        add_transmission(p, w, k);
    for (int i = 0; i < SHADOW_LANES; i++)
        if (p->lit[i] && p->material[i]->kind != LMP_MATERIAL_METALLIC_ROUGHNESS)
            reflect_series(p, w, i, k);
}
