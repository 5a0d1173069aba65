/* SPDX-License-Identifier: MIT */
/* lampion_probe.wgsl as a compute shader: two colors a surface, of three bands and of two. */
@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;
@group(0) @binding(2) var<storage, read> words: array<u32>;

@compute @workgroup_size(SURFACES) fn probes(@builtin(global_invocation_id) id: vec3u) {
    var three: array<vec4f, 7>;
    var two: array<vec4f, 3>;
    for (var k = 0; k < 7; k++) {
        three[k] = given[PROBE + k];
    }
    for (var k = 0; k < 3; k++) {
        two[k] = given[PROBE + 7 + k];
    }
    let n = given[2 * LIGHTS + 3 * i32(id.x) + 1].xyz;
    let first = irradiance_l2(three, n);
    let second = irradiance_l1(two, n);
    for (var c = 0u; c < 3; c++) {
        values[6 * id.x + c] = first[c];
        values[6 * id.x + 3 + c] = second[c];
    }
}
