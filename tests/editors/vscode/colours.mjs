// Compares the colours of a TextMate grammar, or of one of tree-sitter, with the server's semantic tokens, byte for byte:
//   node colours.mjs MODULES NCVET FOLDER_OF_GRAMMARS PROGRAM::LANGUAGE...
// prints a line for each piece of text that has two colours, and last how much of the text agrees.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { load, wordsOf } from '../tree_sitter/grammar.mjs';

const [modules, ncvet, grammars, ...programs] = process.argv.slice(2);
const require = createRequire(path.join(modules, 'nothing.js'));
const { Registry, INITIAL } = require('vscode-textmate');
const oniguruma = require('vscode-oniguruma');
const wasm = fs.readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm'));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));

const scopeOf = (language) => 'source.' + language.replace('ncvet-', 'gcode.');
const registry = new Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async (scope) => {
    const language = scope.replace('source.', '').replace('gcode.', 'ncvet-');
    return JSON.parse(fs.readFileSync(path.join(grammars, language + '.tmLanguage.json'), 'utf8'));
  },
});

/** What both call the kinds of text. */
const kinds = {
  'entity.name.function.program': 'program', 'entity.name.label': 'label', 'keyword.control': 'keyword',
  'support.function.code': 'code', 'keyword.other.miscellaneous': 'miscellaneous', 'keyword.operator': 'operator',
  'support.function': 'function', 'storage.type': 'type', 'constant.language': 'symbol', 'variable.other': 'variable',
  'variable.parameter.axis': 'axis', 'variable.parameter': 'parameter', 'constant.numeric': 'number',
  'comment.line': 'comment', 'comment.block': 'comment', 'string.quoted': 'string',
};
const types = {
  function: 'code', macro: 'miscellaneous', keyword: 'keyword', property: 'axis', parameter: 'parameter', number: 'number',
  variable: 'variable', method: 'function', class: 'program', label: 'label', enumMember: 'symbol', type: 'type',
  operator: 'operator', string: 'string', comment: 'comment',
};

/** Nodes of tree-sitter that have other names. */
const nodes = { block_number: 'label', tape: 'keyword', unknown: '', other: '' };

function treeColours(lines, file) {
  const grammar = load(file);
  return lines.map((line) => {
    const colours = Array(line.length).fill('');
    for (const { node, begin, end } of wordsOf(grammar, line)) colours.fill(nodes[node] ?? node, begin, end);
    return colours;
  });
}

/** A kind for each character of each line; '' where there is no colour. */
async function grammarColours(lines, language) {
  const tree = path.join(grammars, language, 'grammar.js');
  if (fs.existsSync(tree)) return treeColours(lines, tree);
  const grammar = await registry.loadGrammar(scopeOf(language));
  let state = INITIAL;
  return lines.map((line) => {
    const result = grammar.tokenizeLine(line, state);
    state = result.ruleStack;
    const colours = Array(line.length).fill('');
    for (const token of result.tokens) {
      const scope = token.scopes.at(-1).replace(/\.gcode.*$/, '');
      colours.fill(token.scopes.length > 1 ? kinds[scope] : '', token.startIndex, token.endIndex);
    }
    return colours;
  });
}

/** One conversation with the server: the semantic tokens of each program. */
class Server {
  constructor() {
    this.process = spawn(ncvet, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.buffer = Buffer.alloc(0);
    this.waiting = new Map();
    this.id = 0;
    this.process.stdout.on('data', (data) => this.take(data));
  }
  take(data) {
    this.buffer = Buffer.concat([this.buffer, data]);
    for (;;) {
      const head = this.buffer.indexOf('\r\n\r\n');
      if (head < 0) return;
      const length = Number(/Content-Length: (\d+)/i.exec(this.buffer.subarray(0, head))[1]);
      if (this.buffer.length < head + 4 + length) return;
      const message = JSON.parse(this.buffer.subarray(head + 4, head + 4 + length));
      this.buffer = this.buffer.subarray(head + 4 + length);
      if (message.method) continue;
      this.waiting.get(message.id)?.(message.result);
      this.waiting.delete(message.id);
    }
  }
  send(message) {
    const text = JSON.stringify({ jsonrpc: '2.0', ...message });
    this.process.stdin.write(`Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`);
  }
  ask(method, params) {
    const id = ++this.id;
    this.send({ id, method, params });
    return new Promise((resolve) => this.waiting.set(id, resolve));
  }
  async start() {
    const answer = await this.ask('initialize', {
      processId: null, rootUri: null,
      capabilities: { textDocument: { semanticTokens: { requests: { full: true }, tokenTypes: [], tokenModifiers: [], formats: ['relative'] } } },
    });
    this.legend = answer.capabilities.semanticTokensProvider.legend.tokenTypes;
    this.send({ method: 'initialized', params: {} });
  }
  async colours(file, language, text, lines) {
    const uri = pathToFileURL(path.resolve(file)).href;
    this.send({ method: 'textDocument/didOpen', params: { textDocument: { uri, languageId: language, version: 1, text } } });
    const { data } = await this.ask('textDocument/semanticTokens/full', { textDocument: { uri } });
    const colours = lines.map((line) => Array(line.length).fill(''));
    for (let i = 0, line = 0, at = 0; i < data.length; i += 5) {
      at = data[i] ? data[i + 1] : at + data[i + 1];
      line += data[i];
      colours[line]?.fill(types[this.legend[data[i + 3]]], at, at + data[i + 2]);
    }
    this.send({ method: 'textDocument/didClose', params: { textDocument: { uri } } });
    return colours;
  }
}

const server = new Server();
await server.start();
let same = 0, all = 0;
for (const program of programs) {
  const [file, language] = program.split('::');
  const text = fs.readFileSync(file, 'latin1').replace(/[^\x00-\x7f]/g, '?');
  const lines = text.split(/\r\n|\r|\n/);
  const [here, there] = [await grammarColours(lines, language), await server.colours(file, language, text, lines)];
  lines.forEach((line, number) => {
    for (let at = 0; at < line.length; ++at) {
      // Blanks have no colour, and what the server leaves open the spelling may say.
      if (line[at] === ' ' || line[at] === '\t' || !there[number][at]) continue;
      ++all;
      if (here[number][at] === there[number][at]) {
        ++same;
        continue;
      }
      let end = at + 1;
      while (end < line.length && here[number][end] === here[number][at] && there[number][end] === there[number][at]) ++end;
      all += end - at - 1;
      console.log(`${file}:${number + 1}:${at + 1}: ${line.slice(at, end)}: grammar ${here[number][at] || 'nothing'}, server ${there[number][at]} | ${line}`);
      at = end - 1;
    }
  });
}
console.log(`${same} of ${all}`);
server.send({ method: 'exit' });
