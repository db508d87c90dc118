// From a block number to its line.
import * as vscode from 'vscode';
import { isProgram } from './languages';

/** The number of a block as the program writes it, at the beginning of its line. */
const numberOf = (line: string): string | undefined => /^\s*(?:\/\d?\s*)*[N:]\s*0*(\d+)/i.exec(line)?.[1];

/** Lines of blocks with a number, ascending. */
function linesOf(document: vscode.TextDocument, number: string): number[] {
  const wanted = number.replace(/^0+(?=\d)/, '');
  const lines: number[] = [];
  for (let line = 0; line < document.lineCount; ++line) {
    if (numberOf(document.lineAt(line).text) === wanted) {
      lines.push(line);
    }
  }
  return lines;
}

/** The number of the block at the cursor, or of the last one before it that has one. */
function currentNumber(editor: vscode.TextEditor): string | undefined {
  for (let line = editor.selection.active.line; line >= 0; --line) {
    const number = numberOf(editor.document.lineAt(line).text);
    if (number) {
      return number;
    }
  }
  return undefined;
}

async function goToBlock(): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  if (!editor || !isProgram(editor.document)) {
    return;
  }
  const current = currentNumber(editor);
  const answer = await vscode.window.showInputBox({
    title: 'Go to block number',
    prompt: current ? `The cursor is in or after block N${current}` : undefined,
    value: current,
    validateInput: (text) => (/^\s*[N:]?\s*\d+\s*$/i.test(text) ? undefined : 'a number, for example 120 or N120'),
  });
  const number = answer?.replace(/\D/g, '');
  if (!number) {
    return;
  }
  const lines = linesOf(editor.document, number);
  if (lines.length === 0) {
    await vscode.window.showInformationMessage(`There is no block N${number} in this text.`);
    return;
  }
  // Of several programs in a text: the next one, and round again.
  const line = lines.find((one) => one > editor.selection.active.line) ?? lines[0];
  editor.selection = new vscode.Selection(line, 0, line, 0);
  editor.revealRange(editor.selection, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
}

export function registerBlocks(context: vscode.ExtensionContext): void {
  context.subscriptions.push(vscode.commands.registerCommand('ncvet.goToBlock', goToBlock));
}
