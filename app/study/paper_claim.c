/* SPDX-License-Identifier: MIT */
/* The verdict: the paper's claims beside the measurements of the steps. */
#include "app/study/paper.h"

#include <stdarg.h>
#include <string.h>

static const char *const verdicts[] = {
    [PAPER_HOLDS] = "holds",
    [PAPER_FAILS] = "does not hold",
    [PAPER_IMPRECISE] = "not as printed in single precision",
    [PAPER_ELSEWHERE] = "not on this device",
    [PAPER_UNLIKE] = "not on stand-ins",
};

void paper_claim_add(paper *p, paper_verdict verdict, paper_claim claim, const char *format, ...) {
    if (p->claim_count == PAPER_CLAIMS_MAX)
        return;
    paper_judged *judged = &p->claims[p->claim_count++];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(judged->here, sizeof judged->here, format, arguments);
    va_end(arguments);
    judged->verdict = verdict;
    judged->claim = claim;
}

void paper_name_source(paper *p, paper_source source, const char *name) {
    char *const names = p->sources[source];
    const size_t used = strlen(names), size = sizeof p->sources[source];
    snprintf(names + used, size - used, "%s%s", used ? ", " : "", name);
}

/* Lists what the steps have shown. */
static void tell_sources(paper *p) {
    static const char *const texts[] = {
        [PAPER_MEASURED] = "On the paper's own data",
        [PAPER_FIT] = "On fits, which are not the measurements",
        [PAPER_STAND_IN] = "On stand-ins, for want of data",
    };
    for (int i = 0; i <= PAPER_STAND_IN; i++)
        if (p->sources[i][0])
            page_text(&p->page, "%s: <b>%s</b>.", texts[i], p->sources[i]);
}

double paper_nanoseconds(double milliseconds, const int size[2], int lights, int bands) {
    return milliseconds * 1e6 / ((double)size[0] * size[1] * lights * bands);
}

bool paper_write_verdict(paper *p, base_error *error) {
    page_table table;
    page_section(&p->page, "Verdict");
    page_text(&p->page,
              "What the paper claims, in translation, beside what this run has measured. Times are "
              "of the whole frame, and in nanoseconds a pixel, light and band, so that machines "
              "and sizes compare. Claims of "
              "steps that were left out are not listed.");
    tell_sources(p);
    page_wrapped_begin(&p->page);
    if (!page_table_begin(&p->page, &table, "verdict", "claim|paper|here|verdict|rests on|why",
                          error))
        return false;
    for (int i = 0; i < p->claim_count; i++) {
        const paper_judged *judged = &p->claims[i];
        page_table_row(&table, "%s|%s|%s|%s|%s|%s", judged->claim.text, judged->claim.number,
                       judged->here, verdicts[judged->verdict], judged->claim.basis,
                       judged->claim.why);
    }
    const bool ok = page_table_end(&table, error);
    page_wrapped_end(&p->page);
    return ok;
}
