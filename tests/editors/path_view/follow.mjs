// Follows a program that is edited as the view of VS Code does: asks the server for its path after each edit, takes what
// has changed into it, and compares it with a path that is made anew. Prints what differs, and how long it took.
//
//   node follow.mjs NCVET PROGRAM DIALECT EDITS [measure]
//
// With `measure` only the first and the last path are compared, and each edit changes one coordinate.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const [program, file, dialect, edits, mode] = process.argv.slice(2);
const top = fileURLToPath(new URL('../../../', import.meta.url));
const read = (folder, names) => names.map((name) => readFileSync(`${top}${folder}/${name}.js`, 'utf8')).join('\n');

/** What of the view needs no page. */
const view = new Function(`'use strict';
${read('formats/reports/viewer', ['data', 'curve', 'levels', 'times', 'tool_path'])}
${read('lsp/editors/vscode/view', ['splice'])}
return { ToolPath, Levels, allLevels, splicePath, hiddenClass };`)();

// ---- the server

const server = spawn(program, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
const waiting = new Map();
let rest = Buffer.alloc(0),
  lastId = 0;
server.stdout.on('data', (piece) => {
  rest = Buffer.concat([rest, piece]);
  for (;;) {
    const end = rest.indexOf('\r\n\r\n');
    if (end < 0) return;
    const length = Number(/content-length: (\d+)/i.exec(rest.toString('latin1', 0, end))[1]);
    if (rest.length < end + 4 + length) return;
    const message = JSON.parse(rest.toString('utf8', end + 4, end + 4 + length));
    rest = rest.subarray(end + 4 + length);
    if (message.method && message.id !== undefined) send({ jsonrpc: '2.0', id: message.id, result: null });
    else if (message.id !== undefined) {
      waiting.get(message.id)?.(message);
      waiting.delete(message.id);
    }
  }
});
function send(message) {
  const body = Buffer.from(JSON.stringify(message));
  server.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
  server.stdin.write(body);
}
function request(method, params) {
  return new Promise((resolve, reject) => {
    const id = ++lastId;
    waiting.set(id, (message) => (message.error ? reject(new Error(message.error.message)) : resolve(message.result)));
    send({ jsonrpc: '2.0', id, method, params });
  });
}
const notify = (method, params) => send({ jsonrpc: '2.0', method, params });

// ---- edits

let seed = 1;
const below = (limit) => {
  seed = (Math.imul(seed, 1103515245) + 12345) >>> 0;
  return Math.floor((seed / 2 ** 32) * limit);
};

function randomEdit(lines) {
  const line = below(lines.length - 1),
    range = (from, to) => ({ start: { line, character: from }, end: { line, character: to } });
  switch (below(6)) {
    case 0:
      return { range: { start: { line, character: 0 }, end: { line: line + 1, character: 0 } }, text: '' };
    case 1:
      return { range: range(0, 0), text: lines[line] + '\n' };
    case 2:
      return { range: range(0, 0), text: lines[below(lines.length - 1)] + '\n(X)\n' };
    case 3: {
      const typed = ['G', 'X', '1', '.', ' ', '\n', 'F100.', 'G40 ', 'T1 M6\n', '(', 'M30\n', 'G4 P100\n', 'G2 X1. R5.\n'];
      const at = below(lines[line].length + 1);
      return { range: range(at, at), text: typed[below(typed.length)] };
    }
    default:
      return digit(lines, line);
  }
}

function digit(lines, line) {
  const at = lines[line].search(/\d(?=\D*$)/);
  const from = Math.max(0, at);
  return { range: { start: { line, character: from }, end: { line, character: from + (at < 0 ? 0 : 1) } }, text: at < 0 ? ' ' : String(below(10)) };
}

function applied(lines, { range: { start, end }, text }) {
  const begin = (lines[start.line] ?? '').slice(0, start.character),
    after = (lines[end.line] ?? '').slice(end.character);
  lines.splice(start.line, end.line - start.line + 1, ...(begin + text + after).split('\n'));
}

// ---- the comparison

function* arraysOf(path) {
  const { curve, drawn } = path;
  yield* Object.entries({ kind: curve.kind, machine: curve.machine, line: curve.line, fileMoves: curve.fileMoves, fileNumbers: curve.fileNumbers });
  for (const [i, axis] of curve.axes.entries()) yield [`axis ${i}`, axis];
  for (const [i, axis] of curve.filled.entries()) yield [`filled ${i}`, axis];
  for (const [name, array] of Object.entries(curve.arcs)) yield [`arcs.${name}`, array];
  for (const name of ['places', 'kinds', 'ofMove', 'firsts', 'lengths', 'classes']) yield [`drawn.${name}`, drawn[name]];
  for (const list of ['feeds', 'dwells', 'others'])
    for (const [name, array] of Object.entries(path[list])) yield [`${list}.${name}`, array];
  yield ['blocks', path.blocks];
  yield ['sections.move', path.sections.move];
  yield ['sections.operation', path.sections.operation];
  if (path.centre) {
    yield ['centre.line', path.centre.line];
    yield ['centre.places', path.drawnCentre.places];
    yield ['centre.kinds', path.drawnCentre.kinds];
  }
}

/** What differs between two paths: a line each. */
function differences(path, due) {
  const found = [],
    others = new Map(arraysOf(due));
  for (const [name, array] of arraysOf(path)) {
    const other = others.get(name);
    if (!other || array.length !== other.length) found.push(`${name}: ${array.length} elements, not ${other?.length}`);
    else {
      const at = array.findIndex((x, i) => !Object.is(x, other[i]) && !(x === 0 && other[i] === 0));
      if (at >= 0) found.push(`${name}[${at}]: ${array[at]}, not ${other[at]}`);
    }
  }
  const modes = (of) => Array.from(of.sections.setting, (setting) => JSON.stringify(of.json.settings[setting])).join();
  if (modes(path) !== modes(due)) found.push('modes');
  for (const name of ['operations', 'files', 'end'])
    if (JSON.stringify(path.json[name]) !== JSON.stringify(due.json[name]))
      found.push(`${name}: ${JSON.stringify(path.json[name])}, not ${JSON.stringify(due.json[name])}`);
  return found;
}

/** Pieces hold all corners, and coarse lines those that are kept of each piece. */
function faultsOfLevels(levels) {
  const found = [],
    { starts, pieces, drawn } = levels;
  const fresh = Object.assign(Object.create(view.Levels.prototype), { drawn, starts, pieces, bounds: new Float32Array(pieces * 6) });
  for (let piece = 0; piece < pieces; ++piece) fresh.findBounds(piece);
  if (starts[0] !== 0 || starts[pieces] !== drawn.count || starts.length !== pieces + 1) found.push('pieces do not hold all corners');
  if (starts.some((start, i) => i && start < starts[i - 1])) found.push('pieces are in disorder');
  if (fresh.bounds.some((x, i) => x !== levels.bounds[i])) found.push('boxes of pieces');
  for (const { index, away, begins } of levels.levels.slice(1)) {
    const due = fresh.coarser(away);
    if (due.index.length !== index.length || due.index.some((x, i) => x !== index[i])) found.push(`corners of level ${away}`);
    if (due.begins.some((x, i) => x !== begins[i])) found.push(`begins of level ${away}`);
  }
  return found;
}

// ---- the run

const text = readFileSync(file, 'utf8').replace(/\r/g, '');
const lines = text.split('\n'),
  uri = 'file:///nowhere/part.nc';
await request('initialize', { capabilities: { general: { positionEncodings: ['utf-16'] } }, initializationOptions: { dialect } });
notify('initialized', {});
notify('textDocument/didOpen', { textDocument: { uri, languageId: 'gcode', version: 1, text } });
const ask = (previous) => request('ncvet/path', { textDocument: { uri }, previous, pieces: true });
async function askForAll() {
  let whole = await ask('');
  while (whole.more) whole = await ask('');
  return whole;
}
const times = { server: [], view: [] };
let answer = await ask('');
let path = new view.ToolPath(answer.path),
  curves = curvesOf(path),
  wholes = 0,
  bytes = 0;
function curvesOf(of) {
  return [of.drawn, of.drawnCentre].filter(Boolean).map((drawn) => ({ drawn, levels: view.allLevels(drawn) }));
}
for (let i = 0; i < Number(edits); ++i) {
  const edit = mode === 'measure' ? digit(lines, Math.floor(lines.length / 2) + below(1000)) : randomEdit(lines);
  const isSilent = mode !== 'measure';
  applied(lines, edit);
  notify('textDocument/didChange', { textDocument: { uri, version: i + 2 }, contentChanges: [edit] });
  let next, done;
  do {
    let start = performance.now();
    next = await ask(answer.id);
    times.server.push(performance.now() - start);
    answer = next;
    start = performance.now();
    done = next.change && splice(next.change);
    times.view.push(performance.now() - start);
  } while (done && next.more);
  if (!done) {
    ++wholes;
    if (!next.path || next.more) answer = await askForAll();
    if (!answer.path.programmed.count) break;
    path = new view.ToolPath(answer.path);
    curves = curvesOf(path);
  } else if (isSilent || i === Number(edits) - 1) {
    answer = await askForAll();
    const found = [...differences(path, new view.ToolPath(answer.path)), ...faultsOfLevels(curves[0].levels)];
    if (found.length) {
      console.log(`edit ${i} ${JSON.stringify(edit)} ${JSON.stringify(next.change.programmed.first)}: ${found.slice(0, 8).join('; ')}`);
      break;
    }
  }
}
function splice(change) {
  bytes += JSON.stringify(change).length;
  return view.splicePath(path, curves, change);
}
const middle = (list) => list.sort((a, b) => a - b)[list.length >> 1] ?? 0,
  worst = (list) => list.sort((a, b) => a - b)[Math.floor(list.length * 0.99)] ?? 0;
console.log(
  `took ${path.curve.count} moves, ${edits} edits, ${wholes} whole: server p50 ${middle(times.server).toFixed(1)} ms p99 ${worst(times.server).toFixed(1)} ms, ` +
    `view p50 ${middle(times.view).toFixed(1)} ms p99 ${worst(times.view).toFixed(1)} ms, ${Math.round(bytes / edits)} bytes an edit`
);
console.log('done');
await request('shutdown', null);
notify('exit');
