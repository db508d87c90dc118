// Snippets for texts whose control is found out: those of the control that the server has found. The languages of single
// controls have theirs from package.json.
import * as fs from 'node:fs';
import * as path from 'node:path';
import * as vscode from 'vscode';
import { anyControl } from './languages';

interface Snippet {
  prefix: string;
  body: string[];
  description: string;
}

export function registerSnippets(context: vscode.ExtensionContext, controlOf: (document: vscode.TextDocument) => string | undefined): void {
  const read = new Map<string, vscode.CompletionItem[]>();
  const snippetsOf = (control: string): vscode.CompletionItem[] => {
    const known = read.get(control);
    if (known) {
      return known;
    }
    const file = path.join(context.extensionPath, 'snippets', control + '.json');
    const entries: Record<string, Snippet> = fs.existsSync(file) ? JSON.parse(fs.readFileSync(file, 'utf8')) : {};
    const items = Object.entries(entries).map(([name, snippet]) => {
      const item = new vscode.CompletionItem({ label: snippet.prefix, description: name }, vscode.CompletionItemKind.Snippet);
      item.insertText = new vscode.SnippetString(snippet.body.join('\n'));
      item.documentation = new vscode.MarkdownString().appendCodeblock(snippet.body.join('\n').replace(/\$\{\d+:([^}]*)\}|\$\d/g, '$1'));
      item.sortText = '~' + snippet.prefix; // after the words of the control
      return item;
    });
    read.set(control, items);
    return items;
  };
  const provider: vscode.CompletionItemProvider = {
    provideCompletionItems(document, position) {
      const before = document.lineAt(position).text.slice(0, position.character);
      const control = controlOf(document);
      return control && /^\s*[a-z]*$/i.test(before) ? snippetsOf(control) : [];
    },
  };
  context.subscriptions.push(vscode.languages.registerCompletionItemProvider(anyControl, provider));
}
