/* SPDX-License-Identifier: MIT */
/* Reading the tensor files of the RGL material database: a directory of named arrays. */
#include "src/brdf/rgl.h"

#include <math.h>

#define DIMENSIONS_MAX 8

/* Tables take rings of 0.7 degrees, because samples are interpolated. */
#define RINGS          128
#define RINGS_PER_BAND 2

/* Fields of the format; this reader uses the first ones. */
typedef enum rgl_field_id {
    FIELD_THETA,
    FIELD_PHI,
    FIELD_NDF,
    FIELD_SIGMA,
    FIELD_VNDF,
    FIELD_JACOBIAN,
    FIELD_RGB,
    FIELD_SPECTRA,
    FIELD_WAVELENGTHS,
    FIELD_LUMINANCE,
    FIELD_DESCRIPTION,
    FIELD_COUNT
} rgl_field_id;

static const struct {
    const char *name;
    unsigned char type;
    unsigned char dimensions;
    bool required;
} known[FIELD_COUNT] = {
    { "theta_i", RGL_F32, 1, true },      { "phi_i", RGL_F32, 1, true },
    { "ndf", RGL_F32, 2, true },          { "sigma", RGL_F32, 2, true },
    { "vndf", RGL_F32, 4, true },         { "jacobian", RGL_U8, 1, true },
    { "rgb", RGL_F32, 5, false },         { "spectra", RGL_F32, 5, false },
    { "wavelengths", RGL_F32, 1, false }, { "luminance", RGL_F32, 4, false },
    { "description", RGL_U8, 1, false },
};

/* Bytes of an element, by its type number. */
static const unsigned char type_sizes[12] = { 0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8 };

typedef struct rgl_field {
    bool present;
    uint64_t shape[DIMENSIONS_MAX];
    size_t offset; /* offset of the data in the file */
    size_t count;  /* elements */
} rgl_field;

typedef struct rgl_file {
    const unsigned char *bytes;
    size_t size;
    rgl_field fields[FIELD_COUNT];
    lmp_parse_error *error;
} rgl_file;

/* Fills the error and returns false. */
static bool wrong(const rgl_file *file, size_t offset, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static bool wrong(const rgl_file *file, size_t offset, const char *format, ...) {
    va_list list;
    va_start(list, format);
    lmpi_parse_fail_list(file->error, LMP_ERROR_FORMAT, offset, format, list);
    va_end(list);
    return false;
}

/* --- the directory ---------------------------------------------------------------------------- */

static int find_known(const unsigned char *name, size_t length) {
    for (int id = 0; id < FIELD_COUNT; id++)
        if (strlen(known[id].name) == length && memcmp(known[id].name, name, length) == 0)
            return id;
    return -1;
}

/* Reads the shape at `at` and checks that the data lie inside the file. */
static bool read_extent(const rgl_file *file, size_t at, int dimensions, int type, uint64_t offset,
                        int number, rgl_field *field) {
    uint64_t count = 1;
    for (int d = 0; d < dimensions; d++) {
        const uint64_t n = lmpi_bytes_at_u64(file->bytes + at + 8 * (size_t)d);
        if (n == 0)
            return wrong(file, at + 8 * (size_t)d, "field %d has dimension %d of size 0", number,
                         d);
        if (n > file->size || count > file->size / n)
            return wrong(file, at + 8 * (size_t)d,
                         "field %d has more elements than the file has bytes", number);
        count *= n;
        field->shape[d] = n;
    }
    const uint64_t bytes = count * type_sizes[type];
    if (offset > file->size || bytes > file->size - offset)
        return wrong(file, at, "data of field %d (%zu bytes at %zu) end past the file's %zu bytes",
                     number, (size_t)bytes, (size_t)offset, file->size);
    field->offset = (size_t)offset;
    field->count = (size_t)count;
    field->present = true;
    return true;
}

/* Reads directory entry `number` at *at and steps over it. */
static bool read_entry(rgl_file *file, int number, size_t *at) {
    const size_t start = *at, size = file->size;
    if (size - start < 2)
        return wrong(file, start, "the directory ends before field %d", number);
    const size_t length = file->bytes[start] | (size_t)file->bytes[start + 1] << 8;
    if (size - start < 2 + length + 11)
        return wrong(file, start, "the directory ends within field %d", number);
    const unsigned char *name = file->bytes + start + 2;
    const size_t rest = start + 2 + length;
    const int dimensions = (int)(file->bytes[rest] | file->bytes[rest + 1] << 8);
    const int type = file->bytes[rest + 2];
    const uint64_t offset = lmpi_bytes_at_u64(file->bytes + rest + 3);
    if (type < 1 || type >= (int)sizeof type_sizes)
        return wrong(file, rest + 2, "field %d has unknown type %d", number, type);
    if (dimensions > DIMENSIONS_MAX)
        return wrong(file, rest, "field %d has %d dimensions, more than %d", number, dimensions,
                     DIMENSIONS_MAX);
    if (size - rest - 11 < 8 * (size_t)dimensions)
        return wrong(file, rest, "the directory ends within the shape of field %d", number);
    *at = rest + 11 + 8 * (size_t)dimensions;
    rgl_field field = { 0 };
    if (!read_extent(file, rest + 11, dimensions, type, offset, number, &field))
        return false;
    const int id = find_known(name, length);
    if (id < 0)
        return true;
    if (file->fields[id].present)
        return wrong(file, start, "field '%s' is there twice", known[id].name);
    if (dimensions != known[id].dimensions || type != known[id].type)
        return wrong(file, rest, "field '%s' has %d dimensions of type %d, not %d of type %d",
                     known[id].name, dimensions, type, known[id].dimensions, known[id].type);
    file->fields[id] = field;
    return true;
}

static bool read_directory(rgl_file *file) {
    if (file->size < RGL_HEADER || memcmp(file->bytes, RGL_MAGIC, RGL_MAGIC_SIZE) != 0)
        return wrong(file, 0, "not a tensor file (no 'tensor_file' at the start)");
    if (file->bytes[12] != 1) {
        lmpi_parse_fail(file->error, LMP_ERROR_VERSION, 12, "tensor file version %d.%d, not 1.x",
                        file->bytes[12], file->bytes[13]);
        return false;
    }
    const uint32_t count = lmpi_bytes_at_u32(file->bytes + 14);
    size_t at = RGL_HEADER;
    for (uint32_t i = 0; i < count; i++)
        if (!read_entry(file, (int)i, &at))
            return false;
    for (int id = 0; id < FIELD_COUNT; id++)
        if (known[id].required && !file->fields[id].present)
            return wrong(file, 0, "field '%s' is missing", known[id].name);
    const bool spectral = file->fields[FIELD_SPECTRA].present;
    if (!spectral && !file->fields[FIELD_RGB].present)
        return wrong(file, 0, "neither field 'rgb' nor 'spectra' is there");
    if (spectral && !file->fields[FIELD_RGB].present && !file->fields[FIELD_WAVELENGTHS].present)
        return wrong(file, 0, "field 'wavelengths' is missing");
    return true;
}

/* --- shapes and values ------------------------------------------------------------------------ */

static bool same_shape(const rgl_file *file, rgl_field_id id, int d, uint64_t expected,
                       const char *by) {
    const uint64_t n = file->fields[id].shape[d];
    if (n != expected)
        return wrong(file, file->fields[id].offset, "dimension %d of '%s' is %zu, %s says %zu", d,
                     known[id].name, (size_t)n, by, (size_t)expected);
    return true;
}

static bool check_shapes(const rgl_file *file) {
    const rgl_field *f = file->fields;
    const uint64_t phis = f[FIELD_PHI].shape[0], thetas = f[FIELD_THETA].shape[0];
    const rgl_field_id sampled[] = { FIELD_VNDF, FIELD_RGB, FIELD_SPECTRA, FIELD_LUMINANCE };
    for (size_t i = 0; i < sizeof sampled / sizeof *sampled; i++) {
        if (!f[sampled[i]].present)
            continue;
        if (!same_shape(file, sampled[i], 0, phis, "phi_i") ||
            !same_shape(file, sampled[i], 1, thetas, "theta_i"))
            return false;
    }
    if (f[FIELD_RGB].present && !same_shape(file, FIELD_RGB, 2, 3, "rgb"))
        return false;
    if (f[FIELD_SPECTRA].present && f[FIELD_WAVELENGTHS].present &&
        !same_shape(file, FIELD_SPECTRA, 2, f[FIELD_WAVELENGTHS].shape[0], "wavelengths"))
        return false;
    if (f[FIELD_VNDF].shape[2] < 2 || f[FIELD_VNDF].shape[3] < 2)
        return wrong(file, f[FIELD_VNDF].offset, "slices of 'vndf' need 2 x 2 samples at least");
    for (int id = 0; id < FIELD_COUNT; id++)
        for (int d = 0; f[id].present && d < known[id].dimensions; d++)
            if (f[id].shape[d] > 1 << 24)
                return wrong(file, f[id].offset, "dimension %d of '%s' is too large", d,
                             known[id].name);
    return true;
}

/* Copies a float field, each value finite and not below `minimum`. */
static bool copy_floats(const rgl_file *file, rgl_field_id id, float minimum, float *out) {
    const rgl_field *field = &file->fields[id];
    for (size_t i = 0; i < field->count; i++) {
        out[i] = lmpi_bytes_at_f32(file->bytes + field->offset + 4 * i);
        if (!(out[i] >= minimum && out[i] <= 1e30f))
            return wrong(file, field->offset + 4 * i, "value %zu of '%s' is %s", i, known[id].name,
                         out[i] < minimum ? "below its range" : "not a finite number");
    }
    return true;
}

static bool is_ascending(const rgl_file *file, rgl_field_id id, const float *values) {
    for (size_t i = 1; i < file->fields[id].count; i++)
        if (!(values[i] > values[i - 1]))
            return wrong(file, file->fields[id].offset + 4 * i, "'%s' does not ascend at value %zu",
                         known[id].name, i);
    return true;
}

/* Checks that theta_i lies in 0 … pi/2, and that phi_i covers a full turn, half a turn, or a
 * quarter turn that begins at a multiple of one. */
static bool check_angles(const rgl_file *file, brdf_rgl *rgl) {
    if (!is_ascending(file, FIELD_THETA, rgl->theta) || !is_ascending(file, FIELD_PHI, rgl->phi))
        return false;
    const double last = (double)rgl->theta[rgl->theta_count - 1];
    if (rgl->theta[0] < 0 || last > BRDF_PI / 2 + 1e-3)
        return wrong(file, file->fields[FIELD_THETA].offset, "'theta_i' leaves 0 to pi/2");
    const double first = (double)rgl->phi[0];
    const double span = (double)rgl->phi[rgl->phi_count - 1] - first;
    if (fabs(first) > 2 * BRDF_PI + 1e-3 || span > 2 * BRDF_PI + 1e-3)
        return wrong(file, file->fields[FIELD_PHI].offset, "'phi_i' leaves one turn");
    rgl->isotropic = rgl->phi_count <= 2;
    rgl->symmetry = 1;
    if (rgl->isotropic)
        return true;
    const double parts = 2 * BRDF_PI / span, quarters = first / (BRDF_PI / 2);
    rgl->symmetry = parts < 1.5 ? 1 : parts < 3 ? 2 : 4;
    if (!(fabs(parts - rgl->symmetry) <= 0.15 * rgl->symmetry) ||
        (rgl->symmetry == 4 && !(fabs(quarters - floor(quarters + 0.5)) <= 0.02)))
        return wrong(file, file->fields[FIELD_PHI].offset,
                     "'phi_i' does not span a full, half or quarter turn");
    return true;
}

/* --- color ------------------------------------------------------------------------------------ */

/* A bell curve with a width on either side of its center. */
static double bell(double x, double center, double left, double right) {
    const double t = (x - center) / (x < center ? left : right);
    return exp(-t * t / 2);
}

/* Evaluates the CIE 1931 color matching functions at a wavelength in nm: the multi-lobe fit of
 * Wyman, Sloan and Shirley (2013). */
static void observer(double nm, double xyz[3]) {
    xyz[0] = 1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) -
             0.065 * bell(nm, 501.1, 20.4, 26.2);
    xyz[1] = 0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1);
    xyz[2] = 1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8);
}

/* CIE XYZ under illuminant E to linear sRGB: Bradford's adaptation from E to D65, then sRGB's
 * primaries; rows sum to 1, so that gray stays gray. */
static const double rgb_from_xyz[3][3] = {
    { 3.1466577, -1.6664638, -0.4801939 },
    { -0.9955216, 1.9557567, 0.0397649 },
    { 0.0635948, -0.2145632, 1.1509684 },
};

/* Computes weights[3 i + c], what wavelength i adds to channel c, by trapezoids between the
 * wavelengths. */
static bool spectral_weights(const rgl_file *file, const float *nm, double *weights) {
    const size_t count = file->fields[FIELD_WAVELENGTHS].count;
    double sum[3] = { 0, 0, 0 };
    for (size_t i = 0; i < count; i++) {
        const double below = i > 0 ? (double)nm[i] - (double)nm[i - 1] : 0;
        const double above = i + 1 < count ? (double)nm[i + 1] - (double)nm[i] : 0;
        double xyz[3];
        observer((double)nm[i], xyz);
        for (int c = 0; c < 3; c++) {
            weights[3 * i + (size_t)c] = xyz[c] * (count > 1 ? (below + above) / 2 : 1);
            sum[c] += weights[3 * i + (size_t)c];
        }
    }
    for (int c = 0; c < 3; c++)
        if (!(sum[c] > 1e-3))
            return wrong(file, file->fields[FIELD_WAVELENGTHS].offset,
                         "'wavelengths' (nm) miss the visible range");
    for (size_t i = 0; i < count; i++) {
        double xyz[3];
        for (int c = 0; c < 3; c++)
            xyz[c] = weights[3 * i + (size_t)c] / sum[c];
        for (int c = 0; c < 3; c++)
            weights[3 * i + (size_t)c] = rgb_from_xyz[c][0] * xyz[0] + rgb_from_xyz[c][1] * xyz[1] +
                                         rgb_from_xyz[c][2] * xyz[2];
    }
    return true;
}

/* Computes rgb[slice][channel][plane] from spectra[slice][wavelength][plane]. */
static bool add_spectra(const rgl_file *file, size_t slices, size_t plane, const double *weights,
                        float *rgb) {
    const rgl_field *field = &file->fields[FIELD_SPECTRA];
    const size_t count = file->fields[FIELD_WAVELENGTHS].count;
    for (size_t slice = 0; slice < slices; slice++)
        for (size_t i = 0; i < plane; i++) {
            double sum[3] = { 0, 0, 0 };
            for (size_t w = 0; w < count; w++) {
                const size_t at = field->offset + 4 * ((slice * count + w) * plane + i);
                const double value = (double)lmpi_bytes_at_f32(file->bytes + at);
                if (!(fabs(value) <= 1e30))
                    return wrong(file, at, "a value of 'spectra' is not a finite number");
                for (size_t c = 0; c < 3; c++)
                    sum[c] += weights[3 * w + c] * value;
            }
            for (size_t c = 0; c < 3; c++)
                rgb[(3 * slice + c) * plane + i] = (float)sum[c];
        }
    return true;
}

static lmp_result convert_spectra(const rgl_file *file, const lmp_host *host, size_t slices,
                                  size_t plane, float *rgb) {
    const size_t count = file->fields[FIELD_WAVELENGTHS].count;
    double *weights = lmpi_allocate(host, count * (3 * sizeof(double) + sizeof(float)));
    if (!weights)
        return LMP_ERROR_MEMORY;
    float *nm = (float *)(weights + 3 * count);
    const bool good =
        copy_floats(file, FIELD_WAVELENGTHS, 1, nm) && is_ascending(file, FIELD_WAVELENGTHS, nm) &&
        spectral_weights(file, nm, weights) && add_spectra(file, slices, plane, weights, rgb);
    lmpi_release(host, weights);
    return good ? LMP_OK : LMP_ERROR_FORMAT;
}

/* --- the object ------------------------------------------------------------------------------- */

/* Sets the shapes and lays the arrays out behind the object; returns the floats they take. */
static size_t lay_out(const rgl_file *file, brdf_rgl *rgl, float *base) {
    const rgl_field *f = file->fields;
    const rgl_field *samples = f[FIELD_RGB].present ? &f[FIELD_RGB] : &f[FIELD_SPECTRA];
    rgl->theta_count = (int)f[FIELD_THETA].count;
    rgl->phi_count = (int)f[FIELD_PHI].count;
    rgl->vndf_height = (int)f[FIELD_VNDF].shape[2];
    rgl->vndf_width = (int)f[FIELD_VNDF].shape[3];
    rgl->rgb_height = (int)samples->shape[3];
    rgl->rgb_width = (int)samples->shape[4];
    const size_t slices = f[FIELD_THETA].count * f[FIELD_PHI].count;
    const size_t sizes[] = {
        f[FIELD_THETA].count,
        f[FIELD_PHI].count,
        f[FIELD_NDF].count,
        f[FIELD_SIGMA].count,
        f[FIELD_VNDF].count,
        f[FIELD_VNDF].count,
        slices * (size_t)f[FIELD_VNDF].shape[2],
        (size_t)(samples->count / samples->shape[2] * 3),
    };
    float *parts[8];
    size_t total = 0;
    for (size_t i = 0; i < 8; i++) {
        parts[i] = base ? base + total : NULL;
        total += sizes[i];
    }
    rgl->theta = parts[0];
    rgl->phi = parts[1];
    rgl->ndf = (brdf_grid) { (int)f[FIELD_NDF].shape[0], (int)f[FIELD_NDF].shape[1], parts[2] };
    rgl->sigma =
        (brdf_grid) { (int)f[FIELD_SIGMA].shape[0], (int)f[FIELD_SIGMA].shape[1], parts[3] };
    rgl->density = parts[4];
    rgl->conditional = parts[5];
    rgl->marginal = parts[6];
    rgl->rgb = parts[7];
    return total;
}

static lmp_result fill(const rgl_file *file, const lmp_host *host, lmp_brdf *brdf) {
    brdf_rgl *rgl = &brdf->rgl;
    float *base = lmpi_brdf_extra(brdf);
    lay_out(file, rgl, base);
    const size_t thetas = file->fields[FIELD_THETA].count, phis = file->fields[FIELD_PHI].count;
    float *grids = base + thetas + phis;
    if (!copy_floats(file, FIELD_THETA, -1, base) ||
        !copy_floats(file, FIELD_PHI, -7, base + thetas) || !check_angles(file, rgl) ||
        !copy_floats(file, FIELD_NDF, 0, grids) ||
        !copy_floats(file, FIELD_SIGMA, 0, grids + file->fields[FIELD_NDF].count) ||
        !copy_floats(file, FIELD_VNDF, 0, rgl->density))
        return LMP_ERROR_FORMAT;
    const size_t slice = lmpi_rgl_accumulate(rgl);
    if (slice < thetas * phis) {
        wrong(file, file->fields[FIELD_VNDF].offset, "slice %zu of 'vndf' is zero", slice);
        return LMP_ERROR_FORMAT;
    }
    rgl->jacobian = file->bytes[file->fields[FIELD_JACOBIAN].offset] != 0;
    brdf->info.spectral = !file->fields[FIELD_RGB].present;
    if (brdf->info.spectral)
        return convert_spectra(file, host, thetas * phis,
                               (size_t)rgl->rgb_width * (size_t)rgl->rgb_height, rgl->rgb);
    /* negative samples occur in the database; evaluation clamps, as its authors' code does */
    return copy_floats(file, FIELD_RGB, -1e30f, rgl->rgb) ? LMP_OK : LMP_ERROR_FORMAT;
}

lmp_result lmp_brdf_read_rgl(const lmp_host *host, const void *data, size_t size,
                             lmp_parse_error *error, lmp_brdf **brdf) {
    *brdf = NULL;
    rgl_file file = { .bytes = data, .size = size, .error = error };
    if (!read_directory(&file) || !check_shapes(&file))
        return size > 13 && memcmp(data, RGL_MAGIC, RGL_MAGIC_SIZE) == 0 && file.bytes[12] != 1
                   ? LMP_ERROR_VERSION
                   : LMP_ERROR_FORMAT;
    const lmp_host resolved = lmpi_host_resolve(host);
    brdf_rgl shape = { 0 };
    lmp_brdf *made = NULL;
    lmp_result result =
        lmpi_brdf_new(&resolved, LMP_BRDF_RGL, lay_out(&file, &shape, NULL) * sizeof(float), &made);
    if (result == LMP_OK)
        result = fill(&file, &resolved, made);
    if (result == LMP_ERROR_MEMORY)
        lmpi_parse_fail(error, result, 0, "out of memory for the samples");
    if (result != LMP_OK) {
        lmp_brdf_destroy(made);
        return result;
    }
    made->info.anisotropic = !made->rgl.isotropic;
    made->info.measured = true;
    made->info.rings = RINGS;
    made->rings_per_band = RINGS_PER_BAND;
    made->info.shape[0] = made->rgl.phi_count;
    made->info.shape[1] = made->rgl.theta_count;
    made->eval = lmpi_rgl_eval;
    *brdf = made;
    return LMP_OK;
}
