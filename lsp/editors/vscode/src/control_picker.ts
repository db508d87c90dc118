// The control of the text in sight: shown in the status bar, chosen from a list, kept for a file, a folder or the workspace.
import { applyEdits, modify, parse } from 'jsonc-parser';
import * as vscode from 'vscode';
import { type Control, marksIn, readControls } from './controls';
import { anyControl, chooseLanguage, isProgram } from './languages';

/** What the server says after each check: `ncvet/control`. */
export interface ControlNotice {
  uri: string;
  dialect: string;
  title: string;
  guessed: boolean;
  sure: boolean;
  reason: string;
}

const configurationFile = '.ncvet.json';
const section = 'ncvet';
const shownLines = 200;

/** A list shows the marks of code as they are. */
function plain(text: string | undefined): string {
  return (text ?? '').replaceAll('`', '');
}

export class ControlPicker {
  private controls: Control[] = [];
  private readonly notices = new Map<string, ControlNotice>();
  private readonly item: vscode.StatusBarItem;
  private problem: string | undefined;

  constructor(private readonly context: vscode.ExtensionContext) {
    void readControls(context).then((controls) => {
      this.controls = controls;
      this.show();
    });
    this.item = vscode.window.createStatusBarItem('ncvet.control', vscode.StatusBarAlignment.Right, 99);
    this.item.name = 'ncvet: control';
    context.subscriptions.push(
      this.item,
      vscode.commands.registerCommand('ncvet.chooseControl', () => this.choose()),
      vscode.window.onDidChangeActiveTextEditor(() => this.show()),
      vscode.workspace.onDidCloseTextDocument((document) => this.notices.delete(document.uri.toString())),
    );
    this.show();
  }

  /** Takes what the server says of a document. */
  take(notice: ControlNotice, uri: vscode.Uri): void {
    this.notices.set(uri.toString(), notice);
    this.show();
  }

  /** The control of a document, as far as it is known. */
  controlOf(document: vscode.TextDocument): string | undefined {
    const named = document.languageId.startsWith('ncvet-') ? document.languageId.slice('ncvet-'.length) : undefined;
    return this.notices.get(document.uri.toString())?.dialect ?? named;
  }

  /** Says in the status bar why there is no server; undefined: there is one. */
  tellProblem(problem: string | undefined): void {
    this.problem = problem;
    this.notices.clear();
    this.show();
  }

  private shortName(id: string, title: string): string {
    return this.controls.find((control) => control.id === id)?.short ?? title;
  }

  private show(): void {
    const document = vscode.window.activeTextEditor?.document;
    const hasNames = this.controls.length > 0 || this.problem !== undefined;
    if (!document || !isProgram(document) || !hasNames) {
      this.item.hide();
      return;
    }
    const notice = this.notices.get(document.uri.toString());
    this.item.command = this.problem ? 'ncvet.restart' : 'ncvet.chooseControl';
    this.item.backgroundColor = this.problem ? new vscode.ThemeColor('statusBarItem.warningBackground') : undefined;
    if (this.problem) {
      this.item.text = '$(warning) ncvet';
      this.item.tooltip = this.problem;
    } else if (notice) {
      const name = this.shortName(notice.dialect, notice.title);
      const doubt = notice.guessed ? (notice.sure ? ' · guessed' : ' · guessed?') : '';
      this.item.text = `$(server-process) ${name}${doubt}`;
      this.item.tooltip = new vscode.MarkdownString(
        `**${notice.title}**\n\n${notice.reason}${notice.guessed ? '\n\nClick to name the control.' : ''}`,
      );
    } else {
      this.item.text = '$(server-process) Control';
      this.item.tooltip = 'The control that this program is checked for';
    }
    this.item.accessibilityInformation = { label: `Control of the machine: ${this.item.text}` };
    this.item.show();
  }

  private async choose(): Promise<void> {
    const document = vscode.window.activeTextEditor?.document;
    if (!document || !isProgram(document)) {
      await vscode.window.showInformationMessage('Open an NC program first: the control is chosen for it.');
      return;
    }
    const control = await this.pickControl(document);
    const place = control === undefined ? undefined : await this.pickPlace(document, control);
    await place?.store();
  }

  /** The id of a control, `auto`, or undefined when the user chose nothing. */
  private async pickControl(document: vscode.TextDocument): Promise<string | undefined> {
    const head = document.getText(new vscode.Range(0, 0, shownLines, 0));
    const notice = this.notices.get(document.uri.toString());
    const rows = this.controls.map((control) => ({ control, ...marksIn(control, head) }));
    rows.sort((a, b) => b.score - a.score);
    const automatic = { id: 'auto', label: '$(search) Automatic', description: 'found out from the text', detail: plain(notice?.reason) };
    const items = rows.map(({ control, reasons }) => ({
      id: control.id,
      label: control.short,
      description: control.id === notice?.dialect ? `${control.id} · now in force` : control.id,
      detail: reasons.length > 0 ? `${control.title}. In this text: ${plain(reasons.slice(0, 3).join('; '))}` : control.title,
    }));
    const options = { title: 'The control of this program', matchOnDescription: true, matchOnDetail: true };
    return (await vscode.window.showQuickPick([automatic, ...items], options))?.id;
  }

  /** Where the choice is to be kept. */
  private async pickPlace(document: vscode.TextDocument, control: string) {
    const settings = vscode.workspace.getConfiguration(section, document.uri);
    const named = settings.get<string>('dialect', 'auto');
    const file = document.uri.scheme === 'file' ? await nearestConfiguration(document.uri) : undefined;
    const inFile = file?.dialect && file.dialect !== 'auto' ? `${vscode.workspace.asRelativePath(file.uri)} names ${file.dialect}` : '';
    const bySetting = named !== 'auto' && named !== '' ? `the setting ncvet.dialect names ${named}` : '';
    const counts = (...reasons: string[]) => {
      const reason = reasons.find((one) => one !== '');
      return reason ? `has no effect while ${reason}` : undefined;
    };
    const language = control === 'auto' ? anyControl : `ncvet-${control}`;
    const places = [
      {
        label: '$(file) This file', description: `language mode ${language}`, detail: counts(bySetting, inFile),
        store: () => chooseLanguage(this.context, document, language),
      },
    ];
    if (file) {
      places.push({
        label: '$(folder) This folder', description: vscode.workspace.asRelativePath(file.uri), detail: counts(bySetting),
        store: () => writeConfiguration(file.uri, control),
      });
    }
    const hasWorkspace = vscode.workspace.workspaceFolders !== undefined;
    const target = hasWorkspace ? vscode.ConfigurationTarget.Workspace : vscode.ConfigurationTarget.Global;
    places.push({
      label: hasWorkspace ? '$(root-folder) This workspace' : '$(account) All programs', description: 'setting ncvet.dialect', detail: undefined,
      store: async () => await settings.update('dialect', control === 'auto' ? undefined : control, target),
    });
    return vscode.window.showQuickPick(places, { title: 'Keep this choice for' });
  }
}

/** The configuration that counts for a file: the nearest one up to the workspace's folder, else one that is not there yet. */
async function nearestConfiguration(file: vscode.Uri): Promise<{ uri: vscode.Uri; dialect?: string }> {
  const root = vscode.workspace.getWorkspaceFolder(file)?.uri.path;
  const folder = vscode.Uri.joinPath(file, '..');
  for (let at = folder; ; at = vscode.Uri.joinPath(at, '..')) {
    const uri = vscode.Uri.joinPath(at, configurationFile);
    try {
      const text = new TextDecoder().decode(await vscode.workspace.fs.readFile(uri));
      return { uri, dialect: parse(text)?.dialect };
    } catch {
      // there is none here
    }
    if (!root || at.path === root || at.path === '/' || !at.path.startsWith(root)) {
      return { uri: vscode.Uri.joinPath(folder, configurationFile) };
    }
  }
}

/** Writes the control into a configuration; all else in it stays as it is. */
async function writeConfiguration(uri: vscode.Uri, control: string): Promise<void> {
  let text = '{}\n';
  try {
    text = (await vscode.workspace.openTextDocument(uri)).getText();
  } catch {
    // it is new
  }
  const value = control === 'auto' ? undefined : control;
  const edits = modify(text, ['dialect'], value, { formattingOptions: { insertSpaces: true, tabSize: 2, eol: '\n' } });
  await vscode.workspace.fs.writeFile(uri, new TextEncoder().encode(applyEdits(text, edits)));
}
