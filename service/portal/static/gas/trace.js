// An indicated pressure as it is pasted or dropped: two columns, angle and pressure, with or without heads.

import { cellsOf, headOf, numeric } from "../grid/paste.js";
import { decimalMark, read, settled, symbol } from "../quantity.js";

const FEWEST = 3;
const TURN = 360;
// degrees by which a cycle may be longer than it is
const ROUGH = 0.5;
const ANGLE = /angle|winkel|crank|°|deg|kw\b|ca\b/i;
const PRESSURE = /press|druck|\bp\b|bar|pa\b|psi/i;
// so many lines of two columns, the first of them rising, are a pressure without heads; in a table of the machine they may be its own
const MANY = 12;
export const TOO_MANY = 60;

const values = (line) => line.filter((cell) => cell !== "");
const isHead = (line) => values(line).length > 0 && !values(line).some(numeric);

// the lines of a text with its heads; where a comma stands alone in each line it is what stands between the columns
function linesOf(text) {
  const lines = cellsOf(text);
  const apart = lines.every((line) => line.length === 1) ? cellsOf(text, ",") : lines;
  const first = apart.findIndex((line) => !isHead(line));
  return { heads: first < 0 ? apart : apart.slice(0, first), body: first < 0 ? [] : apart.slice(first) };
}

// whether a pasted text is a pressure over the angle rather than a table of the machine
export function isTrace(text, certain = MANY) {
  const { heads, body } = linesOf(text);
  const words = heads.flat();
  if (words.some((word) => ANGLE.test(word)) && words.some((word) => PRESSURE.test(word))) return body.length >= FEWEST && words.length <= 3 * Math.max(1, heads.length);
  const angles = body.map(([angle]) => Number(angle?.replace(",", ".")));
  return body.length >= certain && body.every((line) => values(line).length === 2) && angles.every((angle, index) => index === 0 || angle > angles[index - 1]);
}

/**
 * A cycle from 0 on, and what is wrong; `unit` of the pressures is that of their head, null where none stands there.
 * @param {string} text @param {number} every of so many lines one is taken @param {number} most lines that a cylinder may have
 * @returns {{ angles: number[], pressures: number[], turns: number, unit: string | null, lines: number, troubles: string[] }}
 */
export function traceOf(text, every, most) {
  const { heads, body } = linesOf(text);
  const troubles = [];
  const column = (pattern, otherwise) => heads.map((line) => line.findIndex((word) => pattern.test(word))).find((at) => at >= 0) ?? otherwise;
  const at = column(ANGLE, 0);
  const of = column(PRESSURE, at === 0 ? 1 : 0);
  const units = heads.map((line) => line[of] ?? "").flatMap((word) => [headOf(word)[1], word]).map((word) => symbol(word, "Pa")).filter(Boolean);
  const mark = decimalMark(body.flat());
  const number = (cell) => {
    const value = read(settled(cell ?? "", mark), "");
    return typeof value === "number" ? value : NaN;
  };
  const rows = [];
  const wrong = (line, why) => { troubles.push(`line ${heads.length + line + 1}: ${why}`); };
  body.forEach((cells, line) => {
    if (!values(cells).length) return;
    const [angle, pressure] = [number(cells[at]), number(cells[of])];
    if (!cells[of]) wrong(line, "there is no pressure");
    else if (Number.isNaN(angle) || Number.isNaN(pressure)) wrong(line, `“${Number.isNaN(angle) ? cells[at] : cells[of]}” is no number`);
    else if (rows.length && angle <= rows.at(-1)[0]) wrong(line, `the angle ${angle} does not follow ${rows.at(-1)[0]}: angles must rise`);
    else rows.push([angle, pressure]);
  });
  const span = rows.length ? rows.at(-1)[0] - rows[0][0] : 0;
  const turns = span > TURN + ROUGH ? 2 : 1;
  const cycle = TURN * turns;
  if (rows.length < FEWEST) troubles.push("there are fewer than three lines of an angle and a pressure");
  if (span > 2 * TURN + ROUGH) troubles.push(`the angles span ${span}°, more than the two revolutions of a cycle`);
  else if (rows.length >= FEWEST && span < cycle / 2) troubles.push(`the angles span ${span}°, less than half of a cycle`);
  const thinned = rows.filter((_, index) => index % every === 0);
  if (thinned.length > most) troubles.push(`${thinned.length} lines are more than the ${most} that each cylinder of this machine may have`);
  // what ends the cycle repeats its beginning; a cycle may begin before the dead centre
  const open = thinned.filter(([angle]) => angle - thinned[0][0] < cycle - 1e-6).map(([angle, pressure]) => [((angle % cycle) + cycle) % cycle, pressure]);
  open.sort(([one], [other]) => one - other);
  return { angles: open.map(([angle]) => Number(angle.toPrecision(10))), pressures: open.map(([, pressure]) => pressure), turns, unit: units[0] ?? null, lines: rows.length, troubles };
}
