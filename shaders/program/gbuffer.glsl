/* SPDX-License-Identifier: MIT */
/* gbuffer.glsl - encodes the values of the G-buffer, whose attachments shared.h lists. */
#ifndef LAMPION_GBUFFER_GLSL
#define LAMPION_GBUFFER_GLSL

vec2 gbuffer_sign(vec2 v) {
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec3 gbuffer_encode_color(vec3 c) {
    return sqrt(max(c, vec3(0.0)));
}

vec3 gbuffer_decode_color(vec3 stored) {
    return stored * stored;
}

/* Packs the square roots of a color as three bytes of an integer, which a float32 holds exactly. */
float gbuffer_pack_color(vec3 c) {
    uvec3 root = uvec3(min(gbuffer_encode_color(c), vec3(1.0)) * 255.0 + 0.5);
    return float(root.r | root.g << 8u | root.b << 16u);
}

vec3 gbuffer_unpack_color(float stored) {
    uint bytes = uint(stored);
    vec3 root = vec3(bytes & 255u, bytes >> 8u & 255u, bytes >> 16u) / 255.0;
    return gbuffer_decode_color(root);
}

/* Encodes a unit vector octahedrally (Cigolle et al. 2014), in 0 … 1. */
vec2 gbuffer_encode_normal(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0)
        p = (1.0 - abs(p.yx)) * gbuffer_sign(p);
    return p * 0.5 + 0.5;
}

vec3 gbuffer_decode_normal(vec2 stored) {
    vec2 p = stored * 2.0 - 1.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * gbuffer_sign(n.xy);
    return normalize(n);
}

float gbuffer_encode_kind(int kind) {
    return float(kind) / 65535.0;
}

int gbuffer_decode_kind(float stored) {
    return int(stored * 65535.0 + 0.5);
}

float gbuffer_encode_light(int index) {
    return float(index) / 65535.0;
}

int gbuffer_decode_light(float stored) {
    return int(stored * 65535.0 + 0.5);
}

#endif
