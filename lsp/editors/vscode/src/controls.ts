// The controls: what the tables say of them, and which marks of a text speak for one.
import * as vscode from 'vscode';

export interface Control {
  id: string;
  short: string;
  title: string;
  family: string;
  extensions: string[];
  marks: { pattern: string; score: number; reason: string }[];
}

const shownLines = 200; // as many as the server looks at

export async function readControls(context: vscode.ExtensionContext): Promise<Control[]> {
  const file = vscode.Uri.joinPath(context.extensionUri, 'controls.json');
  return JSON.parse(new TextDecoder().decode(await vscode.workspace.fs.readFile(file)));
}

/** Endings of files that are programs of some control. */
export async function endingsOfPrograms(context: vscode.ExtensionContext): Promise<string[]> {
  return [...new Set((await readControls(context)).flatMap((control) => control.extensions))].sort();
}

/** Marks of a text that speak for a control, the strongest first. */
export function marksIn(control: Control, text: string): { score: number; reasons: string[] } {
  const lines = text
    .split(/\r\n|\r|\n/, shownLines)
    .map((line) => line.trim().toUpperCase())
    .filter((line) => line !== '');
  const found = control.marks.filter((mark) => {
    const pattern = new RegExp(mark.pattern);
    return lines.some((line) => pattern.test(line));
  });
  found.sort((a, b) => b.score - a.score);
  return { score: found.reduce((sum, mark) => sum + mark.score, 0), reasons: found.map((mark) => mark.reason) };
}
