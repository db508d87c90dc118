// The controls: what the tables say of them, and which marks of a text speak for one.
import * as fs from 'node:fs';
import * as path from 'node:path';

export interface Control {
  id: string;
  short: string;
  title: string;
  family: string;
  extensions: string[];
  marks: { pattern: string; score: number; reason: string }[];
}

const shownLines = 200; // as many as the server looks at

export function readControls(extensionPath: string): Control[] {
  return JSON.parse(fs.readFileSync(path.join(extensionPath, 'controls.json'), 'utf8'));
}

/** Marks of a text that speak for a control, the strongest first. */
export function marksIn(control: Control, text: string): { score: number; reasons: string[] } {
  const lines = text
    .split(/\r\n|\r|\n/, shownLines)
    .map((line) => line.trim().toUpperCase())
    .filter((line) => line !== '');
  const found = control.marks.filter((mark) => {
    const pattern = new RegExp(mark.pattern);
    return lines.some((line) => pattern.test(line));
  });
  found.sort((a, b) => b.score - a.score);
  return { score: found.reduce((sum, mark) => sum + mark.score, 0), reasons: found.map((mark) => mark.reason) };
}
