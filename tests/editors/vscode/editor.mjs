// VS Code for the test: code-server with the packed extension and the probe, and a browser that shows it.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import net from 'node:net';
import path from 'node:path';

const patience = 60000; // ms that anything may take, on a machine with much else to do
const sleep = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** Waits until `look` gives something true; `what` is said when it never does. */
export async function until(what, look, milliseconds = patience) {
  const end = Date.now() + milliseconds;
  let last, pause = 20;
  for (;;) {
    try {
      const found = await look();
      if (found) return found;
      last = undefined;
    } catch (error) {
      last = error;
    }
    if (Date.now() > end) throw new Error(`waited in vain for ${what}${last ? ': ' + last : ''}`);
    await sleep(pause);
    pause = Math.min(200, pause * 1.5);
  }
}

const freePort = () =>
  new Promise((resolve) => {
    const server = net.createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });

/** Without what costs time and is not looked at. */
const quiet = {
  'workbench.startupEditor': 'none', 'workbench.tips.enabled': false, 'workbench.reduceMotion': 'on', 'workbench.enableExperiments': false,
  'telemetry.telemetryLevel': 'off', 'security.workspace.trust.enabled': false, 'extensions.ignoreRecommendations': true,
  'extensions.autoCheckUpdates': false, 'remote.autoForwardPorts': false, 'git.enabled': false, 'typescript.tsserver.enabled': false,
  'editor.minimap.enabled': false, 'editor.cursorBlinking': 'solid', 'files.autoSave': 'off', 'window.commandCenter': false,
  'chat.commandCenter.enabled': false, 'chat.disableAIFeatures': true, 'workbench.secondarySideBar.defaultVisibility': 'hidden',
  'editor.accessibilitySupport': 'off',
};

export class Editor {
  /** `folder`: where all of it is, given back by the one who calls. */
  constructor(folder, modules) {
    this.folder = folder;
    this.workspace = path.join(folder, 'workspace');
    this.modules = modules;
    this.entry = path.join(modules, 'code-server', 'out', 'node', 'entry.js');
  }

  write(name, text) {
    const file = path.join(this.workspace, name);
    fs.mkdirSync(path.dirname(file), { recursive: true });
    fs.writeFileSync(file, Array.isArray(text) ? text.join('\n') + '\n' : text);
    return file;
  }
  read(name) {
    return fs.readFileSync(path.join(this.workspace, name), 'utf8');
  }

  /** Those of the user, and of the machine on which the server is: what belongs to a machine counts there alone. */
  settings(settings) {
    for (const of of ['User', 'Machine']) {
      const file = path.join(this.folder, 'user', of, 'settings.json');
      fs.mkdirSync(path.dirname(file), { recursive: true });
      fs.writeFileSync(file, JSON.stringify({ ...quiet, ...settings }, null, 2));
    }
  }

  get options() {
    return ['--user-data-dir', path.join(this.folder, 'user'), '--extensions-dir', path.join(this.folder, 'extensions'),
      '--config', path.join(this.folder, 'config.yaml')];
  }

  /** What runs `inBrowser` is in another host than the probe, which does not see it. */
  async start(packed, environment, inBrowser = false) {
    fs.writeFileSync(path.join(this.folder, 'config.yaml'), 'auth: none\ncert: false\n');
    const probe = path.join(this.folder, 'extensions', 'ncvet-test.probe-0.0.1');
    fs.cpSync(path.join(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), 'probe'), probe, { recursive: true });
    const puppeteer = createRequire(path.join(this.modules, 'nothing.js'))('puppeteer-core');
    const browser = puppeteer.launch({
      executablePath: process.env.NCVET_CHROMIUM ?? '/usr/bin/chromium', headless: true,
      args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage'], defaultViewport: { width: 1280, height: 800 },
      userDataDir: path.join(this.folder, 'browser'),
    });
    const [port, probePort] = [await freePort(), await freePort()];
    this.probe = `http://127.0.0.1:${probePort}/`;
    const log = fs.openSync(path.join(this.folder, 'server.log'), 'w');
    this.server = spawn('node', [this.entry, ...this.options, '--bind-addr', `127.0.0.1:${port}`, '--auth', 'none', '--disable-telemetry',
      '--disable-update-check', '--disable-workspace-trust', '--disable-getting-started-override'], {
      stdio: ['ignore', log, log], detached: true, env: { ...process.env, ...environment, NCVET_PROBE_PORT: String(probePort) },
    });
    const address = `http://127.0.0.1:${port}/`;
    await until('code-server', async () => (await fetch(address, { redirect: 'manual' })).status < 400);
    this.browser = await browser;
    this.page = await this.browser.newPage();
    // code-server puts a service worker of its own over all of its address. It takes the frames of views and of pages before
    // their own worker has them, and they stay blank: in VS Code there is none.
    await this.page.evaluateOnNewDocument(() => {
      const workers = navigator.serviceWorker;
      if (!workers) return;
      const register = workers.register.bind(workers);
      workers.register = (script, options) => (/_static\/out\/browser\/serviceWorker/.test(script) ? new Promise(() => {}) : register(script, options));
    });
    await this.page.goto(`${address}?folder=${this.workspace}`);
    await until('the probe', () => this.ask('return true'));
    // As a user installs a package from a file; no second editor has to be started for it.
    await this.ask(`await vscode.commands.executeCommand('workbench.extensions.installExtension', vscode.Uri.file(${JSON.stringify(packed)}))`);
    if (!inBrowser) await until('the extension', () => this.ask(`return vscode.extensions.getExtension('ncvet.ncvet')?.isActive`));
  }

  async stop() {
    await this.browser?.close().catch(() => {});
    if (this.server) {
      try {
        process.kill(-this.server.pid); // with the extension host and the language server
      } catch {
        // it has ended
      }
    }
  }

  /** Runs the body of a function in the extension host. */
  async ask(body) {
    const answer = await fetch(this.probe, { method: 'POST', body: String(body) });
    const { result, error } = await answer.json();
    if (error) throw new Error(error);
    return result;
  }

  file(name) {
    return `vscode.Uri.file(${JSON.stringify(path.join(this.workspace, name))})`;
  }
  async open(name) {
    await this.ask(`await vscode.window.showTextDocument(${this.file(name)}, { preview: false })`);
  }
  async closeAll() {
    // Of a text that is not saved the editor would ask, and wait.
    await this.ask(`for (const one of vscode.workspace.textDocuments.filter((document) => document.isDirty)) {
        await vscode.window.showTextDocument(one);
        await vscode.commands.executeCommand('workbench.action.files.revert');
      }
      await vscode.commands.executeCommand('workbench.action.closeAllEditors')`);
    await this.forgetViews();
  }
  language() {
    return this.ask('return vscode.window.activeTextEditor?.document.languageId');
  }
  /** Findings of a file, as `line rule`. */
  findings(name, source = 'ncvet') {
    return this.ask(`return vscode.languages.getDiagnostics(${this.file(name)}).filter((one) => one.source === ${JSON.stringify(source)})
      .map((one) => (one.range.start.line + 1) + ' ' + (one.code?.value ?? one.code ?? one.message))`);
  }
  command(id, ...args) {
    return this.ask(`return void vscode.commands.executeCommand(${[id, ...args].map((arg) => JSON.stringify(arg)).join(', ')})`);
  }
  /** The worker of a view that was closed may keep the one of the next from taking over, whose frame then stays blank. */
  forgetViews() {
    return this.page.evaluate(async () => {
      for (const one of await navigator.serviceWorker.getRegistrations()) await one.unregister();
    });
  }
  /** Waits for what a view shows; one that stays blank is loaded again, which is the editor's own remedy. */
  async seen(what, look) {
    for (let left = 3; left > 0; --left) {
      try {
        return await until(what, look, patience / 3);
      } catch (error) {
        if (left === 1) throw error;
        await this.forgetViews();
        await this.command('workbench.action.webview.reloadWebviewAction');
      }
    }
    return undefined;
  }
  /** The page of a view in which a selector finds something. */
  view(selector) {
    return this.seen(`a view with ${selector}`, async () => {
      for (const frame of this.page.frames()) if (await frame.$(selector).catch(() => null)) return frame;
      return undefined;
    });
  }
  /** The text of the first element that a selector finds; undefined when there is none. */
  text(selector) {
    return this.page.evaluate((what) => document.querySelector(what)?.textContent ?? undefined, selector);
  }
  texts(selector) {
    return this.page.evaluate((what) => [...document.querySelectorAll(what)].map((one) => one.textContent), selector);
  }
  control() {
    return this.text('.statusbar-item[id="ncvet.ncvet.ncvet.control"], .statusbar-item[id$="ncvet.control"]');
  }
  toasts() {
    return this.texts('.notifications-toasts .notification-list-item-message');
  }
  async press(button) {
    await until(`the button ${button}`, () =>
      this.page.evaluate((name) => {
        const found = [...document.querySelectorAll('.notifications-toasts .monaco-button')].find((one) => one.textContent === name);
        found?.click();
        return Boolean(found);
      }, button),
    );
  }
  /** All messages that are shown until `notedToasts`, those that have gone again too. */
  noteToasts() {
    return this.page.evaluate(() => {
      const noted = new Set();
      const observer = new MutationObserver(() =>
        document.querySelectorAll('.notifications-toasts .notification-list-item-message').forEach((one) => noted.add(one.textContent)));
      observer.observe(document.body, { subtree: true, childList: true });
      globalThis.notedToasts = () => {
        observer.disconnect();
        return [...noted];
      };
    });
  }
  notedToasts() {
    return this.page.evaluate(() => globalThis.notedToasts());
  }
  /** Puts the cursor, which the page learns of a little later. */
  async cursor(line, character) {
    await this.page.click('.monaco-editor .view-lines');
    await this.ask(`const at = new vscode.Position(${line}, ${character}); vscode.window.activeTextEditor.selection = new vscode.Selection(at, at)`);
    await until('the cursor', async () =>
      (await this.text('.statusbar-item[id="status.editor.selection"]'))?.includes(`Ln ${line + 1}, Col ${character + 1}`));
  }
  async dismiss() {
    await this.ask(`await vscode.commands.executeCommand('notifications.clearAll')`);
  }
  /** Types into the box that is open. */
  async fill(text) {
    await this.page.keyboard.down('Control');
    await this.page.keyboard.press('a');
    await this.page.keyboard.up('Control');
    await this.page.keyboard.sendCharacter(text);
  }
  /** Whether the list or box that is open takes what is typed. */
  takesText() {
    return this.page.evaluate(() => Boolean(document.activeElement?.closest('.quick-input-widget')));
  }
  /** Answers the question of a box. */
  async answer(text) {
    await until('a box', () => this.takesText());
    await this.fill(text);
    await this.page.keyboard.press('Enter');
  }
  /** Types into the list that is open until it has the entry, and takes it. */
  async pick(text) {
    const isOffered = () => this.page.evaluate((wanted) => {
      const row = document.querySelector('.quick-input-list .monaco-list-row.focused');
      return Boolean(row?.textContent.toLowerCase().includes(wanted.toLowerCase()));
    }, text);
    const enough = 1000; // ms; what was typed into a list that closes is typed again
    await until(`a list with ${text}`, async () => {
      if (!(await this.takesText())) return false;
      await this.fill(text);
      return until('its row', isOffered, enough);
    });
    await this.page.keyboard.press('Enter');
  }
  async shoot(file) {
    await this.page.screenshot({ path: file });
  }
  /** The picture of the step that runs is what is seen now, not what its end leaves. */
  async look() {
    if (!this.pictureOfStep) return;
    await this.shoot(this.pictureOfStep);
    this.pictureOfStep = '';
  }
}
