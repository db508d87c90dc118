// Coarser versions of a drawing, for far views and while it is moved; pieces that can be left out.

/** Corners in one piece: so few that most of a close view is left out, so many that asking is cheap. */
const pieceSize = 512;
/** How far a coarse line leaves the fine one, as parts of the drawing's size. */
const coarseParts = [1 / 6000, 1 / 1500, 1 / 400, 1 / 120];

class Levels {
  constructor(drawn) {
    this.drawn = drawn;
    this.cut();
    this.levels = [{ away: 0, index: null }];
  }

  /** Cuts the drawing into pieces; `starts` is where each begins, and where the last one ends. */
  cut() {
    const { count } = this.drawn;
    this.pieces = Math.ceil(count / pieceSize);
    this.starts = new Uint32Array(this.pieces + 1);
    for (let piece = 0; piece < this.pieces; ++piece) this.starts[piece] = piece * pieceSize;
    this.starts[this.pieces] = count;
    this.bounds = new Float32Array(this.pieces * 6);
    for (let piece = 0; piece < this.pieces; ++piece) this.findBounds(piece);
    this.findBox();
  }

  /** The box of a piece, with the corner before it, where its first segment begins. */
  findBounds(piece) {
    const { places } = this.drawn,
      box = newBox();
    for (let n = Math.max(0, this.starts[piece] - 1); n < this.starts[piece + 1]; ++n)
      for (let axis = 0; axis < 3; ++axis) {
        const x = places[n * 3 + axis];
        if (x < box.min[axis]) box.min[axis] = x;
        if (x > box.max[axis]) box.max[axis] = x;
      }
    this.bounds.set(box.min, piece * 6);
    this.bounds.set(box.max, piece * 6 + 3);
  }

  /** The box of all. */
  findBox() {
    const { bounds } = this,
      all = newBox();
    for (let i = 0; i < bounds.length; i += 6)
      for (let axis = 0; axis < 3; ++axis) {
        if (bounds[i + axis] < all.min[axis]) all.min[axis] = bounds[i + axis];
        if (bounds[i + 3 + axis] > all.max[axis]) all.max[axis] = bounds[i + 3 + axis];
      }
    this.box = all;
    this.size =
      Math.hypot(...all.max.map((x, axis) => (Number.isFinite(x) ? x - all.min[axis] : 0))) || 1;
  }

  /** Makes one more level; false: there are all. */
  prepare() {
    const next = this.levels.length - 1;
    if (next >= coarseParts.length) return false;
    this.levels.push(this.coarser(this.size * coarseParts[next]));
    return true;
  }

  /** Leaves corners out that lie within `away` of the line from one that is kept. */
  coarser(away) {
    const index = new Uint32Array(this.drawn.count),
      begins = new Uint32Array(this.pieces + 1);
    let n = 0;
    for (let piece = 0; piece < this.pieces; ++piece) {
      begins[piece] = n;
      n = this.coarsen(piece, away, index, n);
    }
    begins[this.pieces] = n;
    return { away, index: index.slice(0, n), begins };
  }

  /** The corners of a piece that are kept go into `index` from `n` on; where the next one goes. */
  coarsen(piece, away, index, n) {
    const { places, classes, count } = this.drawn,
      begin = this.starts[piece],
      end = this.starts[piece + 1];
    let anchor = begin,
      dx = 0,
      dy = 0,
      dz = 0,
      reach = 0,
      hasDirection = false;
    for (let i = begin; i < end; ++i) {
      const next = i + 1;
      // Where the class, tool or operation changes, at gaps, and at both ends of pieces.
      let keep =
        i === begin ||
        next === end ||
        (classes[i * 4] & 7) === hiddenClass ||
        (classes[next * 4] & 7) !== (classes[i * 4] & 7) ||
        classes[next * 4 + 2] !== classes[i * 4 + 2] ||
        classes[next * 4 + 1] !== classes[i * 4 + 1];
      if (!keep && hasDirection) {
        // The next corner leaves the line, or goes back on it.
        const x = places[next * 3] - places[anchor * 3],
          y = places[next * 3 + 1] - places[anchor * 3 + 1],
          z = places[next * 3 + 2] - places[anchor * 3 + 2];
        const along = x * dx + y * dy + z * dz;
        keep = along < reach || x * x + y * y + z * z - along * along > away * away;
        reach = along;
      }
      if (keep) {
        index[n++] = i;
        anchor = i;
        hasDirection = false;
      }
      if (!hasDirection && next < count) {
        const x = places[next * 3] - places[anchor * 3],
          y = places[next * 3 + 1] - places[anchor * 3 + 1],
          z = places[next * 3 + 2] - places[anchor * 3 + 2];
        reach = Math.hypot(x, y, z);
        hasDirection = reach > away;
        dx = x / reach;
        dy = y / reach;
        dz = z / reach;
      }
    }
    return n;
  }

  /** The coarsest level that leaves the fine line by no more than `away` mm. */
  choose(away) {
    let best = 0;
    this.levels.forEach((level, i) => {
      if (level.away <= away) best = i;
    });
    return best;
  }

  /** Whether something of a piece can be within so many pixels of a place, which is seen by `rows`. */
  isNear(piece, rows, place, pixels) {
    const i = piece * 6,
      b = this.bounds;
    return place.every((at, row) => {
      const [x, y, z, w] = rows[row];
      const twice = x * (b[i] + b[i + 3]) + y * (b[i + 1] + b[i + 4]) + z * (b[i + 2] + b[i + 5]);
      const span =
        Math.abs(x) * (b[i + 3] - b[i]) +
        Math.abs(y) * (b[i + 4] - b[i + 1]) +
        Math.abs(z) * (b[i + 5] - b[i + 2]);
      return Math.abs(at - w - twice / 2) <= span / 2 + pixels[row];
    });
  }

  /** Whether a piece is drawn, one of so many. Which ones has no pattern that the eye would see. */
  isShown(piece, sparse) {
    return sparse === 1 || (Math.imul(piece, 0x9e3779b1) >>> 16) % sparse === 0;
  }

  /**
   * Both ends of each line of a level in the pieces that are shown: without a graphics unit a
   * thousand short strips take longer than all the lines in them.
   */
  thinned(level, sparse) {
    const { index, begins } = this.levels[level],
      found = [];
    for (let piece = 0; piece < this.pieces; ++piece) {
      if (!this.isShown(piece, sparse)) continue;
      const first = index ? begins[piece] : this.starts[piece],
        end = index ? begins[piece + 1] : this.starts[piece + 1];
      for (let i = Math.max(1, first); i < end; ++i)
        if (index) found.push(index[i - 1], index[i]);
        else found.push(i - 1, i);
    }
    return Uint32Array.from(found);
  }

  /** Runs [first, last) of pieces of which something can be inside the view, of those that are shown. */
  visible(camera, width, height, sparse) {
    const runs = [],
      rows = camera.rows(),
      half = [width / 2, height / 2];
    for (let piece = 0; piece < this.pieces; ++piece) {
      if (!this.isShown(piece, sparse) || !this.isNear(piece, rows, [0, 0], half)) continue;
      const last = runs[runs.length - 1];
      if (last && last[1] === piece) last[1] = piece + 1;
      else runs.push([piece, piece + 1]);
    }
    return runs;
  }
}
