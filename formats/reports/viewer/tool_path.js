// The path of one program with all that belongs to it: modes, operations, times, extents.

class ToolPath {
  constructor(json) {
    this.json = json;
    this.isLathe = json.machineKind === 'lathe';
    this.curve = new Curve(json.programmed);
    this.centre = json.centre && new Curve(json.centre);
    this.feeds = readChanges(json.feeds);
    this.dwells = readChanges(json.dwells);
    this.others = readChanges(json.others);
    this.sections = {
      move: numbersOf(Uint32Array, json.sections.move),
      setting: numbersOf(Uint32Array, json.sections.setting),
      operation: numbersOf(Uint32Array, json.sections.operation)
    };
    this.tools = [...new Set(json.operations.map((operation) => operation.tool))];
    this.findBlocks();
    this.findOffsets();
    this.expand();
  }

  sectionOf(move) {
    return Math.max(0, lastNotAbove(this.sections.move, move));
  }
  settingOf(move) {
    return this.json.settings[this.sections.setting[this.sectionOf(move)]] ?? noSetting;
  }
  operationOf(move) {
    return this.sections.operation[this.sectionOf(move)] ?? 0;
  }
  feedOf(move) {
    const at = lastNotAbove(this.feeds.move, move);
    return at < 0
      ? { value: NaN, mode: 0 }
      : { value: this.feeds.value[at], mode: this.feeds.kind[at] };
  }

  /** Moves at which another block begins. */
  findBlocks() {
    const { line, count } = this.curve,
      begins = [];
    let file = -1;
    for (let i = 0, f = 0; i < count; ++i) {
      while (f + 1 < this.curve.fileMoves.length && this.curve.fileMoves[f + 1] <= i) ++f;
      const now = this.curve.fileNumbers[f];
      if (i === 0 || line[i] !== line[i - 1] || now !== file) begins.push(i);
      file = now;
    }
    this.blocks = Uint32Array.from(begins);
    this.firstOfLine = new Map();
  }

  blockOf(move) {
    return Math.max(0, lastNotAbove(this.blocks, move));
  }
  /** The last move of a block. */
  endOfBlock(block) {
    return (this.blocks[block + 1] ?? this.curve.count) - 1;
  }

  /** The first move of a line, else the last one of the nearest line before it; -1: none. */
  moveOfLine(file, line) {
    let index = this.firstOfLine.get(file);
    if (!index) {
      let longest = 0;
      for (let i = 0; i < this.curve.count; ++i) longest = Math.max(longest, this.curve.line[i]);
      index = [new Int32Array(longest + 2).fill(-1), new Int32Array(longest + 2).fill(-1)];
      const fileAt = changeWalk({ move: this.curve.fileMoves });
      this.blocks.forEach((begin, block) => {
        if (this.curve.fileNumbers[fileAt(begin)] !== file) return;
        const at = this.curve.line[begin];
        if (index[0][at] < 0) {
          index[0][at] = begin;
          index[1][at] = this.endOfBlock(block);
        }
      });
      this.firstOfLine.set(file, index);
    }
    const [firsts, lasts] = index;
    if (firsts[line] >= 0) return firsts[line];
    for (let at = Math.min(line, firsts.length) - 1; at > 0; --at)
      if (lasts[at] >= 0) return lasts[at];
    return -1;
  }

  /** Places of the zero points: apart where all of them are known, else over each other. */
  findOffsets() {
    const used = new Set();
    for (const setting of this.sections.setting) used.add(this.json.settings[setting].workOffset);
    used.delete('');
    this.usedOffsets = [...used];
    const origins = this.usedOffsets.map((code) => this.json.machine.offsets[code]);
    this.originsKnown =
      origins.length > 0 &&
      origins.every(
        (origin) => origin && origin.every((x, axis) => x !== null || (this.isLathe && axis === 1))
      );
    this.apart = this.originsKnown && origins.length > 1;
    this.origin = this.originsKnown ? origins[0].map((x) => x ?? 0) : null;
  }

  shiftOfSetting(setting) {
    if (!this.apart || !this.origin) return [0, 0, 0];
    const origin = this.json.machine.offsets[setting.workOffset];
    return origin ? origin.map((x, axis) => (x ?? 0) - this.origin[axis]) : [0, 0, 0];
  }

  /** Gives of moves, ascending from `first` on, the index of the section in which each is. */
  walk(first = 0) {
    const { move } = this.sections;
    let next = lastNotAbove(move, first) + 1;
    return (i) => {
      while (next < move.length && move[next] <= i) ++next;
      return next - 1;
    };
  }

  /** Whether a cycle makes the move, for moves that ascend from `first` on. */
  cycleWalk(first = 0) {
    const section = this.walk(first);
    return (i) => Boolean(this.json.settings[this.sections.setting[section(i)]]?.cycle);
  }

  expand() {
    if (!this.curve.filled) this.curve.fillGaps(this.isLathe, this.cycleWalk());
    this.curve.chooseFineness();
    this.drawn = this.drawRange(0, this.curve.count);
    if (this.centre) this.expandCentre([0, 0, 0]);
    this.colour();
  }

  /** The drawing of the moves [first, last). */
  drawRange(first, last) {
    const shifts = this.json.settings.map((setting) => this.shiftOfSetting(setting)),
      none = [0, 0, 0];
    const sectionAt = this.walk(first),
      isOfCycle = this.cycleWalk(first);
    return this.curve.expandRange(
      this.isLathe,
      (i) => shifts[this.sections.setting[sectionAt(i)]] ?? none,
      (i) => {
        if (this.curve.kind[i] === Rapid) return 0;
        if (this.curve.kind[i] === Thread) return 3;
        return isOfCycle(i) ? 2 : 1;
      },
      first,
      last
    );
  }

  /** The path beside is shown where it is another one: under compensation, and on the path off. */
  expandCentre(none) {
    const { centre } = this;
    if (!this.centreEnds) this.matchCentre();
    const isBeside = new Uint8Array(centre.count),
      section = this.walk();
    let wasOn = false,
      i = 0;
    this.blocks.forEach((begin, block) => {
      const on = Boolean(this.json.settings[this.sections.setting[section(begin)]]?.side);
      const end = this.centreEnds[block];
      if (on || wasOn) isBeside.fill(1, i, end);
      if (end > i) wasOn = on;
      i = end;
    });
    centre.filled ?? centre.fillGaps(this.isLathe, () => false);
    this.drawnCentre = centre.expand(
      this.isLathe,
      () => none,
      (move) => (isBeside[move] ? 4 : hiddenClass)
    );
  }

  /** Of each block the number of moves of the path beside up to its end: both have the same blocks. */
  matchCentre() {
    const { curve, centre, blocks } = this,
      ends = new Uint32Array(blocks.length);
    let at = 0;
    blocks.forEach((begin, block) => {
      const file = curve.fileOf(begin),
        line = curve.line[begin];
      while (at < centre.count && centre.line[at] === line && centre.fileOf(at) === file) ++at;
      ends[block] = at;
    });
    this.centreEnds = ends;
  }

  /** Four bytes a corner: class and shade, tool, operation, level of the feed. */
  colour() {
    this.findGreatestFeed();
    this.drawn.classes = new Uint8Array(this.drawn.count * 4);
    this.colourRange(0, this.drawn.count);
    if (this.drawnCentre) this.colourCentre();
  }

  colourCentre() {
    const centre = new Uint8Array(this.drawnCentre.count * 4);
    this.drawnCentre.kinds.forEach((kind, n) => {
      centre[n * 4] = kind | (31 << 3);
    });
    this.drawnCentre.classes = centre;
  }

  findGreatestFeed() {
    let most = 0;
    this.feeds.value.forEach((value, i) => {
      if (this.feeds.kind[i] !== 3 && value > most) most = value;
    });
    this.greatestFeed = most;
  }

  /** The same of the corners [first, last). */
  colourRange(first, last) {
    const { kinds, ofMove, places, classes: bytes } = this.drawn,
      most = this.greatestFeed,
      from = Math.max(1, first),
      begin = from < this.drawn.count ? ofMove[from] : 0;
    const section = this.walk(begin);
    let feed = lastNotAbove(this.feeds.move, begin);
    for (let n = from; n < last; ++n) {
      const move = ofMove[n],
        at = section(move);
      while (feed + 1 < this.feeds.move.length && this.feeds.move[feed + 1] <= move) ++feed;
      const setting = this.json.settings[this.sections.setting[at]] ?? noSetting;
      bytes[n * 4] = kinds[n] | (shadeOf(places, n) << 3);
      bytes[n * 4 + 1] = Math.max(0, this.tools.indexOf(setting.tool)) & 255;
      bytes[n * 4 + 2] = this.sections.operation[at] & 255;
      bytes[n * 4 + 3] =
        kinds[n] === 0 || feed < 0 || !most
          ? 0
          : Math.max(0, Math.min(255, Math.round((255 * this.feeds.value[feed]) / most))) || 0;
    }
    bytes[0] = hiddenClass;
  }
}

const noSetting = {
  tool: null,
  lengthOffset: null,
  radiusOffset: null,
  workOffset: '',
  cycle: '',
  side: '',
  spindle: 'unknown',
  speed: null,
  surfaceSpeed: false,
  speedLimit: null
};

function readChanges(json) {
  return {
    move: numbersOf(Uint32Array, json.move),
    value: numbersOf(Float32Array, json.value),
    kind: numbersOf(Uint8Array, json.kind)
  };
}

/** Brightness 0 to 31 of a segment in a light from above, which makes surfaces of many lines readable. */
function shadeOf(places, n) {
  const i = n * 3,
    dx = places[i] - places[i - 3],
    dy = places[i + 1] - places[i - 2],
    dz = places[i + 2] - places[i - 1];
  const along = (-0.5 * dx - 0.33 * dy + 0.8 * dz) / Math.hypot(dx, dy, dz);
  return Number.isFinite(along)
    ? Math.round(10 + 21 * Math.sqrt(Math.max(0, 1 - along * along)))
    : 31;
}
