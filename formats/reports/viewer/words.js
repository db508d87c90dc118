// Numbers and names as people read them.

function number(value) {
  if (value === null || !Number.isFinite(value)) return '?';
  const text = Math.abs(value) >= 1000 ? value.toFixed(1) : value.toFixed(3);
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

function clock(seconds) {
  if (!Number.isFinite(seconds)) return '?';
  if (seconds < 60) return `${seconds.toFixed(1)} s`;
  const whole = Math.round(seconds),
    h = Math.floor(whole / 3600),
    m = Math.floor(whole / 60) % 60,
    s = whole % 60;
  return h ? `${h} h ${m} min` : `${m} min ${s} s`;
}

function lengthText(mm) {
  return mm >= 10_000
    ? `${number(Math.round(mm / 10) / 100)} m`
    : `${number(Math.round(mm * 10) / 10)} mm`;
}

/** A message with its pieces of code set apart. */
function withCode(message) {
  return message.split('`').map((piece, i) => (i % 2 ? make('code', {}, piece) : piece));
}

function counted(count, one, several) {
  return `${count.toLocaleString('en')} ${count === 1 ? one : several}`;
}

function toolName(tool) {
  return tool === null ? 'no tool' : `T${tool}`;
}

function operationName(operation) {
  return [toolName(operation.tool), operation.comment, operation.cycle].filter(Boolean).join(' · ');
}

function range([low, high], unit = '') {
  if (!(low <= high)) return '';
  return `${number(low)}${low === high ? '' : ` – ${number(high)}`}${unit}`;
}

const feedUnits = ['', 'mm/min', 'mm/rev', '1/min'];

/** The coordinate as the program gives it. */
function coordinate(path, axis, value) {
  return axis === 0 && path.json.diameter ? 2 * value : value;
}

/** Where the tool is after a move, and what it does there. */
function placeTexts(path, move) {
  const { curve } = path,
    place = curve.place(move),
    setting = path.settingOf(move);
  const axes = (path.isLathe && !Number.isFinite(place[1]) ? [0, 2] : [0, 1, 2]).map(
    (axis) => `${axisName(path, axis)} ${number(coordinate(path, axis, place[axis]))}`
  );
  const others = new Map();
  for (let i = 0; i <= lastNotAbove(path.others.move, move); ++i)
    others.set(String.fromCharCode(path.others.kind[i]), path.others.value[i]);
  others.forEach((value, name) => axes.push(`${name} ${number(value)}`));
  const texts = [
    `line ${curve.line[move]}${path.json.files.length > 1 ? ` of ${path.json.files[curve.fileOf(move)]}` : ''}`,
    axes.join('  ')
  ];
  const kind = curve.kind[move];
  if (kind === Rapid) texts.push('rapid');
  else if (kind === Dwell) texts.push('dwell');
  else if (kind !== ToolChange) {
    const feed = path.feedOf(move);
    texts.push(`F ${number(feed.value)} ${feedUnits[feed.mode]}`.trim());
  }
  texts.push(toolName(setting.tool));
  if (setting.speed !== null)
    texts.push(`S ${number(setting.speed)}${setting.surfaceSpeed ? ' m/min' : ''}`);
  if (setting.workOffset) texts.push(setting.workOffset);
  if (setting.cycle) texts.push(setting.cycle);
  if (setting.side) texts.push(`tool on the ${setting.side}`);
  return texts;
}
