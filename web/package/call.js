// SPDX-License-Identifier: MIT
// call.js - passes JavaScript's arguments to C's functions as api.js describes them, checked, and what C returns back.
//
// Arguments live in C's memory while a call runs: numbers in arrays of that memory are passed as they are, all else is
// copied to a stack of its own (Stack) and, where C writes, back.
import { constants, enums, functions, structs } from './api.js';
import { conditions, explain, structConditions } from './conditions.js';
import { extents, memberExtents, spread } from './extents.js';
import { Blocks, LampionError, Stack } from './memory.js';
import { nullable, unbounded, wholes } from './rules.js';

export { LampionError };

const kinds = {
    i8: Int8Array, u8: Uint8Array, i16: Int16Array, u16: Uint16Array, i32: Int32Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array,
};
for (const name of Object.keys(enums))
    kinds[name] = Int32Array;
const limits = { i8: [-128, 127], u8: [0, 255], i16: [-32768, 32767], u16: [0, 65535], i32: [-(2 ** 31), 2 ** 31 - 1], u32: [0, 2 ** 32 - 1] };
// Functions of DataView.
const [getters, setters] = ['get', 'set'].map((verb) => Object.fromEntries(Object.entries(kinds).map(([type, { name }]) => [type, verb + name.replace('Array', '')])));
const memberNames = Object.fromEntries(Object.entries(structs).map(([type, { members }]) => [type, new Set(members.map(([name]) => name))]));
const plainFloats = (name) => structs[name]?.members.every(([, type]) => type === 'f32');
const arrays = new Set(['vec3_array', 'float_array', 'rgb_array', 'sh_array']);

// An object of C's, until its destroy function.
export class Handle {
    constructor(caller, kind, pointer, destroy) {
        Object.assign(this, { kind, pointer });
        Object.defineProperty(this, 'caller', { value: caller });
        if (destroy && Symbol.dispose)
            this[Symbol.dispose] = () => this.pointer && destroy(this);
    }
}

// Checks a number that is passed by value or within a struct: what is not a float has the range of its type.
function checkNumber(type, value, name, range) {
    const names = enums[type], own = limits[type];
    if (typeof value !== 'number')
        throw new TypeError(names ? `${name} is ${JSON.stringify(value)}, not a constant such as ${names[0]}` : `${name} is not a number`);
    if (names && !(Number.isInteger(value) && value >= 0 && value < names.length))
        throw new RangeError(`${name} is ${value}, none of ${names.join(', ')}`);
    if (own && !(Number.isInteger(value) && value >= own[0] && value <= own[1]))
        throw new RangeError(`${name} is ${value}, not ${own[0] ? 'an integer' : 'a count'}`);
    if (own && range && value && !(value >= range[0] && value <= range[1]))
        throw new RangeError(`${name} is ${value}, not ${range[0]} to ${range[1]}`);
}

export class Caller {
    constructor(c, memory) {
        Object.assign(this, { c, memory, buffer: memory.buffer, stack: new Stack(c), blocks: new Blocks(), bytes: new Uint8Array(memory.buffer), view: new DataView(memory.buffer) });
        this.text = new TextDecoder();
        this.scratch = c.malloc(constants.SCRATCH_SIZE + constants.SCRATCH_ALIGNMENT);
        this.scratchAt = Math.ceil(this.scratch / constants.SCRATCH_ALIGNMENT) * constants.SCRATCH_ALIGNMENT;
        if (!this.stack.begin || !this.scratch)
            throw new LampionError(constants.ERROR_MEMORY, 'load() was given too little memory');
        this.api = {};
        for (const [name, description] of Object.entries(functions))
            this.api[name] = this.bind(name, description);
    }

    string(at) {
        return at ? this.text.decode(this.bytes.subarray(at, this.bytes.indexOf(0, at))) : null;
    }

    size(type) {
        return type.of ? type.count * this.size(type.of) : type.to ? 4 : kinds[type]?.BYTES_PER_ELEMENT ?? (type === 'bool' ? 1 : structs[type].size);
    }

    // --- reading ---------------------------------------------------------------------------------

    read(type, at, context = {}) {
        const { view } = this;
        if (type === 'bool')
            return view.getUint8(at) !== 0;
        if (kinds[type])
            return view[getters[type]](at, true);
        if (type.of)
            return Array.from({ length: type.count }, (none, i) => this.read(type.of, at + i * this.size(type.of)));
        if (type.to) {
            const pointer = view.getUint32(at, true), { count, owner } = context;
            return type.to === 'char' ? this.string(pointer) : pointer && count !== undefined ? this.list(type.to, pointer, count, owner) : null;
        }
        const value = {};
        for (const [name, member, offset] of structs[type].members)
            value[name] = member.to ? null : this.read(member, at + offset);
        for (const [name, member, offset] of structs[type].members.filter(([, member]) => member.to)) // their lengths are known now
            value[name] = this.read(member, at + offset, { count: memberExtents[type]?.[name]?.(value), owner: context.owner });
        return value;
    }

    // Numbers as a view of C's memory, which lasts as long as their owner, structs as copies.
    list(type, pointer, count, owner) {
        if (kinds[type]) {
            this.blocks.add(pointer, count * kinds[type].BYTES_PER_ELEMENT, owner);
            return new kinds[type](this.buffer, pointer, count);
        }
        return Array.from({ length: count }, (none, i) => this.read(type, pointer + i * this.size(type)));
    }

    // --- writing ---------------------------------------------------------------------------------

    write(type, at, value, name, context, range) {
        const { view } = this;
        if (type === 'bool')
            return view.setUint8(at, value ? 1 : 0);
        if (kinds[type]) {
            checkNumber(type, value, name, range);
            return view[setters[type]](at, value, true);
        }
        if (type.of) {
            if (typeof value === 'string' || value?.length === undefined || value.length > type.count)
                throw new TypeError(`${name} is not an array of at most ${type.count}`);
            for (let i = 0; i < value.length; i++)
                this.write(type.of, at + i * this.size(type.of), value[i], `${name}[${i}]`, context, range);
            return undefined;
        }
        if (type.to)
            return view.setUint32(at, value === null ? 0 : this.pointer(type, value, name, context), true);
        return this.writeStruct(type, at, value, name, context);
    }

    // whole: whether members that are not given are zero, so that conditions on several can be checked.
    writeStruct(type, at, value, name, extent, whole = true) {
        if (arrays.has(type))
            return this.writeArray(type, at, value, name, extent);
        if (value === null || typeof value !== 'object')
            throw new TypeError(`${name} is ${typeof value === 'string' ? JSON.stringify(value) : String(value)}, not an object${plainFloats(type) ? ` or ${structs[type].members.length} numbers` : ''}`);
        const { members } = structs[type];
        if (typeof value.length === 'number' && plainFloats(type)) { // [x, y, z]
            if (value.length !== members.length)
                throw new TypeError(`${name} has ${value.length} numbers, not ${members.length}`);
            return members.forEach(([one, member, offset], i) => this.write(member, at + offset, value[i], `${name}[${i}]`));
        }
        for (const key of Object.keys(value)) {
            if (!memberNames[type].has(key) && !/^(is[A-Z]|_)/.test(key)) // such as isColor of three's colors
                throw new TypeError(`${name}.${key} is not a member of lmp_${type}`);
            if (value[key] === undefined)
                throw new TypeError(`${name}.${key} is undefined`);
        }
        const fault = whole && structConditions[type]?.(value);
        if (fault)
            throw new RangeError(`${name}.${fault}`);
        const all = memberExtents[type] && Object.fromEntries(members.map(([one]) => [one, value[one] ?? 0]));
        for (const [one, member, offset, range] of members) {
            const needed = memberExtents[type]?.[one]?.(all, extent);
            if (arrays.has(member) && needed && !value[one] && !nullable.has(`${type}.${one}`))
                throw new TypeError(`${name}.${one} is missing`);
            if (value[one] !== undefined)
                this.write(member, at + offset, value[one], `${name}.${one}`, needed, range);
        }
    }

    // An array of vectors, numbers, colors or coefficients: itself, or with strides.
    writeArray(type, at, value, name, extent) {
        const { view } = this, width = type === 'float_array' ? 1 : 3;
        const [values, count] = Array.isArray(extent) ? extent : [width, extent];
        const list = value instanceof Float32Array || Array.isArray(value), stride = list ? undefined : value?.stride;
        if (!value) {
            if (Array.isArray(extent) ? extent[1] : extent)
                throw new TypeError(`${name} is missing`);
            return;
        }
        if (stride !== undefined && !(Number.isInteger(stride) && stride >= 0 && stride % 4 === 0))
            throw new RangeError(`${name}.stride is not a multiple of 4`);
        if (type === 'vec3_array' && !list) {
            const needed = count && (stride ?? 4) / 4 * (count - 1) + 1;
            ['x', 'y', 'z'].forEach((axis, i) => view.setUint32(at + 4 * i, this.numbers('f32', value?.[axis], `${name}.${axis}`, needed, true), true));
            view.setUint32(at + 12, stride ?? 4, true);
            return;
        }
        const given = list ? { at: value } : value;
        const zero = type === 'float_array' && stride === 0; // the same for all
        const needed = zero ? Math.min(count, 1) : spread(values, count, given);
        const pointer = this.numbers('f32', given?.at, given === value ? `${name}.at` : name, needed, type === 'float_array' || type === 'vec3_array');
        if (type === 'vec3_array') {
            for (let i = 0; i < 3; i++)
                view.setUint32(at + 4 * i, pointer + 4 * i, true);
            view.setUint32(at + 12, 12, true);
            return;
        }
        view.setUint32(at, pointer, true);
        view.setUint32(at + 4, stride ?? (type === 'float_array' ? 4 : 0), true);
        if (type === 'sh_array')
            this.write('sh_layout', at + 8, given.layout ?? 0, `${name}.layout`);
    }

    // Numbers of JavaScript's or C's memory, as a pointer of C's.
    numbers(type, value, name, needed = 0, constant = false) {
        const Kind = kinds[type];
        if (constant && Array.isArray(value)) {
            const wrong = value.findIndex((one) => typeof one !== 'number');
            if (wrong >= 0)
                throw new TypeError(`${name}[${wrong}] is not a number`);
            value = Kind.from(value);
        }
        if (!(value instanceof Kind))
            throw new TypeError(`${name} is not ${type[0] === 'f' ? 'a' : 'an'} ${Kind.name}`);
        if (value.length < needed)
            throw new RangeError(`${name} has ${value.length} values, and ${needed} are needed`);
        if (value.buffer === this.buffer) {
            this.blocks.check(value, name);
            return value.byteOffset;
        }
        const at = this.stack.take(value.byteLength);
        const copy = new Kind(this.buffer, at, value.length);
        copy.set(value);
        if (!constant)
            this.after.push(() => value.set(copy));
        return at;
    }

    own({ caller }, name) {
        if (caller !== this)
            throw new TypeError(`${name} belongs to another instance, of another load()`);
    }

    enough(length, needed, name) {
        if (length < needed)
            throw new RangeError(`${name} has ${length} elements, and ${needed} are needed`);
    }

    pointer(type, value, name, extent) {
        const { to, constant } = type;
        if (value instanceof Structs) {
            if (value.type !== to)
                throw new TypeError(`${name} holds lmp_${value.type}, not lmp_${to}`);
            this.own(value, name);
            value.live(`${name} was freed`);
            this.enough(value.length, extent, name);
            return value.pointer;
        }
        if (to === 'void') {
            if (!ArrayBuffer.isView(value))
                throw new TypeError(`${name} is not an array of bytes`);
            return this.numbers('u8', new Uint8Array(value.buffer, value.byteOffset, value.byteLength), name, extent, constant);
        }
        if (to === 'char') {
            const bytes = new TextEncoder().encode(`${value}\0`);
            return this.numbers('u8', bytes, name, 0, true);
        }
        if (kinds[to])
            return this.numbers(to, value, name, extent, constant);
        if (to.to) { // pointers to objects
            this.enough(value.length, extent, name);
            const at = this.stack.take(4 * value.length);
            Array.from(value, (one, i) => this.view.setUint32(at + 4 * i, this.pointer(to, one, `${name}[${i}]`), true));
            return at;
        }
        if (!structs[to]) {
            if (!(value instanceof Handle) || value.kind !== to)
                throw new TypeError(`${name} is not an lmp_${to}`);
            if (!value.pointer)
                throw new TypeError(`${name} was destroyed`);
            this.own(value, name);
            return value.pointer;
        }
        if (value instanceof Float32Array && plainFloats(to))
            return this.numbers('f32', value, name, structs[to].size / 4 * extent, constant);
        const list = Array.isArray(value) && (typeof value[0] !== 'number' || !plainFloats(to)) ? value : [value];
        if (!wholes.has(to))
            this.enough(list.length, extent, name);
        const { size } = structs[to], at = this.stack.take(size * list.length);
        this.bytes.fill(0, at, at + size * list.length);
        for (let i = 0; i < list.length; i++)
            this.writeStruct(to, at + i * size, list[i], list === value ? `${name}[${i}]` : name, extent);
        return at;
    }

    // --- calls -----------------------------------------------------------------------------------

    // Returns lmp_NAME as a function of JavaScript's: without the host, the scratch and the error, which are filled in
    // here, and without what is only written at the end, which it returns.
    bind(name, { result, parameters, bands }) {
        const f = this.c[`lmp_${name}`];
        const given = parameters.filter(([, , how]) => how === 'given').map(([parameter]) => parameter);
        const destroys = name.endsWith('_destroy');
        const extentOf = (parameter) => extents[`${name}.${parameter}`] ?? extents[parameter];
        return (...values) => {
            if (values.length !== given.length)
                throw new TypeError(`${name} takes ${given.length} arguments, not ${values.length}`);
            if (destroys && values[0]?.borrowed)
                throw new TypeError(`${name}: ${given[0]} belongs to another object`);
            const args = Object.fromEntries(values.map((value, i) => [given[i], value]));
            const before = this.after;
            this.after = [];
            try {
                return this.stack.within(() => {
                    const passed = [], written = [];
                    let error = 0, returned = 0;
                    if (structs[result])
                        passed.push(returned = this.stack.take(structs[result].size));
                    for (const [parameter, type, how] of parameters) {
                        if (how === 'hidden') {
                            if (type.to === 'parse_error')
                                error = this.stack.take(structs.parse_error.size);
                            passed.push(type.to === 'host' ? 0 : type.to === 'scratch' ? this.lendScratch() : error);
                        } else if (how === 'out') {
                            const at = this.stack.take(this.size(type.to));
                            this.bytes.fill(0, at, at + this.size(type.to));
                            written.push([type.to, at]);
                            passed.push(at);
                        } else {
                            passed.push(this.pass(name, parameter, type, args, destroys, extentOf(parameter), parameter === 'bands' ? bands : undefined));
                        }
                    }
                    const fault = conditions[name]?.(args, this.api);
                    if (fault)
                        throw new RangeError(`${name}: ${fault}`);
                    const value = f(...passed);
                    this.after.forEach((copy) => copy());
                    if (result === 'status' && value)
                        throw new LampionError(value, `${name}: ${this.reason(name, value, error, args)}`);
                    if (destroys && values[0]) {
                        values[0].pointer = 0;
                        this.blocks.removeOf(values[0]);
                    }
                    const made = written.map(([type, at]) => type.to ? this.handle(type.to, this.view.getUint32(at, true), args) : this.read(type, at));
                    if (made.length)
                        return result === 'bool' && !value ? null : made.length === 1 ? made[0] : made;
                    return this.give(name, result, value, returned, args);
                });
            } finally {
                this.after = before;
            }
        };
    }

    // Returns why a function failed.
    reason(name, status, error, args) {
        if (error)
            return this.string(error + structs.parse_error.members.find(([member]) => member === 'text')[2]);
        return (status === constants.ERROR_ARGUMENT && explain(name, args)) || this.string(this.c.lmp_result_text(status));
    }

    lendScratch() {
        const at = this.stack.take(8);
        this.view.setUint32(at, this.scratchAt, true);
        this.view.setUint32(at + 4, constants.SCRATCH_SIZE, true);
        return at;
    }

    pass(name, parameter, type, args, destroys, extent, bands) {
        const value = args[parameter];
        if (kinds[type]) {
            checkNumber(unbounded.has(`${name}.${parameter}`) ? 'i32' : type, value, `${name}: ${parameter}`);
            if (bands && !(value >= bands[0] && value <= bands[1]))
                throw new RangeError(`${name}: bands is ${value}, not ${bands[0]} to ${bands[1]}`);
            return value;
        }
        const words = `${name}: ${parameter}`, needed = extent?.(args, this.api);
        if (type.to) {
            if (value === null && (destroys || needed === 0 || nullable.has(parameter) || nullable.has(`${name}.${parameter}`)))
                return 0;
            if (value === null || value === undefined)
                throw new TypeError(`${words} is missing`);
            return this.pointer(type, value, words, needed);
        }
        const at = this.stack.take(structs[type].size);
        this.bytes.fill(0, at, at + structs[type].size);
        this.writeStruct(type, at, value, words, needed);
        return at;
    }

    handle(kind, pointer, { bands } = {}) {
        const handle = new Handle(this, kind, pointer, this.api[`${kind}_destroy`]);
        return bands === undefined ? handle : Object.assign(handle, { bands });
    }

    give(name, result, value, returned, args) {
        if (result === 'void' || result === 'status')
            return undefined;
        if (structs[result])
            return this.read(result, returned, { owner: Object.values(args)[0] });
        if (!result.to)
            return result === 'bool' ? value !== 0 : result === 'u32' ? value >>> 0 : value;
        if (result.to === 'char')
            return this.string(value);
        if (!value)
            return null;
        const count = extents[`${name}.result`]?.(args, this.api);
        if (count !== undefined)
            return this.list(result.to, value, count, Object.values(args)[0]);
        return structs[result.to] ? this.read(result.to, value) : Object.assign(new Handle(this, result.to, value), { borrowed: true });
    }
}

// Structs side by side in C's memory, for what is changed every frame: passed without copies.
export class Structs {
    constructor(caller, type, length) {
        const { size } = structs[type];
        const pointer = caller.c.malloc(size * length || 1);
        if (!pointer)
            throw new LampionError(constants.ERROR_MEMORY, `${length} structs lmp_${type} do not fit into the memory that load() was given`);
        caller.bytes.fill(0, pointer, pointer + size * length);
        caller.blocks.add(pointer, size * length);
        Object.assign(this, { caller, type, length, pointer, size });
    }
    live(fault = 'these structs were freed') {
        if (!this.pointer)
            throw new TypeError(fault);
    }
    check(i) {
        this.live();
        if (!(Number.isInteger(i) && i >= 0 && i < this.length))
            throw new RangeError(`there is no element ${i} of ${this.length}`);
        return this.pointer + i * this.size;
    }
    get(i) {
        return this.caller.read(this.type, this.check(i));
    }
    // Returns one member of an element.
    memberAt(i, member) {
        const [, type, offset] = structs[this.type].members.find(([name]) => name === member);
        return this.caller.read(type, this.check(i) + offset);
    }
    // Sets the members given; the others stay as they are.
    set(i, value) {
        this.caller.writeStruct(this.type, this.check(i), value, `[${i}]`, undefined, false);
    }
    // Where a member of the first element is, in numbers, and the bytes from one element to the next.
    array(member) {
        this.live();
        const found = structs[this.type].members.find(([name]) => name === member);
        if (!found)
            throw new TypeError(`${member} is not a member of lmp_${this.type}`);
        const [, type, offset] = found, { buffer } = this.caller, end = this.pointer + this.size * this.length;
        const from = (skip) => new Float32Array(buffer, this.pointer + offset + skip, (end - this.pointer - offset - skip) / 4 | 0);
        if (type !== 'f32' && structs[type]?.size !== 12)
            throw new TypeError(`${member} is neither a float nor a vector`);
        return type === 'f32' ? { at: from(0), stride: this.size } : { x: from(0), y: from(4), z: from(8), stride: this.size };
    }
    free() {
        this.live();
        this.caller.blocks.remove(this.pointer, this.size * this.length);
        this.caller.c.free(this.pointer);
        this.pointer = this.length = 0;
    }
}
