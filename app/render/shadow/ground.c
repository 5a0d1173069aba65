/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/ground.h"

#include "app/scene/vector.h"

/* The ground's radius in radii of the scene: farther out, the scene hides less than a thousandth of
 * the sky. */
static const float reach_radii = 30;

/* A disk around the point below the middle of the scene. */
typedef struct disk {
    lmp_vec3 middle;
    float radius;
} disk;

static disk disk_under(const scene *s) {
    const lmp_vec3 low = vec_load(s->minimum), high = vec_load(s->maximum);
    const lmp_vec3 center = vec_scale(vec_add(low, high), 0.5f);
    return (disk) { vec(center.x, low.y, center.z),
                    reach_radii * 0.5f * vec_length(vec_sub(high, low)) };
}

/* Finds where a ray meets the disk from above; directions have the length of render_camera's. */
static bool meets(const disk *ground, lmp_vec3 origin, lmp_vec3 direction, float far,
                  lmp_vec3 *at) {
    const float above = origin.y - ground->middle.y;
    if (!(above > 0 && direction.y < 0))
        return false;
    const float depth = above / -direction.y;
    *at = vec_add(origin, vec_scale(direction, depth));
    at->y = ground->middle.y;
    return depth < far && vec_length(vec_sub(*at, ground->middle)) < ground->radius;
}

static void set_surface(render_tile *tile, int i, lmp_vec3 at, lmp_vec3 view) {
    const float position[3] = { at.x, at.y, at.z }, normal[3] = { 0, 1, 0 };
    const float to_camera[3] = { view.x, view.y, view.z };
    for (int c = 0; c < 3; c++) {
        tile->position[c][i] = position[c];
        tile->normal[c][i] = normal[c];
        tile->view[c][i] = to_camera[c];
        tile->emission[c][i] = tile->transmitted[c][i] = 0;
    }
    tile->kind[i] = RENDER_SURFACE;
    tile->ambient[i] = 1;
    tile->material[i] = render_material_matte((lmp_rgb) { 1, 1, 1 });
}

void shadow_ground_lay(const scene *s, const render_camera *camera, const render_rectangle *pixels,
                       render_tile *tile) {
    const disk ground = disk_under(s);
    for (int i = 0; i < pixels->width * pixels->height; i++) {
        const int x = pixels->x + i % pixels->width, y = pixels->y + i / pixels->width;
        float o[3], d[3];
        lmp_vec3 at;
        if (tile->kind[i] != RENDER_NONE)
            continue;
        render_camera_rays(camera, &x, &y, 1, (float *[3]) { &o[0], &o[1], &o[2] },
                           (float *[3]) { &d[0], &d[1], &d[2] });
        const lmp_vec3 direction = vec_load(d);
        if (meets(&ground, vec_load(o), direction, camera->far, &at))
            set_surface(tile, i, at, vec_scale(direction, -1 / vec_length(direction)));
    }
}
