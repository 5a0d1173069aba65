/* SPDX-License-Identifier: MIT */
/* lampion/sh.h - real spherical harmonics: evaluation, rotation, windows, projection, products.
 *
 * Words and conventions
 *   bands       n: degrees l = 0 … n-1, n*n coefficients. Never "order": libraries disagree on it.
 *   index       l*l + l + m, m from -l to l: (0,0) (1,-1) (1,0) (1,1) (2,-2) …
 *   basis       real, orthonormal, paper Eq. 1-2 with the Condon-Shortley sign, as Sloan,
 *               DirectXMath and Google: Y_1 = 0.4886 * (-y, z, -x). Files without that sign differ
 *               by (-1)^m
 *   projection  f_lm = ∫ f(w) Y_lm(w) dw (paper Eq. 5);  ∫ f g dw = Σ f_lm g_lm (paper Eq. 4)
 *   arrays      coefficients (sh, a, b, c …) hold LMP_SH_COUNT(bands) values, what has one a band
 *               (weights, zonal) `bands`; they must not overlap unless a function says so
 *
 * bands is in 1 … LMP_BANDS_MAX everywhere, and directions and axes are unit. A release build,
 * which does not look (base.h), evaluates the polynomials at directions that are not; arrays that
 * overlap where they must not give wrong values, more bands lead outside arrays. */
#ifndef LAMPION_SH_H
#define LAMPION_SH_H

#include <lampion/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Number of coefficients of `bands` bands, and the index of (l, m) among them. */
#define LMP_SH_COUNT(bands) (LMP_CAST(size_t, bands) * LMP_CAST(size_t, bands))
#define LMP_SH_INDEX(l, m)  LMP_CAST(size_t, (l) * (l) + (l) + (m))

/* The same where m >= 0 alone is kept, of functions that are unchanged under y -> -y. */
#define LMP_SH_HALF_COUNT(bands) (LMP_CAST(size_t, bands) * (LMP_CAST(size_t, bands) + 1) / 2)
#define LMP_SH_HALF_INDEX(l, m)  LMP_CAST(size_t, (l) * ((l) + 1) / 2 + (m))

/* Floats of a rotation: the (2l+1)^2 matrices of l = 0 … bands-1, one after the other. */
#define LMP_SH_ROTATION_COUNT(bands) ((4 * LMP_SH_COUNT(bands) - 1) * LMP_CAST(size_t, bands) / 3)

/* Y_lm(direction) for all l < bands (paper Eq. 1), in Cartesian form: no angles, no poles. */
LMP_API void lmp_sh_eval(int bands, lmp_vec3 direction, float *sh);

/* Y_lm(direction) and its surface gradient, the derivatives of Y_lm(v / |v|) by x, y, z where v is
 * the direction, perpendicular to it. gradient receives three planes of LMP_SH_COUNT(bands) values,
 * d/dx, d/dy, d/dz */
LMP_API void lmp_sh_eval_gradient(int bands, lmp_vec3 direction, float *sh, float *gradient);

/* s a + t b, coefficient by coefficient: sums, differences, scaled and interpolated functions. sh
 * may be a or b. */
LMP_API void lmp_sh_combine(int bands, float s, const float *a, float t, const float *b, float *sh);

/* Σ a_i b_i: the integral of the product (paper Eq. 4). */
LMP_API float lmp_sh_dot(int bands, const float *a, const float *b);

/* The value at `direction` of the function with coefficients sh (paper Eq. 6). */
LMP_API float lmp_sh_reconstruct(int bands, const float *sh, lmp_vec3 direction);

/* Coefficients of a function symmetric around `axis` (paper Eq. 3, 13). zonal[l] is its coefficient
 * of Y_l0 in the frame whose z is the axis. */
LMP_API void lmp_sh_from_zonal(int bands, const float *zonal, lmp_vec3 axis, float *sh);

/* The matrices M^l of f'(w) = f(R^-1 w): c'_l = M^l c_l, so that M^l Y_l(w) = Y_l(R w).
 *
 * rotation must not be zero, and is normalized; matrices receives LMP_SH_ROTATION_COUNT(bands)
 * values, each matrix row-major */
LMP_API void lmp_sh_rotation(int bands, lmp_quat rotation, float *matrices);

/* The same from a matrix, row-major, that must be a rotation up to rounding (LMP_UNIT_TOLERANCE).
 */
LMP_API void lmp_sh_rotation_from_matrix(int bands, const float rotation[9], float *matrices);

/* Rotates coefficients by `angle` radians around z, from x toward y: O(bands²), without matrices.
 * sh and rotated may be the same array. */
LMP_API void lmp_sh_rotate_z(int bands, float angle, const float *sh, float *rotated);

/* Rotates coefficients by the matrices of lmp_sh_rotation, not in place. */
LMP_API void lmp_sh_rotate(int bands, const float *matrices, const float *sh, float *rotated);

/* The two in one, where a rotation has but a few functions to rotate: no matrices are made, and up
 * to LMP_SH_FEW_BANDS bands it takes as long as rotating by them does.
 *
 * rotation as for lmp_sh_rotation_from_matrix; not in place */
LMP_API void lmp_sh_rotate_by_matrix(int bands, const float rotation[9], const float *sh,
                                     float *rotated);

/* Windowing filters damp the ringing of a truncated series by scaling band l by a weight (Sloan
 * 2008). Apply one once, to the material, never to light and material both. */
typedef enum lmp_window {
    LMP_WINDOW_NONE = 0,
    LMP_WINDOW_HANNING, /* (1 + cos(pi l / size)) / 2 */
    LMP_WINDOW_LANCZOS, /* sin(pi l / size) / (pi l / size) */
    LMP_WINDOWS         /* how many there are */
} lmp_window;

/* "none", "hanning" …; NULL from LMP_WINDOWS on. */
LMP_API const char *lmp_sh_window_name(lmp_window window);

/* Weights of a windowing filter. size is the band whose weight falls to 0, as those past it; 0
 * means bands, as in the paper (§4.2). LMP_WINDOW_NONE gives 1 to every band, whatever the size. */
LMP_API void lmp_sh_window(int bands, lmp_window window, float size, float *weights);

/* Weights that minimize the squared Laplacian of the function sh (Sloan 2008): the window
 * 1 / (1 + mu l^2 (l+1)^2) whose mu leaves the fraction `keep`, 0 < keep <= 1, of it. */
LMP_API void lmp_sh_window_laplacian(int bands, float keep, const float *sh, float *weights);

/* Scales band l of sh by weights[l]; windowed may be sh. */
LMP_API void lmp_sh_window_apply(int bands, const float *weights, const float *sh, float *windowed);

/* A function on the sphere, for projection; direction is unit. */
typedef float (*lmp_sh_function)(lmp_vec3 direction, void *user);

/* Coefficients of any function (paper Eq. 5) by Gauss-Legendre nodes in z times uniform nodes in
 * azimuth: exact, up to rounding, for functions band-limited to degree 2*nodes - bands. `function`
 * is called at `nodes` heights times 2*nodes azimuths; 0 means bands, enough for as many bands. Of
 * a function with a step at the equator take an even number: an odd one has nodes on it. */
LMP_API void lmp_sh_project_function(int bands, int nodes, lmp_sh_function function, void *user,
                                     float *sh);

/* The same of a color, which is asked for each direction once: three planes, red, green, blue. */
typedef lmp_rgb (*lmp_sh_function_rgb)(lmp_vec3 direction, void *user);
LMP_API void lmp_sh_project_function_rgb(int bands, int nodes, lmp_sh_function_rgb function,
                                         void *user, float *sh);

/* Texels of an image: any number of channels, interleaved or planar. Strides 0 mean tight and
 * interleaved. A texel counts as a constant seen at its center, weighted by its exact solid angle:
 * take images of at least 4 * bands rows. Sums are in double; bands² / 2 multiplications and
 * additions a texel and channel. */
typedef enum lmp_texel { LMP_TEXEL_FLOAT = 0, LMP_TEXEL_HALF } lmp_texel;

/* A latitude-longitude image of the surroundings; zero-initialize it. Row 0 touches up (+y). The
 * center column shows +x and columns run toward +z, u = 1/2 + atan2(z, x) / 2 pi, as in three.js
 * and in the sample viewer of glTF. */
typedef struct lmp_latlong {
    const void *pixels;
    int width, height, channels;
    lmp_texel texel;
    size_t row_stride, texel_stride, channel_stride;
    float azimuth; /* of the center column, radians from +x toward +z */
    bool mirrored; /* columns run from +z toward -z: the surroundings as seen in a mirror */
    bool z_up;     /* for worlds with z up: (x, y, z) of a world with y up is (x, -z, y) there */
} lmp_latlong;

/* Coefficients of a latitude-longitude image: as many planes as channels. */
LMP_API void lmp_sh_project_latlong(int bands, const lmp_latlong *image, float *sh);

/* A cube map; zero-initialize it. The faces are +x, -x, +y, -y, +z, -z, each `size` rows of `size`
 * texels, oriented as OpenGL, Vulkan and Direct3D store them (OpenGL 4.6, table 8.19): column and
 * row grow along -z and -y on +x, z and -y on -x, x and z on +y, x and -z on -y, x and -y on +z, -x
 * and -y on -z. */
typedef struct lmp_cubemap {
    const void *faces[6];
    int size, channels;
    lmp_texel texel;
    size_t row_stride, texel_stride, channel_stride;
    bool left_handed; /* the map is of a left-handed world, as Direct3D's: its z is -z here */
} lmp_cubemap;

/* Coefficients of a cube map: as many planes as channels. */
LMP_API void lmp_sh_project_cubemap(int bands, const lmp_cubemap *map, float *sh);

/* c = the first `bands` bands of the pointwise product of the functions a and b, exact up to
 * rounding, from the triple products Γ_ijk = ∫ Y_i Y_j Y_k: c_k = Σ Γ_ijk a_i b_j.
 *
 * 1 … LMP_SH_FEW_BANDS bands */
#define LMP_SH_FEW_BANDS 6
LMP_API void lmp_sh_multiply_few(int bands, const float *a, const float *b, float *c);

/* The same of any bands: beyond those a quadrature grid, which is made beforehand. Immutable; share
 * it freely. */
typedef struct lmp_sh_product lmp_sh_product;

/* *product is NULL on failure (LMP_ERROR_ARGUMENT: bands); lmp_sh_product_destroy accepts NULL. */
LMP_API lmp_result lmp_sh_product_create(const lmp_host *host, int bands, lmp_sh_product **product);
LMP_API void lmp_sh_product_destroy(lmp_sh_product *product);

/* c as lmp_sh_multiply_few, of the bands of the product object. */
LMP_API void lmp_sh_multiply(const lmp_sh_product *product, const float *a, const float *b,
                             float *c);

/* --- batches ------------------------------------------------------------------------------------
 * The functions that end in _n, here and in light.h and lobe.h, do the work of their twins for many
 * elements, on the widest instruction set of the machine. Results agree up to rounding, and are the
 * same bits on every machine and however the elements are split among threads.
 *
 * A result of V values an element is laid out
 *   LMP_SH_INTERLEAVED  element after element, as engines store it: `stride` bytes from one element
 *                       to the next, its values side by side
 *   LMP_SH_PLANAR       value after value, the faster one: `stride` bytes from one value's plane to
 *                       the next, the elements side by side. Where that is a power of two, planes
 *                       compete for the same lines of the cache: pad it
 * Stride 0 means tight; what lies between is left alone. */
typedef enum lmp_sh_layout { LMP_SH_INTERLEAVED = 0, LMP_SH_PLANAR } lmp_sh_layout;

/* lmp_sh_eval of many directions: LMP_SH_COUNT(bands) values an element. */
LMP_API void lmp_sh_eval_n(int bands, lmp_vec3_array directions, size_t count, lmp_sh_layout layout,
                           size_t stride, float *sh);

/* lmp_sh_eval_gradient of many directions: gradient receives 3 * LMP_SH_COUNT(bands) values an
 * element, d/dx, then d/dy, then d/dz, laid out as sh with a stride of its own. */
LMP_API void lmp_sh_eval_gradient_n(int bands, lmp_vec3_array directions, size_t count,
                                    lmp_sh_layout layout, size_t stride, float *sh,
                                    size_t gradient_stride, float *gradient);

/* lmp_sh_dot of many pairs, both laid out alike; dots receives `count` values. */
LMP_API void lmp_sh_dot_n(int bands, const float *a, const float *b, size_t count,
                          lmp_sh_layout layout, size_t stride, float *dots);

/* lmp_sh_rotate of many functions by the same matrices; sh and rotated are laid out alike. */
LMP_API void lmp_sh_rotate_n(int bands, const float *matrices, const float *sh, size_t count,
                             lmp_sh_layout layout, size_t stride, float *rotated);

/* Numbers of 16 bits, IEEE 754's binary16, which shaders and textures take: any array of values,
 * as what a batch wrote, gaps included, for buffers half as large. Each is rounded to the nearest,
 * ties to even; from 65520 on that is infinity, and the least above 0 is 2^-24. NaN stays NaN.
 *
 * values and halves must not overlap */
LMP_API void lmp_sh_pack_half(const float *values, size_t count, uint16_t *halves);
LMP_API void lmp_sh_unpack_half(const uint16_t *halves, size_t count, float *values);

/* --- in double -----------------------------------------------------------------------------------
 * For research: within 1e-13 of exact values to 20 bands (docs/accuracy.md), the same bits on every
 * machine. One element a call and no vectors, because the kernels' tables are floats. Contracts are
 * those of the functions without _double. */

/* Y_lm(direction). */
LMP_API void lmp_sh_eval_double(int bands, const double direction[3], double *sh);

/* gradient may be NULL: then it is not found. */
LMP_API void lmp_sh_eval_gradient_double(int bands, const double direction[3], double *sh,
                                         double *gradient);

/* The second derivatives of Y_lm(v / |v|) by x, y, z at v = direction: six planes of
 * LMP_SH_COUNT(bands) values, d²/dx², dx dy, dx dz, dy², dy dz, dz². Their trace is -l(l+1) Y_lm.
 */
LMP_API void lmp_sh_eval_hessian_double(int bands, const double direction[3], double *hessian);

/* rotation is a quaternion x, y, z, w. */
LMP_API void lmp_sh_rotation_double(int bands, const double rotation[4], double *matrices);
LMP_API void lmp_sh_rotate_double(int bands, const double *matrices, const double *sh,
                                  double *rotated);

#ifdef __cplusplus
}
#endif
#endif
