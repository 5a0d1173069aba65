/* SPDX-License-Identifier: MIT */
/* crash.h - a message for crashes of a driver. */
#ifndef LAMPION_RENDER_GL_CRASH_H
#define LAMPION_RENDER_GL_CRASH_H

/* Where the address space is limited, turns a crash of the driver into an error message and an
 * exit: drivers use memory without checking whether they got it. */
void gpu_expect_crashes(void);

#endif
