// How long a program runs, and how far it goes. What nobody has said is assumed, and told as such.

/** Values that are taken where the machine profile has none. */
const assumed = { rapid: 10_000, toolChange: 5 };

/** The values that a time is made of, with those that are assumed. */
function timeBasis(machine) {
  return {
    rapid: machine.rapid ?? assumed.rapid,
    rapidAssumed: machine.rapid === null,
    toolChange: machine.toolChange ?? assumed.toolChange,
    toolChangeAssumed: machine.toolChange === null,
    acceleration: machine.acceleration,
    feedMax: machine.feedMax
  };
}

/** Speed of the spindle (1/min) at a radius (mm); NaN: not known. */
function spindleSpeed(setting, radius, machine) {
  if (setting.speed === null) return NaN;
  if (!setting.surfaceSpeed) return setting.speed;
  const limit = Math.min(setting.speedLimit ?? Infinity, machine.spindleMax ?? Infinity);
  return Math.min(limit, (1000 * setting.speed) / (2 * Math.PI * Math.max(radius, 1e-3)));
}

/** Seconds since the begin at the end of each move, and sums by what is done, by tool, by operation. */
function measure(path, basis) {
  const { curve, drawn } = path,
    machine = path.json.machine;
  const ends = new Float64Array(curve.count);
  const sums = { rapid: 0, feed: 0, dwell: 0, toolChange: 0 };
  const lengths = { rapid: 0, feed: 0 };
  const section = path.walk(),
    feedAt = changeWalk(path.feeds),
    dwellAt = changeWalk(path.dwells);
  const byTool = new Map(),
    byOperation = path.json.operations.map(() => newSum());
  const extents = { rapid: newBox(), feed: newBox() };
  let isNoted = false,
    now = 0,
    unknownFeeds = 0,
    lastSpeed = 0,
    current = -1,
    setting = noSetting,
    tool = null;
  const before = [0, 0, 0];
  for (let i = 0; i < curve.count; ++i) {
    const at = section(i);
    if (at !== current) {
      current = at;
      setting = path.json.settings[path.sections.setting[at]] ?? noSetting;
      if (!byTool.has(setting.tool)) byTool.set(setting.tool, newSum());
      tool = byTool.get(setting.tool);
      isNoted = false;
    }
    const operation = byOperation[path.sections.operation[at]] ?? newSum();
    const kind = curve.kind[i];
    const feed = feedAt(i),
      dwell = dwellAt(i);
    let seconds = 0,
      part = 'feed';
    if (kind === Dwell) {
      seconds = dwell >= 0 ? path.dwells.value[dwell] : NaN;
      part = 'dwell';
    } else if (kind === ToolChange) {
      seconds = basis.toolChange;
      part = 'toolChange';
    } else {
      const length = drawn.lengths[i];
      if (!isNoted) noteSetting(tool, setting);
      isNoted = true;
      part = kind === Rapid ? 'rapid' : 'feed';
      const speed =
        kind === Rapid ? basis.rapid : feedSpeed(path, feed, setting, i, length, basis, machine);
      seconds = length > 0 ? (60 * length) / speed : 0;
      if (basis.acceleration && speed > 0) {
        const { lost, reached } = lostTime(
          drawn,
          i,
          lastSpeed,
          speed / 60,
          basis.acceleration,
          before
        );
        seconds += lost;
        lastSpeed = reached;
      }
      lengths[part] += length;
      for (const sum of [tool, operation]) sum[part] += length;
      addPlace(extents[part], curve, i);
      if (part === 'feed') {
        addPlace(tool.box, curve, i);
        addPlace(operation.box, curve, i);
        if (feed >= 0) noteFeed(tool, path.feeds.value[feed], path.feeds.kind[feed]);
      }
    }
    if (!Number.isFinite(seconds)) {
      ++unknownFeeds;
      seconds = 0;
    }
    now += seconds;
    ends[i] = now;
    sums[part] += seconds;
    tool.seconds += seconds;
    operation.seconds += seconds;
    if (curve.isTravel(i)) ++operation.moves;
  }
  return { ends, sums, lengths, total: now, unknownFeeds, byTool, byOperation, extents, basis };
}

function newBox() {
  return { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
}
function newSum() {
  return {
    seconds: 0,
    rapid: 0,
    feed: 0,
    moves: 0,
    box: newBox(),
    speeds: [Infinity, -Infinity],
    surface: [Infinity, -Infinity],
    feeds: new Map(),
    lengthOffsets: new Set(),
    radiusOffsets: new Set()
  };
}

function changeWalk(changes) {
  let at = -1;
  return (i) => {
    while (at + 1 < changes.move.length && changes.move[at + 1] <= i) ++at;
    return at;
  };
}

function addPlace(box, curve, i) {
  for (let axis = 0; axis < 3; ++axis) {
    const x = curve.axes[axis][i];
    if (x < box.min[axis]) box.min[axis] = x;
    if (x > box.max[axis]) box.max[axis] = x;
  }
}

function noteSetting(sum, setting) {
  if (setting.lengthOffset !== null) sum.lengthOffsets.add(setting.lengthOffset);
  if (setting.radiusOffset !== null) sum.radiusOffsets.add(setting.radiusOffset);
  if (setting.speed === null) return;
  const range = setting.surfaceSpeed ? sum.surface : sum.speeds;
  range[0] = Math.min(range[0], setting.speed);
  range[1] = Math.max(range[1], setting.speed);
}

function noteFeed(sum, value, mode) {
  if (!Number.isFinite(value)) return;
  const range = sum.feeds.get(mode) ?? [Infinity, -Infinity];
  range[0] = Math.min(range[0], value);
  range[1] = Math.max(range[1], value);
  sum.feeds.set(mode, range);
}

/** mm/min of a move at feed; NaN: not known. */
function feedSpeed(path, feed, setting, move, length, basis, machine) {
  if (feed < 0) return NaN;
  const value = path.feeds.value[feed],
    mode = path.feeds.kind[feed];
  let speed = NaN;
  if (mode === 1) speed = value;
  else if (mode === 2)
    speed = value * spindleSpeed(setting, Math.abs(path.curve.axes[0][move]), machine);
  else if (mode === 3) speed = length * value;
  return basis.feedMax ? Math.min(speed, basis.feedMax) : speed;
}

/**
 * Seconds (`lost`) that a move takes beside a constant speed because axes speed up and brake, and the
 * speed that it reaches. The speed through a corner is that part of it that goes straight on.
 */
function lostTime(drawn, move, speedBefore, speed, acceleration, before) {
  const first = drawn.firsts[move],
    last = drawn.firsts[move + 1] - 1,
    p = drawn.places;
  const way = drawn.lengths[move];
  if (last < first || !(way > 0)) return { lost: 0, reached: speedBefore };
  let cosine = 0,
    length = 0,
    lengthBefore = 0;
  for (let axis = 0; axis < 3; ++axis) {
    const begin = p[first * 3 + axis] - p[first * 3 - 3 + axis];
    length += begin ** 2;
    lengthBefore += before[axis] ** 2;
    cosine += begin * before[axis];
    before[axis] = p[last * 3 + axis] - p[last * 3 - 3 + axis];
  }
  const straight = Math.max(0, cosine / Math.sqrt(length * lengthBefore)) || 0;
  const corner = Math.min(speedBefore, speed) * straight;
  const braking =
    speedBefore > corner ? (speedBefore - corner) ** 2 / (2 * acceleration * speedBefore) : 0;
  // A short move never reaches its speed.
  const reached = Math.min(speed, Math.sqrt(corner ** 2 + 2 * acceleration * way));
  const wayUp = (reached ** 2 - corner ** 2) / (2 * acceleration);
  const time = (reached - corner) / acceleration + (way - wayUp) / reached;
  return { lost: braking + time - way / speed, reached };
}
