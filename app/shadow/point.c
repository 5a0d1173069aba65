/* SPDX-License-Identifier: MIT */
#include "app/shadow/point.h"

#include "app/scene/vector.h"

/* The triangle of a pixel is looked for this many lifts before and behind its position. */
static const float near_lifts = 10;

static lmp_vec3 lane_of(const shadow_vectors *v, int lane) {
    return vec(v->of[0][lane], v->of[1][lane], v->of[2][lane]);
}

static void set_lane(shadow_vectors *v, int lane, lmp_vec3 value) {
    v->of[0][lane] = value.x;
    v->of[1][lane] = value.y;
    v->of[2][lane] = value.z;
}

/* --- where rays start ------------------------------------------------------------------------- */

/* A smooth normal says that the surface bulges past its flat triangle: a ray that starts on the
 * triangle would meet its neighbors. So it starts as high as the surface of second degree that has
 * the corners' normals, which lies half as far off the triangle as the corners' tangent planes,
 * and, against rounding, a little off the triangle. Hollows stay where they are drawn. */
static void leave_triangle(const shadow_view *view, const trace_hit *hit, int lane,
                           shadow_points *p) {
    const scene_vertex *corners[3];
    double weights[3];
    lmp_vec3 at = { 0, 0, 0 }, sum = { 0, 0, 0 };
    float height = 0;
    trace_corners(view->scene, hit, corners, weights);
    const lmp_vec3 a = vec_load(corners[0]->position);
    const lmp_vec3 face = vec_normalize(vec_cross(vec_sub(vec_load(corners[1]->position), a),
                                                  vec_sub(vec_load(corners[2]->position), a)),
                                        vec(0, 1, 0));
    const float side = vec_dot(face, lane_of(&p->view, lane)) < 0 ? -1.0f : 1.0f;
    for (int i = 0; i < 3; i++) {
        at = vec_add(at, vec_scale(vec_load(corners[i]->position), (float)weights[i]));
        sum = vec_add(sum, vec_scale(vec_load(corners[i]->normal), (float)weights[i] * side));
    }
    for (int i = 0; i < 3; i++) {
        const lmp_vec3 to_corner = vec_sub(vec_load(corners[i]->position), at);
        const lmp_vec3 normal = vec_load(corners[i]->normal);
        height += 0.5f * (float)weights[i] * side * vec_dot(to_corner, normal);
    }
    const lmp_vec3 smooth = vec_normalize(sum, vec_scale(face, side));
    const lmp_vec3 start = vec_add(at, vec_scale(smooth, fmaxf(height, 0)));
    set_lane(&p->smooth, lane, smooth);
    set_lane(&p->origin, lane, vec_add(start, vec_scale(face, side * view->lift)));
}

/* Where rounding hides the triangle from the ray, what the pixel knows serves. */
static void leave_pixel(const shadow_view *view, int lane, shadow_points *p) {
    const lmp_vec3 normal = lane_of(&p->normal, lane);
    set_lane(&p->smooth, lane, normal);
    set_lane(&p->origin, lane,
             vec_add(lane_of(&p->position, lane), vec_scale(normal, near_lifts * view->lift)));
}

static void find_origins(const shadow_view *view, shadow_points *p) {
    const float before = near_lifts * view->lift;
    trace_rays rays;
    trace_hit hits[SHADOW_LANES];
    for (int i = 0; i < SHADOW_LANES; i++) {
        rays.length[i] = p->lit[i] ? 2 * before : -1;
        for (int c = 0; c < 3; c++) {
            rays.origin[c][i] = p->position.of[c][i] + before * p->view.of[c][i];
            rays.direction[c][i] = -p->view.of[c][i];
        }
    }
    trace_nearest_n(view->bvh, TRACE_CAMERA, &rays, hits);
    for (int i = 0; i < SHADOW_LANES; i++) {
        if (p->lit[i] && hits[i].mesh != TRACE_NOTHING)
            leave_triangle(view, &hits[i], i, p);
        else if (p->lit[i])
            leave_pixel(view, i, p);
    }
}

/* --- what they reflect ------------------------------------------------------------------------ */

/* n bands show a lobe as wide as one of GGX of this alpha², at least. */
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

/* What is under a coat is seen through it; 0 where there is none. */
static void set_coat(const gpu_row *row, int x, float least, int i, shadow_points *p) {
    const lmp_coat *coat = &row->material[x].coat;
    const bool coated = p->lit[i] && coat->weight > 0;
    lmp_vec3 normal = { 0, 0, 0 }, mirror = { 0, 0, 0 };
    p->coat[i] = p->coat_alpha2[i] = 0;
    if (coated) {
        const lmp_vec3 view = lane_of(&p->view, i);
        normal = vec(row->coat_normal[0][x], row->coat_normal[1][x], row->coat_normal[2][x]);
        p->coat[i] = lmp_material_coated(coat, normal, view);
        p->coat_alpha2[i] =
            coat->roughness * coat->roughness * coat->roughness * coat->roughness + least;
        mirror = vec_sub(vec_scale(normal, 2 * vec_dot(normal, view)), view);
        p->albedo[i] *= 1 - p->coat[i];
        p->shine[i] *= 1 - p->coat[i];
        p->coated = true;
    }
    set_lane(&p->coat_normal, i, normal);
    set_lane(&p->coat_mirror, i, mirror);
}

float shadow_footprint(const shadow_view *view, const gpu_row *row, int x) {
    float d2 = 0;
    for (int c = 0; c < 3; c++) {
        const float d = row->position[c][x] - view->camera->eye[c];
        d2 += d * d;
    }
    return view->pixel * (view->camera->height > 0 ? 1 : sqrtf(d2));
}

void shadow_points_set(const shadow_view *view, const gpu_row *row, const int *pixels, int count,
                       shadow_points *p) {
    static const lmp_material unlit = { 0 }; /* where nothing is, the row has no material */
    const float least = resolved(&view->settings);
    p->settings = &view->settings;
    p->coated = false;
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
    }
    find_origins(view, p);
}

static lmp_rgb reflect_series(const shadow_points *p, int lane, lmp_vec3 w) {
    const lmp_light light = { .kind = LMP_LIGHT_DIRECTIONAL,
                              .direction = w,
                              .irradiance = { 1, 1, 1 } };
    const lmp_surface surface = { .position = lane_of(&p->position, lane),
                                  .normal = lane_of(&p->normal, lane),
                                  .view = lane_of(&p->view, lane),
                                  .coat_normal = lane_of(&p->coat_normal, lane) };
    return lmp_shade(p->settings, p->material[lane], &surface, &light, 1);
}

/* GGX and its masking, times the cosine of w; h is half way between v and w. */
static float glossy(lmp_vec3 n, lmp_vec3 v, lmp_vec3 w, lmp_vec3 h, float a2) {
    const float in = vec_dot(n, w), out = fmaxf(vec_dot(n, v), 1e-3f);
    const float nh = vec_dot(n, h), peak = nh * nh * (a2 - 1) + 1;
    const float masking =
        in * sqrtf(out * out * (1 - a2) + a2) + out * sqrtf(in * in * (1 - a2) + a2);
    return in > 0 ? in * a2 / (2 * PI * peak * peak * masking) : 0;
}

lmp_rgb shadow_reflect(const shadow_points *p, int lane, lmp_vec3 w) {
    if (p->material[lane]->kind != LMP_MATERIAL_METALLIC_ROUGHNESS)
        return reflect_series(p, lane, w);
    const lmp_vec3 n = lane_of(&p->normal, lane), v = lane_of(&p->view, lane);
    const float in = fmaxf(vec_dot(n, w), 0), coat = p->coat[lane];
    const lmp_vec3 h = vec_normalize(vec_add(v, w), n);
    const float across = 1 - fminf(fabsf(vec_dot(v, h)), 1);
    const float square = across * across, grazing = square * square * across;
    const float specular = glossy(n, v, w, h, p->alpha2[lane]);
    const float over =
        coat > 0 ? coat * glossy(lane_of(&p->coat_normal, lane), v, w, h, p->coat_alpha2[lane]) : 0;
    float k[3];
    for (int c = 0; c < 3; c++) {
        const float f0 = p->f0.of[c][lane];
        const float under =
            p->diffuse.of[c][lane] / PI * in + specular * (f0 + (p->f90[lane] - f0) * grazing);
        k[c] = (1 - coat) * under + over;
    }
    return rgb_load(k);
}
