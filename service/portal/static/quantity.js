// Quantities as people write them: numbers with a decimal point or comma, units in their many spellings.

/** @type {{ [unit: string]: { [symbol: string]: number } }} */
const UNITS = {
  m: { m: 1, cm: 0.01, mm: 0.001, in: 0.0254, ft: 0.3048 },
  kg: { kg: 1, g: 0.001, t: 1000, lb: 0.45359237 },
  deg: { deg: 1, rad: 180 / Math.PI },
  rpm: { rpm: 1, Hz: 60, "rad/s": 30 / Math.PI },
  N: { N: 1, kN: 1000, lbf: 4.4482216152605 },
  Pa: { Pa: 1, kPa: 1e3, MPa: 1e6, bar: 1e5, psi: 6894.757293168361 },
  "N m": { "N m": 1, "N mm": 0.001, "lbf ft": 1.3558179483314004 },
};
const SPELT = {
  '"': "in", inch: "in", "'": "ft", "°": "deg", degree: "deg", degrees: "deg", lbs: "lb", nm: "N m", "n·m": "N m", "n*m": "N m", nmm: "N mm",
  "1/min": "rpm", "/min": "rpm", "r/min": "rpm", "rev/min": "rpm", "u/min": "rpm", "min-1": "rpm", "min^-1": "rpm", "min⁻¹": "rpm", "1/s": "Hz",
};
// thousands may stand apart: 1 234,5 or 1'234.5, but 500 1/min is 500
const WRITTEN = /^([+-]?(?=[.,]?\d)(?:\d{1,3}(?:[\s'\u2019]\d{3})+(?!\d)|\d*)(?:[.,]\d*)*(?:e[+-]?\d+)?)\s*(.*)$/i;

// The rule, for a number by itself: of points and commas the last one is decimal, and what stands more than once groups.
// `mark` is the decimal one where a table tells it: then the other one groups.
function decimal(text, mark = null) {
  const bare = text.replace(/[\s'\u2019]/g, "");
  const last = mark ? bare.indexOf(mark) : Math.max(bare.lastIndexOf("."), bare.lastIndexOf(","));
  if (last < 0) return mark ? bare.replace(/[.,]/g, "") : bare;
  const grouping = bare.indexOf(bare[last]) !== last || bare.indexOf(bare[last], last + 1) >= 0;
  const [whole, part] = grouping ? [bare, ""] : [bare.slice(0, last), bare.slice(last + 1)];
  return `${whole.replace(/[.,]/g, "")}${part ? `.${part.replace(/[.,]/g, "")}` : ""}`;
}

// 1,125 may be one and a bit, or more than a thousand; 0,125 and 12,5 cannot be
const EITHER = /^([+\-\u2212]?[1-9]\d{0,2}),(\d{3})(?!\d)\s*([^\d.,].*)?$/;
const SINGLE = /^[+\-\u2212]?\d*([.,])(\d*)(?!\d)\s*([^\d.,].*)?$/;
const MIXED = /^[+\-\u2212]?\d{1,3}(?:([.,])\d{3})+([.,])\d*/;

// The decimal mark that cells of one table share, null where none of them tells it: all of a table was written in one place.
export function decimalMark(cells) {
  const marks = new Set();
  for (const cell of cells) {
    const text = cell.trim();
    const [, group, last] = MIXED.exec(text) ?? [];
    const [, mark, part] = SINGLE.exec(text) ?? [];
    if (last && last !== group) marks.add(last);
    else if (mark && (part.length !== 3 || /^[+\-\u2212]?0?[.,]/.test(text))) marks.add(mark);
  }
  return marks.size === 1 ? [...marks][0] : null;
}

// a cell as a number by itself is written, by the mark of its table
export function settled(text, mark) {
  const [, digits, rest] = (mark && WRITTEN.exec(text.trim().replaceAll("\u2212", "-"))) || [];
  return digits === undefined ? text : `${decimal(digits, mark)}${rest ? ` ${rest}` : ""}`;
}

// how the service spells a unit, where it is one of those of the field
export function symbol(text, unit) {
  const known = UNITS[unit] ?? {};
  if (text in known) return text;
  const lower = text.toLowerCase();
  const spelt = Object.keys(known).filter((one) => one.toLowerCase() === lower);
  return spelt.length === 1 ? spelt[0] : SPELT[lower] in known ? SPELT[lower] : null;
}

// A number, a text such as "140 mm" that the service reads, or what was typed: the service says what it cannot read.
export function read(text, unit) {
  const trimmed = text.trim().replaceAll("\u2212", "-");
  const [, digits, rest] = WRITTEN.exec(trimmed) ?? [];
  if (digits === undefined) return trimmed;
  const number = decimal(digits);
  if (!Number.isFinite(Number(number))) return trimmed;
  if (!rest || (rest === unit && !(unit in UNITS))) return Number(number);
  return `${number} ${symbol(rest, unit) ?? rest}`;
}

// the value in the unit, NaN where the service would not read it
export function quantity(value, unit) {
  if (typeof value === "number") return value;
  const [, number, rest] = /^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*([a-z][a-z/ ]*?)\s*$/i.exec(value ?? "") ?? [];
  return Number(number) * (UNITS[unit]?.[rest] ?? NaN);
}

// metres that no machine has are millimetres whose unit was left out
const LARGEST_M = 5;
const LARGEST_PLACE_M = 50;

// what was meant, where a bare number of metres is hardly one
export function meant(value, unit, name) {
  const largest = /position|plane/.test(name) ? LARGEST_PLACE_M : LARGEST_M;
  return unit === "m" && typeof value === "number" && Math.abs(value) >= largest ? `${value} mm` : null;
}

/**
 * What may be meant otherwise by a number as it was typed, null where nothing may.
 * @returns {{ words: string, other: string } | null}
 */
export function doubt(value, unit, name, text = "") {
  const other = meant(value, unit, name);
  if (other) return { words: `${value} m?`, other };
  const [, whole, part, rest] = EITHER.exec(text.trim()) ?? [];
  return whole ? { words: `${text.trim()} is read as ${whole}.${part}.`, other: `${whole}${part}${rest ? ` ${rest}` : ""}` } : null;
}
