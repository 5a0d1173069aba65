/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"

#include <lampion/probe.h>

/* Factors of irradiance over pi as a polynomial of a normal: A_l / pi times the factors of Y_lm
 * (Sloan 2008, appendix A2; the table of Filament's IndirectLight.h, and Unity's
 * SphericalHarmonicMath). */
#define POLYNOMIAL                                                                                 \
    {                                                                                              \
        0.282094792f, -0.325735008f, 0.325735008f, -0.325735008f, 0.273137108f, -0.273137108f,     \
            0.0788478913f, -0.273137108f, 0.136568554f                                             \
    }

#define EACH(factor)                                                                               \
    { factor, factor, factor, factor, factor, factor, factor, factor, factor }

/* The formats of the engines; docs/probes.md has the source of each row. */
static const lmp_probe_format formats[LMP_PROBE_ENGINE_COUNT] = {
    [LMP_PROBE_UNITY] = { "unity", { .axes = { -1, 2, 3 } }, 1, false, POLYNOMIAL },
    [LMP_PROBE_UNREAL] = { "unreal", { .axes = { 1, 3, 2 } }, 100, false, EACH(1) },
    [LMP_PROBE_GODOT] = { "godot",
                          { .sign = LMP_PROBE_SIGN_POSITIVE },
                          1,
                          true,
                          EACH(0.318309886f) },
    [LMP_PROBE_FILAMENT] = { "filament", { .sign = 0 }, 1, true, POLYNOMIAL },
};

const lmp_probe_format *lmp_probe_engine_format(lmp_probe_engine engine) {
    assert((unsigned)engine < LMP_PROBE_ENGINE_COUNT);
    return &formats[engine];
}

void lmp_probe_export(int bands, const lmp_probe_format *format, const float *sh, float *values) {
    enum { BANDS = 3, COUNT = BANDS * BANDS };
    static const lmp_probe_convention ours = { 0 };
    assert(bands >= BANDS && bands <= LMP_BANDS_MAX);
    assert(lmpi_are_apart(sh, 3 * LMP_SH_COUNT(bands), values, 3 * COUNT));
    for (size_t c = 0; c < 3; c++) {
        float converted[COUNT];
        lmp_probe_convert(BANDS, &ours, &format->convention, sh + c * LMP_SH_COUNT(bands),
                          converted);
        for (size_t i = 0; i < COUNT; i++)
            values[format->interleaved ? 3 * i + c : COUNT * c + i] =
                format->factors[i] * converted[i];
    }
}
