// Pages of rules: read-only documents, which the editor shows as pages.
import * as vscode from 'vscode';
import type { BaseLanguageClient } from 'vscode-languageclient';

export const scheme = 'ncvet-rule';

/** The server keeps a page as a file; here it is a document that nobody can change. */
const pages = new Map<string, vscode.Uri>(); // the file of a page, by the path of the document

export const isPage = (uri: vscode.Uri): boolean => uri.scheme === 'file' && uri.path.endsWith('.md');

/** The read-only document of a page that the server has written into a file. */
export function documentOf(page: vscode.Uri): vscode.Uri {
  // The folder is named for the control whose programs the page shows.
  const uri = vscode.Uri.from({ scheme, path: '/' + page.path.split('/').slice(-2).join('/') });
  pages.set(uri.path, page);
  return uri;
}

export async function showPage(page: vscode.Uri): Promise<void> {
  await vscode.commands.executeCommand('markdown.showPreviewToSide', documentOf(page));
}

/** The rule of a finding. */
export function ruleOf(diagnostic: vscode.Diagnostic): string {
  const code = diagnostic.code;
  return String(typeof code === 'object' ? code.value : code);
}

export const findingsOf = (uri: vscode.Uri): vscode.Diagnostic[] =>
  vscode.languages.getDiagnostics(uri).filter((finding) => finding.source === 'ncvet');

/** The rules that have something to say at the cursor; else those of the whole text. */
function rulesInSight(editor: vscode.TextEditor): string[] {
  const findings = findingsOf(editor.document.uri);
  const here = findings.filter((finding) => finding.range.intersection(editor.selection));
  return [...new Set((here.length > 0 ? here : findings).map(ruleOf))].sort();
}

async function explainRule(client: BaseLanguageClient | undefined): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  const rules = editor ? rulesInSight(editor) : [];
  if (rules.length === 0) {
    await vscode.window.showInformationMessage('ncvet has found nothing here that it could explain.');
    return;
  }
  const rule = rules.length === 1 ? rules[0] : await vscode.window.showQuickPick(rules, { title: 'Explain which rule?' });
  if (rule) {
    await client?.sendRequest('workspace/executeCommand', { command: 'ncvet.explain', arguments: [rule, editor?.document.uri.toString()] });
  }
}

export function registerExplain(
  context: vscode.ExtensionContext, client: () => BaseLanguageClient | undefined, read: (page: vscode.Uri) => Thenable<Uint8Array>,
): void {
  const content: vscode.TextDocumentContentProvider = {
    async provideTextDocumentContent(uri) {
      const page = pages.get(uri.path);
      return page ? new TextDecoder().decode(await read(page)) : '';
    },
  };
  context.subscriptions.push(
    vscode.workspace.registerTextDocumentContentProvider(scheme, content),
    // `ncvet.explain` itself is the server's command, which takes a rule.
    vscode.commands.registerCommand('ncvet.explainRule', () => explainRule(client())),
  );
}
