// A grammar of tree-sitter without tree-sitter: the functions in whose words it is written make data of it, and texts are cut
// into words as tree-sitter cuts them: the word of the highest precedence counts, then the longest, then the one of the first rule.
import fs from 'node:fs';

const rule = (type) => (...members) => ({ type, members: members.map(asRule) });
const asRule = (one) => (one instanceof RegExp ? { type: 'pattern', source: one.source } : typeof one === 'string' ? { type: 'text', text: one } : one);

const words = {
  seq: rule('seq'), choice: rule('choice'), optional: rule('optional'), repeat: rule('repeat'), repeat1: rule('repeat1'),
  alias: (one, name) => ({ type: 'alias', members: [asRule(one)], name: name.symbol }),
  prec: (precedence, one) => ({ ...asRule(one), precedence }),
  token: (one) => ({ type: 'token', members: [asRule(one)] }),
  grammar: (made) => made,
};

/** What a grammar.js says: its name, its rules by name, and its words in their order. */
export function load(file) {
  const module = {};
  new Function('module', ...Object.keys(words), fs.readFileSync(file, 'utf8'))(module, ...Object.values(words));
  const { name, extras, rules } = module.exports;
  const symbols = new Proxy({}, { get: (_, symbol) => ({ type: 'symbol', symbol }) });
  const made = Object.fromEntries(Object.entries(rules).map(([key, one]) => [key, asRule(one(symbols))]));
  const nodes = {};
  walk(made, (one) => {
    if (one.type === 'alias') nodes[one.members[0].symbol] = one.name;
  });
  const tokens = Object.entries(made)
    .filter(([, one]) => one.type === 'token' || one.type === 'pattern')
    .map(([key, one]) => {
      const { source, precedence = 0 } = one.type === 'token' ? one.members[0] : one;
      return { key, node: nodes[key] ?? key, source, precedence, expression: new RegExp(source, 'y') };
    });
  return { name, rules: made, tokens, blanks: extras(symbols) };
}

export function walk(rules, visit) {
  const go = (one) => {
    visit(one);
    one.members?.forEach(go);
  };
  Object.values(rules).forEach(go);
}

/** The words of a line: `node`, `begin` and `end`. */
export function wordsOf({ tokens, blanks }, line) {
  const words = [],
    blank = new RegExp(blanks[0].source, 'y');
  for (let at = 0; at < line.length; ) {
    let best = { length: 1 };
    blank.lastIndex = at;
    for (const token of blank.test(line) ? [] : tokens) {
      token.expression.lastIndex = at;
      const length = token.expression.exec(line)?.[0].length ?? 0;
      const isBefore = !best.token || token.precedence > best.token.precedence || (token.precedence === best.token.precedence && length > best.length);
      if (length && isBefore) best = { token, length };
    }
    if (best.token) words.push({ node: best.token.node, begin: at, end: at + best.length });
    at += best.length;
  }
  return words;
}
