/* SPDX-License-Identifier: MIT */
/* Evaluation of the adaptive parameterisation of Dupuy and Jakob (2018). */
#include "src/brdf/rgl.h"

#include <math.h>

double lmpi_rgl_theta(const double w[3]) {
    const double chord2 = w[0] * w[0] + w[1] * w[1] + (w[2] - 1) * (w[2] - 1);
    return 2 * asin(fmin(sqrt(chord2) / 2, 1));
}

/* Finds the cell of x in ascending nodes and the fraction of its upper end; a single node has no
 * cell. */
static int find_node(const float *nodes, int count, double x, double *fraction) {
    *fraction = 0;
    if (count < 2)
        return 0;
    int low = 0, high = count - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if ((double)nodes[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    const double a = (double)nodes[low], b = (double)nodes[low + 1];
    *fraction = fmin(fmax((x - a) / (b - a), 0), 1);
    return low;
}

rgl_slices lmpi_rgl_slices(const brdf_rgl *rgl, double theta, double phi) {
    double p = 0, t = 0;
    const int i = find_node(rgl->phi, rgl->phi_count, phi, &p);
    const int j = find_node(rgl->theta, rgl->theta_count, theta, &t);
    const int i1 = i + 1 < rgl->phi_count ? i + 1 : i;
    const int j1 = j + 1 < rgl->theta_count ? j + 1 : j;
    const size_t n = (size_t)rgl->theta_count;
    const size_t row0 = (size_t)i * n, row1 = (size_t)i1 * n;
    return (rgl_slices) {
        { row0 + (size_t)j, row0 + (size_t)j1, row1 + (size_t)j, row1 + (size_t)j1 },
        { (1 - p) * (1 - t), (1 - p) * t, p * (1 - t), p * t },
    };
}

size_t lmpi_rgl_accumulate(brdf_rgl *rgl) {
    const size_t slices = (size_t)rgl->phi_count * (size_t)rgl->theta_count;
    const size_t width = (size_t)rgl->vndf_width, height = (size_t)rgl->vndf_height;
    for (size_t slice = 0; slice < slices; slice++) {
        float *density = rgl->density + slice * width * height;
        float *conditional = rgl->conditional + slice * width * height;
        float *marginal = rgl->marginal + slice * height;
        double total = 0, before = 0;
        for (size_t y = 0; y < height; y++) {
            double sum = 0;
            for (size_t x = 1; x < width; x++)
                sum += ((double)density[y * width + x - 1] + (double)density[y * width + x]) / 2;
            total += y > 0 ? (before + sum) / 2 : 0;
            before = sum;
        }
        const double scale = 1 / total;
        if (!(total > 0 && isfinite(scale)))
            return slice;
        double rows = 0;
        for (size_t y = 0; y < height; y++) {
            double sum = 0;
            for (size_t x = 0; x < width; x++) {
                const size_t i = y * width + x;
                if (x > 0)
                    sum += ((double)density[i - 1] + (double)density[i] * scale) / 2;
                density[i] = (float)((double)density[i] * scale);
                conditional[i] = (float)sum;
            }
            rows += y > 0 ? (before + sum) / 2 : 0;
            before = sum;
            marginal[y] = (float)rows;
        }
    }
    return slices;
}

/* Finds a cell of a grid: its lower corner and the position in it. */
static size_t grid_cell(double u, int count, double *fraction) {
    const double position = fmin(fmax(u, 0), 1) * (count - 1);
    const int cell = count < 2 ? 0 : (int)position < count - 2 ? (int)position : count - 2;
    *fraction = position - cell;
    return (size_t)cell;
}

/* Sums the slices' values at one offset in their tables. */
static double mix(const float *tables, size_t stride, const rgl_slices *slices, size_t offset) {
    double sum = 0;
    for (int k = 0; k < 4; k++)
        if (slices->weight[k] > 0)
            sum += slices->weight[k] * (double)tables[slices->index[k] * stride + offset];
    return sum;
}

void lmpi_rgl_warp(const brdf_rgl *rgl, const rgl_slices *slices, const double u[2], double s[2]) {
    const size_t width = (size_t)rgl->vndf_width, stride = width * (size_t)rgl->vndf_height;
    double fx, fy;
    const size_t x = grid_cell(u[0], rgl->vndf_width, &fx);
    const size_t y = grid_cell(u[1], rgl->vndf_height, &fy);
    const size_t at = y * width + x, end = y * width + width - 1;
    const double d00 = mix(rgl->density, stride, slices, at);
    const double d01 = mix(rgl->density, stride, slices, at + 1);
    const double d10 = mix(rgl->density, stride, slices, at + width);
    const double d11 = mix(rgl->density, stride, slices, at + width + 1);
    const double c0 = mix(rgl->conditional, stride, slices, at);
    const double c1 = mix(rgl->conditional, stride, slices, at + width);
    const double r0 = mix(rgl->conditional, stride, slices, end);
    const double r1 = mix(rgl->conditional, stride, slices, end + width);
    const double left = d00 + fy * (d10 - d00), right = d01 + fy * (d11 - d01);
    const double row = r0 + fy * (r1 - r0);
    const double along = fx * (left + fx * (right - left) / 2) + c0 + fy * (c1 - c0);
    /* a row of zeros has no density to follow */
    s[0] = row > 0 ? along / row : u[0];
    s[1] = fy * (r0 + fy * (r1 - r0) / 2) + mix(rgl->marginal, (size_t)rgl->vndf_height, slices, y);
}

double lmpi_rgl_bilinear(const brdf_grid *grid, const double s[2]) {
    double fx, fy;
    const size_t x = grid_cell(s[0], grid->width, &fx), y = grid_cell(s[1], grid->height, &fy);
    const size_t right = grid->width > 1, down = grid->height > 1 ? (size_t)grid->width : 0;
    const float *v = grid->values + y * (size_t)grid->width + x;
    const double top = (double)v[0] + fx * ((double)v[right] - (double)v[0]);
    const double low = (double)v[down] + fx * ((double)v[down + right] - (double)v[down]);
    return top + fy * (low - top);
}

/* Brings phi_i into the part of the turn that the file covers, and moves both directions by the
 * symmetry: a half turn, or mirrors in x and y. */
static void fold(const brdf_rgl *rgl, double a[3], double b[3]) {
    const double middle = ((double)rgl->phi[0] + (double)rgl->phi[rgl->phi_count - 1]) / 2;
    const double x = cos(middle), y = sin(middle);
    if (rgl->symmetry == 2 && a[0] * x + a[1] * y < 0)
        for (int k = 0; k < 2; k++) {
            a[k] = -a[k];
            b[k] = -b[k];
        }
    if (rgl->symmetry == 4)
        for (int k = 0; k < 2; k++)
            if (a[k] * (k ? y : x) < 0) {
                a[k] = -a[k];
                b[k] = -b[k];
            }
}

/* Adds whole turns to phi, to bring it within half a turn of the middle of the file's nodes. */
static double wrap_phi(const brdf_rgl *rgl, double phi) {
    const double middle = ((double)rgl->phi[0] + (double)rgl->phi[rgl->phi_count - 1]) / 2;
    const double turns = (phi - middle) / (2 * BRDF_PI);
    return middle + (turns - floor(turns + 0.5)) * 2 * BRDF_PI;
}

void lmpi_rgl_eval(const lmp_brdf *brdf, const double first[3], const double second[3],
                   double rgb[3]) {
    const brdf_rgl *rgl = &brdf->rgl;
    double a[3] = { first[0], first[1], first[2] }, b[3] = { second[0], second[1], second[2] };
    fold(rgl, a, b);
    double m[3];
    lmpi_brdf_half_vector(a, b, m);
    const double theta_a = lmpi_rgl_theta(a), phi_a = atan2(a[1], a[0]);
    const double phi_m = atan2(m[1], m[0]) - (rgl->isotropic ? phi_a : 0);
    const double turns = (phi_m + BRDF_PI) / (2 * BRDF_PI);
    const double u_a[2] = { sqrt(theta_a * 2 / BRDF_PI), (phi_a + BRDF_PI) / (2 * BRDF_PI) };
    const double u_m[2] = { sqrt(lmpi_rgl_theta(m) * 2 / BRDF_PI), turns - floor(turns) };
    const rgl_slices slices =
        lmpi_rgl_slices(rgl, theta_a, rgl->isotropic ? phi_a : wrap_phi(rgl, phi_a));
    double s[2];
    lmpi_rgl_warp(rgl, &slices, u_m, s);
    double factor = 1 / b[2];
    if (rgl->jacobian) {
        const double sigma = lmpi_rgl_bilinear(&rgl->sigma, u_a);
        factor = sigma > 0 ? factor * lmpi_rgl_bilinear(&rgl->ndf, u_m) / (4 * sigma) : 0;
    }
    const size_t plane = (size_t)rgl->rgb_width * (size_t)rgl->rgb_height;
    for (size_t c = 0; c < 3; c++) {
        double value = 0;
        for (int k = 0; k < 4; k++) {
            if (!(slices.weight[k] > 0))
                continue;
            const brdf_grid grid = { rgl->rgb_height, rgl->rgb_width,
                                     rgl->rgb + (3 * slices.index[k] + c) * plane };
            value += slices.weight[k] * lmpi_rgl_bilinear(&grid, s);
        }
        rgb[c] = fmax(0, value) * factor;
    }
}
