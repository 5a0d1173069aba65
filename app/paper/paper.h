/* SPDX-License-Identifier: MIT */
/* paper.h - the figures, tables and claims of Mézières and Paulin 2020, reproduced and put beside
 * what the paper says: one HTML page.
 *
 *     paper claim page             the steps in order, the verdict, HTML
 *     data                         the paper's scenes and materials, or what stands in for them
 *     frame                        frames drawn and timed on the devices of this machine
 *     scenes detail                figures 1 and 5; parts of their images, enlarged
 *     materials materials_time     figure 6
 *     basis lights cap operations table cost preintegrated gradients fields shadows
 *                                  the other steps, a file each
 *     legendre                     what the steps judge formulas by */
#ifndef LAMPION_PAPER_H
#define LAMPION_PAPER_H

#include "app/compare/compare.h"
#include "app/paper/data.h"
#include "app/paper/page.h"
#include "app/render/renderer.h"

/* Runs a command line of the program ("render builtin:atrium …"); returns its exit status. */
typedef int (*paper_runner)(int argc, char **argv);

typedef struct paper_options {
    const char *directory; /* created if it is not there */
    bool quick;            /* smaller images, for who waits; else the paper's sizes */
    cli_list data;         /* folders with the paper's scenes and materials, absolute */
    cli_list steps;        /* the names of those to run; none means all */
    paper_runner run;
} paper_options;

/* Whether there is such a step; *error names those there are. */
bool paper_has_step(const char *name, cli_error *error);

/* Writes index.html and its files. A step that fails says so in the page, and *failures counts it;
 * the others go on. False only if the page itself cannot be written. */
bool paper_write(const paper_options *options, int *failures, cli_error *error);

/* --- for the steps ---------------------------------------------------------------------------- */

typedef enum paper_verdict {
    PAPER_HOLDS,
    PAPER_FAILS,
    PAPER_IMPRECISE, /* the formula as printed fails in single precision alone */
    PAPER_ELSEWHERE, /* the paper measured on a GPU what a CPU does here */
    PAPER_UNLIKE     /* the paper says it of a scene or material that something stands in for */
} paper_verdict;

/* What the paper says, its number, on what the verdict rests, and why it holds or not. */
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
    char sources[PAPER_STAND_IN + 1][512]; /* what the steps have shown, by where it is from */
    paper_page page;
    paper_judged claims[PAPER_CLAIMS_MAX];
    int claim_count;
} paper;

/* Adds a claim to the verdict, with which the page begins; the format is of what was measured. */
void paper_claim_add(paper *p, paper_verdict verdict, paper_claim claim, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool paper_write_verdict(paper *p, cli_error *error);

/* Has the verdict name what a step shows. */
void paper_name_source(paper *p, paper_source source, const char *name);

/* A frame's time by its pixels, lights and bands. */
double paper_nanoseconds(double milliseconds, const int size[2], int lights, int bands);

typedef struct paper_step {
    const char *name, *title;
    bool (*run)(paper *p, cli_error *error);
} paper_step;

bool paper_step_basis(paper *p, cli_error *error);
bool paper_step_lights(paper *p, cli_error *error);
bool paper_step_cap(paper *p, cli_error *error);
bool paper_step_integral(paper *p, cli_error *error);
bool paper_step_operations(paper *p, cli_error *error);
bool paper_step_table(paper *p, cli_error *error);
bool paper_step_san_miguel(paper *p, cli_error *error);
bool paper_step_sponza(paper *p, cli_error *error);
bool paper_step_materials(paper *p, cli_error *error);
bool paper_step_cost(paper *p, cli_error *error);
bool paper_step_preintegrated(paper *p, cli_error *error);
bool paper_step_gradients(paper *p, cli_error *error);
bool paper_step_fields(paper *p, cli_error *error);
bool paper_step_shadows(paper *p, cli_error *error);

/* Runs a command line of the program, its words as paper_quote writes them, blanks between them;
 * `show` puts it on the page. */
bool paper_run(paper *p, bool show, cli_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Compares two files of images. */
bool paper_compare(const char *pixels, const char *truth, compare_result *result, cli_error *error);

#endif
