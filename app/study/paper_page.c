/* SPDX-License-Identifier: MIT */
#include "app/study/paper_page.h"

#include <stdarg.h>
#include <string.h>

static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:1060px;margin:0 auto;padding:1em;"
    "color:#1d2126;background:#fff}h1{line-height:1.15}h2{margin-top:2.2em;border-top:1px solid "
    "#ccd2d9;padding-top:.8em}figure{margin:1em 0}img{max-width:100%;height:auto;display:block}"
    "figcaption{color:#555d66;font-size:14px;margin-top:.3em}pre{background:#f1f3f5;padding:.6em "
    ".8em;overflow-x:auto;font-size:13px;white-space:pre-wrap;overflow-wrap:anywhere}"
    ".row{display:flex;flex-wrap:wrap;gap:0 1em}.row figure{flex:1 1 200px}"
    ".wide{overflow-x:auto}table{border-collapse:collapse;font-size:14px;margin:.6em 0}"
    "th,td{padding:.25em .7em;text-align:right;border-bottom:1px solid #dde1e6;white-space:nowrap}"
    ".wrapped th,.wrapped td{white-space:normal;text-align:left;vertical-align:top}"
    "th:first-child,td:first-child{text-align:left}th{background:#f1f3f5}"
    ".failed{background:#fde8e8;border-left:4px solid #c0392b;padding:.6em .8em}";

void page_begin(paper_page *page, const char *title, const char *lead) {
    fprintf(page->html,
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
            "name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>%s</title>\n"
            "<style>%s</style></head><body>\n<h1>%s</h1>\n<p>%s</p>\n",
            title, style, title, lead);
}

void page_end(paper_page *page) {
    fputs("</body></html>\n", page->html);
}

static void put_escaped(FILE *html, const char *text) {
    for (; *text; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", html);
            break;
        case '>':
            fputs("&gt;", html);
            break;
        case '&':
            fputs("&amp;", html);
            break;
        case '"':
            fputs("&quot;", html);
            break;
        default:
            fputc(*text, html);
        }
}

void page_section(paper_page *page, const char *title) {
    fprintf(page->html, "<h2>%s</h2>\n", title);
}

void page_text(paper_page *page, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("<p>", page->html);
    vfprintf(page->html, format, arguments);
    fputs("</p>\n", page->html);
    va_end(arguments);
}

void page_command(paper_page *page, const char *command) {
    fputs("<pre>", page->html);
    put_escaped(page->html, command);
    fputs("</pre>\n", page->html);
}

void page_failure(paper_page *page, const char *text) {
    fputs("<p class=\"failed\">This step failed: ", page->html);
    put_escaped(page->html, text);
    fputs("</p>\n", page->html);
}

void page_row_begin(paper_page *page) {
    fputs("<div class=\"row\">\n", page->html);
}

void page_row_end(paper_page *page) {
    fputs("</div>\n", page->html);
}

void page_image(paper_page *page, const char *file, const char *caption) {
    fprintf(page->html,
            "<figure><a href=\"%s\"><img src=\"%s\" alt=\"%s\"></a><figcaption>%s</figcaption>"
            "</figure>\n",
            file, file, caption, caption);
}

void page_wrapped_begin(paper_page *page) {
    fputs("<div class=\"wrapped\">\n", page->html);
}

void page_wrapped_end(paper_page *page) {
    fputs("</div>\n", page->html);
}

/* --- tables ----------------------------------------------------------------------------------- */

/* Writes a cell of a CSV file (RFC 4180). */
static void put_cell(FILE *csv, const char *cell, size_t length) {
    if (!memchr(cell, ',', length)) {
        fwrite(cell, 1, length, csv);
        return;
    }
    fputc('"', csv);
    for (size_t i = 0; i < length; i++) {
        if (cell[i] == '"')
            fputc('"', csv);
        fputc(cell[i], csv);
    }
    fputc('"', csv);
}

static void put_row(page_table *table, const char *cells, const char *tag) {
    FILE *const html = table->page->html, *const csv = table->csv.stream;
    fprintf(html, "<tr>");
    for (const char *cell = cells;; cell++) {
        const size_t length = strcspn(cell, "|");
        fprintf(html, "<%s>%.*s</%s>", tag, (int)length, cell, tag);
        put_cell(csv, cell, length);
        cell += length;
        if (!*cell)
            break;
        fputc(',', csv);
    }
    fprintf(html, "</tr>\n");
    fputc('\n', csv);
}

bool page_table_begin(paper_page *page, page_table *table, const char *file, const char *heads,
                      base_error *error) {
    table->page = page;
    snprintf(table->file, sizeof table->file, "%s.csv", file);
    if (!file_write_begin(&table->csv, table->file, error))
        return false;
    fputs("<div class=\"wide\"><table>\n", page->html);
    put_row(table, heads, "th");
    return true;
}

void page_table_row(page_table *table, const char *format, ...) {
    char cells[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cells, sizeof cells, format, arguments);
    va_end(arguments);
    put_row(table, cells, "td");
}

bool page_table_end(page_table *table, base_error *error) {
    fprintf(table->page->html, "</table></div>\n<p><a href=\"%s\">%s</a></p>\n", table->file,
            table->file);
    return file_write_commit(&table->csv, error);
}

/* --- plots ------------------------------------------------------------------------------------ */

static bool write_file(const figure_plot *plot, const char *extension,
                       void (*put)(FILE *, const figure_plot *), base_error *error) {
    char path[80];
    snprintf(path, sizeof path, "%s.%s", plot->file, extension);
    file_writer file;
    if (!file_write_begin(&file, path, error))
        return false;
    put(file.stream, plot);
    return file_write_commit(&file, error);
}

bool page_plot_write(paper_page *page, const figure_plot *plot, base_error *error) {
    char path[80], caption[160];
    if (!write_file(plot, "svg", figure_plot_draw, error) ||
        !write_file(plot, "csv", figure_plot_list, error))
        return false;
    snprintf(path, sizeof path, "%s.svg", plot->file);
    snprintf(caption, sizeof caption, "%s (points: %s.csv)", plot->title, plot->file);
    page_image(page, path, caption);
    return true;
}
