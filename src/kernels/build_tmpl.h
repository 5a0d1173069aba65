/* SPDX-License-Identifier: MIT */
/* build_tmpl.h - one build of the kernels: the file that includes it sets LMPI_LANES, LMPI_KERNELS
 * and LMPI_SINGLE, and CMake its instruction set. */
#include "src/kernels/kernels.h"
#include "src/kernels/lanes.h"

/* Kernels for few points, and for results that no cache holds. */
#if LMPI_LANES == 16
#include "src/kernels/avx2_tmpl.h"
#elif LMPI_LANES > 1
#include "src/kernels/accumulate_few_tmpl.h"
#else
#define accumulate_points accumulate_block
#endif
#if LMPI_STREAMS
#include "src/kernels/stream_tmpl.h"
#elif LMPI_LANES < 16
#define kernel_eval_streamed    kernel_eval
#define kernel_project_streamed kernel_project
#endif

#include "src/kernels/accumulate_more_tmpl.h"
#include "src/kernels/eval_gradient_tmpl.h"
#include "src/kernels/field_tmpl.h"
#include "src/kernels/ggx_tmpl.h"
#include "src/kernels/gradient_tmpl.h"
#include "src/kernels/half_tmpl.h"
#include "src/kernels/image_tmpl.h"
#include "src/kernels/kinds_tmpl.h"
#include "src/kernels/lobe_tmpl.h"
#include "src/kernels/preintegrated_brdf_tmpl.h"
#include "src/kernels/project_tmpl.h"
#include "src/kernels/reconstruct_tmpl.h"
#include "src/kernels/refine_tmpl.h"
#include "src/kernels/rows_tmpl.h"
#include "src/kernels/shade_flat_tmpl.h"
#include "src/kernels/shade_zonal_tmpl.h"
#include "src/kernels/vectors_tmpl.h"

extern const lmpi_kernels LMPI_KERNELS;
extern const struct lmpi_single LMPI_SINGLE;

const lmpi_kernels LMPI_KERNELS = {
#if LMPI_LANES == 1
    .name = "scalar",
#elif LMPI_LANES == 8
    .name = "avx2",
#elif LMPI_LANES == 16
    .name = "avx512",
#elif defined(__SSE2__)
    .name = "sse2",
#elif defined(__wasm__)
    .name = "wasm",
#else
    .name = "neon",
#endif
    .lanes = LMPI_LANES,
    .convert.load_rows = kernel_load_rows,
    .convert.store_colors = kernel_store_colors,
    .lobe.ggx = kernel_ggx,
    .convert.pack_half = kernel_pack_half,
    .convert.unpack_half = kernel_unpack_half,
    .sh.eval = kernel_eval,
    .sh.eval_streamed = kernel_eval_streamed,
    .sh.eval_gradient = kernel_eval_gradient,
    .sh.dot = kernel_dot,
    .sh.rotate = kernel_rotate,
    .sh.reconstruct = kernel_reconstruct,
    .sh.image = kernel_image,
    .light.zonal = kernel_zonal,
    .light.project = kernel_project,
    .light.project_streamed = kernel_project_streamed,
    .light.accumulate = kernel_accumulate,
    .light.accumulate_more = kernel_accumulate_more,
    .light.add = kernel_add,
    .light.cone = kernel_cone,
    .light.gradient = kernel_gradient,
    .light.fading_gradient = kernel_fading_gradient,
    .field.interpolate = kernel_interpolate,
    .field.refine = kernel_refine,
    .field.refine_add = kernel_refine_add,
    .lobe.response = kernel_lobe,
    .shade.zonal = kernel_shade_zonal,
    .shade.polygons = kernel_shade_polygons,
    .shade.disk = kernel_shade_disk,
    .shade.tube = kernel_shade_tube,
    .shade.field = kernel_shade_field,
    .shade.preintegrated_lobe = kernel_shade_preintegrated_lobe,
    .shade.preintegrated_brdf = kernel_shade_preintegrated_brdf,
    .single = &LMPI_SINGLE,
};
