// The steps of the test: the name says what holds, the body does what a user does and looks at what the user sees.
import fs from 'node:fs';
import { until } from './editor.mjs';

function same(is, due, what) {
  if (JSON.stringify(is) !== JSON.stringify(due)) throw new Error(`${what}: ${JSON.stringify(is)}, not ${JSON.stringify(due)}`);
}
function holds(is, what) {
  if (!is) throw new Error(what);
}

export const drilling = ['%', 'O0100 (PLATE, FANUC 0I-MF)', 'N10 G17 G21 G40 G80 G90 G94', 'N20 T1 M06', 'N30 G54 G00 X0. Y0. S1200 M03', 'N40 G43 H1 Z50. M08',
  'N50 G81 X10. Y10. Z-10. R2. F200.', 'N60 X30.', 'N70 T2 M06', 'N80 G80', 'N90 G91 G28 Z0. M09', 'N100 M30', '%'];

/** Writes the program that most steps look at. */
export function prepare(editor) {
  editor.write('plate.nc', drilling);
}

export const steps = {
  async 'a program has its findings, and its control is in the status bar'(editor) {
    await editor.open('plate.nc');
    const found = await until('findings', async () => (await editor.findings('plate.nc')).length > 0 && (await editor.findings('plate.nc')));
    holds(found.includes('9 cycle-left-active'), `the cycle is left on at the tool change: ${found}`);
    const control = await until('the control in the status bar', () => editor.control());
    holds(/FANUC mill|Haas mill/.test(control) && control.includes('guessed'), `the control is shown as a guess: ${control}`);
    const messages = await editor.ask(`return vscode.languages.getDiagnostics(${editor.file('plate.nc')}).map((one) => one.message)`);
    holds(messages.every((message) => !message.includes('`')), `marks of code in a message: ${messages}`);
  },

  async 'a long comment at the head leaves the control as it is'(editor) {
    editor.write('commented.nc', [...drilling.slice(0, 2), ...Array.from({ length: 300 }, (_, i) => `(TOOL LIST, LINE ${i + 1})`), ...drilling.slice(2)]);
    await editor.open('commented.nc');
    const control = await until('the control in the status bar', () => editor.control());
    holds(/FANUC mill|Haas mill/.test(control), `the control: ${control}`);
  },

  async 'findings of called files are seen'(editor) {
    editor.write('calls/O0100.nc', ['%', 'O0100 (MAIN, FANUC 0I-MF)', 'N10 G17 G21 G40 G80 G90 G94', 'N20 T1 M06', 'N30 G54 G00 X0. Y0. S1200 M03',
      'N40 G43 H1 Z50. M08', 'N50 G81 X10. Y10. Z-10. R2. F200.', 'N60 M98 P0200', 'N70 G80 M09', 'N80 M30', '%']);
    editor.write('calls/O0200.nc', ['%', 'O0200 (SUB)', 'N10 X20. Y20.', 'N20 T2 M06', 'N30 M99', '%']);
    await editor.open('calls/O0100.nc');
    await until('findings of the closed file', async () => (await editor.findings('calls/O0200.nc')).length > 0);
    same(await editor.findings('calls/O0200.nc'), ['4 cycle-left-active'], 'findings of a subprogram whose caller is beside it');
  },

  async 'the control is chosen for a file, and the findings follow'(editor) {
    editor.write('lathe.nc', drilling);
    await editor.open('lathe.nc');
    await until('the control', () => editor.control());
    await editor.command('ncvet.chooseControl');
    await editor.pick('Haas lathe (classic)');
    await editor.pick('This file');
    await until('the language', async () => (await editor.language()) === 'ncvet-haas-lathe');
    await until('the new control', async () => (await editor.control())?.includes('Haas lathe'));
  },

  async 'the list of controls has reasons from the text'(editor) {
    await editor.open('plate.nc');
    await until('the control', () => editor.control());
    await editor.command('ncvet.chooseControl');
    await until('the list', async () => (await editor.texts('.quick-input-list .quick-input-list-row')).length > 3);
    const rows = await editor.texts('.quick-input-list .monaco-list-row');
    holds(rows.some((row) => row.includes('In this text:')), `no reasons: ${rows.slice(0, 4)}`);
  },

  async 'the control is chosen for a folder, and its findings follow'(editor) {
    editor.write('shop/plate.nc', drilling);
    editor.write('shop/.ncvet.json', '{\n  // written by hand\n  "ignore": ["style"]\n}\n'.replace('  // written by hand\n', ''));
    await editor.open('shop/plate.nc');
    await until('the control', () => editor.control());
    await editor.command('ncvet.chooseControl');
    await editor.pick('din66025');
    await editor.pick('This folder');
    await until('.ncvet.json', () => JSON.parse(editor.read('shop/.ncvet.json')).dialect === 'din66025');
    same(JSON.parse(editor.read('shop/.ncvet.json')).ignore, ['style'], 'what else is in the file');
    const control = await until('the control of the configuration', async () => {
      const shown = await editor.control();
      return shown?.includes('DIN 66025') && shown;
    });
    holds(!control.includes('guessed'), control);
  },

  async 'the control is chosen for the workspace'(editor) {
    await editor.open('plate.nc');
    await until('the control', () => editor.control());
    await editor.command('ncvet.chooseControl');
    await editor.pick('nct-104m');
    await editor.pick('This workspace');
    await until('the setting', () => JSON.parse(editor.read('.vscode/settings.json'))['ncvet.dialect'] === 'nct-104m');
    await until('the new control', async () => (await editor.control())?.includes('NCT-104M'));
    await editor.command('ncvet.chooseControl');
    await editor.pick('Automatic');
    await editor.pick('This workspace');
    await until('a guess again', async () => (await editor.control())?.includes('guessed'));
  },

  async 'a change of the configuration renews the findings'(editor) {
    editor.write('fresh/.ncvet.json', '{ "dialect": "fanuc-mill" }\n');
    editor.write('fresh/plate.nc', drilling);
    await editor.open('fresh/plate.nc');
    await until('findings', async () => (await editor.findings('fresh/plate.nc')).includes('9 cycle-left-active'));
    editor.write('fresh/.ncvet.json', '{ "dialect": "fanuc-mill", "ignore": ["cycle"] }\n');
    await until('findings without the rule', async () => !(await editor.findings('fresh/plate.nc')).includes('9 cycle-left-active'));
  },

  async 'a change of a setting renews the findings'(editor) {
    const ignore = (rules) => editor.ask(`await vscode.workspace.getConfiguration('ncvet').update('ignore', ${rules}, vscode.ConfigurationTarget.Workspace)`);
    const isFound = async () => (await editor.findings('plate.nc')).includes('9 cycle-left-active');
    await editor.open('plate.nc');
    await until('findings', isFound);
    await ignore(`['cycle']`);
    await until('findings without the rule', async () => !(await isFound()));
    await ignore('undefined');
    await until('findings with it', isFound);
  },

  async 'a control that does not exist is marked in the settings'(editor) {
    editor.write('.vscode/settings.json', '{ "ncvet.dialect": "fanuk" }\n');
    await editor.open('.vscode/settings.json');
    await until('a warning', () => editor.ask(`return vscode.languages.getDiagnostics(${editor.file('.vscode/settings.json')})
      .some((one) => /neither a control of ncvet|fanuc-mill/.test(one.message))`));
    editor.write('.vscode/settings.json', '{}\n');
  },

  async 'a broken configuration is told, and the last good one counts'(editor) {
    editor.write('broken/.ncvet.json', '{ "dialect": "fanuc-mill" }\n');
    editor.write('broken/plate.nc', drilling);
    await editor.open('broken/plate.nc');
    await until('findings', async () => (await editor.findings('broken/plate.nc')).includes('9 cycle-left-active'));
    editor.write('broken/.ncvet.json', '{ "dialect": "fanuc-mill" "ignore": [] }\n');
    await until('a message', async () => (await editor.toasts()).some((text) => /ncvet\.json/.test(text)));
    await until('a diagnostic of the configuration', async () => (await editor.findings('broken/.ncvet.json')).length > 0);
    await editor.ask(`const edit = new vscode.WorkspaceEdit(); edit.insert(${editor.file('broken/plate.nc')}, new vscode.Position(6, 0), 'N45 F0\\n');
      await vscode.workspace.applyEdit(edit)`);
    await until('the findings of a later check', async () => (await editor.findings('broken/plate.nc')).includes('10 cycle-left-active'));
    editor.write('broken/.ncvet.json', '{ "dialect": "fanuc-mill" }\n');
    await until('its end', async () => (await editor.findings('broken/.ncvet.json')).length === 0);
  },

  async 'the configuration and machine profiles are checked by their schemas'(editor) {
    editor.write('schema/.ncvet.json', '{ "dialct": "fanuc-mill" }\n');
    editor.write('schema/vf2.machine.json', '{ "dialect": "haas-mill", "spindle": { "maxSpeeed": 8100 } }\n');
    const warned = (name) => editor.ask(`return vscode.languages.getDiagnostics(${editor.file(name)}).map((one) => one.message).join()`);
    await editor.open('schema/vf2.machine.json');
    await until('a warning of the profile', async () => /maxSpeeed/.test(await warned('schema/vf2.machine.json')));
    await editor.open('schema/.ncvet.json');
    await until('a warning of the configuration', async () => /dialct/.test(await warned('schema/.ncvet.json')));
  },

  async 'a text that looks like a program is offered as one, a letter and a header of C are left alone'(editor) {
    editor.write('offer/part.txt', drilling);
    editor.write('offer/note.txt', ['Dear colleague,', 'the fixture of O0100 is ready.', 'Please run G54 with X10 first.', 'Thank you']);
    editor.write('stdio.h', ['#ifndef STDIO_H', '#define STDIO_H', '#include <stddef.h>', 'int printf(const char *, ...);', '#endif']);
    await editor.noteToasts();
    await editor.open('offer/note.txt');
    await editor.open('stdio.h');
    same(await editor.language(), 'cpp', 'language of a header of C');
    await editor.open('offer/part.txt');
    await until('the offer', async () => (await editor.toasts()).some((text) => text.includes('looks like an NC program')));
    const offers = await editor.notedToasts();
    same(offers.length, 1, `neither a letter nor a header is offered: ${offers}`);
    holds(offers[0].includes('part.txt'), offers[0]);
    await editor.press('Always for .txt');
    await until('the language', async () => (await editor.language()) === 'gcode');
    await until('findings', async () => (await editor.findings('offer/part.txt')).length > 0);
    editor.write('.vscode/settings.json', '{}\n');
  },

  async 'a file without an ending is a program by its first line'(editor) {
    editor.write('O0100', drilling);
    await editor.open('O0100');
    await until('the language', async () => (await editor.language()) === 'gcode');
  },

  async 'the page of a rule cannot be edited'(editor) {
    await editor.open('plate.nc');
    await until('findings', async () => (await editor.findings('plate.nc')).length > 0);
    const target = await editor.ask(`return vscode.languages.getDiagnostics(${editor.file('plate.nc')}).find((one) => one.source === 'ncvet').code.target.toString()`);
    holds(target.startsWith('ncvet-rule:'), `the link of a finding leads to ${target}`);
    await editor.ask(`await vscode.commands.executeCommand('vscode.open', vscode.Uri.parse(${JSON.stringify(target)}))`);
    const open = () => editor.ask(`return vscode.window.tabGroups.all.flatMap((group) => group.tabs).map((tab) => tab.input?.viewType ?? tab.input?.uri?.toString() ?? '')`);
    await until('the page', async () => (await open()).some((tab) => tab.includes('markdown.preview') || tab.startsWith('ncvet-rule:')));
    holds(!(await open()).some((tab) => tab.startsWith('file:') && tab.endsWith('.md')), `a file is open: ${await open()}`);
  },

  async 'the tool path is beside the text, follows what is typed, and both cursors follow each other'(editor) {
    await editor.open('plate.nc');
    await until('the control', () => editor.control());
    await editor.command('ncvet.showPath');
    const shown = () => editor.ask(`return vscode.commands.executeCommand('ncvet.shownPath')`);
    const before = await editor.seen('the path', async () => ((await shown()).moves > 0 ? await shown() : undefined));
    // Two holes, of which each has three moves or more.
    await editor.ask(`const editor = vscode.window.visibleTextEditors[0], edit = new vscode.WorkspaceEdit();
      edit.insert(editor.document.uri, new vscode.Position(8, 0), 'N65 X50.\\n'); await vscode.workspace.applyEdit(edit)`);
    const after = await until('the moves of one more hole', async () => ((await shown()).moves > before.moves ? await shown() : undefined));
    same(after.what, 'change', 'what was sent');
    const view = await editor.view('#tool-path');
    const marked = () => view.evaluate(() => globalThis.ncvet.report.findings.length);
    await until('marks of findings', async () => (await marked()) > 0);
    await editor.ask(`const editor = vscode.window.visibleTextEditors[0]; editor.selection = new vscode.Selection(8, 0, 8, 0)`);
    await until('the slider at the cursor', async () => /line 9/.test(await view.evaluate(() => document.getElementById('place').textContent)));
    await view.evaluate(() => globalThis.ncvet.pathPane.stepBlock(-1));
    await until('the cursor at the slider', async () => (await editor.ask('return vscode.window.visibleTextEditors[0].selection.active.line')) === 7);
    await until('the view stays there', async () => /line 8/.test(await view.evaluate(() => document.getElementById('place').textContent)));
  },

  async 'explain shows the page of the rule at the cursor'(editor) {
    editor.write('explain.nc', drilling.map((line) => line.replace('Y10.', 'Y10. Y10.')));
    await editor.open('explain.nc');
    await until('findings', async () => (await editor.findings('explain.nc')).includes('9 cycle-left-active'));
    await editor.command('ncvet.explainRule'); // where the cursor is there is no finding
    await editor.pick('cycle-left-active');
    await until('the page', () => editor.ask(`return vscode.window.tabGroups.all.flatMap((group) => group.tabs).some((tab) => /cycle-left-active/.test(tab.label))`));
    await until('its text', () => editor.ask(`return vscode.workspace.textDocuments.some((one) =>
      one.uri.scheme === 'ncvet-rule' && one.getText().includes('Why it matters at the machine') && !/G99/.test(one.getText()))`));
    const page = await editor.view('#why-it-matters-at-the-machine');
    await until('what is seen of it', () => page.evaluate(() => document.getElementById('why-it-matters-at-the-machine').getBoundingClientRect().width > 0));
  },

  async 'all safe fixes are applied, and the others are counted'(editor) {
    editor.write('fixes.nc', drilling.map((line) => line.replace('Y10.', 'Y10. Y10.')));
    await editor.open('fixes.nc');
    await until('findings', async () => (await editor.findings('fixes.nc')).length > 0);
    await editor.command('ncvet.fixAll');
    const said = await until('a word on it', async () => (await editor.toasts()).find((text) => text.includes('Applied')));
    holds(/the one safe fix.*more need/.test(said), said);
    await until('the text', async () => (await editor.ask('return vscode.window.activeTextEditor.document.lineAt(6).text')) === drilling[6]);
  },

  async 'a block number is gone to'(editor) {
    await editor.open('plate.nc');
    await editor.command('ncvet.goToBlock');
    await editor.answer('N70');
    await until('the line', async () => (await editor.ask('return vscode.window.activeTextEditor.selection.active.line')) === 8);
  },

  async 'the views show operations, callers and findings'(editor) {
    await editor.open('calls/O0100.nc');
    await until('findings', async () => (await editor.findings('calls/O0200.nc')).length > 0);
    await editor.ask(`await vscode.commands.executeCommand('workbench.view.extension.ncvet')`);
    const rows = () => editor.texts('.pane-body .monaco-list-row');
    await until('a tool', async () => (await rows()).some((row) => /T1/.test(row)));
    await until('a rule', async () => (await rows()).some((row) => /cycle-/.test(row)));
    await editor.ask(`await vscode.commands.executeCommand('vscode.open', ${editor.file('calls/O0200.nc')})`);
    await until('a caller', async () => (await rows()).some((row) => /called by 1/.test(row)));
  },

  async 'a lens counts the callers in other files'(editor) {
    await editor.open('calls/O0200.nc');
    const titles = () => editor.ask(`return (await vscode.commands.executeCommand('vscode.executeCodeLensProvider', ${editor.file('calls/O0200.nc')}, 20))
      .map((lens) => lens.command?.title)`);
    await until('the lens', async () => (await titles()).includes('1 caller'));
  },

  async 'a program is renamed with its calls and its file'(editor) {
    editor.write('named/O0300.nc', ['%', 'O0300 (MAIN, FANUC 0I-MF)', 'N10 G17 G21 G40 G80 G90 G94', 'N20 M98 P0310', 'N30 M30', '%']);
    editor.write('named/O0310.nc', ['%', 'O0310 (SUB)', 'N10 G00 X20. Y20.', 'N20 M99', '%']);
    await editor.open('named/O0300.nc');
    await until('the control', () => editor.control());
    await editor.cursor(3, 11);
    await editor.page.keyboard.press('F2');
    await until('the box for the name', () => editor.page.evaluate(() => document.activeElement?.closest('.rename-box') !== null));
    await editor.page.keyboard.type('320');
    await editor.page.keyboard.press('Enter');
    await until('the texts', () => editor.ask(`return vscode.workspace.textDocuments.filter((one) => /P320|O0320/.test(one.getText())).length === 2`));
    await editor.ask('await vscode.workspace.saveAll()');
    holds(editor.read('named/O0300.nc').includes('M98 P320'), editor.read('named/O0300.nc'));
    await until('the file', () => editor.read('named/O0320.nc').includes('O0320 (SUB)'));
  },

  async 'a program follows when its file is renamed'(editor) {
    await editor.open('named/O0300.nc');
    await until('the control', () => editor.control());
    const edit = `const edit = new vscode.WorkspaceEdit(); edit.renameFile(${editor.file('named/O0320.nc')}, ${editor.file('named/O0330.nc')});`;
    await editor.ask(`${edit} void vscode.workspace.applyEdit(edit)`);
    // The editor asks whether the extension may change texts with it.
    await until('the question', () => editor.page.evaluate(() => {
      const button = [...document.querySelectorAll('.monaco-dialog-box .monaco-button')].find((one) => one.textContent === 'OK');
      button?.click();
      return Boolean(button);
    }));
    await until('the call', () => editor.ask(`return vscode.workspace.textDocuments.some((one) => one.getText().includes('M98 P330'))`));
    await until('the file', async () => {
      await editor.ask('await vscode.workspace.saveAll()');
      return editor.read('named/O0330.nc').includes('O0330 (SUB)');
    });
  },

  async 'a variable is renamed in the programs that share it'(editor) {
    editor.write('shared/O0400.nc', ['%', 'O0400 (MAIN, FANUC 0I-MF)', 'N10 G17 G21 G40 G80 G90 G94', 'N20 #102=5.', 'N30 M98 P0410', 'N40 M30', '%']);
    editor.write('shared/O0410.nc', ['%', 'O0410 (SUB)', 'N10 G00 X#102', 'N20 M99', '%']);
    await editor.open('shared/O0400.nc');
    await until('the control', () => editor.control());
    await editor.ask(`const edit = await vscode.commands.executeCommand('vscode.executeDocumentRenameProvider', ${editor.file('shared/O0400.nc')},
      new vscode.Position(3, 6), '110'); await vscode.workspace.applyEdit(edit)`);
    await until('both texts', async () => {
      await editor.ask('await vscode.workspace.saveAll()');
      return editor.read('shared/O0400.nc').includes('N20 #110=5.') && editor.read('shared/O0410.nc').includes('N10 G00 X#110');
    });
  },

  async 'a lens over a contour tells the largest tool when it is seen'(editor) {
    editor.write('contour.nc', [...drilling.slice(0, 6), 'G01 Z-1. F100.', 'G41 D1 X10. Y0.', 'Y10.', 'G03 X0. Y20. R10.', 'G01 X-10.', 'G40 X-30.',
      'G00 Z50. M09', 'G49', 'M30', '%']);
    await editor.open('contour.nc');
    await until('the lens', async () => (await editor.texts('.codelens-decoration')).some((text) => text.includes('safe up to R10.00')));
  },

  async 'a loop of the selection is written out'(editor) {
    editor.write('loop.nc', [...drilling.slice(0, 6), '#1=0', 'WHILE[#1LT3]DO1', 'G00 X[#1*10.]', '#1=#1+1', 'END1', ...drilling.slice(10)]);
    await editor.open('loop.nc');
    await until('the control', () => editor.control());
    const title = 'Unroll the selection';
    const actions = `const range = new vscode.Range(7, 0, 11, 0); vscode.window.activeTextEditor.selection = new vscode.Selection(range.start, range.end);
      const actions = await vscode.commands.executeCommand('vscode.executeCodeActionProvider', ${editor.file('loop.nc')}, range, 'refactor', 20);`;
    await until('the action', () => editor.ask(`${actions} return actions.some((one) => one.title === '${title}')`));
    await editor.ask(`${actions} await vscode.workspace.applyEdit(actions.find((one) => one.title === '${title}').edit)`);
    const lines = await editor.ask(`return vscode.window.activeTextEditor.document.getText().split('\\n').slice(7, 13)`);
    same(lines, ['G00 X[#1*10.]', '#1=#1+1', 'G00 X[#1*10.]', '#1=#1+1', 'G00 X[#1*10.]', '#1=#1+1'], 'the passes');
  },

  async 'selected blocks become a subprogram in a file of its own'(editor) {
    const head = ['G17 G90 G54 G40 G94', 'T1 D1', 'M6', 'S800 M3', 'G0 X10 Y20', 'G0 Z2'];
    editor.write('parts/SHAFT.MPF', [...head, 'G1 X5 F100', 'Y5', 'G0 Z50', 'M30']);
    await editor.open('parts/SHAFT.MPF');
    await until('the control', async () => (await editor.control())?.includes('SINUMERIK'));
    const actions = `const range = new vscode.Range(6, 0, 8, 0); vscode.window.activeTextEditor.selection = new vscode.Selection(range.start, range.end);
      const actions = await vscode.commands.executeCommand('vscode.executeCodeActionProvider', ${editor.file('parts/SHAFT.MPF')}, range, 'refactor.extract', 20);
      const made = actions.find((one) => one.title === 'Make the selection a subprogram');`;
    await until('the action', () => editor.ask(`${actions} return Boolean(made)`));
    holds(await editor.ask(`${actions} return vscode.workspace.applyEdit(made.edit)`), 'the edit is not made');
    await until('the subprogram', async () => {
      await editor.ask('await vscode.workspace.saveAll()');
      return editor.read('parts/PART1.SPF') === 'G1 X5 F100\nY5\nM17\n';
    });
    same(editor.read('parts/SHAFT.MPF').split('\n').slice(6), ['PART1', 'G0 Z50', 'M30', ''], 'the program');
    await until('the check of the subprogram', async () => (await editor.findings('parts/SHAFT.MPF')).every((one) => !one.includes('undefined')));
  },

  async 'declaration and implementation lead to the called program'(editor) {
    await editor.open('calls/O0100.nc');
    for (const what of ['Declaration', 'Implementation', 'Definition'])
      await until(what, () => editor.ask(`const found = await vscode.commands.executeCommand('vscode.execute${what}Provider',
        ${editor.file('calls/O0100.nc')}, new vscode.Position(7, 10)); return found.some((one) => (one.uri ?? one.targetUri).path.endsWith('O0200.nc'))`));
  },

  async 'a long program is opened within bounds, and a hover is answered while it is checked'(editor, { ncvet }) {
    const blocks = Array.from({ length: 400_000 }, (_, i) => `N${i + 9} G1 X${i % 999} Y${i % 77}.5`);
    editor.write('long.nc', [...drilling.slice(0, 6), ...blocks, 'M30', '%']);
    await editor.open('long.nc');
    const hover = () => editor.ask(`const found = await vscode.commands.executeCommand('vscode.executeHoverProvider', ${editor.file('long.nc')},
      new vscode.Position(50, 7)); return found.flatMap((one) => one.contents.map((part) => part.value)).join()`);
    await until('findings', async () => (await editor.findings('long.nc')).length > 0);
    for (const code of ['G91', 'G90']) {
      await editor.ask(`const edit = new vscode.WorkspaceEdit(); edit.replace(${editor.file('long.nc')}, new vscode.Range(6, 0, 6, 0), '${code}\\n');
        return vscode.workspace.applyEdit(edit)`);
      const text = await hover();
      holds(/feed/.test(text), `the hover after ${code}: ${text}`);
    }
    for (const id of fs.readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
      let command = '', status = '';
      try {
        command = fs.readFileSync(`/proc/${id}/cmdline`, 'utf8');
        status = fs.readFileSync(`/proc/${id}/status`, 'utf8');
      } catch {
        continue; // it has ended
      }
      if (!command.startsWith(`${ncvet}\0lsp`)) continue;
      const peak = Number(/VmHWM:\s+(\d+)/.exec(status)[1]) / 1024;
      holds(peak < 300, `the server took ${peak} MB`);
    }
  },

  async 'a new block has its number'(editor) {
    editor.write('typed.nc', drilling);
    await editor.open('typed.nc');
    await until('findings', async () => (await editor.findings('typed.nc')).length > 0);
    await editor.cursor(5, drilling[5].length);
    await editor.page.keyboard.press('Enter');
    await until('the number', async () => /^N4\d ?$/.test(await editor.ask('return vscode.window.activeTextEditor.document.lineAt(6).text')));
  },

  async 'snippets are those of the control'(editor) {
    editor.write('new/.ncvet.json', '{ "dialect": "haas-mill" }\n');
    editor.write('new/empty.nc', ['%', 'O1 (NEW)', '', '']);
    await editor.open('new/empty.nc');
    await until('the control', async () => (await editor.control())?.includes('Haas mill'));
    const labels = await editor.ask(`const list = await vscode.commands.executeCommand('vscode.executeCompletionItemProvider',
      ${editor.file('new/empty.nc')}, new vscode.Position(2, 0)); return list.items.map((item) => item.label.label ?? item.label)`);
    for (const wanted of ['head', 'tool', 'cycle G83']) holds(labels.includes(wanted), `no snippet ${wanted}`);
  },

  async 'the editor does not ask for the whole workspace for ever'(editor, { messages }) {
    // All that was asked in the steps before, which took longer than the two seconds between two such questions.
    holds(fs.readFileSync(messages, 'utf8').includes('"textDocument/diagnostic"'), 'nothing was asked at all');
    holds(!fs.readFileSync(messages, 'utf8').includes('"workspace/diagnostic"'), 'workspace/diagnostic is asked for though the setting is off');
  },

  async 'without the program ncvet there is one message, with what to do, and colours'(editor, { wrapper }) {
    const set = (file) => editor.ask(`await vscode.workspace.getConfiguration('ncvet').update('path', ${JSON.stringify(file)}, vscode.ConfigurationTarget.Global)`);
    await editor.open('plate.nc');
    await editor.noteToasts();
    await set('/no/such/ncvet');
    const buttons = await until('the message', async () => {
      const shown = await editor.texts('.notifications-toasts .monaco-button');
      return shown.length > 0 && shown;
    });
    for (const wanted of ['Choose Program…', 'Open Settings', 'How to Install']) holds(buttons.includes(wanted), `buttons: ${buttons}`);
    const colours = await editor.page.evaluate(() => new Set([...document.querySelectorAll('.view-line span span')].map((one) => getComputedStyle(one).color)).size);
    holds(colours >= 4, `${colours} colours without the server`);
    await set(wrapper);
    await until('the control again', async () => /guessed/.test((await editor.control()) ?? ''));
    const said = await editor.notedToasts();
    same(said.length, 1, `messages: ${said}`);
    holds(said[0].includes('/no/such/ncvet'), said[0]);
  },

  async 'the package for a platform brings its program'(editor, { wrapper }) {
    const extension = await editor.ask(`return vscode.extensions.getExtension('ncvet.ncvet').extensionPath`);
    holds(fs.existsSync(`${extension}/bin/ncvet`), 'the package has no program');
    const set = (file) => editor.ask(`await vscode.workspace.getConfiguration('ncvet').update('path', ${JSON.stringify(file)}, vscode.ConfigurationTarget.Global)`);
    await set('');
    editor.write('brought.nc', drilling);
    await editor.open('brought.nc');
    await until('findings', async () => (await editor.findings('brought.nc')).includes('9 cycle-left-active'));
    await set(wrapper);
    await until('the control again', async () => /guessed/.test((await editor.control()) ?? ''));
  },

  async 'a hover tells the state of the machine'(editor) {
    await editor.open('plate.nc');
    const text = await until('the hover', () => editor.ask(`const found = await vscode.commands.executeCommand('vscode.executeHoverProvider',
      ${editor.file('plate.nc')}, new vscode.Position(7, 5)); return found.flatMap((one) => one.contents.map((part) => part.value)).join()`));
    holds(/Before this block/.test(text) && /G81/.test(text), text);
    await editor.ask(`const editor = vscode.window.activeTextEditor; editor.selection = new vscode.Selection(7, 5, 7, 5);
      await vscode.commands.executeCommand('editor.action.showHover')`);
    await until('it is seen', async () => (await editor.texts('.monaco-hover')).some((one) => one.includes('Before this block')));
    await editor.look();
    await editor.open('calls/O0100.nc');
    const afterCall = await until('the hover after a call', () => editor.ask(`const found = await vscode.commands.executeCommand('vscode.executeHoverProvider',
      ${editor.file('calls/O0100.nc')}, new vscode.Position(8, 5)); return found.flatMap((one) => one.contents.map((part) => part.value)).join()`));
    holds(/Before this block/.test(afterCall) && !/M99/.test(afterCall), `the return is over: ${afterCall}`);
  },

  async 'codes are completed in the order of their numbers'(editor) {
    editor.write('codes.nc', [...drilling.slice(0, 6), 'N50 G', ...drilling.slice(6)]);
    await editor.open('codes.nc');
    await until('the control', () => editor.control());
    const labels = await editor.ask(`const list = await vscode.commands.executeCommand('vscode.executeCompletionItemProvider',
      ${editor.file('codes.nc')}, new vscode.Position(6, 5)); return list.items.map((item) => [item.sortText, item.label.label ?? item.label])`);
    const codes = labels.sort(([a], [b]) => (a < b ? -1 : 1)).map(([, label]) => label).filter((label) => /^G0*[0-9.]+$/.test(label));
    const numbers = codes.map((code) => Number(code.slice(1)));
    holds(numbers.length > 10, `codes: ${codes}`);
    same(numbers, [...numbers].sort((a, b) => a - b), 'order');
    await editor.ask(`const editor = vscode.window.activeTextEditor; editor.selection = new vscode.Selection(6, 5, 6, 5);
      await vscode.commands.executeCommand('editor.action.triggerSuggest')`);
    await until('they are seen', async () => (await editor.texts('.suggest-widget .monaco-list-row')).length > 0);
  },

  async 'a dry run stops at a breakpoint and shows the machine'(editor) {
    editor.write('run.nc', drilling);
    await editor.open('run.nc');
    await until('the control', () => editor.control());
    await editor.ask(`vscode.debug.addBreakpoints([new vscode.SourceBreakpoint(new vscode.Location(${editor.file('run.nc')}, new vscode.Position(7, 0)))])`);
    await editor.command('ncvet.dryRun');
    const frame = () => editor.ask(`const session = vscode.debug.activeDebugSession;
      return session && (await session.customRequest('stackTrace', { threadId: 1 })).stackFrames[0]`);
    // What is asked before that is refused, and the editor tells the user so.
    await until('the mark of the block', () => editor.page.$('.debug-top-stack-frame-line'));
    await until('the first block', async () => (await frame())?.line === 3);
    await editor.ask(`await vscode.commands.executeCommand('workbench.action.debug.continue')`);
    await until('the breakpoint', async () => (await frame())?.line === 8);
    const rows = () => editor.texts('.debug-variables .monaco-list-row');
    await until('the groups of the state', async () => (await rows()).some((row) => row.includes('Position')));
    const x = await editor.ask(`return (await vscode.debug.activeDebugSession.customRequest('evaluate', { expression: 'X', context: 'watch' })).result`);
    same(x, '10', 'X after the first hole');
    await editor.look();
    await editor.ask(`await vscode.commands.executeCommand('workbench.action.debug.stepOver')`);
    await until('the next block', async () => (await frame())?.line === 9);
    await editor.ask(`await vscode.commands.executeCommand('workbench.action.debug.stop'); vscode.debug.removeBreakpoints(vscode.debug.breakpoints)`);
    await until('the end', () => editor.ask('return !vscode.debug.activeDebugSession'));
    same(await editor.toasts(), [], 'nothing was refused');
  },

  async 'the walk-through opens'(editor) {
    await editor.ask(`await vscode.commands.executeCommand('workbench.action.openWalkthrough', 'ncvet.ncvet#ncvet.start', false)`);
    await until('it', async () => (await editor.texts('.getting-started-step')).some((text) => text.includes('Look at the control')));
  },

  async 'the language of a file is kept when extensions start again'(editor) {
    await editor.ask('globalThis.isOld = true');
    // The editor starts the process of its extensions again when it ends.
    process.kill(await editor.ask('return process.pid'), 'SIGKILL');
    await until('the probe of the new one', () => editor.ask('return !globalThis.isOld'));
    await editor.open('lathe.nc');
    await until('the language', async () => (await editor.language()) === 'ncvet-haas-lathe');
    await until('the control', async () => (await editor.control())?.includes('Haas lathe'));
  },
};
