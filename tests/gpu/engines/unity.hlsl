/* SPDX-License-Identifier: MIT */
/* lampion_probe.cginc as a compute shader: two colors a surface, of three bands and of two. */
[[vk::binding(0)]] StructuredBuffer<float4> given;
[[vk::binding(1)]] RWStructuredBuffer<float> values;
#include "lampion_probe.cginc"

[numthreads(SURFACES, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
    float4 three[7], two[3];
    for (int k = 0; k < 7; k++)
        three[k] = given[PROBE + k];
    for (int j = 0; j < 3; j++)
        two[j] = given[PROBE + 7 + j];
    float3 n = given[2 * LIGHTS + 3 * id.x + 1].xyz, first = lmp_probe_l2(three, n), second = lmp_probe_l1(two, n);
    for (int c = 0; c < 3; c++) {
        values[6 * id.x + c] = first[c];
        values[6 * id.x + 3 + c] = second[c];
    }
}
