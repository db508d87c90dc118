// What is in the program in sight, as trees: operations by tool, subprograms and their callers, findings by rule.
import * as vscode from 'vscode';
import { findingsOf, ruleOf } from './explain';
import { isProgram, nameOf } from './languages';

/** A row of a tree; its rows below it are made when it is opened. */
interface Row {
  label: string;
  description?: string;
  tooltip?: string;
  icon?: vscode.ThemeIcon;
  place?: vscode.Location;
  below?: () => Promise<Row[]> | Row[];
  open?: boolean;
}

const waitForTyping = 300; // ms

/** A tree about the program of the active editor; it stays when another text is looked at. */
abstract class ProgramTree implements vscode.TreeDataProvider<Row> {
  private readonly changed = new vscode.EventEmitter<void>();
  readonly onDidChangeTreeData = this.changed.event;
  private timer: NodeJS.Timeout | undefined;
  private asked = 0; // when rows were asked for last
  protected document: vscode.TextDocument | undefined;

  abstract rows(document: vscode.TextDocument): Promise<Row[]> | Row[];

  look(document: vscode.TextDocument | undefined): void {
    if (document && isProgram(document)) {
      this.document = document;
    } else if (this.document?.isClosed) {
      this.document = undefined;
    }
    this.renew();
  }

  hasProgram(): boolean {
    return this.document !== undefined && !this.document.isClosed;
  }

  renew(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      // The editor asks for the rows below those that it just got: those that are made anew meanwhile it does not know, and
      // it shows nothing below them.
      if (Date.now() - this.asked < waitForTyping) {
        this.renew();
      } else {
        this.changed.fire();
      }
    }, waitForTyping);
  }

  async getChildren(row?: Row): Promise<Row[]> {
    this.asked = Date.now();
    try {
      if (row) {
        return (await row.below?.()) ?? [];
      }
      return this.document && this.hasProgram() ? await this.rows(this.document) : [];
    } catch {
      return []; // the server is not there, which is told elsewhere, or the text is another one by now
    }
  }

  getTreeItem(row: Row): vscode.TreeItem {
    const { None, Collapsed, Expanded } = vscode.TreeItemCollapsibleState;
    const item = new vscode.TreeItem(row.label, !row.below ? None : row.open ? Expanded : Collapsed);
    item.description = row.description;
    item.tooltip = row.tooltip;
    item.iconPath = row.icon;
    if (row.place) {
      const options: vscode.TextDocumentShowOptions = { selection: row.place.range, preserveFocus: true };
      item.command = { title: 'Show', command: 'vscode.open', arguments: [row.place.uri, options] };
    }
    return item;
  }
}

async function symbolsOf(document: vscode.TextDocument): Promise<vscode.DocumentSymbol[]> {
  const found = await vscode.commands.executeCommand<vscode.DocumentSymbol[]>('vscode.executeDocumentSymbolProvider', document.uri);
  return found ?? [];
}

function* allOf(symbols: vscode.DocumentSymbol[]): Iterable<vscode.DocumentSymbol> {
  for (const symbol of symbols) {
    yield symbol;
    yield* allOf(symbol.children);
  }
}

/** What the server's kinds of symbols are: programs, tools, operations, subprograms. All others are no parts of a program. */
function iconOf(kind: vscode.SymbolKind): vscode.ThemeIcon | undefined {
  const { Module, Class, Event, Function } = vscode.SymbolKind;
  const names: Partial<Record<vscode.SymbolKind, string>> = {
    [Module]: 'file-code', [Class]: 'tools', [Event]: 'target', [Function]: 'symbol-method',
  };
  const name = names[kind];
  return name ? new vscode.ThemeIcon(name) : undefined;
}

class Operations extends ProgramTree {
  async rows(document: vscode.TextDocument): Promise<Row[]> {
    const shown = (symbol: vscode.DocumentSymbol): Row => ({
      label: symbol.name,
      description: symbol.detail,
      icon: iconOf(symbol.kind),
      place: new vscode.Location(document.uri, symbol.selectionRange),
      below: symbol.children.length > 0 ? () => symbol.children.map(shown) : undefined,
      open: true,
    });
    return (await symbolsOf(document)).filter((symbol) => iconOf(symbol.kind)).map(shown);
  }
}

class Subprograms extends ProgramTree {
  async rows(document: vscode.TextDocument): Promise<Row[]> {
    const programs = [...allOf(await symbolsOf(document))].filter(({ kind }) =>
      [vscode.SymbolKind.Module, vscode.SymbolKind.Function].includes(kind),
    );
    const rows = programs.map(async (symbol): Promise<Row> => {
      const [item] = await this.items(document.uri, symbol.selectionRange.start);
      const calls = item ? await this.callers(item) : [];
      return {
        label: symbol.name,
        description: calls.length > 0 ? `called by ${calls.length}` : symbol.detail,
        icon: iconOf(symbol.kind),
        place: new vscode.Location(document.uri, symbol.selectionRange),
        below: calls.length > 0 ? () => calls.flatMap((call) => this.shown(call)) : undefined,
      };
    });
    return Promise.all(rows);
  }

  private async items(uri: vscode.Uri, at: vscode.Position): Promise<vscode.CallHierarchyItem[]> {
    return (await vscode.commands.executeCommand<vscode.CallHierarchyItem[]>('vscode.prepareCallHierarchy', uri, at)) ?? [];
  }

  private async callers(item: vscode.CallHierarchyItem): Promise<vscode.CallHierarchyIncomingCall[]> {
    return (await vscode.commands.executeCommand<vscode.CallHierarchyIncomingCall[]>('vscode.provideIncomingCalls', item)) ?? [];
  }

  /** A row for each place from which a program is called, with its own callers below. */
  private shown(call: vscode.CallHierarchyIncomingCall): Row[] {
    return call.fromRanges.map((range) => ({
      label: call.from.name,
      description: `${nameOf(call.from.uri)}:${range.start.line + 1}`,
      icon: new vscode.ThemeIcon('call-incoming'),
      place: new vscode.Location(call.from.uri, range),
      below: async () => (await this.callers(call.from)).flatMap((next) => this.shown(next)),
    }));
  }
}

const severityIcons = ['error', 'warning', 'info', 'lightbulb'];
const severityIcon = (severity: vscode.DiagnosticSeverity) => new vscode.ThemeIcon(severityIcons[severity]);

/** Of all programs: findings of a called one are as important as those of the one in sight. */
class Findings extends ProgramTree {
  override async getChildren(row?: Row): Promise<Row[]> {
    return row ? super.getChildren(row) : this.rows();
  }

  rows(): Row[] {
    const byRule = new Map<string, { uri: vscode.Uri; finding: vscode.Diagnostic }[]>();
    for (const [uri] of vscode.languages.getDiagnostics()) {
      for (const finding of findingsOf(uri)) {
        const rule = ruleOf(finding);
        byRule.set(rule, [...(byRule.get(rule) ?? []), { uri, finding }]);
      }
    }
    const worst = (rule: string) => Math.min(...(byRule.get(rule) ?? []).map(({ finding }) => finding.severity));
    const rules = [...byRule.keys()].sort((a, b) => worst(a) - worst(b) || a.localeCompare(b));
    return rules.map((rule) => ({
      label: rule,
      description: String(byRule.get(rule)?.length),
      icon: severityIcon(worst(rule)),
      below: () =>
        (byRule.get(rule) ?? []).map(({ uri, finding }) => ({
          label: finding.message.split('\n')[0],
          description: `${nameOf(uri)}:${finding.range.start.line + 1}`,
          tooltip: finding.message,
          icon: severityIcon(finding.severity),
          place: new vscode.Location(uri, finding.range),
        })),
    }));
  }
}

export function registerTrees(context: vscode.ExtensionContext): void {
  const trees = { 'ncvet.operations': new Operations(), 'ncvet.subprograms': new Subprograms(), 'ncvet.findings': new Findings() };
  const all: ProgramTree[] = Object.values(trees);
  const lookAtActive = () => {
    const document = vscode.window.activeTextEditor?.document;
    all.forEach((tree) => tree.look(document));
    // Where none is in sight the views say what they are for.
    void vscode.commands.executeCommand('setContext', 'ncvet.hasProgram', trees['ncvet.operations'].hasProgram());
  };
  for (const [id, tree] of Object.entries(trees)) {
    context.subscriptions.push(vscode.window.registerTreeDataProvider(id, tree));
  }
  context.subscriptions.push(
    vscode.window.onDidChangeActiveTextEditor(lookAtActive),
    vscode.workspace.onDidCloseTextDocument(lookAtActive),
    vscode.workspace.onDidChangeTextDocument(({ document }) => isProgram(document) && all.forEach((tree) => tree.renew())),
    // Findings come after each check: callers and operations may have changed with the text as well.
    vscode.languages.onDidChangeDiagnostics(() => all.forEach((tree) => tree.renew())),
  );
  lookAtActive();
}
