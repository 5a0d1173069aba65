/* SPDX-License-Identifier: MIT */
/* paper_page.h - one HTML page with its images, plots (SVG) and tables (also CSV), in one
 * folder. */
#ifndef LAMPION_STUDY_PAPER_PAGE_H
#define LAMPION_STUDY_PAPER_PAGE_H

#include "app/base/file_writer.h"
#include "app/image/plot.h"

/* A page; its files are written to the working directory. */
typedef struct paper_page {
    FILE *html;
} paper_page;

void page_begin(paper_page *page, const char *title, const char *lead);
void page_end(paper_page *page);
void page_section(paper_page *page, const char *title);
/* Writes a paragraph; the format may contain HTML. */
void page_text(paper_page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Shows the command that made what follows. */
void page_command(paper_page *page, const char *command);
void page_failure(paper_page *page, const char *text);
/* Begin and end a row, whose images stand side by side if there is room. */
void page_row_begin(paper_page *page);
void page_row_end(paper_page *page);
void page_image(paper_page *page, const char *file, const char *caption);

/* Begin and end tables that break the lines of their cells. */
void page_wrapped_begin(paper_page *page);
void page_wrapped_end(paper_page *page);

/* A table, also written to FILE.csv. Cells are separated by '|'. */
typedef struct page_table {
    paper_page *page;
    file_writer csv;
    char file[64];
} page_table;
bool page_table_begin(paper_page *page, page_table *table, const char *file, const char *heads,
                      base_error *error);
void page_table_row(page_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool page_table_end(page_table *table, base_error *error);

/* Writes a plot to FILE.svg, and its points to FILE.csv. */
bool page_plot_write(paper_page *page, const figure_plot *plot, base_error *error);

#endif
