// Copies the server as WebAssembly into the package, where `./dev package npm` has made it: it runs where the program is not
// installed. Without it the extension needs the program.
import { cpSync, existsSync, rmSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const from = fileURLToPath(new URL('../../../../build/package/npm/package/', import.meta.url));
const to = fileURLToPath(new URL('../server/', import.meta.url));
rmSync(to, { recursive: true, force: true });
for (const folder of existsSync(from) ? ['bin', 'lib'] : []) {
  cpSync(`${from}${folder}`, `${to}${folder}`, { recursive: true });
}
