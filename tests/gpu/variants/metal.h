/* SPDX-License-Identifier: MIT */
/* metal.h - the part of Metal's language that the Metal variants need, for clang as C++14: its
 * vectors, from clang's own, matrices by columns, and functions. Apple's compiler runs only on
 * Apple's systems. */
#ifndef LAMPION_TESTS_GPU_METAL_H
#define LAMPION_TESTS_GPU_METAL_H

#include <cmath>
#include <cstring>

#define thread
#define constant const

template <int N> using vector = float __attribute__((ext_vector_type(N)));
using float2 = vector<2>;
using float3 = vector<3>;
using float4 = vector<4>;
using int2 = int __attribute__((ext_vector_type(2)));

/* Clang's vectors have no constructors of several values. */
inline float2 make(float2 *, float x, float y) {
    return float2 { x, y };
}
inline float2 make(float2 *, int2 v) {
    return float2 { float(v.x), float(v.y) };
}
inline float3 make(float3 *, float x) {
    return float3 { x, x, x };
}
inline float3 make(float3 *, float x, float y, float z) {
    return float3 { x, y, z };
}
inline float4 make(float4 *, float3 v, float w) {
    return float4 { v.x, v.y, v.z, w };
}
inline int2 make(int2 *, float2 v) {
    return int2 { int(v.x), int(v.y) };
}
#define float2(...) make(static_cast<float2 *>(nullptr), __VA_ARGS__)
#define float3(...) make(static_cast<float3 *>(nullptr), __VA_ARGS__)
#define float4(...) make(static_cast<float4 *>(nullptr), __VA_ARGS__)
#define int2(...)   make(static_cast<int2 *>(nullptr), __VA_ARGS__)

inline float dot(float2 a, float2 b) {
    return a.x * b.x + a.y * b.y;
}
inline float dot(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline float dot(float4 a, float4 b) {
    return dot(a.xyz, b.xyz) + a.w * b.w;
}
inline float3 cross(float3 a, float3 b) {
    return a.yzx * b.zxy - a.zxy * b.yzx;
}
inline float3 normalize(float3 v) {
    return v / std::sqrt(dot(v, v));
}
inline float3 reflect(float3 v, float3 n) {
    return v - 2 * dot(n, v) * n;
}
inline float fract(float x) {
    return x - std::floor(x);
}
inline float2 floor(float2 v) {
    return float2 { std::floor(v.x), std::floor(v.y) };
}
using std::abs;
using std::cos;
using std::floor;
using std::sin;
using std::sqrt;

inline int min(int a, int b) {
    return a < b ? a : b;
}
inline float min(float a, float b) {
    return a < b ? a : b;
}
inline float max(float a, float b) {
    return a > b ? a : b;
}
inline float2 min(float2 a, float2 b) {
    return float2 { min(a.x, b.x), min(a.y, b.y) };
}
inline float3 max(float3 a, float3 b) {
    return float3 { max(a.x, b.x), max(a.y, b.y), max(a.z, b.z) };
}
inline float clamp(float x, float low, float high) {
    return min(max(x, low), high);
}
inline float2 clamp(float2 v, float2 low, float2 high) {
    return float2 { clamp(v.x, low.x, high.x), clamp(v.y, low.y, high.y) };
}
template <typename T> T mix(T a, T b, float t) {
    return a + (b - a) * t;
}
template <typename T, typename F> T as_type(F x) {
    T bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

struct float3x3 {
    float3 column[3];
    float3x3() = default;
    explicit float3x3(float) : column {} {}
    float3x3(float3 a, float3 b, float3 c) : column { a, b, c } {}
    float3 &operator[](int i) {
        return column[i];
    }
};
inline float3 operator*(float3x3 m, float3 v) {
    return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}
inline float3 operator*(float3 v, float3x3 m) {
    return float3 { dot(v, m[0]), dot(v, m[1]), dot(v, m[2]) };
}
inline float3x3 transpose(float3x3 m) {
    return float3x3(float3 { m[0].x, m[1].x, m[2].x }, float3 { m[0].y, m[1].y, m[2].y },
                    float3 { m[0].z, m[1].z, m[2].z });
}

#endif
