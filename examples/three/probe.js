// SPDX-License-Identifier: MIT
// probe.js X Y Z: what `lampion project` says of lights.json at a point, summed: three planes of 9
// coefficients, which main.js reads as probe.json. The program is LAMPION, or that of the path.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';

const point = process.argv.slice(2, 5).map(Number);
const { lights } = JSON.parse(readFileSync('lights.json', 'utf8'));
const rows = lights.map(({ position, radius }) => [...position, radius, ...point].join());
const table = ['light_x,light_y,light_z,radius,recv_x,recv_y,recv_z', ...rows].join('\n');
const output = execFileSync(process.env.LAMPION ?? 'lampion', ['project', '--batch', '-', '--bands', '3'],
    { input: `${table}\n`, encoding: 'utf8' });
const coefficients = output.trim().split('\n').slice(1).map((row) => row.split(',').map(Number));
const planes = [0, 1, 2].map((channel) => Array.from({ length: 9 }, (_, i) =>
    lights.reduce((sum, light, k) => sum + light.radiance[channel] * coefficients[k][i], 0)));
writeFileSync('probe.json', JSON.stringify(planes));
