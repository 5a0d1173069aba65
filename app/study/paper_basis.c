/* SPDX-License-Identifier: MIT */
#include "app/study/paper.h"

#include <lampion/sh.h>

#include <math.h>

#define SIDE 64

/* Integrates ∫ Y_i Y_j over a product grid that is exact for these degrees; returns the largest
 * difference from 1 or 0. */
static double gram_error(int bands) {
    const int count = bands * bands;
    double worst = 0, sums[25 * 25] = { 0 };
    for (int a = 0; a < SIDE; a++)
        for (int b = 0; b < SIDE; b++) {
            /* Chebyshev nodes of the polar angle with Clenshaw-Curtis-like weights */
            const double theta = M_PI * (a + 0.5) / SIDE, phi = 2 * M_PI * b / SIDE;
            double weight = 1;
            float y[25];
            for (int k = 1; k <= SIDE / 2 - 1; k++)
                weight -= 2 * cos(2 * k * theta) / (4.0 * k * k - 1);
            weight *= 2.0 / SIDE * 2 * M_PI / SIDE;
            lmp_sh_eval(bands,
                        (lmp_vec3) { (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                                     (float)cos(theta) },
                        y);
            for (int i = 0; i < count * count; i++)
                sums[i] += weight * (double)y[i / count] * (double)y[i % count];
        }
    for (int i = 0; i < count * count; i++)
        worst = fmax(worst, fabs(sums[i] - (i / count == i % count)));
    return worst;
}

bool paper_step_basis(paper *p, base_error *error) {
    if (!paper_run(p, true, error, "basis --bands 5 --size 1200x760 -o figure2.png"))
        return false;
    page_image(&p->page, "figure2.png",
               "The first five bands; red is positive, green negative, the zonal column shaded.");
    page_text(&p->page,
              "They are orthonormal: the largest deviation of ∫ Y<sub>i</sub> Y<sub>j</sub> from 1 "
              "or 0, over 5 bands by quadrature of the float32 functions, is %.1e.",
              gram_error(5));
    return true;
}
