/* SPDX-License-Identifier: MIT */
/* texels.glsl - arrays of vec4 that are read at any index (app/render/gl/texels.h): TEXELS declares
 * one by the number of its storage block, TEXEL reads an element. In a page it is a texture of any
 * width, row by row. */
#ifdef SHARED_WITHOUT_STORAGE
#define TEXELS(block, name, number) uniform sampler2D name;
#define TEXEL(name, i) texelFetch(name, ivec2((i) % textureSize(name, 0).x, (i) / textureSize(name, 0).x), 0)
#elif defined(TEXELS_FETCHED)
#define TEXELS(block, name, number)                                                                \
    layout(binding = SHARED_TEXELS + number) uniform samplerBuffer name;
#define TEXEL(name, i) texelFetch(name, i)
#else
#define TEXELS(block, name, number)                                                                \
    layout(std430, binding = number) readonly restrict buffer block { vec4 name[]; };
#define TEXEL(name, i) name[i]
#endif
