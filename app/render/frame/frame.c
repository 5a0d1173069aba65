/* SPDX-License-Identifier: MIT */
#include "app/render/frame/frame.h"

bool render_frame_check(const render_frame *frame, cli_error *error) {
    const unsigned reads = method_table[frame->method].reads;
    if (reads & METHOD_READS_PREINTEGRATED && !frame->lobes)
        return cli_fail(error, NULL, "preintegrated shading without its lobes");
    if (reads & METHOD_READS_FIELD && !frame->field)
        return cli_fail(error, NULL, "a field's shading without its field");
    return true;
}
