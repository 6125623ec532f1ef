// Tables from a spreadsheet: rows of lines, cells of tabs or semicolons; heads may say which column, and in which unit.

import { decimalMark, settled, symbol } from "../quantity.js";
import { nearest } from "../words.js";

// What stands between the cells: tabs, semicolons, or the commas of a CSV, as many in each line and none of them decimal.
function separator(lines) {
  const [first] = lines;
  const found = ["\t", ";"].find((mark) => first.includes(mark));
  if (found) return found;
  const counts = new Set(lines.filter(Boolean).map((line) => split(line, ",").length));
  const [count] = counts;
  const certain = !numeric(first) || count > 2 || lines.some((line) => line.includes("."));
  return counts.size === 1 && count > 1 && lines.length > 1 && certain && !/,\s/.test(first) ? "," : "\t";
}

// the cells of a line; one in quotation marks may hold what stands between cells
function split(line, mark) {
  if (!line.includes('"')) return line.split(mark);
  const cells = [""];
  let quoted = false;
  for (const letter of line) {
    if (letter === '"') quoted = !quoted;
    else if (letter === mark && !quoted) cells.push("");
    else cells[cells.length - 1] += letter;
  }
  return cells;
}

/** @param {string} text @param {string} [mark] what stands between cells, where that is known */
export function cellsOf(text, mark) {
  const lines = text.replace(/^\uFEFF/, "").replace(/\r/g, "").replace(/\n+$/, "").split("\n");
  const known = mark ?? separator(lines);
  return lines.map((line) => split(line, known).map((cell) => cell.trim()));
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
  // a column without a head is nobody's
  const index = !plain ? -1 : columns.findIndex(({ path, name, head: shown, also }) => [path, name, shown, shown.replace(/ /g, "_"), also ?? ""].some((one) => one.toLowerCase() === plain));
  return { index, unit };
}

// the columns that some heads name
export const knownHeads = (heads, columns) => new Set(heads.filter(Boolean).map((head) => column(head, columns).index).filter((index) => index >= 0));

/**
 * What of a pasted table goes where; numbers by the decimal mark of the table.
 * @returns {{ rows: string[][], places: { index: number, unit: string }[], unknown: { head: string, near: string | null }[], empty: string[] }}
 */
export function placed(text, columns, start, accepted = {}) {
  const lines = cellsOf(text);
  const first = lines[0];
  const known = first.map((head) => column(head, columns, accepted));
  const near = (head) => nearest(head.replace(/[([,].*$/, ""), columns.flatMap(({ name, head: shown }) => [shown, name]));
  // names may stand in the first line of cells too: heads are words without a number among them, one of them known
  const headed = !first.some(numeric) && known.some(({ index }) => index >= 0);
  // a column without a value says nothing of what is there
  const blank = lines.slice(1).length ? first.map((_, at) => headed && lines.slice(1).every((cells) => !cells[at])) : [];
  const places = headed ? known.map((place, at) => (blank[at] ? { ...place, index: -1 } : place)) : first.map((_, index) => ({ index: start + index, unit: "" }));
  const numbers = (cells) => cells.filter((_, at) => columns[places[at]?.index]?.kind === "number");
  const body = lines.slice(Number(headed));
  const mark = decimalMark(body.flatMap(numbers));
  const rows = body.map((cells) => cells.map((cell, at) => (columns[places[at]?.index]?.kind === "number" ? settled(cell, mark) : cell)));
  const unknown = headed ? first.filter((head, index) => head && known[index].index < 0).map((head) => ({ head, near: near(head) })) : [];
  return { rows, places, unknown, empty: first.filter((_, at) => blank[at] && known[at].index >= 0) };
}

// a bare number under a head with a unit has that unit
export function withUnit(text, unit, of) {
  const known = unit && symbol(unit, of);
  return known && known !== of && text && /\d\s*$/.test(text) ? `${text} ${known}` : text;
}
