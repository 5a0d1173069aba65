/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/surface.h"

#include "app/scene/vector.h"

/* A point of a triangle as its material is asked about it. */
typedef struct point {
    const cpu_textures *textures;
    const scene_material *material;
    const scene_vertex *corners;
    float weights[3];
    lmp_vec3 smooth; /* the unit normal between the corners', on the front side */
    float side;      /* -1 where the back is seen */
    cpu_footprint footprint;
} point;

static lmp_vec3 mix(const float *a, const float *b, const float *c, const float weights[3]) {
    return vec_add(vec_scale(vec_load(a), weights[0]),
                   vec_add(vec_scale(vec_load(b), weights[1]), vec_scale(vec_load(c), weights[2])));
}

/* How weights of the second and third corner change along the plane, from the ray of a pixel to one
 * whose origin or direction is another. */
static void change_of_weights(const render_camera *camera, const float direction[3], float distance,
                              const lmp_vec3 edges[2], lmp_vec3 normal, const float step[3],
                              float change[2]) {
    const lmp_vec3 d = vec_load(direction), aside = vec_load(step);
    const lmp_vec3 moved = vec_scale(aside, camera->parallel ? 1 : distance);
    const float facing = vec_dot(normal, d), size2 = vec_dot(normal, normal);
    const lmp_vec3 along = vec_scale(d, -vec_dot(normal, moved) / facing);
    const lmp_vec3 dp = vec_add(moved, along);
    change[0] = vec_dot(vec_cross(dp, edges[1]), normal) / size2;
    change[1] = vec_dot(vec_cross(edges[0], dp), normal) / size2;
}

/* The texture coordinates of the pixel and of those beside it. */
static void set_footprint(const render_camera *camera, const float direction[3], float distance,
                          const lmp_vec3 edges[2], lmp_vec3 normal, point *p) {
    float sides[2][3], change[2][2];
    for (int c = 0; c < 3; c++) {
        sides[0][c] = camera->right[c] * (2 / (float)camera->width);
        sides[1][c] = camera->down[c] * (2 / (float)camera->height);
    }
    for (int k = 0; k < 2; k++)
        change_of_weights(camera, direction, distance, edges, normal, sides[k], change[k]);
    for (int set = 0; set < 2; set++)
        for (int i = 0; i < 2; i++) {
            const float a = p->corners[0].uv[set][i], b = p->corners[1].uv[set][i] - a;
            const float c = p->corners[2].uv[set][i] - a;
            p->footprint.uv[set][i] = a + p->weights[1] * b + p->weights[2] * c;
            p->footprint.across[set][i] = change[0][0] * b + change[0][1] * c;
            p->footprint.down[set][i] = change[1][0] * b + change[1][1] * c;
        }
}

/* White where there is no map. */
static void look_up(const point *p, const scene_texture_use *use, float rgba[4]) {
    if (use->texture >= 0)
        cpu_texture_at(p->textures, use, &p->footprint, rgba);
    else
        rgba[0] = rgba[1] = rgba[2] = rgba[3] = 1;
}

/* A map of normals around n. */
static lmp_vec3 bend(const point *p, lmp_vec3 n, const scene_texture_use *use, float scale) {
    float texel[4];
    if (use->texture < 0)
        return n;
    look_up(p, use, texel);
    const lmp_vec3 tangent =
        mix(p->corners[0].tangent, p->corners[1].tangent, p->corners[2].tangent, p->weights);
    float sign = 0;
    for (int i = 0; i < 3; i++)
        sign += p->weights[i] * p->corners[i].tangent[3];
    const lmp_vec3 t = vec_scale(tangent, 1 / sqrtf(fmaxf(vec_dot(tangent, tangent), 1e-20f)));
    const lmp_vec3 b = vec_scale(vec_cross(n, t), sign);
    const lmp_vec3 bent =
        vec_add(vec_scale(t, (texel[0] * 2 - 1) * scale),
                vec_add(vec_scale(b, (texel[1] * 2 - 1) * scale), vec_scale(n, texel[2] * 2 - 1)));
    return vec_scale(bent, 1 / sqrtf(fmaxf(vec_dot(bent, bent), 1e-20f)));
}

static void set_vector(float *const planes[3], size_t at, lmp_vec3 v) {
    planes[0][at] = v.x;
    planes[1][at] = v.y;
    planes[2][at] = v.z;
}

static float unit(float x) {
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

static void set_color(float *const planes[3], size_t at, const float rgb[3]) {
    for (int c = 0; c < 3; c++)
        planes[c][at] = unit(rgb[c]);
}

/* Of a layered material; what is under a coat shines through it. */
static void fill_layers(const point *p, lmp_vec3 view, size_t at, const render_surfaces *s,
                        float emission[3]) {
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
    const float through = coat.weight > 0 ? 1 - lmp_material_coated(&coat, n, view) : 1;
    for (int c = 0; c < 3; c++)
        emission[c] *= through;
    set_vector(s->coat_normal, at, vec_scale(n, p->side));
}

/* Multiplies by the colors of the vertices, where they count. */
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

static void fill_base(const point *p, size_t at, const render_surfaces *s) {
    const scene_material *m = p->material;
    float texel[4], base[3] = { m->base_color[0], m->base_color[1], m->base_color[2] };
    tint(p, base);
    look_up(p, &m->base_color_map, texel);
    for (int c = 0; c < 3; c++)
        base[c] *= texel[c];
    set_color(s->base, at, base);
    look_up(p, &m->metallic_roughness_map, texel);
    s->metallic[at] = unit(m->metallic * texel[2]);
    s->roughness[at] = unit(m->roughness * texel[1]);
    look_up(p, &m->specular_map, texel);
    s->specular[at] = texel[3];
    look_up(p, &m->occlusion_map, texel);
    s->ambient[at] = unit(1 + m->occlusion * (texel[0] - 1));
}

void cpu_triangle_find(const scene *world, const trace_hit *hit, cpu_triangle *t) {
    if (t->material && t->instance == hit->instance && t->triangle == hit->triangle)
        return;
    t->instance = hit->instance;
    t->triangle = hit->triangle;
    t->number = scene_instance_material(world, hit->instance);
    t->material = &world->materials[t->number];
    t->mapped = false;
    for (int i = 0; i < SCENE_MAPS; i++)
        t->mapped = t->mapped || t->material->maps[i].texture >= 0;
    scene_triangle(world, hit->instance, hit->triangle, t->corners);
    const lmp_vec3 a = vec_load(t->corners[0].position);
    for (int i = 0; i < 2; i++)
        t->edges[i] = vec_sub(vec_load(t->corners[i + 1].position), a);
    t->face = vec_cross(t->edges[0], t->edges[1]);
}

/* Of a material without maps. */
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

void cpu_surface_fill(const cpu_textures *textures, const cpu_triangle *t, const float direction[3],
                      const trace_hit *hit, size_t at, const render_surfaces *s) {
    point p = { .textures = textures, .material = t->material, .corners = t->corners };
    const scene_vertex *v = t->corners;
    p.weights[0] = (float)(1 - (double)hit->u - (double)hit->v);
    p.weights[1] = hit->u;
    p.weights[2] = hit->v;
    const lmp_vec3 d = vec_load(direction);
    const lmp_vec3 normal = mix(v[0].normal, v[1].normal, v[2].normal, p.weights);
    p.side = vec_dot(t->face, d) > 0 ? -1.0f : 1.0f;
    p.smooth = vec_dot(normal, normal) > 0 ? vec_normalize(normal, t->face)
                                           : vec_normalize(t->face, vec(0, 1, 0));
    set_vector(s->position, at, mix(v[0].position, v[1].position, v[2].position, p.weights));
    const scene_material *m = p.material;
    const bool layered = s->layered && render_material_is_layered(s->materials, t->number);
    if (!t->mapped && !layered) {
        fill_plain(&p, t->number, at, s);
        return;
    }
    if (t->mapped)
        set_footprint(&s->camera, direction, hit->distance, t->edges, t->face, &p);
    s->seen[at] = t->number;
    const lmp_vec3 n = bend(&p, p.smooth, &m->normal_map, m->normal_scale);
    set_vector(s->normal, at, vec_scale(n, p.side));
    fill_base(&p, at, s);
    float texel[4], emission[3];
    look_up(&p, &m->emission_map, texel);
    for (int c = 0; c < 3; c++)
        emission[c] = m->emission[c] * texel[c];
    if (m->flags & SCENE_UNLIT)
        tint(&p, emission);
    if (layered)
        fill_layers(&p, vec_normalize(vec_scale(d, -1), d), at, s, emission);
    set_vector(s->emission, at, vec_load(emission));
}
