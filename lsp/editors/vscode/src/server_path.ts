// Where the server is: the program that the setting names, the one in the extension, the one in PATH, or
// the WebAssembly module that the extension brings.
import * as fs from 'node:fs';
import * as os from 'node:os';
import * as path from 'node:path';

const isWindows = process.platform === 'win32';
const fileName = isWindows ? 'ncvet.exe' : 'ncvet';

function isProgram(file: string): boolean {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}

function inPath(name: string): string | undefined {
  const folders = (process.env.PATH ?? '').split(path.delimiter).filter((folder) => folder !== '');
  const names = isWindows && !path.extname(name) ? [name + '.exe'] : [name];
  return folders.flatMap((folder) => names.map((one) => path.join(folder, one))).find(isProgram);
}

/** A program, or a script that Node runs. */
export interface Server {
  file: string;
  needsNode?: boolean;
}

/** The server, or where it was looked for in vain. */
export function findServer(setting: string, extensionPath: string): Server | { lookedFor: string } {
  const wanted = setting.trim().replace(/^~(?=[/\\])/, os.homedir());
  if (wanted !== '') {
    const file = /[/\\]/.test(wanted) ? (isProgram(wanted) ? wanted : undefined) : inPath(wanted);
    return file ? { file } : { lookedFor: `The setting ncvet.path names ${wanted}, which is no program.` };
  }
  const bundled = path.join(extensionPath, 'bin', fileName);
  const file = isProgram(bundled) ? bundled : inPath(fileName);
  if (file) {
    return { file };
  }
  const script = path.join(extensionPath, 'server', 'bin', 'ncvet.js');
  return fs.existsSync(script) ? { file: script, needsNode: true } : { lookedFor: 'It is neither in the extension nor in PATH.' };
}
