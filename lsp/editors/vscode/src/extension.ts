// Starts `ncvet lsp` for part programs, and binds what the editor shows of them.
import * as vscode from 'vscode';
import { registerBlocks } from './blocks';
import { makeClient, type QuietClient, section } from './client';
import { ControlPicker } from './control_picker';
import { registerDryRun } from './dry_run';
import { registerExplain } from './explain';
import { registerFixes } from './fixes';
import { languageIds, watchLanguages } from './languages';
import { findServer } from './server_path';
import { registerSnippets } from './snippets';
import { registerTrees } from './trees';

let client: QuietClient | undefined;

/** Tells the user, once, that there is no server, and what to do. */
async function tellThatItIsMissing(problem: string): Promise<void> {
  const choose = 'Choose Program…';
  const settings = 'Open Settings';
  const help = 'How to Install';
  const answer = await vscode.window.showErrorMessage(`ncvet did not start. ${problem}`, choose, settings, help);
  if (answer === choose) {
    const files = await vscode.window.showOpenDialog({ title: 'The program ncvet', canSelectMany: false });
    if (files?.[0]) {
      await vscode.workspace.getConfiguration(section).update('path', files[0].fsPath, vscode.ConfigurationTarget.Global);
    }
  } else if (answer === settings) {
    await vscode.commands.executeCommand('workbench.action.openSettings', 'ncvet.path');
  } else if (answer === help) {
    await vscode.commands.executeCommand('workbench.action.openWalkthrough', 'ncvet.ncvet#ncvet.start', false);
  }
}

async function start(context: vscode.ExtensionContext, picker: ControlPicker): Promise<void> {
  const setting = vscode.workspace.getConfiguration(section).get<string>('path', '');
  const found = findServer(setting, context.extensionPath);
  let problem = 'lookedFor' in found ? found.lookedFor : undefined;
  if ('file' in found) {
    client = makeClient(found, languageIds(context), picker);
    try {
      await client.start();
      client.started = true;
    } catch (error) {
      client = undefined;
      problem = `${found.file}: ${error instanceof Error ? error.message : error}`;
    }
  }
  picker.tellProblem(problem);
  if (problem) {
    void tellThatItIsMissing(problem);
  }
}

async function stop(): Promise<void> {
  const last = client;
  client = undefined;
  await last?.dispose();
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const picker = new ControlPicker(context);
  const restart = async () => {
    await stop();
    await start(context, picker);
  };
  registerExplain(context, () => client);
  registerFixes(context);
  registerDryRun(context, (document) => picker.controlOf(document));
  registerBlocks(context);
  registerTrees(context);
  registerSnippets(context, (document) => picker.controlOf(document));
  context.subscriptions.push(
    vscode.commands.registerCommand('ncvet.restart', restart),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration('ncvet.path')) {
        await restart();
      }
    }),
  );
  await start(context, picker);
  watchLanguages(context);
}

export const deactivate = stop;
