// The pane of the tool path: drawing, views, layers, and the slider over the blocks.

/** A line may leave the fine one by so many pixels at rest, with a graphics unit and without one. */
const awayAtRest = 0.35,
  awayAtSlowRest = 1;
/**
 * What is left out while the drawing moves: corners within so many pixels of the line, and all pieces
 * but each so many. The first is the finest.
 */
const qualities = [
  [0.7, 1],
  [1.5, 1],
  [4, 1],
  [10, 1],
  [10, 2],
  [10, 4],
  [10, 8],
  [16, 16],
  [16, 32]
];
/** So many frames must come early before the drawing gets finer; more where it was too fine before. */
const quickFrames = 12,
  mostQuickFrames = 60;
/** Milliseconds after the last movement until all of it is drawn. */
const restAfter = 160;
/** Milliseconds of a frame above which the drawing gets coarser while it moves, and below which finer. */
const slowFrame = 24,
  quickFrame = 18;
/** Corners that any browser draws in time, and those below which nothing is left out. */
const fewCorners = 8000,
  fewestCorners = 300;

class PathPane {
  constructor(app) {
    this.app = app;
    this.canvas = byId('scene');
    this.marks = byId('marks').getContext('2d');
    this.camera = new Camera();
    this.scene = (app.wantsFlat ? null : GlScene.on(this.canvas)) ?? new FlatScene(this.canvas);
    this.isFlat = this.scene instanceof FlatScene;
    this.path = null;
    this.layers = {
      rapid: true,
      feed: true,
      cycle: true,
      thread: true,
      centre: true,
      stock: true,
      travel: false,
      findings: true
    };
    this.mode = 'motion';
    this.range = null; // [first, last) of the moves of what alone is shown
    this.move = -1; // where the slider is; -1: before the first
    this.dims = false; // whether what comes after the slider is faint
    this.isMoving = false;
    this.quality = this.scene.isSlow ? 4 : 0;
    this.early = 0;
    this.enough = quickFrames;
    this.buildBar();
    this.buildSlider();
    listenToPointer(this);
    new ResizeObserver(() => this.resize()).observe(byId('stage'));
  }

  // ---- what is shown

  show(path, keepView) {
    this.path = path;
    if (path) {
      this.curves = [path.drawn, path.drawnCentre]
        .filter(Boolean)
        .map((drawn) => ({ drawn, levels: new Levels(drawn) }));
      for (const { levels } of this.curves) while (levels.prepare());
      this.scene.setCurves(this.curves);
      this.usePalette();
      if (!keepView) {
        this.range = null;
        this.dims = false;
        this.move = path.curve.count - 1;
        this.setView(path.isLathe ? 'turning' : 'corner');
      }
    } else {
      this.curves = [];
      this.scene.setCurves([]);
    }
    byId('tool-path').classList.toggle('empty', !path);
    this.fillBar();
    fillLegend(this);
    this.fillSlider();
    this.refresh();
  }

  usePalette() {
    this.scene.setPalette(paletteOf(this.mode, this.app.isDark()));
  }

  setView(name) {
    if (!this.path) return;
    this.camera.look(name === 'corner' && this.path.isLathe ? turningCorner : standardViews[name]);
    this.fit();
  }

  fit() {
    if (!this.path) return;
    const box = this.boxShown();
    this.camera.fit(box, this.width, this.height);
    this.refresh();
  }

  /** Of what is shown; of rapid moves that lead far away from the cuts no more than once their size. */
  boxShown() {
    const { drawn } = this.path,
      cuts = newBox(),
      all = newBox();
    const first = this.range ? drawn.firsts[this.range[0]] : 0,
      last = this.range ? drawn.firsts[this.range[1]] : drawn.count;
    for (let n = first; n < last; ++n) {
      const kind = drawn.kinds[n];
      if (kind === hiddenClass) continue;
      for (let axis = 0; axis < 3; ++axis) {
        const x = drawn.places[n * 3 + axis];
        for (const box of kind === 0 ? [all] : [all, cuts]) {
          if (x < box.min[axis]) box.min[axis] = x;
          if (x > box.max[axis]) box.max[axis] = x;
        }
      }
    }
    if (!Number.isFinite(cuts.min[0])) return all;
    const size = Math.hypot(...cuts.max.map((x, axis) => x - cuts.min[axis]));
    return {
      min: all.min.map((x, axis) => Math.max(x, cuts.min[axis] - size)),
      max: all.max.map((x, axis) => Math.min(x, cuts.max[axis] + size))
    };
  }

  /** Brings the place of a move into view. */
  reveal(move) {
    const place = drawnPlace(this.path, move);
    if (!place || !this.width) return;
    const [x, y] = this.camera.project(place),
      halfX = this.width / 2 - 30,
      halfY = this.height / 2 - 30;
    this.camera.pan(
      Math.max(-halfX, Math.min(halfX, x)) - x,
      y - Math.max(-halfY, Math.min(halfY, y))
    );
  }

  /** Shows one tool or operation alone; null: all. */
  isolate(range) {
    this.range = range;
    this.fit();
  }

  // ---- frames

  resize() {
    const stage = byId('stage'),
      ratio = Math.min(2, window.devicePixelRatio || 1);
    const hadSize = this.width > 0;
    this.width = stage.clientWidth;
    this.height = stage.clientHeight;
    for (const canvas of [this.canvas, byId('marks')]) {
      canvas.width = Math.max(1, Math.round(this.width * ratio));
      canvas.height = Math.max(1, Math.round(this.height * ratio));
    }
    if (hadSize && !this.camera.isFitted) this.refresh();
    else this.fit();
  }

  /** Draws soon. `moves`: more frames will follow. */
  refresh(moves = false) {
    if (moves) {
      this.isMoving = true;
      clearTimeout(this.restTimer);
      this.restTimer = setTimeout(() => {
        this.isMoving = false;
        this.enough = quickFrames;
        this.refresh();
      }, restAfter);
    }
    if (this.frame) return;
    this.frame = requestAnimationFrame((now) => {
      this.frame = 0;
      this.adapt(now);
      this.draw();
    });
  }

  /** Coarser where frames come late, finer where they come early. */
  adapt(now) {
    const took = now - (this.lastFrame ?? now);
    this.lastFrame = now;
    if (!this.isMoving || took <= 0 || took > 1000) return;
    this.early = took < quickFrame ? this.early + 1 : 0;
    // A path that is short anyway is not what makes frames late.
    if (took > slowFrame && this.corners > fewestCorners) {
      this.quality = Math.min(qualities.length - 1, this.quality + 1);
      this.enough = Math.min(mostQuickFrames, this.enough * 2);
    } else if (this.early > this.enough && this.quality > 0) {
      --this.quality;
      this.early = 0;
    }
  }

  view() {
    const { path, layers, move, range } = this,
      { drawn } = path,
      all = [0, 0x7fffffff];
    const isWhole = !this.dims || move >= path.curve.count - 1;
    // Numbers of corners before a move, of both paths.
    const corner = (at) => drawn.firsts[at],
      besides = (at) =>
        path.drawnCentre.firsts[
          at >= path.curve.count ? path.centre.count : path.centreEnds[path.blockOf(at)]
        ];
    const mask = classes.reduce((bits, name, i) => bits | (layers[name] ? 1 << i : 0), 0);
    return {
      camera: this.camera,
      width: this.width,
      height: this.height,
      mode: colourModes[this.mode],
      mask,
      heights: this.heights(),
      showCentre: layers.centre,
      centreColour: colourOf('motion', 4, this.app.isDark()),
      faint: 0.13,
      away: this.isMoving
        ? qualities[this.quality][0]
        : this.scene.isSlow
          ? awayAtSlowRest
          : awayAtRest,
      sparse:
        this.isMoving && this.curves[0].drawn.count > fewCorners ? qualities[this.quality][1] : 1,
      range: range ? range.map(corner) : all,
      limit: isWhole ? 0x7fffffff : move < 0 ? 0 : corner(move + 1) - 1,
      centreRange: range && path.drawnCentre ? range.map(besides) : all,
      centreLimit: isWhole || !path.drawnCentre ? 0x7fffffff : move < 0 ? 0 : besides(move) - 1
    };
  }

  heights() {
    const { extents } = this.app.measures;
    return Number.isFinite(extents.feed.min[2])
      ? [extents.feed.min[2], extents.feed.max[2]]
      : [0, 1];
  }

  draw() {
    if (!this.width) return;
    if (this.path) this.corners = this.scene.draw(this.view());
    drawMarks(this);
  }

  // ---- controls

  buildBar() {
    const bar = byId('tools-bar');
    const view = (name, label, key) =>
      make(
        'button',
        {
          type: 'button',
          title: `${label} (${key})`,
          data: { view: name },
          onclick: () => this.setView(name)
        },
        label
      );
    this.viewButtons = make('span', { className: 'group', role: 'group', ariaLabel: 'Views' });
    this.viewsOfMill = [
      view('corner', '3D', '1'),
      view('top', 'XY', '2'),
      view('front', 'XZ', '3'),
      view('right', 'YZ', '4')
    ];
    this.viewsOfLathe = [
      view('turning', 'ZX', '1'),
      view('corner', '3D', '2'),
      view('top', 'XY', '3')
    ];
    const fit = make(
      'button',
      {
        type: 'button',
        title: 'Show all (f)',
        onclick: () => {
          this.range = null;
          this.fit();
        }
      },
      'Fit'
    );
    this.modeSelect = make(
      'select',
      { ariaLabel: 'Colour by', onchange: () => this.setMode(this.modeSelect.value) },
      ...['motion', 'tool', 'operation', 'feed', 'height'].map((mode) =>
        make('option', { value: mode }, `colour by ${mode}`)
      )
    );
    this.layerBoxes = make('span', { className: 'layers' });
    bar.append(this.viewButtons, fit, this.modeSelect, this.layerBoxes);
  }

  setMode(mode) {
    this.mode = mode;
    this.modeSelect.value = mode;
    this.usePalette();
    fillLegend(this);
    this.refresh();
  }

  fillBar() {
    if (!this.path) return;
    this.viewButtons.replaceChildren(...(this.path.isLathe ? this.viewsOfLathe : this.viewsOfMill));
    const { machine } = this.path.json,
      used = new Set(this.path.drawn.kinds);
    const hasBox = (box) => box && [...box.min, ...box.max].some((x) => x !== null);
    const layers = [
      ['rapid', 'rapids', used.has(0)],
      ['feed', 'feeds', used.has(1)],
      ['cycle', 'cycles', used.has(2)],
      ['thread', 'threads', used.has(3)],
      ['centre', this.path.isLathe ? 'nose centre' : 'tool centre', Boolean(this.path.centre)],
      ['stock', 'stock', hasBox(machine.stock) || machine.clamps.length > 0],
      ['travel', 'travel', Boolean(this.path.origin) && hasBox(machine.envelope)],
      ['findings', 'findings', true]
    ];
    this.layerBoxes.replaceChildren(
      ...layers
        .filter(([, , has]) => has)
        .map(([name, label]) => {
          const box = make('input', {
            type: 'checkbox',
            checked: this.layers[name],
            onchange: () => {
              this.layers[name] = box.checked;
              this.refresh();
            }
          });
          return make('label', {}, box, label);
        })
    );
    if (this.path.originsKnown && this.path.usedOffsets.length > 1) {
      const box = make('input', {
        type: 'checkbox',
        checked: this.path.apart,
        onchange: () => {
          this.path.apart = box.checked;
          this.path.expand();
          this.show(this.path, true);
          this.fit();
        }
      });
      this.layerBoxes.append(
        make(
          'label',
          { title: 'Zero points at their places, or over each other' },
          box,
          'zero points apart'
        )
      );
    }
  }

  // ---- the slider

  buildSlider() {
    const step = (label, title, by) =>
      make('button', { type: 'button', title, onclick: () => this.stepBlock(by) }, label);
    this.slider = make('input', {
      type: 'range',
      min: 0,
      value: 0,
      step: 1,
      ariaLabel: 'Block',
      oninput: () => this.goToBlock(Number(this.slider.value) - 1)
    });
    this.playButton = make(
      'button',
      { type: 'button', title: 'Run (space)', onclick: () => this.play() },
      '▶'
    );
    this.position = make('output', { className: 'position' });
    byId('slider-bar').append(
      step('‹', 'Block before (←)', -1),
      this.playButton,
      step('›', 'Next block (→)', 1),
      this.slider,
      this.position
    );
  }

  fillSlider() {
    if (!this.path) return;
    this.slider.max = this.path.blocks.length;
    this.tellPlace();
  }

  /** Block -1 is before the first. */
  goToBlock(block) {
    if (!this.path) return;
    this.dims = true;
    this.goTo(block < 0 ? -1 : this.path.endOfBlock(Math.min(block, this.path.blocks.length - 1)));
    this.app.followMove(this.move);
  }

  stepBlock(by) {
    if (!this.path) return;
    const block = this.move < 0 ? -1 : this.path.blockOf(this.move);
    this.goToBlock(Math.max(-1, Math.min(this.path.blocks.length - 1, block + by)));
  }

  /** One move within the block. */
  stepMove(by) {
    if (!this.path) return;
    this.dims = true;
    this.goTo(Math.max(-1, Math.min(this.path.curve.count - 1, this.move + by)));
    this.app.followMove(this.move);
  }

  goTo(move) {
    this.move = move;
    this.tellPlace();
    this.refresh(true);
  }

  tellPlace() {
    const { path, move } = this;
    if (!path) return;
    const block = move < 0 ? 0 : path.blockOf(move) + 1;
    this.slider.value = block;
    this.position.textContent = `block ${block.toLocaleString('en')} of ${path.blocks.length.toLocaleString('en')} · ${clock(move < 0 ? 0 : this.app.measures.ends[move])}`;
    byId('place').replaceChildren(
      ...(move < 0 ? [] : placeTexts(path, move)).map((text) => make('span', {}, text))
    );
  }

  /** Runs through the blocks in about half a minute, or ends that. */
  play() {
    this.isPlaying = !this.isPlaying && Boolean(this.path);
    this.playButton.textContent = this.isPlaying ? '❚❚' : '▶';
    if (!this.isPlaying) return;
    this.dims = true;
    if (this.move >= this.path.curve.count - 1) this.move = -1;
    const { total, ends } = this.app.measures,
      seconds = Math.min(30, Math.max(4, this.path.blocks.length / 20));
    let at = this.move < 0 ? 0 : ends[this.move],
      last = 0;
    const step = (now) => {
      if (!this.isPlaying) return;
      at += last ? (((now - last) / 1000) * total) / seconds : 0;
      last = now;
      const move = total > 0 ? lastNotAbove(ends, at) : this.move + 1;
      if (move !== this.move) {
        this.goTo(Math.min(move, this.path.curve.count - 1));
        this.app.followMove(this.move);
      }
      if (this.move >= this.path.curve.count - 1) return this.play();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
