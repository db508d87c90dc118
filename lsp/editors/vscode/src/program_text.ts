// Whether a text is a part program, by its first lines: for files whose ending says nothing of it.

/** Endings that machinists use for programs, and others for other things; `c` and `h` files are programs of some controls. */
export const looseEndings = new Set(
  '.txt .pim .prg .ptp .sub .ncd .fnc .hnc .dnc .pgm .ncf .arc .h .i .min'.split(' '),
);

const shownBytes = 8192; // enough to pass a header of comments
const leastBlocks = 3;
const leastShare = 0.8; // of the lines that say something

const comment = /^(?:\/?\s*(?:N\d+\s*)?\([^)]*\)?|;.*|'.*|".*)$/;
const words = /^\/?\d?\s*(?:[N:]\d+\s*)?(?:[A-Z]{1,2}\s*=?\s*[-+]?(?:\d+\.?\d*|\.\d+|#\d+|\[[^\]]*\]|R\d+)\s*)+(?:\(.*|;.*)?$/;
const header = /^(?:%|%?O\d{1,8}\s*(?:[(<].*)?|%_N_\w+|:\d+|N\s*PROGRAM.*|;\$PATH=.*)$/;
const macro = /^(?:[N:]\d+\s*)?(?:#\d+\s*=.*|IF\s*[[(].*|WHILE\s*\[.*|END\d.*|GOTO[FB]?\s*\w+|R\d+\s*=.*|(?:MCALL\s+)?(?:CYCLE|POCKET|HOLES|SLOT)\d+.*|A?(?:TRANS|ROT|MIRROR)\b.*|<[A-Z]{3}.*>|O(?:\d+|<[^>]*>)\s+(?:SUB|ENDSUB|CALL|IF|ELSE|ENDIF|WHILE|ENDWHILE|DO|REPEAT|ENDREPEAT|RETURN)\b.*)$/;
const code = /(?:^|[^A-Z])[GM]\d{1,3}(?![\d])/;

// Other texts that are made of letters and numbers.
const foreign = [
  /^%FS|^%MO|\*$/m, // Gerber: blocks end with an asterisk
  /^M48\s*$/m, // Excellon
  /^\s*(?:#include|#define|#pragma|extern|typedef|struct|namespace)\b/m,
  /^\s*\d*\s*BEGIN PGM/m, // Heidenhain: no control that ncvet reads
  /^P[1-6]\s*\n/, // a picture
];

/** Whether the beginning of a text is that of a part program. It rather errs on the side of no. */
export function looksLikeProgram(text: string): boolean {
  const head = text.slice(0, shownBytes).replace(/^\uFEFF/, '');
  if (foreign.some((pattern) => pattern.test(head))) {
    return false;
  }
  let said = 0;
  let blocks = 0;
  let codes = 0;
  const lines = head.split(/\r\n|\r|\n/);
  if (text.length > shownBytes) {
    lines.pop(); // cut off
  }
  for (const line of lines.map((one) => one.trim().toUpperCase())) {
    if (line === '' || comment.test(line)) {
      continue;
    }
    ++said;
    const isBlock = words.test(line) || macro.test(line);
    if (isBlock || header.test(line)) {
      ++blocks;
    }
    if (isBlock && code.test(line)) {
      ++codes;
    }
  }
  return blocks >= leastBlocks && codes >= 2 && blocks >= leastShare * said;
}
