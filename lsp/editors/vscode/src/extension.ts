// The extension in an editor on a computer: the server is a program, or a module that Node runs.
import * as vscode from 'vscode';
import { LanguageClient, type ServerOptions, TransportKind } from 'vscode-languageclient/node';
import { bindClient, clientOptions, section } from './client';
import { registerDryRun } from './dry_run';
import { activateOn, stop } from './main';
import type { Platform } from './platform';
import { findServer } from './server_path';

const computer: Platform = {
  async makeClient(context, languages, picker) {
    const setting = vscode.workspace.getConfiguration(section).get<string>('path', '');
    const found = findServer(setting, context.extensionPath);
    if ('lookedFor' in found) {
      return { problem: found.lookedFor };
    }
    const { file, needsNode } = found;
    const server: ServerOptions = needsNode
      ? { module: file, args: ['lsp'], transport: TransportKind.stdio }
      : { command: file, args: ['lsp'] };
    return bindClient(new LanguageClient(section, 'ncvet', server, clientOptions(languages, ['file', 'untitled'])), picker);
  },
  readPage: (page) => vscode.workspace.fs.readFile(page),
  registerDryRun,
};

export const activate = (context: vscode.ExtensionContext): Promise<void> => activateOn(computer, context);
export const deactivate = stop;
