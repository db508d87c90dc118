// The language server on streams: takes messages apart and lets the module work in between.
'use strict';

/** A header that is longer is none. */
const mostHeaderBytes = 4096;
/** Longer messages end the server: a program of 100 MB with its escapes fits. */
const mostBytes = 512 * 1024 * 1024;

/** Bodies of messages out of pieces of a stream. */
class Messages {
  constructor(take) {
    this.take = take;
    this.pieces = [];
    this.size = 0;
    this.wanted = null; // bytes of the body that is being received
  }

  push(piece) {
    this.pieces.push(piece);
    this.size += piece.length;
    while (this.next());
  }

  next() {
    if (this.wanted === null && !this.readHeader()) return false;
    if (this.size < this.wanted) return false;
    const bytes = this.joined();
    const body = bytes.subarray(0, this.wanted);
    this.keep(bytes.subarray(this.wanted));
    this.wanted = null;
    this.take(body);
    return true;
  }

  joined() {
    return this.pieces.length === 1 ? this.pieces[0] : Buffer.concat(this.pieces, this.size);
  }
  keep(rest) {
    this.pieces = [rest];
    this.size = rest.length;
  }

  readHeader() {
    const bytes = this.joined();
    this.keep(bytes);
    const end = bytes.indexOf('\r\n\r\n');
    if (end < 0) {
      if (bytes.length > mostHeaderBytes) throw new Error('what arrives is no message');
      return false;
    }
    const header = bytes.toString('latin1', 0, end);
    const length = /(?:^|\r\n)content-length:[ \t]*([0-9]{1,12})[ \t]*(?:\r\n|$)/i.exec(header);
    this.keep(bytes.subarray(end + 4));
    this.wanted = length ? Number(length[1]) : 0;
    if (this.wanted > mostBytes) throw new Error('a message is too long');
    return true;
  }
}

/** Gives the module the body of a message. */
function give(module, body) {
  const at = module._malloc(Math.max(1, body.length));
  module.HEAPU8.set(body, at);
  module._ncvet_take(at, body.length);
  module._free(at);
}

/** Lets the module work whenever there is something to do; gives a function that tells it of more. */
function workOf(module, done) {
  let timer, immediate;
  const go = () => {
    immediate = undefined;
    const until = module._ncvet_work();
    if (module._ncvet_exit_code() >= 0) return done(module._ncvet_exit_code());
    if (until === 0) immediate = setImmediate(go);
    else if (until > 0) timer = setTimeout(go, until);
  };
  return () => {
    clearTimeout(timer);
    immediate ??= setImmediate(go);
  };
}

/** Serves the client that writes to `input` until it says `exit` or goes away: the exit code. */
function serve(module, input) {
  return new Promise((resolve, reject) => {
    const work = workOf(module, resolve);
    const messages = new Messages((body) => {
      give(module, body);
      work();
    });
    input.on('data', (piece) => {
      try {
        messages.push(piece);
        if (module._ncvet_exit_code() >= 0) resolve(module._ncvet_exit_code());
      } catch (error) {
        reject(error);
      }
    });
    input.on('end', () => resolve(1)); // it did not say `exit`
    input.on('error', reject);
  });
}

module.exports = { serve };
