// What is drawn over the path: boxes, findings, the tool, axes and a scale.

function styleOf(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function drawMarks(pane) {
  const { marks, width, height, path } = pane,
    ratio = marks.canvas.width / width;
  marks.setTransform(1, 0, 0, 1, 0, 0);
  marks.clearRect(0, 0, marks.canvas.width, marks.canvas.height);
  marks.setTransform(ratio, 0, 0, ratio, (ratio * width) / 2, (ratio * height) / 2);
  marks.font = '12px system-ui, sans-serif';
  if (!path) return;
  const { machine } = path.json;
  if (pane.layers.stock) {
    if (machine.stock) drawBox(pane, machine.stock, styleOf('--stock'), []);
    for (const clamp of machine.clamps) drawBox(pane, clamp, styleOf('--error'), []);
  }
  if (pane.layers.travel && path.origin) drawBox(pane, travelOf(path), styleOf('--quiet'), [6, 5]);
  if (pane.layers.findings) drawFindings(pane);
  drawTool(pane);
  drawAxes(pane);
  drawScale(pane);
}

/** The travel of the axes, seen from the zero point. */
function travelOf(path) {
  const { envelope } = path.json.machine,
    from = (x, axis) => (x === null ? null : x - path.origin[axis]);
  return { min: envelope.min.map(from), max: envelope.max.map(from) };
}

/** Bounds that a box does not have are those of the path. */
function drawBox(pane, box, colour, dash) {
  const shown = pane.curves[0].levels.box;
  const bound = (list, other) =>
    list.map((x, axis) => x ?? (Number.isFinite(other[axis]) ? other[axis] : 0));
  const low = bound(box.min, shown.min),
    high = bound(box.max, shown.max);
  const corner = (i) =>
    pane.camera.project([
      i & 1 ? high[0] : low[0],
      i & 2 ? high[1] : low[1],
      i & 4 ? high[2] : low[2]
    ]);
  const { marks } = pane;
  marks.strokeStyle = colour;
  marks.lineWidth = 1;
  marks.setLineDash(dash);
  marks.beginPath();
  for (let i = 0; i < 8; ++i)
    for (const bit of [1, 2, 4])
      if (!(i & bit)) {
        const [x, y] = corner(i),
          [toX, toY] = corner(i | bit);
        marks.moveTo(x, -y);
        marks.lineTo(toX, -toY);
      }
  marks.stroke();
  marks.setLineDash([]);
}

/** Place of the end of a move as it is drawn; null: it is not drawn. */
function drawnPlace(path, move) {
  if (move < 0) return null;
  const { drawn } = path,
    n = drawn.firsts[move + 1] - 1;
  if (n < 0) return null;
  const place = [drawn.places[n * 3], drawn.places[n * 3 + 1], drawn.places[n * 3 + 2]];
  return known(place) ? place : null;
}

/** The findings of the path with their places; found once for each path. */
function placedFindings(pane) {
  const { path, app } = pane;
  if (path.placed) return path.placed;
  path.placed = [];
  for (const finding of app.report.findings) {
    const file = path.json.files.indexOf(finding.path);
    if (file < 0) continue;
    const move = path.moveOfLine(file, finding.line),
      place = drawnPlace(path, move);
    finding.move = move;
    if (place) path.placed.push({ finding, place });
  }
  return path.placed;
}

function drawFindings(pane) {
  const { marks, app } = pane;
  for (const { finding, place } of placedFindings(pane)) {
    if (!app.isShown(finding) && finding !== app.selected) continue;
    const [x, y] = pane.camera.project(place),
      isSelected = finding === app.selected;
    marks.fillStyle = styleOf(`--${finding.severity}`);
    marks.strokeStyle = styleOf('--ground');
    marks.lineWidth = 1.5;
    marks.beginPath();
    marks.moveTo(x, -y);
    marks.arc(x, -y - (isSelected ? 17 : 12), isSelected ? 8 : 5, Math.PI * 0.8, Math.PI * 0.2);
    marks.closePath();
    marks.fill();
    marks.stroke();
  }
}

/** The finding whose mark is there (pixels from the middle, up). */
function findingAt(pane, x, y) {
  if (!pane.layers.findings) return null;
  const hit = placedFindings(pane).find(({ finding, place }) => {
    if (!pane.app.isShown(finding)) return false;
    const [px, py] = pane.camera.project(place);
    return Math.hypot(x - px, y - py - 12) < 8;
  });
  return hit?.finding ?? null;
}

/** Where the slider is: a ring, and the tool's circle where its radius is known. */
function drawTool(pane) {
  const { marks, path } = pane,
    place = drawnPlace(path, pane.move);
  if (!place) return;
  const [x, y] = pane.camera.project(place);
  marks.strokeStyle = styleOf('--ink');
  marks.fillStyle = styleOf('--accent');
  marks.lineWidth = 1.5;
  marks.beginPath();
  marks.arc(x, -y, 4.5, 0, 2 * Math.PI);
  marks.fill();
  marks.stroke();
  const tool = path.json.machine.tools[path.settingOf(pane.move).tool];
  if (path.isLathe || !tool?.radius) return;
  marks.setLineDash([3, 3]);
  marks.beginPath();
  for (let i = 0; i <= 48; ++i) {
    const angle = (i / 24) * Math.PI,
      [cx, cy] = pane.camera.project([
        place[0] + tool.radius * Math.cos(angle),
        place[1] + tool.radius * Math.sin(angle),
        place[2]
      ]);
    if (i) marks.lineTo(cx, -cy);
    else marks.moveTo(cx, -cy);
  }
  marks.stroke();
  marks.setLineDash([]);
}

function drawAxes(pane) {
  const { marks, camera, width, height, path } = pane,
    x0 = -width / 2 + 44,
    y0 = height / 2 - 44,
    length = 28;
  const colours = ['#d6453d', '#2e9e4f', '#2f6fd6'];
  ['X', 'Y', 'Z'].forEach((name, axis) => {
    const right = camera.axes[0][axis] * length,
      up = camera.axes[1][axis] * length;
    if (Math.hypot(right, up) < 3 || (path.isLathe && axis === 1 && Math.hypot(right, up) < 8))
      return;
    marks.strokeStyle = marks.fillStyle = colours[axis];
    marks.lineWidth = 2;
    marks.beginPath();
    marks.moveTo(x0, y0);
    marks.lineTo(x0 + right, y0 - up);
    marks.stroke();
    marks.textAlign = 'center';
    marks.textBaseline = 'middle';
    marks.fillText(name, x0 + right * 1.38, y0 - up * 1.38);
  });
  // The zero point.
  const [x, y] = camera.project([0, 0, 0]);
  marks.strokeStyle = styleOf('--quiet');
  marks.lineWidth = 1;
  marks.beginPath();
  marks.moveTo(x - 7, -y);
  marks.lineTo(x + 7, -y);
  marks.moveTo(x, -y - 7);
  marks.lineTo(x, -y + 7);
  marks.stroke();
}

function drawScale(pane) {
  const { marks, camera, width, height } = pane;
  const wanted = 110 / camera.scale,
    power = 10 ** Math.floor(Math.log10(wanted));
  const length = [5, 2, 1].map((x) => x * power).find((x) => x <= wanted) ?? power;
  const pixels = length * camera.scale,
    x = width / 2 - 18,
    y = height / 2 - 16;
  marks.strokeStyle = marks.fillStyle = styleOf('--quiet');
  marks.lineWidth = 1.5;
  marks.beginPath();
  marks.moveTo(x - pixels, y - 5);
  marks.lineTo(x - pixels, y);
  marks.lineTo(x, y);
  marks.lineTo(x, y - 5);
  marks.stroke();
  marks.textAlign = 'center';
  marks.textBaseline = 'bottom';
  marks.fillText(`${number(length)} mm`, x - pixels / 2, y - 5);
}
