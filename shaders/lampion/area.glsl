/* SPDX-License-Identifier: MIT */
/* area.glsl - lights that are areas: rectangles, disks, tubes and polygons of lampion/light.h.
 *
 * Include it after lampion.glsl, and after coefficients.glsl if that is used: lmp_shade_zonal and
 * lmp_shade_coefficients then add the areas to the other lights. Define before lampion.glsl what it
 * says for lights, LMP_LIGHT_COUNT 0 if there are none, and
 *   LMP_AREA_COUNT        int: number of areas
 *   LMP_AREA_TEXEL(i, k)  vec4: number k of area i, as lmp_light_copy_area_texels fills them:
 *       0    a point near its middle and, in w, its shape: LMP_AREA_DISK, LMP_AREA_TUBE or the
 *            number of its corners, 3 … 8; negative if it shines from both sides
 *       1    its radiance and, in w, the distance of its farthest point from its middle
 *       2    its unit normal, or the half of a tube's axis, from the middle; w: the radius of a disk
 *            or a tube
 *       3 …  a polygon's corners, from its middle and counter-clockwise around the normal
 *
 * What there is beside the lmp_shade_… functions
 *   lmp_area_irradiance   irradiance under an area of radiance 1, cut by the surface's horizon
 *   lmp_area_respond      that, and the response of lobes
 *
 * What is seen of an area is a loop of edges of great circles. An integral over it is the sum of one
 * along each edge, O(LMP_BANDS) a lobe; where the area looks small, its edges cancel, and 4 to 16
 * nodes, or three times as many for a tube or a polygon of 7 and 8 corners, stand for its parts. A
 * disk's loop has LMP_AREA_EDGES edges, and a tube's has as many at both ends together.
 *
 * Largest errors against the exact integrals, of 10 bands, in parts of the most that a surface or a
 * lobe can get of the light at that distance: from the outline less than a tenth of the light's size,
 * less than the size, farther. Where the sum changes from one way to the other, steps are below 1e-4.
 *       with corners   irradiance 4e-3, 1e-4, 1e-5   lobes 2e-3, 2e-4, 5e-4
 *       disk                      5e-3, 2e-4, 3e-5         9e-3, 7e-3, 2e-4
 *       tube                      4e-3, 2e-4, 3e-4         5e-3, 2e-3, 2e-4
 * The worst are lights a hundred times as long as wide, and points at 1e-4 of the size. Positions are
 * float: what lies close to an area must not be far from the origin. */
#ifndef LAMPION_AREA_GLSL
#define LAMPION_AREA_GLSL

#define LMP_AREA_DISK  1
#define LMP_AREA_TUBE  2
#define LMP_AREA_EDGES 16

/* What the includer defined is only read here, where no local name can hide one of its own. */
int lmp_area_count() {
    return LMP_AREA_COUNT;
}
vec4 lmp_area_texel(int lmp_i, int lmp_k) {
    return LMP_AREA_TEXEL(lmp_i, lmp_k);
}

/* Returns the angle of the direction (x, y), -pi … pi; languages promise few digits of their own. */
float lmp_area_angle(float y, float x) {
    float t = abs(y) / max(sqrt(x * x + y * y) + abs(x), 1e-30);
    t /= 1.0 + sqrt(1.0 + t * t);
    t /= 1.0 + sqrt(1.0 + t * t);
    float t2 = t * t;
    float series = (((t2 / 9.0 - 1.0 / 7.0) * t2 + 0.2) * t2 - 1.0 / 3.0) * t2 + 1.0;
    float acute = 8.0 * t * series, angle = x < 0.0 ? LMP_PI - acute : acute;
    return y < 0.0 ? -angle : angle;
}

/* Returns the cosine and the sine of an angle, -pi … pi, from those of its quarter. */
vec2 lmp_area_direction(float angle) {
    float q = 0.25 * angle, q2 = q * q;
    float series = (((q2 / 72.0 - 1.0) * q2 / 42.0 + 1.0) * q2 / 20.0 - 1.0) * q2 / 6.0 + 1.0;
    float s = q * series, sine = 2.0 * s * sqrt(1.0 - s * s), cosine = 1.0 - 2.0 * s * s;
    return vec2(1.0 - 2.0 * sine * sine, 2.0 * sine * cosine);
}

/* --- what a point sees ------------------------------------------------------------------------ */

/* An area as seen from a point, which sees nothing of a flat one at height 0. */
struct lmp_area {
    vec3 center; /* from the point */
    float distance;
    int shape;
    float side;   /* -1 where the back is seen, else 1 */
    float height; /* the distance of the plane, or of the line of a tube's axis */
    float radius, extent;
    vec3 normal;            /* of a flat one; of a tube, along its axis */
    vec3 x, y;              /* of a tube, to the line of its axis, and across */
    float along, half_axis; /* of a tube: how far its middle is along the axis, and half its length */
    float crowded;          /* of a disk, how close vertices are at the nearest point of its rim */
    int end_edges;          /* of a tube, how many edges stand for the first end */
};

/* The circle that is seen of an end of a tube: middle + radius (outward cos a + across sin a), from
 * the area's center, for -angle <= a <= angle. */
struct lmp_area_end {
    vec3 middle, outward, across;
    float radius, angle, height;
};

/* Returns the end on this side of the axis, 1 or -1. */
lmp_area_end lmp_area_find_end(lmp_area area, float side) {
    float at = area.along + side * area.half_axis, d2 = at * at + area.height * area.height;
    float d = sqrt(d2), nearer = area.radius * area.radius / d2, sine = area.radius / area.height;
    lmp_area_end end;
    end.middle = (side * area.half_axis - at * nearer) * area.normal - (area.height * nearer) * area.x;
    end.outward = side / d * (area.height * area.normal - at * area.x);
    end.across = side * area.y;
    end.radius = area.radius * sqrt(1.0 - nearer);
    end.angle = lmp_area_angle(sqrt(1.0 - sine * sine), sine * side * at / d);
    end.height = d * (1.0 - nearer);
    return end;
}

/* Sees the line of a tube's axis. */
void lmp_area_see_tube(vec3 half_axis, inout lmp_area area) {
    area.half_axis = sqrt(dot(half_axis, half_axis));
    area.normal = half_axis / max(area.half_axis, 1e-30);
    area.along = dot(area.center, area.normal);
    vec3 to_axis = area.center - area.along * area.normal;
    to_axis -= dot(to_axis, area.normal) * area.normal; /* what rounding has left of the axis */
    area.height = sqrt(dot(to_axis, to_axis));
    area.x = to_axis / max(area.height, 1e-30);
    area.y = cross(area.normal, area.x);
    if (area.height > area.radius) {
        float first = lmp_area_find_end(area, 1.0).angle, second = lmp_area_find_end(area, -1.0).angle;
        area.end_edges = 3 + int(float(LMP_AREA_EDGES - 6) * first / (first + second) + 0.5);
    }
}

/* Finds radii of a disk, the first to the nearest point of the rim. Vertices are closer there, so
 * that edges look equally long; less close, because the rim is also seen along itself. */
void lmp_area_see_disk(inout lmp_area area) {
    vec3 beside = -area.center - dot(-area.center, area.normal) * area.normal;
    if (!(dot(beside, beside) > 0.0))
        beside = cross(area.normal, abs(area.normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    area.x = normalize(beside);
    area.y = cross(area.normal, area.x);
    vec3 near = area.center + area.radius * area.x, far = area.center - area.radius * area.x;
    area.crowded = clamp(sqrt(sqrt(dot(near, near) / dot(far, far))), 0.01, 1.0);
}

lmp_area lmp_area_see(int i, vec3 viewer) {
    vec4 first = lmp_area_texel(i, 0), third = lmp_area_texel(i, 2);
    lmp_area area;
    area.center = first.xyz - viewer;
    area.distance = sqrt(dot(area.center, area.center));
    area.shape = int(abs(first.w));
    area.side = 1.0;
    area.extent = lmp_area_texel(i, 1).w;
    area.radius = third.w;
    area.normal = third.xyz;
    if (area.shape == LMP_AREA_TUBE) {
        lmp_area_see_tube(third.xyz, area);
        return area;
    }
    float above = -dot(area.normal, area.center);
    area.side = above < 0.0 ? -1.0 : 1.0;
    area.height = first.w < 0.0 ? abs(above) : max(above, 0.0);
    if (area.shape == LMP_AREA_DISK)
        lmp_area_see_disk(area);
    return area;
}

/* Whether a tube is seen as a sphere, from inside it or beyond an end, and that sphere, the nearest
 * one, from the point. */
bool lmp_area_is_sphere(lmp_area area) {
    return area.shape == LMP_AREA_TUBE && !(area.height > area.radius && area.half_axis > 0.0);
}
vec4 lmp_area_sphere(lmp_area area) {
    float nearest = clamp(0.0, area.along - area.half_axis, area.along + area.half_axis);
    return vec4(area.center + (nearest - area.along) * area.normal, area.radius);
}

/* Returns a direction whose opposite is neither seen nor nearly seen. */
vec3 lmp_area_inner(lmp_area area) {
    if (area.shape == LMP_AREA_TUBE)
        return normalize(lmp_area_sphere(area).xyz);
    return area.height < 0.5 * area.distance ? -area.side * area.normal : area.center / area.distance;
}

/* --- the outline ------------------------------------------------------------------------------ */

/* Vertices are counter-clockwise around the normal, edges go backwards. All are given from the
 * area's center. */
int lmp_area_edges(lmp_area area) {
    return area.shape == LMP_AREA_DISK   ? LMP_AREA_EDGES
           : area.shape == LMP_AREA_TUBE ? LMP_AREA_EDGES + 2
                                         : area.shape;
}

/* Vertices of curves lie so far out that the polygon is as large as what it stands for. */
vec3 lmp_area_disk_vertex(lmp_area area, int k) {
    float each = 2.0 * LMP_PI / float(LMP_AREA_EDGES);
    vec2 halved = lmp_area_direction(0.5 * (each * float(k) - LMP_PI)) * vec2(1.0, area.crowded);
    float per = 1.0 / dot(halved, halved), arc = each * area.crowded * per, arc2 = arc * arc;
    vec2 at = vec2(halved.x * halved.x - halved.y * halved.y, 2.0 * halved.x * halved.y);
    float out_by = 1.0 + arc2 / 12.0 + arc2 * arc2 / 160.0;
    return area.radius * out_by * per * (at.x * area.x + at.y * area.y);
}
/* The sides go on, as tangents of an end, from where they touch it to its first and last vertex. If
 * each edge between these spans 1 + sqrt(3) times the angle of such a piece, a piece and the edge
 * beside it cover as much as the circle does there; 2.8 times leaves the least errors of lobes. */
vec3 lmp_area_tube_vertex(lmp_area area, int k) {
    bool second = k > area.end_edges;
    lmp_area_end end = lmp_area_find_end(area, second ? -1.0 : 1.0);
    int at = second ? k - area.end_edges - 1 : k;
    int edges = second ? LMP_AREA_EDGES - area.end_edges : area.end_edges;
    float count = float(edges), piece = end.angle / (1.0 + 1.4 * count), outer = end.angle - piece;
    float each = max(2.0 * outer / count, 1e-4);
    vec2 touching = lmp_area_direction(piece);
    float first = 1.0 / touching.x, out_by = first;
    if (at > 0 && at < edges) {
        float left = count * each - 2.0 * (touching.y * first - piece);
        left *= (count - 2.0) / lmp_area_direction(each).y;
        out_by = (sqrt(first * first + left) - first) / (count - 2.0);
    }
    vec2 w = lmp_area_direction(outer * (float(2 * at) / count - 1.0));
    return end.middle + end.radius * out_by * (w.x * end.outward + w.y * end.across);
}
vec3 lmp_area_vertex(int i, lmp_area area, int k) {
    if (area.shape == LMP_AREA_DISK)
        return lmp_area_disk_vertex(area, k);
    if (area.shape == LMP_AREA_TUBE)
        return lmp_area_tube_vertex(area, k);
    return lmp_area_texel(i, 3 + k).xyz;
}

/* --- irradiance ------------------------------------------------------------------------------- */

/* A point of the outline: from the center, from the viewer, and how far its direction is from the
 * center's, which keeps its digits however small the area. */
struct lmp_area_point {
    vec3 from_center, position, offset;
};
lmp_area_point lmp_area_make_point(lmp_area area, vec3 from_center) {
    lmp_area_point p;
    p.from_center = from_center;
    p.position = area.center + from_center;
    float d = sqrt(dot(p.position, p.position));
    float farther = dot(from_center, area.center + p.position) / (d + area.distance);
    p.offset = (from_center - area.center * (farther / area.distance)) / d;
    return p;
}

/* Returns n · ∫ w × dw along the arc from a to b, but for what is 0 around a loop: that along the
 * chord, from the offsets, and twice what lies between the two. */
float lmp_area_arc(vec3 n, lmp_area_point a, lmp_area_point b) {
    vec3 pole = cross(a.position, b.from_center - a.from_center);
    float across = sqrt(dot(pole, pole)), angle = lmp_area_angle(across, dot(a.position, b.position));
    float square = angle * angle, less_sine = angle - lmp_area_direction(angle).y;
    if (angle < 0.5)
        less_sine = angle * square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
    return dot(n, cross(a.offset, b.offset)) + dot(n, pole) / max(across, 1e-30) * less_sine;
}

/* Returns that along the horizon, where a half turn stays one if rounding says that it goes back. */
float lmp_area_horizon_arc(vec3 n, float side, lmp_area_point a, lmp_area_point b) {
    float along = dot(a.position, b.position), across = dot(n, cross(a.position, b.position));
    if (along < 0.0 && abs(across) < -1e-5 * along)
        return dot(n, cross(a.offset, b.offset)) + side * LMP_PI;
    return lmp_area_arc(n, a, b);
}

/* Returns the irradiance by what the horizon leaves of the outline: the arcs above it, and those
 * along it from where one ends to where the next begins. */
float lmp_area_outline_irradiance(int i, lmp_area area, vec3 normal) {
    lmp_area_point from = lmp_area_make_point(area, lmp_area_vertex(i, area, 0)), first = from, last = from;
    float sum = 0.0, above = dot(normal, from.position);
    bool hidden = false, begun = false;
    for (int k = lmp_area_edges(area) - 1; k >= 0; k--) {
        lmp_area_point to = lmp_area_make_point(area, lmp_area_vertex(i, area, k)), a = from, b = to;
        float next = dot(normal, to.position);
        if ((above > 0.0) != (next > 0.0)) {
            vec3 cut = mix(from.from_center, to.from_center, above / (above - next));
            lmp_area_point crossing = lmp_area_make_point(area, cut);
            if (next > 0.0) {
                a = crossing;
                if (hidden)
                    sum += lmp_area_horizon_arc(normal, area.side, last, crossing);
                else
                    first = crossing;
                begun = begun || !hidden;
            } else {
                b = crossing;
                last = crossing;
            }
            hidden = !(next > 0.0);
        }
        if (above > 0.0 || next > 0.0)
            sum += lmp_area_arc(normal, a, b);
        from = to;
        above = next;
    }
    if (hidden && begun)
        sum += lmp_area_horizon_arc(normal, area.side, last, first);
    return max(0.5 * area.side * sum, 0.0);
}

/* Returns the irradiance at a point under an area of radiance 1. */
float lmp_area_irradiance(int i, vec3 from, vec3 normal) {
    lmp_area area = lmp_area_see(i, from);
    if (lmp_area_is_sphere(area))
        return lmp_cap_irradiance(lmp_cap_of_sphere(lmp_area_sphere(area), vec3(0.0)), normal);
    return area.height > 0.0 ? lmp_area_outline_irradiance(i, area, normal) : 0.0;
}

/* --- nodes ------------------------------------------------------------------------------------ */

/* A node stands for a part of an area: where it is from the area's center, and the solid angle of
 * the part times the cube of its distance. */
struct lmp_area_node {
    vec3 from_center;
    float weight;
};

/* Returns node k of Gauss's rule of 2, 3 or 4, and its weight. */
vec2 lmp_area_gauss(int count, int k) {
    float side = 2 * k + 1 < count ? -1.0 : 1.0;
    if (count == 2)
        return vec2(side * 0.5773502692, 1.0);
    if (count == 3)
        return k == 1 ? vec2(0.0, 0.8888888889) : vec2(side * 0.7745966692, 0.5555555556);
    return k == 0 || k == 3 ? vec2(side * 0.8611363116, 0.3478548451)
                            : vec2(side * 0.3399810436, 0.6521451549);
}

/* The parts of an area: quadrangles of a polygon; a disk; the side of a tube and its ends. */
int lmp_area_parts(lmp_area area) {
    return area.shape == LMP_AREA_DISK   ? 1
           : area.shape == LMP_AREA_TUBE ? 3
                                         : (area.shape - 1) / 2;
}

/* Quadrangle `part` of the fan around the first corner, the last of which may be a triangle. */
lmp_area_node lmp_area_quadrangle_node(int i, lmp_area area, int part, vec2 u, vec2 v) {
    vec3 a = lmp_area_texel(i, 3).xyz, b = lmp_area_texel(i, 2 * part + 4).xyz;
    vec3 c = lmp_area_texel(i, 2 * part + 5).xyz;
    vec3 d = lmp_area_texel(i, min(2 * part + 6, area.shape + 2)).xyz;
    float s = 0.5 + 0.5 * u.x, t = 0.5 + 0.5 * v.x;
    vec3 low = mix(a, b, s), high = mix(d, c, s), along = mix(b - a, c - d, t);
    lmp_area_node node;
    node.from_center = mix(low, high, t);
    node.weight = 0.25 * u.y * v.y * area.height * dot(area.normal, cross(along, high - low));
    return node;
}

/* The rectangle between the lines where planes through the viewer touch a tube. */
lmp_area_node lmp_area_side_node(lmp_area area, vec2 u, vec2 v) {
    float sine = area.radius / area.height, cosine = sqrt(1.0 - sine * sine);
    float width = area.radius * cosine;
    lmp_area_node node;
    node.from_center =
        u.x * area.half_axis * area.normal - area.radius * sine * area.x + v.x * width * area.y;
    node.weight = u.y * v.y * area.half_axis * width * area.height * cosine * cosine;
    return node;
}

/* The part of a circle up to an angle from its middle, or all of it, by a rule for the weight sin². */
lmp_area_node lmp_area_circle_node(lmp_area_end circle, int rows, int k, vec2 v) {
    vec2 u = lmp_area_gauss(rows, k);
    float angle = 0.5 * circle.angle * (1.0 + u.x), each = 0.5 * circle.angle * u.y;
    if (circle.angle > 3.1) {
        angle = circle.angle * float(k + 1) / float(rows + 1);
        each = circle.angle / float(rows + 1);
    }
    vec2 w = lmp_area_direction(angle);
    lmp_area_node node;
    node.from_center = circle.middle + circle.radius * (w.x * circle.outward + w.y * v.x * circle.across);
    node.weight = circle.radius * circle.radius * circle.height * w.y * w.y * each * v.y;
    return node;
}

lmp_area_end lmp_area_disk_circle(lmp_area area) {
    lmp_area_end circle;
    circle.middle = vec3(0.0);
    circle.outward = area.x;
    circle.across = area.y;
    circle.radius = area.radius;
    circle.angle = LMP_PI;
    circle.height = area.height;
    return circle;
}

/* Returns node k of a part, of rows * order. */
lmp_area_node lmp_area_make_node(int i, lmp_area area, int part, int rows, int order, int k) {
    int row = k / order;
    vec2 v = lmp_area_gauss(order, k - row * order);
    if (area.shape == LMP_AREA_DISK)
        return lmp_area_circle_node(lmp_area_disk_circle(area), rows, row, v);
    if (area.shape != LMP_AREA_TUBE)
        return lmp_area_quadrangle_node(i, area, part, lmp_area_gauss(rows, row), v);
    if (part == 0)
        return lmp_area_side_node(area, lmp_area_gauss(rows, row), v);
    return lmp_area_circle_node(lmp_area_find_end(area, part == 1 ? 1.0 : -1.0), rows, row, v);
}

/* --- lobes ------------------------------------------------------------------------------------ */

/* What a surface gets of an area of radiance 1: the irradiance, and the responses of lobes. */
struct lmp_area_light {
    float irradiance;
    LMP_EACH lobes;
};

/* Returns the sum over order² nodes of each part or, at order 1, the sphere of a tube. */
lmp_area_light lmp_area_by_nodes(int i, lmp_area area, int order, lmp_surface surface, LMP_EACH_VEC3 axis,
                                 in LMP_EACH weights[LMP_BANDS]) {
    vec3 toward = vec3(0.0);
    lmp_area_light light;
    light.irradiance = 0.0;
    light.lobes = LMP_EACH(0.0);
    for (int part = 0; part < (order > 1 ? lmp_area_parts(area) : 1); part++) {
        int rows = order > 1 && area.shape == LMP_AREA_TUBE && part > 0 ? 4 : order;
        for (int k = 0; k < rows * order; k++) {
            lmp_cap cap;
            if (order > 1) {
                lmp_area_node node = lmp_area_make_node(i, area, part, rows, order, k);
                vec3 p = area.center + node.from_center;
                float d2 = dot(p, p), d = sqrt(d2);
                cap.axis = p / d;
                cap.one_minus_cos = 0.0;
                cap.base = cap.strength = node.weight / (LMP_PI * d * d2);
                toward += LMP_PI * cap.strength * cap.axis;
            } else {
                cap = lmp_cap_of_sphere(lmp_area_sphere(area), vec3(0.0));
                light.irradiance = lmp_cap_irradiance(cap, surface.normal);
            }
            light.lobes += lmp_cap_response(cap, axis, weights);
        }
    }
    light.irradiance += max(dot(surface.normal, toward), 0.0);
    return light;
}

/* Returns the responses by the recurrence along edges of Wang and Ramamoorthi (2018): I_l = ∫ P_l ds
 * and D_l = ∫ P'_l ds along an edge, for z(s) = axis · w(s) between the ends, where z and dz/ds are
 * known. All is monic, as in lmp_cap_response. */
LMP_EACH lmp_area_by_edges(int i, lmp_area area, LMP_EACH_VEC3 axis, in LMP_EACH weights[LMP_BANDS]) {
    LMP_EACH sum = LMP_EACH(0.0);
    float solid_angle = 0.0;
    vec3 inner = lmp_area_inner(area), from_center = lmp_area_vertex(i, area, 0);
    vec3 from = area.center + from_center;
    for (int k = lmp_area_edges(area) - 1; k >= 0; k--) {
        vec3 to_center = lmp_area_vertex(i, area, k), to = area.center + to_center;
        vec3 pole = cross(from, to_center - from_center), a = normalize(from), b = normalize(to);
        float across = sqrt(dot(pole, pole)), lengths = sqrt(dot(from, from) * dot(to, to));
        solid_angle += 2.0 * lmp_area_angle(dot(inner, pole) / lengths,
                                            1.0 + dot(a, b) + dot(a, inner) + dot(b, inner));
        pole /= max(across, 1e-30);
        LMP_EACH outward = LMP_DOT(pole, axis), outward2 = outward * outward;
        LMP_EACH z = LMP_DOT(a, axis), slope = LMP_DOT(cross(pole, a), axis);
        LMP_EACH y = LMP_DOT(b, axis), slope2 = LMP_DOT(cross(pole, b), axis);
        /* P_l at both ends, p and q, I_l and D_l; with 0 those of l - 1 */
        LMP_EACH p0 = LMP_EACH(1.0), p = z, q0 = LMP_EACH(1.0), q = y, next;
        LMP_EACH I0 = LMP_EACH(lmp_area_angle(across, dot(from, to))), I = slope - slope2;
        LMP_EACH D0 = LMP_EACH(0.0), D = I0, g = LMP_EACH(0.0);
        if (LMP_BANDS > 1)
            g = 0.5 * weights[LMP_BAND(1)] * D;
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        next = float((l - 1) * (l - 1) * (l - 1)) / float((2 * l - 3) * (2 * l - 1) * l) * I0 -    \
               1.0 / float(l) * (q * slope2 - p * slope + outward2 * D);                           \
        D0 = float((l - 1) * l) / float((2 * l - 3) * (2 * l - 1)) * D0 + float(l) * I;            \
        I0 = I;                                                                                    \
        I = next;                                                                                  \
        next = D0;                                                                                 \
        D0 = D;                                                                                    \
        D = next;                                                                                  \
        next = z * p - float((l - 1) * (l - 1)) / float((2 * l - 1) * (2 * l - 3)) * p0;           \
        p0 = p;                                                                                    \
        p = next;                                                                                  \
        next = y * q - float((l - 1) * (l - 1)) / float((2 * l - 1) * (2 * l - 3)) * q0;           \
        q0 = q;                                                                                    \
        q = next;                                                                                  \
        g += 1.0 / float(l * (l + 1)) * weights[LMP_BAND(l)] * D;                                  \
    }
        LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
        sum += outward * g;
        from_center = to_center;
        from = to;
    }
    return area.side / LMP_PI * (solid_angle * weights[0] + sum);
}

/* Returns what a surface gets of area i, the lobes around these axes having weights by
 * lmp_lobe_weigh. The size decides how: an error of 1e-4 is at most where it does. */
lmp_area_light lmp_area_respond(int i, lmp_surface surface, LMP_EACH_VEC3 axis,
                                in LMP_EACH weights[LMP_BANDS]) {
    lmp_area area = lmp_area_see(i, surface.position);
    lmp_area_light light;
    light.irradiance = 0.0;
    light.lobes = LMP_EACH(0.0);
    bool is_sphere = lmp_area_is_sphere(area);
    if (!is_sphere && !(area.height > 0.0))
        return light;
    float size = float(LMP_BANDS + 8) * area.extent / area.distance;
    bool large = !is_sphere && size > (area.shape == LMP_AREA_DISK ? 3.0 : 4.5);
    if (large)
        light.lobes = lmp_area_by_edges(i, area, axis, weights);
    else
        light = lmp_area_by_nodes(i, area, is_sphere ? 1 : size < 0.65 ? 2 : size < 2.2 ? 3 : 4, surface,
                                  axis, weights);
    if (large || (!is_sphere && abs(dot(surface.normal, area.center)) < area.extent))
        light.irradiance = lmp_area_outline_irradiance(i, area, surface.normal);
    return light;
}

/* Adds up all areas for lmp_shade_zonal. */
vec3 lmp_areas_shade(lmp_surface surface, lmp_lobes lobes, in LMP_EACH weights[LMP_BANDS]) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < lmp_area_count(); i++) {
        lmp_area_light light = lmp_area_respond(i, surface, lobes.axis, weights);
        sum += lmp_area_texel(i, 1).rgb *
               (lobes.diffuse * (light.irradiance / LMP_PI) + LMP_SUM(lobes.weight, light.lobes));
    }
    return sum;
}

#endif
