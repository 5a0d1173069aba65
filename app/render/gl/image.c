/* SPDX-License-Identifier: MIT */
/* Output of the HDR target: to a window, to 8 bits, and linear. */
#include "app/render/gl/state.h"

void gpu_present(gpu_renderer *r, unsigned framebuffer, const image_display *display,
                 bool rows_from_top) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, r->targets.width, r->targets.height);
    glBindVertexArray(r->empty_array);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindTextureUnit(SHARED_HDR, r->targets.hdr);
    glUseProgram(r->tones[display->tone]);
    glUniform1f(0, display->exposure);
    glUniform1i(1, rows_from_top ? 0 : 1);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* Checks that the device had memory for everything that was drawn. */
static bool check_memory(const gpu_renderer *r, base_error *error) {
    return glGetError() != GL_OUT_OF_MEMORY ||
           base_fail(error, NULL, "%s has no memory for an image of %d x %d", r->context.device,
                     r->targets.width, r->targets.height);
}

bool gpu_read_rgb8(gpu_renderer *r, const image_display *display, unsigned char *rgb8,
                   render_times *times, base_error *error) {
    if (times)
        gpu_clock_mark(&r->clock, 3);
    gpu_present(r, r->targets.ldr_framebuffer, display, true);
    if (times) {
        gpu_clock_mark(&r->clock, 4);
        times->tone = gpu_clock_marked(&r->clock, 4) - gpu_clock_marked(&r->clock, 3);
        times->total = times->surfaces + times->shade + times->shadow + times->bounces +
                       times->transfer + times->tone;
    }
    const size_t size = 3 * (size_t)r->targets.width * (size_t)r->targets.height;
    if (size > INT32_MAX)
        return base_fail(error, NULL, "an image of %d x %d is too large to read back",
                         r->targets.width, r->targets.height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(r->targets.ldr, 0, GL_RGB, GL_UNSIGNED_BYTE, (GLsizei)size, rgb8);
    return check_memory(r, error);
}

bool gpu_read_image(gpu_renderer *r, image *pixels, base_error *error) {
    if (!image_create(pixels, r->targets.width, r->targets.height, error))
        return false;
    const size_t size = 3 * sizeof(float) * (size_t)r->targets.width * (size_t)r->targets.height;
    if (size > INT32_MAX) {
        image_free(pixels);
        return base_fail(error, NULL, "an image of %d x %d is too large to read back",
                         r->targets.width, r->targets.height);
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(r->targets.hdr, 0, GL_RGB, GL_FLOAT, (GLsizei)size, pixels->rgb);
    if (check_memory(r, error))
        return true;
    image_free(pixels);
    return false;
}
