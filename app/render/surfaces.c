/* SPDX-License-Identifier: MIT */
#include "app/render/surfaces.h"

#include "app/base/memory.h"

#include <stdlib.h>
#include <string.h>

/* --- planes ----------------------------------------------------------------------------------- */

enum { PLAIN = 16, LAYERED = 12, TRANSLUCENT = 3, TILED = 19 };

/* The gap between planes, a cache line. Planes of a tile have 4096 bytes: without the gap, the same
 * pixel of all planes would map to one cache set, which holds fewer. */
enum { APART = 16 };

static size_t values_of(size_t planes, size_t count) {
    return planes * (count + APART);
}

/* Returns the next plane of `count` values. */
static float *next(float **memory, size_t count) {
    float *plane = *memory;
    *memory += count + APART;
    return plane;
}

size_t render_surfaces_values(int width, int height, const render_materials *materials) {
    size_t planes = 1 + PLAIN;
    planes += materials->layered ? LAYERED : 0;
    planes += materials->translucent ? TRANSLUCENT : 0;
    planes += materials->blends ? 1 : 0;
    return values_of(planes, (size_t)width * (size_t)height);
}

void render_surfaces_lay(float *memory, int width, int height, const render_materials *materials,
                         render_surfaces *s) {
    const bool layered = materials->layered, translucent = materials->translucent;
    const size_t count = (size_t)width * (size_t)height;
    memset(s, 0, sizeof *s);
    s->width = width;
    s->height = height;
    s->layered = layered;
    s->translucent = translucent;
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
    for (int c = 0; translucent && c < 3; c++)
        s->transmitted[c] = next(&memory, count);
    if (materials->blends)
        s->weight = next(&memory, count);
}

bool render_surfaces_create(int width, int height, const render_materials *materials,
                            render_surfaces *s) {
    memset(s, 0, sizeof *s);
    float *memory = memory_large(render_surfaces_values(width, height, materials) * sizeof *memory);
    if (!memory)
        return false;
    render_surfaces_lay(memory, width, height, materials, s);
    s->memory = memory;
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

void render_surfaces_lay_bounced(float *memory, render_surfaces *s) {
    const size_t count = (size_t)s->width * (size_t)s->height;
    for (size_t c = 0; c < 3; c++) {
        s->bounced[c] = memory ? memory + c * count : NULL;
        s->arrived[c] = memory ? memory + (3 + c) * count : NULL;
    }
}

bool render_surfaces_fit_bounced(const render_frame *frame, render_surfaces *s) {
    const size_t count = (size_t)s->width * (size_t)s->height;
    float *memory = s->bounced[0];
    if (!frame->bounces.fill) {
        free(memory);
        memory = NULL;
    } else if (!memory)
        memory = memory_large(RENDER_BOUNCED_PLANES * count * sizeof *memory);
    render_surfaces_lay_bounced(memory, s);
    return memory || !frame->bounces.fill;
}

bool render_surfaces_share(render_surfaces *s) {
    if (!s->same)
        s->same = calloc((size_t)s->width * (size_t)s->height, sizeof *s->same);
    return s->same;
}

bool render_surfaces_note_taken(render_surfaces *s) {
    if (!s->taken)
        s->taken = calloc((size_t)s->width * (size_t)s->height, sizeof *s->taken);
    return s->taken;
}

render_nearness render_nearness_of(const render_camera *c) {
    static const float steps = 4; /* in widths of a pixel */
    const float down2 = c->down[0] * c->down[0] + c->down[1] * c->down[1] + c->down[2] * c->down[2];
    const float reach2 = steps * steps * down2 * c->step[1] * c->step[1];
    return (render_nearness) { c->parallel ? reach2 : 0, c->parallel ? 0 : reach2 };
}

void render_surfaces_free(render_surfaces *s) {
    free(s->same);
    free(s->taken);
    free(s->smooth);
    free(s->hits);
    free(s->bounced[0]);
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
    float *memory =
        malloc(count * (sizeof *tile->material + 1) + values_of(TILED, count) * sizeof(float));
    if (!memory)
        return false;
    tile->material = (lmp_material *)(void *)memory;
    memory = (float *)(void *)(tile->material + count);
    float **planes[] = { tile->position,    tile->normal,   tile->view,
                         tile->coat_normal, tile->emission, tile->transmitted };
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

lmp_surfaces render_tile_surfaces(const render_tile *tile, bool layered) {
    lmp_surfaces surfaces = {
        .position = render_vectors(tile->position),
        .normal = render_vectors(tile->normal),
        .view = render_vectors(tile->view),
        .material = tile->material,
        .material_stride = sizeof *tile->material,
    };
    if (layered)
        surfaces.coat_normal = render_vectors(tile->coat_normal);
    return surfaces;
}

bool render_tiles_visit(int width, int height, render_tile_user *use, void *user) {
    const int count = render_tile_count(width, height);
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        render_tile tile;
        const bool mine = ok = render_tile_create(RENDER_TILE_PIXELS, &tile);
#pragma omp for schedule(dynamic)
        for (int i = 0; i < count; i++)
            if (mine) {
                const render_rectangle pixels = render_tile_at(width, height, i);
                use(&pixels, &tile, user);
            }
        if (mine)
            render_tile_free(&tile);
    }
    return ok;
}

static void fill_bounced(const render_rectangle *pixels, render_tile *tile, void *user) {
    const render_surfaces *s = user;
    s->frame->bounces.fill(s->frame->bounces.user, s, pixels, tile);
}

bool render_surfaces_fill_bounced(const render_surfaces *s) {
    render_surfaces planes = *s;
    return !s->frame->bounces.fill ||
           render_tiles_visit(s->width, s->height, fill_bounced, &planes);
}

static lmp_rgb light_of(const render_surfaces *s, uint32_t number) {
    return number < s->frame->light_count ? s->frame->lights[number].emitter.radiance
                                          : (lmp_rgb) { 0, 0, 0 };
}

/* Returns the background's radiance in the direction opposite to `view`. */
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

/* Fills in what a surface's material has in common with others of that material, in place because
 * the struct is large; base color, metalness and roughness are left to fill_surface. */
static void fill_material_constants(const render_surfaces *s, size_t pixel,
                                    lmp_material *material) {
    const uint32_t number = s->seen[pixel];
    const bool layered = s->layered && render_material_is_layered(s->materials, number);
    const lmp_rgb tint = layered ? render_color_at(s->tint, pixel) : (lmp_rgb) { 1, 1, 1 };
    render_material_fill(s->materials, number, s->specular[pixel], tint, material);
    if (layered)
        render_material_cover(s->materials, (lmp_coat) { s->coat[pixel], s->coat_roughness[pixel] },
                              render_color_at(s->sheen, pixel), s->sheen_roughness[pixel],
                              material);
}

/* Whether two pixels that see surfaces share the part that fill_material_constants sets. */
static bool are_alike(const render_surfaces *s, size_t a, size_t b) {
    return !s->layered && s->seen[a] == s->seen[b] &&
           render_surfaces_owner(s, a)->specular[a] == render_surfaces_owner(s, b)->specular[b];
}

static void fill_emission(const render_surfaces *s, size_t pixel, size_t at, render_tile *tile) {
    render_set_color(tile->emission, at, render_surfaces_emission(s, pixel));
}

static void fill_surface(const render_surfaces *s, size_t pixel, size_t at, render_tile *tile) {
    lmp_material *material = &tile->material[at];
    material->base_color = render_color_at(s->base, pixel);
    material->metallic = s->metallic[pixel];
    material->roughness = s->roughness[pixel];
    tile->ambient[at] = s->ambient[pixel];
    for (int c = 0; s->translucent && c < 3; c++)
        tile->transmitted[c][at] = s->transmitted[c][pixel];
    const bool coated = s->layered && material->coat.weight > 0;
    for (int c = 0; s->layered && c < 3; c++)
        tile->coat_normal[c][at] = coated ? s->coat_normal[c][pixel] : s->normal[c][pixel];
}

static render_kind kind_of(uint32_t seen) {
    return seen == RENDER_SEES_NOTHING ? RENDER_NONE
           : seen >= RENDER_SEES_LIGHT ? RENDER_LIGHT
                                       : RENDER_SURFACE;
}

/* Fills `count` pixels of a row into the tile from `at` on. */
static void fill_span(const render_surfaces *s, size_t first, size_t count, size_t at,
                      render_tile *tile) {
    for (int c = 0; c < 3; c++)
        memcpy(tile->position[c] + at, s->position[c] + first, count * sizeof(float));
    for (size_t i = 0; i < count; i++) {
        const size_t pixel = first + i, to = at + i;
        const render_surfaces *own = render_surfaces_owner(s, pixel);
        tile->kind[to] = (unsigned char)kind_of(s->seen[pixel]);
        if (tile->kind[to] != RENDER_SURFACE)
            continue;
        for (int c = 0; c < 3; c++)
            tile->normal[c][to] = own->normal[c][pixel];
        fill_emission(own, pixel, to, tile);
        if (i > 0 && are_alike(s, pixel, pixel - 1))
            tile->material[to] = tile->material[to - 1];
        else
            fill_material_constants(own, pixel, &tile->material[to]);
        fill_surface(own, pixel, to, tile);
    }
}

void render_surfaces_tile(const render_surfaces *s, int x, int y, int width, int height,
                          render_tile *tile) {
    tile->translucent = s->translucent;
    for (int i = 0; i < height; i++) {
        const size_t at = (size_t)i * (size_t)width;
        float *const views[3] = { tile->view[0] + at, tile->view[1] + at, tile->view[2] + at };
        render_camera_views(&s->camera, x, y + i, width, views);
        fill_span(s, render_surfaces_at(s, x, y + i), (size_t)width, at, tile);
    }
}

void render_surfaces_outline(const render_surfaces *s, const render_rectangle *pixels,
                             render_tile *tile) {
    size_t at = 0;
    for (int y = pixels->y; y < pixels->y + pixels->height; y++) {
        const size_t first = render_surfaces_at(s, pixels->x, y);
        for (size_t i = first; i < first + (size_t)pixels->width; i++, at++) {
            const render_surfaces *from = render_surfaces_owner(s, i);
            tile->kind[at] = (unsigned char)kind_of(s->seen[i]);
            for (int c = 0; c < 3; c++) {
                tile->position[c][at] = s->position[c][i];
                tile->normal[c][at] = from->normal[c][i];
            }
            fill_emission(from, i, at, tile);
        }
    }
}

/* Computes the views of a list of pixels, those adjacent in a row together. */
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
    tile->translucent = s->translucent;
    pick_views(s, pixels, count, tile);
    for (int c = 0; c < 3; c++) {
        pick_plane(s->position[c], pixels, count, tile->position[c]);
        pick_plane(s->normal[c], pixels, count, tile->normal[c]);
    }
    for (size_t i = 0; i < count; i++) {
        const size_t pixel = pixels[i];
        tile->kind[i] = RENDER_SURFACE;
        fill_emission(s, pixel, i, tile);
        if (i > 0 && are_alike(s, pixel, pixels[i - 1]))
            tile->material[i] = tile->material[i - 1];
        else
            fill_material_constants(s, pixel, &tile->material[i]);
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
