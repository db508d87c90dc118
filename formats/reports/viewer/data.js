// What the page holds: JSON in inert elements, arrays of numbers in base64. See docs/trace-format.md.

/** The JSON of an element, which is then given back to the browser; null when there is none. */
function takeJson(id) {
  const element = document.getElementById(id);
  if (!element) return null;
  const value = JSON.parse(element.textContent);
  element.remove();
  return value;
}

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64),
    bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** An array of the type, over the bytes that the text holds. */
function numbersOf(Type, base64) {
  const bytes = bytesOf(base64);
  return new Type(bytes.buffer, 0, Math.floor(bytes.length / Type.BYTES_PER_ELEMENT));
}

/** Index of the last element of an ascending array that is not above the value; -1: all are. */
function lastNotAbove(array, value) {
  let low = 0,
    high = array.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (array[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** An element with properties and children; texts become text, never markup. */
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === 'data') Object.assign(element.dataset, value);
    else if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  for (const child of children.flat()) if (child !== null) element.append(child);
  return element;
}

const byId = (id) => document.getElementById(id);

/** A text with its lines and colours, read when it is first shown. */
class ProgramText {
  constructor(path, json) {
    this.path = path;
    this.text = json.text;
    this.cut = json.cut;
    const begins = [0];
    for (let at = json.text.indexOf('\n'); at >= 0; at = json.text.indexOf('\n', at + 1))
      begins.push(at + 1);
    this.begins = Uint32Array.from(begins);
    this.count = Math.max(1, begins.length - (json.text.endsWith('\n') ? 1 : 0));
    this.readColours(bytesOf(json.colours));
  }

  readColours(bytes) {
    let count = 0;
    for (let i = 0; i < bytes.length; ++i, ++count) {
      while (bytes[i] & 0x80) ++i;
      ++i;
      while (bytes[i] & 0x80) ++i;
      ++i;
    }
    this.starts = new Uint32Array(count);
    this.lengths = new Uint32Array(count);
    this.names = new Uint8Array(count);
    let at = 0,
      last = 0;
    const next = () => {
      let value = 0;
      for (let shift = 0; ; shift += 7) {
        const byte = bytes[at++];
        value |= (byte & 0x7f) << shift;
        if (!(byte & 0x80)) return value >>> 0;
      }
    };
    for (let i = 0; i < count; ++i) {
      this.starts[i] = last + next();
      this.lengths[i] = next();
      this.names[i] = bytes[at++];
      last = this.starts[i] + this.lengths[i];
    }
  }

  /** The line (from 1) without its end. */
  line(number) {
    const begin = this.begins[number - 1] ?? this.text.length;
    const end = this.begins[number] === undefined ? this.text.length : this.begins[number] - 1;
    return this.text.slice(
      begin,
      this.text[end] === '\n' || end === this.text.length ? end : end + 1
    );
  }

  /** Pieces [begin, end, name, definition] of a line that have a colour. */
  colours(number) {
    const begin = this.begins[number - 1] ?? this.text.length;
    const end = begin + this.line(number).length,
      pieces = [];
    for (
      let i = Math.max(0, lastNotAbove(this.starts, begin));
      i < this.starts.length && this.starts[i] < end;
      ++i
    )
      if (this.starts[i] >= begin)
        pieces.push([
          this.starts[i] - begin,
          this.starts[i] - begin + this.lengths[i],
          this.names[i] & 0x7f,
          this.names[i] >> 7
        ]);
    return pieces;
  }
}

/** Columns count characters, strings of JavaScript count units of UTF-16. */
function unitOfColumn(text, column) {
  let unit = 0;
  for (let left = column - 1; left > 0 && unit < text.length; --left)
    unit += text.codePointAt(unit) > 0xffff ? 2 : 1;
  return unit;
}
