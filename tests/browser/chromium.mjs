// Drives Chromium without any package: messages of its debugging protocol over two pipes.
// chromium.mjs PROGRAM PAGE STEPS.json [SCREENSHOT]: opens the page, evaluates the expressions of the
// list one after the other in it, and prints what came as JSON: results, errors, requests.
import { spawn } from 'node:child_process';
import { readFileSync, writeFileSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [program, page, stepsFile, screenshot] = process.argv.slice(2);
const steps = JSON.parse(readFileSync(stepsFile, 'utf8'));
const profile = mkdtempSync(join(tmpdir(), 'ncvet-chromium-'));
const child = spawn(
  program,
  [
    '--headless=new',
    '--no-sandbox',
    '--disable-dev-shm-usage',
    '--remote-debugging-pipe',
    '--enable-unsafe-swiftshader',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    `--user-data-dir=${profile}`,
    'about:blank'
  ],
  { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] }
);

const waiting = new Map(),
  listeners = [];
let number = 0,
  rest = '';
child.stdio[4].setEncoding('utf8');
child.stdio[4].on('data', (text) => {
  const messages = (rest + text).split('\0');
  rest = messages.pop();
  for (const message of messages.map((one) => JSON.parse(one))) {
    if (message.id) waiting.get(message.id)?.(message);
    else listeners.forEach((listener) => listener(message));
  }
});

function send(method, params = {}, sessionId = undefined) {
  return new Promise((resolve, reject) => {
    const id = ++number;
    waiting.set(id, (message) => {
      waiting.delete(id);
      if (message.error) reject(new Error(`${method}: ${message.error.message}`));
      else resolve(message.result);
    });
    child.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + '\0');
  });
}

const report = { results: [], errors: [], requests: [] };
try {
  const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
  const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
  const ask = (method, params) => send(method, params, sessionId);
  listeners.push(({ method, params }) => {
    if (method === 'Runtime.exceptionThrown')
      report.errors.push(
        params.exceptionDetails.exception?.description ?? params.exceptionDetails.text
      );
    if (method === 'Log.entryAdded' && params.entry.level === 'error')
      report.errors.push(params.entry.text);
    if (method === 'Network.requestWillBeSent' && !params.request.url.startsWith('data:'))
      report.requests.push(params.request.url);
  });
  for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await ask(`${domain}.enable`);
  await ask('Emulation.setDeviceMetricsOverride', {
    width: 1600,
    height: 1000,
    deviceScaleFactor: 1,
    mobile: false
  });
  const loaded = new Promise((resolve) =>
    listeners.push(({ method }) => {
      if (method === 'Page.loadEventFired') resolve();
    })
  );
  const begin = Date.now();
  await ask('Page.navigate', { url: page });
  await loaded;
  report.milliseconds = Date.now() - begin;
  for (const expression of steps) {
    const { result, exceptionDetails } = await ask('Runtime.evaluate', {
      expression,
      awaitPromise: true,
      returnByValue: true
    });
    report.results.push(
      exceptionDetails
        ? `error: ${exceptionDetails.exception?.description}`
        : (result.value ?? null)
    );
  }
  if (screenshot)
    writeFileSync(screenshot, Buffer.from((await ask('Page.captureScreenshot')).data, 'base64'));
  await send('Browser.close');
} catch (error) {
  report.errors.push(String(error));
  child.kill();
}
await new Promise((resolve) =>
  child.exitCode === null && child.signalCode === null ? child.once('exit', resolve) : resolve()
);
rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
process.stdout.write(JSON.stringify(report));
