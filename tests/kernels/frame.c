/* SPDX-License-Identifier: MIT */
/* Whole images of the CPU's device: the same bits by every instruction set's kernels, by Embree's
 * instruction sets, by each of libm's, for any number of threads, and, by golden checksums, by
 * every compiler. */
#include "app/render/renderer/renderer.h"
#include "app/render/shadow/shadow.h"

#include "tests/oracle/check.h"

#include <lampion/cpu.h>

#include <dlfcn.h>
#include <inttypes.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define GOLDEN_BALLS  0x4ade70437cf5ede1
#define GOLDEN_ATRIUM 0xae479071dedf9a0a

enum { WIDTH = 80, HEIGHT = 45, BANDS = 6 };

/* Adds bytes to an FNV-1a hash. */
static uint64_t add_bytes(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

/* Returns a hash of the radiances, and of the bytes shown of them. */
static uint64_t draw(const scene *world, bool shadows) {
    base_error error = { "" };
    render_device device;
    image pixels;
    static unsigned char rgb8[3 * WIDTH * HEIGHT];
    const shadow_settings settings = { .rays = 2 };
    if (!render_device_open(DEVICE_CPU, NULL, world, &device, &error))
        fail_msg("%s", error.text);
    any_renderer *renderer = renderer_create(&device, &error);
    shadow *cast = shadow_create(world, render_device_bvh(&device), NULL, &settings, &error);
    assert_true(renderer && cast);
    const render_frame frame = { .width = WIDTH,
                                 .height = HEIGHT,
                                 .camera = scene_default_camera(world, (float)WIDTH / HEIGHT),
                                 .bands = BANDS,
                                 .window = LMP_WINDOW_HANNING,
                                 .lights = world->lights,
                                 .light_count = world->light_count,
                                 .samples = 3,
                                 .shadow =
                                     shadows ? shadow_pass(cast) : (render_pass) { .user = NULL } };
    if (!renderer_draw(renderer, &frame, NULL, &error) ||
        !renderer_read_image(renderer, &pixels, &error))
        fail_msg("%s", error.text);
    const image_display display = { .exposure = image_auto_exposure(&pixels) };
    assert_true(renderer_read_rgb8(renderer, &display, rgb8, NULL, &error));
    uint64_t hash =
        add_bytes(0xcbf29ce484222325u, pixels.rgb, 3 * (size_t)WIDTH * HEIGHT * sizeof *pixels.rgb);
    hash = add_bytes(hash, rgb8, sizeof rgb8);
    image_free(&pixels);
    shadow_destroy(cast);
    renderer_destroy(renderer);
    render_device_close(&device);
    return hash;
}

static void check_scene(const char *name, bool shadows, uint64_t golden) {
    static const char *const configurations[] = { "isa=sse2", "isa=sse4.2", "isa=avx2" };
    scene world;
    base_error error = { "" };
    if (!scene_load(name, &(scene_options) { .no_cache = true }, &world, &error))
        fail_msg("%s", error.text);
    const uint64_t first = draw(&world, shadows);
    if (first != golden)
        fail_msg("%s: 0x%016" PRIx64 ", not 0x%016" PRIx64, name, first, golden);
    for (unsigned flag = LMP_CPU_SCALAR; flag <= LMP_CPU_AVX512; flag <<= 1) {
        if (!(lmp_cpu_flags() & flag))
            continue;
        lmp_cpu_limit(flag);
        assert_true(draw(&world, shadows) == golden);
    }
    lmp_cpu_limit(LMP_CPU_ALL);
    static const int counts[] = { 1, 2, 7 };
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        omp_set_num_threads(counts[i]);
        assert_true(draw(&world, shadows) == golden);
    }
    omp_set_num_threads(omp_get_num_procs());
    for (size_t i = 0; i < sizeof configurations / sizeof *configurations; i++) {
        setenv("LAMPION_EMBREE", configurations[i], 1);
        assert_true(draw(&world, shadows) == golden);
    }
    unsetenv("LAMPION_EMBREE");
    scene_free(&world);
}

static void balls_have_the_same_bits_everywhere(void **state) {
    (void)state;
    check_scene("builtin:balls", false, GOLDEN_BALLS);
}

static void the_atrium_has_the_same_bits_everywhere(void **state) {
    (void)state;
    check_scene("builtin:atrium", true, GOLDEN_ATRIUM);
}

/* --- the C library ---------------------------------------------------------------------------- */

/* Returns where libm's sine lies in it: another function on CPUs with other features. */
static ptrdiff_t place_of_sine(void) {
    void *library = dlopen("libm.so.6", RTLD_LAZY), *sine = library ? dlsym(library, "sin") : NULL;
    Dl_info info;
    assert_true(sine && dladdr(sine, &info));
    dlclose(library);
    return (char *)sine - (char *)info.dli_fbase;
}

static uint64_t draw_atrium(void) {
    scene world;
    base_error error = { "" };
    if (!scene_load("builtin:atrium", &(scene_options) { .no_cache = true }, &world, &error))
        fail_msg("%s", error.text);
    const uint64_t hash = draw(&world, true);
    scene_free(&world);
    return hash;
}

/* The process runs with a glibc that takes the CPU for an older one. */
static void the_atrium_has_the_same_bits_by_an_older_libm(void **state) {
    (void)state;
    char self[4096], command[4400];
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    assert_true(length > 0);
    self[length] = 0;
    snprintf(command, sizeof command,
             "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-FMA4,-SSE4_1 '%s' older", self);
    FILE *older = popen(command, "r");
    assert_non_null(older);
    uint64_t hash = 0;
    ptrdiff_t place = 0;
    assert_int_equal(fscanf(older, "%" SCNx64 " %td", &hash, &place), 2);
    assert_int_equal(pclose(older), 0);
    assert_true(hash == GOLDEN_ATRIUM);
    if (lmp_cpu_flags() & LMP_CPU_AVX2) /* otherwise this process runs the older functions, too */
        assert_int_not_equal(place, place_of_sine());
}

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "older") == 0) {
        printf("%" PRIx64 " %td\n", draw_atrium(), place_of_sine());
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_have_the_same_bits_everywhere),
        cmocka_unit_test(the_atrium_has_the_same_bits_everywhere),
        cmocka_unit_test(the_atrium_has_the_same_bits_by_an_older_libm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
