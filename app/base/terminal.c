/* SPDX-License-Identifier: MIT */
#include "app/base/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool quiet;

void terminal_be_quiet(void) {
    quiet = true;
}

bool terminal_is_quiet(void) {
    return quiet;
}

bool terminal_can_draw(void) {
    const char *const kind = getenv("TERM");
    return isatty(STDERR_FILENO) && kind && strcmp(kind, "dumb") != 0;
}
