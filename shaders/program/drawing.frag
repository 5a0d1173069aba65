/* SPDX-License-Identifier: MIT */
/* Draws over a window; the drawing's upper left corner is at corner.xy of a window corner.z pixels
 * high. */
layout(binding = 0) uniform sampler2D drawing;
layout(location = 0) uniform ivec3 corner;
layout(location = 0) out vec4 color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    color = texelFetch(drawing, ivec2(at.x - corner.x, corner.z - 1 - at.y - corner.y), 0);
}
