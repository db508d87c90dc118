// What is different where the editor runs on a computer, and where it runs in a browser.
import type * as vscode from 'vscode';
import type { QuietClient } from './client';
import type { ControlPicker } from './control_picker';

export interface Platform {
  /** A client of a server that has not started yet; or why there is none. */
  makeClient(context: vscode.ExtensionContext, languages: string[], picker: ControlPicker): Promise<QuietClient | { problem: string }>;
  /** The bytes of a page that the server has written. */
  readPage(page: vscode.Uri): Thenable<Uint8Array>;
  registerDryRun(context: vscode.ExtensionContext, controlOf: (document: vscode.TextDocument) => string | undefined): void;
  /** A client was stopped, and with it its server. */
  stopped?(): void;
}
