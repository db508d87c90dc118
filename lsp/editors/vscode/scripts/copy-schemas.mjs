// Copies the schemas of the tables into the package: the editor checks `.ncvet.json` and machine profiles by them.
import { cpSync, mkdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const from = fileURLToPath(new URL('../../../../rulesets/schema/', import.meta.url));
const to = fileURLToPath(new URL('../schema/', import.meta.url));
mkdirSync(to, { recursive: true });
for (const name of ['config', 'machine']) {
  cpSync(`${from}${name}.schema.json`, `${to}${name}.schema.json`);
}
