// Serves a folder on this computer while a command runs: served.mjs FOLDER COMMAND...
// `{page}` in the command becomes the address of the folder.
import { spawn } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const [folder, command, ...words] = process.argv.slice(2);
const types = {
  '.css': 'text/css',
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.json': 'application/json',
  '.nc': 'text/plain',
  '.wasm': 'application/wasm'
};
const server = createServer(async (request, response) => {
  const path = normalize(new URL(request.url, 'http://localhost').pathname);
  const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
  try {
    const bytes = await readFile(file);
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    response.end(bytes);
  } catch {
    response.writeHead(404);
    response.end();
  }
});
server.listen(0, '127.0.0.1', () => {
  const page = `http://127.0.0.1:${server.address().port}/`;
  const child = spawn(command, words.map((word) => word.replace('{page}', page)), {
    stdio: 'inherit'
  });
  child.on('exit', (status) => process.exit(status ?? 1));
});
