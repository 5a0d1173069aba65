/* SPDX-License-Identifier: MIT */
/* build.h - one build of the kernels: the file that includes it sets LMP_LANES, LMP_KERNELS and
 * LMP_SINGLE, and
 * CMake its instruction set. */
#include "src/kernels/accumulate_more.h"
#include "src/kernels/eval_gradient.h"
#include "src/kernels/field.h"
#include "src/kernels/ggx.h"
#include "src/kernels/gradient.h"
#include "src/kernels/half.h"
#include "src/kernels/image.h"
#include "src/kernels/kinds.h"
#include "src/kernels/lobe.h"
#include "src/kernels/preintegrated_brdf.h"
#include "src/kernels/project.h"
#include "src/kernels/reconstruct.h"
#include "src/kernels/refine.h"
#include "src/kernels/rows.h"
#include "src/kernels/shade_zonal.h"
#include "src/kernels/single.h"
#include "src/kernels/vectors.h"

extern const lmp_kernels LMP_KERNELS;

const lmp_kernels LMP_KERNELS = {
#if LMP_LANES == 1
    .name = "scalar",
#elif LMP_LANES == 8
    .name = "avx2",
#elif LMP_LANES == 16
    .name = "avx512",
#elif defined(__SSE2__)
    .name = "sse2",
#elif defined(__wasm__)
    .name = "wasm",
#else
    .name = "neon",
#endif
    .lanes = LMP_LANES,
    .load_rows = kernel_load_rows,
    .store_colors = kernel_store_colors,
    .ggx = kernel_ggx,
    .pack_half = kernel_pack_half,
    .unpack_half = kernel_unpack_half,
    .eval = kernel_eval,
    .eval_streamed = kernel_eval_streamed,
    .eval_gradient = kernel_eval_gradient,
    .dot = kernel_dot,
    .rotate = kernel_rotate,
    .reconstruct = kernel_reconstruct,
    .image = kernel_image,
    .zonal = kernel_zonal,
    .project = kernel_project,
    .project_streamed = kernel_project_streamed,
    .accumulate = kernel_accumulate,
    .accumulate_more = kernel_accumulate_more,
    .add = kernel_add,
    .cone = kernel_cone,
    .gradient = kernel_gradient,
    .fading_gradient = kernel_fading_gradient,
    .interpolate = kernel_interpolate,
    .refine = kernel_refine,
    .refine_add = kernel_refine_add,
    .lobe = kernel_lobe,
    .shade_zonal = kernel_shade_zonal,
    .shade_field = kernel_shade_field,
    .shade_preintegrated_lobe = kernel_shade_preintegrated_lobe,
    .shade_preintegrated_brdf = kernel_shade_preintegrated_brdf,
    .single = &LMP_SINGLE,
};
