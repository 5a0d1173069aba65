/* SPDX-License-Identifier: MIT */
/* Averages a pixel's samples. With an exposure, bright samples weigh less, as the tone curve will
 * compress them: the edge of a lamp then fades over a pixel instead of staying jagged. */
#include "shared.h"

layout(local_size_x = SHARED_GROUP, local_size_y = SHARED_GROUP) in;
layout(binding = 0, rgba32f) uniform restrict image2D hdr;
layout(binding = 1, rgba32f) uniform restrict image2D sums;
layout(location = 0) uniform float exposure;
layout(location = 1) uniform int first;
layout(location = 2) uniform int keep; /* set if more samples follow */
layout(location = 3) uniform int show; /* set to write the mean so far to the image */

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, ivec2(size_lights.xy))))
        return;
    vec3 radiance = imageLoad(hdr, at).rgb;
    float weight = 1.0 / (1.0 + exposure * max(radiance.r, max(radiance.g, radiance.b)));
    vec4 sum = vec4(radiance * weight, weight);
    if (first == 0)
        sum += imageLoad(sums, at);
    if (keep != 0)
        imageStore(sums, at, sum);
    if (show != 0)
        imageStore(hdr, at, vec4(sum.rgb / sum.a, 1.0));
}
