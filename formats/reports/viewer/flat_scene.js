// The drawing where there is no WebGL 2: the same view on a plain canvas.

/** Lines in one frame: what a processor draws in a few hundredths of a second. */
const mostFlatLines = 60_000;

/** In the place of an entry of the palette. */
const centreEntry = 256;

class FlatScene {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.curves = [];
    this.isSlow = true;
  }

  setPalette(bytes) {
    this.palette = bytes;
  }
  setCurves(curves) {
    this.curves = curves;
  }
  finish() {}

  draw(view) {
    const { context, canvas } = this,
      ratio = canvas.width / view.width;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.setTransform(ratio, 0, 0, -ratio, canvas.width / 2, canvas.height / 2);
    context.lineWidth = 1 / ratio;
    let lines = 0;
    // The path beside first: where both are one, the programmed one is seen.
    for (let i = this.curves.length - 1; i >= 0; --i)
      if (i === 0 || view.showCentre) lines += this.drawCurve(this.curves[i], view, i > 0);
    context.globalAlpha = 1;
    return lines;
  }

  drawCurve({ drawn, levels }, view, isCentre) {
    const { context } = this,
      rows = view.camera.rows();
    const runs = levels.visible(view.camera, view.width, view.height, view.sparse);
    let level = levels.choose(view.away / view.camera.scale);
    const linesOf = (which) =>
      runs.reduce(
        (sum, [first, last]) =>
          sum +
          (which === 0
            ? levels.starts[last] - levels.starts[first]
            : levels.levels[which].begins[last] - levels.levels[which].begins[first]),
        0
      );
    while (level + 1 < levels.levels.length && linesOf(level) > mostFlatLines) ++level;
    const step = Math.max(1, Math.ceil(linesOf(level) / mostFlatLines));
    const { places, classes } = drawn,
      index = levels.levels[level].index;
    const range = isCentre ? view.centreRange : view.range,
      limit = isCentre ? view.centreLimit : view.limit;
    let style = -1,
      isOpen = false,
      lines = 0;
    const flush = () => {
      if (isOpen) context.stroke();
      isOpen = false;
    };
    const point = (n) => {
      const i = n * 3;
      return [
        rows[0][0] * places[i] +
          rows[0][1] * places[i + 1] +
          rows[0][2] * places[i + 2] +
          rows[0][3],
        rows[1][0] * places[i] +
          rows[1][1] * places[i + 1] +
          rows[1][2] * places[i + 2] +
          rows[1][3]
      ];
    };
    for (const [first, last] of runs) {
      const begin = index
        ? Math.max(0, levels.levels[level].begins[first] - 1)
        : Math.max(0, levels.starts[first] - 1);
      const end = index
        ? levels.levels[level].begins[last]
        : levels.starts[last];
      let [x, y] = point(index ? index[begin] : begin);
      for (let i = begin + 1; i < end; ++i) {
        const n = index ? index[i] : i,
          [toX, toY] = point(n);
        const kind = classes[n * 4] & 7;
        const isSkipped = step > 1 && kind !== 0 && i % step !== 0;
        if (kind !== hiddenClass && (view.mask >> kind) & 1 && !isSkipped) {
          const isFaint = n < range[0] || n >= range[1] || n > limit;
          const now =
            (isCentre ? centreEntry : this.entry(view, classes, places, n, kind)) * 4 +
            (isFaint ? 2 : 0) +
            (kind === 0 ? 1 : 0);
          if (now !== style || !isOpen) {
            flush();
            this.setStyle(now, view);
            style = now;
            context.beginPath();
            isOpen = true;
          }
          context.moveTo(x, y);
          context.lineTo(toX, toY);
          ++lines;
        }
        x = toX;
        y = toY;
      }
    }
    flush();
    return lines;
  }

  entry(view, classes, places, n, kind) {
    if (view.mode === 0) return kind;
    if (view.mode < 4) return classes[n * 4 + view.mode];
    const [low, high] = view.heights;
    return (
      Math.max(
        0,
        Math.min(255, Math.round((255 * (places[n * 3 + 2] - low)) / Math.max(high - low, 1e-6)))
      ) || 0
    );
  }

  setStyle(style, view) {
    const i = (style >> 2) * 4,
      { palette } = this;
    this.context.strokeStyle = cssColour(
      style >> 2 === centreEntry ? view.centreColour : palette.subarray(i, i + 3)
    );
    this.context.globalAlpha = (style & 1 ? 0.55 : 1) * (style & 2 ? view.faint : 1);
  }
}
