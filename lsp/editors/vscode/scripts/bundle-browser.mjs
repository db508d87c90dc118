// Puts the worker together in which the server runs in a browser: the module's script, where `./dev package npm` has made it, and
// what binds it to the editor.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const module = fileURLToPath(new URL('../../../../build/package/npm/package/lib/module.js', import.meta.url));
const worker = fileURLToPath(new URL('../worker/server_worker.js', import.meta.url));
const to = fileURLToPath(new URL('../dist/', import.meta.url));
mkdirSync(to, { recursive: true });
if (existsSync(module)) writeFileSync(`${to}server_worker.js`, `${readFileSync(module, 'utf8')}\n${readFileSync(worker, 'utf8')}`);
