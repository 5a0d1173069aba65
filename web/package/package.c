/* SPDX-License-Identifier: MIT */
/* package.c - what the npm package needs of C besides the library: functions on the sphere that are
 * JavaScript's, and the texels of a volume of probes. */
#include <lampion/probe.h>

#include <emscripten.h>

EMSCRIPTEN_KEEPALIVE void lampion_project(int bands, int nodes, float *sh);
EMSCRIPTEN_KEEPALIVE void lampion_project_rgb(int bands, int nodes, float *sh);
EMSCRIPTEN_KEEPALIVE void lampion_pack_volume(const float *sh, size_t count, uint16_t *halves);

/* --- for lmp_sh_project_function -------------------------------------------------------------- */

/* Calls the function that JavaScript is projecting; values receives three numbers. */
__attribute__((import_module("lampion"), import_name("call"))) void lampion_call(float x, float y,
                                                                                 float z,
                                                                                 float *values);

static float call(lmp_vec3 direction, void *user) {
    (void)user;
    float values[3];
    lampion_call(direction.x, direction.y, direction.z, values);
    return values[0];
}

static lmp_rgb call_rgb(lmp_vec3 direction, void *user) {
    (void)user;
    float values[3];
    lampion_call(direction.x, direction.y, direction.z, values);
    return (lmp_rgb) { values[0], values[1], values[2] };
}

void lampion_project(int bands, int nodes, float *sh) {
    lmp_sh_project_function(bands, nodes, call, NULL, sh);
}

void lampion_project_rgb(int bands, int nodes, float *sh) {
    lmp_sh_project_function_rgb(bands, nodes, call_rgb, NULL, sh);
}

/* --- for LightProbeVolume (three.js) ---------------------------------------------------------- */

enum { SLABS = sizeof(lmp_probe_constants) / (4 * sizeof(float)) };

/* Writes the constants of probes of 3 bands, interleaved, as halves: a slab of `count` texels of 4
 * for each of the SLABS vectors of lmp_probe_constants, as the layers of a 3D texture. */
void lampion_pack_volume(const float *sh, size_t count, uint16_t *halves) {
    for (size_t i = 0; i < count; i++) {
        union {
            lmp_probe_constants constants;
            float values[SLABS][4];
        } probe;
        lmp_probe_make_constants(3, 1, sh + 27 * i, &probe.constants);
        for (size_t slab = 0; slab < SLABS; slab++)
            lmp_sh_pack_half_n(probe.values[slab], 4, halves + 4 * (slab * count + i));
    }
}
