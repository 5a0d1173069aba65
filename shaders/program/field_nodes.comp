/* SPDX-License-Identifier: MIT */
/* field_nodes.comp - a field's nodes as the library computes them (lmp_field_coarser_level): those of the
 * coarser field interpolated, with what the lights near them add.
 *
 * A group computes the nodes of one block of the coarser field, which share a list of lights; a
 * thread computes the coefficients m and -m of SHARED_FIELD_BANDS bands of a node, from `low` on,
 * so that one program serves all numbers of bands. */
#include "shared.h"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(std430, binding = SHARED_FIELD_NODES) restrict buffer field_nodes_block {
    vec4 field_nodes[];
};
layout(std430, binding = SHARED_FIELD) readonly restrict buffer field_block {
    shared_field field;
};
layout(std430, binding = SHARED_FIELD_COARSER_NODES) readonly restrict buffer coarser_nodes_block {
    vec4 coarser_nodes[];
};
layout(std430, binding = SHARED_FIELD_COARSER) readonly restrict buffer coarser_block {
    shared_field coarser;
    uint coarser_lists[];
};
layout(location = 0) uniform int bands;
layout(location = 1) uniform bool coarsest; /* there is no coarser field, so all lights count */
layout(location = 2) uniform int first;     /* the first of LIGHTS lights that this dispatch takes */

const float pi = 3.14159265;

int node_index(int l, int m) {
    return l * l + l + m;
}

/* Returns how many threads share the bands of a column. */
int node_parts(int m) {
    return (bands - m + SHARED_FIELD_BANDS - 1) / SHARED_FIELD_BANDS;
}

/* --- coefficients ----------------------------------------------------------------------------- */

#define NODE_EACH(X) X(0) X(1) X(2) X(3)

/* Sums per band: a column per color, with its value and derivatives by x, y, z. */
struct node_sums {
    mat3x4 cosine[SHARED_FIELD_BANDS], sine[SHARED_FIELD_BANDS]; /* coefficients m, and -m */
};

/* Returns the factor of Y_lm, which is this factor times a polynomial of z that begins with z^(l -
 * m), and the real or, for -m, the imaginary part of (x + iy)^m. */
float node_norm(int l, int m) {
    float square = 0.25 / pi;
    for (int k = 1; k <= l; k++)
        square *= k <= m ? float(2 * k + 1) / float(2 * k) * (k == 1 ? 2.0 : 1.0)
                         : float(4 * k * k - 1) / float(k * k - m * m);
    return m % 2 == 0 ? sqrt(square) : -sqrt(square);
}

/* A sphere that does not contain the point, or a Dirac, of color 1, in a band l of column m: as in
 * src/kernels/gradient_tmpl.h, R_l and P_l(alpha) are computed by their differences. */
struct node_light {
    vec3 w;    /* direction to the center */
    float t;   /* 1 - alpha */
    float base; /* 2 pi t */
    vec3 size; /* pi sin²a; that divided by the distance; twice that divided by alpha */
    vec2 fade; /* how much of it the field holds, and the derivative of that by the distance */
    float c, s, c_before, s_before;             /* parts of (x + iy)^m, and of the power before */
    float q, q_before, slope, slope_before;     /* the polynomial and its derivative, and before */
    float R, R_step, P, P_step;
};

/* Begins a light in band 0 of column 0. A negative r means a Dirac, with pi sin²a = 1/d². */
node_light node_light_at(vec3 v, float d, float r, vec2 fade) {
    float held = max(r, 0.0), e = sqrt((d - held) * (d + held)), inverse = 1.0 / (d * (d + e));
    float per_d = (d + e) * inverse, t = held * held * inverse;
    float strength = (r < 0.0 ? 1.0 : pi * held * held) * per_d * per_d, across = strength * per_d;
    vec3 size = vec3(strength, across, 2.0 * across / max(e * per_d, COS_MIN));
    return node_light(v * per_d, t, r < 0.0 ? strength : 2.0 * pi * t, size, fade, 1.0, 0.0, 0.0,
                      0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0);
}

/* Advances from band k - 1 to k and, on the way to column m, to column k. */
void node_step(int k, int m, inout node_light a) {
    if (k <= m) {
        a.c_before = a.c;
        a.s_before = a.s;
        a.c = a.w.x * a.c_before - a.w.y * a.s_before;
        a.s = a.w.x * a.s_before + a.w.y * a.c_before;
    } else {
        float b = float((k - 1) * (k - 1) - m * m) / float(4 * (k - 1) * (k - 1) - 1);
        float q = a.w.z * a.q - b * a.q_before, slope = a.q + a.w.z * a.slope - b * a.slope_before;
        a.q_before = a.q;
        a.q = q;
        a.slope_before = a.slope;
        a.slope = slope;
    }
    if (k > 1)
        a.R_step = (float(k - 2) * a.R_step - float(2 * k - 1) * a.t * a.R) / float(k + 1);
    a.P_step = (float(k - 1) * a.P_step - float(2 * k - 1) * a.t * a.P) / float(k);
    a.R += a.R_step;
    a.P += a.P_step;
}

void node_take(int l, int m, float norm, node_light a, vec3 color, inout mat3x4 cosine,
               inout mat3x4 sine) {
    float q = norm * a.q, value = l == 0 ? a.base : a.size.x * a.R;
    float across = l == 0 ? 0.0 : a.fade.x * a.size.y * a.R;
    float along = a.fade.x * a.size.z * a.P - a.fade.y * value;
    float around = float(m) * across * q, tilt = across * norm * a.slope;
    along = along * q + around + a.w.z * tilt;
    value *= a.fade.x * q;
    vec3 by = vec3(a.w.xy * along, a.w.z * along - tilt);
    cosine += outerProduct(vec4(value * a.c, by.x * a.c - around * a.c_before,
                                by.y * a.c + around * a.s_before, by.z * a.c), color);
    if (m > 0)
        sine += outerProduct(vec4(value * a.s, by.x * a.s - around * a.s_before,
                                  by.y * a.s - around * a.c_before, by.z * a.s), color);
}

/* --- lights ----------------------------------------------------------------------------------- */

/* Returns f, less that of the coarser field, and its derivative: 0 from inside a sphere, and for
 * lights that do not fade. */
vec2 node_fade(int light, float d) {
    vec2 per_reach = vec2(field.origin.w, coarsest ? 0.0 : coarser.origin.w);
    vec2 t = clamp((d - max(lights[light].sphere.w, 0.0)) * per_reach, 0.0, 1.0), u = t * t, rest = 1.0 - u;
    vec2 value = u * u * (6.0 - u * (8.0 - 3.0 * u)), slope = 24.0 * per_reach * t * u * rest * rest;
    if (lights[light].radiance.w > float(SHARED_LIGHT_HIDDEN))
        return vec2(0.0);
    return vec2(value.x - value.y, slope.x - slope.y);
}

void node_add(int light, vec3 at, int low, int m, vec4 norm, inout node_sums sums) {
    vec4 sphere = lights[light].sphere;
    vec3 v = sphere.xyz - at, color = lights[light].radiance.rgb;
    float d = length(v);
    vec2 fade = node_fade(light, d);
    if (fade == vec2(0.0))
        return;
    node_light a = node_light_at(v, d, sphere.w, fade);
    for (int k = 1; k <= low; k++)
        node_step(k, m, a);
#define NODE_BAND(i)                                                                               \
    if (low + i < bands) {                                                                         \
        if (i > 0)                                                                                 \
            node_step(low + i, m, a);                                                              \
        node_take(low + i, m, norm[i], a, color, sums.cosine[i], sums.sine[i]);                    \
    }
    NODE_EACH(NODE_BAND)
#undef NODE_BAND
}

/* The positions of lights in the lists: those of the block, those near everywhere, and how many in
 * all. */
struct node_lights {
    ivec2 own, everywhere;
    int count;
};

ivec2 node_list(int list, int lists) {
    int begin = int(coarser_lists[list]);
    return ivec2(lists + 1 + begin, int(coarser_lists[list + 1]) - begin);
}

node_lights node_find(ivec3 block) {
    if (coarsest)
        return node_lights(ivec2(0), ivec2(0), int(field.per_cell.w));
    ivec3 blocks = ivec3(coarser.nodes.xyz) / 2;
    int count = blocks.x * blocks.y * blocks.z;
    ivec2 own = node_list((block.z * blocks.y + block.y) * blocks.x + block.x, count + 1);
    ivec2 everywhere = node_list(count, count + 1);
    return node_lights(own, everywhere, own.y + everywhere.y);
}

int node_listed(node_lights near, int i) {
    if (coarsest)
        return i;
    return int(coarser_lists[i < near.own.y ? near.own.x + i : near.everywhere.x + i - near.own.y]);
}

/* --- the coarser field ------------------------------------------------------------------------ */

/* Along an axis, what a corner of a cell contributes to Adini's polynomial (field.glsl): its linear
 * weight, its bend and the weight of its slope, and the derivatives of these. */
struct node_axis {
    vec3 value, slope;
};

node_axis node_along(float s, float h, bool far) {
    float rest = 1.0 - s, bend = s * s * (3.0 - 2.0 * s) - s, steep = (6.0 * s * rest - 1.0) / h;
    if (far)
        return node_axis(vec3(s, bend, -h * s * s * rest),
                         vec3(1.0 / h, steep, s * (3.0 * s - 2.0)));
    return node_axis(vec3(rest, -bend, h * s * rest * rest),
                     vec3(-1.0 / h, -steep, rest * (1.0 - 3.0 * s)));
}

/* Returns the weights of a corner's value and derivatives. */
vec4 node_weight(vec3 x, vec3 y, vec3 z) {
    vec3 others = vec3(y.x * z.x, x.x * z.x, x.x * y.x);
    return vec4(x.x * others.x + dot(vec3(x.y, y.y, z.y), others), vec3(x.z, y.z, z.z) * others);
}

mat3x4 node_read(int at, mat4 weights) {
    int count = bands * bands;
    return mat3x4(coarser_nodes[at] * weights, coarser_nodes[at + count] * weights,
                  coarser_nodes[at + 2 * count] * weights);
}

/* Interpolates a node, which lies on a coarser node, or in the middle between some. */
void node_interpolate(ivec3 node, int low, int m, inout node_sums sums) {
    ivec3 size = ivec3(coarser.nodes.xyz), middle = node & 1;
    vec3 s = 0.5 * vec3(middle);
    for (int k = 0; k < (middle == ivec3(0) ? 1 : 8); k++) {
        ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
        node_axis x = node_along(s.x, coarser.cell.x, corner.x > 0);
        node_axis y = node_along(s.y, coarser.cell.y, corner.y > 0);
        node_axis z = node_along(s.z, coarser.cell.z, corner.z > 0);
        mat4 weights =
            mat4(node_weight(x.value, y.value, z.value), node_weight(x.slope, y.value, z.value),
                 node_weight(x.value, y.slope, z.value), node_weight(x.value, y.value, z.slope));
        corner += node / 2;
        int at = ((corner.z * size.y + corner.y) * size.x + corner.x) * 3 * bands * bands;
#define NODE_BAND(i)                                                                               \
    if (low + i < bands) {                                                                         \
        sums.cosine[i] += node_read(at + node_index(low + i, m), weights);                         \
        sums.sine[i] += node_read(at + node_index(low + i, -m), weights);                          \
    }
        NODE_EACH(NODE_BAND)
#undef NODE_BAND
    }
}

/* --- a node ----------------------------------------------------------------------------------- */

/* Begins a node without lights, or with what an earlier dispatch has left. */
node_sums node_begin(ivec3 node, int at, int low, int m) {
    node_sums sums;
    int green = bands * bands, blue = 2 * green;
#define NODE_BAND(i) sums.cosine[i] = sums.sine[i] = mat3x4(0.0);
    NODE_EACH(NODE_BAND)
#undef NODE_BAND
    if (first == 0 && !coarsest)
        node_interpolate(node, low, m, sums);
    if (first == 0)
        return sums;
#define NODE_BAND(i)                                                                               \
    if (low + i < bands) {                                                                         \
        int c = at + node_index(low + i, m), s = at + node_index(low + i, -m);                     \
        sums.cosine[i] = mat3x4(field_nodes[c], field_nodes[c + green], field_nodes[c + blue]);    \
        sums.sine[i] = mat3x4(field_nodes[s], field_nodes[s + green], field_nodes[s + blue]);      \
    }
    NODE_EACH(NODE_BAND)
#undef NODE_BAND
    return sums;
}

void node_write(int at, mat3x4 sums) {
    field_nodes[at] = sums[0];
    field_nodes[at + bands * bands] = sums[1];
    field_nodes[at + 2 * bands * bands] = sums[2];
}

void main() {
    int parts = 0, m = 0;
    for (int k = 0; k < bands; k++)
        parts += node_parts(k);
    int part = int(gl_WorkGroupID.x) % parts;
    ivec3 block = ivec3(int(gl_WorkGroupID.x) / parts, gl_WorkGroupID.yz);
    ivec3 node = 4 * block + ivec3(gl_LocalInvocationID), size = ivec3(field.nodes.xyz);
    node_lights near = node_find(block);
    if (any(greaterThanEqual(node, size)) || (first > 0 && first >= near.count))
        return;
    for (; part >= node_parts(m); m++)
        part -= node_parts(m);
    int low = m + SHARED_FIELD_BANDS * part;
    int at = ((node.z * size.y + node.y) * size.x + node.x) * 3 * bands * bands;
    vec3 point = field.origin.xyz + field.cell.xyz * vec3(node);
    vec4 norm;
#define NODE_BAND(i) norm[i] = node_norm(low + i, m);
    NODE_EACH(NODE_BAND)
#undef NODE_BAND
    node_sums sums = node_begin(node, at, low, m);
    for (int i = first; i < min(near.count, first + LIGHTS); i++)
        node_add(node_listed(near, i), point, low, m, norm, sums);
#define NODE_BAND(i)                                                                               \
    if (low + i < bands) {                                                                         \
        node_write(at + node_index(low + i, m), sums.cosine[i]);                                   \
        if (m > 0)                                                                                 \
            node_write(at + node_index(low + i, -m), sums.sine[i]);                                \
    }
    NODE_EACH(NODE_BAND)
#undef NODE_BAND
}
