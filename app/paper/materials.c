/* SPDX-License-Identifier: MIT */
/* Figure 6: measured materials, here the fits of the MERL database that come with the program. */
#include "app/paper/paper.h"

/* The paper's materials are RGL measurements, which may not be passed on; these look like them. */
static const struct {
    const char *letter, *paper, *ours;
} materials[] = {
    { "a", "paper_white", "white-paint" },
    { "b", "ilm_solo_millennium_falcon", "grease-covered-steel" },
    { "c", "acrylic_felt_orange", "orange-paint" },
    { "d", "ilm_solo_m_68", "nickel" },
    { "e", "cc_amber_citrine", "specular-yellow-phenolic" },
};
enum { MATERIALS = sizeof materials / sizeof *materials, CUTS = 2 };
static const int cuts[CUTS] = { 10, 20 };

/* One material: the pictures at each number of bands, the ground truth, and their difference. */
static bool make_material(paper *p, int number, page_table *table, cli_error *error) {
    const char *letter = materials[number].letter, *name = materials[number].ours;
    char common[256], truth[64];
    snprintf(common, sizeof common, "builtin:ball --material test_material=sgd:%s --size %s", name,
             p->options->full ? "600x816" : "300x408");
    snprintf(truth, sizeof truth, "figure6-%s-truth.exr", letter);
    if (!paper_run(p, false, error, "reference %s --spp 64 -o %s", common, truth))
        return false;
    for (int c = 0; c < CUTS; c++) {
        char picture[64];
        compare_result result;
        snprintf(picture, sizeof picture, "figure6-%s-%d.exr", letter, cuts[c]);
        if (!paper_run(p, false, error, "render %s --bands %d --window hanning -o %s", common,
                       cuts[c], picture) ||
            !paper_compare(picture, truth, &result, error))
            return false;
        page_table_row(table, "%s|%s|%s|%d|%.2e|%.4f", letter, materials[number].paper, name,
                       cuts[c], result.values[COMPARE_RELMSE], result.values[COMPARE_SSIM]);
    }
    return true;
}

/* The pictures side by side: ground truth, 10 bands, 20 bands; one exposure for all three. */
static bool show_material(paper *p, int number, cli_error *error) {
    const char *letter = materials[number].letter;
    const char *const kinds[] = { "truth", "10", "20" };
    float exposure = 0;
    for (int k = 0; k < 3; k++) {
        char from[64], to[64], caption[160];
        image picture;
        snprintf(from, sizeof from, "figure6-%s-%s.exr", letter, kinds[k]);
        snprintf(to, sizeof to, "figure6-%s-%s.png", letter, kinds[k]);
        if (!image_read(from, &picture, error))
            return false;
        exposure = k == 0 ? image_auto_exposure(&picture) : exposure;
        const bool ok = image_write(&picture, to, exposure, error);
        image_free(&picture);
        if (!ok)
            return false;
        snprintf(caption, sizeof caption, "(%s) %s, %s%s", letter, materials[number].ours,
                 k ? kinds[k] : "ground truth", k ? " bands" : "");
        page_picture(&p->page, to, caption);
    }
    return true;
}

bool paper_step_materials(paper *p, cli_error *error) {
    page_table table;
    page_text(&p->page,
              "The paper renders five measured materials at 600×816 under 10 sphere lights in "
              "less than 3 ms each with 10 bands, and (d) in 105 ms with 20. Its RGL files may not "
              "be passed on; these are fits of MERL materials of like gloss (Bagher et al. 2012). "
              "Errors are against the whole BRDF.");
    page_command(&p->page, "lampion render builtin:ball --material "
                           "test_material=sgd:NAME --bands 10 --window hanning -o figure6.exr\n"
                           "lampion reference builtin:ball --material "
                           "test_material=sgd:NAME --spp 64 -o figure6-truth.exr");
    if (!page_table_begin(&p->page, &table, "figure6",
                          "figure|paper's material|material|bands|relative MSE|SSIM", error))
        return false;
    for (int i = 0; i < MATERIALS; i++)
        if (!make_material(p, i, &table, error))
            return false;
    if (!page_table_end(&table, error))
        return false;
    bool ok = true;
    for (int i = 0; ok && i < MATERIALS; i++) {
        page_row_begin(&p->page);
        ok = show_material(p, i, error);
        page_row_end(&p->page);
    }
    return ok;
}
