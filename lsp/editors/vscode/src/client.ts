// The client of the server, wherever that runs: what it tells the server of the editor, and what it makes of the server's answers.
import * as vscode from 'vscode';
import type {
  BaseLanguageClient, ClientCapabilities, FeatureState, LanguageClientOptions, MessageSignature, StaticFeature,
} from 'vscode-languageclient';
import type { ControlNotice, ControlPicker } from './control_picker';
import { documentOf, isPage, showPage } from './explain';

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

export interface QuietClient extends BaseLanguageClient {
  /** It runs: what fails from now on is told as others tell it. */
  started: boolean;
}

/**
 * Makes a client say little. Why it did not start is told, once, by whoever has started it. A request that fails is a line in
 * the output: the text has changed or was closed meanwhile, and what the user asked for himself the editor tells anyway.
 */
function quiet(client: BaseLanguageClient): QuietClient {
  const made = Object.assign(client, { started: false });
  const error = client.error.bind(client);
  const failed = client.handleFailedRequest.bind(client);
  client.error = (message, data, showNotification) => error(message, data, made.started ? showNotification : false);
  client.handleFailedRequest = <T>(type: MessageSignature, token: vscode.CancellationToken | undefined, reason: unknown, otherwise: T): T =>
    failed(type, token, reason, otherwise, false);
  return made;
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

/** `schemes`: where the texts are that the server sees; none: all. */
export function clientOptions(languages: string[], schemes: string[]): LanguageClientOptions {
  const places = schemes.length > 0 ? schemes.map((scheme) => ({ scheme })) : [{}];
  return {
    documentSelector: languages.flatMap((language) => places.map((place) => ({ ...place, language }))),
    // Without the functions that the editor puts beside the settings: a worker cannot be sent them.
    initializationOptions: JSON.parse(JSON.stringify(vscode.workspace.getConfiguration(section))),
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
}

/** What every client takes from the server beside the protocol. */
export function bindClient(client: BaseLanguageClient, picker: ControlPicker): QuietClient {
  client.registerFeature(new ControlFeature());
  client.onNotification('ncvet/control', (notice: ControlNotice) => picker.take(notice, client.protocol2CodeConverter.asUri(notice.uri)));
  return quiet(client);
}
