// Where the drawing is looked at from: parallel lines stay parallel, as in a drawing of the part.

/** Directions to the right, up, and towards the viewer, of the views that have a name. */
const standardViews = {
  top: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1]
  ],
  front: [
    [1, 0, 0],
    [0, 0, 1],
    [0, -1, 0]
  ],
  right: [
    [0, 1, 0],
    [0, 0, 1],
    [1, 0, 0]
  ],
  turning: [
    [0, 0, 1],
    [1, 0, 0],
    [0, 1, 0]
  ],
  corner: [
    [0.7071, 0.7071, 0],
    [-0.4082, 0.4082, 0.8165],
    [0.5774, -0.5774, 0.5774]
  ]
};
const turningCorner = [
  [-0.35, 0.25, 0.9028],
  [0.9, 0.2, 0.2935],
  [0, 1, 0]
];

class Camera {
  constructor() {
    this.axes = standardViews.corner.map((axis) => [...axis]);
    this.target = [0, 0, 0];
    this.scale = 1; // pixels for each millimetre
    this.isFitted = false; // all is shown, and nobody has looked elsewhere since
  }

  look(axes) {
    this.axes = orthogonal(axes);
  }

  /** Turns about the axis that is up at the part, and tips. */
  orbit(right, down, up) {
    const turn = rotation(up, -right),
      tip = rotation(this.axes[0], -down);
    this.axes = orthogonal(this.axes.map((axis) => apply(tip, apply(turn, axis))));
  }

  pan(right, down) {
    if (right || down) this.isFitted = false;
    for (let i = 0; i < 3; ++i)
      this.target[i] -= (right * this.axes[0][i] - down * this.axes[1][i]) / this.scale;
  }

  /** Keeps the point at that distance (pixels) from the middle where it is. */
  zoom(factor, right, down) {
    this.isFitted = false;
    const scale = Math.min(1e6, Math.max(1e-6, this.scale * factor)),
      shift = 1 / this.scale - 1 / scale;
    for (let i = 0; i < 3; ++i)
      this.target[i] += (right * this.axes[0][i] - down * this.axes[1][i]) * shift;
    this.scale = scale;
  }

  /** Shows all of a box. */
  fit(box, width, height) {
    if (
      !Number.isFinite(box.min[0] + box.max[0] + box.min[1] + box.max[1] + box.min[2] + box.max[2])
    )
      return;
    this.target = box.min.map((x, axis) => (x + box.max[axis]) / 2);
    const half = box.min.map((x, axis) => (box.max[axis] - x) / 2);
    const reach = (row) =>
      Math.max(
        1e-3,
        2 * this.axes[row].reduce((sum, x, axis) => sum + Math.abs(x) * half[axis], 0)
      );
    this.scale = 0.86 * Math.min(width / reach(0), height / reach(1));
    this.isFitted = true;
  }

  /** Rows that make pixels from the middle of a place: right, up, and depth in pixels. */
  rows() {
    return this.axes.map((axis) => {
      const row = axis.map((x) => x * this.scale);
      row.push(-row.reduce((sum, x, i) => sum + x * this.target[i], 0));
      return row;
    });
  }

  project(place) {
    return this.rows().map(
      (row) => row[0] * place[0] + row[1] * place[1] + row[2] * place[2] + row[3]
    );
  }
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
function unit(a) {
  const length = Math.hypot(...a) || 1;
  return a.map((x) => x / length);
}
function orthogonal([right, up]) {
  const r = unit(right),
    back = unit(cross(r, up));
  return [r, cross(back, r), back];
}
/** Turns by an angle about a direction. */
function rotation(axis, angle) {
  const [x, y, z] = unit(axis),
    c = Math.cos(angle),
    s = Math.sin(angle),
    t = 1 - c;
  return [
    [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
    [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
    [t * x * z - s * y, t * y * z + s * x, t * z * z + c]
  ];
}
function apply(matrix, v) {
  return matrix.map((row) => dot(row, v));
}
