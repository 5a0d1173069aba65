/* SPDX-License-Identifier: MIT */
/* Kernels that store past the caches give the bits of those that do not, wherever the output lies,
 * and touch nothing beside it; batch functions take them for large outputs. */
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "tests/oracle/check.h"

#include <lampion/cpu.h>
#include <lampion/lampion.h>

#include <stdlib.h>
#include <string.h>

enum { COUNT = 208, BANDS = 10, VALUES = BANDS * BANDS, PADDED = VALUES + 13 };
enum { ROOM = COUNT * PADDED + 64 };

static float center[3][COUNT], point[3][COUNT], axis[3][COUNT], radius[COUNT];
static float plain[ROOM], streamed[ROOM];

static int fill(void **test) {
    (void)test;
    for (int i = 0; i < COUNT; i++) {
        const lmp_vec3 way = check_random_direction();
        axis[0][i] = way.x;
        axis[1][i] = way.y;
        axis[2][i] = way.z;
        for (int k = 0; k < 3; k++) {
            center[k][i] = (float)check_random_between(2, 3);
            point[k][i] = (float)check_random();
        }
        radius[i] = (float)check_random_between(0.01, 0.3);
    }
    return 0;
}

/* Where the output of a kernel lies: its first float, and how many floats lie between rows or
 * planes. */
typedef struct place {
    size_t count, offset, gap;
    int planar, bands;
} place;

static void run(const lmpi_kernels *k, place p, int streams, float *memory) {
    const size_t values = LMP_SH_COUNT(p.bands);
    const lmpi_kernel_out out = { memory + p.offset, (p.planar ? p.count : values) + p.gap,
                                  p.planar };
    const lmpi_kernel_vec3 axes = { axis[0], axis[1], axis[2] };
    const lmpi_kernel_pairs pairs = { { center[0], center[1], center[2] },
                                      { point[0], point[1], point[2] },
                                      radius };
    if (streams & 2)
        (streams & 1 ? k->light.project_streamed : k->light.project)(p.bands, &pairs, p.count,
                                                                     &out);
    else
        (streams & 1 ? k->sh.eval_streamed : k->sh.eval)(p.bands, &axes, p.count, &out);
    lmpi_batch_fence();
}

static void check_place(const lmpi_kernels *k, place p) {
    for (int kernel = 0; kernel < 4; kernel += 2) {
        memset(plain, 0x5a, sizeof plain);
        memset(streamed, 0x5a, sizeof streamed);
        run(k, p, kernel, plain);
        run(k, p, kernel + 1, streamed);
        assert_memory_equal(plain, streamed, sizeof plain);
    }
}

static void streamed_bits_are_those_of_ordinary_stores(void **test) {
    static const size_t counts[] = { 1, 3, 8, 16, 17, 31, 32, 33, 63, 64, 67, 192, 195 };
    static const size_t gaps[] = { 0, 1, 4, 12, 13 };
    enum { COUNTS = sizeof counts / sizeof *counts, GAPS = sizeof gaps / sizeof *gaps };
    (void)test;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2) {
        lmpi_kernels k;
        if (lmpi_kernels_init(&k, flag) != flag)
            continue;
        for (int bands = 1; bands <= BANDS; bands++)
            for (int c = 0; c < COUNTS; c++)
                for (int g = 0; g < GAPS; g++)
                    for (int planar = 0; planar < 2; planar++) {
                        const size_t offset = (size_t)(c * GAPS + g) % 17;
                        if (planar && counts[c] + gaps[g] > COUNT)
                            continue;
                        check_place(&k, (place) { counts[c], offset, gaps[g], planar, bands });
                    }
    }
}

/* The outputs exceed the threshold of streaming, with a few directions and spheres repeated; they
 * begin in the middle of a cache line. */
enum { LARGE = 42016, LARGE_PLANE = LARGE + 32 };
static float large[VALUES * LARGE_PLANE + 16], few[VALUES * COUNT];

static void check_large(lmp_sh_layout layout, size_t stride, const float *from) {
    const size_t step = layout == LMP_SH_PLANAR ? 1 : stride;
    const size_t plane = layout == LMP_SH_PLANAR ? stride : 1;
    for (size_t i = 0; i < LARGE; i++)
        for (size_t v = 0; v < VALUES; v++)
            if (memcmp(from + i * step + v * plane, few + v, sizeof *few) != 0)
                fail_msg("value %zu of element %zu differs", v, i);
    if (layout == LMP_SH_PLANAR)
        for (size_t v = 0; v < VALUES; v++)
            for (size_t i = LARGE; i < LARGE_PLANE; i++)
                assert_true(from[v * plane + i] == -77);
}

static void batch_functions_stream_large_outputs(void **test) {
    (void)test;
    const lmp_vec3_array one = { axis[0], axis[1], axis[2], 0 };
    const lmp_vec3_array at = { point[0], point[1], point[2], 0 };
    const lmp_spheres sphere = { .center = { center[0], center[1], center[2], 0 },
                                 .radius = { radius, 0 } };
    const size_t plane = LARGE_PLANE * sizeof(float);
    float *const to = large + 3;
    assert_true((size_t)VALUES * sizeof(float) * LARGE > LMPI_BATCH_STREAMED);
    for (int planar = 0; planar < 2; planar++) {
        const lmp_sh_layout layout = planar ? LMP_SH_PLANAR : LMP_SH_INTERLEAVED;
        const size_t stride = planar ? plane : 0, floats = planar ? LARGE_PLANE : VALUES;
        for (size_t i = 0; i < sizeof large / sizeof *large; i++)
            large[i] = -77;
        lmp_sh_eval_n(BANDS, one, 1, lmp_sh_interleaved(few, 0));
        lmp_sh_eval_n(BANDS, one, LARGE, (lmp_sh_array) { to, stride, layout });
        check_large(layout, floats, to);
        lmp_sphere_project_n(BANDS, &sphere, at, 1, lmp_sh_interleaved(few, 0));
        lmp_sphere_project_n(BANDS, &sphere, at, LARGE, (lmp_sh_array) { to, stride, layout });
        check_large(layout, floats, to);
        lmp_sh_eval_n(BANDS, one, LARGE, (lmp_sh_array) { to, stride, layout });
        lmp_sphere_project_all_n(BANDS, &sphere, 16, at, LARGE / 16,
                                 (lmp_sh_array) { to, stride, layout });
        check_large(layout, floats, to);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(streamed_bits_are_those_of_ordinary_stores),
        cmocka_unit_test(batch_functions_stream_large_outputs),
    };
    return cmocka_run_group_tests(tests, fill, NULL);
}
