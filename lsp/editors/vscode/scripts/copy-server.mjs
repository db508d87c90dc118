// Copies into the package what checks programs where ncvet is not installed: the program that NCVET_PROGRAM names, in a
// package for one platform; else the server as WebAssembly, where `./dev package npm` has made it. With neither the extension
// needs an installed program.
import { chmodSync, copyFileSync, cpSync, existsSync, mkdirSync, rmSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const module = fileURLToPath(new URL('../../../../build/package/npm/package/', import.meta.url));
const [bin, server] = ['../bin/', '../server/'].map((folder) => fileURLToPath(new URL(folder, import.meta.url)));
rmSync(bin, { recursive: true, force: true });
rmSync(server, { recursive: true, force: true });
const program = process.env.NCVET_PROGRAM ?? '';
if (program !== '') {
  const copy = `${bin}ncvet${path.extname(program) === '.exe' ? '.exe' : ''}`;
  mkdirSync(bin);
  copyFileSync(program, copy);
  chmodSync(copy, 0o755);
} else if (existsSync(module)) {
  for (const folder of ['bin', 'lib']) {
    cpSync(`${module}${folder}`, `${server}${folder}`, { recursive: true });
  }
}
