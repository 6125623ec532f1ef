// Tables from a spreadsheet: rows of lines, cells of tabs or semicolons; heads may say which column, and in which unit.

import { symbol } from "../quantity.js";
import { nearest } from "../words.js";

export function cellsOf(text) {
  const lines = text.replace(/\r/g, "").replace(/\n+$/, "").split("\n");
  const mark = lines[0].includes("\t") ? "\t" : lines[0].includes(";") ? ";" : "\t";
  return lines.map((line) => line.split(mark).map((cell) => cell.trim()));
}

export const numeric = (text) => /^[+\-\u2212]?[\d.,]/.test(text);

// [word, unit] of a head such as "Position (mm)"
export function headOf(head) {
  const [, word, unit] = /^(.*?)(?:\s*[([,]\s*([^)\]]*)[)\]]?)?$/.exec(head) ?? [];
  return [word?.trim() ?? "", unit?.trim() ?? ""];
}

// a head is its column's path, its last name, how it is shown, or what it names, with or without a unit
function column(head, columns, accepted = {}) {
  const [word, unit] = headOf(head);
  const plain = (accepted[head] ?? word).toLowerCase();
  const index = columns.findIndex(({ path, name, head: shown, also }) => [path, name, shown, shown.replace(/ /g, "_"), also ?? ""].some((one) => one.toLowerCase() === plain));
  return { index, unit };
}

// the columns that some heads name
export const knownHeads = (heads, columns) => new Set(heads.filter(Boolean).map((head) => column(head, columns).index).filter((index) => index >= 0));

/**
 * What of a pasted table goes where.
 * @returns {{ rows: string[][], places: { index: number, unit: string }[], unknown: { head: string, near: string | null }[] }}
 */
export function placed(text, columns, start, accepted = {}) {
  const lines = cellsOf(text);
  const first = lines[0];
  const known = first.map((head) => column(head, columns, accepted));
  const near = (head) => nearest(head.replace(/[([,].*$/, ""), columns.flatMap(({ name, head: shown }) => [shown, name]));
  // names may stand in the first line of cells too: heads are words without a number among them, one of them known
  const headed = !first.some(numeric) && known.some(({ index }) => index >= 0);
  if (!headed) return { rows: lines, places: first.map((_, index) => ({ index: start + index, unit: "" })), unknown: [] };
  const unknown = first.filter((head, index) => head && known[index].index < 0).map((head) => ({ head, near: near(head) }));
  return { rows: lines.slice(1), places: known, unknown };
}

// a bare number under a head with a unit has that unit
export function withUnit(text, unit, of) {
  const known = unit && symbol(unit, of);
  return known && known !== of && text && /\d\s*$/.test(text) ? `${text} ${known}` : text;
}
