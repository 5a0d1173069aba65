/* SPDX-License-Identifier: MIT */
/* brdf.h - what the files of this module share. */
#ifndef LAMPION_BRDF_BRDF_H
#define LAMPION_BRDF_BRDF_H

#include <lampion/brdf.h>

#include "src/base/bytes.h"
#include "src/base/host.h"
#include "src/base/parse_error.h"

#define BRDF_PI 3.14159265358979323846

typedef struct brdf_phong {
    double reflectance[3], exponent;
} brdf_phong;

typedef struct brdf_ggx {
    double alpha_x, alpha_y, f0[3], diffuse[3];
} brdf_ggx;

/* Values for white sheen by the square root of the view's cosine, 0 to 1: how many times more
 * light than arrives from a uniform sky the specification has them reflect (not used below 1), and
 * what they do reflect. */
#define BRDF_SHEEN_ALBEDOS 129
typedef struct brdf_sheen {
    double alpha, color[3], diffuse[3], gain[BRDF_SHEEN_ALBEDOS], albedo[BRDF_SHEEN_ALBEDOS];
} brdf_sheen;

typedef struct brdf_merl {
    int shape[3];
    float *samples; /* [theta_h][theta_d][phi_d][rgb], scaled to sr⁻¹ */
} brdf_merl;

/* A plane of samples over the unit square; columns run along the first coordinate. */
typedef struct brdf_grid {
    int height, width;
    const float *values;
} brdf_grid;

typedef struct brdf_rgl {
    int phi_count, theta_count;
    bool isotropic, jacobian;
    int symmetry;       /* the file covers 1/symmetry of a turn of phi_i: 1, 2 or 4 */
    const float *phi;   /* [phi_count] */
    const float *theta; /* [theta_count] */
    brdf_grid ndf, sigma;
    int vndf_height, vndf_width;
    float *density;     /* [phi][theta][height][width], integral 1 */
    float *conditional; /* the same shape as density: its integral along a row up to here */
    float *marginal;    /* [phi][theta][height]: integral of the rows up to here */
    int rgb_height, rgb_width;
    float *rgb; /* [phi][theta][channel][height][width] */
} brdf_rgl;

struct lmp_brdf {
    lmp_host host;
    lmp_brdf_info info;
    int rings_per_band; /* the least of a table by default, where info.rings limits them */
    /* Evaluates f_r of unit vectors above the surface; b is the direction whose cosine the file
     * includes. */
    void (*eval)(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]);
    /* Evaluates the mean of eval and its mirror image under y -> -y, with a in the x-z plane; may
     * be NULL. */
    void (*eval_mirrored)(const lmp_brdf *brdf, const double a[3], const double b[3],
                          double rgb[3]);
    union {
        double lambert[3];
        brdf_phong phong;
        brdf_ggx ggx;
        brdf_sheen sheen;
        lmp_sgd sgd;
        brdf_merl merl;
        brdf_rgl rgl;
    };
};

/* Allocates one zeroed block, aligned for any type, for the object and `extra` bytes behind it. */
lmp_result lmpi_brdf_new(const lmp_host *host, lmp_brdf_kind kind, size_t extra, lmp_brdf **brdf);
static inline void *lmpi_brdf_extra(lmp_brdf *brdf) {
    return (unsigned char *)brdf + ((sizeof *brdf + 15) & ~(size_t)15);
}

/* Computes the unit half vector of a and b. */
void lmpi_brdf_half_vector(const double a[3], const double b[3], double h[3]);
static inline double brdf_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

#endif
