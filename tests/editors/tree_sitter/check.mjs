// Looks whether tree-sitter would take the grammars, and whether they find the words of a few blocks: `node check.mjs FOLDER`,
// which has a folder for each language. What is wrong is printed, a line each; the last line is `done`.
import fs from 'node:fs';
import path from 'node:path';
import { load, walk, wordsOf } from './grammar.mjs';

const folder = process.argv[2];
const wrong = (text) => console.log(text);

/** Blocks with their words: what a node is, and its text. */
const blocks = {
  gcode: [
    ['N10 G01 X-5.5 F100. M8 (A HOLE)', 'block_number N10 code G01 axis X operator - number 5.5 parameter F number 100. miscellaneous M8 comment (A HOLE)'],
    ['IF[#101 GT 5.]GOTO100', 'keyword IF other [ variable #101 operator GT number 5. other ] keyword GOTO number 100'],
    ['WHILE[#1LT3]DO1', 'keyword WHILE other [ variable #1 operator LT number 3 other ] keyword DO number 1'],
    ['g54.1p2x1y2 ; away', 'code g54.1 parameter p number 2 axis x number 1 axis y number 2 comment ; away'],
    ['O0100 (PLATE', 'program O0100 comment (PLATE'],
    ['G999 WORD', 'unknown G999 unknown WORD'],
    ['%', 'tape %'],
  ],
  'ncvet-sinumerik': [
    ['N10 G1 X=R1*2 F100 M8 ; AWAY', 'block_number N10 code G1 axis X operator = variable R1 operator * number 2 parameter F number 100 miscellaneous M8 comment ; AWAY'],
    ['START: IF R1>5 GOTOF END', 'label START: keyword IF variable R1 operator > number 5 keyword GOTOF variable END'],
    ['DEF REAL DEPTH=5', 'keyword DEF type REAL variable DEPTH operator = number 5'],
    ['TRANS X10 Y1=5', 'code TRANS axis X number 10 axis Y1= number 5'],
    ['CYCLE83(50,0,2,,-20)', 'code CYCLE83 other ( number 50 other , number 0 other , number 2 other , other , operator - number 20 other )'],
    ['MSG("HELLO") $P_UIFR[1]', 'code MSG other ( string "HELLO" other ) variable $P_UIFR other [ number 1 other ]'],
    ['%_N_SHAFT_MPF', 'program %_N_SHAFT_MPF'],
  ],
  'ncvet-ecs': [
    ["N10 G1 DX5 Y-2 ' AWAY", "block_number N10 code G1 axis DX number 5 axis Y operator - number 2 comment ' AWAY"],
    ['N20 L<SUB1> {CALL}', 'block_number N20 program L<SUB1> comment {CALL}'],
    ['N30 <JMP:N10>', 'block_number N30 operator < keyword JMP other : block_number N10 operator >'],
  ],
  'ncvet-mefi': [['N5 G1 X10 F200 " AWAY', 'block_number N5 code G1 axis X number 10 parameter F number 200 comment " AWAY']],
};

for (const language of fs.readdirSync(folder)) {
  const grammar = load(path.join(folder, language, 'grammar.js'));
  if (!/^[a-z_]+$/.test(grammar.name)) wrong(`${language}: the name ${grammar.name}`);
  const used = new Set(['source_file']), nodes = new Set();
  walk(grammar.rules, (one) => {
    if (one.type === 'symbol') used.add(one.symbol);
    if (one.type === 'alias') nodes.add(one.name);
  });
  for (const symbol of used) if (!grammar.rules[symbol] && !nodes.has(symbol)) wrong(`${language}: there is no rule ${symbol}`);
  for (const name of Object.keys(grammar.rules)) if (!used.has(name)) wrong(`${language}: nothing uses the rule ${name}`);
  for (const { key, source } of grammar.tokens) {
    if (/\(\?[=!<]|\\[1-9bB]/.test(source)) wrong(`${language}: ${key} looks around, which tree-sitter's expressions cannot`);
    if (new RegExp(`^(?:${source})$`).test('')) wrong(`${language}: ${key} is a word of no length`);
  }
  const queries = fs.readFileSync(path.join(folder, language, 'queries', 'highlights.scm'), 'utf8');
  for (const [, node] of queries.matchAll(/^\((\w+)\)/gm)) if (!nodes.has(node)) wrong(`${language}: there is no node ${node} to be coloured`);
  for (const [line, due] of blocks[language] ?? []) {
    const found = wordsOf(grammar, line).map(({ node, begin, end }) => `${node} ${line.slice(begin, end)}`).join(' ');
    if (found !== due) wrong(`${language}: ${line}\n  is  ${found}\n  not ${due}`);
  }
}
console.log('done');
