// ncvet in a worker of the page: a command line for each message, over files in memory.
'use strict';

importScripts('module.js');

/** The code is compiled once; each command line gets a module of its own, and none leaves anything. */
const compiled = WebAssembly.compileStreaming(fetch('ncvet.wasm'));

/** Runs a command line over `files` (text by name): its exit code, what it printed, files after it. */
async function run(words, files, wanted) {
  const code = await compiled;
  const printed = [],
    complaints = [];
  const module = await createNcvetModule({
    instantiateWasm: (imports, received) => {
      WebAssembly.instantiate(code, imports).then((instance) => received(instance, code));
      return {};
    },
    thisProgram: 'ncvet',
    print: (line) => printed.push(line),
    printErr: (line) => complaints.push(line),
    quit: (status, reason) => {
      throw reason;
    }
  });
  module.FS.mkdir('/parts');
  module.FS.chdir('/parts');
  for (const [name, text] of Object.entries(files)) module.FS.writeFile(name, text);
  let status;
  try {
    status = module.callMain(words);
  } catch (error) {
    if (error?.name !== 'ExitStatus') throw error;
    status = error.status;
  }
  const after = Object.fromEntries(
    wanted.map((name) => [
      name,
      module.FS.analyzePath(name).exists ? module.FS.readFile(name, { encoding: 'utf8' }) : null
    ])
  );
  return { status, printed: printed.join('\n'), complaints: complaints.join('\n'), files: after };
}

const dialectWords = (control) => (control ? ['--dialect', control] : []);

const requests = {
  async check({ name, text, control }) {
    const words = ['check', '--exit-zero', '--format', 'json', '-o', '../report.json'];
    const { complaints, files } = await run(
      [...words, '--report', 'html:../report.html', ...dialectWords(control), name],
      { [name]: text },
      ['../report.json', '../report.html']
    );
    if (files['../report.json'] === null) throw new Error(complaints);
    return { report: JSON.parse(files['../report.json']), page: files['../report.html'] };
  },

  async fix({ name, text, control }) {
    const { files } = await run(
      ['check', '--fix', '--exit-zero', '--quiet', ...dialectWords(control), name],
      { [name]: text },
      [name]
    );
    return { text: files[name] };
  },

  async explain({ rule, control }) {
    const { printed, complaints } = await run(
      ['explain', ...dialectWords(control), rule],
      {},
      []
    );
    return { page: printed || complaints };
  }
};

onmessage = async ({ data }) => {
  try {
    const started = performance.now();
    const answer = await requests[data.kind](data);
    postMessage({ id: data.id, answer, took: performance.now() - started });
  } catch (error) {
    postMessage({ id: data.id, error: String(error?.message ?? error) });
  }
};
compiled.then(
  () => postMessage({ ready: true }),
  (error) => postMessage({ failed: String(error) })
);
