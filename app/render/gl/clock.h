/* SPDX-License-Identifier: MIT */
/* clock.h - measures when the passes of a frame end. */
#ifndef LAMPION_RENDER_GL_CLOCK_H
#define LAMPION_RENDER_GL_CLOCK_H

#include <epoxy/gl.h>
#include <stdbool.h>

enum { GPU_TIMESTAMPS = 5 };

/* Timer queries on hardware, waits for completion on software. */
typedef struct gpu_clock {
    bool software;
    GLuint timestamps[GPU_TIMESTAMPS]; /* hardware */
    double marks[GPU_TIMESTAMPS];      /* software, milliseconds */
} gpu_clock;

void gpu_clock_create(gpu_clock *clock, bool software);
void gpu_clock_delete(gpu_clock *clock);

/* Mark an instant of the frame, and return its milliseconds once the frame is done. */
void gpu_clock_mark(gpu_clock *clock, int index);
double gpu_clock_marked(const gpu_clock *clock, int index);

#endif
