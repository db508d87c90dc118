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
    const { filled } = this,
      place = (i) => filled.map((axis) => axis[i]);
    if (isLathe)
      filled[1].forEach((y, i) => {
        if (Number.isNaN(y)) filled[1][i] = 0;
      });
    let at = null,
      cut = null,
      cutLine = 0;
    for (let i = 0; i < this.count; ++i) {
      if (!this.isTravel(i)) continue;
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
      at = to;
      if (this.kind[i] === Feed) {
        cut = to;
        cutLine = this.line[i];
      }
    }
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
    const arcSteps = this.stepsOfArcs();
    let total = 1;
    for (let i = 0; i < this.count; ++i) if (this.isTravel(i)) ++total;
    for (const steps of arcSteps) total += steps - 1;
    const places = new Float32Array(total * 3),
      kinds = new Uint8Array(total);
    const ofMove = new Uint32Array(total),
      firsts = new Uint32Array(this.count + 1);
    const lengths = new Float32Array(this.count);
    const at = [NaN, isLathe ? 0 : NaN, NaN],
      to = [0, 0, 0];
    let n = 1,
      arc = 0,
      notDrawn = 0;
    places.fill(NaN, 0, 3);
    kinds[0] = hiddenClass;
    const put = (place, offset, kind, move) => {
      for (let axis = 0; axis < 3; ++axis) places[n * 3 + axis] = place[axis] + offset[axis];
      kinds[n] = kind;
      ofMove[n++] = move;
    };
    for (let i = 0; i < this.count; ++i) {
      firsts[i] = n;
      while (arc < this.arcs.move.length && this.arcs.move[arc] < i) ++arc;
      if (!this.isTravel(i)) continue;
      for (let axis = 0; axis < 3; ++axis) to[axis] = this.filled[axis][i];
      const isKnown = known(at) && known(to);
      const offset = shift(i);
      const kind = isKnown ? classOf(i) : hiddenClass;
      if (!isKnown) ++notDrawn;
      if (isKnown && this.kind[i] === Arc && this.arcs.move[arc] === i) {
        lengths[i] = this.putArc(arc, arcSteps[arc], at, to, (place) =>
          put(place, offset, kind, i)
        );
      } else {
        lengths[i] = partialLength(at, to);
        put(to, offset, kind, i);
      }
      for (let axis = 0; axis < 3; ++axis) at[axis] = to[axis];
    }
    firsts[this.count] = n;
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

  stepsOfArcs() {
    const count = this.arcs.move.length,
      steps = new Uint16Array(count);
    for (let coarse = 1; ; coarse *= 2) {
      let total = 0;
      for (let i = 0; i < count; ++i) {
        const move = this.arcs.move[i];
        const p = this.arcs.axes[i] & 15,
          q = this.arcs.axes[i] >> 4;
        const radius = Math.hypot(
          this.axes[p][move] - this.arcs.first[i],
          this.axes[q][move] - this.arcs.second[i]
        );
        // So many that a chord leaves the arc by no more than a hundredth of a millimetre, or a
        // thousandth of a large radius.
        const away = Math.max(0.01, radius / 1000) * coarse;
        const angle = 2 * Math.acos(Math.max(0, 1 - away / Math.max(radius, away)));
        const turn = Math.abs(this.arcs.turns[i]) * 2 * Math.PI;
        steps[i] = Math.min(2000, Math.max(1, Math.ceil(turn / Math.max(angle, 0.02)))) || 1;
        total += steps[i];
      }
      if (total + this.count < mostVertices || coarse > 64) return steps;
    }
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
