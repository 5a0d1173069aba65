// SPDX-License-Identifier: MIT
// lampion.js - the shaders in WGSL as one text for any number of bands: an ES module that needs nothing.

const windows = { none: 0, hanning: 1, lanczos: 2 };

// Writes the loops over bands out, so that a band is a constant, and an array's index with it.
function unrolled(text, bands, known = {}) {
    const loop = /for \(var ([lm]): i32 = (\w+); \1 < LMP_BANDS; \1\+\+\) \{/.exec(text);
    if (!loop)
        return text;
    const [head, name, first] = loop, begin = loop.index + head.length;
    let end = begin;
    for (let depth = 1; depth > 0; end++)
        depth += text[end] === '{' ? 1 : text[end] === '}' ? -1 : 0;
    const body = text.slice(begin, end - 1);
    let steps = '';
    for (let i = Number(known[first] ?? first); i < bands; i++)
        steps += `{ const ${name} = ${i};${unrolled(body, bands, { ...known, [name]: i })}}\n`;
    return text.slice(0, loop.index) + steps + unrolled(text.slice(end), bands, known);
}

// Returns the functions of Lampion for a shader module, to be joined with yours.
//   bands          1 … 32
//   window         'none', 'hanning' or 'lanczos'; windowSize is the band whose weight falls to 0
//   ggx            true: glTF's material as well, and lobes are its; you define lmp_ggx_texel
//   spheres        false: lights are of any kind, and you define lmp_light_fixed, _color and _lit
//   areas          true: you define lmp_area_count and lmp_area_texel
//   coefficients, coat, probe   true: the files of these names
//   preintegrated  'lobe', or 'brdf' for both
//   loops          true: keep the loops over bands, which are short to compile and slower to run
export function lampionWgsl({ bands, window = 'none', windowSize = bands, ggx = false, spheres = true, areas = false,
    coefficients = false, coat = false, probe = false, preintegrated = '', loops = false }) {
    if (!Number.isInteger(bands) || bands < 1 || bands > 32)
        throw new RangeError('bands are an integer, 1 to 32');
    if (!(window in windows))
        throw new RangeError(`window is one of ${Object.keys(windows).join(', ')}`);
    const files = { ggx, lampion: true, spheres, coat, coefficients, area: areas, no_areas: !areas, probe,
        preintegrated_lookup: preintegrated, preintegrated_lobe: preintegrated, preintegrated_brdf: preintegrated === 'brdf' };
    const constants = `const LMP_BANDS = ${bands};\nconst LMP_WINDOW = ${windows[window]};\nconst LMP_WINDOW_SIZE = ${windowSize};\n`;
    const text = Object.keys(files).filter((name) => files[name]).map((name) => texts[`${ggx ? 'ggx' : 'phong'}/${name}`]).join('\n');
    return constants + (loops ? text : unrolled(text, bands));
}

