// The files of the workspace for a server that has none of its own: copies of the programs and of what they are checked by.
import * as vscode from 'vscode';
import { endingsOfPrograms } from './controls';

/** A workspace with more files is not copied: a browser has them from elsewhere. */
const mostFiles = 2000;
/** A longer file is a text of something else. */
const mostBytes = 32 * 1024 * 1024;
/** Folders in folders that are looked through. */
const deepest = 8;
/** So many are fetched at a time. */
const atOnce = 16;

/** The path of a text for the server: that of a file, wherever it is. */
export const pathOf = (uri: vscode.Uri): string => uri.path;

export class ServerFiles {
  private readonly known = new Map<string, vscode.Uri>(); // by path
  private readonly waiting = new Map<number, (bytes: Uint8Array) => void>();
  private readonly watchers: vscode.Disposable[] = [];
  private last = 0;

  constructor(private readonly port: MessagePort) {
    port.onmessage = ({ data }: MessageEvent<{ id: number; bytes: Uint8Array }>) => {
      this.waiting.get(data.id)?.(data.bytes);
      this.waiting.delete(data.id);
    };
  }

  /** Copies programs, configurations and machine profiles, and goes on with what changes. */
  async copyWorkspace(context: vscode.ExtensionContext): Promise<void> {
    const endings = new Set([...(await endingsOfPrograms(context)), 'json']);
    const isWanted = (name: string) => endings.has(/\.([^.]+)$/.exec(name)?.[1].toLowerCase() ?? '') || /^O\d+$/i.test(name);
    const found: vscode.Uri[] = [];
    for (const { uri } of vscode.workspace.workspaceFolders ?? []) {
      await this.search(uri, isWanted, found, deepest);
    }
    for (let i = 0; i < found.length; i += atOnce) {
      await Promise.all(found.slice(i, i + atOnce).map((uri) => this.copy(uri)));
    }
    const watcher = vscode.workspace.createFileSystemWatcher('**/*');
    const copyWanted = (uri: vscode.Uri) => isWanted(uri.path.split('/').at(-1) ?? '') && this.copy(uri);
    watcher.onDidCreate(copyWanted);
    watcher.onDidChange(copyWanted);
    watcher.onDidDelete((uri) => this.remove(uri));
    this.watchers.push(watcher, vscode.workspace.onDidOpenTextDocument(({ uri }) => this.known.set(pathOf(uri), uri)));
    vscode.workspace.textDocuments.forEach(({ uri }) => this.known.set(pathOf(uri), uri));
  }

  /** Looks through a folder: the editor's own search is not to be had everywhere. */
  private async search(folder: vscode.Uri, isWanted: (name: string) => boolean, found: vscode.Uri[], depth: number): Promise<void> {
    let entries: [string, vscode.FileType][] = [];
    try {
      entries = await vscode.workspace.fs.readDirectory(folder);
    } catch {
      return; // it may not be read
    }
    for (const [name, type] of entries) {
      const uri = vscode.Uri.joinPath(folder, name);
      if (type & vscode.FileType.Directory && depth > 0 && !name.startsWith('.') && name !== 'node_modules') {
        await this.search(uri, isWanted, found, depth - 1);
      } else if (type & vscode.FileType.File && isWanted(name) && found.length < mostFiles) {
        found.push(uri);
      }
    }
  }

  /** Where the file of a path is; undefined: it is none of the workspace. */
  uriOf(path: string): vscode.Uri | undefined {
    return this.known.get(path);
  }

  /** A file of the server: a page that it has written. */
  read(path: string): Promise<Uint8Array> {
    const id = ++this.last;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.port.postMessage({ read: path, id });
    });
  }

  private async copy(uri: vscode.Uri): Promise<void> {
    try {
      const { size } = await vscode.workspace.fs.stat(uri);
      if (size > mostBytes) {
        return;
      }
      const bytes = await vscode.workspace.fs.readFile(uri);
      this.known.set(pathOf(uri), uri);
      this.port.postMessage({ write: pathOf(uri), bytes });
    } catch {
      // it is gone again
    }
  }

  private remove(uri: vscode.Uri): void {
    this.port.postMessage({ remove: pathOf(uri) });
  }

  dispose(): void {
    this.watchers.forEach((watcher) => watcher.dispose());
    this.port.close();
  }
}
