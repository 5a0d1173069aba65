// SPDX-License-Identifier: MIT
// options.js - what is said of wrong options and objects, by load() and for every engine.

// Returns options, of which there are no others than those named.
export function optionsOf(owner, given, names) {
    if (given === null || typeof given !== 'object')
        throw new TypeError(`${owner} takes options, such as { ${names[0]} }, not ${given}`);
    for (const option of Object.keys(given))
        if (!names.includes(option))
            throw new TypeError(`${owner}: there is no option ${option}, only ${names.join(', ')}`);
    return given;
}

// Names an object of an engine's, even if its user did not.
export const titleOf = (object) => object === null || typeof object !== 'object' ? String(object)
    : `${object.type ?? object.getClassName?.() ?? object.constructor?.name} ${object.name ? `"${object.name}"` : object.uuid ?? object.uniqueId ?? object.id ?? ''}`.trim();

// Says a value so that a string cannot be taken for a number.
export const said = (value) => typeof value === 'string' ? JSON.stringify(value) : String(value);
