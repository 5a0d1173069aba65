/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/surface.h"

#include "app/scene/vector.h"

/* A point on a triangle at which its material is evaluated. */
typedef struct point {
    const cpu_textures *textures;
    const scene_material *material;
    const scene_vertex *corners;
    float weights[3];
    lmp_vec3 smooth; /* the unit interpolated normal, on the front side */
    float side;      /* -1 where the back is seen */
    cpu_footprint footprint;
    const scene_texture_use *covered; /* the texture that `cover` was found for, or NULL */
    cpu_cover cover;
} point;

static lmp_vec3 mix(const float *a, const float *b, const float *c, const float weights[3]) {
    return vec_add(vec_scale(vec_load(a), weights[0]),
                   vec_add(vec_scale(vec_load(b), weights[1]), vec_scale(vec_load(c), weights[2])));
}

/* Finds the texture coordinates of the pixel, and how they change along the triangle's plane to the
 * neighboring pixels, whose rays differ in origin or direction. */
static void set_footprint(const render_camera *camera, const cpu_triangle *t, lmp_vec3 d,
                          float distance, point *p) {
    const float reach = camera->parallel ? 1 : distance, facing = 1 / vec_dot(t->face, d);
    const float *const sides[2] = { camera->right, camera->down };
    lmp_vec3 along[2];
    for (int k = 0; k < 2; k++) {
        const lmp_vec3 moved = vec_scale(vec_load(sides[k]), camera->step[k] * reach);
        along[k] = vec_sub(moved, vec_scale(d, vec_dot(t->face, moved) * facing));
    }
    for (int set = 0; set < 2; set++)
        for (int i = 0; i < 2 && t->read[set]; i++) {
            const float a = p->corners[0].uv[set][i], b = p->corners[1].uv[set][i] - a;
            const float c = p->corners[2].uv[set][i] - a;
            p->footprint.uv[set][i] = a + p->weights[1] * b + p->weights[2] * c;
            p->footprint.across[set][i] = vec_dot(t->slope[set][i], along[0]);
            p->footprint.down[set][i] = vec_dot(t->slope[set][i], along[1]);
        }
}

/* Looks up a texture; white if there is none. */
static void look_up(point *p, const scene_texture_use *use, float rgba[4]) {
    if (use->texture < 0) {
        rgba[0] = rgba[1] = rgba[2] = rgba[3] = 1;
        return;
    }
    if (!p->covered || !cpu_textures_alike(p->textures, p->covered, use)) {
        cpu_texture_cover(p->textures, use, &p->footprint, &p->cover);
        p->covered = use;
    }
    cpu_texture_read(p->textures, use, &p->cover, rgba);
}

static lmp_vec3 unit_of(lmp_vec3 v) {
    const float square = vec_dot(v, v);
    return vec_scale(v, 1 / sqrtf(square > 1e-20f ? square : 1e-20f));
}

/* Applies a normal map to n. */
static lmp_vec3 bend(point *p, lmp_vec3 n, const scene_texture_use *use, float scale) {
    float texel[4];
    if (use->texture < 0)
        return n;
    look_up(p, use, texel);
    const lmp_vec3 tangent =
        mix(p->corners[0].tangent, p->corners[1].tangent, p->corners[2].tangent, p->weights);
    float sign = 0;
    for (int i = 0; i < 3; i++)
        sign += p->weights[i] * p->corners[i].tangent[3];
    const lmp_vec3 t = unit_of(tangent);
    const lmp_vec3 b = vec_scale(vec_cross(n, t), sign);
    const lmp_vec3 bent =
        vec_add(vec_scale(t, (texel[0] * 2 - 1) * scale),
                vec_add(vec_scale(b, (texel[1] * 2 - 1) * scale), vec_scale(n, texel[2] * 2 - 1)));
    return unit_of(bent);
}

static void set_vector(float *const planes[3], size_t at, lmp_vec3 v) {
    planes[0][at] = v.x;
    planes[1][at] = v.y;
    planes[2][at] = v.z;
}

static void weaken(float *const planes[3], size_t at, float part) {
    for (int c = 0; c < 3; c++)
        planes[c][at] *= part;
}

static float unit(float x) {
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

static void set_color(float *const planes[3], size_t at, const float rgb[3]) {
    for (int c = 0; c < 3; c++)
        planes[c][at] = unit(rgb[c]);
}

/* Fills in the layers of a material. Returns the fraction of light from below its coat that the
 * coat lets through. */
static float fill_layers(point *p, lmp_vec3 view, size_t at, const render_surfaces *s) {
    const scene_material *m = p->material;
    float texel[4], sheen[3];
    const lmp_vec3 n = bend(p, p->smooth, &m->coat_normal_map, m->coat_normal_scale);
    look_up(p, &m->coat_map, texel);
    s->coat[at] = unit(m->coat * texel[0]);
    look_up(p, &m->coat_roughness_map, texel);
    s->coat_roughness[at] = unit(m->coat_roughness * texel[1]);
    look_up(p, &m->specular_color_map, texel);
    set_color(s->tint, at, texel);
    look_up(p, &m->sheen_color_map, texel);
    for (int c = 0; c < 3; c++)
        sheen[c] = m->sheen_color[c] * texel[c];
    set_color(s->sheen, at, sheen);
    look_up(p, &m->sheen_roughness_map, texel);
    s->sheen_roughness[at] = unit(m->sheen_roughness * texel[3]);
    const lmp_coat coat = { s->coat[at], s->coat_roughness[at] };
    set_vector(s->coat_normal, at, vec_scale(n, p->side));
    return coat.weight > 0 ? 1 - lmp_material_coat_reflectance(&coat, n, view) : 1;
}

/* Multiplies by the vertex colors, if the material uses them. */
static void tint(const point *p, float rgb[3]) {
    if (!(p->material->flags & SCENE_VERTEX_COLORS))
        return;
    for (int c = 0; c < 3; c++) {
        float color = 0;
        for (int i = 0; i < 3; i++)
            color += p->weights[i] * (float)p->corners[i].color[c];
        rgb[c] *= color * (1 / 65535.0f);
    }
}

/* Returns the color of transmitted light, which is taken from the base color except for leaves. */
static lmp_vec3 transmit(point *p, float metallic, float base[3]) {
    const scene_material *m = p->material;
    const float matte = 1 - unit(metallic);
    float texel[4], through[3];
    if (m->flags & SCENE_LEAF)
        return vec_scale(vec(unit(base[0]), unit(base[1]), unit(base[2])),
                         SCENE_LEAF_TRANSMITS * matte);
    look_up(p, &m->transmission_map, texel);
    const float part = m->transmission * texel[3] * matte;
    look_up(p, &m->transmission_color_map, texel);
    for (int c = 0; c < 3; c++) {
        through[c] = unit(m->transmission_color[c] * texel[c]) * part;
        base[c] *= 1 - part;
    }
    return vec_load(through);
}

static void fill_base(point *p, bool translucent, size_t at, const render_surfaces *s) {
    const scene_material *m = p->material;
    float texel[4], base[3] = { m->base_color[0], m->base_color[1], m->base_color[2] };
    tint(p, base);
    look_up(p, &m->base_color_map, texel);
    for (int c = 0; c < 3; c++)
        base[c] *= texel[c];
    look_up(p, &m->metallic_roughness_map, texel);
    s->metallic[at] = unit(m->metallic * texel[2]);
    s->roughness[at] = unit(m->roughness * texel[1]);
    if (translucent)
        set_vector(s->transmitted, at, transmit(p, s->metallic[at], base));
    set_color(s->base, at, base);
    look_up(p, &m->specular_map, texel);
    s->specular[at] = texel[3];
    look_up(p, &m->occlusion_map, texel);
    s->ambient[at] = unit(1 + m->occlusion * (texel[0] - 1));
}

/* Sets the material and finds which sets of coordinates its maps use. */
static void set_material(const scene *world, uint32_t number, cpu_triangle *t) {
    t->number = number;
    t->material = &world->materials[number];
    t->read[0] = t->read[1] = false;
    for (int i = 0; i < SCENE_MAPS; i++)
        if (t->material->maps[i].texture >= 0)
            t->read[t->material->maps[i].set] = true;
    t->mapped = t->read[0] || t->read[1];
}

/* Finds how the used coordinates change along the triangle's plane. */
static void set_slopes(cpu_triangle *t) {
    const float scale = 1 / vec_dot(t->face, t->face);
    const lmp_vec3 second = vec_scale(vec_cross(t->edges[1], t->face), scale);
    const lmp_vec3 third = vec_scale(vec_cross(t->face, t->edges[0]), scale);
    for (int set = 0; set < 2; set++)
        for (int i = 0; i < 2 && t->read[set]; i++) {
            const float a = t->corners[0].uv[set][i];
            t->slope[set][i] = vec_add(vec_scale(second, t->corners[1].uv[set][i] - a),
                                       vec_scale(third, t->corners[2].uv[set][i] - a));
        }
}

void cpu_triangle_find(const scene *world, const trace_hit *hit, cpu_triangle *t) {
    if (t->material && t->instance == hit->instance && t->triangle == hit->triangle)
        return;
    const uint32_t number = scene_instance_material(world, hit->instance);
    if (!t->material || t->number != number)
        set_material(world, number, t);
    t->instance = hit->instance;
    t->triangle = hit->triangle;
    scene_triangle(world, hit->instance, hit->triangle, t->corners);
    const lmp_vec3 a = vec_load(t->corners[0].position);
    for (int i = 0; i < 2; i++)
        t->edges[i] = vec_sub(vec_load(t->corners[i + 1].position), a);
    t->face = vec_cross(t->edges[0], t->edges[1]);
    if (t->mapped)
        set_slopes(t);
}

/* Fills in the surface of a material without maps. */
static void fill_plain(const point *p, uint32_t number, size_t at, const render_surfaces *s) {
    const scene_material *m = p->material;
    float base[3] = { m->base_color[0], m->base_color[1], m->base_color[2] };
    float emission[3] = { m->emission[0], m->emission[1], m->emission[2] };
    tint(p, base);
    if (m->flags & SCENE_UNLIT)
        tint(p, emission);
    s->seen[at] = number;
    set_vector(s->normal, at, vec_scale(p->smooth, p->side));
    set_color(s->base, at, base);
    s->metallic[at] = m->metallic;
    s->roughness[at] = m->roughness;
    s->specular[at] = s->ambient[at] = 1;
    set_vector(s->emission, at, vec_load(emission));
}

static void set_weights(const trace_hit *hit, float weights[3]) {
    weights[0] = (float)(1 - (double)hit->u - (double)hit->v);
    weights[1] = hit->u;
    weights[2] = hit->v;
}

static lmp_vec3 position_at(const scene_vertex corners[3], const float weights[3]) {
    return mix(corners[0].position, corners[1].position, corners[2].position, weights);
}

lmp_vec3 cpu_surface_position(const cpu_triangle *t, const trace_hit *hit) {
    float weights[3];
    set_weights(hit, weights);
    return position_at(t->corners, weights);
}

/* Finds the hit point's weights, normal and side, which do not depend on the material. */
static void place(const cpu_triangle *t, lmp_vec3 d, const trace_hit *hit, point *p) {
    const scene_vertex *v = t->corners;
    set_weights(hit, p->weights);
    const lmp_vec3 normal = mix(v[0].normal, v[1].normal, v[2].normal, p->weights);
    p->side = vec_dot(t->face, d) > 0 ? -1.0f : 1.0f;
    p->smooth = vec_dot(normal, normal) > 0 ? vec_normalize(normal, t->face)
                                            : vec_normalize(t->face, vec(0, 1, 0));
}

static void fill(point *p, const cpu_triangle *t, lmp_vec3 d, float distance, bool layered,
                 bool translucent, size_t at, const render_surfaces *s) {
    const scene_material *m = p->material;
    if (t->mapped)
        set_footprint(&s->camera, t, d, distance, p);
    s->seen[at] = t->number;
    const lmp_vec3 n = bend(p, p->smooth, &m->normal_map, m->normal_scale);
    set_vector(s->normal, at, vec_scale(n, p->side));
    fill_base(p, translucent, at, s);
    float texel[4], emission[3];
    look_up(p, &m->emission_map, texel);
    for (int c = 0; c < 3; c++)
        emission[c] = m->emission[c] * texel[c];
    if (m->flags & SCENE_UNLIT)
        tint(p, emission);
    set_vector(s->emission, at, vec_load(emission));
    if (!layered)
        return;
    const float seen = fill_layers(p, vec_normalize(vec_scale(d, -1), d), at, s);
    weaken(s->emission, at, seen);
    if (s->translucent)
        weaken(s->transmitted, at, seen);
}

void cpu_surface_fill(const cpu_textures *textures, const cpu_triangle *t, const float direction[3],
                      const trace_hit *hit, const cpu_first *first, size_t at,
                      const render_surfaces *s) {
    const lmp_vec3 d = vec_load(direction);
    const bool layered = s->layered && render_material_is_layered(s->materials, t->number);
    const bool translucent =
        s->translucent && render_material_is_translucent(s->materials, t->number);
    point p;
    p.textures = textures;
    p.material = t->material;
    p.corners = t->corners;
    p.covered = NULL;
    place(t, d, hit, &p);
    const lmp_vec3 position = position_at(t->corners, p.weights);
    set_vector(s->position, at, position);
    if (s->translucent)
        set_vector(s->transmitted, at, vec(0, 0, 0));
    if (!t->mapped && !layered && !translucent) {
        fill_plain(&p, t->number, at, s);
        return;
    }
    const lmp_vec3 front = vec_scale(p.smooth, p.side);
    if (s->smooth)
        cpu_shared_keep(s, at, front);
    if (!first || !cpu_shared_take(first, t->number, position, front, at, s))
        fill(&p, t, d, hit->distance, layered, translucent, at, s);
}
