// Puts the playground together: node playground/build.mjs LIB OUT
//
// LIB is the folder `lib` of the npm package. The files of OUT can be served by any web server.
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { spawnSync } from 'node:child_process';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const top = dirname(here);
const [lib, out] = process.argv.slice(2);
if (!lib || !out) {
  process.stderr.write('usage: node playground/build.mjs LIB OUT\n');
  process.exit(2);
}

/** The viewer's script and style are allowed by their sums, which a report names in its own policy. */
function policyOfViewer(program) {
  const command = join(dirname(lib), 'bin', 'ncvet.js');
  const words = [command, 'check', '--exit-zero', '--format', 'html', program];
  const { stdout, stderr, status } = spawnSync(process.execPath, words, {
    encoding: 'utf8',
    maxBuffer: 1 << 28
  });
  const sum = (of) => new RegExp(`${of} ('sha256-[^']+')`).exec(stdout)?.[1];
  if (status !== 0 || !sum('script-src') || !sum('style-src'))
    throw new Error(`no report was written: ${stderr}`);
  return { script: sum('script-src'), style: sum('style-src') };
}

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, 'examples'), { recursive: true });
for (const name of ['page.css', 'page.js', 'worker.js'])
  copyFileSync(join(here, name), join(out, name));
for (const name of ['module.js', 'ncvet.wasm']) copyFileSync(join(lib, name), join(out, name));
// What makes the pages of rules readable, from Debian's package node-marked.
copyFileSync('/usr/share/nodejs/marked/lib/marked.umd.min.js', join(out, 'marked.js'));

const programs = join(top, 'tests', 'programs', 'examples');
const examples = readdirSync(programs)
  .filter((name) => name.endsWith('.nc'))
  .sort();
for (const name of examples)
  copyFileSync(join(programs, name), join(out, 'examples', name));
const controls = JSON.parse(
  readFileSync(join(top, 'lsp', 'editors', 'vscode', 'controls.json'), 'utf8')
).map(({ id, title }) => ({ id, title }));
writeFileSync(join(out, 'lists.json'), `${JSON.stringify({ controls, examples }, null, 1)}\n`);

// The viewer is a page in a frame that the browser makes of a text: this page's policy holds for it.
const viewer = policyOfViewer(join(programs, examples[0]));
const policy = [
  "default-src 'none'",
  `script-src 'self' 'wasm-unsafe-eval' ${viewer.script}`,
  `style-src 'self' ${viewer.style}`,
  "connect-src 'self'",
  "worker-src 'self'",
  'frame-src blob:',
  'img-src data:',
  "base-uri 'none'",
  "form-action 'none'"
].join('; ');
writeFileSync(
  join(out, 'index.html'),
  readFileSync(join(here, 'index.html'), 'utf8').replace('{{policy}}', policy)
);
