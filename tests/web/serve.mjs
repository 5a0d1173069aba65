// SPDX-License-Identifier: MIT
// serve.mjs - serves a folder to a browser, as modules and workers need it.
import { createServer } from 'node:http';
import { readFile, writeFile } from 'node:fs/promises';
import { basename, extname, normalize } from 'node:path';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.json': 'application/json', '.wasm': 'application/wasm' };

// Returns the address of FOLDER. What a page sends (PUT) is written into it, and its name is given to `received`.
export async function serve(folder, received = () => {}) {
    const server = createServer(async (request, response) => {
        const path = normalize(new URL(request.url, 'http://localhost').pathname);
        if (request.method === 'PUT') {
            await writeFile(`${folder}/${basename(path)}`, request);
            response.end();
            received(basename(path));
            return;
        }
        try {
            const content = await readFile(folder + (path === '/' ? '/index.html' : path));
            response.setHeader('Content-Type', types[extname(path)] ?? 'text/html');
            response.end(content);
        } catch {
            response.statusCode = path === '/favicon.ico' ? 204 : 404;
            response.end();
        }
    });
    await new Promise((listening) => { server.listen(0, '127.0.0.1', listening); });
    server.unref();
    return `http://127.0.0.1:${server.address().port}`;
}
