/* SPDX-License-Identifier: MIT */
/* paper.h - reproduces the figures, tables and claims of Mézières and Paulin 2020, and sets them
 * beside what the paper says, on one HTML page.
 *
 *     paper claim page             the steps in order, the verdict, HTML
 *     data                         the paper's scenes and materials, or what stands in for them
 *     frame                        frames drawn and timed on the devices of this machine
 *     scenes detail                figures 1 and 5; parts of their images, enlarged
 *     materials materials_time     figure 6
 *     basis lights cap operations table cost preintegrated gradients fields shadows
 *                                  the other steps, one file each: a new one is declared below
 *                                  and added as a row of paper.c
 *     legendre                     the values by which the steps judge formulas */
#ifndef LAMPION_STUDY_PAPER_H
#define LAMPION_STUDY_PAPER_H

#include "app/base/cli.h"
#include "app/image/compare.h"
#include "app/render/renderer/renderer.h"
#include "app/study/paper_data.h"
#include "app/study/paper_page.h"

/* Runs a command line of the program ("render builtin:atrium …"); returns its exit status. */
typedef int (*paper_runner)(int argc, char **argv);

typedef struct paper_options {
    const char *directory; /* created if it does not exist */
    bool quick;            /* smaller images; else the paper's sizes */
    cli_list data;         /* folders with the paper's scenes and materials, absolute */
    cli_list steps;        /* names of the steps to run; empty: all */
    paper_runner run;
} paper_options;

/* Writes the help of an option that chooses steps, which lists their names, to `text`. Returns
 * `text`. */
const char *paper_step_help(char *text, size_t size);

/* Whether there is such a step; if not, *error lists those that there are. */
bool paper_has_step(const char *name, base_error *error);

/* Writes index.html and its files. A step that fails is reported on the page and counted in
 * *failures; the others still run. Returns false only if the page itself cannot be written. */
bool paper_write(const paper_options *options, int *failures, base_error *error);

/* --- for the steps ---------------------------------------------------------------------------- */

typedef enum paper_verdict {
    PAPER_HOLDS,
    PAPER_FAILS,
    PAPER_IMPRECISE, /* the formula as printed fails only in single precision */
    PAPER_ELSEWHERE, /* the paper measured on a GPU what runs on a CPU here */
    PAPER_UNLIKE     /* the claim concerns a scene or material that has a stand-in here */
} paper_verdict;

/* The paper's claim and its number, the basis of the verdict, and the reason why the claim holds or
 * fails. */
typedef struct paper_claim {
    const char *text, *number;
    char basis[160];
    const char *why;
} paper_claim;

typedef struct paper_judged {
    paper_claim claim;
    paper_verdict verdict;
    char here[256]; /* what was measured */
} paper_judged;

#define PAPER_CLAIMS_MAX 32

typedef struct paper {
    const paper_options *options;
    paper_data data;
    char sources[PAPER_STAND_IN + 1][512]; /* names of what the steps have shown, by source */
    paper_page page;
    paper_judged claims[PAPER_CLAIMS_MAX];
    int claim_count;
} paper;

/* Adds a claim to the verdict, with which the page begins; `format` is for what was measured. */
void paper_claim_add(paper *p, paper_verdict verdict, paper_claim claim, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool paper_write_verdict(paper *p, base_error *error);

/* Adds what a step shows to the sources that the verdict names. */
void paper_name_source(paper *p, paper_source source, const char *name);

/* Returns a frame's time per pixel, light and band, in nanoseconds. */
double paper_nanoseconds(double milliseconds, const int size[2], int lights, int bands);

typedef struct paper_step {
    const char *name, *title;
    bool (*run)(paper *p, base_error *error);
} paper_step;

bool paper_step_basis(paper *p, base_error *error);
bool paper_step_lights(paper *p, base_error *error);
bool paper_step_cap(paper *p, base_error *error);
bool paper_step_integral(paper *p, base_error *error);
bool paper_step_operations(paper *p, base_error *error);
bool paper_step_table(paper *p, base_error *error);
bool paper_step_san_miguel(paper *p, base_error *error);
bool paper_step_sponza(paper *p, base_error *error);
bool paper_step_materials(paper *p, base_error *error);
bool paper_step_cost(paper *p, base_error *error);
bool paper_step_preintegrated(paper *p, base_error *error);
bool paper_step_gradients(paper *p, base_error *error);
bool paper_step_fields(paper *p, base_error *error);
bool paper_step_shadows(paper *p, base_error *error);

/* Runs a command line of the program, whose words are written by paper_quote and separated by
 * spaces; `show` puts it on the page. */
bool paper_run(paper *p, bool show, base_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Compares two image files. */
bool paper_compare(const char *pixels, const char *truth, compare_result *result,
                   base_error *error);

#endif
