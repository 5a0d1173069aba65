/* SPDX-License-Identifier: MIT */
/* engines.h - what the shaders of game engines make of a probe, written from their documentation
 * (docs/probes.md), and the irradiance of a sphere light by closed forms without the code of
 * harmonics. */
#ifndef LAMPION_TESTS_ORACLE_ENGINES_H
#define LAMPION_TESTS_ORACLE_ENGINES_H

#include "tests/oracle/oracle.h"

#include <lampion/probe.h>

#include <math.h>

/* Returns what a white diffuse surface reflects, irradiance over pi, from one channel's nine values
 * and a normal in the engine's world. */
typedef double engine_shader(const double v[9], const double n[3]);

/* Unity: GetSHCoefficients makes unity_SHAr, unity_SHBr and unity_SHC of SphericalHarmonicsL2;
 * SHEvalLinearL0L1 and SHEvalLinearL2 of UnityCG.cginc evaluate them. */
static inline double unity_shader(const double v[9], const double n[3]) {
    const double a[4] = { v[3], v[1], v[2], v[0] - v[6] };
    const double b[4] = { v[4], v[5], 3 * v[6], v[7] }, c = v[8];
    const double x = n[0], y = n[1], z = n[2];
    return a[0] * x + a[1] * y + a[2] * z + a[3] + b[0] * x * y + b[1] * y * z + b[2] * z * z +
           b[3] * z * x + c * (x * x - y * y);
}

/* Unreal: DotSH3(sh, CalcDiffuseTransferSH3(n, 1)) / PI of SHCommon.ush. */
static inline double unreal_shader(const double v[9], const double n[3]) {
    const double x = n[0], y = n[1], z = n[2];
    const double basis[9] = { 0.282095,
                              -0.488603 * y,
                              0.488603 * z,
                              -0.488603 * x,
                              1.092548 * x * y,
                              -1.092548 * y * z,
                              0.315392 * (3 * z * z - 1),
                              -1.092548 * x * z,
                              0.546274 * (x * x - y * y) };
    const double exponent = 1,
                 scale[3] = { 2 * ORACLE_PI / (1 + exponent), 2 * ORACLE_PI / (2 + exponent),
                              exponent * 2 * ORACLE_PI / (3 + 4 * exponent + exponent * exponent) };
    double sum = 0;
    for (int i = 0; i < 9; i++)
        sum += scale[i == 0 ? 0 : i < 4 ? 1 : 2] * basis[i] * v[i];
    return sum / ORACLE_PI;
}

/* Godot: the captured lightmap of scene_forward_clustered.glsl. */
static inline double godot_shader(const double v[9], const double n[3]) {
    const double c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708;
    const double x = n[0], y = n[1], z = n[2];
    return c1 * v[8] * (x * x - y * y) + c3 * v[6] * z * z + c4 * v[0] - c5 * v[6] +
           2 * c1 * (v[4] * x * y + v[7] * x * z + v[5] * y * z) +
           2 * c2 * (v[3] * x + v[1] * y + v[2] * z);
}

/* Filament: Irradiance_SphericalHarmonics of surface_light_indirect.fs. */
static inline double filament_shader(const double v[9], const double n[3]) {
    const double x = n[0], y = n[1], z = n[2];
    return v[0] + v[1] * y + v[2] * z + v[3] * x + v[4] * y * x + v[5] * y * z +
           v[6] * (3 * z * z - 1) + v[7] * z * x + v[8] * (x * x - y * y);
}

static engine_shader *const engine_shaders[LMP_PROBE_ENGINE_COUNT] = {
    unity_shader,
    unreal_shader,
    godot_shader,
    filament_shader,
};

/* Converts a direction of a world with glTF's axes as the engine's importers do: UnityGLTF and
 * Unity's own glTFast negate x, Unreal's GLTFCore exchanges y and z. */
static inline void engine_direction(lmp_probe_engine engine, const double n[3], double theirs[3]) {
    const bool unity = engine == LMP_PROBE_UNITY, unreal = engine == LMP_PROBE_UNREAL;
    theirs[0] = unity ? -n[0] : n[0];
    theirs[1] = unreal ? n[2] : n[1];
    theirs[2] = unreal ? n[1] : n[2];
}

/* Returns the index of value i of channel c among a probe's 27: Unity's and Unreal's structures
 * hold nine of red first, Godot and Filament an array of nine colors. */
static inline int engine_index(lmp_probe_engine engine, int i, int c) {
    return engine == LMP_PROBE_UNITY || engine == LMP_PROBE_UNREAL ? 9 * c + i : 3 * i + c;
}

/* Returns what the engine makes of channel c of a probe; n is in glTF's axes. */
static inline double engine_reflects(lmp_probe_engine engine, const float *values, int c,
                                     const double n[3]) {
    double v[9], theirs[3];
    for (int i = 0; i < 9; i++)
        v[i] = (double)values[engine_index(engine, i, c)];
    engine_direction(engine, n, theirs);
    return engine_shaders[engine](v, theirs);
}

/* Returns the irradiance of a sphere of radiance 1 whose center has the `cosine` with the normal:
 * exact where it is all above the surface, and of three bands at any normal: the zonal integrals of
 * Legendre's polynomials over its cap, times those of the clamped cosine, pi, 2 pi / 3, pi / 4. */
static inline double sphere_irradiance(double radius, double distance, double cosine) {
    return ORACLE_PI * radius * radius / (distance * distance) * cosine;
}
static inline double sphere_irradiance_of_3_bands(double radius, double distance, double cosine) {
    const double sine = radius / distance, c = sqrt(1 - sine * sine);
    const double band0 = (1 - c) / 2 * ORACLE_PI;
    const double band1 = 3 * (1 - c * c) / 4 * (2 * ORACLE_PI / 3) * cosine;
    const double band2 = 5 * (c - c * c * c) / 4 * (ORACLE_PI / 4) * (3 * cosine * cosine - 1) / 2;
    return band0 + band1 + band2;
}

#endif
