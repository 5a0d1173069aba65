/* SPDX-License-Identifier: MIT */
/* field.glsl - surfaces under a field (lampion/field.h): the coefficients of all lights come from
 * the eight nodes around a point by Adini's polynomial, and the lights near it are summed exactly,
 * by the fraction that the field does not hold there. Its macros are those of sums of coefficients.
 */
#include "texels.glsl"

/* as lmp_field_copy_nodes: the value of a coefficient and its slopes */
TEXELS(field_nodes_block, field_nodes, SHARED_FIELD_NODES)
layout(std430, binding = SHARED_FIELD) readonly restrict buffer field_block {
    shared_field field;
    uint field_lists[]; /* as lmp_field_copy_lists: where each list begins, then the lights */
};

/* Where the point last looked up lies; at a point outside the grid every light is summed. */
bool field_inside = false;
ivec3 field_cell;
vec3 field_fraction;
ivec2 field_own, field_all; /* first and count in field_lists: near its cell, near everywhere */

ivec2 field_list(int list, int lists) {
    int first = int(field_lists[list]);
    return ivec2(lists + 1 + first, int(field_lists[list + 1]) - first);
}

void field_find(vec3 point) {
    vec3 at = (point - field.origin.xyz) * field.per_cell.xyz;
    ivec3 nodes = ivec3(field.nodes.xyz), blocks = nodes / 2;
    field_inside = all(greaterThanEqual(at, vec3(0.0))) && all(lessThanEqual(at, vec3(nodes - 1)));
    if (!field_inside)
        return;
    field_cell = min(ivec3(at), nodes - 2);
    field_fraction = at - vec3(field_cell);
    ivec3 block = field_cell / 2;
    int count = blocks.x * blocks.y * blocks.z;
    field_own = field_list((block.z * blocks.y + block.y) * blocks.x + block.x, count + 1);
    field_all = field_list(count, count + 1);
}

int field_light_count() {
    return field_inside ? field_own.y + field_all.y : int(size_lights.z);
}

int field_light(int i) {
    if (!field_inside)
        return i;
    return int(field_lists[i < field_own.y ? field_own.x + i : field_all.x + i - field_own.y]);
}

/* Returns what the field does not hold of a light, 1 - f with f = u² (6 - 8 u + 3 u²), u = t²; only
 * spheres and points fade. */
float field_residual(int light, vec3 point) {
    vec4 sphere = lights[light].sphere;
    if (!field_inside || lights[light].radiance.w > float(SHARED_LIGHT_HIDDEN))
        return 1.0;
    float t = clamp((length(sphere.xyz - point) - max(sphere.w, 0.0)) * field.origin.w, 0.0, 1.0);
    float v = 1.0 - t * t;
    return v * v * v * (1.0 + 3.0 * t * t);
}

/* --- far lights ------------------------------------------------------------------------------- */

/* Per axis the linear weights of Adini's polynomial, their bends, and the weights of the slopes. */
struct field_axes {
    vec3 linear, bend, slope;
};

/* Returns the weights on the near side of the cell or, where `far` is set, on the other side. */
field_axes field_side(bvec3 far) {
    vec3 s = field_fraction, rest = 1.0 - s;
    vec3 bend = s * s * (3.0 - 2.0 * s) - s, both = field.cell.xyz * (s * rest);
    return field_axes(mix(rest, s, far), mix(-bend, bend, far), both * mix(rest, -s, far));
}

/* Returns the weights of a corner's value, and of its slopes. */
vec4 field_weight(field_axes a) {
    vec3 others = a.linear.yxx * a.linear.zzy;
    return vec4(a.linear.x * others.x + dot(a.bend, others), a.slope * others);
}

/* The corners of the cell around the point, each by its first texel and its weights. */
struct field_corners {
    int at[8];
    vec4 weight[8];
};

field_corners field_corners_around() {
    field_corners corners;
    ivec3 nodes = ivec3(field.nodes.xyz);
    for (int k = 0; k < 8; k++) {
        bvec3 far = bvec3((k & 1) != 0, (k & 2) != 0, k >= 4);
        ivec3 node = field_cell + ivec3(far);
        corners.at[k] = ((node.z * nodes.y + node.y) * nodes.x + node.x) * (3 * LMP_SH_COUNT);
        corners.weight[k] = field_weight(field_side(far));
    }
    return corners;
}

/* Interpolates a coefficient, for callers that may index at run time. */
vec3 field_coefficient(field_corners corners, int i) {
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 8; k++) {
        int at = corners.at[k] + i;
        sum += vec3(dot(corners.weight[k], TEXEL(field_nodes, at)),
                    dot(corners.weight[k], TEXEL(field_nodes, at + LMP_SH_COUNT)),
                    dot(corners.weight[k], TEXEL(field_nodes, at + 2 * LMP_SH_COUNT)));
    }
    return sum;
}

/* The most bands whose factors are kept for all corners. Those of more bands do not fit into
 * registers: on an H200 7 bands took twice the time of factors computed again at each corner, and
 * 10 bands seven times. */
#define FIELD_KEEPS 6

/* Computes FIELD_FACTOR of each coefficient, what each of its colors adds to what the lobes
 * reflect: Y_lm of the normal and of the lobes' axes, as lmp_sh_eval computes them, times the
 * lobes' factors. */
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        up = sqrt(float(4 * l * l - 1) / float(l == m ? 1 : l * l - m * m));                       \
        down = sqrt(float(l == m ? 0 : (l - 1) * (l - 1) - m * m) /                                \
                    float(l == 0 ? 1 : 4 * (l - 1) * (l - 1) - 1));                                \
        q = l == m ? diagonal : up * (n.z * q1 - down * q2);                                       \
        p = l == m ? LMP_EACH(diagonal) : up * (z * p1 - down * p2);                               \
        q2 = q1;                                                                                   \
        q1 = q;                                                                                    \
        p2 = p1;                                                                                   \
        p1 = p;                                                                                    \
        q *= diffuse[LMP_BAND(l)];                                                                 \
        p *= glossy[LMP_BAND(l)];                                                                  \
        FIELD_FACTOR(LMP_INDEX(l, m), color * (q * c) + LMP_SUM(lobes.weight, p * cs))             \
        if (m > 0) {                                                                               \
            FIELD_FACTOR(LMP_INDEX(l, -m), color * (q * s) + LMP_SUM(lobes.weight, p * ss))        \
        }                                                                                          \
    }
#define LMP_COLUMN(m)                                                                              \
    if (m < LMP_BANDS) {                                                                           \
        q1 = q2 = 0.0;                                                                             \
        p1 = p2 = LMP_EACH(0.0);                                                                   \
        LMP_FOR_COLUMN(LMP_ROW, m)                                                                 \
        diagonal *= m == 0 ? -sqrt(3.0) : -sqrt(float(2 * m + 3) / float(2 * m + 2));              \
        t = n.x * c - n.y * s;                                                                     \
        s = n.x * s + n.y * c;                                                                     \
        c = t;                                                                                     \
        ts = x * cs - y * ss;                                                                      \
        ss = x * ss + y * cs;                                                                      \
        cs = ts;                                                                                   \
    }
#define FIELD_FACTORS                                                                              \
    c = 1.0;                                                                                       \
    s = 0.0;                                                                                       \
    cs = LMP_EACH(1.0);                                                                            \
    ss = LMP_EACH(0.0);                                                                            \
    diagonal = sqrt(0.25 / LMP_PI);                                                                \
    LMP_FOR_COLUMNS(LMP_COLUMN)

/* Adds what a coefficient with such factors contributes at a corner, by its value and slopes. */
#define FIELD_ADD(i, factors)                                                                      \
    f = factors;                                                                                   \
    each_red += f.r * TEXEL(field_nodes, red + i);                                                        \
    each_green += f.g * TEXEL(field_nodes, green + i);                                                    \
    each_blue += f.b * TEXEL(field_nodes, blue + i);

/* Loops over the corners, because straight-line code of all eight takes a driver minutes to
 * compile. */
vec3 field_shade_far(lmp_surface surface, lmp_lobes lobes) {
    float diffuse[LMP_BANDS];
    LMP_EACH glossy[LMP_BANDS];
    lmp_lobe_make_diffuse(diffuse);
    lmp_lobe_make_phong(lobes.exponent, glossy);
    vec3 n = surface.normal, color = lobes.diffuse / LMP_PI, f, sum = vec3(0.0);
    LMP_EACH x = LMP_DOT(vec3(1.0, 0.0, 0.0), lobes.axis);
    LMP_EACH y = LMP_DOT(vec3(0.0, 1.0, 0.0), lobes.axis);
    LMP_EACH z = LMP_DOT(vec3(0.0, 0.0, 1.0), lobes.axis);
    float c, s, diagonal, up, down, q, q1, q2, t;
    LMP_EACH cs, ss, p, p1, p2, ts;
    ivec3 nodes = ivec3(field.nodes.xyz);
#if LMP_BANDS <= FIELD_KEEPS
    vec3 factor[LMP_SH_COUNT];
#define FIELD_FACTOR(i, factors) factor[i] = factors;
    FIELD_FACTORS
#undef FIELD_FACTOR
#undef LMP_COLUMN
#undef LMP_ROW
#endif
    for (int k = 0; k < 8; k++) {
        bvec3 far = bvec3((k & 1) != 0, (k & 2) != 0, k >= 4);
        ivec3 node = field_cell + ivec3(far);
        int red = ((node.z * nodes.y + node.y) * nodes.x + node.x) * (3 * LMP_SH_COUNT);
        int green = red + LMP_SH_COUNT, blue = green + LMP_SH_COUNT;
        vec4 each_red = vec4(0.0), each_green = vec4(0.0), each_blue = vec4(0.0);
#if LMP_BANDS <= FIELD_KEEPS
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        FIELD_ADD(LMP_INDEX(l, m), factor[LMP_INDEX(l, m)])                                        \
        if (m > 0) {                                                                               \
            FIELD_ADD(LMP_INDEX(l, -m), factor[LMP_INDEX(l, -m)])                                  \
        }                                                                                          \
    }
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
        LMP_FOR_COLUMNS(LMP_COLUMN)
#else
#define FIELD_FACTOR(i, factors) FIELD_ADD(i, factors)
        FIELD_FACTORS
#undef FIELD_FACTOR
#endif
        vec4 weight = field_weight(field_side(far));
        sum += vec3(dot(weight, each_red), dot(weight, each_green), dot(weight, each_blue));
    }
    return sum;
}
#undef FIELD_ADD
#undef FIELD_FACTORS
#undef LMP_COLUMN
#undef LMP_ROW

/* --- all lights ------------------------------------------------------------------------------- */

vec3 field_shade_some(lmp_surface surface, lmp_lobes lobes) {
    field_find(surface.position);
    vec3 sum = lmp_shade_some_zonal(surface, lobes);
    return field_inside ? sum + field_shade_far(surface, lobes) : sum;
}

LMP_SHADE_MATERIALS(lmp_shade_field, field_shade_some)
