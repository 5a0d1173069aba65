/* SPDX-License-Identifier: MIT */
/* lampion/brdf.h - reflectance: measured and parametric BRDFs, and their tables on spherical
 * harmonics.
 *
 * Conventions
 *   frame       local: z = normal, x = tangent. wi points to the light, wo to the viewer, both away
 *               from the surface; both are normalized here.
 *   value       f_r in sr⁻¹, linear RGB, without the cosine; 0 unless wi.z > 0 and wo.z > 0.
 *   table       coefficients, for each view direction, of f_r(wi, wo) max(cos theta_i, 0) on the
 *               sphere of wi (Kautz, Sloan and Snyder 2002; paper §4.1): a dot product with the
 *               light's coefficients in the same frame is the reflected radiance.
 *
 * Readers take bytes, trust nothing, and say what is wrong and where, in every build; what else is
 * asked a release build takes as kept (base.h). Objects are immutable: share them freely among
 * threads. */
#ifndef LAMPION_BRDF_H
#define LAMPION_BRDF_H

#include <lampion/sh.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What is wrong with bytes, for a person: text without a file name, and the offset of the first
 * byte concerned. Every reader fills it on failure; NULL where it is not wanted. */
typedef struct lmp_parse_error {
    size_t offset;
    char text[200];
} lmp_parse_error;

/* A BRDF of any kind. */
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
#define LMP_BRDF_KINDS (LMP_BRDF_SHEEN + 1) /* of the last one */

/* Frees any BRDF, through the host it was made with; accepts NULL. */
LMP_API void lmp_brdf_destroy(lmp_brdf *brdf);

/* f_r(wi, wo) in sr⁻¹. Near the horizon it may grow without bound: held to the largest float. */
LMP_API lmp_rgb lmp_brdf_eval(const lmp_brdf *brdf, lmp_vec3 wi, lmp_vec3 wo);

/* The same in double, for directions that float cannot tell apart. */
LMP_API void lmp_brdf_eval_double(const lmp_brdf *brdf, const double wi[3], const double wo[3],
                                  double rgb[3]);

/* What a BRDF is. */
typedef struct lmp_brdf_info {
    lmp_brdf_kind kind;
    bool anisotropic; /* rotating the surface around its normal changes it */
    bool mirrored;    /* isotropic, and exactly unchanged under y -> -y */
    bool measured;    /* cells of a file: finer quadrature than `rings` finds only their edges */
    bool spectral;    /* an RGL file with spectra, converted to RGB */
    int shape[3];     /* MERL: cells of theta_h, theta_d, phi_d; RGL: nodes of phi_i, theta_i */
    int rings;        /* quadrature rings that resolve it, or 0 where nothing limits them */
    size_t bytes;     /* memory it holds */
} lmp_brdf_info;
LMP_API lmp_brdf_info lmp_brdf_describe(const lmp_brdf *brdf);

/* --- parametric --------------------------------------------------------------------------------
 * The caller owns *brdf, which is NULL on failure, and frees it with lmp_brdf_destroy.
 * LMP_ERROR_ARGUMENT: a value that is not finite or outside its range. */

/* albedo/pi; albedo >= 0. */
LMP_API lmp_result lmp_brdf_create_lambert(const lmp_host *host, lmp_rgb albedo, lmp_brdf **brdf);

/* reflectance (e+2)/(2 pi) max(wi·r, 0)^e, r the mirror direction of wo: reflects `reflectance` of
 * the light seen head-on (Lafortune and Willems 1994). exponent >= 0, reflectance >= 0. */
LMP_API lmp_result lmp_brdf_create_phong(const lmp_host *host, lmp_rgb reflectance, float exponent,
                                         lmp_brdf **brdf);

/* Microfacets: GGX normals (Walter et al. 2007), height-correlated Smith masking, Schlick's
 * Fresnel term F; what it lets through, 1 - F, of diffuse/pi: glTF 2.0, appendix B. Anisotropic
 * where the alphas differ. */
typedef struct lmp_ggx {
    float alpha_x, alpha_y; /* widths along x and y, 0.001 … 1; alpha_y 0 means alpha_x */
    lmp_rgb f0;             /* reflectance at normal incidence, 0 … 1 */
    lmp_rgb diffuse;        /* albedo of the diffuse part, >= 0 */
} lmp_ggx;
LMP_API lmp_result lmp_brdf_create_ggx(const lmp_host *host, const lmp_ggx *ggx, lmp_brdf **brdf);

/* Cloth, as KHR_materials_sheen has it with the distribution and the visibility that it calls
 * Charlie: fibers over a diffuse base, which has what they leave, 1 - max(color) E, E their albedo
 * toward the light or the view, whichever is more. Where those formulas reflect more than arrives,
 * at grazing angles of roughnesses below 0.3, they are divided by the larger excess of the two. */
typedef struct lmp_sheen {
    float roughness; /* 0.07 … 1: how much the fibers diverge from the normal */
    lmp_rgb color;   /* of the fibers, 0 … 1 */
    lmp_rgb diffuse; /* albedo of the base, >= 0 */
} lmp_sheen;
LMP_API lmp_result lmp_brdf_create_sheen(const lmp_host *host, const lmp_sheen *sheen,
                                         lmp_brdf **brdf);

/* The shifted gamma distribution of Bagher, Soler and Holzschuch (2012), each member red, green,
 * blue; formula in docs/materials.md. */
typedef struct lmp_sgd {
    double rho_d[3], rho_s[3], alpha[3], p[3], f0[3], f1[3], k_ap[3];
    double lambda[3], c[3], k[3], theta0[3];
} lmp_sgd;
LMP_API lmp_result lmp_brdf_create_sgd(const lmp_host *host, const lmp_sgd *sgd, lmp_brdf **brdf);

/* The 100 materials of the MERL database as fitted by those authors, built in. A name is as in the
 * database ("gold-metallic-paint") or its alias. lmp_sgd_name: NULL past the end. lmp_sgd_find:
 * LMP_ERROR_ARGUMENT for an unknown name. */
LMP_API const char *lmp_sgd_name(size_t index);
LMP_API lmp_result lmp_sgd_find(const char *name, lmp_sgd *sgd);

/* --- measured files ----------------------------------------------------------------------------
 * Readers copy what they need: `data` may go once they return. LMP_ERROR_FORMAT: bytes that are not
 * such a file, of which *error tells; LMP_ERROR_MEMORY. Nothing in a file is believed that its size
 * does not bear out. */

/* MERL .binary (Matusik et al. 2003): int32 dimensions of theta_h, theta_d, phi_d, then a plane of
 * float64 for red, green and blue. Looked up by cell, as its authors do; negative cells (no data)
 * read as 0. Any dimensions that agree with `size`; NaN and infinity are errors. */
LMP_API lmp_result lmp_brdf_read_merl(const lmp_host *host, const void *data, size_t size,
                                      lmp_parse_error *error, lmp_brdf **brdf);

/* RGL .bsdf tensor file (Dupuy and Jakob 2018), isotropic or anisotropic (phi_i over a full, half
 * or quarter turn), RGB or spectral. Spectra become linear sRGB by the CIE 1931 observer (the
 * analytic fit of Wyman, Sloan and Shirley 2013) under an equal-energy illuminant, adapted so that
 * a flat spectrum is gray. lmp_brdf_eval divides the file's f_r cos theta_o by its cosine; tables
 * take the viewer as the file's first direction. */
LMP_API lmp_result lmp_brdf_read_rgl(const lmp_host *host, const void *data, size_t size,
                                     lmp_parse_error *error, lmp_brdf **brdf);

/* Writers: any BRDF sampled into a file's form. MERL: the value at each cell's center, 90 x 90 x
 * 180 (an anisotropic BRDF loses its anisotropy). RGL: RGB, resolution in docs/formats.md.
 *
 * *data receives *size bytes allocated by the host; release them through it (free() if NULL).
 * *data is NULL and *size 0 on failure. */
#define LMP_MERL_SIZE 34992012u
LMP_API lmp_result lmp_brdf_write_merl(const lmp_host *host, const lmp_brdf *brdf, void **data,
                                       size_t *size);
LMP_API lmp_result lmp_brdf_write_rgl(const lmp_host *host, const lmp_brdf *brdf, void **data,
                                      size_t *size);

/* --- tables ----------------------------------------------------------------------------------- */

typedef enum lmp_brdf_symmetry {
    LMP_BRDF_SYMMETRY_AUTO = 0, /* mirrored where the BRDF is so, exactly or to its own noise */
    LMP_BRDF_SYMMETRY_MIRROR,   /* m >= 0 alone: averages f_r with its mirror image */
    LMP_BRDF_SYMMETRY_NONE
} lmp_brdf_symmetry;

/* How to make a table; zero-initialize it, zero means the default. */
typedef struct lmp_brdf_table_desc {
    int bands;    /* 1 … LMP_BANDS_MAX; LMP_BRDF_BANDS_DEFAULT */
    int views;    /* angles theta_o, 2 … 1024; LMP_BRDF_VIEWS_DEFAULT, or of an isotropic BRDF
                     5/4 a band if that is more */
    int azimuths; /* angles phi_o of an anisotropic BRDF, 4 … 256; 32 */
    lmp_window window; /* as in lmp_sh_window; LMP_WINDOW_NONE */
    float window_size; /* bands */
    lmp_brdf_symmetry symmetry;
    float tolerance; /* the change, relative to a view's largest coefficient, that ends the doubling
                        of nodes; 1e-4 */
    int rings_max;   /* the most rings to double to, 16 … 2048; what the BRDF resolves, or 512 */
} lmp_brdf_table_desc;
#define LMP_BRDF_BANDS_DEFAULT    10
#define LMP_BRDF_VIEWS_DEFAULT    64
#define LMP_BRDF_AZIMUTHS_DEFAULT 32

typedef struct lmp_brdf_table lmp_brdf_table;

/* desc NULL: zero-initialized. The paper windows its 10 bands by LMP_WINDOW_HANNING. Takes seconds
 * to minutes, on all threads of the host. *table is NULL on failure, needs the BRDF no more, and is
 * freed with lmp_brdf_table_destroy. LMP_ERROR_ARGUMENT: a member outside its range. */
LMP_API lmp_result lmp_brdf_table_create(const lmp_host *host, const lmp_brdf_table_desc *desc,
                                         const lmp_brdf *brdf, lmp_brdf_table **table);
LMP_API void lmp_brdf_table_destroy(lmp_brdf_table *table);

/* What a table is. View v has theta_o = v theta_step, the last half a step before the horizon;
 * azimuth a has phi_o = 2 pi a / azimuths. */
typedef struct lmp_brdf_table_info {
    int bands, views;
    int azimuths;      /* 1: isotropic */
    bool mirrored;     /* m >= 0 alone: index l(l+1)/2 + m; otherwise l*l + l + m */
    size_t count;      /* coefficients of a view and channel: n(n+1)/2 or n² */
    lmp_window window; /* already applied */
    float window_size;
    int rings;        /* the most rings any view took */
    float change;     /* largest relative change at the last doubling of any view */
    float theta_step; /* radians */
} lmp_brdf_table_info;
LMP_API lmp_brdf_table_info lmp_brdf_table_describe(const lmp_brdf_table *table);

/* All coefficients: [azimuth][view][channel][count], in the frame of the view, whose x-z plane
 * holds wo with x >= 0. */
LMP_API const float *lmp_brdf_table_coefficients(const lmp_brdf_table *table);

/* Coefficients for any view, between the table's by cubic interpolation (Catmull-Rom) in theta_o
 * and phi_o.
 *
 * phi_o is ignored by an isotropic table; cos_theta_o is clamped to 0 … 1
 * rgb receives 3 planes of `count` values, in the frame of the view */
LMP_API void lmp_brdf_table_view(const lmp_brdf_table *table, float cos_theta_o, float phi_o,
                                 float *rgb);

/* The part of the light that a view reflects: ∫ f_r cos theta_i dw under radiance 1, of the BRDF,
 * and of its truncated and windowed series over the same hemisphere. */
LMP_API void lmp_brdf_table_albedo(const lmp_brdf_table *table, int view, int azimuth,
                                   lmp_rgb *whole, lmp_rgb *series);

/* Coefficients for one view, in the material's own frame, unwindowed: rgb receives 3 planes of
 * LMP_SH_COUNT(bands) values.
 *
 * rings Gauss-Legendre rings of 2*rings azimuths; wo.z > 0 */
LMP_API lmp_result lmp_brdf_project(const lmp_host *host, int bands, int rings,
                                    const lmp_brdf *brdf, lmp_vec3 wo, float *rgb);

/* The file format .lmpt (docs/formats.md): little-endian, versioned, checksummed; the same bytes
 * from the same table on any machine.
 *
 * bytes receives lmp_brdf_table_size(table) bytes */
LMP_API size_t lmp_brdf_table_size(const lmp_brdf_table *table);
LMP_API void lmp_brdf_table_write(const lmp_brdf_table *table, void *bytes);
LMP_API lmp_result lmp_brdf_table_read(const lmp_host *host, const void *data, size_t size,
                                       lmp_parse_error *error, lmp_brdf_table **table);

#ifdef __cplusplus
}
#endif
#endif
