// SPDX-License-Identifier: MIT
// generate.mjs INCLUDE OUT: reads clang's tree of the public headers, as JSON, from standard input and the headers'
// constants from the folder INCLUDE, and writes OUT/api.js, by which call.js passes arguments, its types, OUT/api.d.ts, and the
// symbols to export, OUT/exports.txt.
//
// Layouts are those of wasm32: every member is aligned to its size, pointers and size_t have 4 bytes.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { nullable, wholes } from './rules.js';

const [include, out] = process.argv.slice(2);
const { inner: nodes } = JSON.parse(readFileSync(0));
const headers = readdirSync(include).sort().filter((name) => name.endsWith('.h')).map((name) => readFileSync(`${include}/${name}`, 'utf8'));
const plain = (name) => name.replace(/^(lmp_|LMP_)/, '');
const sizes = { bool: 1, i8: 1, u8: 1, i16: 2, u16: 2, i32: 4, u32: 4, f32: 4, f64: 8 };
const scalars = {
    _Bool: 'bool', bool: 'bool', 'signed char': 'i8', char: 'u8', uint8_t: 'u8', int16_t: 'i16', uint16_t: 'u16', int: 'i32', uint32_t: 'u32', 'unsigned int': 'u32',
    size_t: 'u32', float: 'f32', double: 'f64',
};
// What JavaScript passes by itself: the host's hooks, memory lent for a call, and where a reader reports an error.
const hidden = new Set(['host', 'scratch', 'parse_error']);
// Functions that need more than a table: callbacks (package.c), and bytes that C allocates.
const special = new Set(['sh_project_function', 'sh_project_function_rgb', 'brdf_encode_merl', 'brdf_encode_rgl']);

const records = {}, enums = {}, functions = [], constants = {}, comments = {};

function textOf(node) {
    const gather = ({ kind, text = '', name, inner = [] }) =>
        (kind === 'InlineCommandComment' ? `@${name}` : text) + inner.map(gather).join(kind === 'FullComment' ? '\n' : '');
    const comment = node.inner?.find(({ kind }) => kind === 'FullComment');
    return comment ? gather(comment).split('\n').map((line) => line.replace(/^ *\*? ?/, '').trimEnd()).join('\n').trim() : separated.get(node.name) ?? '';
}

// Comments that a macro separates from what they are of, where clang does not find them.
const separated = new Map(headers.flatMap((text) =>
    [...text.matchAll(/\/\*((?:(?!\*\/)[^])*)\*\/\n(?:#define.*\n)+(?:typedef struct |(?:LMP_EXPERIMENTAL )?LMP_API\s[^;(]*?)\b(lmp_\w+)(?= \{|\()/g)]
        .map(([, comment, name]) => [name, comment.split(/\n \*\n/).map((part) => part.replace(/(^|\n) \* */g, ' ').trim()).join('\n')])));

// Whether the constants of an enumeration are 0, 1, 2 …, as those of flags are not.
const isCounted = (name) => enums[name].every((one, i) => constants[one] === i);

// A type as call.js reads it: a scalar, the name of an enumeration or a struct, an array { of, count } or a pointer { to, constant }.
function typeOf(text) {
    text = text.replace(/^(struct|enum) /, '').trim();
    const array = text.match(/^(.*?) ?\[(\d+)\](.*)$/);
    if (array)
        return { of: typeOf(array[1] + array[3]), count: Number(array[2]) };
    const pointer = text.match(/^(.*?) ?\*(const)?$/);
    if (pointer) {
        const to = pointer[1].replace(/^const /, '').replace(/^(.*\*) ?const$/, '$1');
        return { to: to === 'void' ? 'void' : to === 'char' ? 'char' : typeOf(to), constant: /^const /.test(pointer[1]) || pointer[2] === 'const' };
    }
    text = text.replace(/^const /, '');
    if (scalars[text])
        return scalars[text];
    if (text.startsWith('lmp_'))
        return enums[plain(text)] && !isCounted(plain(text)) ? 'i32' : plain(text);
    throw new Error(`unknown type ${text}`);
}

const alignment = (type) => type.of ? alignment(type.of) : type.to ? 4 : sizes[type] ?? records[type].alignment;
const sizeOf = (type) => type.of ? type.count * sizeOf(type.of) : type.to ? 4 : sizes[type] ?? records[type].size;

// Lays out the members of a struct or union from `begin` on; members of anonymous unions join those of the struct.
function layOut(record, begin, members) {
    let at = begin, end = begin, most = 1;
    const inner = record.inner ?? [];
    for (const [i, field] of inner.entries()) {
        if (field.kind === 'RecordDecl' && inner[i + 1]?.kind === 'FieldDecl' && !inner[i + 1].name) {
            const probe = layOut(field, 0, []);
            at = Math.ceil(at / probe.alignment) * probe.alignment;
            const done = layOut(field, at, members);
            most = Math.max(most, done.alignment);
            at = done.end;
        } else if (field.kind === 'FieldDecl' && field.name) {
            const type = field.type.qualType.includes('(*)') ? { to: 'void' } : typeOf(field.type.qualType);
            const align = alignment(type);
            most = Math.max(most, align);
            at = Math.ceil(at / align) * align;
            members.push({ name: field.name, type, at, comment: textOf(field) });
            at += sizeOf(type);
        } else {
            continue;
        }
        end = Math.max(end, at);
        if (record.tagUsed === 'union')
            at = begin;
    }
    return { end: Math.ceil((end - begin) / most) * most + begin, alignment: most };
}

for (const node of nodes) {
    if (!node.name?.startsWith('lmp_') && node.kind !== 'EnumDecl')
        continue;
    if (node.kind === 'EnumDecl' && node.name?.startsWith('lmp_')) {
        const names = enums[plain(node.name)] = [];
        sizes[plain(node.name)] = 4;
        let value = 0;
        for (const one of node.inner.filter(({ kind }) => kind === 'EnumConstantDecl')) {
            const given = one.inner?.find(({ kind }) => kind === 'ConstantExpr')?.value;
            value = given === undefined ? value : Number(given);
            constants[plain(one.name)] = value++;
            comments[plain(one.name)] = textOf(one);
            names.push(plain(one.name));
        }
    } else if (node.kind === 'RecordDecl' && node.completeDefinition) {
        const members = [], { end, alignment: align } = layOut(node, 0, members);
        records[plain(node.name)] = { size: end, alignment: align, members, comment: textOf(node) };
    } else if (node.kind === 'FunctionDecl' && node.storageClass !== 'static') {
        functions.push(node);
    }
}

// Constants that are numbers, or products and sums of them.
const macros = headers.flatMap((text) => [...text.matchAll(/^#define LMP_([A-Z0-9_]+) +(\S.*?)(?: *\/\*.*)?$/gm)]);
for (const [, name, text] of macros) {
    const value = text.replace(/LMP_([A-Z0-9_]+)/g, (all, other) => constants[other]).replace(/UINT32_MAX/, '4294967295')
        .replace(/([0-9.])f\b/g, '$1');
    if (/^[-+*/0-9.e() ]+$/.test(value))
        constants[name] = Function(`return ${value}`)();
}

const opaque = (type) => typeof type === 'string' && !sizes[type] && !records[type] && type !== 'void' && type !== 'char';
const callable = functions.filter(({ name }) => !special.has(plain(name))).map((node) => {
    const parameters = (node.inner ?? []).filter(({ kind }) => kind === 'ParmVarDecl').map(({ name, type: { qualType } }) => {
        const type = typeOf(qualType);
        return { name, type, how: hidden.has(type.to) ? 'hidden' : 'given' };
    });
    // What is only written and comes last is returned: objects, and structs.
    for (const parameter of parameters.filter(({ how }) => how === 'given').reverse()) {
        const { to, constant } = parameter.type;
        if (!to || constant || !(to.to || records[to]))
            break;
        parameter.how = 'out';
    }
    const text = node.type.qualType.replace(/ ?\(.*/, '');
    const status = text === 'lmp_result' && node.name !== 'lmp_result_text';
    return { name: plain(node.name), parameters, result: status ? 'status' : text === 'void' ? 'void' : typeOf(text), comment: textOf(node) };
});

// --- what comments say in words ------------------------------------------------------------------

const numberOf = (text) => text === 'pi' ? Math.PI : constants[plain(text)] ?? Number(text);
const NUMBER = '(-?[0-9][0-9.e+-]*|LMP_[A-Z_]+|pi)';

// The range of a number or of each of an array, as [low, high, whether 0 stands for a default], by its comment.
function rangeOf(record, { name, type, comment }) {
    const found = comment.match(new RegExp(`${NUMBER} … ${NUMBER}`))?.slice(1).map(numberOf);
    return (type.of ?? type) !== 'bool' && found?.every(Number.isFinite) ? [...found, /_(desc|settings)$/.test(record) || comment.includes(`${name} = 0 means`)] : undefined;
}

// The bands that a function takes, where they are not those of all.
function bandsOf(text) {
    const [, low, high] = text.match(/([0-9]+) (?:…|to) (\w+) bands/) ?? text.match(/(?:at least(?= [0-9]+ bands)|bands must be at least) ([0-9]+)/) ?? [];
    return [numberOf(low ?? '1'), numberOf(high ?? 'LMP_BANDS_MAX')];
}

// What LMP_ERROR_ARGUMENT means, if a function's comment says it.
function faultOf({ comment }) {
    const other = comment.match(/LMP_ERROR_ARGUMENT as for lmp_(\w+)/)?.[1];
    const [, text] = comment.match(/LMP_ERROR_ARGUMENT: ([^;.\n]*)/) ?? [];
    return other ? faultOf(callable.find(({ name }) => name === other)) : text?.replace(/^([^(]*)\)[^]*/, '$1').trim();
}

const shown = Object.entries(records).filter(([name]) => !hidden.has(name));
const code = (value) => JSON.stringify(value).replace(/"([a-z_]+)":/g, '$1:').replaceAll('"', "'");
writeFileSync(`${out}/api.js`, `// Made from Lampion's headers by generate.mjs.
export const constants = {
${Object.entries(constants).map(([name, value]) => `    ${name}: ${value},`).join('\n')}
};
export const structs = {
${Object.entries(records).map(([name, { size, members }]) =>
        `    ${name}: { size: ${size}, members: ${code(members.map((member) => [member.name, member.type, member.at, rangeOf(name, member)].filter((one) => one !== undefined)))} },`).join('\n')}
};
export const enums = {
${Object.entries(enums).filter(([name]) => isCounted(name)).map(([name, names]) => `    ${name}: ${code(names)},`).join('\n')}
};
export const functions = {
${callable.map((one) => {
        const { name, result } = one, parameters = one.parameters.map(({ name: parameter, type, how }) => [parameter, type, how]);
        return `    ${name}: ${code({ result, parameters, bands: bandsOf(one.comment), fault: faultOf(one) })},`;
    }).join('\n')}
};
`);

// --- types ---------------------------------------------------------------------------------------

const title = (name) => name.replace(/(^|_)([a-z])/g, (all, before, letter) => letter.toUpperCase());
const numbers = { f32: 'Float32Array', f64: 'Float64Array', i16: 'Int16Array', u16: 'Uint16Array', u32: 'Uint32Array', i32: 'Int32Array', u8: 'Uint8Array', i8: 'Int8Array' };
const floats = (type) => records[type]?.members.every(({ type: one }) => one === 'f32');

// A struct that C returns has all of its members.
const returned = new Set();
function returnedType(name) {
    if (!returned.has(name)) {
        returned.add(name);
        records[name].members.forEach(({ type }) => scriptType(type, false));
    }
    return `${title(name)}Result`;
}

// Structs that describe arrays, which have types of their own below.
const arrays = { vec3_array: 'Vec3Array', float_array: 'FloatArray', sh_array: 'ShArray', rgb_array: 'RgbArray' };

// many: whether structs are counted by the next argument.
function scriptType(type, given, many = true) {
    if (type === 'bool')
        return 'boolean';
    if (sizes[type])
        return 'number';
    if (type.of)
        return numbers[type.of] ? (given ? 'ArrayLike<number>' : 'number[]') : scriptType(type.of, given).replace(/^.* \| .*$/, '($&)') + '[]';
    if (type.to) {
        if (type.to === 'char')
            return 'string';
        if (type.to === 'void')
            return given && type.constant ? 'ArrayBufferView' : 'Uint8Array';
        if (type.to.to)
            return `${title(type.to.to)}[]`;
        if (opaque(type.to))
            return title(type.to);
        if (numbers[type.to])
            return given && type.constant ? `${numbers[type.to]} | number[]` : numbers[type.to];
        if (!given)
            return `${returnedType(type.to)}[]`;
        const one = title(type.to), list = type.constant && many ? `${one} | readonly ${one}[] | Structs<${one}>` : one;
        return floats(type.to) ? `${list} | Float32Array` : list;
    }
    if (!given)
        return returnedType(type);
    if (type === 'vec3' || type === 'rgb' || type === 'quat')
        return `${title(type)} | ArrayLike<number>`;
    return arrays[type] ?? title(type);
}

const comment = (text, indent = '') =>
    text ? `${indent}/**\n${text.replaceAll('*/', '*').split('\n').map((line) => `${indent} * ${line}`.trimEnd()).join('\n')}\n${indent} */\n` : '';

// An object, or null; numbers, or a struct.
const resultType = (result) => result.to && opaque(result.to) ? `${title(result.to)} | null`
    : result.to && records[result.to] && result.to !== 'light' ? returnedType(result.to) : scriptType(result, false);

function signature({ name, parameters, result }) {
    const [given, outs] = ['given', 'out'].map((wanted) => parameters.filter(({ how }) => how === wanted));
    const kind = outs.map(({ type }) => type.to.to ? title(type.to.to) : returnedType(type.to));
    const what = outs.length === 1 ? kind[0] : outs.length ? `[${kind.join(', ')}]`
        : result === 'void' || result === 'status' ? 'void' : result.to === 'char' ? 'string | null' : resultType(result);
    const lists = given.map(({ name: one, type }, i) => {
        const many = /count$/.test(given[i + 1]?.name) && !wholes.has(type.to);
        const may = type.to && (nullable.has(one) || nullable.has(`${name}.${one}`) || one === 'lights');
        return `${one}: ${scriptType(type, true, many)}${may ? ' | null' : ''}`;
    });
    return `(${lists.join(', ')}): ${result === 'bool' && outs.length ? `${what} | null` : what}`;
}

const signatures = callable.map((one) => `${comment(one.comment, '    ')}    ${one.name}${signature(one)};`);
const declared = [...returned].map((name) => `export interface ${title(name)}Result {
${records[name].members.map(({ name: one, type }) => `    ${one}: ${scriptType(type, false)}${type.to && type.to !== 'char' ? ' | null' : ''};`).join('\n')}
}`);
const simple = new Set([...Object.keys(arrays), ...hidden]);
const handles = [...new Set(callable.flatMap(({ parameters }) => parameters.map(({ type }) => type.to?.to ?? type.to).filter(opaque)))];
const written = handles.map((name) => `export interface ${title(name)} { readonly kind: '${name}'; [Symbol.dispose](): void }`);
writeFileSync(`${out}/api.d.ts`, `// Made from Lampion's headers, whose comments these are. The documents, headers and sources that they name are in Lampion's
// source archive; the paper is P. Mézières and M. Paulin, Projection efficace de lumières sphériques sur les harmoniques
// sphériques, JFIG 2020.
import type { Structs } from './index.js';

declare global {
    interface SymbolConstructor { readonly dispose: unique symbol } // for compilers that lack it
}

/** Vectors side by side, or three arrays with the bytes from one element to the next; a stride of 0 repeats one. */
export type Vec3Array = Float32Array | number[] | { x: Float32Array, y: Float32Array, z: Float32Array, stride: number };
export type FloatArray = Float32Array | number[] | { at: Float32Array, stride: number };
export type RgbArray = Float32Array | { at: Float32Array, stride?: number };
/** Coefficients side by side, or with a stride in bytes and a layout: SH_INTERLEAVED or SH_PLANAR. */
export type ShArray = Float32Array | { at: Float32Array, stride?: number, layout?: number };

${written.join('\n')}

${shown.filter(([name]) => !simple.has(name)).map(([name, { members, comment: text }]) => `${comment(text)}export interface ${title(name)} {
${members.map(({ name: one, type, comment: why }) => `${comment(why, '    ')}    ${one}?: ${scriptType(type, true)}${type.to ? ' | null' : ''};`).join('\n')}
}`).join('\n\n')}

${declared.join('\n\n')}

/** Structs by name, for structs(). */
export interface StructTypes {
${shown.filter(([name]) => !simple.has(name)).map(([name]) => `    ${name}: ${title(name)};`).join('\n')}
}

export interface Constants {
${Object.keys(constants).map((name) => `${comment(comments[name], '    ')}    readonly ${name}: number;`).join('\n')}
}

export interface Functions {
${signatures.join('\n')}
}
`);

const symbols = [...functions.map(({ name }) => `_${name}`), '_malloc', '_free'];
writeFileSync(`${out}/exports.txt`, `${symbols.join('\n')}\n`);
