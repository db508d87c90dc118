// Runs what the test sends, with `vscode` in sight, and answers with its result as JSON.
const http = require('node:http');
const vscode = require('vscode');

exports.activate = () => {
  const server = http.createServer(async (request, response) => {
    let text = '';
    for await (const piece of request) text += piece;
    try {
      const run = new Function('vscode', 'return (async () => {' + text + '})()');
      response.end(JSON.stringify({ result: (await run(vscode)) ?? null }));
    } catch (error) {
      response.end(JSON.stringify({ error: String(error?.stack ?? error) }));
    }
  });
  server.listen(Number(process.env.NCVET_PROBE_PORT), '127.0.0.1');
};
