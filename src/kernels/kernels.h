/* SPDX-License-Identifier: MIT */
/* kernels.h - the batch kernels: one source, compiled once for each instruction set, and a table of
 * function pointers for each build, by topic (arrays.h says what the kernels read and write).
 *
 * Every build does the same operations in the same order, contracts none of them to an FMA and
 * takes its quotients and roots from the IEEE instructions, so all give the same bits. */
#ifndef LAMPION_KERNELS_KERNELS_H
#define LAMPION_KERNELS_KERNELS_H

#include "src/kernels/convert.h"
#include "src/kernels/field.h"
#include "src/kernels/light.h"
#include "src/kernels/lobe.h"
#include "src/kernels/sh.h"
#include "src/kernels/shade.h"

typedef struct lmpi_kernels {
    const char *name;
    int lanes;
    lmpi_convert_kernels convert;
    lmpi_sh_kernels sh;
    lmpi_light_kernels light;
    lmpi_field_kernels field;
    lmpi_lobe_kernels lobe;
    lmpi_shade_kernels shade;
    const struct lmpi_single *single; /* the kernels of single.h */
} lmpi_kernels;

/* The build for AVX2, which takes over what AVX-512 would not do faster. */
extern const lmpi_kernels lmpi_kernels_avx2;

#endif
