/* SPDX-License-Identifier: MIT */
/* The paper's tabulation (§4.2), to compare: sin²a R_l against cos a, looked up in place of the
 * recurrence. Far lights lie in its last step; Diracs, whose R_l are all 1, are not in the table.
 */
layout(binding = SHARED_ZONAL) uniform sampler2D zonal_table;

/* Returns the four values from band 4k on. Entries run from cos a = 0 to 1, at the centers of
 * texels. */
vec4 tabulated_series(int k, float c) {
    vec2 at = vec2((c * float(SHARED_ZONAL_ENTRIES - 1) + 0.5) / float(SHARED_ZONAL_ENTRIES),
                   (float(k) + 0.5) / float((LMP_BANDS + 3) / 4));
    return textureLod(zonal_table, at, 0.0);
}

void lmp_cap_series(lmp_cap cap, out float R[LMP_BANDS]) {
    float c = 1.0 - cap.one_minus_cos, side = cap.strength < 0.0 ? -1.0 : 1.0;
    float dirac = cap.one_minus_cos > 0.0 ? 0.0 : max(cap.strength, 0.0);
    vec4 four = tabulated_series(0, c);
    R[0] = cap.base;
    if (LMP_BANDS > 1)
        R[LMP_BAND(1)] = side * four.y + dirac;
#define LMP_STEP(l)                                                                                \
    if (l < LMP_BANDS) {                                                                           \
        if (l % 4 == 0)                                                                            \
            four = tabulated_series(l / 4, c);                                                     \
        R[LMP_BAND(l)] = side * four[l % 4] + dirac;                                               \
    }
    LMP_FOR_BANDS(LMP_STEP)
#undef LMP_STEP
}
