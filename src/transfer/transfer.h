/* SPDX-License-Identifier: MIT */
/* transfer.h - how a transfer lies in memory. */
#ifndef LAMPION_TRANSFER_TRANSFER_H
#define LAMPION_TRANSFER_TRANSFER_H

#include "src/base/host.h"
#include "src/base/precondition.h"

#include <lampion/transfer.h>

/* Red, green, blue and, except in sums of weights, 0. */
typedef float transfer_color __attribute__((vector_size(16)));

/* Surfels that a task computes. */
enum { TRANSFER_TASK = 256 };

struct lmp_transfer {
    lmp_host host; /* resolved; first, for lmpi_release_object */
    lmp_transfer_info info;
    /* An iteration multiplies the largest error by at most this: the albedo that the rays of one
     * surfel meet on average, the largest of all surfels and colors. */
    float contraction;
    size_t next; /* the surfel at which the next iteration begins */
    lmp_transfer_surfel *surfels;
    transfer_color *indirect; /* E of each surfel */
    /* B of each source, and last of what emits nothing: LMP_TRANSFER_NONE among hits becomes its
     * index. */
    transfer_color *radiosity;
    transfer_color *largest; /* of each task: the largest change of E, and the largest E */
    float *basis;            /* per direction of the probes' rays, Y_lm times 4 / their number */
    uint32_t *hits, *links, *probe_hits;
};

#endif
