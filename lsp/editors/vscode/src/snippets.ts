// Snippets for texts whose control is found out: those of the control that the server has found. The languages of single
// controls have theirs from package.json.
import * as vscode from 'vscode';
import { anyControl } from './languages';

interface Snippet {
  prefix: string;
  body: string[];
  description: string;
}

export function registerSnippets(context: vscode.ExtensionContext, controlOf: (document: vscode.TextDocument) => string | undefined): void {
  const read = new Map<string, Promise<vscode.CompletionItem[]>>();
  const entriesOf = async (control: string): Promise<Record<string, Snippet>> => {
    const file = vscode.Uri.joinPath(context.extensionUri, 'snippets', control + '.json');
    try {
      return JSON.parse(new TextDecoder().decode(await vscode.workspace.fs.readFile(file)));
    } catch {
      return {}; // a control of the user's own
    }
  };
  const make = async (control: string): Promise<vscode.CompletionItem[]> => {
    const entries = await entriesOf(control);
    const items = Object.entries(entries).map(([name, snippet]) => {
      const item = new vscode.CompletionItem({ label: snippet.prefix, description: name }, vscode.CompletionItemKind.Snippet);
      item.insertText = new vscode.SnippetString(snippet.body.join('\n'));
      item.documentation = new vscode.MarkdownString().appendCodeblock(snippet.body.join('\n').replace(/\$\{\d+:([^}]*)\}|\$\d/g, '$1'));
      item.sortText = '~' + snippet.prefix; // after the words of the control
      return item;
    });
    return items;
  };
  const snippetsOf = (control: string): Promise<vscode.CompletionItem[]> => {
    const known = read.get(control) ?? make(control);
    read.set(control, known);
    return known;
  };
  const provider: vscode.CompletionItemProvider = {
    async provideCompletionItems(document, position) {
      const before = document.lineAt(position).text.slice(0, position.character);
      const control = controlOf(document);
      return control && /^\s*[a-z]*$/i.test(before) ? snippetsOf(control) : [];
    },
  };
  context.subscriptions.push(vscode.languages.registerCompletionItemProvider(anyControl, provider));
}
