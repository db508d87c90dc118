// Has tree-sitter itself parse the programs of the rules' pages, and looks whether each block is whole, and has the words that
// `grammar.mjs` cuts it into: `node parse.mjs GRAMMAR WORDS RULES`. WORDS is `words.c` with the parser of the grammar. What is wrong
// is printed, a line each; the last line is `done`.
import fs from 'node:fs';
import path from 'node:path';
import { execFileSync } from 'node:child_process';
import { load, wordsOf } from './grammar.mjs';

const [folder, binary, rules] = process.argv.slice(2);
const language = path.basename(folder);
const own = fs.readdirSync(path.dirname(folder)).map((name) => name.replace('ncvet-', ''));
const isOfLanguage = (control) => (own.includes(control) ? language === `ncvet-${control}` : language === 'gcode');

/** The lines of all programs of the language, one after the other. */
function* programLines() {
  for (const name of fs.readdirSync(rules, { recursive: true }).filter((one) => one.endsWith('.md')))
    for (const [, control, program] of fs.readFileSync(path.join(rules, name), 'utf8').matchAll(/^```nc (\S+)[^\n]*\n(.*?)^```/gms))
      if (isOfLanguage(control)) yield* program.trimEnd().split('\n');
}

/** The words that tree-sitter finds in a file, as texts, by line. */
function parsed(file, text) {
  const lines = text.toString().split('\n').map(() => []);
  const said = execFileSync(binary, [path.join(folder, 'queries', 'highlights.scm'), file], { maxBuffer: 1 << 28 });
  let line = 0,
    end = text.indexOf('\n');
  for (const word of said.toString().split('\n').slice(1, -1)) {
    const [kind, from, to] = word.split(' ');
    for (; end >= 0 && end <= Number(from); end = text.indexOf('\n', end + 1)) ++line;
    lines[line].push(`${kind} ${text.subarray(Number(from), Number(to))}`);
  }
  return lines;
}

const grammar = load(path.join(folder, 'grammar.js'));
const lines = [...programLines()];
const file = `${binary}.nc`;
fs.writeFileSync(file, lines.join('\n'));
const found = parsed(file, fs.readFileSync(file));
lines.forEach((line, i) => {
  const is = found[i].join(' ');
  const due = wordsOf(grammar, line).map(({ node, begin, end }) => `${node} ${line.slice(begin, end)}`).join(' ');
  if (is !== due) console.log(`${language}: ${line}\n  is  ${is}\n  not ${due}`);
});
if (lines.length < 1000) console.log(`${language}: only ${lines.length} blocks`);
console.log('done');
