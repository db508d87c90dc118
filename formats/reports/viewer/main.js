// The page as a whole: what is selected, and how the panes follow each other.

let app = null;

class App {
  constructor() {
    this.report = takeJson('report');
    this.texts = new Map(); // by path, as far as they were shown
    this.paths = new Map(); // by index of the text
    this.selected = null; // finding
    this.step = null; // place that explains it
    this.stepIndex = -1;
    this.path = null;
    this.measures = null;
    this.wantsFlat = location.hash === '#2d';
    this.readTheme();
  }

  start() {
    this.list = new FindingList(this);
    this.textPane = new TextPane(this);
    this.pathPane = new PathPane(this);
    this.tables = new Tables(this);
    const hasPath = this.report.texts.some((_, i) => byId(`path-${i}`));
    document.body.classList.toggle('no-path', !hasPath);
    // A page round this one may have the text and the findings itself.
    document.body.classList.toggle('path-alone', hasPath && location.hash === '#tool-path');
    this.drawFiles();
    this.list.draw();
    this.listen();
    const { files, findings, notifications } = this.report;
    const places = files.length === 1 ? files[0].path : `${files.length} files`;
    document.title = `${places} · ncvet`;
    byId('summary').textContent =
      `${this.report.tool.version} · ${places}${files.some((file) => !file.complete) ? ' · an analysis was cut short' : ''}`;
    for (const notification of notifications)
      byId('files').append(make('li', { className: 'problem' }, notification.message));
    const first = findings[0]?.path ?? files[0]?.path ?? this.report.texts[0];
    if (first !== undefined) this.showFile(first);
    if (findings.length) this.selectFinding(findings[0]);
  }

  // ---- files

  textOf(path) {
    if (!this.texts.has(path)) {
      const index = this.report.texts.indexOf(path),
        json = index < 0 ? null : takeJson(`text-${index}`);
      this.texts.set(path, json && new ProgramText(path, json));
    }
    return this.texts.get(path);
  }

  showFile(path) {
    const text = this.textOf(path);
    if (!text) return false;
    this.textPane.show(text);
    for (const item of byId('files').children)
      item.classList.toggle('selected', item.dataset.path === path);
    // A subprogram is shown on the path of the program that called it.
    if (
      !this.path ||
      ((!this.path.json.files.includes(path) || this.hasPath(path)) &&
        this.path.json.files[0] !== path)
    )
      this.showPathOf(path);
    return true;
  }

  hasPath(path) {
    const index = this.report.texts.indexOf(path);
    return this.paths.has(index) || Boolean(byId(`path-${index}`));
  }

  showPathOf(path) {
    const index = this.report.texts.indexOf(path);
    if (!this.paths.has(index)) {
      const json = takeJson(`path-${index}`);
      this.paths.set(index, json && json.programmed.count ? new ToolPath(json) : null);
    }
    const toolPath = this.paths.get(index);
    if (toolPath === this.path && toolPath) return;
    this.path = toolPath;
    this.measures =
      toolPath && measure(toolPath, (toolPath.basis ??= timeBasis(toolPath.json.machine)));
    this.pathPane.show(toolPath, false);
    this.tables.draw();
  }

  setBasis(basis) {
    this.path.basis = basis;
    this.measures = measure(this.path, basis);
    this.tables.draw();
    this.pathPane.tellPlace();
  }

  drawFiles() {
    const counts = new Map();
    for (const finding of this.report.findings) {
      const of = counts.get(finding.path) ?? { error: 0, warning: 0, style: 0 };
      ++of[finding.severity];
      counts.set(finding.path, of);
    }
    const about = new Map(this.report.files.map((file) => [file.path, file]));
    byId('files').replaceChildren(
      ...this.report.texts.map((path) => {
        const file = about.get(path),
          of = counts.get(path);
        return make(
          'li',
          {
            data: { path },
            title: file
              ? `${file.dialect}${file.guessed ? `, guessed: ${file.reason}` : ''}, ${file.blocks} blocks`
              : 'called from the others'
          },
          make('button', { type: 'button', onclick: () => this.showFile(path) }, path),
          ...['error', 'warning', 'style']
            .filter((severity) => of?.[severity])
            .map((severity) =>
              make('span', { className: `count ${severity}` }, String(of[severity]))
            ),
          file ? make('small', {}, `${file.dialect}${file.guessed ? ' (guessed)' : ''}`) : null
        );
      })
    );
  }

  // ---- what is selected

  isShown(finding) {
    return this.list.lets(finding);
  }

  filtersChanged() {
    this.list.draw();
    this.textPane.draw();
    this.pathPane.refresh();
  }

  selectFinding(finding) {
    this.selected = finding;
    this.stepIndex = -1;
    this.step = null;
    this.goToLine(finding.path, finding.line);
    this.list.draw();
    drawDetail(this);
  }

  /** Shows one of the places that explain the finding. */
  goToStep(index) {
    const steps = stepsOf(this.selected);
    this.stepIndex = (index + steps.length) % steps.length;
    this.step = steps[this.stepIndex];
    this.goToLine(this.step.path, this.step.line);
    drawDetail(this);
  }

  /** Text and slider go to a line. `keepMove`: the text alone. */
  goToLine(path, line, keepMove = false) {
    if (!this.showFile(path)) return;
    this.textPane.setCurrent(line);
    const file = this.path ? this.path.json.files.indexOf(path) : -1;
    if (file < 0 || keepMove) return this.pathPane.refresh();
    const move = this.path.moveOfLine(file, line);
    if (move < 0) return;
    const end = this.path.endOfBlock(this.path.blockOf(move));
    this.pathPane.dims = false;
    this.pathPane.reveal(end);
    this.pathPane.goTo(end);
  }

  /** The text follows the slider. */
  followMove(move) {
    if (move < 0 || !this.path) return;
    const path = this.path.json.files[this.path.curve.fileOf(move)];
    const text = this.textOf(path);
    if (!text) return;
    this.textPane.show(text);
    this.textPane.setCurrent(this.path.curve.line[move]);
  }

  // ---- theme, keys, print

  /** The theme that was chosen, else the system's. */
  readTheme() {
    let kept = null;
    try {
      kept = localStorage.getItem('ncvet-theme');
    } catch {
      /* a page of a file may have no storage */
    }
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const use = (theme) => {
      document.documentElement.dataset.theme = theme;
    };
    use(kept ?? (dark.matches ? 'dark' : 'light'));
    if (kept) return;
    dark.addEventListener('change', () => {
      use(dark.matches ? 'dark' : 'light');
      this.recolour();
    });
  }

  isDark() {
    return document.documentElement.dataset.theme === 'dark';
  }

  toggleTheme() {
    const theme = this.isDark() ? 'light' : 'dark';
    document.documentElement.dataset.theme = theme;
    try {
      localStorage.setItem('ncvet-theme', theme);
    } catch {
      /* as above */
    }
    this.recolour();
  }

  recolour() {
    this.pathPane.usePalette();
    fillLegend(this.pathPane);
    this.tables.draw();
    this.pathPane.refresh();
  }

  listen() {
    byId('theme').addEventListener('click', () => this.toggleTheme());
    byId('print').addEventListener('click', () => window.print());
    byId('help-button').addEventListener('click', () => showKeys());
    window.addEventListener('beforeprint', () => fillPrint(this));
    document.addEventListener('keydown', (event) => this.key(event));
  }

  key(event) {
    const isTyping = event.target.closest('input[type=search], input[type=number], select');
    if (event.key === 'Escape') {
      byId('keys').hidden = true;
      event.target.blur?.();
      return;
    }
    if (isTyping || event.ctrlKey || event.metaKey || event.altKey) return;
    const name = event.key === ' ' ? 'space' : event.key,
      action = keyActions[event.shiftKey && name.startsWith('Arrow') ? `Shift+${name}` : name];
    if (!action || (name === 'space' && event.target.closest('button, input'))) return;
    event.preventDefault();
    action[1](this);
  }
}

const keyActions = {
  n: [
    'next finding',
    (app) => {
      const next = app.list.neighbour(1);
      if (next) app.selectFinding(next);
    }
  ],
  p: [
    'finding before',
    (app) => {
      const next = app.list.neighbour(-1);
      if (next) app.selectFinding(next);
    }
  ],
  ']': [
    'next place of the finding',
    (app) => {
      if (app.selected) app.goToStep(app.stepIndex + 1);
    }
  ],
  '[': [
    'place before',
    (app) => {
      if (app.selected) app.goToStep(app.stepIndex < 0 ? -1 : app.stepIndex - 1);
    }
  ],
  e: ['errors on or off', (app) => app.list.toggle('error')],
  w: ['warnings on or off', (app) => app.list.toggle('warning')],
  s: ['style on or off', (app) => app.list.toggle('style')],
  '/': ['search', () => byId('search').focus()],
  ArrowRight: ['next block', (app) => app.pathPane.stepBlock(1)],
  ArrowLeft: ['block before', (app) => app.pathPane.stepBlock(-1)],
  'Shift+ArrowRight': ['next move of a block', (app) => app.pathPane.stepMove(1)],
  'Shift+ArrowLeft': ['move before', (app) => app.pathPane.stepMove(-1)],
  Home: ['begin of the program', (app) => app.pathPane.goToBlock(-1)],
  End: [
    'end of the program',
    (app) => app.path && app.pathPane.goToBlock(app.path.blocks.length - 1)
  ],
  space: ['run, or stop', (app) => app.pathPane.play()],
  f: [
    'show all of the path',
    (app) => {
      app.pathPane.range = null;
      app.pathPane.fit();
    }
  ],
  1: ['views', (app) => pressView(app, 0)],
  2: ['', (app) => pressView(app, 1)],
  3: ['', (app) => pressView(app, 2)],
  4: ['', (app) => pressView(app, 3)],
  '+': [
    'closer',
    (app) => {
      app.pathPane.camera.zoom(1.25, 0, 0);
      app.pathPane.refresh(true);
    }
  ],
  '-': [
    'further away',
    (app) => {
      app.pathPane.camera.zoom(0.8, 0, 0);
      app.pathPane.refresh(true);
    }
  ],
  t: ['light or dark', (app) => app.toggleTheme()],
  '?': ['these keys', () => showKeys()]
};

function pressView(app, i) {
  if (app.path)
    (app.path.isLathe ? app.pathPane.viewsOfLathe : app.pathPane.viewsOfMill)[i]?.click();
}

function showKeys() {
  const names = {
    ArrowRight: '→',
    ArrowLeft: '←',
    'Shift+ArrowRight': 'Shift →',
    'Shift+ArrowLeft': 'Shift ←',
    1: '1 2 3 4'
  };
  const keys = byId('keys');
  keys.replaceChildren(
    make('h3', {}, 'Keys'),
    make(
      'dl',
      {},
      Object.entries(keyActions)
        .filter(([, [label]]) => label)
        .flatMap(([key, [label]]) => [make('dt', {}, names[key] ?? key), make('dd', {}, label)])
    ),
    make(
      'p',
      {},
      'Drawing: drag turns, Shift or the right button moves, the wheel zooms, a click goes to the block, a double click shows all.'
    )
  );
  keys.hidden = !keys.hidden;
  keys.onclick = () => {
    keys.hidden = true;
  };
}

/** Findings that are printed: a longer list is nothing for paper. */
const mostPrinted = 2000;

function fillPrint(app) {
  const shown = app.list.shown(),
    parts = [make('h1', {}, document.title)];
  if (app.path) {
    app.pathPane.isMoving = false;
    app.pathPane.draw();
    parts.push(make('img', { src: app.pathPane.canvas.toDataURL('image/png'), alt: 'Tool path' }));
    parts.push(...app.tables.summary(), make('h2', {}, 'Tools'), app.tables.tools());
  }
  parts.push(make('h2', {}, byId('findings-title').textContent));
  parts.push(
    table(
      ['place', 'severity', 'finding', 'rule'],
      shown
        .slice(0, mostPrinted)
        .map((finding) => [
          `${finding.path}:${finding.line}:${finding.column}`,
          finding.severity,
          finding.message,
          finding.rule
        ])
    )
  );
  if (shown.length > mostPrinted)
    parts.push(make('p', {}, `and ${shown.length - mostPrinted} more`));
  byId('report-print').replaceChildren(...parts);
}

function start() {
  app = new App();
  window.ncvet = app; // for tests and for the curious
  app.start();
}
