/* SPDX-License-Identifier: MIT */
/* surfaces.h - what one sample of a frame's pixels sees: planes of float32, a value a pixel. Rays
 * or a G-buffer fill them; shading, fields and shadows read them, a tile at a time. */
#ifndef LAMPION_RENDER_SURFACES_H
#define LAMPION_RENDER_SURFACES_H

#include "app/environment/environment.h"
#include "app/render/frame/camera.h"
#include "app/render/frame/materials.h"
#include "app/trace/rays.h"

/* What a pixel sees: nothing, a light of the frame by its number, or a surface of a material. */
#define RENDER_SEES_NOTHING UINT32_MAX
#define RENDER_SEES_LIGHT   0x80000000u /* plus the light's number */

struct render_surfaces {
    int x, y, width, height; /* the rectangle of the image's pixels that the planes hold */
    render_camera camera;
    const render_frame *frame;
    const render_materials *materials;
    const environment *environment; /* NULL: none */
    bool layered;                   /* the planes from coat_normal on are there */
    void *memory;
    uint32_t *seen;
    float *position[3], *normal[3];                /* of surfaces, as those after it */
    float *base[3], *metallic, *roughness;         /* not of tables */
    float *specular;                               /* a factor on the dielectric's */
    float *ambient;                                /* how much of the environment comes */
    float *emission[3];                            /* as seen through a coat */
    float *coat_normal[3], *coat, *coat_roughness; /* of layered materials alone */
    float *tint[3];                                /* a factor on F0 */
    float *sheen[3], *sheen_roughness;
    trace_hit *hits; /* triangles, also behind lights; NULL of a G-buffer, or if nobody asks */
    uint32_t
        *smooth; /* normals without their maps, as app/render/cpu/shared.h packs them; as hits */
};

/* Planes for a rectangle of so many pixels at 0, 0. False without memory. */
bool render_surfaces_create(int width, int height, bool layered, render_surfaces *surfaces);
void render_surfaces_free(render_surfaces *surfaces);

/* Has whoever fills the planes keep the triangles that rays hit, or normals. False without memory.
 */
bool render_surfaces_keep_hits(render_surfaces *surfaces);
bool render_surfaces_keep_smooth(render_surfaces *surfaces);

/* How much the normals of what two samples of a pixel see may differ for it to count as one
 * surface; and how much the positions: the square of it at distance 0, and what that grows by with
 * the square of the distance. */
#define RENDER_NORMAL_STEP (1 / 64.0f)
typedef struct render_nearness {
    float constant, spread;
} render_nearness;
render_nearness render_nearness_of(const render_camera *camera);

/* The index of a pixel of the image in the planes. */
static inline size_t render_surfaces_at(const render_surfaces *s, int x, int y) {
    return (size_t)(y - s->y) * (size_t)s->width + (size_t)(x - s->x);
}

/* A rectangle of an image's pixels. */
typedef struct render_rectangle {
    int x, y, width, height;
} render_rectangle;

/* Images are drawn in tiles of at most so many pixels a side, whose pixels lie close to each other:
 * near the same lights, in few cells of a field. How many there are, and one of them. */
enum { RENDER_TILE = 32, RENDER_TILE_PIXELS = RENDER_TILE * RENDER_TILE };
int render_tile_count(int width, int height);
render_rectangle render_tile_at(int width, int height, int number);

typedef enum render_kind { RENDER_NONE, RENDER_LIGHT, RENDER_SURFACE } render_kind;

/* Pixels side by side as the library takes them. The kind alone means something where it is not
 * RENDER_SURFACE; radiance = emission + what lmp_shade gives for a surface. */
typedef struct render_tile {
    unsigned char *kind; /* render_kind */
    float *position[3], *normal[3], *view[3];
    float *coat_normal[3]; /* where the surfaces are layered */
    float *emission[3];
    float *ambient;
    lmp_material *material;
} render_tile;
bool render_tile_create(int pixels, render_tile *tile);
void render_tile_free(render_tile *tile);

/* The pixels of a rectangle, rows from the top, from any thread, each with a tile of its own. */
void render_surfaces_tile(const render_surfaces *surfaces, int x, int y, int width, int height,
                          render_tile *tile);

/* What is seen of a light or past everything by a pixel that sees no surface. */
lmp_rgb render_surfaces_beyond(const render_surfaces *surfaces, int x, int y);

/* The pixels of a list alone, by their indices in the planes, all of which see a surface. */
void render_surfaces_pick(const render_surfaces *surfaces, const uint32_t *pixels, size_t count,
                          render_tile *tile);

/* The positions of the surfaces alone in a row, one after another; returns how many there are. */
size_t render_surfaces_positions(const render_surfaces *surfaces, int y, render_tile *tile);

/* What the surface of a pixel, by its index, emits. */
static inline lmp_rgb render_surfaces_emission(const render_surfaces *s, size_t pixel) {
    return (lmp_rgb) { s->emission[0][pixel], s->emission[1][pixel], s->emission[2][pixel] };
}

#endif
