// Drives VS Code through what a user does: `node drive.mjs PLAN.json`. The plan names `modules`, `ncvet`, `packed` (the
// extension), `folder` (empty, for all that is written) and perhaps `pictures`, a folder for a picture of each step; `only` chooses
// steps by their names. Without a folder for pictures there are those of what went wrong. That is printed, a line each, and how long
// each step took; the last line is `done`.
import fs from 'node:fs';
import path from 'node:path';
import { Editor } from './editor.mjs';
import { prepare, steps } from './steps.mjs';

const plan = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));
const editor = new Editor(plan.folder, plan.modules);
const pictures = plan.pictures ?? path.join(plan.folder, 'pictures');
fs.mkdirSync(pictures, { recursive: true });

// The messages to the server are kept: one step looks at what the editor has asked for.
const messages = path.join(plan.folder, 'messages');
const wrapper = path.join(plan.folder, 'ncvet-with-messages');
fs.writeFileSync(wrapper, `#!/bin/sh\nexec tee -a '${messages}' | '${plan.ncvet}' "$@"\n`, { mode: 0o755 });
fs.writeFileSync(messages, '');

editor.settings({ 'ncvet.path': wrapper });
prepare(editor);

const began = Date.now();
try {
  await editor.start(plan.packed, {});
  console.log(`took ${Date.now() - began} ms: the start`);
  for (const [name, run] of Object.entries(steps)) {
    if (plan.only && !new RegExp(plan.only).test(name)) continue;
    const start = Date.now();
    const picture = path.join(pictures, name.replace(/\W+/g, '-') + '.png');
    editor.pictureOfStep = plan.pictures ? picture : '';
    try {
      await run(editor, { ...plan, messages, wrapper });
    } catch (error) {
      console.log(`${name}: ${error.message}`);
      editor.pictureOfStep = picture;
    }
    await editor.look().catch(() => {});
    console.log(`took ${Date.now() - start} ms: ${name}`);
    await editor.page.keyboard.press('Escape');
    await editor.dismiss().catch(() => {});
    await editor.closeAll().catch(() => {});
  }
} catch (error) {
  console.log(`VS Code: ${error.stack}`);
} finally {
  await editor.stop();
}
console.log('done');
