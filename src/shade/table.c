/* SPDX-License-Identifier: MIT */
#include <lampion/shade.h>

#include <math.h>

typedef struct frame {
    lmp_vec3 x, y, z;
} frame;

static float dot(lmp_vec3 a, lmp_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static lmp_vec3 cross(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* v without its part along the unit n, made unit; false where nothing is left. */
static bool flatten(lmp_vec3 v, lmp_vec3 n, lmp_vec3 *flat) {
    const float along = dot(v, n);
    const lmp_vec3 rest = { v.x - along * n.x, v.y - along * n.y, v.z - along * n.z };
    const float length2 = dot(rest, rest);
    if (!(length2 > 1e-12f * dot(v, v)))
        return false;
    const float scale = 1 / sqrtf(length2);
    *flat = (lmp_vec3) { rest.x * scale, rest.y * scale, rest.z * scale };
    return true;
}

/* The material's x axis: the tangent, or the horizontal direction across the normal. */
static lmp_vec3 across(lmp_vec3 tangent, lmp_vec3 n) {
    lmp_vec3 x = { 1, 0, 0 };
    if (flatten(tangent, n, &x))
        return x;
    const lmp_vec3 up = { 0, 1, 0 }, side = x;
    if (!flatten(cross(up, n), n, &x))
        flatten(side, n, &x);
    return x;
}

static lmp_vec3 into(const frame *f, lmp_vec3 v) {
    return (lmp_vec3) { dot(v, f->x), dot(v, f->y), dot(v, f->z) };
}

/* Σ of what one light's coefficients give with the table's, m >= 0 alone if mirrored. */
static float gather(const lmp_brdf_table_info *info, const float *light, const float *table) {
    float sum = 0;
    for (int l = 0; l < info->bands; l++)
        for (int m = info->mirrored ? 0 : -l; m <= l; m++)
            sum += light[LMP_SH_INDEX(l, m)] * *table++;
    return fmaxf(sum, 0);
}

lmp_rgb lmp_shade_table(const lmp_brdf_table *table, const lmp_surface *surface, lmp_vec3 tangent,
                        const lmp_light *lights, size_t count) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const lmp_vec3 n = surface->normal, material_x = across(tangent, n);
    frame view = { .x = material_x, .z = n };
    flatten(surface->view, n, &view.x);
    view.y = cross(n, view.x);
    const float phi = atan2f(dot(view.x, cross(n, material_x)), dot(view.x, material_x));

    float sum[3 * LMP_BANDS_MAX * LMP_BANDS_MAX], rgb[3 * LMP_BANDS_MAX * LMP_BANDS_MAX];
    const size_t plane = LMP_SH_COUNT(info.bands);
    for (size_t i = 0; i < 3 * plane; i++)
        sum[i] = 0;
    for (size_t i = 0; i < count; i++) {
        lmp_light light = lights[i];
        const lmp_vec3 offset = { light.position.x - surface->position.x,
                                  light.position.y - surface->position.y,
                                  light.position.z - surface->position.z };
        light.position = into(&view, offset);
        light.direction = into(&view, light.direction);
        lmp_light_project(&light, 1, (lmp_vec3) { 0, 0, 0 }, info.bands, rgb);
        for (size_t k = 0; k < 3 * plane; k++)
            sum[k] += rgb[k];
    }
    lmp_brdf_table_view(table, dot(surface->view, n), phi, rgb);
    return (lmp_rgb) { gather(&info, sum, rgb), gather(&info, sum + plane, rgb + info.count),
                       gather(&info, sum + 2 * plane, rgb + 2 * info.count) };
}
