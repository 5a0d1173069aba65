/* SPDX-License-Identifier: MIT */
/* The camera of a scene that has none: outside, before a model, or inside a building. */
#include "app/scene/instance.h"
#include "app/scene/interior.h"
#include "app/scene/space.h"
#include "app/scene/subject.h"
#include "app/scene/vector.h"

#define DEFAULT_FOV   0.7854f /* 45° */
#define INSIDE_FOV    1.2f    /* wide, as rooms are photographed */
#define INSIDE_BACK   0.8f    /* fraction of the distance to the wall behind */
#define INSIDE_HEIGHT 0.4f    /* fraction of a room's height */
#define FRAMING_PART  0.9f    /* fraction of the image that a model fills at most */

/* Looks at the middle of a room from where most of it is visible. Where no wall limits how far the
 * camera may go, it looks ahead from the middle. */
static scene_camera camera_inside(const scene *s, lmp_vec3 middle) {
    scene_camera camera = { .name = "inside", .up = { 0.0f, 1.0f, 0.0f }, .fov = INSIDE_FOV };
    const space_room room = space_room_at(s, middle);
    const lmp_vec3 size = vec_sub(vec_load(s->maximum), vec_load(s->minimum));
    float most = 0.0f;
    lmp_vec3 way = vec(0.0f, 0.0f, 1.0f);
    for (int axis = 0; axis < 3; axis += 2)
        for (int sign = -1; sign <= 1; sign += 2) {
            const float free = sign < 0 ? room.back[axis] : room.ahead[axis];
            if (isfinite(free) && free > most) {
                most = free;
                way = axis == 0 ? vec((float)sign, 0.0f, 0.0f) : vec(0.0f, 0.0f, (float)sign);
            }
        }
    if (isfinite(room.back[1]) && isfinite(room.ahead[1]))
        middle.y += INSIDE_HEIGHT * (room.back[1] + room.ahead[1]) - room.back[1];
    const lmp_vec3 eye = vec_add(middle, vec_scale(way, INSIDE_BACK * most));
    if (!(most > 0.0f))
        middle.z -= fmaxf(vec_length(size), 1e-18f);
    vec_store(eye, camera.eye);
    vec_store(middle, camera.target);
    return camera;
}

/* --- outside ---------------------------------------------------------------------------------- */

/* The view pyramid of a model, with these slopes, looking along -from. Its planes touch the model
 * where x + slope z and -x + slope z are largest, which gives the position of its tip between two
 * of them. */
typedef struct pyramid {
    scene_subject subject;
    lmp_vec3 center, right, up, from;
    float slope[2];    /* across, along up */
    float touching[4]; /* distance of the plane that touches: right, left, top, bottom */
    float radius;      /* of the model around its center */
} pyramid;

/* Finds how far a point reaches past the planes and away from the center. */
static void reach_of(const pyramid *f, lmp_vec3 point, float sides[4], float *radius) {
    const lmp_vec3 p = vec_sub(point, f->center);
    const float x = vec_dot(f->right, p), y = vec_dot(f->up, p), z = vec_dot(f->from, p);
    sides[0] = x + f->slope[0] * z;
    sides[1] = -x + f->slope[0] * z;
    sides[2] = y + f->slope[1] * z;
    sides[3] = -y + f->slope[1] * z;
    *radius = vec_length(p);
}

/* Whether the instance's box may reach farther than what has been touched so far. */
static bool may_touch(const scene *s, size_t instance, const pyramid *f) {
    float low[3], high[3], sides[4], radius;
    scene_instance_box(s, instance, low, high);
    for (int i = 0; i < 8; i++) {
        const lmp_vec3 corner =
            vec(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
        reach_of(f, corner, sides, &radius);
        for (int k = 0; k < 4; k++)
            if (!(sides[k] <= f->touching[k]))
                return true;
        if (!(radius <= f->radius))
            return true;
    }
    return false;
}

/* Whether a triangle belongs to what is framed. */
static bool is_framed(const scene_subject *subject, const float corners[3][3]) {
    for (int i = 0; i < 3 && subject->part; i++) {
        const lmp_vec3 p = vec_load(corners[i]);
        if (!(p.x >= subject->low.x && p.y >= subject->low.y && p.z >= subject->low.z &&
              p.x <= subject->high.x && p.y <= subject->high.y && p.z <= subject->high.z))
            return false;
    }
    return true;
}

static void touch(const scene *s, pyramid *f) {
    for (int i = 0; i < 4; i++)
        f->touching[i] = -INFINITY;
    for (size_t i = 0; i < s->instance_count; i++) {
        if (!may_touch(s, i, f))
            continue;
        for (uint32_t n = 0; n < scene_instance_triangles(s, i); n++) {
            float corners[3][3], sides[4], radius;
            scene_triangle_positions(s, i, n, corners);
            const bool framed = is_framed(&f->subject, (const float(*)[3])corners);
            for (int k = 0; k < 3 && framed; k++) {
                reach_of(f, vec_load(corners[k]), sides, &radius);
                for (int side = 0; side < 4; side++)
                    f->touching[side] = fmaxf(f->touching[side], sides[side]);
                f->radius = fmaxf(f->radius, radius);
            }
        }
    }
}

static float half_width(const pyramid *f, int axis) {
    return 0.5f * (f->touching[2 * axis] + f->touching[2 * axis + 1]);
}

/* Returns the distance at which every triangle fits into the image; the camera never stands inside
 * the model. Where the view is wider than needed, slopes shrink until the planes touch from
 * there. */
static float fit(const scene *s, pyramid *f) {
    enum { PASSES = 4 };
    touch(s, f);
    const float distance =
        fmaxf(f->radius, fmaxf(half_width(f, 0) / f->slope[0], half_width(f, 1) / f->slope[1]));
    for (int pass = 1; pass < PASSES; pass++) {
        for (int axis = 0; axis < 2; axis++)
            f->slope[axis] = half_width(f, axis) / distance;
        touch(s, f);
    }
    return distance;
}

/* Puts the model in the middle of the image, as near as fits. */
static scene_camera camera_before(const scene *s, const scene_frame *frame, float aspect) {
    static const float from[4][2] = {
        { 0.45f, 1.0f }, { 1.0f, -0.45f }, { -0.45f, -1.0f }, { -1.0f, 0.45f }
    };
    const scene_subject *const seen = &frame->subject;
    const float *const way = from[frame->quarter];
    const lmp_vec3 center = vec_add(vec_scale(seen->low, 0.5f), vec_scale(seen->high, 0.5f));
    const float slope = FRAMING_PART * (float)tan(0.5 * (double)DEFAULT_FOV);
    pyramid f = { .subject = *seen,
                  .center = center,
                  .from = vec_normalize(vec(way[0], 0.35f, way[1]), vec(0.0f, 0.0f, 1.0f)),
                  .slope = { slope * aspect, slope },
                  .radius = 1e-18f };
    f.right = vec_normalize(vec_cross(vec(0.0f, 1.0f, 0.0f), f.from), f.from);
    f.up = vec_cross(f.from, f.right);
    scene_camera camera = { .name = "framed", .up = { 0.0f, 1.0f, 0.0f }, .fov = DEFAULT_FOV };
    const float distance = s->index_count > 0 ? fit(s, &f) : f.radius;
    const lmp_vec3 aside = vec_add(vec_scale(f.right, 0.5f * (f.touching[0] - f.touching[1])),
                                   vec_scale(f.up, 0.5f * (f.touching[2] - f.touching[3])));
    const lmp_vec3 target = vec_add(center, aside);
    vec_store(target, camera.target);
    vec_store(vec_add(target, vec_scale(f.from, distance)), camera.eye);
    return camera;
}

float scene_camera_height(const scene_camera *camera, float distance) {
    return camera->height > 0.0f ? camera->height
                                 : 2.0f * distance * (float)tan(0.5 * (double)camera->fov);
}

/* Widens the field of view for images narrower than the camera's aspect, which then see more above
 * and below. */
static void widen(scene_camera *camera, float aspect) {
    if (!(aspect > 0.0f && aspect < camera->aspect))
        return;
    camera->height *= camera->aspect / aspect;
    camera->fov =
        (float)(2.0 * atan(tan(0.5 * (double)camera->fov) * (double)(camera->aspect / aspect)));
}

/* Returns the file's first camera. */
static scene_camera own_camera(const scene *s, float aspect) {
    scene_camera first = s->cameras[0];
    widen(&first, aspect);
    return first;
}

/* --- which ------------------------------------------------------------------------------------ */

const char *const scene_framing_names[] = { "auto", "outside", "inside", NULL };

#define FRONTS_POOR   0.5f  /* below this fraction of fronts, other sides are tried */
#define FRONTS_BETTER 0.25f /* by which another side must be better */

/* Returns the side that shows most fronts: boxes are viewed from where they are open. */
static int best_quarter(const scene_interior *found) {
    int best = 0;
    if (found->fronts_before[0] < FRONTS_POOR)
        for (int i = 1; i < 4; i++)
            if (found->fronts_before[i] > found->fronts_before[best] &&
                found->fronts_before[i] > found->fronts_before[0] + FRONTS_BETTER)
                best = i;
    return best;
}

/* Whether everything is drawn from both sides, as those of formats that say nothing of sides
 * are. */
static bool draws_backs(const scene *s) {
    for (size_t i = 0; i < s->instance_count && s->material_count > 0; i++)
        if (!(s->materials[scene_instance_material(s, i)].flags & SCENE_DOUBLE_SIDED))
            return false;
    return s->material_count > 0;
}

/* Returns the fraction of the upper sky that reaches what is framed from outside. Cells as large as
 * a model in wide surroundings tell only whether these close above it, as a dome does. */
static float find_sky(const scene *s, const scene_grid *grid, const scene_frame *frame) {
    lmp_vec3 above = vec_scale(vec_add(frame->subject.low, frame->subject.high), 0.5f);
    above.y += 0.05f * scene_diagonal(s);
    if (frame->subject.part)
        return scene_interior_closes(grid, above) ? 0.0f : 1.0f;
    return scene_interior_sky(grid, frame->quarter, draws_backs(s));
}

static scene_frame find_frame(const scene *s, scene_framing wanted) {
    scene_frame frame = {
        .wanted = wanted, .framing = wanted, .subject = scene_subject_find(s), .sky = 1.0f
    };
    scene_grid *grid = s->index_count > 0 ? scene_grid_create(s) : NULL;
    if (frame.framing == SCENE_FRAMING_AUTO)
        frame.framing = SCENE_FRAMING_OUTSIDE;
    if (!grid)
        return frame;
    const scene_interior found = scene_interior_find(grid);
    frame.middle = found.middle;
    frame.quarter = best_quarter(&found);
    if (s->camera_count == 0 || wanted == SCENE_FRAMING_OUTSIDE)
        frame.sky = find_sky(s, grid, &frame);
    frame.own = s->camera_count > 0 && scene_interior_closes(grid, vec_load(s->cameras->eye));
    if (wanted == SCENE_FRAMING_AUTO && (s->camera_count > 0 ? frame.own : found.inside))
        frame.framing = SCENE_FRAMING_INSIDE;
    scene_grid_destroy(grid);
    return frame;
}

scene_frame scene_frame_of(const scene *s) {
    if (s->frame && s->frame->framing != SCENE_FRAMING_AUTO)
        return *s->frame;
    const scene_frame found = find_frame(s, s->frame ? s->frame->wanted : SCENE_FRAMING_AUTO);
    if (s->frame)
        *s->frame = found;
    return found;
}

bool scene_is_inside(const scene *s) {
    return scene_frame_of(s).framing == SCENE_FRAMING_INSIDE;
}

scene_camera scene_framed_camera(const scene *s, scene_framing framing, float aspect) {
    const scene_frame frame = scene_frame_of(s);
    if (framing == SCENE_FRAMING_AUTO)
        framing = frame.framing;
    if (framing == SCENE_FRAMING_INSIDE)
        return frame.own ? own_camera(s, aspect) : camera_inside(s, frame.middle);
    return camera_before(s, &frame, aspect > 0.0f ? aspect : 1.0f);
}

scene_camera scene_default_camera(const scene *s, float aspect) {
    if (s->camera_count > 0 && !(s->frame && s->frame->wanted != SCENE_FRAMING_AUTO))
        return own_camera(s, aspect);
    return scene_framed_camera(s, SCENE_FRAMING_AUTO, aspect);
}
