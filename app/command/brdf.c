/* SPDX-License-Identifier: MIT */
/* lampion brdf - the properties of a material, its values, its table, its plot, and conversion to
 * other formats. */
#include "app/command/brdf.h"
#include "app/base/cli.h"
#include "app/base/csv.h"
#include "app/base/file_writer.h"
#include "app/base/printable.h"
#include "app/base/progress.h"
#include "app/render/method.h"
#include "app/scene/bake.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* --- info ------------------------------------------------------------------------------------- */

static void print_cells(const lmp_brdf_info *info) {
    printf("cells      %d theta_h x %d theta_d x %d phi_d\n", info->shape[0], info->shape[1],
           info->shape[2]);
}

static void print_nodes(const lmp_brdf_info *info) {
    printf("nodes      %d phi_i x %d theta_i, %s\n", info->shape[0], info->shape[1],
           info->spectral ? "spectral" : "RGB");
}

static const struct {
    const char *name;
    void (*print_samples)(const lmp_brdf_info *info); /* NULL: a formula, without samples */
} kinds[] = {
    [LMP_BRDF_LAMBERT] = { "Lambert", NULL },
    [LMP_BRDF_PHONG] = { "Phong", NULL },
    [LMP_BRDF_GGX] = { "GGX", NULL },
    [LMP_BRDF_SGD] = { "SGD (fit of a MERL material)", NULL },
    [LMP_BRDF_MERL] = { "MERL .binary", print_cells },
    [LMP_BRDF_RGL] = { "RGL .bsdf tensor file", print_nodes },
    [LMP_BRDF_SHEEN] = { "sheen", NULL },
};
static_assert(sizeof kinds / sizeof *kinds == LMP_BRDF_KIND_COUNT, "a row for each kind");

static void print_table_info(const lmp_brdf_table *table) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    printf("bands      %d\n", info.bands);
    printf("views      %d x %d azimuths%s\n", info.views, info.azimuths,
           info.mirrored ? ", mirrored (m >= 0)" : "");
    printf("window     %s of %g bands\n", lmp_sh_window_name(info.window),
           (double)info.window_size);
    printf("quadrature %d rings, last doubling changed a view by %.2g of its largest\n", info.rings,
           (double)info.change);
    printf("\nalbedo     of the BRDF               of its series above the horizon\n");
    printf("  theta_o  red     green   blue      red     green   blue\n");
    for (int k = 0; k < 8; k++) {
        const int view = k * (info.views - 1) / 7;
        lmp_rgb a, b;
        lmp_brdf_table_find_albedo(table, view, 0, &a, &b);
        printf("  %6.2f   %.4f  %.4f  %.4f    %.4f  %.4f  %.4f\n",
               (double)info.theta_step * view * 180 / pi, (double)a.r, (double)a.g, (double)a.b,
               (double)b.r, (double)b.g, (double)b.b);
    }
}

static void print_brdf_info(const material *m) {
    const lmp_brdf_info info = lmp_brdf_describe(m->brdf);
    if (kinds[info.kind].print_samples)
        kinds[info.kind].print_samples(&info);
    printf("isotropy   %s\n", info.anisotropic ? "anisotropic"
                              : info.mirrored  ? "isotropic, mirror-symmetric"
                                               : "isotropic");
    printf("memory     %zu bytes\n", info.bytes);
}

static bool print_info(const brdf_options *o, const material *m, base_error *error) {
    printf("material   ");
    printable_print(m->name);
    printf("\nformat     %s\n",
           m->table ? "Lampion table (.lmpt)" : kinds[lmp_brdf_describe(m->brdf).kind].name);
    if (m->file_size)
        printf("size       %zu bytes\n", m->file_size);
    lmp_brdf_table *table = NULL;
    if (m->brdf)
        print_brdf_info(m);
    if (!material_bake(m, &o->table, &table, error))
        return false;
    print_table_info(table);
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    double most = 0;
    for (int view = 0; view < info.views; view++)
        for (int azimuth = 0; azimuth < info.azimuths; azimuth++) {
            lmp_rgb a, b;
            lmp_brdf_table_find_albedo(table, view, azimuth, &a, &b);
            most = fmax(most, fmax((double)a.r, fmax((double)a.g, (double)a.b)));
        }
    printf("\nenergy     largest albedo %.4f: %s\n", most,
           most <= 1.0001 ? "conserved" : "MORE LEAVES THAN ARRIVES");
    lmp_brdf_table_destroy(table);
    return true;
}

/* --- eval ------------------------------------------------------------------------------------- */

static bool eval_rows(const material *m, csv_reader *reader, base_error *error) {
    static const char *const names[] = { "wi_x", "wi_y", "wi_z", "wo_x", "wo_y", "wo_z" };
    float v[6];
    csv_result result;
    puts("r,g,b");
    while ((result = csv_read_row(reader, names, 6, v, error)) == CSV_ROW) {
        const lmp_vec3 wi = { v[0], v[1], v[2] }, wo = { v[3], v[4], v[5] };
        const lmp_rgb f = lmp_brdf_eval(m->brdf, wi, wo);
        printf("%.9g,%.9g,%.9g\n", (double)f.r, (double)f.g, (double)f.b);
    }
    return result == CSV_END;
}

/* Evaluates the rows of a table of directions, whose header line is optional. */
static bool evaluate(const brdf_options *o, const material *m, base_error *error) {
    (void)o;
    if (!m->brdf)
        return base_fail(error, m->name, "is a table, which holds no values of f_r to evaluate");
    const int first = getc(stdin);
    ungetc(first, stdin);
    static csv_reader reader;
    if (!csv_open_stream(&reader, stdin, "standard input",
                         first == 'w' ? "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z" : NULL, error))
        return false;
    const bool ok = eval_rows(m, &reader, error);
    csv_close(&reader);
    return ok;
}

/* --- bake, convert ---------------------------------------------------------------------------- */

/* Tabulates a material into the cache, where render and view look, and into a file if one is
 * given. */
static bool bake_table(const brdf_options *o, const material *m, base_error *error) {
    if (!m->brdf && o->output)
        return base_fail(error, m->name, "is a table already");
    lmp_brdf_table *table = NULL;
    lmp_preintegrated_brdf *preintegrated = NULL;
    const bool ok = material_bake(m, &o->table, &table, error) &&
                    (!o->preintegrated || material_preintegrate(m, table, &preintegrated, error)) &&
                    (!o->output || material_write_table(table, o->output, error));
    lmp_preintegrated_brdf_destroy(preintegrated);
    lmp_brdf_table_destroy(table);
    return ok;
}

static bool convert(const brdf_options *o, const material *m, base_error *error) {
    const char *extension = strrchr(o->output, '.');
    const bool merl = extension && strcmp(extension, ".binary") == 0;
    if (!m->brdf)
        return base_fail(error, m->name, "is a table, which cannot become a BRDF again");
    if (!merl && !(extension && strcmp(extension, ".bsdf") == 0))
        return base_fail(error, o->output, "unknown format (name it .binary or .bsdf)");
    void *data = NULL;
    size_t size = 0;
    const char *what = "sampling the BRDF";
    const lmp_host host = bake_host(&what);
    const lmp_result result = merl ? lmp_brdf_encode_merl(&host, m->brdf, &data, &size)
                                   : lmp_brdf_encode_rgl(&host, m->brdf, &data, &size);
    progress_end();
    if (result != LMP_OK)
        return base_fail(error, o->output, "%s", lmp_result_text(result));
    const bool ok = file_write_whole(o->output, data, size, error);
    free(data);
    return ok;
}

/* --- bands ------------------------------------------------------------------------------------ */

/* Integrates (f_r cos theta_i)² of green for one view, uniformly in theta, because lobes at the
 * pole are narrow. */
static double norm2(const lmp_brdf *brdf, double theta_o) {
    enum { THETAS = 2048, AZIMUTHS = 512 };
    const double wo[3] = { sin(theta_o), 0, cos(theta_o) };
    double sum = 0;
    for (int k = 0; k < THETAS; k++)
        for (int j = 0; j < AZIMUTHS; j++) {
            const double theta = pi / 2 * (k + 0.5) / THETAS, phi = pi * (j + 0.5) / AZIMUTHS;
            const double wi[3] = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
            double rgb[3];
            lmp_brdf_eval_double(brdf, wi, wo, rgb);
            sum += rgb[1] * wi[2] * rgb[1] * wi[2] * sin(theta);
        }
    return sum * (pi / 2 / THETAS) * (2 * pi / AZIMUTHS);
}

/* Measures the truncation error of n bands, ‖f cos - series‖ / ‖f cos‖ over all views at 0, 20, 40
 * and 60 degrees: left[n], n = 0 … LMP_BANDS_MAX. */
static bool measure_bands(const material *m, double left[LMP_BANDS_MAX + 1], base_error *error) {
    enum { VIEWS = 4, RINGS = 512 };
    const size_t plane = LMP_SH_COUNT(LMP_BANDS_MAX);
    float *sh = malloc(3 * plane * sizeof *sh);
    if (!sh)
        return base_fail(error, NULL, "out of memory");
    double band[LMP_BANDS_MAX] = { 0 }, total = 0;
    for (int v = 0; v < VIEWS; v++) {
        const double theta = v * pi / 9;
        const lmp_vec3 wo = { (float)sin(theta), 0, (float)cos(theta) };
        if (lmp_brdf_project(NULL, LMP_BANDS_MAX, RINGS, m->brdf, wo, sh) != LMP_OK) {
            free(sh);
            return base_fail(error, m->name, "out of memory");
        }
        for (int l = 0; l < LMP_BANDS_MAX; l++)
            for (int i = l * l; i < (l + 1) * (l + 1); i++)
                band[l] += (double)sh[plane + (size_t)i] * (double)sh[plane + (size_t)i];
        total += norm2(m->brdf, theta);
    }
    free(sh);
    double kept = 0;
    for (int n = 0; n <= LMP_BANDS_MAX; n++) {
        left[n] = sqrt(fmax(0, 1 - kept / total));
        if (n < LMP_BANDS_MAX)
            kept += band[n];
    }
    return true;
}

static int bands_below(const double *left, double bound) {
    for (int n = 1; n <= LMP_BANDS_MAX; n++)
        if (left[n] <= bound)
            return n;
    return -1;
}

static bool study_bands(const char *name, base_error *error) {
    static const int columns[] = { 3, 5, 10, 20, 40, 80, 128 };
    double left[LMP_BANDS_MAX + 1];
    material m;
    if (!material_open(name, &m, error))
        return false;
    bool ok = m.brdf || base_fail(error, name, "is a table, which is truncated already");
    ok = ok && measure_bands(&m, left, error);
    material_close(&m);
    if (!ok)
        return false;
    printable_print(name);
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        printf(",%.4f", left[columns[i]]);
    const int ten = bands_below(left, 0.1), one = bands_below(left, 0.01);
    ten > 0 ? printf(",%d", ten) : printf(",>%d", LMP_BANDS_MAX);
    one > 0 ? printf(",%d\n", one) : printf(",>%d\n", LMP_BANDS_MAX);
    return true;
}

/* --- the command ------------------------------------------------------------------------------ */

static const struct {
    const char *name;
    bool (*run)(const brdf_options *, const material *, base_error *);
    const char *writes; /* one of the kinds of endings, or NULL */
    bool caches;        /* also works without a file, on several materials */
} actions[] = {
    { "info", print_info, NULL, false },     { "eval", evaluate, NULL, false },
    { "bake", bake_table, "a table", true }, { "plot", brdf_plot, "an image", false },
    { "convert", convert, "a BRDF", false },
};

static const struct {
    const char *ending, *kind;
} endings[] = {
    { ".lmpt", "a table" },  { ".png", "an image" }, { ".exr", "an image" },
    { ".binary", "a BRDF" }, { ".bsdf", "a BRDF" },
};

/* Rejects a name whose extension is for another kind of file, before the work rather than after
 * it. */
static bool check_ending(const char *action, const char *path, const char *kind,
                         base_error *error) {
    const char *const ending = strrchr(path, '.');
    const char *right = NULL;
    bool other = false;
    for (size_t i = 0; ending && i < sizeof endings / sizeof *endings; i++) {
        const bool same = strcmp(endings[i].kind, kind) == 0;
        if (same && !right)
            right = endings[i].ending;
        other = other || (!same && strcmp(endings[i].ending, ending) == 0);
    }
    return !other || base_fail(error, path, "%s writes %s (name it %s)", action, kind, right);
}

/* Whether an action writes a file; an unknown action is reported elsewhere. */
static bool writes_file(const char *name) {
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++)
        if (strcmp(name, actions[i].name) == 0)
            return actions[i].writes != NULL;
    return strcmp(name, "list") != 0 && strcmp(name, "bands") != 0;
}

static bool run_on(const brdf_options *o,
                   bool (*action)(const brdf_options *, const material *, base_error *),
                   const char *name, base_error *error) {
    material m;
    if (!material_open(name, &m, error))
        return false;
    const bool ok = action(o, &m, error);
    material_close(&m);
    return ok;
}

static int run_action(const cli_command *command, const brdf_options *o, int count,
                      char **operands) {
    base_error error;
    if (o->output && !writes_file(operands[0]))
        return cli_usage(command, "%s prints and writes no file: it has no -o", operands[0]);
    if (strcmp(operands[0], "list") == 0) {
        if (count != 1)
            return cli_usage(command, "list takes no MATERIAL, %d given", count - 1);
        for (size_t i = 0; lmp_brdf_sgd_name(i); i++)
            printf("sgd:%s\n", lmp_brdf_sgd_name(i));
        return BASE_OK;
    }
    if (strcmp(operands[0], "bands") == 0) {
        if (count == 1)
            return cli_usage(command, "bands needs a MATERIAL");
        puts("material,3,5,10,20,40,80,128,bands_for_10_percent,bands_for_1_percent");
        for (int i = 1; i < count; i++)
            if (!study_bands(operands[i], &error))
                return base_report(&error);
        return BASE_OK;
    }
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++) {
        if (strcmp(operands[0], actions[i].name) != 0)
            continue;
        const bool caches = actions[i].caches && !o->output;
        if (count != 2 && !(caches && count > 2))
            return cli_usage(command, "%s needs one MATERIAL, %d given", operands[0], count - 1);
        if (actions[i].writes && !o->output && !caches)
            return cli_usage_output(command, "FILE");
        if (o->output && !check_ending(operands[0], o->output, actions[i].writes, &error))
            return base_report(&error);
        bool ok = true;
        for (int k = 1; k < count && ok; k++)
            ok = run_on(o, actions[i].run, operands[k], &error);
        return ok ? BASE_OK : base_report(&error);
    }
    return cli_usage_operand(command, operands[0]);
}

static int run(const cli_command *command, int argc, char **argv) {
    brdf_options o = { .table = { .bands = LMP_BRDF_BANDS_DEFAULT,
                                  .views = LMP_BRDF_VIEWS_DEFAULT,
                                  .azimuths = LMP_BRDF_AZIMUTHS_DEFAULT },
                       .size = { 1200, 800 } };
    int window = LMP_WINDOW_HANNING;
    const cli_option options[] = {
        { "output", 'o', CLI_TEXT, &o.output, "FILE",
          "the table (.lmpt), image (.png), or BRDF (.binary, .bsdf) to write", 0, 0, NULL, NULL },
        { "bands", 'n', CLI_INT, &o.table.bands, "N", "bands of spherical harmonics", 1,
          LMP_BANDS_MAX, NULL, &o.bands_given },
        { "views", 0, CLI_INT, &o.table.views, "N",
          "view angles of the table; by default 64, or 5/4 a band if that is more", 2, 1024, NULL,
          &o.views_given },
        { "azimuths", 0, CLI_INT, &o.table.azimuths, "N", "view azimuths of an anisotropic table",
          4, 256, NULL, NULL },
        { "window", 0, CLI_CHOICE, &window, "WINDOW",
          "windowing filter: damps the ringing of a series of few bands", 0, 0,
          method_window_names(), NULL },
        { "window-size", 0, CLI_FLOAT, &o.table.window_size, "BANDS",
          "where its weights fall to 0; 0 means the number of bands", 0, 1000, NULL, NULL },
        { "preintegrated", 0, CLI_FLAG, &o.preintegrated, NULL,
          "with bake: what --method preintegrated reads, too, into the cache", 0, 0, NULL, NULL },
        { "size", 0, CLI_SIZE, o.size, "WxH", "pixels of the plot", 64, 8192, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    int operand_count = 0, status = BASE_OK;
    char **operands = NULL;
    if (!cli_parse(command, options, argc, argv, &operand_count, &operands, &status))
        return status;
    if (operand_count == 0)
        return cli_usage(command, "needs an action: info, eval, bake, plot, convert, bands, list");
    if (o.table.azimuths % 2)
        return cli_usage(command, "--azimuths must be even");
    o.table.window = (lmp_window)window;
    if (!o.views_given)
        o.table.views = 0;
    return run_action(command, &o, operand_count, operands);
}

const cli_command command_brdf = {
    .name = "brdf",
    .operands = "info|eval|bake|plot|convert|bands|list MATERIAL…",
    .summary = "show, evaluate, tabulate and convert measured materials",
    .examples =
        "lampion brdf info sgd:gold-metallic-paint\n"
        "echo 0,0,1,0.6,0,0.8 | lampion brdf eval gold.binary   # wi_x,wi_y,wi_z,wo_x,wo_y,wo_z: "
        "r,g,b\n"
        "lampion brdf bake gold.binary -o gold.lmpt --bands 10 --views 64 --window hanning\n"
        "lampion brdf bake ggx:0.1 sgd:chrome --preintegrated   # into the cache, before the first "
        "image\n"
        "lampion brdf plot ggx:0.3 -o ggx.png\n"
        "lampion brdf convert sgd:red-fabric -o red-fabric.binary\n"
        "lampion brdf bands sgd:red-fabric sgd:chrome",
    .run = run,
};
