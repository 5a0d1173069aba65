/* SPDX-License-Identifier: MIT */
/* avx2_tmpl.h - hands AVX2's build what AVX-512 would not do faster, with the same bits. */
#ifndef LAMPION_KERNELS_AVX2_TMPL_H
#define LAMPION_KERNELS_AVX2_TMPL_H

#include "src/kernels/accumulate_tmpl.h"
#include "src/kernels/kernels.h"

/* Sums lights at points; points that leave half of the lanes unused cost less by AVX2, with the
 * same bits. */
static void accumulate_points(const lmp_scratch *scratch, int bands,
                              const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                              const lmpi_kernel_out *out, size_t element, size_t live) {
    if (live > LMPI_LANES / 2) {
        accumulate_block(scratch, bands, lights, points, out, element, live);
        return;
    }
    if (element == 0) {
        lmpi_kernels_avx2.light.accumulate(scratch, bands, lights, points, live, out);
        return;
    }
    const lmpi_kernel_vec3 some = { points->x + element, points->y + element, points->z + element };
    lmpi_kernel_lights seen = *lights;
    lmpi_kernel_out to = *out;
    if (seen.visibility)
        seen.visibility += element;
    to.at += out->planar ? element : element * out->stride;
    lmpi_kernels_avx2.light.accumulate(scratch, bands, &seen, &some, live, &to);
}

/* Streams by AVX2's kernels, which take less time than AVX-512's would, because streaming waits for
 * memory. */
static void kernel_eval_streamed(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                 const lmpi_kernel_out *out) {
    lmpi_kernels_avx2.sh.eval_streamed(bands, directions, count, out);
}

static void kernel_project_streamed(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                                    const lmpi_kernel_out *out) {
    lmpi_kernels_avx2.light.project_streamed(bands, pairs, count, out);
}

#endif
