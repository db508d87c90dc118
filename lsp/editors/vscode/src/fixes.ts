// All safe fixes at once, and a word on those that are left.
import * as vscode from 'vscode';
import { isProgram } from './languages';

const kind = 'source.fixAll.ncvet';

async function fixAll(): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  if (!editor || !isProgram(editor.document)) {
    return;
  }
  const { document } = editor;
  const all = new vscode.Range(0, 0, document.lineCount, 0);
  const resolved = 1; // the edit of an action comes with it
  const actions = await vscode.commands.executeCommand<vscode.CodeAction[]>(
    'vscode.executeCodeActionProvider', document.uri, all, kind, resolved,
  );
  const action = actions.find((one) => one.edit);
  if (!action?.edit) {
    await vscode.window.showInformationMessage('ncvet has no safe fix for this text.');
    return;
  }
  await vscode.workspace.applyEdit(action.edit);
  // The title counts the fixes, and those that need a look.
  void vscode.window.showInformationMessage(action.title.replace(/^Apply /, 'Applied '));
}

export function registerFixes(context: vscode.ExtensionContext): void {
  context.subscriptions.push(vscode.commands.registerCommand('ncvet.fixAll', fixAll));
}
