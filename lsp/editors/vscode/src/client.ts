// The client of the server: what it tells the server of the editor, and what it makes of the server's answers.
import * as vscode from 'vscode';
import {
  type ClientCapabilities, type FeatureState, LanguageClient, type LanguageClientOptions, type MessageSignature, type ServerOptions, type StaticFeature,
  TransportKind,
} from 'vscode-languageclient/node';
import type { ControlNotice, ControlPicker } from './control_picker';
import { documentOf, isPage, showPage } from './explain';
import type { Server } from './server_path';

export const section = 'ncvet';

/** Asks the server for `ncvet/control` after each check. */
class ControlFeature implements StaticFeature {
  fillClientCapabilities(capabilities: ClientCapabilities): void {
    capabilities.experimental = { ...(capabilities.experimental as object), ncvet: { control: true } };
  }
  initialize(): void {}
  getState(): FeatureState {
    return { kind: 'static' };
  }
  clear(): void {}
}

/**
 * Why it did not start is told, once, by whoever has started it. A request that fails is a line in the output: the text has
 * changed or was closed meanwhile, and what the user asked for himself the editor tells anyway.
 */
class QuietClient extends LanguageClient {
  started = false;
  override error(message: string, data?: unknown, showNotification?: boolean | 'force'): void {
    super.error(message, data, this.started ? showNotification : false);
  }
  override handleFailedRequest<T>(type: MessageSignature, token: vscode.CancellationToken | undefined, error: unknown, otherwise: T): T {
    return super.handleFailedRequest(type, token, error, otherwise, false);
  }
}

/** The link of a finding opens the page of its rule as one that cannot be edited. */
function withPages(findings: vscode.Diagnostic[]): vscode.Diagnostic[] {
  for (const finding of findings) {
    if (typeof finding.code === 'object' && isPage(finding.code.target)) {
      finding.code = { value: finding.code.value, target: documentOf(finding.code.target) };
    }
  }
  return findings;
}

export function makeClient({ file, needsNode }: Server, languages: string[], picker: ControlPicker): QuietClient {
  const server: ServerOptions = needsNode
    ? { module: file, args: ['lsp'], transport: TransportKind.stdio }
    : { command: file, args: ['lsp'] };
  const options: LanguageClientOptions = {
    documentSelector: languages.flatMap((language) => [
      { scheme: 'file', language },
      { scheme: 'untitled', language },
    ]),
    initializationOptions: vscode.workspace.getConfiguration(section),
    // The server asks for the section again when it is told that something changed.
    synchronize: { configurationSection: section },
    middleware: {
      handleDiagnostics: (uri, findings, next) => next(uri, withPages(findings)),
      provideDiagnostics: async (document, previous, token, next) => {
        const report = await next(document, previous, token);
        if (report?.kind === 'full') {
          withPages(report.items as vscode.Diagnostic[]);
        }
        return report;
      },
      window: {
        showDocument: async (params, token, next) => {
          const uri = vscode.Uri.parse(params.uri);
          if (!isPage(uri)) {
            return next(params, token);
          }
          await showPage(uri);
          return { success: true };
        },
      },
    },
  };
  const client = new QuietClient(section, 'ncvet', server, options);
  client.registerFeature(new ControlFeature());
  client.onNotification('ncvet/control', (notice: ControlNotice) => picker.take(notice));
  return client;
}

export type { QuietClient };
