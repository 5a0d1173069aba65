/* SPDX-License-Identifier: MIT */
#include "app/render/frame.h"

bool render_frame_check(const render_frame *frame, base_error *error) {
    const unsigned reads = method_table[frame->method].reads;
    if (reads & METHOD_READS_PREINTEGRATED && !frame->lobes)
        return base_fail(error, NULL, "preintegrated shading without its lobes");
    if (reads & METHOD_READS_FIELD && !frame->field)
        return base_fail(error, NULL, "a field's shading without its field");
    return true;
}

bool render_goes_on(const render_frame *frame, base_error *error) {
    return !frame->progress || !atomic_load(&frame->progress->cancelled) ||
           base_fail(error, NULL, "drawing the image was cancelled");
}
