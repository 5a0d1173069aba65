// SPDX-License-Identifier: MIT
// rules.js - what the headers say in words alone, for the checks of call.js and the types of generate.mjs alike.

// What may be null: what C has a meaning for.
export const nullable = new Set(['visibility', 'settings', 'desc', 'red', 'green', 'blue', 'lighting', 'sh_eval_gradient_double.gradient',
    'surfaces.position', 'surfaces.tangent', 'surfaces.coat_normal', 'probe_samples.weights']);

// Structs that stand for many elements by arrays within them: the count beside them is that of these arrays.
export const wholes = new Set(['spheres', 'surfaces', 'transfer_lighting']);

// Constants that functions also take beyond the last one of their enumeration.
export const unbounded = new Set(['sh_window_name.window', 'result_text.result']);
