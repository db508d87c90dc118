// Takes into a path what an edit of its program has changed: see "Changes of a path" in
// docs/trace-format.md. What it costs hangs on the changed stretch; of the rest numbers are moved.

/** Elements [first, first + removed) become `added`, an array of the same type; `width` numbers make an element. */
function spliced(array, first, removed, added, width = 1) {
  const begin = first * width,
    end = begin + removed * width;
  if (added.length === removed * width) {
    array.set(added, begin);
    return array;
  }
  const result = new array.constructor(array.length - removed * width + added.length);
  result.set(array.subarray(0, begin));
  result.set(added, begin);
  result.set(array.subarray(end), begin + added.length);
  return result;
}

/** Adds to the elements from `first` on. */
function shift(array, first, by) {
  if (by) for (let i = first; i < array.length; ++i) array[i] += by;
}

const numberTypes = { move: Uint32Array, value: Float32Array, kind: Uint8Array, setting: Uint32Array, operation: Uint32Array };

/** A list of columns, of which `move` counts moves. */
function spliceList(list, change, movesBy) {
  for (const name of Object.keys(list)) {
    const added = numbersOf(numberTypes[name], change.added[name]);
    list[name] = spliced(list[name], change.first, change.removed, added);
    if (name === 'move') shift(list.move, change.first + added.length, movesBy);
  }
}

/** Blocks of the first file further down are in other lines. */
function moveLines(curve, { from, by }) {
  if (!by) return;
  curve.fileMoves.forEach((begin, run) => {
    if (curve.fileNumbers[run] !== 0) return;
    const end = curve.fileMoves[run + 1] ?? curve.count;
    for (let i = begin; i < end; ++i) if (curve.line[i] >= from) curve.line[i] += by;
  });
}

/** From which move on which file: around the stretch as before. */
function spliceFiles(curve, stretch, first, removed) {
  const moves = [],
    files = [];
  const add = (move, file) => {
    if (files.length && files[files.length - 1] === file) return;
    if (moves.length && moves[moves.length - 1] === move) {
      moves.pop();
      files.pop();
      return add(move, file);
    }
    moves.push(move);
    files.push(file);
  };
  const by = stretch.count - removed,
    after = curve.fileOf(first + removed);
  curve.fileMoves.forEach((move, run) => move < first && add(move, curve.fileNumbers[run]));
  stretch.fileMoves.forEach((move, run) => add(first + move, stretch.fileNumbers[run]));
  if (first + removed < curve.count) add(first + stretch.count, after);
  curve.fileMoves.forEach((move, run) => move > first + removed && add(move + by, curve.fileNumbers[run]));
  curve.fileMoves = Uint32Array.from(moves);
  curve.fileNumbers = Uint16Array.from(files);
}

function spliceArcs(curve, stretch, first, removed) {
  const { arcs } = curve,
    begin = lastNotAbove(arcs.move, first - 1) + 1,
    end = lastNotAbove(arcs.move, first + removed - 1) + 1;
  shift(stretch.arcs.move, 0, first);
  for (const name of Object.keys(arcs)) arcs[name] = spliced(arcs[name], begin, end - begin, stretch.arcs[name]);
  shift(arcs.move, begin + stretch.arcs.move.length, stretch.count - removed);
}

/** The moves of a curve; what is drawn of them is another matter. */
function spliceCurve(curve, { first, removed }, stretch, lines) {
  moveLines(curve, lines);
  spliceFiles(curve, stretch, first, removed);
  spliceArcs(curve, stretch, first, removed);
  for (const name of ['kind', 'machine', 'line']) curve[name] = spliced(curve[name], first, removed, stretch[name]);
  for (const name of ['axes', 'filled'])
    curve[name] = curve[name].map((axis, i) => spliced(axis, first, removed, stretch.axes[i]));
  curve.count += stretch.count - removed;
}

/** Moves that only end elsewhere. */
function placeMoves(curve, places, lines) {
  moveLines(curve, lines);
  const moves = numbersOf(Uint32Array, places.move);
  ['x', 'y', 'z'].forEach((name, which) => {
    const axis = curve.axes[which];
    numbersOf(Float32Array, places[name]).forEach((value, i) => (axis[moves[i]] = value));
  });
}

/** The move with which the block of `move` begins. */
function blockBegin(curve, move) {
  while (move > 0 && curve.line[move] === curve.line[move - 1]) --move;
  return move;
}

/** Moves at which blocks begin, when the moves [first, last) of now are others and `by` more than before. */
function spliceBlocks(path, first, last, by) {
  const { blocks, curve } = path,
    begin = lastNotAbove(blocks, first - 1) + 1,
    end = lastNotAbove(blocks, last - by) + 1;
  const begins = [];
  for (let i = first; i <= Math.min(last, curve.count - 1); ++i)
    if (i === 0 || curve.line[i] !== curve.line[i - 1] || curve.fileOf(i) !== curve.fileOf(i - 1)) begins.push(i);
  path.blocks = spliced(blocks, begin, end - begin, Uint32Array.from(begins));
  shift(path.blocks, begin + begins.length, by);
  path.firstOfLine.clear();
}

/** Draws the moves [first, last) anew, which are `by` more than before. Returns the corners that are others. */
function redraw(path, first, last, by) {
  const { drawn } = path,
    corner = drawn.firsts[first],
    // The corner where nothing is known is before the first move.
    begin = first === 0 ? 0 : corner,
    end = drawn.firsts[last - by];
  const stretch = path.drawRange(first, last),
    change = { first: begin, removed: end - begin, added: stretch.count };
  const cornersBy = change.added - change.removed;
  shift(stretch.firsts, 0, begin);
  drawn.places = spliced(drawn.places, begin, change.removed, stretch.places, 3);
  drawn.classes = spliced(drawn.classes, begin, change.removed, new Uint8Array(stretch.count * 4), 4);
  drawn.kinds = spliced(drawn.kinds, begin, change.removed, stretch.kinds);
  drawn.ofMove = spliced(drawn.ofMove, begin, change.removed, stretch.ofMove);
  shift(drawn.ofMove, begin + stretch.count, by);
  drawn.firsts = spliced(drawn.firsts, first, last - by - first, stretch.firsts.subarray(0, last - first));
  shift(drawn.firsts, last, cornersBy);
  drawn.lengths = spliced(drawn.lengths, first, last - by - first, stretch.lengths);
  drawn.count += cornersBy;
  return change;
}

/** The index of corners of a coarse level, of which some pieces are others. */
function spliceLevel(levels, level, { begin, end, pieces }, cornersBy) {
  const { index, begins, away } = level;
  const made = new Uint32Array(levels.starts[begin + pieces] - levels.starts[begin]),
    madeBegins = new Uint32Array(pieces);
  let n = 0;
  for (let piece = 0; piece < pieces; ++piece) {
    madeBegins[piece] = begins[begin] + n;
    n = levels.coarsen(begin + piece, away, made, n);
  }
  const by = n - (begins[end] - begins[begin]);
  level.index = spliced(index, begins[begin], begins[end] - begins[begin], made.subarray(0, n));
  shift(level.index, begins[begin] + n, cornersBy);
  level.begins = spliced(begins, begin, end - begin, madeBegins);
  shift(level.begins, begin + pieces, by);
}

/** The pieces of a drawing of which some corners are others. */
function spliceLevels(levels, { first, removed, added }) {
  const { starts } = levels,
    by = added - removed;
  // The piece after the last corner that is another begins with a segment from it.
  const begin = Math.max(0, lastNotAbove(starts, first)),
    last = Math.min(levels.pieces - 1, Math.max(begin, lastNotAbove(starts, first + removed))),
    end = last + 1;
  const from = starts[begin],
    to = starts[end] + by,
    pieces = Math.max(1, Math.ceil((to - from) / pieceSize));
  const begins = Uint32Array.from({ length: pieces }, (_, i) => from + Math.floor(((to - from) * i) / pieces));
  levels.starts = spliced(starts, begin, end - begin, begins);
  shift(levels.starts, begin + pieces, by);
  levels.bounds = spliced(levels.bounds, begin, end - begin, new Float32Array(pieces * 6), 6);
  levels.pieces += pieces - (end - begin);
  for (let piece = begin; piece < Math.min(levels.pieces, begin + pieces + 1); ++piece) levels.findBounds(piece);
  levels.findBox();
  for (const level of levels.levels) if (level.index) spliceLevel(levels, level, { begin, end, pieces }, by);
}

/** Tools in the order of their operations: their numbers are colours. */
function toolsOf(path) {
  return [...new Set(path.json.operations.map((operation) => operation.tool))];
}

const sameList = (a, b) => a.length === b.length && a.every((x, i) => x === b[i]);

/** Lists of modes: true when what was not edited may have other colours now. */
function spliceModes(path, change, movesBy) {
  const { json } = path,
    { first, removed, added } = change.operations;
  for (const name of ['feeds', 'dwells', 'others']) spliceList(path[name], change[name], movesBy);
  spliceList(path.sections, change.sections, movesBy);
  const operationsBy = added.length - removed;
  const addedSections = numbersOf(Uint32Array, change.sections.added.move).length;
  shift(path.sections.operation, change.sections.first + addedSections, operationsBy);
  for (const operation of json.operations)
    if (operation.file === 0 && operation.line >= change.lines.from) operation.line += change.lines.by;
  json.operations.splice(first, removed, ...added);
  json.settings.push(...change.settings);
  json.files = change.files;
  json.end = change.end;
  const tools = toolsOf(path),
    feed = path.greatestFeed;
  path.findGreatestFeed();
  const isOther = operationsBy !== 0 || feed !== path.greatestFeed || !sameList(tools, path.tools);
  path.tools = tools;
  return isOther;
}

/** The path of the tool's centre: only compensated contours have one, and it is drawn as a whole. */
function spliceCentre(path, change) {
  if (!path.centre || !change.centre) return Boolean(path.centre) !== Boolean(change.centre);
  spliceCurve(path.centre, change.centre, new Curve(change.centre.added), change.lines);
  path.centre.filled = null;
  path.centreEnds = null;
  path.expandCentre([0, 0, 0]);
  return false;
}

/**
 * Takes a change into the path. `curves`: its drawings with their levels. Returns for each drawing which
 * corners are others; null: the path has to be made anew.
 */
function splicePath(path, curves, change) {
  const { programmed } = change,
    stretch = programmed.added ? new Curve(programmed.added) : null,
    count = stretch ? stretch.count : programmed.removed,
    by = count - programmed.removed;
  if (path.curve.count + by === 0 || programmed.first > path.curve.count) return null;
  const offsets = [path.apart, path.origin];
  if (stretch) spliceCurve(path.curve, programmed, stretch, change.lines);
  else placeMoves(path.curve, programmed.places, change.lines);
  const isOther = spliceModes(path, change, by);
  if (change.settings.length) path.findOffsets();
  if (path.apart !== offsets[0] || !sameList(path.origin ?? [], offsets[1] ?? [])) return null;
  // From the block before on: where a hole ends may be told by the move after it.
  let first = blockBegin(path.curve, Math.min(programmed.first, path.curve.count - 1));
  if (first > 0) first = blockBegin(path.curve, first - 1);
  let last = Math.max(programmed.first + count, first);
  last = path.curve.fillRange(path.isLathe, path.cycleWalk(first), first, last);
  // The move after the stretch begins where that ends.
  const next = path.curve.nextTravel(last - 1);
  last = next < 0 ? path.curve.count : next + 1;
  spliceBlocks(path, first, last, by);
  const corners = redraw(path, first, last, by);
  if (isOther) path.colourRange(0, path.drawn.count);
  else path.colourRange(corners.first, corners.first + corners.added);
  spliceLevels(curves[0].levels, corners);
  path.placed = null;
  if (spliceCentre(path, change)) return null;
  if (path.centre) {
    path.colourCentre();
    curves[1] = { drawn: path.drawnCentre, levels: allLevels(path.drawnCentre) };
  }
  return { corners, isRecoloured: isOther };
}

/** Counts that the tables tell: of a stretch that is drawn again they are not known. */
function recount(path) {
  const { curve, drawn } = path,
    isOfCycle = path.cycleWalk();
  curve.guessed = drawn.notDrawn = 0;
  for (let i = 0; i < curve.count; ++i) {
    if (!curve.isTravel(i)) continue;
    if (drawn.kinds[drawn.firsts[i]] === hiddenClass) ++drawn.notDrawn;
    const isGap = curve.axes.some((axis, which) => Number.isNaN(axis[i]) && !Number.isNaN(curve.filled[which][i]) && !(path.isLathe && which === 1));
    if (isGap && isOfCycle(i)) ++curve.guessed;
  }
}

function allLevels(drawn) {
  const levels = new Levels(drawn);
  while (levels.prepare());
  return levels;
}
