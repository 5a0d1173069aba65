/* SPDX-License-Identifier: MIT */
/* field_nodes.comp - a field's nodes as the library computes them (lmp_field_coarser): those of the
 * coarser field interpolated, with what the lights near them add.
 *
 * A group is the nodes of one block of the coarser field, which have one list of lights; a thread
 * has the coefficients l, m and l, -m of a node. Nothing is indexed by them but the result, so no
 * array is needed, and one program is for all numbers of bands. */
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
layout(location = 1) uniform bool coarsest; /* there is no coarser field: all lights count */
layout(location = 2) uniform int first;     /* of the lights, LIGHTS of which are taken at once */

const float pi = 3.14159265;

/* --- coefficients ----------------------------------------------------------------------------- */

/* Of one color a column: value and derivatives by x, y, z. */
struct node_sums {
    mat3x4 cosine, sine; /* of m, of -m */
};

/* Y_lm is this factor, a polynomial of z that begins with z^(l - m), and the real or, of -m, the
 * imaginary part of (x + iy)^m. */
float node_norm(int l, int m) {
    float square = 0.25 / pi;
    for (int k = 1; k <= l; k++)
        square *= k <= m ? float(2 * k + 1) / float(2 * k) * (k == 1 ? 2.0 : 1.0)
                         : float(4 * k * k - 1) / float(k * k - m * m);
    return m % 2 == 0 ? sqrt(square) : -sqrt(square);
}

/* What a sphere of radiance 1 has of them at a point outside of it: as src/kernels/gradient.h, by
 * differences of R_l and P_l(alpha). fade: how much of the sphere the field has, and the derivative
 * by the distance. */
void node_project(int l, int m, float norm, vec3 v, float d, float r, vec2 fade, out vec4 cosine,
                  out vec4 sine) {
    float e = sqrt((d - r) * (d + r)), inverse = 1.0 / (d * (d + e)), per_d = (d + e) * inverse;
    float t = r * r * inverse, s2 = r * r * per_d * per_d;
    vec3 w = v * per_d;
    float c = 1.0, s = 0.0, c_before = 0.0, s_before = 0.0;
    float q = 1.0, q_before = 0.0, slope = 0.0, slope_before = 0.0;
    float R = 1.0, R_step = 0.0, P = 1.0, P_step = 0.0;
    for (int k = 1; k <= l; k++) {
        if (k <= m) {
            c_before = c;
            s_before = s;
            c = w.x * c_before - w.y * s_before;
            s = w.x * s_before + w.y * c_before;
        } else {
            float b = float((k - 1) * (k - 1) - m * m) / float(4 * (k - 1) * (k - 1) - 1);
            float q_next = w.z * q - b * q_before;
            float slope_next = q + w.z * slope - b * slope_before;
            q_before = q;
            q = q_next;
            slope_before = slope;
            slope = slope_next;
        }
        if (k > 1)
            R_step = (float(k - 2) * R_step - float(2 * k - 1) * t * R) / float(k + 1);
        P_step = (float(k - 1) * P_step - float(2 * k - 1) * t * P) / float(k);
        R += R_step;
        P += P_step;
    }
    float value = pi * (l == 0 ? 2.0 * t : s2 * R), across = l == 0 ? 0.0 : pi * s2 * per_d * R;
    float along = 2.0 * pi * s2 * per_d / max(e * per_d, COS_MIN) * P;
    along = fade.x * along - fade.y * value;
    value *= fade.x * norm * q;
    across *= fade.x * norm;
    float around = float(m) * across * q, tilt = across * slope;
    along = along * norm * q + around + w.z * tilt;
    float up = w.z * along - tilt;
    cosine = vec4(value * c, w.x * c * along - around * c_before,
                  w.y * c * along + around * s_before, c * up);
    sine = vec4(value * s, w.x * s * along - around * s_before,
                w.y * s * along - around * c_before, s * up);
}

/* --- lights ----------------------------------------------------------------------------------- */

/* f, less that of the coarser field, of the spheres that it does not have whole; 0 is of others. */
vec2 node_fade(int light, float d) {
    vec2 per_reach = vec2(field.origin.w, coarsest ? 0.0 : coarser.origin.w);
    vec2 t = clamp((d - lights[light].sphere.w) * per_reach, 0.0, 1.0), u = t * t, rest = 1.0 - u;
    vec2 value = u * u * (6.0 - u * (8.0 - 3.0 * u)), slope = 24.0 * per_reach * t * u * rest * rest;
    if (lights[light].radiance.w > float(SHARED_LIGHT_HIDDEN) || t.x == 0.0)
        return vec2(0.0);
    return vec2(value.x - value.y, slope.x - slope.y);
}

void node_add(int light, vec3 at, int l, int m, float norm, inout node_sums sums) {
    vec4 sphere = lights[light].sphere;
    vec3 v = sphere.xyz - at, color = lights[light].radiance.rgb;
    float d = length(v);
    vec2 fade = node_fade(light, d);
    vec4 cosine, sine;
    if (fade == vec2(0.0))
        return;
    node_project(l, m, norm, v, d, sphere.w, fade, cosine, sine);
    sums.cosine += outerProduct(cosine, color);
    sums.sine += outerProduct(sine, color);
}

/* Where they are in the lists: those of the block, and those near everywhere; how many in all. */
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

int node_light(node_lights near, int i) {
    if (coarsest)
        return i;
    return int(coarser_lists[i < near.own.y ? near.own.x + i : near.everywhere.x + i - near.own.y]);
}

/* --- the coarser field ------------------------------------------------------------------------ */

/* Along an axis what a corner of a cell has of Adini's polynomial (field.glsl): its linear weight,
 * what bends it and that of its slope, and the derivatives of these. */
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

/* Of the corner's value and derivatives. */
vec4 node_weight(vec3 x, vec3 y, vec3 z) {
    vec3 others = vec3(y.x * z.x, x.x * z.x, x.x * y.x);
    return vec4(x.x * others.x + dot(vec3(x.y, y.y, z.y), others), vec3(x.z, y.z, z.z) * others);
}

mat3x4 node_read(int at, mat4 weights) {
    int count = bands * bands;
    return mat3x4(coarser_nodes[at] * weights, coarser_nodes[at + count] * weights,
                  coarser_nodes[at + 2 * count] * weights);
}

/* A node lies on a coarser one, or in the middle between some. */
node_sums node_interpolate(ivec3 node, int l, int m) {
    node_sums sums = node_sums(mat3x4(0.0), mat3x4(0.0));
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
        int at = ((corner.z * size.y + corner.y) * size.x + corner.x) * 3 * bands * bands + l * l + l;
        sums.cosine += node_read(at + m, weights);
        sums.sine += node_read(at - m, weights);
    }
    return sums;
}

/* --- a node ----------------------------------------------------------------------------------- */

node_sums node_begin(ivec3 node, int at, int l, int m) {
    int count = bands * bands;
    if (first > 0)
        return node_sums(mat3x4(field_nodes[at + m], field_nodes[at + m + count],
                                field_nodes[at + m + 2 * count]),
                         mat3x4(field_nodes[at - m], field_nodes[at - m + count],
                                field_nodes[at - m + 2 * count]));
    if (coarsest)
        return node_sums(mat3x4(0.0), mat3x4(0.0));
    return node_interpolate(node, l, m);
}

void node_end(int at, int m, node_sums sums) {
    for (int c = 0; c < 3; c++) {
        field_nodes[at + m + c * bands * bands] = sums.cosine[c];
        if (m > 0)
            field_nodes[at - m + c * bands * bands] = sums.sine[c];
    }
}

void main() {
    int pairs = bands * (bands + 1) / 2, pair = int(gl_WorkGroupID.x) % pairs, l = 0;
    ivec3 block = ivec3(int(gl_WorkGroupID.x) / pairs, gl_WorkGroupID.yz);
    ivec3 node = 4 * block + ivec3(gl_LocalInvocationID), size = ivec3(field.nodes.xyz);
    node_lights near = node_find(block);
    if (any(greaterThanEqual(node, size)) || (first > 0 && first >= near.count))
        return;
    while ((l + 1) * (l + 2) / 2 <= pair)
        l++;
    int m = pair - l * (l + 1) / 2;
    int at = ((node.z * size.y + node.y) * size.x + node.x) * 3 * bands * bands + l * l + l;
    vec3 point = field.origin.xyz + field.cell.xyz * vec3(node);
    float norm = node_norm(l, m);
    node_sums sums = node_begin(node, at, l, m);
    for (int i = first; i < min(near.count, first + LIGHTS); i++)
        node_add(node_light(near, i), point, l, m, norm, sums);
    node_end(at, m, sums);
}
