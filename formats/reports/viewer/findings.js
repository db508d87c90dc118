// The list of findings with its filters, and the one that is looked at.

/** Findings in the list at once: more are found by the filters. */
const mostListed = 500;

class FindingList {
  constructor(app) {
    this.app = app;
    this.severities = new Set(['error', 'warning', 'style']);
    this.rule = '';
    this.words = '';
    this.buildFilters();
    byId('findings').addEventListener('click', (event) => {
      const item = event.target.closest('li');
      if (item?.dataset.finding)
        app.selectFinding(app.report.findings[Number(item.dataset.finding)]);
    });
  }

  buildFilters() {
    const { findings } = this.app.report;
    const count = (severity) => findings.filter((finding) => finding.severity === severity).length;
    for (const severity of ['error', 'warning', 'style']) {
      const button = make(
        'button',
        {
          type: 'button',
          className: `level ${severity}`,
          ariaPressed: 'true',
          title: `Show or hide (${severity[0]})`,
          data: { severity },
          onclick: () => this.toggle(severity)
        },
        `${count(severity)} ${severity}${severity !== 'style' && count(severity) !== 1 ? 's' : ''}`
      );
      byId('levels').append(button);
    }
    const rules = new Map();
    for (const finding of findings) rules.set(finding.rule, (rules.get(finding.rule) ?? 0) + 1);
    for (const [rule, times] of [...rules].sort())
      byId('rule').append(make('option', { value: rule }, `${rule} (${times})`));
    byId('rule').addEventListener('change', () => {
      this.rule = byId('rule').value;
      this.app.filtersChanged();
    });
    byId('search').addEventListener('input', () => {
      this.words = byId('search').value.trim().toLowerCase();
      this.app.filtersChanged();
    });
  }

  toggle(severity) {
    if (!this.severities.delete(severity)) this.severities.add(severity);
    for (const button of byId('levels').children)
      button.ariaPressed = String(this.severities.has(button.dataset.severity));
    this.app.filtersChanged();
  }

  /** Whether the filters let a finding through. */
  lets(finding) {
    return (
      this.severities.has(finding.severity) &&
      (!this.rule || finding.rule === this.rule) &&
      (!this.words ||
        `${finding.path}:${finding.line} ${finding.message} ${finding.rule}`
          .toLowerCase()
          .includes(this.words))
    );
  }

  shown() {
    return this.app.report.findings.filter((finding) => this.lets(finding));
  }

  draw() {
    const { report } = this.app,
      shown = this.shown();
    const title =
      shown.length === report.findings.length
        ? `${shown.length} findings`
        : `${shown.length} of ${report.findings.length} findings`;
    byId('findings-title').textContent =
      report.findings.length === 1 ? title.replace(/findings$/, 'finding') : title;
    const items = [];
    let path = null;
    for (const finding of shown.slice(0, mostListed)) {
      if (finding.path !== path && report.texts.length > 1)
        items.push(make('li', { className: 'file' }, finding.path));
      path = finding.path;
      items.push(
        make(
          'li',
          {
            className: `${finding.severity}${finding === this.app.selected ? ' selected' : ''}`,
            data: { finding: report.findings.indexOf(finding) }
          },
          make('span', { className: 'place' }, `${finding.line}:${finding.column}`),
          make('span', { className: 'message' }, ...withCode(finding.message)),
          make(
            'span',
            { className: 'rule' },
            finding.rule + (finding.certainty === 'possible' ? ' · possible' : '')
          )
        )
      );
    }
    if (shown.length > mostListed)
      items.push(
        make('li', { className: 'file' }, `${shown.length - mostListed} more: narrow the filters`)
      );
    if (!report.findings.length)
      items.push(make('li', { className: 'file' }, 'Nothing was found.'));
    byId('findings').replaceChildren(...items);
    byId('findings').querySelector('.selected')?.scrollIntoView({ block: 'nearest' });
  }

  /** The finding before or after the selected one. */
  neighbour(by) {
    const shown = this.shown();
    if (!shown.length) return null;
    const at = shown.indexOf(this.app.selected);
    return shown[
      at < 0 ? (by > 0 ? 0 : shown.length - 1) : (at + by + shown.length) % shown.length
    ];
  }
}

/** The places that explain a finding, in the order in which the control comes to them. */
function stepsOf(finding) {
  return [
    ...finding.trace.map((step) => ({ ...step, kind: 'path' })),
    ...finding.related.map((note) => ({ ...note, kind: 'note' })),
    { path: finding.path, line: finding.line, message: 'the finding', kind: 'finding' }
  ];
}

function drawDetail(app) {
  const finding = app.selected,
    detail = byId('detail');
  if (!finding) return detail.replaceChildren();
  const steps = stepsOf(finding);
  const places = make(
    'ol',
    { className: 'steps' },
    steps.map((step, i) =>
      make(
        'li',
        { className: step.kind + (i === app.stepIndex ? ' here' : '') },
        make(
          'button',
          { type: 'button', onclick: () => app.goToStep(i) },
          `${step.path === finding.path ? '' : `${step.path}:`}${step.line}`
        ),
        make('span', {}, ...withCode(step.message))
      )
    )
  );
  detail.replaceChildren(
    make(
      'h3',
      { className: finding.severity },
      make('span', { className: 'level' }, finding.severity),
      ' ',
      ...withCode(finding.message)
    ),
    make(
      'p',
      { className: 'rule' },
      make('b', {}, finding.rule),
      ' · ',
      finding.certainty === 'definite' ? 'on every path' : 'on some path',
      app.report.rules[finding.rule] ? ` · ${app.report.rules[finding.rule]}` : '',
      ` · ncvet explain ${finding.rule}`
    ),
    ...(steps.length > 1 ? [places] : []),
    ...(finding.fix ? [drawFix(finding.fix)] : [])
  );
}

function drawFix(fix) {
  const edits = fix.edits.slice(0, 8).map((edit) => {
    const isInsert = edit.line === edit.endLine && edit.column === edit.endColumn;
    const what = edit.text === '' ? 'delete' : isInsert ? 'insert' : 'write';
    return make(
      'li',
      {},
      `line ${edit.line}, column ${edit.column}: ${what} `,
      edit.text === ''
        ? `to ${edit.endLine}:${edit.endColumn}`
        : make('code', {}, edit.text.replace(/\n$/, ''))
    );
  });
  return make(
    'div',
    { className: 'fix' },
    make('b', {}, `Fix (${fix.safety})`),
    ': ',
    ...withCode(fix.description),
    make('ul', {}, edits)
  );
}
