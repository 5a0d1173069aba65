// SPDX-License-Identifier: MIT
// memory.js - which parts of an instance's memory are in use: a stack for the arguments of calls, and the blocks that
// JavaScript has views of.
import { constants } from './api.js';

export class LampionError extends Error {
    constructor(code, text) {
        super(text);
        this.name = 'LampionError';
        this.code = code;
    }
}

// Memory of C's for the arguments of a call, which may be made within another.
export class Stack {
    constructor(c, size = 1 << 16) {
        Object.assign(this, { c, begin: c.malloc(size), top: 0, size, large: [] });
    }
    take(bytes) {
        const at = this.begin + this.top;
        if (this.top + bytes <= this.size) {
            this.top += (bytes + 15) & ~15;
            return at;
        }
        const memory = this.c.malloc(bytes);
        if (!memory)
            throw new LampionError(constants.ERROR_MEMORY, `${bytes} bytes do not fit into the memory that load() was given`);
        this.large.push(memory);
        return memory;
    }
    // Runs a function, and gives back all memory that it took. C's own stack is put back too, because an exception leaves
    // a function of C without its end.
    within(run) {
        const { c, top, large } = this, mine = [], pointer = c.stackSave();
        this.large = mine;
        try {
            return run();
        } finally {
            c.stackRestore(pointer);
            mine.forEach((memory) => c.free(memory));
            Object.assign(this, { top, large });
        }
    }
}

// The blocks that views of the memory may lie in, sorted by where they begin. A block has an owner: `this` for what
// free() gives back, otherwise the object whose end is that of the block.
export class Blocks {
    blocks = [];
    // The index behind the last block that begins at `at` or before it.
    behind(at) {
        const { blocks } = this;
        let low = 0, high = blocks.length;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (blocks[middle].begin <= at)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }
    add(begin, bytes, owner = this) {
        const i = this.behind(begin), known = this.blocks[i - 1]?.begin === begin; // lent before
        this.blocks.splice(known ? i - 1 : i, known ? 1 : 0, { begin, bytes, owner });
    }
    check({ byteOffset, byteLength }, name) {
        const block = this.blocks[this.behind(byteOffset) - 1];
        if (byteLength && !(block && byteOffset + byteLength <= block.begin + block.bytes))
            throw new TypeError(`${name} was freed`);
    }
    // Forgets the block that is exactly this array or these structs; returns whether there was one.
    remove(begin, bytes, owner = this) {
        const i = this.behind(begin) - 1, block = this.blocks[i];
        const found = block?.begin === begin && block.bytes === bytes && block.owner === owner;
        if (found)
            this.blocks.splice(i, 1);
        return found;
    }
    // Forgets what an object lent.
    removeOf(owner) {
        this.blocks = this.blocks.filter((block) => block.owner !== owner);
    }
}
