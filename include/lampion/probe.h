/* SPDX-License-Identifier: MIT */
/* lampion/probe.h - light probes: irradiance from coefficients, the constants that shaders want,
 * coefficients from samples, conventions of other software, and series that stay positive.
 *
 * A probe is what sh.h and light.h make: coefficients of incoming radiance at a point, of one
 * channel or as three planes, red, green, blue, of LMP_SH_COUNT(bands) values.
 *
 * A release build asserts nothing (base.h); lmp_probe_fit returns a result in every build. */
#ifndef LAMPION_PROBE_H
#define LAMPION_PROBE_H

#include <lampion/lobe.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- irradiance ------------------------------------------------------------------------------- */

/* Irradiance on a surface, W·m⁻²: ∫ L(w) max(n·w, 0) dw = Σ A_l L_lm Y_lm(n), with A_l of
 * lmp_lobe_diffuse (Ramamoorthi and Hanrahan 2001). A diffuse surface reflects albedo / pi of it.
 * Three bands hold irradiance within a few percent, whatever the light.
 *
 * sh holds three planes; normal must be unit. The series may ring below 0; it is not clamped */
LMP_API lmp_rgb lmp_probe_irradiance(int bands, const float *sh, lmp_vec3 normal);

/* The same for many normals, each its own red, green, blue in rgb. */
LMP_API void lmp_probe_irradiance_n(int bands, const float *sh, lmp_vec3_array normals,
                                    size_t count, lmp_rgb *rgb);

/* Irradiance of three bands as the polynomial that engines upload, for a unit normal n:
 *
 *     E_c = linear[c]·(n, 1) + quadratic[c]·(n.x n.y, n.y n.z, n.z n.z, n.z n.x)
 *           + last[c] (n.x n.x - n.y n.y)
 *
 * (Sloan 2008, appendix A10; `unity_SHAr` … `unity_SHC` where `scale` is 1/pi). Seven float4 in a
 * uniform buffer; shaders/probe.glsl evaluates it. */
typedef struct lmp_probe_constants {
    float linear[3][4], quadratic[3][4], last[4]; /* last[3] is 1 */
} lmp_probe_constants;

/* Constants of a probe of at least 3 bands, multiplied by `scale`: 1 for irradiance, 1/pi for what
 * a white diffuse surface reflects. sh holds three planes. */
LMP_API void lmp_probe_constants_of(int bands, float scale, const float *sh,
                                    lmp_probe_constants *constants);

/* --- from samples ----------------------------------------------------------------------------- */

/* Values seen in directions, and how much each counts; every `stride` bytes (base.h). */
typedef struct lmp_probe_samples {
    lmp_vec3_array directions; /* unit */
    lmp_float_array values;
    lmp_float_array weights; /* >= 0; `at` NULL: 1 each */
    size_t count;
} lmp_probe_samples;

/* Coefficients whose series is nearest to samples that need not be uniform: they minimize
 * Σ weight (series - value)² + smoothness Σ l² (l+1)² f_lm², the second term the squared Laplacian.
 * With smoothness 0, samples of a series of so many bands give it back.
 *
 * 1 … LMP_PROBE_FIT_BANDS_MAX bands, smoothness >= 0; sh receives LMP_SH_COUNT(bands) values.
 * LMP_ERROR_ARGUMENT: a value that is not finite or outside its range, or samples that leave some
 * coefficient undetermined (too few, or all in one direction); a smoothness determines all but the
 * constant. LMP_ERROR_MEMORY: bands⁴ doubles are needed. host may be NULL */
#define LMP_PROBE_FIT_BANDS_MAX 32
LMP_API lmp_result lmp_probe_fit(const lmp_host *host, int bands, float smoothness,
                                 const lmp_probe_samples *samples, float *sh);

/* --- series that stay positive ---------------------------------------------------------------- */

/* The weakest window 1 / (1 + mu l² (l+1)²) (Sloan 2008) under which no function of `planes` falls
 * below 0: exactly up to 3 bands, at more bands at 8 n² directions, between which a ripple may fall
 * below 0 by less than 1 % of the mean. A function whose mean is not positive is left out: no
 * window mends it.
 *
 * 1 … LMP_PROBE_POSITIVE_BANDS_MAX bands; sh holds `planes` planes of LMP_SH_COUNT(bands) values,
 * for a window common to all; weights
 * receives `bands` values, for lmp_sh_window_apply, all 1 where nothing falls below 0 */
#define LMP_PROBE_POSITIVE_BANDS_MAX 32
LMP_API void lmp_probe_window_positive(int bands, const float *sh, int planes, float *weights);

/* The least value of a function of 1 to 3 bands, exact but for rounding. */
LMP_API float lmp_probe_minimum(int bands, const float *sh);

/* --- conventions ------------------------------------------------------------------------------ */

/* What other software means by the coefficients of a function, f_lm = ∫ f(w) Y_lm(w) dw for a basis
 * and axes of its own; zero-initialized: what this library means (sh.h). */
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
    /* Its axes x, y, z in this library's world (y up, right-handed): 1, 2, 3 are x, y, z, and -1,
     * -2, -3 their opposites. 0, 0, 0 means 1, 2, 3. Left-handed worlds are allowed. */
    signed char axes[3];
} lmp_probe_convention;

/* The same function's coefficients in another convention.
 *
 * The three |axes| must be different; where those of the two differ, at most
 * LMP_PROBE_AXES_BANDS_MAX bands. sh and converted hold LMP_SH_COUNT(bands) values and must not
 * overlap, index l² + l + m (ACN) in both */
#define LMP_PROBE_AXES_BANDS_MAX 16
LMP_API void lmp_probe_convert(int bands, const lmp_probe_convention *from,
                               const lmp_probe_convention *to, const float *sh, float *converted);

/* Which convention turns `ours`, in this library's, into `theirs`, coefficients of the same
 * function: true, and *convention receives it, if all agree within `tolerance` times the largest.
 * Of several the first: its own axes, then the order of the enumerations. Others differ by a
 * symmetry of the function, or are equal. Other axes are tried up to LMP_PROBE_AXES_BANDS_MAX
 * bands.
 *
 * tolerance >= 0; ours and theirs hold LMP_SH_COUNT(bands) values */
LMP_API bool lmp_probe_recognize(int bands, float tolerance, const float *ours, const float *theirs,
                                 lmp_probe_convention *convention);

/* --- engines -----------------------------------------------------------------------------------
 */

/* What game engines keep of a probe: nine values a channel, of three bands. docs/probes.md says
 * where each engine states it, and what its shaders then do. */
typedef enum lmp_probe_engine {
    LMP_PROBE_UNITY = 0, /* SphericalHarmonicsL2 */
    LMP_PROBE_UNREAL,    /* FSHVectorRGB3 */
    LMP_PROBE_GODOT,     /* a probe of LightmapGI */
    LMP_PROBE_FILAMENT,  /* IndirectLight::Builder::irradiance */
    LMP_PROBE_ENGINES    /* how many there are */
} lmp_probe_engine;

typedef struct lmp_probe_format {
    const char *name; /* "unity" … */
    /* Of its coefficients; the axes are those that its importer of glTF rotates a scene to. */
    lmp_probe_convention convention;
    float unit;       /* how many of its lengths are one of glTF's meters */
    bool interleaved; /* red, green, blue of each value together; false: nine of red come first */
    float factors[9]; /* what each coefficient is multiplied by */
} lmp_probe_format;

/* Static storage; copy it to change its axes. */
LMP_API const lmp_probe_format *lmp_probe_format_of(lmp_probe_engine engine);

/* A probe as an engine keeps it.
 *
 * At least 3 bands, of which 3 count; sh holds three planes, values receives 27 values. */
LMP_API void lmp_probe_export(int bands, const lmp_probe_format *format, const float *sh,
                              float *values);

#ifdef __cplusplus
}
#endif
#endif
