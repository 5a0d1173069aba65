/* SPDX-License-Identifier: MIT */
/* Sampling any BRDF into an RGL tensor file. The format stores f_r cos theta over a microfacet
 * model's own estimate, on a grid remapped so that samples crowd where visible normals do. Any
 * positive estimate makes a valid file; a good one makes it smooth. Here it is the distribution of
 * normals seen in retro-reflection, D(m) ~ 4 f_r(m, m) cos² theta_m. */
#include "src/brdf/rgl.h"

#include <math.h>

/* Nodes of the file: an isotropic one has one phi_i, an anisotropic one a full turn of them. */
#define THETA_COUNT        48
#define NDF_WIDTH          256
#define SIGMA_WIDTH        32
#define VNDF_WIDTH         128
#define VNDF_HEIGHT        64
#define SAMPLE_SIZE        64
#define ANISO_PHI_COUNT    33
#define ANISO_THETA_COUNT  12
#define ANISO_NDF_HEIGHT   65
#define ANISO_SIGMA_HEIGHT 17
#define ANISO_SAMPLE_SIZE  32
/* The last theta_i, a little above the horizon, where f_r is still defined. */
#define THETA_LAST (BRDF_PI / 2 - 2e-3)
/* A fraction of the density is spread evenly, so that every part of the hemisphere has samples. */
#define EVEN_FRACTION 0.2
#define NDF_FLOOR     1e-3

typedef struct writer {
    const lmp_brdf *brdf;
    brdf_rgl rgl; /* the file being made, as its reader will see it */
    float *phi, *theta, *ndf, *sigma, *luminance;
} writer;

static double luminance(const double rgb[3]) {
    return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

/* Finds the normal at coordinates u; an isotropic file counts phi from that of the view. */
static void normal_at(const double u[2], double phi_i, double m[3]) {
    const double theta = BRDF_PI / 2 * u[0] * u[0];
    const double phi = u[1] * 2 * BRDF_PI - BRDF_PI + phi_i;
    m[0] = sin(theta) * cos(phi);
    m[1] = sin(theta) * sin(phi);
    m[2] = cos(theta);
}

/* Finds (u, v) of node i of a grid. */
static void node_at(int width, int height, size_t i, double u[2]) {
    u[0] = (double)(i % (size_t)width) / (width - 1);
    u[1] = height > 1 ? (double)(i / (size_t)width) / (height - 1) : 0;
}

static void fill_angles(const writer *w) {
    for (int i = 0; i < w->rgl.theta_count; i++)
        w->theta[i] = (float)(THETA_LAST * i / (w->rgl.theta_count - 1));
    for (int i = 0; i < w->rgl.phi_count; i++)
        w->phi[i] =
            w->rgl.isotropic ? 0 : (float)(-BRDF_PI + 2 * BRDF_PI * i / (w->rgl.phi_count - 1));
}

/* Fills the distribution of normals from retro-reflection; its largest value is 1. */
static void fill_ndf(const writer *w) {
    const brdf_grid *grid = &w->rgl.ndf;
    const size_t count = (size_t)grid->width * (size_t)grid->height;
    double largest = 0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < count; i++) {
            double u[2], m[3], rgb[3];
            node_at(grid->width, grid->height, i, u);
            normal_at(u, 0, m);
            lmp_brdf_eval_double(w->brdf, m, m, rgb);
            const double d = luminance(rgb) * m[2] * m[2];
            if (pass == 0)
                largest = fmax(largest, d);
            else
                w->ndf[i] = (float)(largest > 0 ? fmax(d / largest, NDF_FLOOR) : 1);
        }
}

/* Fills the projected areas of the normals, ∫ D max(m·w, 0) dm, up to a factor, and each slice of
 * density. */
static void fill_densities(const writer *w) {
    const brdf_rgl *rgl = &w->rgl;
    const size_t plane = (size_t)rgl->vndf_width * (size_t)rgl->vndf_height;
    for (int p = 0; p < rgl->phi_count; p++)
        for (int t = 0; t < rgl->theta_count; t++) {
            const double theta = (double)w->theta[t], phi = (double)w->phi[p];
            const double a[3] = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
            float *density = rgl->density + (size_t)(p * rgl->theta_count + t) * plane;
            double sum = 0;
            for (size_t i = 0; i < plane; i++) {
                double u[2], m[3];
                node_at(rgl->vndf_width, rgl->vndf_height, i, u);
                normal_at(u, 0, m);
                const double solid = sqrt(1 - m[2] * m[2]) * u[0];
                const double d = lmpi_rgl_bilinear(&rgl->ndf, u) * fmax(brdf_dot(a, m), 0) * solid;
                density[i] = (float)d;
                sum += d;
            }
            for (size_t i = 0; i < plane; i++)
                density[i] += (float)(EVEN_FRACTION * sum / (double)plane);
        }
}

static void fill_sigma(const writer *w) {
    const brdf_grid *grid = &w->rgl.sigma;
    for (int t = 0; t < grid->width * grid->height; t++) {
        double u[2], a[3], sum = 0;
        node_at(grid->width, grid->height, (size_t)t, u);
        normal_at(u, 0, a);
        for (size_t i = 0; i < NDF_WIDTH; i++)
            for (int j = 0; j < 64; j++) {
                const double v[2] = { ((double)i + 0.5) / NDF_WIDTH, (j + 0.5) / 64 };
                double m[3];
                normal_at(v, 0, m);
                sum += lmpi_rgl_bilinear(&w->rgl.ndf, v) * fmax(brdf_dot(a, m), 0) *
                       sqrt(1 - m[2] * m[2]) * v[0];
            }
        w->sigma[t] = (float)(sum * BRDF_PI * 2 * BRDF_PI / (NDF_WIDTH * 64));
    }
}

/* Finds the coordinate u[axis] that maps to s in the square: the map grows along each axis, and its
 * second coordinate depends on u[1] alone. */
static double unwarp(const brdf_rgl *rgl, const rgl_slices *slices, int axis, double s, double v) {
    double low = 0, high = 1;
    for (int step = 0; step < 32; step++) {
        const double middle = (low + high) / 2;
        const double u[2] = { axis == 0 ? middle : 0, axis == 0 ? v : middle };
        double here[2];
        lmpi_rgl_warp(rgl, slices, u, here);
        if (here[axis] < s)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

/* Samples the value for the normal at u: f_r cos theta_o over the estimate. Below the horizon the
 * value is continued as an odd function, so that interpolation passes through 0 there. */
static void sample(const writer *w, double theta, double phi, const double u[2], double rgb[3]) {
    const brdf_rgl *rgl = &w->rgl;
    double m[3], b[3];
    normal_at(u, rgl->isotropic ? phi : 0, m);
    const double a[3] = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
    const double along = 2 * brdf_dot(a, m);
    for (int k = 0; k < 3; k++)
        b[k] = along * m[k] - a[k];
    const double cosine = b[2];
    b[2] = fmax(fabs(b[2]), 1e-6);
    lmp_brdf_eval_double(w->brdf, a, b, rgb);
    const double u_a[2] = { sqrt(theta * 2 / BRDF_PI), (phi + BRDF_PI) / (2 * BRDF_PI) };
    const double estimate =
        lmpi_rgl_bilinear(&rgl->ndf, u) / (4 * lmpi_rgl_bilinear(&rgl->sigma, u_a));
    for (int c = 0; c < 3; c++)
        rgb[c] = fmin(fmax(rgb[c] * cosine / estimate, -1e30), 1e30);
}

static void fill_slice(const writer *w, double theta, double phi, float *out) {
    const brdf_rgl *rgl = &w->rgl;
    const rgl_slices slices = lmpi_rgl_slices(rgl, theta, phi);
    const int width = rgl->rgb_width, height = rgl->rgb_height;
    const size_t plane = (size_t)width * (size_t)height;
    for (int y = 0; y < height; y++) {
        const double v = unwarp(rgl, &slices, 1, (double)y / (height - 1), 0);
        for (int x = 0; x < width; x++, out++) {
            const double u[2] = { unwarp(rgl, &slices, 0, (double)x / (width - 1), v), v };
            double rgb[3];
            sample(w, theta, phi, u, rgb);
            for (size_t c = 0; c < 3; c++)
                out[c * plane] = (float)rgb[c];
        }
    }
}

static lmp_result fill_slice_task(size_t index, void *data) {
    const writer *w = data;
    const size_t thetas = (size_t)w->rgl.theta_count;
    const size_t plane = (size_t)w->rgl.rgb_width * (size_t)w->rgl.rgb_height;
    fill_slice(w, (double)w->theta[index % thetas], (double)w->phi[index / thetas],
               w->rgl.rgb + 3 * index * plane);
    return LMP_OK;
}

static void fill_luminances(const writer *w) {
    const brdf_rgl *r = &w->rgl;
    const size_t plane = (size_t)r->rgb_width * (size_t)r->rgb_height;
    const size_t slices = (size_t)r->phi_count * (size_t)r->theta_count;
    for (size_t i = 0; i < slices * plane; i++) {
        const float *rgb = r->rgb + i / plane * 3 * plane + i % plane;
        w->luminance[i] = fmaxf(0, (rgb[0] + rgb[plane] + rgb[2 * plane]) / 3);
    }
}

/* --- the file --------------------------------------------------------------------------------- */

typedef struct out_field {
    const char *name;
    int type;
    int dimensions;
    size_t shape[5];
    const void *values;
} out_field;

static size_t out_count(const out_field *field) {
    size_t count = 1;
    for (int d = 0; d < field->dimensions; d++)
        count *= field->shape[d];
    return count;
}

static size_t out_bytes(const out_field *field) {
    return out_count(field) * (field->type == RGL_U8 ? 1 : 4);
}

static size_t directory_size(const out_field *fields, size_t count) {
    size_t size = RGL_HEADER;
    for (size_t i = 0; i < count; i++)
        size += 2 + strlen(fields[i].name) + 2 + 1 + 8 + 8 * (size_t)fields[i].dimensions;
    return size;
}

static void write_fields(const out_field *fields, size_t count, unsigned char *bytes) {
    unsigned char *p = bytes;
    memcpy(p, RGL_MAGIC, RGL_MAGIC_SIZE);
    p += RGL_MAGIC_SIZE;
    *p++ = 1;
    *p++ = 0;
    p = lmpi_bytes_store_u32(p, (uint32_t)count);
    size_t offset = directory_size(fields, count);
    for (size_t i = 0; i < count; i++) {
        const out_field *field = &fields[i];
        const size_t length = strlen(field->name);
        *p++ = (unsigned char)length;
        *p++ = 0;
        memcpy(p, field->name, length);
        p += length;
        *p++ = (unsigned char)field->dimensions;
        *p++ = 0;
        *p++ = (unsigned char)field->type;
        p = lmpi_bytes_store_u64(p, offset);
        for (int d = 0; d < field->dimensions; d++)
            p = lmpi_bytes_store_u64(p, field->shape[d]);
        if (field->type == RGL_U8)
            memcpy(bytes + offset, field->values, out_count(field));
        else
            for (size_t k = 0; k < out_count(field); k++)
                lmpi_bytes_store_f32(bytes + offset + 4 * k, ((const float *)field->values)[k]);
        offset += out_bytes(field);
    }
}

static lmp_result write_file(const writer *w, const lmp_host *host, void **data, size_t *size) {
    static const char description[] = "resampled by lampion";
    static const unsigned char jacobian = 1;
    const brdf_rgl *r = &w->rgl;
    const size_t phis = (size_t)r->phi_count, thetas = (size_t)r->theta_count;
    const size_t side = (size_t)r->rgb_width, vw = (size_t)r->vndf_width;
    const size_t vh = (size_t)r->vndf_height;
    const out_field fields[] = {
        { "description", RGL_U8, 1, { sizeof description - 1 }, description },
        { "jacobian", RGL_U8, 1, { 1 }, &jacobian },
        { "theta_i", RGL_F32, 1, { thetas }, w->theta },
        { "phi_i", RGL_F32, 1, { phis }, w->phi },
        { "ndf", RGL_F32, 2, { (size_t)r->ndf.height, (size_t)r->ndf.width }, w->ndf },
        { "sigma", RGL_F32, 2, { (size_t)r->sigma.height, (size_t)r->sigma.width }, w->sigma },
        { "vndf", RGL_F32, 4, { phis, thetas, vh, vw }, r->density },
        { "luminance", RGL_F32, 4, { phis, thetas, side, side }, w->luminance },
        { "rgb", RGL_F32, 5, { phis, thetas, 3, side, side }, r->rgb },
    };
    const size_t count = sizeof fields / sizeof *fields;
    size_t total = directory_size(fields, count);
    for (size_t i = 0; i < count; i++)
        total += out_bytes(&fields[i]);
    *data = lmpi_allocate(host, total);
    if (!*data)
        return LMP_ERROR_MEMORY;
    *size = total;
    write_fields(fields, count, *data);
    return LMP_OK;
}

static void set_shape(writer *w) {
    brdf_rgl *r = &w->rgl;
    const bool isotropic = !w->brdf->info.anisotropic;
    r->isotropic = isotropic;
    r->jacobian = true;
    r->symmetry = 1;
    r->phi_count = isotropic ? 1 : ANISO_PHI_COUNT;
    r->theta_count = isotropic ? THETA_COUNT : ANISO_THETA_COUNT;
    r->ndf.width = NDF_WIDTH;
    r->ndf.height = isotropic ? 2 : ANISO_NDF_HEIGHT;
    r->sigma.width = SIGMA_WIDTH;
    r->sigma.height = isotropic ? 2 : ANISO_SIGMA_HEIGHT;
    r->vndf_width = isotropic ? VNDF_WIDTH : VNDF_HEIGHT;
    r->vndf_height = VNDF_HEIGHT;
    r->rgb_width = r->rgb_height = isotropic ? SAMPLE_SIZE : ANISO_SAMPLE_SIZE;
}

/* Lays all arrays out in one block; returns the floats they take. */
static size_t lay_out(writer *w, float *base) {
    brdf_rgl *r = &w->rgl;
    const size_t slices = (size_t)r->phi_count * (size_t)r->theta_count;
    const size_t plane = (size_t)r->vndf_width * (size_t)r->vndf_height;
    const size_t samples = (size_t)r->rgb_width * (size_t)r->rgb_height;
    float **const parts[] = { &w->theta,       &w->phi,      &w->ndf, &w->sigma,    &r->density,
                              &r->conditional, &r->marginal, &r->rgb, &w->luminance };
    const size_t sizes[] = { (size_t)r->theta_count,
                             (size_t)r->phi_count,
                             (size_t)r->ndf.width * (size_t)r->ndf.height,
                             (size_t)r->sigma.width * (size_t)r->sigma.height,
                             slices * plane,
                             slices * plane,
                             slices * (size_t)r->vndf_height,
                             slices * samples * 3,
                             slices * samples };
    size_t total = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        if (base)
            *parts[i] = base + total;
        total += sizes[i];
    }
    r->theta = w->theta;
    r->phi = w->phi;
    r->ndf.values = w->ndf;
    r->sigma.values = w->sigma;
    return total;
}

lmp_result lmp_brdf_encode_rgl(const lmp_host *host, const lmp_brdf *brdf, void **data,
                               size_t *size) {
    *data = NULL;
    *size = 0;
    const lmp_host resolved = lmpi_host_resolve(host);
    writer w = { .brdf = brdf };
    set_shape(&w);
    const size_t floats = lay_out(&w, NULL);
    float *block = lmpi_allocate(&resolved, floats * sizeof *block);
    if (!block)
        return LMP_ERROR_MEMORY;
    lay_out(&w, block);
    fill_angles(&w);
    fill_ndf(&w);
    fill_sigma(&w);
    fill_densities(&w);
    lmpi_rgl_accumulate(&w.rgl);
    const size_t slices = (size_t)w.rgl.phi_count * (size_t)w.rgl.theta_count;
    lmp_result result = lmpi_host_run(&resolved, 0, 1, slices, fill_slice_task, &w);
    if (result == LMP_OK) {
        fill_luminances(&w);
        result = write_file(&w, &resolved, data, size);
    }
    lmpi_release(&resolved, block);
    return result;
}
