/* SPDX-License-Identifier: MIT */
#include "app/base/file_writer.h"
#include "app/render/zonal.h"
#include "app/study/paper.h"
#include "app/study/paper_legendre.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

/* Draws the section of Fig. 4b in pixels: x, the unit circle around it, the light and its
 * tangents. */
static bool draw_geometry(const char *file, base_error *error) {
    const double unit = 110, distance = 330, radius = 120, x = 150, y = 170;
    const double a = asin(radius / distance), reach = sqrt(distance * distance - radius * radius);
    const double tx = reach * cos(a), ty = reach * sin(a), cx = unit * cos(a), cy = unit * sin(a);
    file_writer writer;
    if (!file_write_begin(&writer, file, error))
        return false;
    FILE *const svg = writer.stream;
    fprintf(svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 340\" width=\"640\" "
            "height=\"340\" font-family=\"system-ui,sans-serif\" font-size=\"17\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n"
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#cfe0f5\" stroke=\"#1f5fa8\"/>\n"
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" stroke=\"#999\"/>\n",
            x + distance, y, radius, x, y, unit);
    fprintf(svg,
            "<path d=\"M%.1f %.1fL%.1f %.1fM%.1f %.1fL%.1f %.1f\" stroke=\"#c0392b\"/>\n"
            "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#333\" stroke-dasharray=\"5 4\"/>\n"
            "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#1f5fa8\"/>\n"
            "<path d=\"M%.2f %.2fA%.1f %.1f 0 0 1 %.2f %.2f\" fill=\"none\" stroke=\"#c0392b\" "
            "stroke-width=\"5\"/>\n",
            x, y, x + tx, y - ty, x, y, x + tx, y + ty, x, y, x + distance, x + distance, y, x + tx,
            y - ty, x + cx, y - cy, unit, unit, x + cx, y + cy);
    fprintf(svg,
            "<text x=\"%.1f\" y=\"%.1f\">x</text><text x=\"%.1f\" y=\"%.1f\">d</text>"
            "<text x=\"%.1f\" y=\"%.1f\" fill=\"#1f5fa8\">r</text>"
            "<text x=\"%.1f\" y=\"%.1f\" fill=\"#c0392b\">Q</text>"
            "<text x=\"%.1f\" y=\"%.1f\">a</text>"
            "<text x=\"%.1f\" y=\"%.1f\" fill=\"#555\">sin a = r/d</text>\n</svg>\n",
            x - 16, y + 6, x + 190, y + 20, x + tx + 22, y - ty / 2, x + cx + 6, y - cy - 4, x + 52,
            y - 6, 20.0, 30.0);
    return file_write_commit(&writer, error);
}

/* Implementations of the zonal coefficients in float32. */
enum { PRINTED, SLOAN, LIBRARY, FORMS };
static const int counts[] = { 3, 6, 10, 30, 128 };
enum { COUNTS = sizeof counts / sizeof *counts, LIGHTS = 8 };

typedef double zonal_errors[FORMS][COUNTS];

/* Raises `errors` to those of one light, relative to the largest of so many coefficients. */
static void raise_errors(float ratio, zonal_errors errors) {
    double truth[LMP_BANDS_MAX];
    float zonal[FORMS][LMP_BANDS_MAX] = { { 0 } };
    const float cos_a = sqrtf(1 - ratio * ratio);
    zonal_printed(LMP_BANDS_MAX, cos_a, zonal[PRINTED]);
    zonal_sloan(ZONAL_SLOAN_BANDS, cos_a, zonal[SLOAN]);
    lmp_sphere_project_zonal(LMP_BANDS_MAX, ratio, 1, zonal[LIBRARY]);
    for (int l = 0; l < LMP_BANDS_MAX; l++)
        truth[l] = paper_zonal(l, asin((double)ratio));
    for (int form = 0; form < FORMS; form++) {
        double largest = 0, worst = 0;
        for (int l = 0, k = 0; l < LMP_BANDS_MAX; l++) {
            largest = fmax(largest, fabs(truth[l]));
            worst = fmax(worst, fabs((double)zonal[form][l] - truth[l]));
            if (l + 1 == counts[k]) {
                errors[form][k] = fmax(errors[form][k], worst / largest);
                k++;
            }
        }
    }
}

/* Evaluates Eq. 11 in double. */
static double closed_delta(int l, double cos_a) {
    if (l == 0)
        return 1 - cos_a;
    return (paper_legendre(l - 1, cos_a) - paper_legendre(l + 1, cos_a)) / (2 * l + 1);
}

/* Returns the error of Eq. 12 as printed, in double, for so many bands, relative to the largest
 * value. */
static double printed_error(int bands, double a) {
    double worst = 0, largest = 0;
    for (int l = 0; l < bands; l++) {
        const double truth = paper_zonal(l, a);
        const double printed = sqrt(M_PI * (2 * l + 1)) * closed_delta(l, cos(a));
        worst = fmax(worst, fabs(printed - truth));
        largest = fmax(largest, fabs(truth));
    }
    return worst / largest;
}

/* Tests robustness in float32 and in double: the paper's shaders compute in single precision, so a
 * formula that only holds in double is not robust there, and the verdict distinguishes the two. */
static void claim_robust(paper *p) {
    const float ratio = 1e-3f;
    const double most = 1e-3, in_double = printed_error(counts[2], asin((double)ratio));
    zonal_errors far = { { 0 } };
    raise_errors(ratio, far);
    paper_claim_add(p,
                    far[PRINTED][2] <= most ? PAPER_HOLDS
                    : in_double <= most     ? PAPER_IMPRECISE
                                            : PAPER_FAILS,
                    (paper_claim) { "the projection is robust to lights far away and near",
                                    "no number", "Eq. 12 as printed, in float32 and in double",
                                    "Eq. 12 as printed subtracts Legendre polynomials that agree "
                                    "to many digits, which double has to spare; by differences, as "
                                    "the library has it, far lights keep theirs in float32" },
                    "error of a light at r/d 0.001, 10 bands: %.0e in float32, %.0e in double; "
                    "library %.0e in float32",
                    far[PRINTED][2], in_double, far[LIBRARY][2]);
}

static bool write_errors(paper *p, base_error *error) {
    const float ratios[] = { 1, 0.9f, 0.5f, 0.1f, 0.01f, 1e-3f, 1e-4f, 1e-6f };
    page_table table;
    page_text(&p->page,
              "The cap's zonal coefficients against quadrature of Eq. 8 in double: largest "
              "difference, in parts of the largest coefficient, of %d lights from r/d to 2 %% "
              "below, all computed in float32. Eq. 12 as printed loses small lights to "
              "cancellation; Sloan's closed forms (2008, %d bands) begin with the same cos a, "
              "which has lost them already; the library's form does not.",
              LIGHTS, ZONAL_SLOAN_BANDS);
    if (!page_table_begin(&p->page, &table, "accuracy",
                          "r/d|printed, 3 bands|printed, 6|printed, 10|printed, 30|printed, 128|"
                          "Sloan, 3 bands|Sloan, 6|library, 3 bands|library, 6|library, 10|"
                          "library, 30|library, 128",
                          error))
        return false;
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++) {
        zonal_errors e = { { 0 } };
        for (int light = 0; light < LIGHTS; light++)
            raise_errors(ratios[i] * (1 - 0.02f * (float)light / LIGHTS), e);
        page_table_row(&table, "%g|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e|%.1e",
                       (double)ratios[i], e[PRINTED][0], e[PRINTED][1], e[PRINTED][2],
                       e[PRINTED][3], e[PRINTED][4], e[SLOAN][0], e[SLOAN][1], e[LIBRARY][0],
                       e[LIBRARY][1], e[LIBRARY][2], e[LIBRARY][3], e[LIBRARY][4]);
    }
    claim_robust(p);
    return page_table_end(&table, error);
}

bool paper_step_cap(paper *p, base_error *error) {
    if (!draw_geometry("figure4.svg", error))
        return false;
    page_image(&p->page, "figure4.svg",
               "A sphere of radius r at distance d covers a cap Q of half angle a of the unit "
               "sphere around the shaded point x.");
    return write_errors(p, error);
}

bool paper_step_integral(paper *p, base_error *error) {
    enum { DEGREES = 129, COSINES = 9 };
    double degrees[DEGREES], errors[DEGREES], worst = 0, worst_rule = 0;
    const double cosines[COSINES] = { 0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, -0.5, -0.9 };
    for (int l = 0; l < DEGREES; l++) {
        degrees[l] = l;
        errors[l] = 1e-18; /* so that an exact value is visible */
        for (int i = 0; i < COSINES; i++) {
            const double difference = closed_delta(l, cosines[i]) - paper_delta(l, cosines[i]);
            errors[l] = fmax(errors[l], fabs(difference));
        }
        worst = fmax(worst, errors[l]);
        /* the rule of Annex A, differentiated: (2l+1) P_l = P'_(l+1) - P'_(l-1) */
        const double h = 1e-4, x = 0.37;
        if (l > 0 && l <= 20) {
            const double slope = ((paper_legendre(l + 1, x + h) - paper_legendre(l - 1, x + h)) -
                                  (paper_legendre(l + 1, x - h) - paper_legendre(l - 1, x - h))) /
                                 (2 * h * (2 * l + 1));
            worst_rule = fmax(worst_rule, fabs(slope - paper_legendre(l, x)));
        }
    }
    page_text(&p->page,
              "Eq. 11 in double against quadrature of its left side, l = 0 … 128 and nine angles: "
              "the largest absolute difference is <b>%.1e</b>. Annex A's antiderivative, "
              "differentiated numerically for l ≤ 20: %.1e (the step's own error is that large).",
              worst, worst_rule);
    const figure_series series = { "Eq. 11 − quadrature", degrees, errors, DEGREES };
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = "equation11",
                                            .title = "Eq. 11: closed form against quadrature",
                                            .x_label = "degree l",
                                            .y_label = "largest difference",
                                            .log_y = true,
                                            .series = &series,
                                            .series_count = 1 },
                           error);
}
