// The languages that are part programs, and files that may be.
import * as vscode from 'vscode';
import { looksLikeProgram, looseEndings } from './program_text';

/** The language whose control is found out. */
export const anyControl = 'gcode';

export const isProgram = (document: vscode.TextDocument): boolean =>
  document.languageId === anyControl || document.languageId.startsWith('ncvet-');

/** The name of a file without its folders. */
export const nameOf = (uri: vscode.Uri): string => uri.path.split('/').at(-1) ?? '';

/** The languages that package.json contributes. */
export function languageIds(context: vscode.ExtensionContext): string[] {
  const contributed: { id: string }[] = context.extension.packageJSON.contributes.languages;
  return contributed.map((language) => language.id);
}

const shownLines = 200; // enough to see what a text is
const chosenKey = 'languages'; // in the state of the workspace: languages of files, by URI
const askedKey = 'asked'; // endings that the user does not want to be asked about

type Chosen = Record<string, string>;

/** Keeps the language that a file has been given: the editor itself forgets it with the text. */
async function remember(context: vscode.ExtensionContext, document: vscode.TextDocument, language: string): Promise<void> {
  const { [document.uri.toString()]: _, ...others } = context.workspaceState.get<Chosen>(chosenKey, {});
  const isOurs = language === anyControl || language.startsWith('ncvet-');
  await context.workspaceState.update(chosenKey, isOurs ? { ...others, [document.uri.toString()]: language } : others);
}

export async function chooseLanguage(context: vscode.ExtensionContext, document: vscode.TextDocument, language: string): Promise<void> {
  await remember(context, document, language);
  await vscode.languages.setTextDocumentLanguage(document, language);
}

/** The last letters of a text's name, from the point on; `` when it has none. */
const endingOf = (document: vscode.TextDocument): string => (/(?<=[^/])\.[^./]*$/.exec(document.uri.path)?.[0] ?? '').toLowerCase();

const yes = 'NC Program';
const always = (ending: string) => `Always for ${ending}`;
const never = (ending: string) => `Never for ${ending}`;

/** Makes a text that is a program one for the editor: at once when the user has said so, else after a question. */
async function offer(context: vscode.ExtensionContext, document: vscode.TextDocument): Promise<void> {
  if (document.isClosed || ['output', 'vscode', 'git', 'debug'].includes(document.uri.scheme)) {
    return;
  }
  const chosen = context.workspaceState.get<Chosen>(chosenKey, {})[document.uri.toString()];
  if (chosen && chosen !== document.languageId) {
    await vscode.languages.setTextDocumentLanguage(document, chosen);
  }
  if (chosen || isProgram(document)) {
    return;
  }
  const ending = endingOf(document);
  const asked = context.workspaceState.get<string[]>(askedKey, []);
  const mayBe = looseEndings.has(ending) || (ending === '' && document.languageId === 'plaintext');
  if (!mayBe || asked.includes(ending) || !looksLikeProgram(document.getText(new vscode.Range(0, 0, shownLines, 0)))) {
    return;
  }
  const answers = ending ? [yes, always(ending), never(ending)] : [yes];
  const name = nameOf(document.uri);
  const answer = await vscode.window.showInformationMessage(`${name} looks like an NC program. Check it as one?`, ...answers);
  if (answer === yes) {
    await chooseLanguage(context, document, anyControl);
  } else if (answer === always(ending)) {
    const files = vscode.workspace.getConfiguration('files');
    const target = vscode.workspace.workspaceFolders ? vscode.ConfigurationTarget.Workspace : vscode.ConfigurationTarget.Global;
    const associations = files.inspect<Record<string, string>>('associations');
    const own = target === vscode.ConfigurationTarget.Workspace ? associations?.workspaceValue : associations?.globalValue;
    await files.update('associations', { ...own, ['*' + ending]: anyControl }, target);
  } else if (answer === never(ending)) {
    await context.workspaceState.update(askedKey, [...asked, ending]);
  }
}

export function watchLanguages(context: vscode.ExtensionContext): void {
  // A text whose language is changed is closed and opened again at once.
  let justClosed = '';
  context.subscriptions.push(
    vscode.workspace.onDidCloseTextDocument((document) => {
      justClosed = document.uri.toString();
      setTimeout(() => (justClosed = ''), 0);
    }),
    vscode.workspace.onDidOpenTextDocument((document) => {
      if (justClosed !== document.uri.toString()) {
        return offer(context, document);
      }
      // By the user, who sees it; or by the editor, whose settings have changed.
      const isSeen = vscode.window.activeTextEditor?.document.uri.toString() === justClosed;
      return isSeen ? remember(context, document, document.languageId) : undefined;
    }),
  );
  vscode.workspace.textDocuments.forEach((document) => void offer(context, document));
}
