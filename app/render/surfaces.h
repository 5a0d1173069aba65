/* SPDX-License-Identifier: MIT */
/* surfaces.h - what one sample of a frame's pixels sees: planes of float32, a value per pixel. Rays
 * or a G-buffer fill them; shading, fields and shadows read them, tile by tile. */
#ifndef LAMPION_RENDER_SURFACES_H
#define LAMPION_RENDER_SURFACES_H

#include "app/render/camera.h"
#include "app/render/materials.h"
#include "app/scene/environment.h"
#include "app/scene/trace/rays.h"

/* What a pixel sees: nothing, a light of the frame by its number, or a surface of the material with
 * that number. */
#define RENDER_SEES_NOTHING UINT32_MAX
#define RENDER_SEES_LIGHT   0x80000000u /* plus the light's number */

struct render_surfaces {
    int x, y, width, height; /* the rectangle of the image's pixels that the planes cover */
    render_camera camera;
    const render_frame *frame;
    const render_materials *materials;
    const environment *environment; /* NULL: none */
    bool layered;                   /* whether the planes of layers exist, from coat_normal on */
    bool translucent;               /* whether the plane of transmitted color exists */
    void *memory;
    uint32_t *seen;
    float *position[3], *normal[3];        /* of surfaces, as are those below */
    float *base[3], *metallic, *roughness; /* unused where a table replaces the material */
    float *specular;                       /* a factor on the dielectric's reflection */
    float *ambient;                        /* fraction of the environment's light that arrives */
    float *emission[3];                    /* as seen through a coat */
    float *coat_normal[3], *coat, *coat_roughness; /* of layered materials alone */
    float *tint[3];                                /* a factor on F0 */
    float *sheen[3], *sheen_roughness;
    float *transmitted[3]; /* color of transmitted light, as seen through a coat */
    float *bounced[3];     /* radiance that surfaces reflect of each other's light; or NULL */
    float *arrived[3];     /* and the irradiance of it, W·m⁻² */
    float *weight; /* NULL, or in a scene with blended surfaces the weight of a sample that has met
                      one, and 0 elsewhere (app/scene/trace/blend.h) */
    trace_hit *hits;  /* also behind lights; NULL for a G-buffer, or if not requested */
    uint32_t *smooth; /* normals without maps, packed by app/render/cpu/shared.h; or NULL */
    /* In a later sample: which pixels are the same as in the first one, whose planes have the same
     * layout. For these, only `seen` and positions are set here. NULL: none. */
    unsigned char *same;
    const render_surfaces *first;
    /* Or which pixels are copies of those of the first sample, whose bounced light they have. NULL:
     * none. */
    unsigned char *taken;
};

/* Creates planes for a rectangle of that size at 0, 0, including those that the materials need.
 * Returns false if memory ran out. */
bool render_surfaces_create(int width, int height, const render_materials *materials,
                            render_surfaces *surfaces);
void render_surfaces_free(render_surfaces *surfaces);

/* Return the number of values for such planes, and lay them out in memory of the caller's. */
size_t render_surfaces_values(int width, int height, const render_materials *materials);
void render_surfaces_lay(float *memory, int width, int height, const render_materials *materials,
                         render_surfaces *surfaces);

/* Allocate the plane of hits, or of normals, for whoever fills the planes to keep. Return false if
 * memory ran out. */
bool render_surfaces_keep_hits(render_surfaces *surfaces);
bool render_surfaces_keep_smooth(render_surfaces *surfaces);

enum { RENDER_BOUNCED_PLANES = 6 };

/* Sets the planes of bounced light to those in `memory`, or to none if it is NULL. */
void render_surfaces_lay_bounced(float *memory, render_surfaces *surfaces);

/* Allocates the planes of bounced light for a frame that has any, or frees them for one that has
 * none. Returns false if memory ran out. */
bool render_surfaces_fit_bounced(const render_frame *frame, render_surfaces *surfaces);

/* Allocate `same`, so that pixels may be left to `first`, or `taken`, so that copies of its pixels
 * are known; `first` is to be set. Return false if memory ran out. */
bool render_surfaces_share(render_surfaces *surfaces);
bool render_surfaces_note_taken(render_surfaces *surfaces);

/* Whether a pixel, by its index, is the same as in the first sample. */
static inline bool render_surfaces_same(const render_surfaces *s, size_t pixel) {
    return s->same && s->same[pixel];
}

/* Lists the pixels among `count` from an index on that are not; returns how many there are. */
static inline size_t render_surfaces_others(const render_surfaces *s, size_t first, int count,
                                            size_t *list) {
    size_t others = 0;
    for (size_t at = first; at < first + (size_t)count; at++) {
        list[others] = at;
        others += !render_surfaces_same(s, at);
    }
    return others;
}

/* Whether a pixel, by its index, is a copy of the first sample's. */
static inline bool render_surfaces_taken(const render_surfaces *s, size_t pixel) {
    return s->taken && s->taken[pixel];
}

/* Returns the planes that hold a pixel's surface, except `seen` and its position. */
static inline const render_surfaces *render_surfaces_owner(const render_surfaces *s, size_t pixel) {
    return render_surfaces_same(s, pixel) ? s->first : s;
}

/* How much the normals, and positions, that two samples of a pixel see may differ for them to count
 * as the same surface. For positions: the squared difference at distance 0, and its growth with the
 * squared distance. */
#define RENDER_NORMAL_STEP (1 / 64.0f)
typedef struct render_nearness {
    float constant, spread;
} render_nearness;
render_nearness render_nearness_of(const render_camera *camera);

/* Returns the index of a pixel of the image in the planes. */
static inline size_t render_surfaces_at(const render_surfaces *s, int x, int y) {
    return (size_t)(y - s->y) * (size_t)s->width + (size_t)(x - s->x);
}

/* A rectangle of an image's pixels. */
struct render_rectangle {
    int x, y, width, height;
};

/* Images are drawn in tiles of at most so many pixels a side. Their pixels lie close to each other:
 * near the same lights, in few cells of a field. The functions return the number of tiles, and one
 * of them. */
enum { RENDER_TILE = 32, RENDER_TILE_PIXELS = RENDER_TILE * RENDER_TILE };
int render_tile_count(int width, int height);
render_rectangle render_tile_at(int width, int height, int number);

typedef enum render_kind { RENDER_NONE, RENDER_LIGHT, RENDER_SURFACE } render_kind;

/* Pixels side by side in the library's form. For a kind other than RENDER_SURFACE the other members
 * are not set; for a surface, radiance = emission + what lmp_shade gives, where bounced light
 * counts as emission. */
struct render_tile {
    unsigned char *kind; /* render_kind */
    float *position[3], *normal[3], *view[3];
    float *coat_normal[3]; /* if the surfaces are layered */
    float *emission[3];
    bool translucent; /* whether the surfaces are translucent and have this: */
    float *transmitted[3];
    float *ambient;
    lmp_material *material;
};
bool render_tile_create(int pixels, render_tile *tile);
void render_tile_free(render_tile *tile);

/* Calls `use` for every tile of an image, on all cores, with a render_tile of the thread, whose
 * contents `use` fills itself. Returns false if memory ran out. */
typedef void render_tile_user(const render_rectangle *pixels, render_tile *tile, void *user);
bool render_tiles_visit(int width, int height, render_tile_user *use, void *user);

/* Returns the surfaces of a tile that sees nothing else, as the library takes them; `layered`:
 * whether they have normals of coats. */
lmp_surfaces render_tile_surfaces(const render_tile *tile, bool layered);

/* Extracts the pixels of a rectangle, rows from the top; may be called from any thread, each with a
 * tile of its own. */
void render_surfaces_tile(const render_surfaces *surfaces, int x, int y, int width, int height,
                          render_tile *tile);

/* Extracts the kinds, positions, normals and emission of the pixels of a rectangle. */
void render_surfaces_outline(const render_surfaces *surfaces, const render_rectangle *pixels,
                             render_tile *tile);

/* Fills the planes of bounced light, on all cores, if the frame has any. Returns false if memory
 * ran out. */
bool render_surfaces_fill_bounced(const render_surfaces *surfaces);

/* Returns the radiance of the light or background that a pixel without a surface sees. */
lmp_rgb render_surfaces_beyond(const render_surfaces *surfaces, int x, int y);

/* Extracts the pixels of a list of indices in the planes, all of which see a surface. */
void render_surfaces_pick(const render_surfaces *surfaces, const uint32_t *pixels, size_t count,
                          render_tile *tile);

/* Extracts the positions of the surfaces in a row, one after another; returns how many there
 * are. */
size_t render_surfaces_positions(const render_surfaces *surfaces, int y, render_tile *tile);

/* Return and set a color of planes, by the pixel's index. */
static inline lmp_rgb render_color_at(float *const planes[3], size_t pixel) {
    return (lmp_rgb) { planes[0][pixel], planes[1][pixel], planes[2][pixel] };
}
static inline void render_set_color(float *const planes[3], size_t pixel, lmp_rgb color) {
    planes[0][pixel] = color.r;
    planes[1][pixel] = color.g;
    planes[2][pixel] = color.b;
}

/* Returns planes of vectors as the library takes them. */
static inline lmp_vec3_array render_vectors(float *const planes[3]) {
    return (lmp_vec3_array) { planes[0], planes[1], planes[2], sizeof(float) };
}

/* Returns the radiance of a pixel's surface, by its index in the planes that hold it, that does not
 * come from lights directly: its emission and bounced light. */
static inline lmp_rgb render_surfaces_emission(const render_surfaces *s, size_t pixel) {
    float sum[3];
    for (int c = 0; c < 3; c++)
        sum[c] = s->emission[c][pixel] + (s->bounced[c] ? s->bounced[c][pixel] : 0);
    return (lmp_rgb) { sum[0], sum[1], sum[2] };
}

#endif
