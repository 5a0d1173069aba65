// SPDX-License-Identifier: MIT
// browser.mjs - headless Chromium without a GPU, by its debugging protocol over a pipe: no package is needed. Where a
// shader compiles for 10 s on a busy machine, a watchdog would end the GPU's process, and the browser with it.
import { spawn } from 'node:child_process';
import { rm } from 'node:fs/promises';

// more: options of the browser beside these.
export async function openBrowser(profile, more = []) {
    const options = ['--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
        '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--disable-gpu-watchdog',
        '--disable-dev-shm-usage', '--hide-scrollbars', '--force-color-profile=srgb', '--remote-debugging-pipe', `--user-data-dir=${profile}`, ...more];
    const browser = spawn('chromium', [...options, 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    const waiting = new Map(), listeners = [], [, , , to, from] = browser.stdio;
    let number = 0, rest = '';
    from.setEncoding('utf8').on('data', (data) => {
        const messages = (rest + data).split('\0');
        rest = messages.pop();
        for (const message of messages.map((one) => JSON.parse(one))) {
            const { resolve, reject } = waiting.get(message.id) ?? {};
            waiting.delete(message.id);
            if (message.error)
                reject(new Error(message.error.message));
            else if (resolve)
                resolve(message.result);
            else
                listeners.forEach((listener) => listener(message));
        }
    });
    for (const pipe of [to, from])
        pipe.on('error', () => {}); // its end is told by the exit
    browser.on('exit', () => waiting.forEach(({ reject }) => reject(new Error('the browser is gone'))));
    const send = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
        waiting.set(++number, { resolve, reject });
        to.write(`${JSON.stringify({ id: number, method, params, sessionId })}\0`);
    });
    const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
    const tell = (method, params) => send(method, params, sessionId);
    const complaints = [];
    listeners.push(({ method, params }) => {
        if (method === 'Runtime.exceptionThrown')
            complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
        if (method === 'Log.entryAdded' && params.entry.level === 'error')
            complaints.push(`${params.entry.text} ${params.entry.url ?? ''}`);
    });
    await tell('Runtime.enable');
    await tell('Log.enable');
    await tell('Page.enable');

    async function evaluate(expression) {
        const { result, exceptionDetails } = await tell('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails)
            throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }
    async function until(expression, seconds = 120) {
        for (const end = Date.now() + 1000 * seconds; !await evaluate(expression);) {
            if (Date.now() > end)
                throw new Error(`not in ${seconds} s: ${expression}`);
            await new Promise((wake) => { setTimeout(wake, 100); });
        }
    }
    return {
        tell, evaluate, until, complaints,
        async size(width, height, mobile = false) {
            await tell('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: mobile ? 2 : 1, mobile });
            await tell('Emulation.setTouchEmulationEnabled', { enabled: mobile });
        },
        async open(url) {
            await tell('Page.navigate', { url: 'about:blank' });
            await tell('Page.navigate', { url });
        },
        async close() {
            const gone = new Promise((resolve) => { browser.on('exit', resolve); });
            browser.kill('SIGKILL');
            await gone;
            await rm(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
        },
    };
}
