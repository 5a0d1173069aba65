/* SPDX-License-Identifier: MIT */
/* lampion/brdf.h - reflectance: measured and parametric BRDFs, and their tables of spherical
 * harmonics coefficients.
 *
 * Conventions
 *   frame       local: z = normal, x = tangent. wi points to the light, wo to the viewer, both away
 *               from the surface; the library normalizes both.
 *   value       f_r in sr⁻¹, linear RGB, without the cosine; 0 unless wi.z > 0 and wo.z > 0.
 *   table       coefficients, for each view direction, of f_r(wi, wo) max(cos theta_i, 0) on the
 *               sphere of wi (Kautz, Sloan and Snyder 2002; paper §4.1): a dot product with the
 *               light's coefficients in the same frame is the reflected radiance.
 *
 * In every build, readers treat their bytes as untrusted, and say what is wrong and where; a
 * release build assumes that all other preconditions hold (base.h). Objects are immutable: share
 * them freely among threads. */
#ifndef LAMPION_BRDF_H
#define LAMPION_BRDF_H

#include <lampion/sh.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A BRDF of any kind. It is immutable: share it freely among threads. */
typedef struct lmp_brdf lmp_brdf;

typedef enum lmp_brdf_kind {
    LMP_BRDF_LAMBERT = 0,
    LMP_BRDF_PHONG,
    LMP_BRDF_GGX,
    LMP_BRDF_SGD,
    LMP_BRDF_MERL,
    LMP_BRDF_RGL,
    LMP_BRDF_SHEEN
} lmp_brdf_kind;
#define LMP_BRDF_KIND_COUNT (LMP_BRDF_SHEEN + 1)

/* Frees a BRDF of any kind through the host it was made with. Accepts NULL. */
LMP_API void lmp_brdf_destroy(lmp_brdf *brdf);

/* Evaluates f_r(wi, wo), in sr⁻¹. It may grow without bound near the horizon, so it is clamped to
 * the largest float. */
LMP_API lmp_rgb lmp_brdf_eval(const lmp_brdf *brdf, lmp_vec3 wi, lmp_vec3 wo);

/* Evaluates f_r(wi, wo), in sr⁻¹, in double, for directions that float cannot tell apart. rgb
 * receives red, green and blue. */
LMP_API void lmp_brdf_eval_double(const lmp_brdf *brdf, const double wi[3], const double wo[3],
                                  double rgb[3]);

/* The properties of a BRDF, which lmp_brdf_describe returns. */
typedef struct lmp_brdf_info {
    lmp_brdf_kind kind;
    bool anisotropic; /* rotating the surface around its normal changes it */
    bool mirrored;    /* isotropic, and exactly unchanged under y -> -y */
    bool measured;    /* cells of a file: quadrature finer than `rings` resolves only their edges */
    bool spectral;    /* an RGL file with spectra, converted to RGB */
    int shape[3];     /* MERL: cells of theta_h, theta_d, phi_d; RGL: nodes of phi_i, theta_i */
    int rings;        /* quadrature rings that resolve its cells or samples; 0 for a formula */
    size_t bytes;     /* of memory it holds */
} lmp_brdf_info;
LMP_API lmp_brdf_info lmp_brdf_describe(const lmp_brdf *brdf);

/* --- parametric --------------------------------------------------------------------------------
 * The caller owns *brdf, which is NULL on failure, and frees it with lmp_brdf_destroy.
 * LMP_ERROR_ARGUMENT: a value is not finite or is out of range. */

/* Creates a Lambertian BRDF, f_r = albedo/pi.
 *
 * albedo >= 0 */
LMP_API lmp_result lmp_brdf_create_lambert(const lmp_host *host, lmp_rgb albedo, lmp_brdf **brdf);

/* Creates a Phong lobe, f_r = reflectance (e+2)/(2 pi) max(wi·r, 0)^e, where r is the mirror
 * direction of wo. Seen head-on, it reflects the fraction `reflectance` of the light (Lafortune and
 * Willems 1994).
 *
 * exponent e >= 0, reflectance >= 0 */
LMP_API lmp_result lmp_brdf_create_phong(const lmp_host *host, lmp_rgb reflectance, float exponent,
                                         lmp_brdf **brdf);

/* Microfacets as in glTF 2.0, appendix B: the GGX distribution of normals (Walter et al. 2007),
 * height-correlated Smith masking and Schlick's Fresnel term F, over a diffuse part (1 - F)
 * diffuse/pi. The BRDF is anisotropic if alpha_x and alpha_y differ. */
typedef struct lmp_ggx {
    float alpha_x, alpha_y; /* widths along x and y, 0.001 … 1; alpha_y = 0 means alpha_x */
    lmp_rgb f0;             /* reflectance at normal incidence, 0 … 1 */
    lmp_rgb diffuse;        /* albedo of the diffuse part, >= 0 */
} lmp_ggx;
LMP_API lmp_result lmp_brdf_create_ggx(const lmp_host *host, const lmp_ggx *ggx, lmp_brdf **brdf);

/* Cloth as in KHR_materials_sheen: fibers, with the distribution and the visibility term that the
 * extension calls Charlie, over a diffuse base. The base keeps the fraction 1 - max(color) E of its
 * light, where E is the larger of the fibers' albedos toward the light and toward the viewer. At
 * grazing angles and roughnesses below 0.3 these formulas reflect more light than arrives; there
 * the fibers' reflection is divided by the larger of the two excesses. */
typedef struct lmp_sheen {
    float roughness; /* 0.07 … 1: how much the fibers diverge from the normal */
    lmp_rgb color;   /* reflectance of the fibers, 0 … 1 */
    lmp_rgb diffuse; /* albedo of the base, >= 0 */
} lmp_sheen;
LMP_API lmp_result lmp_brdf_create_sheen(const lmp_host *host, const lmp_sheen *sheen,
                                         lmp_brdf **brdf);

/* The shifted gamma distribution of Bagher, Soler and Holzschuch (2012); each member holds red,
 * green, blue. The formula is in docs/materials.md. */
typedef struct lmp_sgd {
    double rho_d[3], rho_s[3], alpha[3], p[3], f0[3], f1[3], k_ap[3];
    double lambda[3], c[3], k[3], theta0[3];
} lmp_sgd;
LMP_API lmp_result lmp_brdf_create_sgd(const lmp_host *host, const lmp_sgd *sgd, lmp_brdf **brdf);

/* The 100 materials of the MERL database, as fitted by Bagher, Soler and Holzschuch (2012), are
 * built in. lmp_brdf_sgd_name returns the database's name for material `index`, such as
 * "gold-metallic-paint", or NULL past the last. lmp_brdf_find_sgd accepts that name or its alias,
 * and returns LMP_ERROR_ARGUMENT for an unknown one. */
LMP_API const char *lmp_brdf_sgd_name(size_t index);
LMP_API lmp_result lmp_brdf_find_sgd(const char *name, lmp_sgd *sgd);

/* --- measured files ----------------------------------------------------------------------------
 * Readers copy what they need: `data` may be freed once they return. LMP_ERROR_FORMAT: the bytes
 * are not such a file, and *error says why. LMP_ERROR_MEMORY: memory ran out. Nothing that a file
 * claims is trusted unless its size bears it out. */

/* Reads a MERL .binary file (Matusik et al. 2003): int32 dimensions of theta_h, theta_d, phi_d,
 * then planes of float64 for red, green and blue. Values are looked up by cell, as the format's
 * authors do; negative cells (no data) read as 0. Any dimensions that agree with `size` are
 * accepted; NaN and infinity are errors. */
LMP_API lmp_result lmp_brdf_read_merl(const lmp_host *host, const void *data, size_t size,
                                      lmp_parse_error *error, lmp_brdf **brdf);

/* Reads an RGL .bsdf tensor file (Dupuy and Jakob 2018), isotropic or anisotropic (phi_i over a
 * full, half or quarter turn), RGB or spectral. Spectra are converted to linear sRGB with the CIE
 * 1931 observer (the analytic fit of Wyman, Sloan and Shirley 2013) under an equal-energy
 * illuminant, adapted so that a flat spectrum is gray. The file holds f_r cos theta_o, and
 * lmp_brdf_eval divides by the cosine; tables use the file's first direction for the viewer. */
LMP_API lmp_result lmp_brdf_read_rgl(const lmp_host *host, const void *data, size_t size,
                                     lmp_parse_error *error, lmp_brdf **brdf);

/* Sample any BRDF and encode it as a file. A MERL file holds the values at the centers of 90 x 90 x
 * 180 cells, and loses anisotropy; an RGL file holds RGB at the resolution that docs/formats.md
 * gives.
 *
 * *data receives *size bytes allocated by the host; release them through it, or with free() if host
 * is NULL. On failure *data is NULL and *size 0. */
#define LMP_MERL_SIZE 34992012u
LMP_API lmp_result lmp_brdf_encode_merl(const lmp_host *host, const lmp_brdf *brdf, void **data,
                                        size_t *size);
LMP_API lmp_result lmp_brdf_encode_rgl(const lmp_host *host, const lmp_brdf *brdf, void **data,
                                       size_t *size);

/* --- tables ----------------------------------------------------------------------------------- */

typedef enum lmp_brdf_symmetry {
    LMP_BRDF_SYMMETRY_AUTO = 0, /* mirrored if the BRDF is, exactly or within its noise */
    LMP_BRDF_SYMMETRY_MIRROR,   /* keeps only m >= 0: averages f_r with its mirror image */
    LMP_BRDF_SYMMETRY_NONE
} lmp_brdf_symmetry;

/* How to make a table. Zero-initialize it: zero means a member's default, which its comment names
 * last. */
typedef struct lmp_brdf_table_desc {
    int bands;    /* 1 … LMP_BANDS_MAX; LMP_BRDF_BANDS_DEFAULT */
    int views;    /* angles theta_o, 2 … 1024; LMP_BRDF_VIEWS_DEFAULT, or for an isotropic BRDF
                     5/4 per band if that is more */
    int azimuths; /* angles phi_o of an anisotropic BRDF, 4 … 256; 32 */
    lmp_window window; /* as in lmp_sh_make_window; LMP_WINDOW_NONE */
    float window_size; /* in bands */
    lmp_brdf_symmetry symmetry;
    float tolerance; /* the change, relative to a view's largest coefficient, at which the doubling
                        of nodes ends; 1e-4 */
    int rings_max; /* the most rings to double to, 16 … 2048; those that resolve the BRDF, or 512 */
} lmp_brdf_table_desc;
#define LMP_BRDF_BANDS_DEFAULT    10
#define LMP_BRDF_VIEWS_DEFAULT    64
#define LMP_BRDF_AZIMUTHS_DEFAULT 32

typedef struct lmp_brdf_table lmp_brdf_table;

/* Makes the table of a BRDF, which takes seconds to minutes on all threads of the host. The caller
 * frees *table with lmp_brdf_table_destroy; the table does not refer to the BRDF. A NULL desc means
 * a zero-initialized one; the paper windows its 10 bands with LMP_WINDOW_HANNING.
 *
 * On failure *table is NULL. LMP_ERROR_ARGUMENT: a member of desc is outside its range */
LMP_API lmp_result lmp_brdf_table_create(const lmp_host *host, const lmp_brdf_table_desc *desc,
                                         const lmp_brdf *brdf, lmp_brdf_table **table);
LMP_API void lmp_brdf_table_destroy(lmp_brdf_table *table);

/* The properties of a table, which lmp_brdf_table_describe returns. View v has theta_o = v
 * theta_step, and the last view lies half a step before the horizon; azimuth a has phi_o = 2 pi a /
 * azimuths. */
typedef struct lmp_brdf_table_info {
    int bands, views;
    int azimuths;      /* 1 for an isotropic BRDF */
    bool mirrored;     /* only m >= 0 is kept, at index l(l+1)/2 + m; otherwise l*l + l + m */
    size_t count;      /* coefficients per view and channel: n(n+1)/2 or n² */
    lmp_window window; /* already applied to the coefficients */
    float window_size;
    int rings;        /* the most rings that any view took */
    float change;     /* largest relative change at the last doubling of any view */
    float theta_step; /* radians */
} lmp_brdf_table_info;
LMP_API lmp_brdf_table_info lmp_brdf_table_describe(const lmp_brdf_table *table);

/* Returns all coefficients of a table, [azimuth][view][channel][count], which the table owns. Each
 * view has its own frame, in which wo lies in the x-z plane with x >= 0. */
LMP_API const float *lmp_brdf_table_coefficients(const lmp_brdf_table *table);

/* Interpolates the coefficients for any view, with cubics (Catmull-Rom) in theta_o and phi_o
 * between the views of the table.
 *
 * cos_theta_o is clamped to 0 … 1; an isotropic table ignores phi_o
 * sh receives three planes of `count` values, in the frame of the view */
LMP_API void lmp_brdf_table_interpolate(const lmp_brdf_table *table, float cos_theta_o, float phi_o,
                                        float *sh);

/* Finds the fraction of the light that is reflected toward a view, ∫ f_r cos theta_i dw under
 * radiance 1: `whole` receives that of the BRDF, `series` that of its truncated and windowed series
 * over the same hemisphere. */
LMP_API void lmp_brdf_table_find_albedo(const lmp_brdf_table *table, int view, int azimuth,
                                        lmp_rgb *whole, lmp_rgb *series);

/* Projects a BRDF seen from one direction, in the material's own frame and without a windowing
 * filter, using `rings` Gauss-Legendre rings of 2*rings azimuths each.
 *
 * wo.z > 0; sh receives three planes of LMP_SH_COUNT(bands) values */
LMP_API lmp_result lmp_brdf_project(const lmp_host *host, int bands, int rings,
                                    const lmp_brdf *brdf, lmp_vec3 wo, float *sh);

/* Write a table as bytes and read it back, in the file format .lmpt (docs/formats.md):
 * little-endian, versioned, checksummed. A table gives the same bytes on every machine.
 *
 * size must be at least lmp_brdf_table_size(table): otherwise nothing is written and the result is
 * LMP_ERROR_ARGUMENT */
LMP_API size_t lmp_brdf_table_size(const lmp_brdf_table *table);
LMP_API lmp_result lmp_brdf_table_write(const lmp_brdf_table *table, size_t size, void *bytes);
LMP_API lmp_result lmp_brdf_table_read(const lmp_host *host, const void *data, size_t size,
                                       lmp_parse_error *error, lmp_brdf_table **table);

#ifdef __cplusplus
}
#endif
#endif
