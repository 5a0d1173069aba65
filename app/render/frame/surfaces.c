/* SPDX-License-Identifier: MIT */
#include "app/render/frame/surfaces.h"

#include "app/memory/memory.h"

#include <stdlib.h>
#include <string.h>

/* --- planes ----------------------------------------------------------------------------------- */

enum { PLAIN = 16, LAYERED = 12, TILED = 16 };

/* Planes of a tile have 4096 bytes: end to end, the same pixel of all of them would share one set
 * of a cache, which holds fewer. So a cache line lies between. */
enum { APART = 16 };

static size_t bytes_of(size_t planes, size_t count) {
    return planes * (count + APART) * sizeof(float);
}

/* Gives the next plane of `count` values. */
static float *next(float **memory, size_t count) {
    float *plane = *memory;
    *memory += count + APART;
    return plane;
}

bool render_surfaces_create(int width, int height, bool layered, render_surfaces *s) {
    const size_t count = (size_t)width * (size_t)height;
    const size_t planes = 1 + PLAIN + (layered ? LAYERED : 0);
    memset(s, 0, sizeof *s);
    float *memory = memory_large(bytes_of(planes, count));
    if (!memory)
        return false;
    s->width = width;
    s->height = height;
    s->layered = layered;
    s->memory = memory;
    s->seen = (uint32_t *)(void *)next(&memory, count);
    float **const vectors[] = { s->position, s->normal, s->base, s->emission };
    float **const numbers[] = { &s->metallic, &s->roughness, &s->specular, &s->ambient };
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
        for (int c = 0; c < 3; c++)
            vectors[i][c] = next(&memory, count);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        *numbers[i] = next(&memory, count);
    float **const more_vectors[] = { s->coat_normal, s->tint, s->sheen };
    float **const more_numbers[] = { &s->coat, &s->coat_roughness, &s->sheen_roughness };
    for (size_t i = 0; layered && i < sizeof more_vectors / sizeof *more_vectors; i++)
        for (int c = 0; c < 3; c++)
            more_vectors[i][c] = next(&memory, count);
    for (size_t i = 0; layered && i < sizeof more_numbers / sizeof *more_numbers; i++)
        *more_numbers[i] = next(&memory, count);
    return true;
}

bool render_surfaces_keep_hits(render_surfaces *s) {
    if (!s->hits)
        s->hits = memory_large((size_t)s->width * (size_t)s->height * sizeof *s->hits);
    return s->hits;
}

bool render_surfaces_keep_smooth(render_surfaces *s) {
    if (!s->smooth)
        s->smooth = memory_large((size_t)s->width * (size_t)s->height * sizeof *s->smooth);
    return s->smooth;
}

render_nearness render_nearness_of(const render_camera *c) {
    static const float steps = 4; /* widths of a pixel */
    const float down2 = c->down[0] * c->down[0] + c->down[1] * c->down[1] + c->down[2] * c->down[2];
    const float reach2 = steps * steps * down2 * c->step[1] * c->step[1];
    return (render_nearness) { c->parallel ? reach2 : 0, c->parallel ? 0 : reach2 };
}

void render_surfaces_free(render_surfaces *s) {
    free(s->smooth);
    free(s->hits);
    free(s->memory);
    memset(s, 0, sizeof *s);
}

/* --- tiles ------------------------------------------------------------------------------------ */

static int tiles_along(int pixels) {
    return (pixels + RENDER_TILE - 1) / RENDER_TILE;
}

int render_tile_count(int width, int height) {
    return tiles_along(width) * tiles_along(height);
}

static int least(int a, int b) {
    return a < b ? a : b;
}

render_rectangle render_tile_at(int width, int height, int number) {
    const int columns = tiles_along(width);
    const int x = number % columns * RENDER_TILE, y = number / columns * RENDER_TILE;
    return (render_rectangle) { x, y, least(RENDER_TILE, width - x),
                                least(RENDER_TILE, height - y) };
}

bool render_tile_create(int pixels, render_tile *tile) {
    const size_t count = (size_t)pixels;
    memset(tile, 0, sizeof *tile);
    float *memory = malloc(count * (sizeof *tile->material + 1) + bytes_of(TILED, count));
    if (!memory)
        return false;
    tile->material = (lmp_material *)(void *)memory;
    memory = (float *)(void *)(tile->material + count);
    float **planes[] = { tile->position, tile->normal, tile->view, tile->coat_normal,
                         tile->emission };
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++)
        for (int c = 0; c < 3; c++)
            planes[i][c] = next(&memory, count);
    tile->ambient = next(&memory, count);
    tile->kind = (unsigned char *)memory;
    return true;
}

void render_tile_free(render_tile *tile) {
    free(tile->material);
}

static lmp_rgb light_of(const render_surfaces *s, uint32_t number) {
    return number < s->frame->light_count ? s->frame->lights[number].emitter.radiance
                                          : (lmp_rgb) { 0, 0, 0 };
}

/* What is seen past everything, in the direction against `view`. */
static lmp_rgb background_of(const render_surfaces *s, const float view[3]) {
    const float *background = s->frame->background;
    const float away[3] = { -view[0], -view[1], -view[2] };
    if (environment_shines(s->environment) && s->environment->backdrop.rgb &&
        !s->frame->hide_backdrop)
        return environment_seen(s->environment, away);
    return (lmp_rgb) { background[0], background[1], background[2] };
}

lmp_rgb render_surfaces_beyond(const render_surfaces *s, int x, int y) {
    float view[3];
    float *const planes[3] = { &view[0], &view[1], &view[2] };
    const uint32_t seen = s->seen[render_surfaces_at(s, x, y)];
    if (seen != RENDER_SEES_NOTHING)
        return light_of(s, seen - RENDER_SEES_LIGHT);
    render_camera_views(&s->camera, x, y, 1, planes);
    return background_of(s, view);
}

static lmp_rgb color_at(float *const planes[3], size_t pixel) {
    return (lmp_rgb) { planes[0][pixel], planes[1][pixel], planes[2][pixel] };
}

/* Of a surface, without its colors. In place, for it is large. */
static void fill_reflector(const render_surfaces *s, size_t pixel, lmp_material *material) {
    const uint32_t number = s->seen[pixel];
    const bool layered = s->layered && render_material_is_layered(s->materials, number);
    const lmp_rgb tint = layered ? color_at(s->tint, pixel) : (lmp_rgb) { 1, 1, 1 };
    render_material_fill(s->materials, number, s->specular[pixel], tint, material);
    if (layered)
        render_material_cover(s->materials, (lmp_coat) { s->coat[pixel], s->coat_roughness[pixel] },
                              color_at(s->sheen, pixel), s->sheen_roughness[pixel], material);
}

/* Whether two pixels that see surfaces have the same reflector. */
static bool are_alike(const render_surfaces *s, size_t a, size_t b) {
    return !s->layered && s->seen[a] == s->seen[b] && s->specular[a] == s->specular[b];
}

static void fill_surface(const render_surfaces *s, size_t pixel, size_t at, render_tile *tile) {
    lmp_material *material = &tile->material[at];
    material->base_color = color_at(s->base, pixel);
    material->metallic = s->metallic[pixel];
    material->roughness = s->roughness[pixel];
    tile->ambient[at] = s->ambient[pixel];
    const bool coated = s->layered && material->coat.weight > 0;
    for (int c = 0; s->layered && c < 3; c++)
        tile->coat_normal[c][at] = coated ? s->coat_normal[c][pixel] : s->normal[c][pixel];
}

/* `count` pixels of a row, into the tile from `at` on. */
static void fill_span(const render_surfaces *s, size_t first, size_t count, size_t at,
                      render_tile *tile) {
    for (int c = 0; c < 3; c++) {
        memcpy(tile->position[c] + at, s->position[c] + first, count * sizeof(float));
        memcpy(tile->normal[c] + at, s->normal[c] + first, count * sizeof(float));
    }
    for (size_t i = 0; i < count; i++) {
        const size_t pixel = first + i, to = at + i;
        const uint32_t seen = s->seen[pixel];
        tile->kind[to] = seen == RENDER_SEES_NOTHING ? RENDER_NONE
                         : seen >= RENDER_SEES_LIGHT ? RENDER_LIGHT
                                                     : RENDER_SURFACE;
        if (tile->kind[to] != RENDER_SURFACE)
            continue;
        for (int c = 0; c < 3; c++)
            tile->emission[c][to] = s->emission[c][pixel];
        if (i > 0 && are_alike(s, pixel, pixel - 1))
            tile->material[to] = tile->material[to - 1];
        else
            fill_reflector(s, pixel, &tile->material[to]);
        fill_surface(s, pixel, to, tile);
    }
}

void render_surfaces_tile(const render_surfaces *s, int x, int y, int width, int height,
                          render_tile *tile) {
    for (int i = 0; i < height; i++) {
        const size_t at = (size_t)i * (size_t)width;
        float *const views[3] = { tile->view[0] + at, tile->view[1] + at, tile->view[2] + at };
        render_camera_views(&s->camera, x, y + i, width, views);
        fill_span(s, render_surfaces_at(s, x, y + i), (size_t)width, at, tile);
    }
}

/* Views of the pixels of a list, those side by side in a row together. */
static void pick_views(const render_surfaces *s, const uint32_t *pixels, size_t count,
                       render_tile *tile) {
    const uint32_t width = (uint32_t)s->width;
    for (size_t i = 0, end; i < count; i = end) {
        const uint32_t row = pixels[i] / width, past = (row + 1) * width;
        for (end = i + 1; end < count && pixels[end] == pixels[end - 1] + 1 && pixels[end] < past;)
            end++;
        float *const views[3] = { tile->view[0] + i, tile->view[1] + i, tile->view[2] + i };
        render_camera_views(&s->camera, s->x + (int)(pixels[i] - row * width), s->y + (int)row,
                            (int)(end - i), views);
    }
}

static void pick_plane(const float *from, const uint32_t *pixels, size_t count, float *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = from[pixels[i]];
}

void render_surfaces_pick(const render_surfaces *s, const uint32_t *pixels, size_t count,
                          render_tile *tile) {
    pick_views(s, pixels, count, tile);
    for (int c = 0; c < 3; c++) {
        pick_plane(s->position[c], pixels, count, tile->position[c]);
        pick_plane(s->normal[c], pixels, count, tile->normal[c]);
        pick_plane(s->emission[c], pixels, count, tile->emission[c]);
    }
    for (size_t i = 0; i < count; i++) {
        const size_t pixel = pixels[i];
        tile->kind[i] = RENDER_SURFACE;
        if (i > 0 && are_alike(s, pixel, pixels[i - 1]))
            tile->material[i] = tile->material[i - 1];
        else
            fill_reflector(s, pixel, &tile->material[i]);
        fill_surface(s, pixel, i, tile);
    }
}

size_t render_surfaces_positions(const render_surfaces *s, int y, render_tile *tile) {
    const size_t first = render_surfaces_at(s, s->x, y);
    size_t count = 0;
    for (int x = 0; x < s->width; x++) {
        const size_t pixel = first + (size_t)x;
        for (int c = 0; c < 3; c++)
            tile->position[c][count] = s->position[c][pixel];
        count += s->seen[pixel] < RENDER_SEES_LIGHT;
    }
    return count;
}
