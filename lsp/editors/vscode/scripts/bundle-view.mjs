// Puts the script and the style of the tool path's view together, from the viewer of the HTML report and what is added to it.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const viewer = fileURLToPath(new URL('../../../../formats/reports/viewer/', import.meta.url));
const own = fileURLToPath(new URL('../view/', import.meta.url));
const to = fileURLToPath(new URL('../dist/', import.meta.url));

/** Without the report's own frame: its list of findings, its text and what binds them. */
const drawing = ['camera', 'colours', 'curve', 'data', 'flat_scene', 'gl_scene', 'legend', 'levels', 'marks', 'path_pane',
  'pointer', 'tables', 'times', 'tool_path', 'words'];
const additions = ['splice', 'upload', 'live'];

const all = (folder, names, ending) => names.map((name) => readFileSync(`${folder}${name}.${ending}`, 'utf8')).join('\n');
mkdirSync(to, { recursive: true });
const script = all(viewer, drawing, 'js') + all(own, additions, 'js');
writeFileSync(`${to}path_view.js`, `'use strict';\n(() => {\n${script}\nglobalThis.ncvet = app;\n})();\n`);
writeFileSync(`${to}path_view.css`, all(viewer, ['page', 'tool_path'], 'css') + all(own, ['live'], 'css'));
