/* SPDX-License-Identifier: MIT */
/* volume.glsl - lampionVolumeIrradiance: the irradiance at a place of the world by a ProbeGrid, whose texture has seven
 * slabs (SLABS of probes.js). pack.sh expands this file as it does lights.glsl. */
uniform highp sampler3D lampionVolume;
uniform vec3 lampionVolumeMin, lampionVolumeExtent, lampionVolumeSize;
#include "probe.glsl"
vec4 lampionVolumeSlab(vec3 at, float slab) {
    float depth = lampionVolumeSize.z;
    return texture(lampionVolume, vec3(at.xy, (at.z + depth * slab) / (depth * 7.0)));
}
vec3 lampionVolumeIrradiance(vec3 position, vec3 n) {
    vec3 unit = clamp((position - lampionVolumeMin) / lampionVolumeExtent, 0.0, 1.0);
    vec3 at = unit * (lampionVolumeSize - 1.0) + 0.5;
    at.xy /= lampionVolumeSize.xy;
    vec4 linear[3], quadratic[3];
    for (int c = 0; c < 3; c++) {
        linear[c] = lampionVolumeSlab(at, float(c));
        quadratic[c] = lampionVolumeSlab(at, float(3 + c));
    }
    return max(lmp_probe_irradiance(linear, quadratic, lampionVolumeSlab(at, 6.0), n), 0.0);
}
