/* SPDX-License-Identifier: MIT */
/* area_hit.glsl - where rays meet the lights of areas.glsl. A ray begins at the origin, and its
 * direction is unit; the distance is below 0 for a miss, and from behind a light that shines from one
 * side. */

/* Whether a point of a polygon's plane, from its middle, is inside: whether a line from it along x
 * crosses an odd number of sides. */
bool area_holds(int i, int corners, vec3 p, vec3 x, vec3 y) {
    bool inside = false;
    vec3 a = areas_texel(i, 2 + corners).xyz - p;
    for (int k = 0; k < corners; k++) {
        vec3 b = areas_texel(i, 3 + k).xyz - p;
        vec2 from = vec2(dot(a, x), dot(a, y)), to = vec2(dot(b, x), dot(b, y));
        if ((from.y > 0.0) != (to.y > 0.0) && (from.x * to.y - from.y * to.x > 0.0) == (to.y > from.y))
            inside = !inside;
        a = b;
    }
    return inside;
}

float area_hit_flat(int i, float shape, vec3 center, vec3 ray) {
    vec4 normal = areas_texel(i, 2);
    float slope = dot(ray, normal.xyz), hit = dot(center, normal.xyz) / slope;
    if (!(hit > 0.0) || (shape > 0.0 && slope > 0.0))
        return -1.0;
    vec3 p = ray * hit - center;
    int corners = int(abs(shape));
    if (corners < 3)
        return dot(p, p) <= normal.w * normal.w ? hit : -1.0;
    vec3 x = normalize(cross(normal.xyz, abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    return area_holds(i, corners, p, x, cross(normal.xyz, x)) ? hit : -1.0;
}

/* Returns from where to where a ray is in a sphere; the first is larger for a miss. */
vec2 area_inside_sphere(vec3 center, float radius, vec3 ray) {
    float along = dot(ray, center);
    vec3 miss = center - ray * along;
    float half_chord2 = radius * radius - dot(miss, miss), half_chord = sqrt(max(half_chord2, 0.0));
    return half_chord2 < 0.0 ? vec2(1e30, -1e30) : vec2(along - half_chord, along + half_chord);
}

/* Returns that of a tube's side, between its ends. */
vec2 area_inside_side(vec3 center, vec3 half_axis, float radius, vec3 ray) {
    float half_length = length(half_axis);
    vec3 axis = half_axis / half_length, across = ray - axis * dot(ray, axis);
    vec3 to = center - axis * dot(center, axis);
    float a = dot(across, across), b = dot(across, to), c = dot(to, to) - radius * radius;
    float root2 = b * b - a * c, root = sqrt(max(root2, 0.0)), slope = dot(ray, axis);
    float reach = half_length / max(abs(slope), 1e-30), middle = dot(center, axis) / slope;
    if (abs(slope) < 1e-7)
        return root2 < 0.0 || abs(dot(center, axis)) > half_length ? vec2(1e30, -1e30)
                                                                   : vec2(b - root, b + root) / a;
    vec2 ends = vec2(middle - reach, middle + reach);
    if (a < 1e-12)
        return c > 0.0 ? vec2(1e30, -1e30) : ends;
    vec2 side = root2 < 0.0 ? vec2(1e30, -1e30) : vec2(b - root, b + root) / a;
    return vec2(max(side.x, ends.x), min(side.y, ends.y));
}

float area_hit_tube(int i, vec3 center, vec3 ray) {
    vec4 tube = areas_texel(i, 2);
    vec2 first = area_inside_sphere(center - tube.xyz, tube.w, ray);
    vec2 last = area_inside_sphere(center + tube.xyz, tube.w, ray);
    vec2 side = area_inside_side(center, tube.xyz, tube.w, ray);
    if (side.x > side.y)
        side = vec2(1e30, -1e30);
    vec2 inside = vec2(min(side.x, min(first.x, last.x)), max(side.y, max(first.y, last.y)));
    return inside.x > inside.y ? -1.0 : inside.x > 0.0 ? inside.x : inside.y;
}

/* Returns the distance to area i, whose middle is at `center`. */
float area_hit(int i, vec3 center, vec3 ray) {
    float shape = areas_texel(i, 0).w;
    return abs(shape) == 2.0 ? area_hit_tube(i, center, ray) : area_hit_flat(i, shape, center, ray);
}
