// The extension without its part for Node, as an editor in a browser has it: `node web.mjs PLAN.json`, with the plan of drive.mjs.
// What went wrong is printed, a line each; the last line is `done`.
import fs from 'node:fs';
import path from 'node:path';
import { Editor, until } from './editor.mjs';
import { drilling } from './steps.mjs';

const plan = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));
const editor = new Editor(plan.folder, plan.modules);
const pictures = plan.pictures ?? path.join(plan.folder, 'pictures');
fs.mkdirSync(pictures, { recursive: true });
editor.settings({});
const began = Date.now();
editor.write('O0100.nc', drilling.map((line) => line.replace('N60 X30.', 'N60 M98 P0200')));
editor.write('O0200.nc', ['%', 'O0200 (SUB)', 'N10 X20. Y20.', 'N20 T2 M06', 'N30 M99', '%']);

try {
  await editor.start(plan.packed, {}, true);
  await editor.open('O0100.nc');
  await until('the control', async () => (await editor.control())?.includes('FANUC mill'));
  // The worker has a copy of the program that is called.
  await until('findings of the closed file', async () => (await editor.findings('O0200.nc')).includes('4 cycle-left-active'));
  await editor.ask(`const edit = new vscode.WorkspaceEdit(); edit.insert(vscode.window.activeTextEditor.document.uri,
    new vscode.Position(7, 0), 'N55 G80\\n'); await vscode.workspace.applyEdit(edit)`);
  await until('findings as they are after an edit', async () => (await editor.findings('O0200.nc')).every((one) => !one.includes('cycle-left')));
  await editor.command('ncvet.showPath');
  const shown = () => editor.ask(`return vscode.commands.executeCommand('ncvet.shownPath')`);
  const before = await editor.seen('the path', async () => ((await shown()).moves > 0 ? await shown() : undefined));
  await editor.ask(`const edit = new vscode.WorkspaceEdit(); edit.insert(vscode.window.visibleTextEditors[0].document.uri,
    new vscode.Position(7, 0), 'N52 X50.\\n'); await vscode.workspace.applyEdit(edit)`);
  const after = await until('the moves of one more hole', async () => ((await shown()).moves > before.moves ? await shown() : undefined));
  if (after.what !== 'change') throw new Error(`not the changed stretch alone was sent: ${after.what}`);
  const view = await editor.view('#tool-path');
  await until('the drawing', () => view.evaluate(() => globalThis.ncvet.pathPane.corners > 0));
  await editor.shoot(path.join(pictures, 'path-in-a-browser.png'));
  await editor.command('ncvet.explain', 'cycle-left-active');
  await until('the text of a page', () => editor.ask(`return vscode.workspace.textDocuments.some((one) =>
    one.uri.scheme === 'ncvet-rule' && one.getText().includes('Why it matters at the machine')) ||
    vscode.window.tabGroups.all.flatMap((group) => group.tabs).some((tab) => /Preview/.test(tab.label))`));
  await editor.shoot(path.join(pictures, 'in-a-browser.png'));
} catch (error) {
  console.log(`in a browser: ${error.message}`);
} finally {
  await editor.stop();
}
console.log(`took ${Date.now() - began} ms: all of it`);
console.log('done');
