// SPDX-License-Identifier: MIT
// exr.mjs FLOATS WIDTH HEIGHT IMAGE: writes an OpenEXR image of floats as WebGL reads them, RGBA in rows from below.
import { readFileSync, writeFileSync } from 'node:fs';

const [from, widthText, heightText, to] = process.argv.slice(2), width = Number(widthText), height = Number(heightText);
const bytes = readFileSync(from), floats = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
if (floats.length !== 4 * width * height)
    throw new Error(`${from} has ${floats.length} numbers, not ${width} x ${height} x 4`);

const int = (value) => Buffer.from(Int32Array.of(value).buffer), float = (value) => Buffer.from(Float32Array.of(value).buffer);
const text = (value) => Buffer.from(`${value}\0`, 'latin1');
const attribute = (name, type, ...parts) => {
    const value = Buffer.concat(parts);
    return Buffer.concat([text(name), text(type), int(value.length), value]);
};
const FLOAT = 2, box = [0, 0, width - 1, height - 1].map(int);
const header = Buffer.concat([
    int(20000630), int(2),
    attribute('channels', 'chlist', ...['B', 'G', 'R'].map((name) => Buffer.concat([text(name), int(FLOAT), int(0), int(1), int(1)])), Buffer.alloc(1)),
    attribute('compression', 'compression', Buffer.alloc(1)),
    attribute('dataWindow', 'box2i', ...box), attribute('displayWindow', 'box2i', ...box),
    attribute('lineOrder', 'lineOrder', Buffer.alloc(1)), attribute('pixelAspectRatio', 'float', float(1)),
    attribute('screenWindowCenter', 'v2f', float(0), float(0)), attribute('screenWindowWidth', 'float', float(1)),
    Buffer.alloc(1),
]);
const rows = Array.from({ length: height }, (none, y) => {
    const row = 4 * width * (height - 1 - y), values = new Float32Array(3 * width);
    for (let c = 0; c < 3; c++)
        for (let x = 0; x < width; x++)
            values[c * width + x] = floats[row + 4 * x + 2 - c];
    return Buffer.concat([int(y), int(12 * width), Buffer.from(values.buffer)]);
});
const begin = header.length + 8 * height;
const offsets = BigUint64Array.from(rows, (row, y) => BigInt(begin + y * row.length));
writeFileSync(to, Buffer.concat([header, Buffer.from(offsets.buffer), ...rows]));
