/* SPDX-License-Identifier: MIT */
#include "src/preintegrated/brdf.h"

#include "src/base/host.h"
#include "src/kernels/shade.h"

#include <string.h>

lmp_result lmpi_preintegrated_brdf_allocate(const lmp_host *host,
                                            const lmp_preintegrated_brdf_info *info,
                                            lmp_preintegrated_brdf **brdf) {
    const lmp_host resolved = lmpi_host_resolve(host);
    *brdf = NULL;
    if (info->texel_count > BRDF_TEXELS_MAX)
        return LMP_ERROR_MEMORY;
    const size_t slices = (size_t)info->view_count * info->cap_count;
    const size_t slice_bytes = slices * sizeof(lmp_preintegrated_brdf_slice);
    const size_t ambient_bytes = info->view_count * sizeof(lmp_rgb);
    const size_t texel_bytes = (info->texel_count + LMPI_KERNEL_TEXELS_SPARE) * 3 * sizeof(int16_t);
    lmp_preintegrated_brdf *made =
        lmpi_allocate(&resolved, sizeof *made + slice_bytes + ambient_bytes + texel_bytes);
    *brdf = made;
    if (!made)
        return LMP_ERROR_MEMORY;
    made->info = *info;
    made->host = resolved;
    made->slices = (lmp_preintegrated_brdf_slice *)(made + 1);
    made->ambient = (lmp_rgb *)(made->slices + slices);
    made->texels = (int16_t *)(made->ambient + info->view_count);
    made->info.view_remap = made->view_remap;
    made->info.cap_remap = made->cap_remap;
    made->info.slices = made->slices;
    made->info.ambient = made->ambient;
    made->info.texels = made->texels;
    memset(made->texels + 3 * info->texel_count, 0, LMPI_KERNEL_TEXELS_SPARE * 3 * sizeof(int16_t));
    made->info.bytes = sizeof *made + slice_bytes + ambient_bytes + texel_bytes;
    return LMP_OK;
}

void lmp_preintegrated_brdf_destroy(lmp_preintegrated_brdf *brdf) {
    lmpi_release_object(brdf);
}

lmp_preintegrated_brdf_info lmp_preintegrated_brdf_describe(const lmp_preintegrated_brdf *brdf) {
    return brdf->info;
}
