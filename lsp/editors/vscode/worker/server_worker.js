// The server in a worker of the browser: messages of the protocol as they are, and files in memory. The module's own script is
// before this one in the same file.

/** The port over which files come and go. */
let port;
let module;
const early = []; // messages before the module is there
let timer;

/** Takes what the module writes to its standard output apart into messages. */
class Output {
  constructor() {
    this.bytes = new Uint8Array(0);
    this.decoder = new TextDecoder();
  }
  push(piece) {
    const joined = new Uint8Array(this.bytes.length + piece.length);
    joined.set(this.bytes);
    joined.set(piece, this.bytes.length);
    this.bytes = joined;
    while (this.next());
  }
  next() {
    const { bytes } = this;
    const end = bytes.findIndex((byte, i) => byte === 13 && bytes[i + 1] === 10 && bytes[i + 2] === 13 && bytes[i + 3] === 10);
    if (end < 0) return false;
    const length = Number(/content-length:\s*(\d+)/i.exec(this.decoder.decode(bytes.subarray(0, end)))?.[1] ?? 0);
    if (bytes.length < end + 4 + length) return false;
    postMessage(JSON.parse(this.decoder.decode(bytes.subarray(end + 4, end + 4 + length))));
    this.bytes = bytes.slice(end + 4 + length);
    return true;
  }
}

function give(message) {
  const body = new TextEncoder().encode(JSON.stringify(message));
  const at = module._malloc(Math.max(1, body.length));
  module.HEAPU8.set(body, at);
  module._ncvet_take(at, body.length);
  module._free(at);
  work();
}

/** Lets the module work whenever there is something to do, and takes messages in between. */
function work() {
  clearTimeout(timer);
  const until = module._ncvet_work();
  if (module._ncvet_exit_code() >= 0) close();
  else if (until >= 0) timer = setTimeout(work, until);
}

/** Files that come before the module is there are written before its first message. */
function take({ write, bytes, remove, read, id }) {
  const { FS } = module;
  if (write !== undefined) {
    FS.mkdirTree(write.slice(0, write.lastIndexOf('/')) || '/');
    FS.writeFile(write, bytes);
  } else if (remove !== undefined) {
    if (FS.analyzePath(remove).exists) FS.unlink(remove);
  } else if (read !== undefined) {
    port.postMessage({ id, bytes: FS.analyzePath(read).exists ? FS.readFile(read) : new Uint8Array() });
  }
}

async function start(bytes) {
  module = await createNcvetModule({
    wasmBinary: bytes,
    thisProgram: 'ncvet',
    printErr: (line) => console.warn(line),
    quit: (status, reason) => {
      throw reason;
    },
  });
  const { FS } = module;
  const output = new Output();
  const write = FS.write;
  FS.write = (stream, heap, offset, length, ...rest) => {
    if (stream.fd !== 1) return write(stream, heap, offset, length, ...rest);
    output.push(new Uint8Array(heap.buffer, heap.byteOffset + offset, length).slice());
    return length;
  };
  port.onmessage = ({ data }) => take(data);
  // Files that are waiting are taken before the first message.
  await new Promise((resolve) => setTimeout(resolve, 0));
  module.callMain(['lsp']);
  early.splice(0).forEach(give);
}

onmessage = ({ data }) => {
  if (data.ncvet === 'start') {
    port = data.port;
    start(data.module).catch((error) => console.error('ncvet:', error));
  } else if (module && early.length === 0 && module._ncvet_serves()) give(data);
  else early.push(data);
};
