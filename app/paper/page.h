/* SPDX-License-Identifier: MIT */
/* page.h - one HTML page with its images, plots (SVG) and tables (CSV too), all in one folder. */
#ifndef LAMPION_PAPER_PAGE_H
#define LAMPION_PAPER_PAGE_H

#include "app/figure/plot.h"
#include "app/file/file.h"

/* Files are written into the working directory, beside the page. */
typedef struct paper_page {
    FILE *html;
} paper_page;

void page_begin(paper_page *page, const char *title, const char *lead);
void page_end(paper_page *page);
void page_section(paper_page *page, const char *title);
/* A paragraph; the format may hold HTML. */
void page_text(paper_page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The command that made what follows. */
void page_command(paper_page *page, const char *command);
void page_failure(paper_page *page, const char *text);
/* Images between these stand side by side where there is room. */
void page_row_begin(paper_page *page);
void page_row_end(paper_page *page);
void page_image(paper_page *page, const char *file, const char *caption);

/* Tables between these break the lines of their cells. */
void page_wrapped_begin(paper_page *page);
void page_wrapped_end(paper_page *page);

/* A table, written to FILE.csv too. Cells are separated by '|'. */
typedef struct page_table {
    paper_page *page;
    file_writer csv;
    char file[64];
} page_table;
bool page_table_begin(paper_page *page, page_table *table, const char *file, const char *heads,
                      cli_error *error);
void page_table_row(page_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool page_table_end(page_table *table, cli_error *error);

/* A plot, written to FILE.svg, its points to FILE.csv. */
bool page_plot_write(paper_page *page, const figure_plot *plot, cli_error *error);

#endif
