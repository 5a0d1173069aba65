/* SPDX-License-Identifier: MIT */
/* When the passes of a frame end: queries on hardware, finished waits on software. */
#include "app/render/gl/internal.h"
#include "app/timing/timing.h"

/* Marks an instant of the frame: a query on hardware, a finished wait on software. */
void gpu_mark(gpu_renderer *r, int index) {
    if (!r->context.software) {
        glQueryCounter(r->timestamps[index], GL_TIMESTAMP);
        return;
    }
    glFinish();
    r->marks[index] = 1e3 * timing_now();
}

double gpu_marked(const gpu_renderer *r, int index) {
    if (r->context.software)
        return r->marks[index];
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(r->timestamps[index], GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * (double)nanoseconds;
}
