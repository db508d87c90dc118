// Moves with their geometry: what is drawn of them, and how long they are.

const Rapid = 0,
  Feed = 1,
  Arc = 2,
  Thread = 3,
  Dwell = 4,
  ToolChange = 5;
/** Classes of segments, as legends name them; hidden ones lead from or to a place that is unknown. */
const classes = ['rapid', 'feed', 'cycle', 'thread', 'centre'];
const hiddenClass = 7;
/** A drawing with more corners than this has coarser arcs. */
const mostVertices = 4_000_000;

class Curve {
  constructor(json) {
    const kinds = numbersOf(Uint8Array, json.kind);
    this.count = json.count;
    this.kind = kinds.map((kind) => kind & 0x7f);
    this.machine = kinds;
    this.axes = [json.x, json.y, json.z].map((axis) => numbersOf(Float32Array, axis));
    this.line = numbersOf(Uint32Array, json.line);
    this.fileMoves = numbersOf(Uint32Array, json.files.move);
    this.fileNumbers = numbersOf(Uint16Array, json.files.file);
    this.arcs = {
      move: numbersOf(Uint32Array, json.arcs.move),
      axes: numbersOf(Uint8Array, json.arcs.axes),
      first: numbersOf(Float32Array, json.arcs.first),
      second: numbersOf(Float32Array, json.arcs.second),
      turns: numbersOf(Float32Array, json.arcs.turns)
    };
  }

  /**
   * Cycles withdraw the tool by clearances that only the control knows. Where such a place is not
   * known along an axis, the tool is drawn where it was; before the next cut of a hole, where the
   * block's last cut ended.
   */
  fillGaps(isLathe, isOfCycle) {
    this.filled = this.axes.map((axis) => axis.slice());
    this.guessed = 0;
    this.fillRange(isLathe, isOfCycle, 0, this.count);
  }

  /**
   * The same of the moves [first, last), which begin a block, and of further ones as far as it makes
   * a difference; returns where that ends.
   */
  fillRange(isLathe, isOfCycle, first, last) {
    const { filled } = this,
      place = (i) => filled.map((axis) => axis[i]);
    const raw = (i) => {
      this.axes.forEach((axis, which) => {
        filled[which][i] = isLathe && which === 1 && Number.isNaN(axis[i]) ? 0 : axis[i];
      });
    };
    for (let i = first; i < last; ++i) raw(i);
    const before = this.lastTravel(first - 1),
      cutBefore = this.lastFeed(first - 1);
    let at = before < 0 ? null : place(before),
      cut = cutBefore < 0 ? null : place(cutBefore),
      cutLine = cutBefore < 0 ? 0 : this.line[cutBefore],
      isAsBefore = false; // the last place, of a further move
    for (let i = first; i < this.count; ++i) {
      const isFurther = i >= last;
      if (!this.isTravel(i)) continue;
      const former = isFurther ? place(i) : null;
      if (isFurther) {
        const isBegin = this.line[i] !== this.line[i - 1];
        if (isBegin && isAsBefore) return i;
        raw(i);
        // Outside of cycles nothing is filled, so that nothing comes of what is before it.
        if (isBegin && (known(place(i)) || !isOfCycle(i))) return i;
      }
      const to = place(i);
      if (isOfCycle(i) && !known(to) && at && known(at) && !(this.machine[i] & 0x80)) {
        const next = this.nextTravel(i),
          after = next < 0 ? to : place(next);
        // The last cut is between here and where the next one ends, all of them over each other.
        const isHole =
          next >= 0 &&
          this.kind[next] === Feed &&
          cut &&
          cutLine === this.line[i] &&
          cut.every((x, axis) =>
            Number.isNaN(to[axis])
              ? (x - at[axis]) * (x - after[axis]) <= 0
              : x === at[axis] && x === after[axis]
          );
        to.forEach((x, axis) => {
          if (Number.isNaN(x)) to[axis] = filled[axis][i] = isHole ? cut[axis] : at[axis];
        });
        ++this.guessed;
      }
      isAsBefore = isFurther && to.every((x, axis) => Object.is(x, former[axis]));
      at = to;
      if (this.kind[i] === Feed) {
        cut = to;
        cutLine = this.line[i];
      }
    }
    return this.count;
  }

  /** The last move from this one back that goes somewhere; -1: there is none. */
  lastTravel(move) {
    while (move >= 0 && !this.isTravel(move)) --move;
    return move;
  }
  /** The last cut from this one back. */
  lastFeed(move) {
    while (move >= 0 && this.kind[move] !== Feed) --move;
    return move;
  }
  nextTravel(move) {
    for (let i = move + 1; i < this.count; ++i) if (this.isTravel(i)) return i;
    return -1;
  }

  fileOf(move) {
    return this.fileNumbers[lastNotAbove(this.fileMoves, move)] ?? 0;
  }
  isTravel(move) {
    return this.kind[move] <= Thread;
  }
  place(move) {
    return move < 0 ? [NaN, NaN, NaN] : this.axes.map((axis) => axis[move]);
  }

  /**
   * Corners of the drawing and lengths of the moves. `shift(move)` moves a place. Of a lathe Y, which
   * is not told, is 0.
   */
  expand(isLathe, shift, classOf) {
    this.chooseFineness();
    return this.expandRange(isLathe, shift, classOf, 0, this.count);
  }

  /** The same of the moves [first, last); the corner where nothing is known yet is before move 0. */
  expandRange(isLathe, shift, classOf, first, last) {
    const lead = first === 0 ? 1 : 0;
    let arc = lastNotAbove(this.arcs.move, first - 1) + 1,
      total = lead;
    for (let i = first; i < last; ++i) if (this.isTravel(i)) ++total;
    for (let i = arc; i < this.arcs.move.length && this.arcs.move[i] < last; ++i)
      total += this.stepsOf(i, this.coarse) - 1;
    const places = new Float32Array(total * 3),
      kinds = new Uint8Array(total);
    const ofMove = new Uint32Array(total),
      firsts = new Uint32Array(last - first + 1);
    const lengths = new Float32Array(last - first);
    const before = this.lastTravel(first - 1);
    const at = before < 0 ? [NaN, isLathe ? 0 : NaN, NaN] : this.filled.map((axis) => axis[before]),
      to = [0, 0, 0];
    let n = lead,
      notDrawn = 0;
    if (lead) {
      places.fill(NaN, 0, 3);
      kinds[0] = hiddenClass;
    }
    const put = (place, offset, kind, move) => {
      for (let axis = 0; axis < 3; ++axis) places[n * 3 + axis] = place[axis] + offset[axis];
      kinds[n] = kind;
      ofMove[n++] = move;
    };
    for (let i = first; i < last; ++i) {
      firsts[i - first] = n;
      while (arc < this.arcs.move.length && this.arcs.move[arc] < i) ++arc;
      if (!this.isTravel(i)) continue;
      for (let axis = 0; axis < 3; ++axis) to[axis] = this.filled[axis][i];
      const isKnown = known(at) && known(to);
      const offset = shift(i);
      const kind = isKnown ? classOf(i) : hiddenClass;
      if (!isKnown) ++notDrawn;
      if (isKnown && this.kind[i] === Arc && this.arcs.move[arc] === i) {
        lengths[i - first] = this.putArc(arc, this.stepsOf(arc, this.coarse), at, to, (place) =>
          put(place, offset, kind, i)
        );
      } else {
        lengths[i - first] = partialLength(at, to);
        put(to, offset, kind, i);
      }
      for (let axis = 0; axis < 3; ++axis) at[axis] = to[axis];
    }
    firsts[last - first] = n;
    return {
      places: places.subarray(0, n * 3),
      kinds: kinds.subarray(0, n),
      ofMove: ofMove.subarray(0, n),
      firsts,
      lengths,
      count: n,
      notDrawn
    };
  }

  /** So coarse that there are not too many corners. */
  chooseFineness() {
    const count = this.arcs.move.length;
    for (this.coarse = 1; this.coarse <= 64; this.coarse *= 2) {
      let total = 0;
      for (let i = 0; i < count; ++i) total += this.stepsOf(i, this.coarse);
      if (total + this.count < mostVertices) return;
    }
  }

  /** Lines that are drawn for an arc. */
  stepsOf(arc, coarse) {
    const move = this.arcs.move[arc];
    const p = this.arcs.axes[arc] & 15,
      q = this.arcs.axes[arc] >> 4;
    const radius = Math.hypot(
      this.axes[p][move] - this.arcs.first[arc],
      this.axes[q][move] - this.arcs.second[arc]
    );
    // So many that a chord leaves the arc by no more than a hundredth of a millimetre, or a
    // thousandth of a large radius.
    const away = Math.max(0.01, radius / 1000) * coarse;
    const angle = 2 * Math.acos(Math.max(0, 1 - away / Math.max(radius, away)));
    const turn = Math.abs(this.arcs.turns[arc]) * 2 * Math.PI;
    return Math.min(2000, Math.max(1, Math.ceil(turn / Math.max(angle, 0.02)))) || 1;
  }

  /** Gives the corners of an arc to `put`; returns its length. */
  putArc(arc, steps, from, to, put) {
    const p = this.arcs.axes[arc] & 15,
      q = this.arcs.axes[arc] >> 4,
      r = 3 - p - q;
    const turn = this.arcs.turns[arc] * 2 * Math.PI;
    const cp = this.arcs.first[arc],
      cq = this.arcs.second[arc];
    if (!Number.isFinite(cp + cq)) {
      put(to);
      return partialLength(from, to);
    }
    const begin = Math.atan2(from[q] - cq, from[p] - cp);
    const r0 = Math.hypot(from[p] - cp, from[q] - cq),
      r1 = Math.hypot(to[p] - cp, to[q] - cq);
    const place = [0, 0, 0];
    for (let i = 1; i < steps; ++i) {
      const part = i / steps,
        angle = begin + turn * part,
        radius = r0 + (r1 - r0) * part;
      place[p] = cp + radius * Math.cos(angle);
      place[q] = cq + radius * Math.sin(angle);
      place[r] = from[r] + (to[r] - from[r]) * part;
      put(place);
    }
    put(to);
    return Math.hypot((Math.abs(turn) * (r0 + r1)) / 2, to[r] - from[r]);
  }
}

function known(place) {
  return Number.isFinite(place[0] + place[1] + place[2]);
}

/** Of the axes whose two ends are known. */
function partialLength(from, to) {
  let sum = 0;
  for (let axis = 0; axis < 3; ++axis) {
    const way = to[axis] - from[axis];
    if (Number.isFinite(way)) sum += way * way;
  }
  return Math.sqrt(sum);
}
