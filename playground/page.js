// The playground's page: what is typed is checked in a worker, and its findings are shown.
'use strict';

const byId = (id) => document.getElementById(id);

/** A check begins when nothing was typed for so many milliseconds. */
const pause = 250;
/** Findings in the list: more are in the viewer. */
const mostListed = 200;
/** Numbers of lines in the margin: a longer text has none. */
const mostNumbers = 20000;

function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children.flat().filter((child) => child !== null));
  return element;
}

// ---- the worker

let worker, ready;
const open = new Map(); // answers that are waited for, by number
let lastId = 0;

function startWorker() {
  worker = new Worker('worker.js');
  ready = new Promise((resolve, reject) => {
    worker.onmessage = ({ data }) => {
      if (data.ready) return resolve();
      if (data.failed) return reject(new Error(data.failed));
      const waiting = open.get(data.id);
      open.delete(data.id);
      if (data.error) waiting?.reject(new Error(data.error));
      else waiting?.resolve(data);
    };
    worker.onerror = (event) => reject(new Error(event.message));
  });
}

async function ask(kind, details) {
  await ready;
  const id = ++lastId;
  return new Promise((resolve, reject) => {
    open.set(id, { resolve, reject });
    worker.postMessage({ id, kind, ...details });
  });
}

// ---- what is shown

const state = { name: 'program.nc', report: null, running: false, again: false, page: '' };

const program = () => ({
  name: state.name,
  text: byId('text').value,
  control: byId('control').value
});

function tell(text) {
  byId('state').textContent = text;
}

/** The place of a line and a column, which counts characters, in the text. */
function offsetOf(text, line, column) {
  let at = 0;
  for (let left = line - 1; left > 0; --left) {
    const end = text.indexOf('\n', at);
    if (end < 0) return text.length;
    at = end + 1;
  }
  for (let left = column - 1; left > 0 && at < text.length; --left)
    at += text.codePointAt(at) > 0xffff ? 2 : 1;
  return at;
}

function goTo(line, column, endLine = line, endColumn = column) {
  const text = byId('text');
  text.focus();
  text.setSelectionRange(
    offsetOf(text.value, line, column),
    offsetOf(text.value, endLine, endColumn)
  );
  text.scrollTop = Math.max(0, (line - 1) * 19 - text.clientHeight / 2);
}

function showTab(name) {
  for (const one of ['view', 'page']) {
    byId(one).hidden = one !== name;
    byId(`tab-${one}`).setAttribute('aria-selected', String(one === name));
  }
}

function drawNumbers() {
  const worst = new Map();
  for (const finding of state.report?.findings ?? [])
    if (finding.severity === 'error' || !worst.has(finding.line))
      worst.set(finding.line, finding.severity);
  const count = byId('text').value.split('\n').length;
  const lines = [];
  for (let line = 1; line <= Math.min(count, mostNumbers); ++line) {
    const severity = worst.get(line);
    lines.push(severity ? make('span', { className: severity }, `● ${line}`) : String(line), '\n');
  }
  byId('numbers').replaceChildren(...lines);
}

/** Backticks of a message become code. */
const withCode = (message) =>
  message.split('`').map((part, i) => (i % 2 ? make('code', {}, part) : part));

function drawSteps(finding) {
  const steps = [...finding.trace, ...finding.related];
  if (!steps.length) return null;
  return make(
    'ol',
    { className: 'steps' },
    steps.map((step) =>
      make(
        'li',
        {},
        make(
          'button',
          { type: 'button', onclick: () => goTo(step.line, step.column ?? 1) },
          String(step.line)
        ),
        ' ',
        ...withCode(step.message)
      )
    )
  );
}

function drawFinding(finding) {
  const button = (label, title, onclick) => make('button', { type: 'button', title, onclick }, label);
  const acts = [button('explain', finding.rule, () => explain(finding.rule))];
  if (finding.fix)
    acts.push(
      button(
        `fix: ${finding.fix.description.replaceAll('`', '')}`,
        finding.fix.safety === 'safe' ? 'safe' : 'unsafe: the path of the tool changes',
        () => applyFix(finding.fix)
      )
    );
  return make(
    'li',
    {},
    make(
      'button',
      {
        type: 'button',
        className: `place ${finding.severity}`,
        onclick: () => select(finding)
      },
      `${finding.line}:${finding.column} ${finding.severity}`
    ),
    ' ',
    ...withCode(finding.message),
    make('div', { className: 'rule' }, finding.rule, finding.certainty === 'possible' ? ' · possible' : ''),
    drawSteps(finding),
    make('div', { className: 'acts' }, acts)
  );
}

function select(finding) {
  goTo(finding.line, finding.column, finding.endLine, finding.endColumn);
  const viewer = byId('view').contentWindow?.ncvet;
  const same = viewer?.report.findings.find(
    (other) =>
      other.rule === finding.rule && other.line === finding.line && other.column === finding.column
  );
  if (same) viewer.selectFinding(same);
}

function drawFindings() {
  const { report } = state,
    { findings, problems } = report;
  const count = findings.length === 1 ? '1 finding' : `${findings.length} findings`;
  byId('findings-title').textContent = count;
  byId('findings').replaceChildren(
    ...problems.map((problem) => make('li', { className: 'error' }, problem.message)),
    ...findings.slice(0, mostListed).map(drawFinding),
    ...(findings.length > mostListed
      ? [make('li', {}, `${findings.length - mostListed} more are in the viewer`)]
      : []),
    ...(findings.length || problems.length ? [] : [make('li', {}, 'Nothing was found.')])
  );
  byId('fix-all').disabled = !report.summary.fixes.safe;
  drawNumbers();
}

/** The viewer of the HTML report, as the command line writes it. */
function drawPage(page) {
  URL.revokeObjectURL(state.page);
  state.page = URL.createObjectURL(new Blob([page], { type: 'text/html' }));
  byId('view').contentWindow.location.replace(`${state.page}#tool-path`);
}

// ---- what is done

async function check() {
  if (state.running) {
    state.again = true;
    return;
  }
  state.running = true;
  do {
    state.again = false;
    if (byId('text').value === '') {
      tell('');
      break;
    }
    try {
      const { answer, took } = await ask('check', program());
      if (state.again) continue;
      state.report = answer.report;
      drawFindings();
      drawPage(answer.page);
      const file = answer.report.files[0];
      tell(
        file
          ? `${file.dialect}${file.guess ? ` (guessed: ${file.guess.from})` : ''} · ${file.blocks} blocks · ${Math.round(took)} ms`
          : ''
      );
    } catch (error) {
      tell(error.message);
    }
  } while (state.again);
  state.running = false;
}

let timer;
function changed() {
  drawNumbers();
  clearTimeout(timer);
  timer = setTimeout(check, pause);
}

/** Puts a text into the editor; what was there can be had back by undoing. */
function write(text) {
  const area = byId('text');
  area.focus();
  area.select();
  // The one way that keeps the list of what can be undone.
  if (!document.execCommand(text === '' ? 'delete' : 'insertText', false, text)) area.value = text;
  area.setSelectionRange(0, 0);
  area.scrollTop = 0;
  clearTimeout(timer);
  drawNumbers();
  return check();
}

function applyFix(fix) {
  let text = byId('text').value;
  const edits = fix.edits
    .map((edit) => ({
      begin: offsetOf(text, edit.line, edit.column),
      end: offsetOf(text, edit.endLine, edit.endColumn),
      text: edit.text
    }))
    .sort((a, b) => b.begin - a.begin);
  for (const edit of edits) text = text.slice(0, edit.begin) + edit.text + text.slice(edit.end);
  return write(text);
}

async function fixAll() {
  const { answer } = await ask('fix', program());
  if (answer.text !== null) await write(answer.text);
}

async function explain(rule) {
  const { answer } = await ask('explain', {
    rule,
    control: state.report?.files[0]?.dialect ?? ''
  });
  byId('page').innerHTML = marked.parse(answer.page); // a page of ncvet, no text of anybody else
  byId('page').scrollTop = 0;
  showTab('page');
}

/** Programs of older controls are not UTF-8: their bytes are kept as the characters of Windows. */
function decode(bytes) {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}

async function openFile(file) {
  if (!file) return;
  // The name leads to the control; a folder has no part in it.
  state.name = file.name.replaceAll(/[/\\]/g, '_') || 'program.nc';
  await write(decode(await file.arrayBuffer()));
}

function save() {
  const link = make('a', {
    href: URL.createObjectURL(new Blob([byId('text').value])),
    download: state.name
  });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

async function fillLists() {
  const { controls, examples } = await (await fetch('lists.json')).json();
  byId('control').append(
    ...controls.map(({ id, title }) => make('option', { value: id }, title))
  );
  byId('example').append(...examples.map((name) => make('option', { value: name }, name)));
}

async function showExample(name) {
  if (!name) return;
  state.name = name;
  await write(await (await fetch(`examples/${name}`)).text());
  byId('example').value = '';
}

function listen() {
  const text = byId('text');
  text.addEventListener('input', changed);
  text.addEventListener('scroll', () => {
    byId('gutter').scrollTop = text.scrollTop;
  });
  byId('control').addEventListener('change', check);
  byId('example').addEventListener('change', () => showExample(byId('example').value));
  byId('open').addEventListener('click', () => byId('file').click());
  byId('file').addEventListener('change', () => openFile(byId('file').files[0]));
  byId('save').addEventListener('click', save);
  byId('fix-all').addEventListener('click', fixAll);
  byId('tab-view').addEventListener('click', () => showTab('view'));
  byId('tab-page').addEventListener('click', () => showTab('page'));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    openFile(event.dataTransfer.files[0]);
  });
}

async function start() {
  startWorker();
  listen();
  drawNumbers();
  try {
    await Promise.all([ready, fillLists()]);
    tell('');
    await check();
  } catch (error) {
    tell(`ncvet could not be loaded: ${error.message}`);
  }
}

start();
