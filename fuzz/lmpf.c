/* SPDX-License-Identifier: MIT */
/* Fields, .lmpf. */
#include "fuzz/checksum.h"

#include <lampion/field.h>

#include <math.h>

static void use(lmp_field *field) {
    static const lmp_light light = { .position = { 1, 1, 1 }, .radius = 0.5f };
    const lmp_field_info info = lmp_field_describe(field);
    const lmp_vec3 origin = info.desc.origin, cell = info.desc.cell;
    float sh[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
    for (int i = -1; i < 4; i++) {
        const float s = (float)i * 0.75f;
        const lmp_vec3 point = { origin.x + s * cell.x, origin.y + s * cell.y,
                                 origin.z + s * cell.z };
        if (fabsf(point.x) + fabsf(point.y) + fabsf(point.z) < 1e15f)
            lmp_field_eval_n(field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(sh, 0));
        (void)lmp_field_find_near(field, point, 0, NULL, NULL);
    }
    if (info.light_count > 0)
        lmp_field_move_n(NULL, field, &(size_t) { info.light_count - 1 }, &light, 1);
    (void)lmp_field_add(NULL, field, &light);
    lmp_field_remove(NULL, field, 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    lmp_field *field;
    lmp_result result = lmp_field_read(NULL, data, size, NULL, &field);
    if (result == LMP_ERROR_CHECKSUM) {
        unsigned char *valid = fuzz_checksum(data, size);
        if (!valid)
            return 0;
        result = lmp_field_read(NULL, valid, size, NULL, &field);
        free(valid);
    }
    if (result == LMP_OK)
        use(field);
    lmp_field_destroy(field);
    return 0;
}
