// The path of the program in the editor beside: it follows what is typed, and both cursors follow each other.

/** Milliseconds after an edit until sums, tables and lists of layers are made anew. */
const waitForTyping = 400;
/** Findings whose marks are drawn. */
const mostMarks = 5000;

const host = acquireVsCodeApi();

class LiveApp {
  constructor() {
    this.report = { findings: [] };
    this.selected = null;
    this.path = null;
    this.measures = null;
    this.wantsFlat = false;
    this.turn = 0; // times that the view has led the editor
    this.readTheme();
  }

  start() {
    this.pathPane = new PathPane(this);
    this.tables = new Tables(this);
    this.pathPane.show(null, false);
    addEventListener('message', ({ data }) => this[`take_${data.type}`]?.(data));
    document.addEventListener('keydown', (event) => this.key(event));
    new MutationObserver(() => {
      this.readTheme();
      this.recolour();
    }).observe(document.body, { attributes: true, attributeFilter: ['class'] });
    host.postMessage({ type: 'ready' });
  }

  // ---- what comes from the editor

  /** A whole path. */
  take_path({ path, name }) {
    document.title = name;
    const isSame = this.name === name && this.path !== null && this.path.isLathe === (path.machineKind === 'lathe');
    this.name = name;
    const made = path.programmed.count ? new ToolPath(path) : null;
    const move = this.pathPane.move;
    this.path = made;
    this.measure();
    this.pathPane.show(made, isSame && made !== null);
    if (isSame && made) this.pathPane.move = Math.min(move, made.curve.count - 1);
    this.tables.draw();
    this.placeFindings();
    this.told('path');
  }

  /** What an edit has made of it. */
  take_change({ change }) {
    const { path, pathPane } = this,
      start = performance.now();
    const done = path && splicePath(path, pathPane.curves, change);
    if (!done) return host.postMessage({ type: 'again' });
    uploadChange(pathPane.scene, pathPane.curves, done);
    const { first, removed } = change.programmed,
      by = path.curve.count - pathPane.count;
    if (pathPane.move >= first + removed) pathPane.move += by;
    pathPane.move = Math.min(pathPane.move, path.curve.count - 1);
    pathPane.count = path.curve.count;
    pathPane.slider.max = path.blocks.length;
    pathPane.range = null;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.settle(), waitForTyping);
    pathPane.tellPlace();
    pathPane.refresh(true);
    this.placeFindings();
    this.took = performance.now() - start;
    this.told('change');
  }

  take_findings({ findings }) {
    this.report.findings = findings.slice(0, mostMarks);
    this.placeFindings();
  }

  /** The cursor of the editor is in a line. What was sent before the editor knew where the view has led it is old. */
  take_cursor({ uri, line, turn = this.turn }) {
    if (turn < this.turn) return;
    this.cursor = { uri, line };
    this.followCursor();
  }

  take_nothing({ why }) {
    this.path = null;
    this.pathPane.show(null, false);
    this.tables.draw();
    byId('stage').dataset.why = why;
    this.told('nothing');
  }

  told(what) {
    const { path } = this;
    if (path) this.pathPane.count = path.curve.count;
    host.postMessage({ type: 'shown', what, moves: path ? path.curve.count : 0, took: this.took ?? 0 });
  }

  // ---- what is shown

  measure() {
    const { path } = this;
    this.measures = path && measure(path, (path.basis ??= timeBasis(path.json.machine)));
  }

  /** Typing has paused. */
  settle() {
    if (!this.path) return;
    recount(this.path);
    this.measure();
    this.pathPane.fillBar();
    fillLegend(this.pathPane);
    this.pathPane.tellPlace();
    this.tables.draw();
    this.pathPane.refresh();
  }

  placeFindings() {
    if (this.path) this.path.placed = null;
    this.pathPane.refresh();
  }

  followCursor() {
    const { path, cursor, pathPane } = this;
    if (!path || !cursor) return;
    const file = path.json.files.indexOf(cursor.uri);
    const move = file < 0 ? -1 : path.moveOfLine(file, cursor.line);
    if (move < 0) return;
    const end = path.endOfBlock(path.blockOf(move));
    pathPane.dims = false;
    pathPane.reveal(end);
    pathPane.goTo(end);
  }

  setBasis(basis) {
    this.path.basis = basis;
    this.settle();
  }

  // ---- what the user does here

  /** The editor follows the slider. */
  followMove(move) {
    if (move < 0 || !this.path) return;
    const { curve, json } = this.path;
    this.goTo(json.files[curve.fileOf(move)], curve.line[move]);
  }

  /** Rows of the tables lead to their lines. */
  goToLine(uri, line) {
    this.take_cursor({ uri, line });
    this.goTo(uri, line);
  }

  goTo(uri, line) {
    host.postMessage({ type: 'line', uri, line, turn: ++this.turn });
  }

  selectFinding(finding) {
    this.selected = finding;
    this.goToLine(finding.path, finding.line);
  }

  isShown() {
    return true;
  }

  // ---- theme, keys

  isDark() {
    return document.documentElement.dataset.theme === 'dark';
  }

  readTheme() {
    const { classList } = document.body;
    const isLight = classList.contains('vscode-light') || classList.contains('vscode-high-contrast-light');
    document.documentElement.dataset.theme = isLight ? 'light' : 'dark';
  }

  recolour() {
    this.pathPane.usePalette();
    fillLegend(this.pathPane);
    this.tables.draw();
    this.pathPane.refresh();
  }

  key(event) {
    if (event.target.closest('input, select') || event.ctrlKey || event.metaKey || event.altKey) return;
    const { pathPane } = this,
      by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (by && event.shiftKey) pathPane.stepMove(by);
    else if (by) pathPane.stepBlock(by);
    else if (event.key === ' ' && !event.target.closest('button')) pathPane.play();
    else if (event.key === 'f') pathPane.isolate(null);
    else return;
    event.preventDefault();
  }
}

const app = new LiveApp();
app.start();
