/* SPDX-License-Identifier: MIT */
#include "app/view/aim.h"

#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

/* How far above the surface a rim light stands, as a sine: 15 degrees. */
#define RIM_SINE 0.2588190f

const char *const view_aim_names[VIEW_AIMS + 1] = {
    [VIEW_AIM_OFF] = "off",
    [VIEW_AIM_REFLECTION] = "reflection",
    [VIEW_AIM_ILLUMINATION] = "illumination",
    [VIEW_AIM_RIM] = "rim",
};

/* --- directions ------------------------------------------------------------------------------- */

lmp_vec3 view_aim_direction(view_aim aim, lmp_vec3 normal, lmp_vec3 view) {
    /* interpolated normals may turn away from the eye near a silhouette */
    const lmp_vec3 n = vec_dot(normal, view) > 0 ? normal : vec_reject(normal, view);
    if (aim == VIEW_AIM_ILLUMINATION)
        return n;
    if (aim == VIEW_AIM_REFLECTION)
        return vec_normalize(vec_sub(vec_scale(n, 2 * vec_dot(n, view)), view), n);
    const lmp_vec3 away = vec_reject(vec_scale(view, -1), n);
    return vec_normalize(
        vec_add(vec_scale(n, RIM_SINE), vec_scale(away, sqrtf(1 - RIM_SINE * RIM_SINE))), n);
}

void view_aim_light(lmp_light *light, lmp_vec3 point, lmp_vec3 direction, float distance) {
    const scene_light any = { .emitter = *light };
    if (scene_light_has(&any, SCENE_LIGHT_POSITION)) {
        light->position = vec_add(point, vec_scale(direction, distance));
        scene_light_face(light, vec_scale(direction, -1));
    } else {
        light->direction = direction;
    }
}

/* --- dragging --------------------------------------------------------------------------------- */

void view_choose_aim(view_state *s, int aim) {
    static const char *const meanings[VIEW_AIMS] = {
        [VIEW_AIM_OFF] = "Dragging moves the camera",
        [VIEW_AIM_REFLECTION] = "Reflection: drag the highlight over a surface",
        [VIEW_AIM_ILLUMINATION] = "Illumination: drag what the light faces over a surface",
        [VIEW_AIM_RIM] = "Rim: drag along an edge, which is lit from behind",
    };
    s->aim = s->aim == (view_aim)aim ? VIEW_AIM_OFF : (view_aim)aim;
    view_say(s, s->selected < 0 && s->aim != VIEW_AIM_OFF ? "%s; select a light first" : "%s",
             meanings[s->aim]);
}

bool view_aim_begin(view_state *s) {
    if (s->aim == VIEW_AIM_OFF || s->selected < 0)
        return false;
    view_ray ray;
    const view_hit hit = view_hit_at_pointer(s, &ray);
    if (hit.mesh < 0)
        return false;
    const scene_light shown = view_shown_light(s, s->selected);
    s->drag = VIEW_DRAG_AIM;
    s->grabbed = s->now.lights[s->selected];
    s->aim_distance = vec_length(vec_sub(shown.emitter.position, hit.point));
    s->grab = vec_sub(s->grabbed.emitter.position, shown.emitter.position);
    view_aim_follow(s);
    return true;
}

/* Rotates the light as it was when the drag began, so that where it ends does not depend on the way
 * there. */
void view_aim_follow(view_state *s) {
    view_ray ray;
    const view_hit hit = view_hit_at_pointer(s, &ray);
    scene_light moved = s->grabbed;
    if (hit.mesh < 0)
        return;
    const lmp_vec3 direction = view_aim_direction(s->aim, hit.smooth, vec_scale(ray.direction, -1));
    view_aim_light(&moved.emitter, hit.point, direction, s->aim_distance);
    moved.emitter.position = vec_add(moved.emitter.position, s->grab);
    view_change_light(s, &moved);
}
