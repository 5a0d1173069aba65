/* SPDX-License-Identifier: MIT */
/* gltf_motion.c - node animation, of which only the places of lights are kept: sampled at even
 * steps, fine enough for images. */
#include "app/scene/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES_PER_SECOND 60.0
#define SAMPLES_MAX        4096 /* of a light */
#define SECONDS_MAX        1e6

typedef enum channel_kind { CHANNEL_TRANSLATION, CHANNEL_ROTATION, CHANNEL_SCALE } channel_kind;
typedef enum channel_curve { CURVE_LINEAR, CURVE_STEP, CURVE_CUBIC } channel_curve;

/* A property of a node over time: `width` numbers a key; three times that in a cubic curve: the
 * tangent in, the value, the tangent out. */
typedef struct channel {
    long node;
    channel_kind kind;
    channel_curve curve;
    float *times, *values;
    size_t count, width;
} channel;

struct gltf_motions {
    channel *channels;
    size_t channel_count;
    long *parents; /* of each node, or -1 */
    double period;
};

/* --- reading ------------------------------------------------------------------------------------
 */

/* The floats of an accessor with a view and no sparse part; NULL for any other. */
static float *read_floats(const gltf *document, long index, size_t width, size_t *count) {
    const cJSON *accessor = document->accessors.items[index];
    const unsigned char *bytes;
    size_t size;
    void *owned = NULL;
    cli_error ignored;
    bool ok = true;
    const long view = gltf_index(accessor, "bufferView", document->views.count, &ok);
    const char *type = width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4";
    if (view < 0 || gltf_member(accessor, "sparse") || strcmp(gltf_text(accessor, "type"), type) ||
        gltf_number(accessor, "componentType", 0.0) != 5126.0 ||
        !gltf_view_bytes(document, (size_t)view, &bytes, &size, &owned, &ignored))
        return NULL;
    const size_t item = width * sizeof(float);
    *count = (size_t)gltf_number(accessor, "count", 0.0);
    const size_t offset = (size_t)gltf_number(accessor, "byteOffset", 0.0);
    const size_t stride =
        (size_t)gltf_number(document->views.items[view], "byteStride", (double)item);
    float *values = stride >= item ? malloc(*count * item) : NULL;
    for (size_t i = 0; values && i < *count; i++)
        memcpy(values + i * width, bytes + offset + i * stride, item);
    free(owned);
    return values;
}

static bool all_usable(const float *numbers, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i]))
            return false;
    return true;
}

static bool times_rise(const channel *c) {
    for (size_t i = 0; i < c->count; i++)
        if (!(c->times[i] >= 0.0f) || !((double)c->times[i] <= SECONDS_MAX) ||
            (i > 0 && !(c->times[i] > c->times[i - 1])))
            return false;
    return true;
}

/* What it animates; false for weights of morph targets and whatever is unknown. */
static bool find_kind(const cJSON *entry, const cJSON *sampler, channel *c) {
    static const char *const kinds[] = { "translation", "rotation", "scale" };
    const char *path = gltf_text(gltf_member(entry, "target"), "path");
    const char *curve = gltf_text(sampler, "interpolation");
    c->curve = strcmp(curve, "STEP") == 0          ? CURVE_STEP
               : strcmp(curve, "CUBICSPLINE") == 0 ? CURVE_CUBIC
                                                   : CURVE_LINEAR;
    for (int kind = 0; kind < 3; kind++)
        if (strcmp(path, kinds[kind]) == 0) {
            c->kind = (channel_kind)kind;
            c->width = c->kind == CHANNEL_ROTATION ? 4 : 3;
            return true;
        }
    return false;
}

static bool read_channel(const gltf *document, const cJSON *animation, const cJSON *entry,
                         channel *c) {
    bool ok = true;
    const cJSON *samplers = gltf_member(animation, "samplers");
    const long sampler = gltf_index(entry, "sampler", (size_t)cJSON_GetArraySize(samplers), &ok);
    const cJSON *curve = cJSON_GetArrayItem(samplers, (int)sampler);
    const long input = gltf_index(curve, "input", document->accessors.count, &ok);
    const long output = gltf_index(curve, "output", document->accessors.count, &ok);
    memset(c, 0, sizeof *c);
    c->node = gltf_index(gltf_member(entry, "target"), "node", document->nodes.count, &ok);
    if (!ok || sampler < 0 || input < 0 || output < 0 || c->node < 0 || !find_kind(entry, curve, c))
        return false;
    size_t value_count = 0;
    c->times = read_floats(document, input, 1, &c->count);
    c->values = read_floats(document, output, c->width, &value_count);
    const size_t wanted = c->curve == CURVE_CUBIC ? 3 * c->count : c->count;
    if (c->times && c->values && value_count == wanted && times_rise(c) &&
        all_usable(c->values, value_count * c->width))
        return true;
    free(c->times);
    free(c->values);
    return false;
}

static bool animates_already(const gltf_motions *all, const channel *c) {
    for (size_t i = 0; i < all->channel_count; i++)
        if (all->channels[i].node == c->node && all->channels[i].kind == c->kind)
            return true;
    return false;
}

/* All animations of the file play at once; of two for one property the first counts. */
static void read_channels(const gltf *document, gltf_motions *all) {
    const cJSON *animation, *entry;
    cJSON_ArrayForEach(animation, gltf_member(document->root, "animations")) {
        cJSON_ArrayForEach(entry, gltf_member(animation, "channels")) {
            channel *c = &all->channels[all->channel_count];
            if (all->channel_count == 3 * document->nodes.count ||
                !read_channel(document, animation, entry, c))
                continue;
            if (animates_already(all, c)) {
                free(c->times);
                free(c->values);
                continue;
            }
            all->period = fmax(all->period, (double)c->times[c->count - 1]);
            all->channel_count++;
        }
    }
}

gltf_motions *gltf_motions_open(const gltf *document) {
    const size_t nodes = document->nodes.count;
    gltf_motions *all = calloc(1, sizeof *all);
    if (!all)
        return NULL;
    all->channels = calloc(3 * nodes + 1, sizeof *all->channels);
    all->parents = malloc((nodes + 1) * sizeof *all->parents);
    if (!all->channels || !all->parents) {
        gltf_motions_close(all);
        return NULL;
    }
    for (size_t i = 0; i < nodes; i++)
        all->parents[i] = -1;
    for (size_t i = 0; i < nodes; i++) {
        const cJSON *child;
        if (document->world[i][15] != 0.0)
            cJSON_ArrayForEach(child, gltf_member(document->nodes.items[i], "children"))
                all->parents[(size_t)child->valuedouble] = (long)i;
    }
    read_channels(document, all);
    return all;
}

void gltf_motions_close(gltf_motions *all) {
    if (!all)
        return;
    for (size_t i = 0; i < all->channel_count; i++) {
        free(all->channels[i].times);
        free(all->channels[i].values);
    }
    free(all->channels);
    free(all->parents);
    free(all);
}

/* --- sampling -----------------------------------------------------------------------------------
 */

/* q and r with -r alike: the shorter way, at constant speed. */
static void turn(const float *q, const float *r, double u, double *out) {
    double along = 0.0;
    for (int i = 0; i < 4; i++)
        along += (double)q[i] * (double)r[i];
    const double sign = along < 0.0 ? -1.0 : 1.0, angle = acos(fmin(along * sign, 1.0));
    const double sine = sin(angle);
    const double a = sine > 1e-6 ? sin((1.0 - u) * angle) / sine : 1.0 - u;
    const double b = sine > 1e-6 ? sin(u * angle) / sine : u;
    for (int i = 0; i < 4; i++)
        out[i] = a * (double)q[i] + b * sign * (double)r[i];
}

/* glTF's cubic spline between two keys of three entries each. */
static void bend(const channel *c, size_t low, double step, double u, double *out) {
    const float *from = c->values + 3 * low * c->width, *to = from + 3 * c->width;
    for (size_t i = 0; i < c->width; i++) {
        const double value = (double)from[c->width + i], leaving = (double)from[2 * c->width + i];
        const double next = (double)to[c->width + i], arriving = (double)to[i];
        const double u2 = u * u, u3 = u2 * u;
        out[i] = (2 * u3 - 3 * u2 + 1) * value + step * (u3 - 2 * u2 + u) * leaving +
                 (3 * u2 - 2 * u3) * next + step * (u3 - u2) * arriving;
    }
}

static void sample(const channel *c, double seconds, double *out) {
    const size_t stride = c->curve == CURVE_CUBIC ? 3 * c->width : c->width;
    const size_t inside = c->curve == CURVE_CUBIC ? c->width : 0;
    size_t low = 0, high = c->count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *((double)c->times[middle] <= seconds ? &low : &high) = middle;
    }
    const double step = (double)c->times[high] - (double)c->times[low];
    const double along = step > 0.0 ? (seconds - (double)c->times[low]) / step : 0.0;
    const double u = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    const float *from = c->values + low * stride + inside;
    const float *to = c->values + high * stride + inside;
    if (c->curve == CURVE_CUBIC && high > low)
        bend(c, low, step, u, out);
    else if (c->kind == CHANNEL_ROTATION && c->curve == CURVE_LINEAR)
        turn(from, to, u, out);
    else
        for (size_t i = 0; i < c->width; i++)
            out[i] = c->curve == CURVE_STEP && u < 1.0
                         ? (double)from[i]
                         : (double)from[i] + u * ((double)to[i] - (double)from[i]);
}

static void place_node(const gltf *document, const gltf_motions *all, long node, double seconds,
                       double point[3]) {
    gltf_transform transform;
    gltf_transform_read(document->nodes.items[node], &transform);
    for (size_t i = 0; i < all->channel_count; i++) {
        const channel *c = &all->channels[i];
        double *const parts[] = { transform.translation, transform.rotation, transform.scale };
        if (c->node == node)
            sample(c, seconds, parts[c->kind]);
    }
    double m[16], moved[3], length2 = 0.0;
    for (int i = 0; i < 4; i++)
        length2 += transform.rotation[i] * transform.rotation[i];
    for (int i = 0; i < 4 && length2 > 0.0; i++)
        transform.rotation[i] /= sqrt(length2);
    gltf_transform_matrix(&transform, m);
    if (gltf_member(document->nodes.items[node], "matrix"))
        gltf_numbers(document->nodes.items[node], "matrix", 16, m);
    for (int k = 0; k < 3; k++)
        moved[k] = m[k] * point[0] + m[4 + k] * point[1] + m[8 + k] * point[2] + m[12 + k];
    memcpy(point, moved, sizeof moved);
}

static bool is_moved(const gltf_motions *all, long node) {
    for (; node >= 0; node = all->parents[node])
        for (size_t i = 0; i < all->channel_count; i++)
            if (all->channels[i].node == node)
                return true;
    return false;
}

bool gltf_add_motion(const gltf *document, const gltf_motions *all, size_t node, size_t light,
                     scene_builder *builder, cli_error *error) {
    if (!(all->period > 0.0) || !is_moved(all, (long)node))
        return true;
    const double wanted = ceil(all->period * SAMPLES_PER_SECOND) + 1.0;
    const size_t count = wanted > SAMPLES_MAX ? SAMPLES_MAX : (size_t)wanted;
    const size_t first = builder_count(builder, BLOB_OFFSETS);
    scene_motion *motion = builder_append(builder, BLOB_MOTIONS, 1);
    lmp_vec3 *offsets = motion ? builder_append(builder, BLOB_OFFSETS, count) : NULL;
    if (!offsets)
        return cli_fail(error, document->subject, "does not fit into memory");
    *motion =
        (scene_motion) { (uint32_t)light, (uint32_t)first, (uint32_t)count, (float)all->period };
    for (size_t i = 0; i < count; i++) {
        double point[3] = { 0.0, 0.0, 0.0 };
        for (long at = (long)node; at >= 0; at = all->parents[at])
            place_node(document, all, at, all->period * (double)i / (double)(count - 1), point);
        const double *place = &document->world[node][12];
        offsets[i] = (lmp_vec3) { (float)(point[0] - place[0]), (float)(point[1] - place[1]),
                                  (float)(point[2] - place[2]) };
    }
    return true;
}
