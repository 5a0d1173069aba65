/* SPDX-License-Identifier: MIT */
/* lampion/probe.h - light probes: irradiance from coefficients, constants for shaders, coefficients
 * from samples, the conventions of other software, and series that stay positive.
 *
 * A probe consists of the coefficients of incoming radiance at a point, as sphere.h and light.h
 * make them: either one channel or three planes, red, green, blue, of LMP_SH_COUNT(bands) values
 * each.
 *
 * A release build asserts nothing (base.h); lmp_probe_fit checks its arguments in every build. */
#ifndef LAMPION_PROBE_H
#define LAMPION_PROBE_H

#include <lampion/lobe.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- irradiance ------------------------------------------------------------------------------- */

/* Computes the irradiance on a surface, W·m⁻²: ∫ L(w) max(n·w, 0) dw = Σ A_l L_lm Y_lm(n), where
 * A_l are the factors of lmp_lobe_make_diffuse (Ramamoorthi and Hanrahan 2001). A diffuse surface
 * reflects albedo / pi times the irradiance. Three bands represent it to within a few percent,
 * whatever the light.
 *
 * sh holds three planes; normal must be unit. The series may ring below 0; it is not clamped */
LMP_API lmp_rgb lmp_probe_irradiance(int bands, const float *sh, lmp_vec3 normal);

/* Computes the irradiance for many normals, as lmp_probe_irradiance does for one. rgb receives a
 * color for each normal. */
LMP_API void lmp_probe_irradiance_n(int bands, const float *sh, lmp_vec3_array normals,
                                    size_t count, lmp_rgb_array rgb);

/* The irradiance of three bands as a polynomial in the unit normal n, whose constants engines
 * upload:
 *
 *     E_c = linear[c]·(n, 1) + quadratic[c]·(n.x n.y, n.y n.z, n.z n.z, n.z n.x)
 *           + last[c] (n.x n.x - n.y n.y)
 *
 * (Sloan 2008, appendix A10; `unity_SHAr` … `unity_SHC` if `scale` is 1/pi). It takes seven float4
 * in a uniform buffer; probe.glsl evaluates it. */
typedef struct lmp_probe_constants {
    float linear[3][4], quadratic[3][4], last[4]; /* last[3] is 1 */
} lmp_probe_constants;

/* Computes the constants of a probe of at least 3 bands, multiplied by `scale`: 1 for irradiance,
 * 1/pi for the radiance that a white diffuse surface reflects. sh holds three planes. */
LMP_API void lmp_probe_make_constants(int bands, float scale, const float *sh,
                                      lmp_probe_constants *constants);

/* --- from samples ----------------------------------------------------------------------------- */

/* Values observed in given directions, each with a weight. Strides are in bytes (base.h). */
typedef struct lmp_probe_samples {
    lmp_vec3_array directions; /* unit */
    lmp_float_array values;
    lmp_float_array weights; /* >= 0; 1 each if `at` is NULL */
    size_t count;
} lmp_probe_samples;

/* Finds the coefficients whose series best fits the samples, which need not be uniform: they
 * minimize Σ weight (series - value)² + smoothness Σ l² (l+1)² f_lm², where the second term is the
 * squared Laplacian. With smoothness 0, samples of a series of as many bands reproduce that series.
 *
 * 1 … LMP_PROBE_FIT_BANDS_MAX bands, smoothness >= 0; sh receives LMP_SH_COUNT(bands) values.
 * LMP_ERROR_ARGUMENT: a value is not finite or is out of range, or the samples leave some
 * coefficient undetermined (there are too few, or all lie in one direction); a smoothness above 0
 * determines all but the constant. LMP_ERROR_MEMORY: no memory for the bands⁴ doubles needed. host
 * may be NULL */
#define LMP_PROBE_FIT_BANDS_MAX 32
LMP_API lmp_result lmp_probe_fit(const lmp_host *host, int bands, float smoothness,
                                 const lmp_probe_samples *samples, float *sh);

/* --- series that stay positive ---------------------------------------------------------------- */

/* Finds the weakest window 1 / (1 + mu l² (l+1)²) (Sloan 2008) under which none of `planes`
 * functions falls below 0. Up to 3 bands this is exact; with more, it is checked at 8 n²
 * directions, between which a ripple may fall below 0 by less than 1 % of the mean. A function
 * whose mean is not positive is ignored, because no window can make it positive.
 *
 * 1 … LMP_PROBE_POSITIVE_BANDS_MAX bands; sh holds `planes` planes of LMP_SH_COUNT(bands) values,
 * which share the window; weights receives `bands` values, for lmp_sh_apply_window, all 1 if
 * nothing falls below 0 */
#define LMP_PROBE_POSITIVE_BANDS_MAX 32
LMP_API void lmp_probe_make_positive_window(int bands, const float *sh, size_t planes,
                                            float *weights);

/* Returns the smallest value of a function of 1 to 3 bands, exact up to rounding. */
LMP_API float lmp_probe_minimum(int bands, const float *sh);

/* --- conventions ------------------------------------------------------------------------------ */

/* How other software defines the coefficients of a function: as f_lm = ∫ f(w) Y_lm(w) dw, but with
 * a basis and axes of its own. Zero-initialized it means this library's convention (sh.h). */
typedef enum lmp_probe_sign {
    LMP_PROBE_SIGN_CONDON_SHORTLEY = 0, /* Y_1 = 0.4886 (-y, z, -x): Sloan, DirectXMath */
    LMP_PROBE_SIGN_POSITIVE             /* Y_1 = 0.4886 (y, z, x): three.js, sphericart */
} lmp_probe_sign;
typedef enum lmp_probe_normalization {
    LMP_PROBE_ORTHONORMAL = 0, /* ∫ Y² dw = 1 */
    LMP_PROBE_N3D,             /* ∫ Y² dw = 4 pi, so Y_00 = 1: Ambisonics */
    LMP_PROBE_SN3D             /* ∫ Y² dw = 4 pi / (2l+1), Schmidt's: AmbiX */
} lmp_probe_normalization;
typedef struct lmp_probe_convention {
    lmp_probe_sign sign;
    lmp_probe_normalization normalization;
    /* The convention's axes x, y, z in this library's world (y up, right-handed): 1, 2, 3 are x, y,
     * z, and -1, -2, -3 their opposites. 0, 0, 0 means 1, 2, 3. Left-handed worlds are allowed. */
    signed char axes[3];
} lmp_probe_convention;

/* Converts the coefficients of a function from one convention to another.
 *
 * The three |axes| of a convention must be different; if the axes of the two conventions differ,
 * bands must be at most LMP_PROBE_AXES_BANDS_MAX. sh and converted hold LMP_SH_COUNT(bands) values
 * and must not overlap; both have index l² + l + m (ACN) */
#define LMP_PROBE_AXES_BANDS_MAX 16
LMP_API void lmp_probe_convert(int bands, const lmp_probe_convention *from,
                               const lmp_probe_convention *to, const float *sh, float *converted);

/* Finds the convention of `theirs`, given `ours`, the coefficients of the same function in this
 * library's convention. Returns true, and *convention receives it, if all converted coefficients
 * agree to within `tolerance` times the largest. If several conventions fit, it takes the first
 * one: the library's own axes come first, then the order of the enumerations decides. The others
 * differ by a symmetry of the function, or are equal. Axes other than the library's are tried up to
 * LMP_PROBE_AXES_BANDS_MAX bands.
 *
 * tolerance >= 0; ours and theirs hold LMP_SH_COUNT(bands) values */
LMP_API bool lmp_probe_recognize(int bands, float tolerance, const float *ours, const float *theirs,
                                 lmp_probe_convention *convention);

/* --- engines ---------------------------------------------------------------------------------- */

/* The form in which game engines store a probe: nine values per channel, for three bands.
 * docs/probes.md says where each engine documents it, and what its shaders do with it. */
typedef enum lmp_probe_engine {
    LMP_PROBE_UNITY = 0, /* SphericalHarmonicsL2 */
    LMP_PROBE_UNREAL,    /* FSHVectorRGB3 */
    LMP_PROBE_GODOT,     /* a probe of LightmapGI */
    LMP_PROBE_FILAMENT   /* IndirectLight::Builder::irradiance */
} lmp_probe_engine;
#define LMP_PROBE_ENGINE_COUNT (LMP_PROBE_FILAMENT + 1)

typedef struct lmp_probe_format {
    const char *name; /* "unity" … */
    /* The convention of its coefficients. The axes are those that the engine's glTF importer
     * rotates a scene to. */
    lmp_probe_convention convention;
    float unit;       /* how many of the engine's units of length make a glTF meter */
    bool interleaved; /* red, green, blue of each value together; false: all nine reds come first */
    float factors[9]; /* what each coefficient is multiplied by */
} lmp_probe_format;

/* Returns the format of an engine's probes, in static storage; copy it to change its axes. */
LMP_API const lmp_probe_format *lmp_probe_engine_format(lmp_probe_engine engine);

/* Writes a probe in the format of an engine.
 *
 * bands must be at least 3, of which the first 3 are used; sh holds three planes, and values
 * receives 27 values. */
LMP_API void lmp_probe_export(int bands, const lmp_probe_format *format, const float *sh,
                              float *values);

#ifdef __cplusplus
}
#endif
#endif
