/* SPDX-License-Identifier: MIT */
#include "app/scene/emission.h"

#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

#define PI    3.14159265358979
#define STEPS 4 /* of a triangle's edge: STEPS² samples of the texture */
/* Triangles dimmer than this share of the mesh's brightest do not count. */
#define DIM_SHARE 0.02

typedef struct emitter {
    const scene_vertex *vertices;
    const uint32_t *indices;
    const scene_mesh *mesh;
    const scene_material *material;
    const scene_texture *texture; /* or NULL */
    const unsigned char *texels;
} emitter;

static double linear_from_srgb(unsigned char byte) {
    const double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

/* The pixel that coordinate x falls on. */
static uint32_t wrapped_pixel(float x, uint32_t mode, uint32_t size) {
    float whole = floorf(x), part = x - whole;
    if (!isfinite(part))
        return 0;
    if (mode == SCENE_WRAP_CLAMP)
        part = fminf(fmaxf(x, 0.0f), 1.0f);
    else if (mode == SCENE_WRAP_MIRROR && fmodf(whole, 2.0f) != 0.0f)
        part = 1.0f - part;
    const uint32_t pixel = (uint32_t)(part * (float)size);
    return pixel < size ? pixel : size - 1;
}

static void add_texel(const emitter *e, const float uv[2], double sum[3]) {
    const scene_texture_use *use = &e->material->emission_map;
    const float u = use->matrix[0] * uv[0] + use->matrix[1] * uv[1] + use->offset[0];
    const float v = use->matrix[2] * uv[0] + use->matrix[3] * uv[1] + use->offset[1];
    const uint32_t x = wrapped_pixel(u, e->texture->wrap_u, e->texture->width);
    const uint32_t y = wrapped_pixel(v, e->texture->wrap_v, e->texture->height);
    const unsigned char *texel =
        e->texels + e->texture->first_byte + 4 * ((size_t)y * e->texture->width + x);
    for (int k = 0; k < 3; k++)
        sum[k] += linear_from_srgb(texel[k]);
}

/* Mean radiance of a triangle; returns its area. */
static double measure_triangle(const emitter *e, const uint32_t *corners, double radiance[3]) {
    const scene_vertex *a = &e->vertices[corners[0]], *b = &e->vertices[corners[1]];
    const scene_vertex *c = &e->vertices[corners[2]];
    double sum[3] = { 1.0, 1.0, 1.0 };
    if (e->texture) {
        memset(sum, 0, sizeof sum);
        /* Centroids of the STEPS² small triangles, upright and inverted. */
        for (int i = 0; i < STEPS; i++)
            for (int k = 0; k < 2 * (STEPS - i) - 1; k++) {
                const float third = k % 2 ? 2.0f / 3.0f : 1.0f / 3.0f;
                const float s = ((float)i + third) / STEPS;
                const float t = ((float)(k / 2) + third) / STEPS;
                const float uv[2] = {
                    a->uv[0] + s * (b->uv[0] - a->uv[0]) + t * (c->uv[0] - a->uv[0]),
                    a->uv[1] + s * (b->uv[1] - a->uv[1]) + t * (c->uv[1] - a->uv[1]),
                };
                add_texel(e, uv, sum);
            }
        for (int k = 0; k < 3; k++)
            sum[k] /= STEPS * STEPS;
    }
    for (int k = 0; k < 3; k++)
        radiance[k] = (double)e->material->emission[k] * sum[k];
    const lmp_vec3 origin = vec_load(a->position);
    return 0.5 * (double)vec_length(vec_cross(vec_sub(vec_load(b->position), origin),
                                              vec_sub(vec_load(c->position), origin)));
}

static double brightest(const double color[3]) {
    return fmax(color[0], fmax(color[1], color[2]));
}

/* The sphere round the box of the triangles that glow at least `threshold`, and their power. */
static bool measure_emitter(const emitter *e, double threshold, scene_light *light) {
    double power[3] = { 0.0 }, center[3] = { 0.0 }, lo[3] = { 0.0 }, hi[3] = { 0.0 };
    double radius = 0.0;
    bool any = false;
    /* First the box, then the farthest corner from its middle. */
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < e->mesh->index_count; i += 3) {
            const uint32_t *corners = e->indices + e->mesh->first_index + i;
            double radiance[3];
            const double area = measure_triangle(e, corners, radiance);
            if (!(brightest(radiance) >= threshold) || !(area > 0.0))
                continue;
            for (int c = 0; c < 3; c++) {
                const float *p = e->vertices[corners[c]].position;
                double square = 0.0;
                for (int k = 0; k < 3; k++) {
                    const double x = (double)p[k];
                    if (pass == 0) {
                        lo[k] = any ? fmin(lo[k], x) : x;
                        hi[k] = any ? fmax(hi[k], x) : x;
                    }
                    square += (x - center[k]) * (x - center[k]);
                }
                any = true;
                if (pass == 1)
                    radius = fmax(radius, sqrt(square));
            }
            for (int k = 0; k < 3; k++) {
                if (pass == 0)
                    power[k] += PI * area * radiance[k];
                center[k] = 0.5 * (lo[k] + hi[k]);
            }
        }
    if (!(radius > 0.0))
        return false;
    const double sides = e->material->flags & SCENE_DOUBLE_SIDED ? 2.0 : 1.0;
    light->hidden = 1;
    light->radius = (float)radius;
    for (int k = 0; k < 3; k++) {
        light->center[k] = (float)center[k];
        light->radiance[k] = (float)(sides * power[k] / (4.0 * PI * PI * radius * radius));
    }
    return light->radius > 0.0f;
}

bool emission_add_lights(scene_builder *builder, const char *subject, cli_error *error) {
    const scene_mesh *meshes = builder_items(builder, BLOB_MESHES);
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    const scene_texture *textures = builder_items(builder, BLOB_TEXTURES);
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++) {
        const scene_material *material = &materials[meshes[i].material];
        const double emission[3] = { (double)material->emission[0], (double)material->emission[1],
                                     (double)material->emission[2] };
        if (!(brightest(emission) > 0.0))
            continue;
        const int32_t texture = material->emission_map.texture;
        const emitter e = { .vertices = builder_items(builder, BLOB_VERTICES),
                            .indices = builder_items(builder, BLOB_INDICES),
                            .mesh = &meshes[i],
                            .material = material,
                            .texture = texture < 0 ? NULL : &textures[texture],
                            .texels = builder_items(builder, BLOB_TEXELS) };
        double peak = 0.0;
        for (uint32_t k = 0; k < meshes[i].index_count; k += 3) {
            double radiance[3];
            measure_triangle(&e, e.indices + meshes[i].first_index + k, radiance);
            peak = fmax(peak, brightest(radiance));
        }
        scene_light light = { 0 };
        if (!(peak > 0.0) || !measure_emitter(&e, DIM_SHARE * peak, &light))
            continue;
        scene_light *appended = builder_append(builder, BLOB_LIGHTS, 1);
        if (!appended)
            return cli_fail(error, subject, "does not fit into memory");
        *appended = light;
    }
    return true;
}
