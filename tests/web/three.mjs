// SPDX-License-Identifier: MIT
// three.mjs FOLDER PAGE CHROMIUM: opens FOLDER/PAGE in headless Chromium without a GPU,
// and writes what the page sends into FOLDER, until it has sent three.exr.
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { readFile, writeFile } from 'node:fs/promises';
import { basename, extname, normalize } from 'node:path';

const [folder, page, program] = process.argv.slice(2);
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm' };
let browser, log = '';

function end(status) {
    browser.kill('SIGKILL');
    process.exit(status);
}

async function receive(name, request, response) {
    const parts = [];
    for await (const part of request)
        parts.push(part);
    await writeFile(`${folder}/${basename(name)}`, Buffer.concat(parts));
    response.end();
    if (name.endsWith('.exr'))
        end(0);
}

async function serve(request, response) {
    const path = normalize(new URL(request.url, 'http://localhost').pathname);
    if (request.method === 'PUT')
        return receive(path, request, response);
    try {
        const file = path === '/' ? '/index.html' : path;
        const content = await readFile(folder + file);
        response.setHeader('Content-Type', types[extname(file)] ?? 'application/octet-stream');
        response.end(content);
    } catch {
        response.statusCode = 404;
        response.end();
    }
}

const server = createServer(serve).listen(0, '127.0.0.1', () => {
    const options = ['--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-logging=stderr', `--user-data-dir=${folder}/profile`];
    browser = spawn(program, [...options, `http://127.0.0.1:${server.address().port}/${page}`]);
    browser.stderr.on('data', (text) => log += text);
    browser.on('exit', () => end(1));
});
setTimeout(() => {
    console.log(`the page sent no image in 3 minutes\n${log.split('\n').filter((line) => /CONSOLE/.test(line)).join('\n')}`);
    end(1);
}, 180000);
