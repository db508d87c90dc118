// ncvet in Node: the module with the files of the computer, and the server on standard streams.
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const createModule = require('./module.js');
const { useHostFiles } = require('./host_files.js');
const { serve } = require('./server.js');

/** Exit code of the command line when something could not be checked. */
const exitTrouble = 2;

/**
 * Makes a module. `run(arguments)` gives the exit code of the command line; once, because a command
 * leaves settings of its own in the module's memory.
 */
async function createNcvet() {
  const module = await createModule({
    wasmBinary: fs.readFileSync(path.join(__dirname, 'ncvet.wasm')),
    thisProgram: 'ncvet',
    preRun: [(m) => Object.assign(m.ENV, process.env)],
    quit: (status, reason) => {
      throw reason;
    }
  });
  useHostFiles(module);
  return { module, run: (words) => runMain(module, words) };
}

function runMain(module, words) {
  try {
    return module.callMain(words);
  } catch (error) {
    if (error?.name === 'ExitStatus') return error.status;
    // What a crash is told by elsewhere: the module cannot go on.
    const why = error instanceof RangeError ? 'its stack is full' : error?.message ?? error;
    process.stderr.write(`ncvet: crashed: ${why}; please report this with the program\n`);
    return exitTrouble;
  }
}

/** Runs a command line; its exit code. A server goes on until its client says `exit`. */
async function main(words) {
  const { module, run } = await createNcvet();
  const status = run(words);
  return module._ncvet_serves() ? serve(module, process.stdin) : status;
}

module.exports = { createNcvet, main };
