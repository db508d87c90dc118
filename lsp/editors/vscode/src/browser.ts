// The extension in an editor that runs in a browser: the server is a WebAssembly module in a worker.
import * as vscode from 'vscode';
import { LanguageClient } from 'vscode-languageclient/browser';
import { bindClient, clientOptions, section } from './client';
import { activateOn, stop } from './main';
import type { Platform } from './platform';
import { ServerFiles, pathOf } from './server_files';

let worker: Worker | undefined;
let files: ServerFiles | undefined;

/** The server knows files alone: a text elsewhere is one for it, and its place is found again by the path. */
const uriConverters = {
  code2Protocol: (uri: vscode.Uri): string => vscode.Uri.file(pathOf(uri)).toString(),
  protocol2Code: (text: string): vscode.Uri => files?.uriOf(vscode.Uri.parse(text).path) ?? vscode.Uri.parse(text),
};

async function bytesOf(context: vscode.ExtensionContext, ...names: string[]): Promise<Uint8Array> {
  return vscode.workspace.fs.readFile(vscode.Uri.joinPath(context.extensionUri, ...names));
}

const browser: Platform = {
  async makeClient(context, languages, picker) {
    let module: Uint8Array;
    try {
      module = await bytesOf(context, 'server', 'lib', 'ncvet.wasm');
    } catch {
      return { problem: 'The extension was packed without the module that runs in a browser.' };
    }
    // The worker's own address need not be one from which scripts may be loaded.
    const script = await bytesOf(context, 'dist', 'server_worker.js');
    worker = new Worker(URL.createObjectURL(new Blob([script as BlobPart], { type: 'text/javascript' })));
    const { port1, port2 } = new MessageChannel();
    worker.postMessage({ ncvet: 'start', module, port: port2 }, [port2]);
    files = new ServerFiles(port1);
    await files.copyWorkspace(context);
    const options = { ...clientOptions(languages, []), uriConverters };
    return bindClient(new LanguageClient(section, 'ncvet', worker, options), picker);
  },
  readPage: (page) => files?.read(page.path) ?? Promise.resolve(new Uint8Array()),
  registerDryRun(context) {
    const tell = () => void vscode.window.showInformationMessage('A dry run needs the program ncvet, which does not run in a browser.');
    context.subscriptions.push(vscode.commands.registerCommand('ncvet.dryRun', tell));
  },
  stopped() {
    worker?.terminate();
    worker = undefined;
    files?.dispose();
    files = undefined;
  },
};

export const activate = (context: vscode.ExtensionContext): Promise<void> => activateOn(browser, context);
export const deactivate = stop;
