/* SPDX-License-Identifier: MIT */
/* Runs shade.metal on the CPU: metal FOLDER OUTPUT, with FOLDER/given and FOLDER/tables of variants.c. */
#include "metal.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "shade.metal"

template <typename T> static std::vector<T> read(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes { std::istreambuf_iterator<char>(file), {} };
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(static_cast<void *>(values.data()), bytes.data(), values.size() * sizeof(T));
    return values;
}

int main(int count, char **argument) {
    if (count != 3)
        return 1;
    const std::string folder = argument[1];
    const std::vector<float4> given = read<float4>(folder + "/given");
    const std::vector<uint> words = read<uint>(folder + "/tables");
    std::vector<float> values(static_cast<size_t>(SURFACES) * VALUES);
    if (given.empty() || words.empty())
        return 1;
    for (int i = 0; i < SURFACES; i++)
        shade(given.data(), words.data(), i, &values[static_cast<size_t>(VALUES) * static_cast<size_t>(i)]);
    std::ofstream output(argument[2], std::ios::binary);
    output.write(reinterpret_cast<const char *>(values.data()),
                 static_cast<std::streamsize>(values.size() * sizeof values[0]));
    return output ? 0 : 1;
}
