/* SPDX-License-Identifier: MIT */
/* lampion/sh.h - real spherical harmonics: evaluation, rotation, windows, projection, products.
 *
 * Words and conventions
 *   bands       n: degrees l = 0 … n-1, n*n coefficients. Never "order": libraries disagree.
 *   index       l*l + l + m, m from -l to l: (0,0) (1,-1) (1,0) (1,1) (2,-2) …
 *   basis       real, orthonormal, paper Eq. 1-2 with the Condon-Shortley sign, as in Sloan,
 *               DirectXMath and Google's library: Y_1 = 0.4886 * (-y, z, -x). Files without that
 *               sign differ by (-1)^m
 *   projection  f_lm = ∫ f(w) Y_lm(w) dw (paper Eq. 5);  ∫ f g dw = Σ f_lm g_lm (paper Eq. 4)
 *   arrays      coefficients (sh, a, b, c …) hold LMP_SH_COUNT(bands) values, arrays with one value
 *               per band (weights, zonal) `bands`; they must not overlap unless a function says so
 *
 * bands is in 1 … LMP_BANDS_MAX everywhere, and directions and axes are unit. A release build,
 * which does not check (base.h), evaluates the polynomials at directions that are not unit; arrays
 * that overlap where they must not give wrong values, and too many bands lead outside the
 * arrays. */
#ifndef LAMPION_SH_H
#define LAMPION_SH_H

#include <lampion/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Number of coefficients of `bands` bands, and the index of (l, m) among them. */
#define LMP_SH_COUNT(bands) (LMP_CAST(size_t, bands) * LMP_CAST(size_t, bands))
#define LMP_SH_INDEX(l, m)  LMP_CAST(size_t, (l) * (l) + (l) + (m))

/* The count and the index where only m >= 0 is kept, for functions unchanged under y -> -y. */
#define LMP_SH_HALF_COUNT(bands) (LMP_CAST(size_t, bands) * (LMP_CAST(size_t, bands) + 1) / 2)
#define LMP_SH_HALF_INDEX(l, m)  LMP_CAST(size_t, (l) * ((l) + 1) / 2 + (m))

/* Number of floats in a rotation: a matrix of (2l+1)^2 for each l = 0 … bands-1, in that order. */
#define LMP_SH_ROTATION_COUNT(bands) ((4 * LMP_SH_COUNT(bands) - 1) * LMP_CAST(size_t, bands) / 3)

/* Evaluates Y_lm(direction) for all l < bands (paper Eq. 1) in Cartesian form, without
 * singularities at the poles. */
LMP_API void lmp_sh_eval(int bands, lmp_vec3 direction, float *sh);

/* Evaluates Y_lm and its surface gradient, which is perpendicular to the direction: the derivatives
 * of Y_lm(v / |v|) with respect to x, y, z at v = direction. gradient receives three planes of
 * LMP_SH_COUNT(bands) values: d/dx, d/dy, d/dz. */
LMP_API void lmp_sh_eval_gradient(int bands, lmp_vec3 direction, float *sh, float *gradient);

/* Combines two functions into s a + t b: a sum, a difference, an interpolation. sh may be a or
 * b. */
LMP_API void lmp_sh_combine(int bands, float s, const float *a, float t, const float *b, float *sh);

/* Returns Σ a_i b_i, the integral of the functions' product (paper Eq. 4). */
LMP_API float lmp_sh_dot(int bands, const float *a, const float *b);

/* Returns the value at `direction` of the function with coefficients sh (paper Eq. 6). */
LMP_API float lmp_sh_reconstruct(int bands, const float *sh, lmp_vec3 direction);

/* Expands a function symmetric around `axis` (paper Eq. 3, 13). zonal[l] is its coefficient of Y_l0
 * in the frame whose z is the axis. */
LMP_API void lmp_sh_expand_zonal(int bands, const float *zonal, lmp_vec3 axis, float *sh);

/* Makes the matrices M^l of f'(w) = f(R^-1 w): c'_l = M^l c_l, so that M^l Y_l(w) = Y_l(R w).
 *
 * rotation must not be zero, and is normalized; matrices receives LMP_SH_ROTATION_COUNT(bands)
 * values, each matrix row-major */
LMP_API void lmp_sh_make_rotation(int bands, lmp_quat rotation, float *matrices);

/* Makes the matrices of lmp_sh_make_rotation from a row-major matrix, which must be a rotation up
 * to rounding (LMP_UNIT_TOLERANCE). */
LMP_API void lmp_sh_make_rotation_from_matrix(int bands, const float rotation[9], float *matrices);

/* Rotates coefficients by `angle` radians around z, from x toward y: O(bands²), without matrices.
 * sh and rotated may be the same array. */
LMP_API void lmp_sh_rotate_z(int bands, float angle, const float *sh, float *rotated);

/* Rotates coefficients by the matrices of lmp_sh_make_rotation, not in place. */
LMP_API void lmp_sh_rotate(int bands, const float *matrices, const float *sh, float *rotated);

/* Rotates coefficients by a rotation that only a few functions share: no matrices are made, and up
 * to LMP_SH_FEW_BANDS bands it is as fast as lmp_sh_rotate.
 *
 * rotation as for lmp_sh_make_rotation_from_matrix; not in place */
LMP_API void lmp_sh_rotate_by_matrix(int bands, const float rotation[9], const float *sh,
                                     float *rotated);

/* Windowing filters damp the ringing of a truncated series by scaling band l by a weight (Sloan
 * 2008). Apply a window once, to the material, never to both light and material. */
typedef enum lmp_window {
    LMP_WINDOW_NONE = 0,
    LMP_WINDOW_HANNING, /* (1 + cos(pi l / size)) / 2 */
    LMP_WINDOW_LANCZOS  /* sin(pi l / size) / (pi l / size) */
} lmp_window;
#define LMP_WINDOW_COUNT (LMP_WINDOW_LANCZOS + 1)

/* Returns "none", "hanning" …; NULL from LMP_WINDOW_COUNT on. */
LMP_API const char *lmp_sh_window_name(lmp_window window);

/* Computes a windowing filter's weights. size is the band where the weight falls to 0, as it does
 * beyond; 0 means `bands`, as in the paper (§4.2). LMP_WINDOW_NONE gives every band the weight 1,
 * at any size. */
LMP_API void lmp_sh_make_window(int bands, lmp_window window, float size, float *weights);

/* Computes weights that reduce the squared Laplacian of the function sh (Sloan 2008):
 * 1 / (1 + mu l^2 (l+1)^2), with mu such that the fraction `keep` of it, 0 < keep <= 1, remains. */
LMP_API void lmp_sh_make_laplacian_window(int bands, float keep, const float *sh, float *weights);

/* Scales band l of sh by weights[l]; windowed may be sh. */
LMP_API void lmp_sh_apply_window(int bands, const float *weights, const float *sh, float *windowed);

/* A function on the sphere, to be projected; direction is unit. */
typedef float (*lmp_sh_function)(lmp_vec3 direction, void *user);

/* Projects any function (paper Eq. 5) with Gauss-Legendre nodes in z times uniform nodes in
 * azimuth: exact, up to rounding, for functions band-limited to degree 2*nodes - bands. `function`
 * is called at `nodes` heights times 2*nodes azimuths; nodes = 0 means `bands`, enough for a
 * function of as many bands. For a function with a step at the equator use an even number: an odd
 * one puts nodes on it. */
LMP_API void lmp_sh_project_function(int bands, int nodes, lmp_sh_function function, void *user,
                                     float *sh);

/* Projects a color, evaluated once per direction, onto three planes: red, green, blue. */
typedef lmp_rgb (*lmp_sh_function_rgb)(lmp_vec3 direction, void *user);
LMP_API void lmp_sh_project_function_rgb(int bands, int nodes, lmp_sh_function_rgb function,
                                         void *user, float *sh);

/* The texels of an image, which may have any number of channels, interleaved or planar. Strides of
 * 0 mean tight and interleaved. A texel counts as constant, evaluated at its center and weighted by
 * its exact solid angle: use images of at least 4 * bands rows. Sums are taken in double, with
 * bands² / 2 multiplications and additions per texel and channel. */
typedef enum lmp_texel { LMP_TEXEL_FLOAT = 0, LMP_TEXEL_HALF } lmp_texel;

/* A latitude-longitude image of the surroundings; zero-initialize it. The upper edge of row 0 is up
 * (+y). The center column shows +x and columns run toward +z, u = 1/2 + atan2(z, x) / 2 pi, as in
 * three.js and in the sample viewer of glTF. */
typedef struct lmp_latlong {
    const void *pixels;
    int width, height, channels;
    lmp_texel texel;
    size_t row_stride, texel_stride, channel_stride;
    float azimuth; /* of the center column, radians from +x toward +z */
    bool mirrored; /* columns run from +z toward -z: the surroundings as seen in a mirror */
    bool z_up;     /* for z-up worlds: (x, y, z) of a y-up world is (x, -z, y) there */
} lmp_latlong;

/* Projects a latitude-longitude image onto as many planes as it has channels. */
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
    bool left_handed; /* the map is of a left-handed world, like Direct3D's: its z is -z here */
} lmp_cubemap;

/* Projects a cube map onto as many planes as it has channels. */
LMP_API void lmp_sh_project_cubemap(int bands, const lmp_cubemap *map, float *sh);

/* Multiplies two functions: c receives the first `bands` bands of the product of a and b, exact up
 * to rounding: c_k = Σ Γ_ijk a_i b_j, Γ_ijk = ∫ Y_i Y_j Y_k. Exchanging a and b gives the same
 * bits.
 *
 * 1 … LMP_SH_FEW_BANDS bands */
#define LMP_SH_FEW_BANDS 6
LMP_API void lmp_sh_multiply_few(int bands, const float *a, const float *b, float *c);

/* A precomputed quadrature grid for products of any number of bands. It is immutable: share it
 * freely. */
typedef struct lmp_sh_product lmp_sh_product;

/* Makes the grid; on failure (LMP_ERROR_ARGUMENT: bands is out of range) *product is NULL, which
 * lmp_sh_product_destroy accepts. */
LMP_API lmp_result lmp_sh_product_create(const lmp_host *host, int bands, lmp_sh_product **product);
LMP_API void lmp_sh_product_destroy(lmp_sh_product *product);

/* Multiplies two functions as lmp_sh_multiply_few does, with the bands of the product object. */
LMP_API void lmp_sh_multiply(const lmp_sh_product *product, const float *a, const float *b,
                             float *c);

/* --- batches ------------------------------------------------------------------------------------
 * Functions whose names end in _n, here and in other headers, do the work of their twins for many
 * elements, with the widest instruction set of the machine. Results agree up to rounding, and have
 * the same bits on every machine and however the elements are split among threads.
 *
 * A result of V values per element is laid out
 *   LMP_SH_INTERLEAVED  element after element, as engines store it: `stride` bytes from one element
 *                       to the next, its values side by side
 *   LMP_SH_PLANAR       value after value, the faster one: `stride` bytes from one value's plane to
 *                       the next, the elements side by side. If that is a power of two, planes
 *                       compete for the same cache lines: pad it
 * Stride 0 means tight; padding is left untouched. */
typedef enum lmp_sh_layout { LMP_SH_INTERLEAVED = 0, LMP_SH_PLANAR } lmp_sh_layout;

/* Where a batch's coefficients go. */
typedef struct lmp_sh_array {
    float *at;
    size_t stride;
    lmp_sh_layout layout;
} lmp_sh_array;
static inline lmp_sh_array lmp_sh_interleaved(float *at, size_t stride) {
    const lmp_sh_array array = { at, stride, LMP_SH_INTERLEAVED };
    return array;
}
static inline lmp_sh_array lmp_sh_planar(float *at, size_t stride) {
    const lmp_sh_array array = { at, stride, LMP_SH_PLANAR };
    return array;
}

/* Evaluates Y_lm in many directions, as lmp_sh_eval: LMP_SH_COUNT(bands) values per element. */
LMP_API void lmp_sh_eval_n(int bands, lmp_vec3_array directions, size_t count, lmp_sh_array sh);

/* Evaluates Y_lm and its surface gradient in many directions: gradient receives d/dx, then d/dy,
 * d/dz, 3 * LMP_SH_COUNT(bands) values per element. */
LMP_API void lmp_sh_eval_gradient_n(int bands, lmp_vec3_array directions, size_t count,
                                    lmp_sh_array sh, lmp_sh_array gradient);

/* Computes lmp_sh_dot of many pairs, a and b laid out alike; dots receives `count` values. */
LMP_API void lmp_sh_dot_n(int bands, lmp_sh_layout layout, size_t stride, const float *a,
                          const float *b, size_t count, float *dots);

/* Rotates many functions by the same matrices, not in place; sh and rotated are laid out alike. */
LMP_API void lmp_sh_rotate_n(int bands, const float *matrices, const float *sh, size_t count,
                             lmp_sh_array rotated);

/* Convert between floats and IEEE 754's binary16, which shaders and textures take. Any array will
 * do, including a batch's result with its padding. Values are rounded to nearest, ties to even,
 * from 65520 on to infinity; the smallest half above 0 is 2^-24. NaN stays NaN.
 *
 * values and halves must not overlap */
LMP_API void lmp_sh_pack_half_n(const float *values, size_t count, uint16_t *halves);
LMP_API void lmp_sh_unpack_half_n(const uint16_t *halves, size_t count, float *values);

/* --- in double -----------------------------------------------------------------------------------
 * For research: within 1e-13 of the exact values up to 20 bands (docs/accuracy.md), with the same
 * bits on every machine. One element per call and not vectorized, because the kernels' tables are
 * floats. The contracts are those of the functions without _double. */

/* Evaluates Y_lm(direction) in double, as lmp_sh_eval does in float. */
LMP_API void lmp_sh_eval_double(int bands, const double direction[3], double *sh);

/* Evaluates Y_lm and its surface gradient in double; gradient may be NULL. */
LMP_API void lmp_sh_eval_gradient_double(int bands, const double direction[3], double *sh,
                                         double *gradient);

/* Evaluates the second derivatives of Y_lm(v / |v|) with respect to x, y, z at v = direction: six
 * planes of LMP_SH_COUNT(bands) values, d²/dx², dx dy, dx dz, dy², dy dz, dz². Their trace is
 * -l(l+1) Y_lm. */
LMP_API void lmp_sh_eval_hessian_double(int bands, const double direction[3], double *hessian);

/* Make the matrices of a rotation, given as a quaternion x, y, z, w, and rotate coefficients by
 * them. */
LMP_API void lmp_sh_make_rotation_double(int bands, const double rotation[4], double *matrices);
LMP_API void lmp_sh_rotate_double(int bands, const double *matrices, const double *sh,
                                  double *rotated);

#ifdef __cplusplus
}
#endif
#endif
