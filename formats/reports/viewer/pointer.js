// Mouse and fingers on the drawing.

/** Drag, wheel, fingers and clicks on the drawing. */
function listenToPointer(pane) {
  const { canvas } = pane,
    fingers = new Map();
  let moved = 0;
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, {
      x: event.clientX,
      y: event.clientY,
      pans: event.button !== 0 || event.shiftKey || event.ctrlKey
    });
    moved = 0;
  });
  canvas.addEventListener('pointermove', (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger || !pane.path) return;
    const right = event.clientX - finger.x,
      down = event.clientY - finger.y;
    moved += Math.abs(right) + Math.abs(down);
    if (fingers.size > 1) pinch(pane, fingers, event);
    else if (finger.pans) pane.camera.pan(right, down);
    else if (moved > 3)
      pane.camera.orbit(right * 0.01, down * 0.01, pane.path.isLathe ? [1, 0, 0] : [0, 0, 1]);
    finger.x = event.clientX;
    finger.y = event.clientY;
    pane.refresh(true);
  });
  const end = (event) => {
    if (fingers.delete(event.pointerId) && moved <= 3 && event.type === 'pointerup')
      pick(pane, event);
  };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const [right, down] = fromMiddle(pane, event);
      pane.camera.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), right, down);
      pane.refresh(true);
    },
    { passive: false }
  );
  canvas.addEventListener('dblclick', () => pane.fit());
  canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
  canvas.addEventListener('webglcontextrestored', () => location.reload());
}

/** Two fingers: nearer or further, and along. */
function pinch(pane, fingers, event) {
  const [a, b] = [...fingers.values()],
    before = Math.hypot(a.x - b.x, a.y - b.y);
  const moving = fingers.get(event.pointerId),
    other = moving === a ? b : a;
  const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
  const [right, down] = fromMiddle(pane, {
    clientX: (event.clientX + other.x) / 2,
    clientY: (event.clientY + other.y) / 2
  });
  if (before > 0 && after > 0) pane.camera.zoom(after / before, right, down);
  pane.camera.pan((event.clientX - moving.x) / 2, (event.clientY - moving.y) / 2);
}

function fromMiddle(pane, event) {
  const box = pane.canvas.getBoundingClientRect();
  return [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2];
}

/** The move nearest to the mouse, when one is near. */
function pick(pane, event) {
  if (!pane.path) return;
  const [right, down] = fromMiddle(pane, event),
    finding = findingAt(pane, right, -down);
  if (finding) return pane.app.selectFinding(finding);
  const { drawn, levels } = pane.curves[0],
    rows = pane.camera.rows(),
    near = 7,
    view = pane.view();
  const p = drawn.places;
  let best = near,
    found = -1;
  const project = (row, i) =>
    rows[row][0] * p[i] + rows[row][1] * p[i + 1] + rows[row][2] * p[i + 2] + rows[row][3];
  for (let piece = 0; piece < levels.pieces; ++piece) {
    if (!levels.isNear(piece, rows, [right, -down], [near, near])) continue;
    for (let n = Math.max(1, levels.starts[piece]); n < levels.starts[piece + 1]; ++n) {
      const kind = drawn.kinds[n];
      if (
        kind === hiddenClass ||
        !((view.mask >> kind) & 1) ||
        n < view.range[0] ||
        n >= view.range[1] ||
        n > view.limit
      )
        continue;
      const away = distanceTo(
        right,
        -down,
        project(0, n * 3 - 3),
        project(1, n * 3 - 3),
        project(0, n * 3),
        project(1, n * 3)
      );
      if (away < best) {
        best = away;
        found = drawn.ofMove[n];
      }
    }
  }
  if (found < 0) return;
  pane.goTo(found);
  pane.app.followMove(found);
}

/** Of a point from a line between two points. */
function distanceTo(x, y, ax, ay, bx, by) {
  const dx = bx - ax,
    dy = by - ay,
    square = dx * dx + dy * dy;
  const part = square > 0 ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return Math.hypot(x - ax - part * dx, y - ay - part * dy);
}
