/* SPDX-License-Identifier: MIT */
/* The HDR target to a window, to 8 bits, and as it is. */
#include "app/render/gl/internal.h"

void gpu_present(gpu_renderer *r, unsigned framebuffer, const image_display *display,
                 bool rows_from_top) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, r->width, r->height);
    glBindVertexArray(r->empty_array);
    glBindBufferBase(GL_UNIFORM_BUFFER, SHARED_FRAME, r->frame_block);
    glBindTextureUnit(SHARED_HDR, r->hdr);
    glUseProgram(r->tones[display->tone]);
    glUniform1f(0, display->exposure);
    glUniform1i(1, rows_from_top ? 0 : 1);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* Whether all that was drawn for the image had room. */
static bool check_memory(const gpu_renderer *r, cli_error *error) {
    return glGetError() != GL_OUT_OF_MEMORY ||
           cli_fail(error, NULL, "%s has no memory for an image of %d x %d", r->context.device,
                    r->width, r->height);
}

bool gpu_read_rgb8(gpu_renderer *r, const image_display *display, unsigned char *rgb8,
                   render_times *times, cli_error *error) {
    if (times)
        gpu_mark(r, 3);
    gpu_present(r, r->ldr_framebuffer, display, true);
    if (times) {
        gpu_mark(r, 4);
        times->tone = gpu_marked(r, 4) - gpu_marked(r, 3);
        times->total =
            times->surfaces + times->shade + times->shadow + times->transfer + times->tone;
    }
    const size_t size = 3 * (size_t)r->width * (size_t)r->height;
    if (size > INT32_MAX)
        return cli_fail(error, NULL, "an image of %d x %d is too large to read back", r->width,
                        r->height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(r->ldr, 0, GL_RGB, GL_UNSIGNED_BYTE, (GLsizei)size, rgb8);
    return check_memory(r, error);
}

bool gpu_read_image(gpu_renderer *r, image *pixels, cli_error *error) {
    if (!image_create(pixels, r->width, r->height, error))
        return false;
    const size_t size = 3 * sizeof(float) * (size_t)r->width * (size_t)r->height;
    if (size > INT32_MAX) {
        image_free(pixels);
        return cli_fail(error, NULL, "an image of %d x %d is too large to read back", r->width,
                        r->height);
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(r->hdr, 0, GL_RGB, GL_FLOAT, (GLsizei)size, pixels->rgb);
    if (check_memory(r, error))
        return true;
    image_free(pixels);
    return false;
}
