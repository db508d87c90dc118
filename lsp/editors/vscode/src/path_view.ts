// The tool path beside the text: it follows what is typed, and both cursors follow each other.
import * as vscode from 'vscode';
import type { BaseLanguageClient } from 'vscode-languageclient';
import { findingsOf, ruleOf } from './explain';
import { isProgram } from './languages';

/** What the server answers to `ncvet/path`: the whole path, or what has become of the one before. */
interface PathAnswer {
  id: string;
  version: number;
  more?: boolean; // the rest is still that of an earlier text
  path?: { files: string[] };
  change?: { files: string[] };
}

/** What the view says. */
type Message =
  | { type: 'ready' | 'again' }
  | { type: 'shown'; what: string; moves: number; took: number }
  | { type: 'line'; uri: string; line: number; turn: number };

const viewType = 'ncvet.path';
const severities = ['error', 'warning', 'style', 'style'];

/** What was shown last; for tests. */
export interface Shown {
  what: string;
  moves: number;
  took: number;
}

export class PathView {
  private panel: vscode.WebviewPanel | undefined;
  private document: vscode.TextDocument | undefined;
  private last = ''; // id of the server's last answer
  private files: string[] = []; // of the path
  private isAsking = false;
  private asksAgain = false;
  private isReady = false;
  private placed = ''; // where the view has put the editor's cursor
  private turn = 0; // the last time that it did
  private shown: Shown = { what: '', moves: 0, took: 0 };

  constructor(
    private readonly context: vscode.ExtensionContext,
    private readonly client: () => BaseLanguageClient | undefined,
  ) {
    context.subscriptions.push(
      vscode.commands.registerCommand('ncvet.showPath', () => this.open()),
      vscode.commands.registerCommand('ncvet.shownPath', () => this.shown),
      vscode.workspace.onDidChangeTextDocument(({ document, contentChanges }) => {
        if (contentChanges.length > 0 && this.concerns(document)) {
          this.ask();
        }
      }),
      vscode.workspace.onDidCloseTextDocument((document) => document === this.document && this.forget('')),
      vscode.window.onDidChangeActiveTextEditor((editor) => editor && this.look(editor.document)),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.sendCursor(textEditor)),
      vscode.languages.onDidChangeDiagnostics(({ uris }) => {
        if (uris.some((uri) => this.files.includes(uri.toString()))) {
          this.sendFindings();
        }
      }),
    );
  }

  /** A new server knows nothing of the answers of the one before. */
  restart(): void {
    this.last = '';
    this.ask();
  }

  private open(): void {
    const document = vscode.window.activeTextEditor?.document;
    if (!document || !isProgram(document)) {
      void vscode.window.showInformationMessage('The active editor shows no NC program.');
      return;
    }
    if (this.panel) {
      this.panel.reveal(undefined, true);
    } else {
      this.makePanel();
    }
    this.look(document);
  }

  private makePanel(): void {
    const dist = vscode.Uri.joinPath(this.context.extensionUri, 'dist');
    const panel = vscode.window.createWebviewPanel(
      viewType, 'Tool Path', { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, retainContextWhenHidden: true, localResourceRoots: [dist] },
    );
    const address = (name: string) => panel.webview.asWebviewUri(vscode.Uri.joinPath(dist, name)).toString();
    const policy = `default-src 'none'; script-src ${panel.webview.cspSource}; style-src ${panel.webview.cspSource}; img-src data:`;
    this.isReady = false;
    panel.webview.onDidReceiveMessage((message: Message) => this.take(message));
    panel.webview.html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<link rel="stylesheet" href="${address('path_view.css')}">
</head>
<body>
<section id="tool-path" aria-label="Tool path">
  <div id="tools-bar"></div>
  <div id="stage"><canvas id="scene" tabindex="0" aria-label="Drawing of the tool path"></canvas><canvas id="marks"></canvas><div id="place"></div><div id="legend"></div></div>
  <div id="slider-bar"></div>
  <div id="tables"></div>
</section>
<script src="${address('path_view.js')}"></script>
</body>
</html>`;
    panel.onDidDispose(() => {
      this.panel = undefined;
      this.document = undefined;
      this.files = [];
    });
    this.panel = panel;
  }

  private take(message: Message): void {
    switch (message.type) {
      case 'ready':
        this.isReady = true;
        this.turn = 0;
        this.last = '';
        this.ask();
        break;
      case 'again': // what has changed does not go with what the view has
        this.last = '';
        this.ask();
        break;
      case 'shown':
        this.shown = message;
        break;
      case 'line':
        this.turn = message.turn;
        void this.goTo(message.uri, message.line);
        break;
    }
  }

  private send(message: object): void {
    void this.panel?.webview.postMessage(message);
  }

  /** Another program of the path in sight is no reason to leave it: it may be one that is called. */
  private look(document: vscode.TextDocument): void {
    if (!this.panel || !isProgram(document) || this.files.includes(document.uri.toString())) {
      return;
    }
    this.document = document;
    this.last = '';
    this.panel.title = `Tool Path: ${document.uri.path.split('/').at(-1)}`;
    this.ask();
  }

  private concerns(document: vscode.TextDocument): boolean {
    return document === this.document || this.files.includes(document.uri.toString());
  }

  private forget(why: string): void {
    this.document = undefined;
    this.files = [];
    this.send({ type: 'nothing', why });
  }

  /** Asks the server for the path as it is now; once more when something was typed meanwhile. */
  private ask(): void {
    if (this.isAsking) {
      this.asksAgain = true;
      return;
    }
    this.isAsking = true;
    // After the client has told the server of the edit.
    setTimeout(() => void this.askNow(), 0);
  }

  private async askNow(): Promise<void> {
    const { document } = this;
    const client = this.client();
    this.asksAgain = false;
    try {
      if (document && client && this.panel && this.isReady) {
        const params = { textDocument: client.code2ProtocolConverter.asTextDocumentIdentifier(document), previous: this.last, pieces: true };
        const answer = await client.sendRequest<PathAnswer | null>('ncvet/path', params);
        if (answer && document === this.document) {
          this.show(document, answer, client);
          this.asksAgain ||= answer.more === true || answer.version !== document.version;
        }
      }
    } catch (error) {
      this.last = '';
      this.send({ type: 'nothing', why: error instanceof Error ? error.message : String(error) });
    } finally {
      this.isAsking = false;
      if (this.asksAgain) {
        this.ask();
      }
    }
  }

  private show(document: vscode.TextDocument, answer: PathAnswer, client: BaseLanguageClient): void {
    this.last = answer.id;
    const files = (answer.path ?? answer.change)?.files ?? [];
    this.files = files.map((file) => client.protocol2CodeConverter.asUri(file).toString());
    if (answer.path) {
      this.send({ type: 'path', path: { ...answer.path, files: this.files }, name: document.uri.toString() });
      this.sendFindings();
    } else if (answer.change) {
      this.send({ type: 'change', change: { ...answer.change, files: this.files } });
    }
    const editor = vscode.window.visibleTextEditors.find((one) => one.document === document);
    if (editor) {
      this.sendCursor(editor);
    }
  }

  private sendFindings(): void {
    const findings = this.files.flatMap((uri) =>
      findingsOf(vscode.Uri.parse(uri)).map((finding) => ({
        path: uri, line: finding.range.start.line + 1, severity: severities[finding.severity], rule: ruleOf(finding), message: finding.message,
      })),
    );
    this.send({ type: 'findings', findings });
  }

  private sendCursor(editor: vscode.TextEditor): void {
    if (!this.panel || !this.concerns(editor.document)) {
      return;
    }
    const uri = editor.document.uri.toString();
    const line = editor.selection.active.line + 1;
    if (this.placed !== `${uri} ${line}`) {
      this.placed = '';
      this.send({ type: 'cursor', uri, line, turn: this.turn });
    }
  }

  /** The view leads the editor's cursor to a line; the view is there already. */
  private async goTo(uri: string, line: number): Promise<void> {
    this.placed = `${uri} ${line}`;
    let editor = vscode.window.visibleTextEditors.find((one) => one.document.uri.toString() === uri);
    if (!editor) {
      const beside = vscode.window.visibleTextEditors.find((one) => this.concerns(one.document));
      const document = await vscode.workspace.openTextDocument(vscode.Uri.parse(uri));
      editor = await vscode.window.showTextDocument(document, { viewColumn: beside?.viewColumn ?? vscode.ViewColumn.One, preserveFocus: true });
    }
    const last = editor.document.lineAt(Math.min(line - 1, editor.document.lineCount - 1));
    editor.selection = new vscode.Selection(last.range.start, last.range.start);
    editor.revealRange(last.range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  }
}
