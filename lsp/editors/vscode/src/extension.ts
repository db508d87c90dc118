// The client: starts `ncvet lsp` for part programs and gives the editor's commands to it.
import * as vscode from 'vscode';
import { ExecuteCommandRequest, LanguageClient, type LanguageClientOptions, type ServerOptions } from 'vscode-languageclient/node';

const section = 'ncvet';
let client: LanguageClient | undefined;

/** The languages that package.json contributes. */
function languageIds(context: vscode.ExtensionContext): string[] {
  const contributed: { id: string }[] = context.extension.packageJSON.contributes.languages;
  return contributed.map((language) => language.id);
}

function makeClient(context: vscode.ExtensionContext): LanguageClient {
  const settings = vscode.workspace.getConfiguration(section);
  const server: ServerOptions = { command: settings.get('path') || 'ncvet', args: ['lsp'] };
  const options: LanguageClientOptions = {
    documentSelector: languageIds(context).flatMap((language) => [
      { scheme: 'file', language },
      { scheme: 'untitled', language },
    ]),
    initializationOptions: settings,
    // The server asks for the section again when it is told that something changed.
    synchronize: { configurationSection: section },
    middleware: {
      window: {
        // The page of a rule is Markdown: it is shown as a page.
        showDocument: async (params, token, next) => {
          if (!params.uri.startsWith('file:') || !params.uri.endsWith('.md')) {
            return next(params, token);
          }
          await vscode.commands.executeCommand('markdown.showPreviewToSide', vscode.Uri.parse(params.uri));
          return { success: true };
        },
      },
    },
  };
  return new LanguageClient(section, 'ncvet', server, options);
}

async function start(context: vscode.ExtensionContext): Promise<void> {
  client = makeClient(context);
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    const settings = 'Open Settings';
    const answer = await vscode.window.showErrorMessage(
      `ncvet did not start: ${error instanceof Error ? error.message : error}. The setting ncvet.path says where it is.`,
      settings,
    );
    if (answer === settings) {
      await vscode.commands.executeCommand('workbench.action.openSettings', 'ncvet.path');
    }
  }
}

async function stop(): Promise<void> {
  const last = client;
  client = undefined;
  await last?.dispose();
}

/** The rule of a finding. */
function ruleOf(diagnostic: vscode.Diagnostic): string {
  const code = diagnostic.code;
  return String(typeof code === 'object' ? code.value : code);
}

/** The rules that have something to say at the cursor; else those of the whole text. */
function rulesInSight(editor: vscode.TextEditor): string[] {
  const findings = vscode.languages.getDiagnostics(editor.document.uri).filter((finding) => finding.source === 'ncvet');
  const here = findings.filter((finding) => finding.range.intersection(editor.selection));
  return [...new Set((here.length > 0 ? here : findings).map(ruleOf))].sort();
}

async function explainRule(): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  const rules = editor ? rulesInSight(editor) : [];
  if (rules.length === 0) {
    await vscode.window.showInformationMessage('ncvet has found nothing here that it could explain.');
    return;
  }
  const rule = rules.length === 1 ? rules[0] : await vscode.window.showQuickPick(rules, { title: 'Explain which rule?' });
  if (rule) {
    await client?.sendRequest(ExecuteCommandRequest.type, { command: 'ncvet.explain', arguments: [rule] });
  }
}

async function fixAll(): Promise<void> {
  await vscode.commands.executeCommand('editor.action.codeAction', { kind: 'source.fixAll.ncvet', apply: 'first' });
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const restart = async () => {
    await stop();
    await start(context);
  };
  context.subscriptions.push(
    // `ncvet.explain` itself is the server's command, which takes a rule.
    vscode.commands.registerCommand('ncvet.explainRule', explainRule),
    vscode.commands.registerCommand('ncvet.fixAll', fixAll),
    vscode.commands.registerCommand('ncvet.restart', restart),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration('ncvet.path')) {
        await restart();
      }
    }),
  );
  await start(context);
}

export const deactivate = stop;
