// Numbers and names as people read them.

const SUFFIX = /_(m|kg|deg|rpm|N|Nm|Pa|kg_m2|kg_m|m2|W|J|N_per_m|mm_s|ms|s)$/;

// a minus is as wide as a plus, and no hyphen at which a line breaks
const MINUS = "\u2212";
// thousands stand apart as they do in the report: a comma would be read back as decimal
const NARROW = "\u202f";

export function figure(value, digits = 5) {
  if (value === null || value === undefined) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const written = size < 1e-5 || size >= 1e9 ? value.toExponential(2).replace("e+", "e") : value.toLocaleString("en", { maximumSignificantDigits: digits }).replaceAll(",", NARROW);
  return written.replaceAll("-", MINUS);
}

// a residue of rounding beside what was there before is shown as nothing
export const beside = (value, scale) => figure(Math.abs(value) < 1e-9 * Math.abs(scale) ? 0 : value);

export const number = (value, digits) => ({ number: true, text: figure(value, digits) });

// an angle to a ten-thousandth of a degree, as in the report: nothing is set or read more finely
export const degrees = (value) => number(value && Math.round(1e4 * value) / 1e4);

export const share = (value) => (value > 0 && value < 1e-7 ? "less than 0.00001 %" : `${figure(100 * value, 2)} %`);

export const label = (name) => name.replace(SUFFIX, "").replaceAll("_", " ");

// what a field is, for people: null is a field that is left empty
export const hint = (about) => about.replace(/\bnull\b/g, "empty").replace(/\bNull\b/g, "Empty");

export const singular = (name) => label(name).replace(/s$/, "");

// a value of a request, which may be anything, as a text: not every object can be one by itself
export const written = (value) => {
  if (value === null || value === undefined) return "";
  return typeof value === "object" ? JSON.stringify(value) : String(value);
};

export const nameOf = (thing, index) => written(thing?.name ?? index + 1);
