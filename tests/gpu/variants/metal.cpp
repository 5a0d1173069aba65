/* SPDX-License-Identifier: MIT */
/* Runs shade.metal on the CPU: metal INPUT OUTPUT, both vectors of four floats. */
#include "metal.h"

#include <cstdio>
#include <vector>

#include "shade.metal"

int main(int count, char **argument) {
    std::vector<float4> given(2 * LIGHTS + 3 * SURFACES + TEXELS + 11 * AREAS),
        values(4 * SURFACES);
    FILE *input = count == 3 ? std::fopen(argument[1], "rb") : nullptr;
    if (!input || std::fread(given.data(), sizeof given[0], given.size(), input) != given.size())
        return 1;
    std::fclose(input);
    for (int i = 0; i < SURFACES; i++)
        shade(given.data(), i, &values[4 * static_cast<size_t>(i)]);
    FILE *output = std::fopen(argument[2], "wb");
    if (!output ||
        std::fwrite(values.data(), sizeof values[0], values.size(), output) != values.size())
        return 1;
    return std::fclose(output) == 0 ? 0 : 1;
}
