// Dry runs in the editor's debugger: `ncvet dap` as its adapter, and a command that runs the program in sight.
import * as vscode from 'vscode';
import { section } from './client';
import { languageIds } from './languages';
import { findServer } from './server_path';

const type = 'ncvet';

/** The program of the active editor as a launch, where it is one. */
function launchOf(document: vscode.TextDocument | undefined, languages: string[]): vscode.DebugConfiguration | undefined {
  if (!document || document.uri.scheme !== 'file' || !languages.includes(document.languageId)) {
    return undefined;
  }
  return { type, request: 'launch', name: 'Dry run', program: document.uri.fsPath, stopOnEntry: true };
}

/** The dry run of a program that is not saved would be one of the text before. */
async function isSaved(document: vscode.TextDocument | undefined): Promise<boolean> {
  return !document?.isDirty || document.save();
}

export function registerDryRun(context: vscode.ExtensionContext, controlOf: (document: vscode.TextDocument) => string | undefined): void {
  const languages = languageIds(context);
  const active = () => vscode.window.activeTextEditor?.document;

  const configurations: vscode.DebugConfigurationProvider = {
    provideDebugConfigurations: () => [
      { type, request: 'launch', name: 'Dry run', program: '${file}', stopOnEntry: true },
    ],
    // Without a launch.json: the program in sight.
    resolveDebugConfiguration: (_folder, wanted) => (wanted.type ? wanted : launchOf(active(), languages)),
    resolveDebugConfigurationWithSubstitutedVariables: async (_folder, wanted) => {
      const document = vscode.workspace.textDocuments.find((one) => one.uri.fsPath === wanted.program);
      if (!(await isSaved(document))) {
        return undefined;
      }
      const settings = vscode.workspace.getConfiguration(section);
      const dialect = wanted.dialect ?? (document && controlOf(document)) ?? settings.get<string>('dialect', 'auto');
      const machine = wanted.machine ?? settings.get<string>('machine', '');
      const config = wanted.config ?? settings.get<string>('config', '');
      return { ...wanted, dialect, ...(machine && { machine }), ...(config && { config }) };
    },
  };

  const adapters: vscode.DebugAdapterDescriptorFactory = {
    createDebugAdapterDescriptor: () => {
      const found = findServer(vscode.workspace.getConfiguration(section).get<string>('path', ''), context.extensionPath);
      if ('lookedFor' in found) {
        throw new Error(`ncvet did not start. ${found.lookedFor}`);
      }
      if (found.needsNode) {
        throw new Error('A dry run needs the program ncvet: the one in the extension is without threads, and only checks.');
      }
      return new vscode.DebugAdapterExecutable(found.file, ['dap']);
    },
  };

  const run = async () => {
    const launch = launchOf(active(), languages);
    if (!launch) {
      void vscode.window.showInformationMessage('The active editor shows no NC program in a file.');
      return;
    }
    await vscode.debug.startDebugging(vscode.workspace.workspaceFolders?.[0], launch);
  };

  context.subscriptions.push(
    vscode.debug.registerDebugConfigurationProvider(type, configurations),
    vscode.debug.registerDebugAdapterDescriptorFactory(type, adapters),
    vscode.commands.registerCommand('ncvet.dryRun', run),
  );
}
