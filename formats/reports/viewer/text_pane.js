// The text of a program: only the lines that are seen exist.

const lineHeight = 19;
/** Browsers lay out no element that is higher than some ten million pixels. */
const greatestHeight = 8_000_000;

class TextPane {
  constructor(app) {
    this.app = app;
    this.box = byId('lines');
    this.rows = byId('rows');
    this.text = null;
    this.top = 0; // number of lines above the first one shown
    this.current = 0; // line of the slider
    this.box.addEventListener('scroll', () => this.scrolled());
    this.box.addEventListener('wheel', (event) => this.wheeled(event), { passive: false });
    this.rows.addEventListener('click', (event) => this.clicked(event));
    new ResizeObserver(() => this.draw()).observe(this.box);
  }

  show(text) {
    if (this.text === text) return;
    this.text = text;
    this.current = 0;
    this.top = 0;
    this.height = Math.min(greatestHeight, text.count * lineHeight + 8);
    byId('height').style.height = `${this.height}px`;
    this.byLine = new Map();
    for (const finding of this.app.report.findings)
      if (finding.path === text.path) {
        const list = this.byLine.get(finding.line) ?? [];
        list.push(finding);
        this.byLine.set(finding.line, list);
      }
    byId('program-title').textContent =
      text.path + (text.cut ? ' (not all of it: the text is too long for this page)' : '');
    this.box.scrollTop = 0;
    this.draw();
  }

  /** Lines that fit. */
  get seen() {
    return Math.max(1, Math.floor(this.box.clientHeight / lineHeight));
  }
  get lastTop() {
    return Math.max(0, this.text.count - this.seen);
  }
  /** Of a long text a pixel of the scroll bar is more than one line. */
  get isScaled() {
    return this.text.count * lineHeight + 8 > greatestHeight;
  }

  scrolled() {
    if (!this.text) return;
    if (this.ownScroll === this.box.scrollTop) return;
    const most = Math.max(1, this.height - this.box.clientHeight);
    this.top = this.isScaled
      ? (this.box.scrollTop / most) * this.lastTop
      : this.box.scrollTop / lineHeight;
    this.draw();
  }

  wheeled(event) {
    if (!this.text || !this.isScaled || event.ctrlKey) return;
    event.preventDefault();
    this.scrollTo(this.top + (event.deltaMode ? event.deltaY * 3 : event.deltaY / lineHeight));
  }

  scrollTo(top) {
    this.top = Math.max(0, Math.min(this.lastTop, top));
    const most = Math.max(1, this.height - this.box.clientHeight);
    this.box.scrollTop = this.isScaled
      ? (this.top / Math.max(1, this.lastTop)) * most
      : this.top * lineHeight;
    this.ownScroll = this.box.scrollTop;
    this.draw();
  }

  /** Brings a line into view. */
  reveal(line) {
    if (line - 1 < this.top + 2 || line > this.top + this.seen - 3)
      this.scrollTo(line - 1 - this.seen / 2);
    else this.draw();
  }

  setCurrent(line) {
    this.current = line;
    this.reveal(line);
  }

  draw() {
    if (!this.text || this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const first = Math.floor(this.top) + 1,
        last = Math.min(this.text.count, first + this.seen + 2);
      const rows = [];
      for (let line = first; line <= last; ++line) rows.push(this.row(line));
      this.rows.replaceChildren(...rows);
      this.rows.style.transform = `translateY(${this.box.scrollTop - (this.top % 1) * lineHeight}px)`;
    });
  }

  row(line) {
    const findings = (this.byLine.get(line) ?? []).filter(
      (finding) => this.app.isShown(finding) || finding === this.app.selected
    );
    const worst = ['error', 'warning', 'style'].find((severity) =>
      findings.some((finding) => finding.severity === severity)
    );
    const row = make('div', { className: 'row', data: { line } });
    if (line === this.current) row.classList.add('current');
    if (worst) row.classList.add(worst);
    if (this.app.step && this.app.step.path === this.text.path && this.app.step.line === line)
      row.classList.add('step');
    row.append(make('span', { className: 'number' }, String(line)), this.code(line, findings));
    for (const finding of findings.slice(0, 1))
      row.append(
        make(
          'button',
          {
            type: 'button',
            className: `hint ${finding.severity}`,
            data: { finding: this.app.report.findings.indexOf(finding) }
          },
          finding.message.replaceAll('`', '') +
            (findings.length > 1 ? ` (+${findings.length - 1})` : '')
        )
      );
    return row;
  }

  /** The line in pieces of one colour, with the words of findings underlined. */
  code(line, findings) {
    const text = this.text.line(line),
      code = make('code'),
      marks = findings.map((finding) => {
        const begin = unitOfColumn(text, finding.column);
        const end = finding.endLine > line ? text.length : unitOfColumn(text, finding.endColumn);
        return [begin, Math.max(end, begin + 1), finding.severity];
      });
    const colours = this.text.colours(line);
    const cuts = new Set([
      0,
      text.length,
      ...colours.flatMap(([begin, end]) => [begin, end]),
      ...marks.flatMap(([begin, end]) => [Math.min(begin, text.length), Math.min(end, text.length)])
    ]);
    const ordered = [...cuts].sort((a, b) => a - b);
    for (let i = 0; i + 1 < ordered.length; ++i) {
      const begin = ordered[i],
        end = ordered[i + 1];
      const colour = colours.find((piece) => piece[0] <= begin && piece[1] >= end),
        mark = marks.find((piece) => piece[0] <= begin && piece[1] >= end);
      const piece = make('span', {}, text.slice(begin, end));
      if (colour)
        piece.className = `t-${this.app.report.colours[colour[2]] ?? ''}${colour[3] ? ' definition' : ''}`;
      if (mark) piece.classList.add('mark', mark[2]);
      code.append(piece);
    }
    return code;
  }

  clicked(event) {
    const hint = event.target.closest('.hint'),
      row = event.target.closest('.row');
    if (hint) return this.app.selectFinding(this.app.report.findings[Number(hint.dataset.finding)]);
    if (row && String(window.getSelection()) === '')
      this.app.goToLine(this.text.path, Number(row.dataset.line));
  }
}
