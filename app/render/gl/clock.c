/* SPDX-License-Identifier: MIT */
#include "app/render/gl/clock.h"
#include "app/base/timing.h"

void gpu_clock_create(gpu_clock *clock, bool software) {
    clock->software = software;
    glCreateQueries(GL_TIMESTAMP, GPU_TIMESTAMPS, clock->timestamps);
}

void gpu_clock_delete(gpu_clock *clock) {
    glDeleteQueries(GPU_TIMESTAMPS, clock->timestamps);
}

void gpu_clock_mark(gpu_clock *clock, int index) {
    if (!clock->software) {
        glQueryCounter(clock->timestamps[index], GL_TIMESTAMP);
        return;
    }
    glFinish();
    clock->marks[index] = 1e3 * timing_now();
}

double gpu_clock_marked(const gpu_clock *clock, int index) {
    if (clock->software)
        return clock->marks[index];
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(clock->timestamps[index], GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * (double)nanoseconds;
}
