// Starts the server for part programs, and binds what the editor shows of them.
import * as vscode from 'vscode';
import { registerBlocks } from './blocks';
import { type QuietClient, section } from './client';
import { ControlPicker } from './control_picker';
import { registerExplain } from './explain';
import { registerFixes } from './fixes';
import { languageIds, watchLanguages } from './languages';
import { PathView } from './path_view';
import type { Platform } from './platform';
import { registerSnippets } from './snippets';
import { registerTrees } from './trees';

let client: QuietClient | undefined;
let running: Platform | undefined;

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

async function start(context: vscode.ExtensionContext, platform: Platform, picker: ControlPicker): Promise<void> {
  let problem: string | undefined;
  try {
    const made = await platform.makeClient(context, languageIds(context), picker);
    if ('problem' in made) {
      problem = made.problem;
    } else {
      client = made;
      await client.start();
      client.started = true;
    }
  } catch (error) {
    client = undefined;
    problem = error instanceof Error ? error.message : String(error);
  }
  picker.tellProblem(problem);
  if (problem) {
    void tellThatItIsMissing(problem);
  }
}

export async function stop(): Promise<void> {
  const last = client;
  client = undefined;
  await last?.dispose();
  running?.stopped?.();
}

export async function activateOn(platform: Platform, context: vscode.ExtensionContext): Promise<void> {
  running = platform;
  const picker = new ControlPicker(context);
  const view = new PathView(context, () => client);
  const restart = async () => {
    await stop();
    await start(context, platform, picker);
    view.restart();
  };
  registerExplain(context, () => client, (page) => platform.readPage(page));
  registerFixes(context);
  platform.registerDryRun(context, (document) => picker.controlOf(document));
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
  await start(context, platform, picker);
  watchLanguages(context);
}
