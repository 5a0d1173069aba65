/* SPDX-License-Identifier: MIT */
#include "app/study/paper.h"
#include "app/base/choice.h"
#include "app/base/file_writer.h"
#include "app/base/progress.h"
#include "app/base/timing.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const paper_step steps[] = {
    { "basis", "Figure 2: the basis", paper_step_basis },
    { "lights", "Figure 3: simple lights", paper_step_lights },
    { "cap", "Figure 4: the cap of a sphere light", paper_step_cap },
    { "integral", "Equations 11 and 12, Annex A: the integral of a Legendre polynomial",
      paper_step_integral },
    { "operations", "Section 3: operations counted", paper_step_operations },
    { "table", "Section 4.2: analytic or tabulated", paper_step_table },
    { "san-miguel", "Figure 1: ten lights, ten bands", paper_step_san_miguel },
    { "sponza", "Figure 5: thirty lights, five and eight bands", paper_step_sponza },
    { "materials", "Figure 6: measured materials", paper_step_materials },
    { "cost", "What band limiting costs", paper_step_cost },
    { "preintegrated", "What preintegrated lobes cost", paper_step_preintegrated },
    { "gradients", "Beyond the paper: gradients", paper_step_gradients },
    { "fields", "Beyond the paper: fields of many lights", paper_step_fields },
    { "shadows", "What the paper leaves out: shadows", paper_step_shadows },
};
#define STEPS ((int)(sizeof steps / sizeof *steps))

static bool wanted(const paper *p, int step) {
    const cli_list *names = &p->options->steps;
    for (int i = 0; i < names->count; i++)
        if (strcmp(names->items[i], steps[step].name) == 0)
            return true;
    return names->count == 0;
}

const char *paper_step_help(char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "only this step, of:");
    for (int i = 0; i < STEPS && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, " %s", steps[i].name);
    if (used < size)
        snprintf(text + used, size - used, "; may be repeated");
    return text;
}

bool paper_has_step(const char *name, base_error *error) {
    const char *names[STEPS + 1] = { NULL };
    for (int i = 0; i < STEPS; i++) {
        names[i] = steps[i].name;
        if (strcmp(names[i], name) == 0)
            return true;
    }
    return choice_fail(error, "--step", name, names);
}

enum { WORDS_MAX = 64, LINE_MAX_SIZE = 16384 };

/* Splits a line in place at blanks outside quotes; returns the number of words. */
static int split_words(char *line, char *argv[WORDS_MAX]) {
    int argc = 0;
    while (*line && argc < WORDS_MAX - 1) {
        char *end = line;
        bool quoted = false;
        for (argv[argc++] = line; *line && (quoted || *line != ' '); line++) {
            if (*line == '\'')
                quoted = !quoted;
            else if (!quoted && *line == '\\' && line[1])
                *end++ = *++line;
            else
                *end++ = *line;
        }
        line += strspn(line, " ");
        *end = 0;
    }
    argv[argc] = NULL;
    return argc;
}

bool paper_run(paper *p, bool show, base_error *error, const char *format, ...) {
    char line[LINE_MAX_SIZE] = "lampion ", words[LINE_MAX_SIZE], *argv[WORDS_MAX];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line + strlen(line), sizeof line - strlen(line), format, arguments);
    va_end(arguments);
    memcpy(words, line, sizeof words);
    const int argc = split_words(words, argv);
    if (show)
        page_command(&p->page, line);
    if (p->options->run(argc - 1, argv + 1) != BASE_OK)
        return base_fail(error, NULL, "the command \"%s\" failed", line);
    return true;
}

bool paper_compare(const char *pixels, const char *truth, compare_result *result,
                   base_error *error) {
    image a = { .rgb = NULL }, b = { .rgb = NULL };
    const bool ok = image_read(pixels, IMAGE_READ_PIXELS, &a, error) &&
                    image_read(truth, IMAGE_READ_PIXELS, &b, error) &&
                    compare_images(&a, &b, 0, result, error);
    image_free(&a);
    image_free(&b);
    return ok;
}

static void introduce(paper *p) {
    char cpu[128];
    timing_cpu_name(cpu, sizeof cpu);
    page_begin(&p->page, "Efficient projection of sphere lights on spherical harmonics, reproduced",
               "Figures, tables and claims of P. Mézières and M. Paulin, <em>Projection efficace "
               "de lumières sphériques sur les harmoniques sphériques</em> (JFIG 2020), reproduced "
               "by <code>lampion paper</code>. Every number on this page was computed in this run; "
               "each section begins with the command that makes it alone.");
    page_text(&p->page, "Machine: %s, %ld CPUs. The paper's: Intel Xeon 2.10 GHz, RTX 2080. %s",
              cpu, sysconf(_SC_NPROCESSORS_ONLN),
              p->options->quick ? "A quick page (<code>--quick</code>): images are smaller than "
                                  "the paper's."
                                : "Images have the paper's sizes.");
}

/* Shows the command that runs a single step. */
static void show_command(paper *p, const char *step) {
    const cli_list *folders = &p->options->data;
    char line[LINE_MAX_SIZE], word[4200];
    int used = snprintf(line, sizeof line, "lampion paper -o DIR --step %s%s", step,
                        p->options->quick ? " --quick" : "");
    for (int i = 0; i < folders->count && used < LINE_MAX_SIZE; i++)
        if (paper_quote(folders->items[i], word, sizeof word))
            used += snprintf(line + used, sizeof line - (size_t)used, " --data %s", word);
    page_command(&p->page, line);
}

static void run_steps(paper *p, int *failures) {
    for (int i = 0; i < STEPS; i++) {
        base_error error = { "" };
        const double start = timing_now();
        if (!wanted(p, i))
            continue;
        progress_show(steps[i].name, (double)i / STEPS);
        page_section(&p->page, steps[i].title);
        show_command(p, steps[i].name);
        if (!steps[i].run(p, &error)) {
            page_failure(&p->page, error.text);
            fprintf(stderr, "lampion: %s: %s\n", steps[i].name, error.text);
            ++*failures;
        }
        page_text(&p->page, "<small>Step <code>%s</code>: %.1f s.</small>", steps[i].name,
                  timing_now() - start);
        if (isatty(STDERR_FILENO))
            fprintf(stderr, "%d of %d, %s: %.1f s\n", i + 1, STEPS, steps[i].name,
                    timing_now() - start);
    }
    progress_end();
}

/* Writes the page. The verdict is complete only when all steps have run, but precedes them on the
 * page. */
static bool write_page(paper *p, const char *sections, size_t size, base_error *error) {
    file_writer page;
    if (!file_write_begin(&page, "index.html", error))
        return false;
    p->page.html = page.stream;
    introduce(p);
    if (p->claim_count > 0 && !paper_write_verdict(p, error)) {
        file_write_abort(&page);
        return false;
    }
    fwrite(sections, 1, size, page.stream);
    page_end(&p->page);
    return file_write_commit(&page, error);
}

static bool write_all(paper *p, int *failures, base_error *error) {
    char *sections = NULL;
    size_t size = 0;
    p->page.html = open_memstream(&sections, &size);
    if (!p->page.html)
        return base_fail(error, NULL, "out of memory");
    *failures = 0;
    run_steps(p, failures);
    const bool ok = fclose(p->page.html) == 0 ? write_page(p, sections, size, error)
                                              : base_fail(error, NULL, "out of memory");
    free(sections);
    return ok;
}

/* Makes the page's folder the working directory. */
static bool enter(const char *directory, base_error *error) {
    if (mkdir(directory, 0777) != 0 && errno != EEXIST)
        return base_fail(error, directory, "cannot be created: %s", strerror(errno));
    return chdir(directory) == 0 ||
           base_fail(error, directory, "is no folder: %s", strerror(errno));
}

bool paper_write(const paper_options *options, int *failures, base_error *error) {
    paper *p = calloc(1, sizeof *p);
    if (!p)
        return base_fail(error, NULL, "out of memory");
    p->options = options;
    const bool ok = paper_data_find(&options->data, &p->data, error) &&
                    enter(options->directory, error) && write_all(p, failures, error);
    free(p);
    return ok;
}
