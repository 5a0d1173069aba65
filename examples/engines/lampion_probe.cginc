/* SPDX-License-Identifier: MIT */
/* lampion_probe.cginc - irradiance from a probe in Unity's shaders, of the built-in pipeline, URP and VRChat.
 *
 * Upload what lmp_probe_make_constants returns, scale 1/pi, as seven vectors: material.SetVectorArray, or in
 * VRChat VRCShader.SetGlobalVectorArray, whose names begin with _Udon. The first three alone are a probe of
 * two bands, made of coefficients whose third band is 0. Unity's world is left-handed, glTF's importers negate
 * x: convert the coefficients first, by lmp_probe_convert to this library's convention with the axes -1, 2, 3.
 *
 *     #include "lampion_probe.cginc"
 *     float4 _Udon_Probe[7];
 *     ...
 *     color.rgb += albedo * max(lmp_probe_l2(_Udon_Probe, worldNormal), 0.0);
 */
#ifndef LAMPION_PROBE_CGINC
#define LAMPION_PROBE_CGINC

/* Returns irradiance over pi of two bands; n is unit, in the world. The result may ring below 0. */
float3 lmp_probe_l1(float4 probe[3], float3 n) {
    float4 m = float4(n, 1.0);
    return float3(dot(probe[0], m), dot(probe[1], m), dot(probe[2], m));
}

/* Returns that of three bands: unity_SHAr … unity_SHC in this order would be another such array. */
float3 lmp_probe_l2(float4 probe[7], float3 n) {
    float4 m = float4(n, 1.0), q = n.xyzz * n.yzzx;
    return float3(dot(probe[0], m) + dot(probe[3], q), dot(probe[1], m) + dot(probe[4], q),
                  dot(probe[2], m) + dot(probe[5], q)) +
           probe[6].rgb * (n.x * n.x - n.y * n.y);
}

#endif
