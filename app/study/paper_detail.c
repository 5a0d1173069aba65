/* SPDX-License-Identifier: MIT */
#include "app/study/paper_detail.h"

#include "app/image/srgb.h"
#include "app/scene/vector.h"

#include <math.h>
#include <string.h>

static const float *pixel(const image *pixels, int x, int y) {
    return pixels->rgb + 3 * ((size_t)y * (size_t)pixels->width + (size_t)x);
}

static bool cut(const image *whole, const paper_detail *detail, image *part, base_error *error) {
    const int left = (int)(detail->x * whole->width), top = (int)(detail->y * whole->height);
    const int width = (int)(detail->width * whole->width);
    const int height = (int)(detail->height * whole->height);
    if (width < 1 || height < 1)
        return base_fail(error, NULL, "the image is too small for the detail %s", detail->name);
    if (!image_create(part, width, height, error))
        return false;
    for (int y = 0; y < height; y++)
        memcpy(part->rgb + 3 * (size_t)y * (size_t)width, pixel(whole, left, top + y),
               3 * (size_t)width * sizeof *part->rgb);
    return true;
}

static bool enlarge(const image *part, int factor, image *large, base_error *error) {
    if (!image_create(large, factor * part->width, factor * part->height, error))
        return false;
    for (int y = 0; y < large->height; y++)
        for (int x = 0; x < large->width; x++)
            memcpy(large->rgb + 3 * ((size_t)y * (size_t)large->width + (size_t)x),
                   pixel(part, x / factor, y / factor), 3 * sizeof *large->rgb);
    return true;
}

/* Returns the mean luminance of one of blocks² blocks, in which textures and noise average out. */
static double block_luminance(const image *part, int column, int row, int blocks) {
    const int left = column * part->width / blocks, right = (column + 1) * part->width / blocks;
    const int top = row * part->height / blocks, bottom = (row + 1) * part->height / blocks;
    double sum = 0;
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++)
            sum += image_luminance(pixel(part, x, y));
    const int count = (right - left) * (bottom - top);
    return count > 0 ? sum / count : 0;
}

static paper_looks measure(const image *part) {
    enum { BLOCKS = 10 };
    double spread = 0, most = 0, sum = 0, squares = 0;
    const size_t count = (size_t)part->width * (size_t)part->height;
    for (size_t i = 0; i < count; i++) {
        const float *rgb = part->rgb + 3 * i;
        const float high = rgb_brightest(rgb);
        spread += (double)(high - fminf(rgb[0], fminf(rgb[1], rgb[2])));
        most += (double)high;
    }
    for (int i = 0; i < BLOCKS * BLOCKS; i++) {
        const double l = block_luminance(part, i % BLOCKS, i / BLOCKS, BLOCKS);
        sum += l / (BLOCKS * BLOCKS);
        squares += l * l / (BLOCKS * BLOCKS);
    }
    return (paper_looks) { .color = most > 0 ? spread / most : 0,
                           .contrast = sum > 0 ? sqrt(fmax(squares - sum * sum, 0)) / sum : 0 };
}

bool paper_show_detail(paper *p, const char *from, const paper_detail *detail, int width,
                       const char *to, const char *caption, paper_looks *looks, base_error *error) {
    image whole = { .rgb = NULL }, part = { .rgb = NULL }, large = { .rgb = NULL };
    bool ok =
        image_read(from, IMAGE_READ_PIXELS, &whole, error) && cut(&whole, detail, &part, error);
    if (ok) {
        const int factor = (int)lround((double)width / part.width);
        *looks = measure(&part);
        ok = enlarge(&part, factor > 1 ? factor : 1, &large, error) &&
             image_write_figure(&large, to, error);
    }
    image_free(&whole);
    image_free(&part);
    image_free(&large);
    if (ok)
        page_image(&p->page, to, caption);
    return ok;
}
