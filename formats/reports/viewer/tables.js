// What the path amounts to: extents, distances, times, tools, operations.

class Tables {
  constructor(app) {
    this.app = app;
    this.tab = 'summary';
    this.tabs = make(
      'div',
      { className: 'tabs', role: 'tablist' },
      ...[
        ['summary', 'Summary'],
        ['tools', 'Tools'],
        ['operations', 'Operations']
      ].map(([name, label]) =>
        make(
          'button',
          {
            type: 'button',
            role: 'tab',
            data: { tab: name },
            onclick: () => {
              this.tab = name;
              this.draw();
            }
          },
          label
        )
      )
    );
    this.body = make('div', { className: 'table-body' });
    byId('tables').append(this.tabs, this.body);
  }

  draw() {
    const { path } = this.app;
    if (!path) return this.body.replaceChildren();
    for (const button of this.tabs.children)
      button.ariaSelected = String(button.dataset.tab === this.tab);
    this.body.replaceChildren(
      ...{
        summary: () => this.summary(),
        tools: () => [this.tools()],
        operations: () => [this.operations()]
      }[this.tab]()
    );
  }

  summary() {
    const { app } = this,
      { path, measures } = app,
      { basis, sums, lengths, extents } = measures;
    const axes = axesOf(path, measures);
    const extent = (box, axis) =>
      range([coordinate(path, axis, box.min[axis]), coordinate(path, axis, box.max[axis])]) || '–';
    const extentTable = table(
      ['', ...axes.map((axis) => axisName(path, axis))],
      [
        ['cuts', ...axes.map((axis) => extent(extents.feed, axis))],
        ['rapids', ...axes.map((axis) => extent(extents.rapid, axis))]
      ]
    );
    const timeTable = table(
      ['', 'distance', 'time'],
      [
        ['feeds', lengthText(lengths.feed), clock(sums.feed)],
        ['rapids', lengthText(lengths.rapid), clock(sums.rapid)],
        ['dwell', '', sums.dwell ? clock(sums.dwell) : '–'],
        ['tool changes', '', sums.toolChange ? clock(sums.toolChange) : '–'],
        ['all', lengthText(lengths.feed + lengths.rapid), clock(measures.total)]
      ]
    );
    timeTable.classList.add('sums');
    const says = endTexts(path, measures).map((text) => make('p', { className: 'says' }, text));
    return [
      ...says,
      make('div', { className: 'columns' }, extentTable, timeTable, this.basisForm(basis))
    ];
  }

  /** The values that times are made of can be tried out. */
  basisForm(basis) {
    const { app } = this;
    const field = (key, label, unit, isAssumed) => {
      const input = make('input', {
        type: 'number',
        min: 0,
        step: 'any',
        value: basis[key] ?? '',
        onchange: () => {
          const value = input.value === '' ? null : Number(input.value);
          app.setBasis({
            ...basis,
            [key]: key === 'acceleration' ? value || null : Math.max(0, value ?? 0),
            [`${key}Assumed`]: false
          });
        }
      });
      return make(
        'label',
        { className: isAssumed ? 'assumed' : '' },
        `${label} `,
        input,
        ` ${unit}`,
        isAssumed ? make('em', {}, ' assumed') : null
      );
    };
    return make(
      'div',
      { className: 'basis' },
      field('rapid', 'Rapid', 'mm/min', basis.rapidAssumed),
      field('toolChange', 'Tool change', 's', basis.toolChangeAssumed),
      field(
        'acceleration',
        'Acceleration',
        basis.acceleration ? 'mm/s²' : 'mm/s² (none: not counted)',
        false
      )
    );
  }

  tools() {
    const { path, measures } = this.app,
      { tools } = path.json.machine;
    const axes = axesOf(path, measures),
      isKnown = (tool) => Object.hasOwn(tools, String(tool));
    const rows = [...measures.byTool]
      .filter(([, sum]) => sum.rapid + sum.feed > 0)
      .map(([tool, sum]) => {
        const data = isKnown(tool) ? tools[tool] : null;
        const feeds = [...sum.feeds]
          .map(([mode, values]) => range(values, ` ${feedUnits[mode]}`))
          .join(', ');
        const speeds = [range(sum.speeds, ' 1/min'), range(sum.surface, ' m/min')]
          .filter(Boolean)
          .join(', ');
        const axis = (i) =>
          range([coordinate(path, i, sum.box.min[i]), coordinate(path, i, sum.box.max[i])]) || '–';
        return {
          tool,
          cells: [
            toolName(tool),
            data
              ? [data.kind, data.radius === null ? '' : `R${number(data.radius)}`]
                  .filter(Boolean)
                  .join(' ')
              : '–',
            [...sum.lengthOffsets].map((x) => `H${x}`).join(' ') || '–',
            [...sum.radiusOffsets].map((x) => `D${x}`).join(' ') || '–',
            speeds || '–',
            feeds || '–',
            ...axes.map(axis),
            lengthText(sum.feed),
            lengthText(sum.rapid),
            clock(sum.seconds)
          ]
        };
      });
    return table(
      [
        'tool',
        'kind',
        'length',
        path.isLathe ? 'offset' : 'radius',
        'speed',
        'feed',
        ...axes.map((i) => axisName(path, i)),
        'cuts',
        'rapids',
        'time'
      ],
      rows.map((row) => row.cells),
      (i) => this.isolate((operation) => operation.tool === rows[i].tool),
      (i) => path.tools.indexOf(rows[i].tool),
      'tool'
    );
  }

  operations() {
    const { path, measures } = this.app;
    const rows = path.json.operations
      .map((operation, i) => ({ operation, i, sum: measures.byOperation[i] }))
      .filter(({ sum }) => sum.moves > 0)
      .slice(0, mostListed);
    return table(
      ['', 'operation', 'line', 'Z', 'cuts', 'time'],
      rows.map(({ operation, i, sum }) => [
        String(i + 1),
        operationName(operation),
        `${operation.file ? `${path.json.files[operation.file]}:` : ''}${operation.line}`,
        range([sum.box.min[2], sum.box.max[2]]) || '–',
        lengthText(sum.feed),
        clock(sum.seconds)
      ]),
      (i) => this.isolate((operation, index) => index === rows[i].i),
      (i) => rows[i].i & 255,
      'operation'
    );
  }

  /** Shows the moves of the operations that `wanted` names, from the first to the last; a second time all. */
  isolate(wanted) {
    const { path, pathPane } = this.app,
      { move, operation } = path.sections;
    let first = -1,
      last = -1;
    for (let i = 0; i < move.length; ++i)
      if (wanted(path.json.operations[operation[i]], operation[i])) {
        if (first < 0) first = move[i];
        last = move[i + 1] ?? path.curve.count;
      }
    const isSame = pathPane.range && pathPane.range[0] === first && pathPane.range[1] === last;
    pathPane.isolate(first < 0 || isSame ? null : [first, last]);
    if (first >= 0 && !isSame)
      this.app.goToLine(path.json.files[path.curve.fileOf(first)], path.curve.line[first], true);
  }
}

/** Of a lathe Y only when it has one. */
function axesOf(path, { extents }) {
  return path.isLathe &&
    !Number.isFinite(extents.feed.min[1]) &&
    !Number.isFinite(extents.rapid.min[1])
    ? [0, 2]
    : [0, 1, 2];
}

function axisName(path, axis) {
  return `${axis === 0 && path.json.diameter ? '⌀' : ''}${'XYZ'[axis]}`;
}

/** `click` gets the number of a row, `colour` its colour of a mode. */
function table(heads, rows, click, colour, mode) {
  const body = make(
    'tbody',
    {},
    rows.map((cells, i) => {
      const row = make(
        'tr',
        {},
        cells.map((cell) => make('td', {}, cell))
      );
      if (click) {
        row.tabIndex = 0;
        row.title = 'Show it alone, and again all';
        row.addEventListener('click', () => click(i));
        row.addEventListener('keydown', (event) => {
          if (event.key === 'Enter') click(i);
        });
      }
      if (colour)
        row.firstChild.prepend(
          spot(cssColour(colourOf(mode, Math.max(0, colour(i)), app.isDark())))
        );
      return row;
    })
  );
  return make(
    'table',
    {},
    make(
      'thead',
      {},
      make(
        'tr',
        {},
        heads.map((head) => make('th', {}, head))
      )
    ),
    body
  );
}

function spot(colour) {
  const element = make('i', { className: 'spot' });
  element.style.background = colour;
  return element;
}

/** What must be said of the path before it is believed. */
function endTexts(path, measures) {
  const { end, files, machine } = path.json,
    texts = [];
  const at = `line ${end.line}${files.length > 1 ? ` of ${files[end.file]}` : ''}`;
  if (end.kind === 'unknown')
    texts.push(`The path ends at ${at}: ${end.why}. What comes after it is not drawn.`);
  if (end.kind === 'cut')
    texts.push(`The path is cut at ${at}: there are more moves than a report takes.`);
  if (path.drawn.notDrawn)
    texts.push(
      `${counted(path.drawn.notDrawn, 'move is', 'moves are')} not drawn: a coordinate of the begin or the end is not known in the work coordinates (the first positions, G28, G53).`
    );
  if (path.curve.guessed)
    texts.push(
      `${counted(path.curve.guessed, 'place within a cycle is', 'places within cycles are')} not known (a clearance that is set at the control): drawn as if it was zero.`
    );
  if (path.usedOffsets.length > 1 && !path.originsKnown)
    texts.push(
      `${path.usedOffsets.join(', ')} are drawn over each other: the machine profile does not give their origins.`
    );
  if (measures.unknownFeeds)
    texts.push(
      `${counted(measures.unknownFeeds, 'move or dwell has', 'moves or dwells have')} no time: the feed or the speed is not known.`
    );
  const turning = [...new Set(path.others.kind)]
    .map((kind) => String.fromCharCode(kind))
    .filter((axis) => 'ABC'.includes(axis));
  if (turning.length)
    texts.push(
      `The part is not turned by ${turning.join(', ')} in this drawing, and its way is in no distance and no time.`
    );
  if (path.centre && path.isLathe)
    texts.push(
      'The nose centre is drawn where compensation is on; elsewhere the programmed point is that of the tip.'
    );
  return texts;
}
