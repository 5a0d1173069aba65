/* SPDX-License-Identifier: MIT */
/* A window shows one image or two, upright. */
#include "app/render/gl/program.h"
#include "app/render/gl/targets.h"
#include "tests/gpu/device.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT, SIZE = 16 };

typedef struct fixture {
    scene world;
    gpu_renderer *renderer;
    gpu_screen *screen;
    unsigned char sides[2][3 * PIXELS]; /* the image, and a darker copy */
} fixture;

static void open_fixture(fixture *f) {
    base_error error = { "" };
    expect(scene_load("builtin:atrium", &(scene_options) { .no_cache = true }, &f->world, &error),
           &error);
    f->renderer = open_renderer(&f->world);
    f->screen = gpu_screen_create(&error);
    expect(f->screen != NULL, &error);
    const render_frame frame = frame_of(&f->world, WIDTH, HEIGHT);
    expect(gpu_render(f->renderer, &frame, NULL, &error), &error);
    for (int side = 0; side < 2; side++) {
        const image_display display = { .exposure = side ? 0.5f : 1 };
        expect(gpu_read_rgb8(f->renderer, &display, f->sides[side], NULL, &error), &error);
        gpu_screen_take(f->screen, f->renderer, side, &display);
    }
    assert_memory_not_equal(f->sides[0], f->sides[1], sizeof f->sides[0]);
    assert_memory_not_equal(f->sides[0], f->sides[0] + 3 * (PIXELS - WIDTH), 3 * WIDTH);
}

static void close_fixture(fixture *f) {
    gpu_screen_destroy(f->screen);
    gpu_renderer_destroy(f->renderer);
    scene_free(&f->world);
}

/* Returns what the layout shows of a channel at column x. */
static int shown(const fixture *f, const gpu_layout *layout, int x, int i) {
    const int a = f->sides[0][i], b = f->sides[1][i];
    if (layout->split == GPU_SPLIT_NONE)
        return a;
    if (layout->split == GPU_SPLIT_DIFFERENCE)
        return abs(a - b) * GPU_DIFFERENCE_GAIN < 255 ? abs(a - b) * GPU_DIFFERENCE_GAIN : 255;
    if (abs(2 * x + 1 - WIDTH) < (int)layout->line)
        return 242;
    return 2 * x + 1 < WIDTH ? a : b;
}

static void screens_are_read_from_the_top_whole_divided_and_as_differences(void **state) {
    (void)state;
    static fixture f;
    static unsigned char seen[3 * PIXELS];
    base_error error = { "" };
    open_fixture(&f);
    for (int split = 0; split < GPU_SPLITS; split++) {
        const gpu_layout layout = { WIDTH, HEIGHT, (gpu_split)split, 0.5f, 4, 0 };
        expect(gpu_screen_read(f.screen, &layout, seen, &error), &error);
        for (int i = 0; i < 3 * PIXELS; i++)
            assert_true(abs(seen[i] - shown(&f, &layout, i / 3 % WIDTH, i)) <= 1);
    }
    close_fixture(&f);
}

/* Draws by a fragment shader into SIZE x SIZE pixels that stand for a window, and reads them from
 * its lower edge. */
static void draw_window(const char *shader, GLuint texture, void (*set)(void),
                        unsigned char *rgba) {
    const gpu_stage stages[] = { { GL_VERTEX_SHADER, "screen.vert" },
                                 { GL_FRAGMENT_SHADER, shader } };
    base_error error = { "" };
    const GLuint program = gpu_program(stages, 2, "", &error),
                 target = gpu_target_create(GL_RGBA8, SIZE, SIZE);
    GLuint framebuffer, vertices;
    expect(program != 0, &error);
    glCreateVertexArrays(1, &vertices);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, SIZE, SIZE);
    glBindVertexArray(vertices);
    glBindTextureUnit(0, texture);
    glBindTextureUnit(1, texture);
    glUseProgram(program);
    set();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glGetTextureImage(target, 0, GL_RGBA, GL_UNSIGNED_BYTE, 4 * SIZE * SIZE, rgba);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteVertexArrays(1, &vertices);
    glDeleteTextures(1, &target);
    glDeleteProgram(program);
}

/* Makes an image whose rows run from the top; red counts columns, green rows. */
static GLuint numbered(int width, int height) {
    unsigned char texels[4 * SIZE * SIZE];
    const GLuint texture = gpu_target_create(GL_RGBA8, width, height);
    for (int i = 0; i < width * height; i++)
        memcpy(texels + 4 * i,
               (unsigned char[]) { (unsigned char)(i % width + 1), (unsigned char)(i / width + 1),
                                   0, 255 },
               4);
    glTextureSubImage2D(texture, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    return texture;
}

static void set_flip(void) {
    glUniform2f(0, SIZE, SIZE);
    glUniform1i(1, 1);
}

static void windows_show_the_first_row_at_their_top(void **state) {
    (void)state;
    unsigned char seen[4 * SIZE * SIZE];
    const GLuint texture = numbered(SIZE, SIZE);
    draw_window("compose.frag", texture, set_flip, seen);
    for (int row = 0; row < SIZE; row++)
        assert_int_equal(seen[4 * (SIZE - 1 - row) * SIZE + 1], row + 1);
    glDeleteTextures(1, &texture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(screens_are_read_from_the_top_whole_divided_and_as_differences),
        cmocka_unit_test(windows_show_the_first_row_at_their_top),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
