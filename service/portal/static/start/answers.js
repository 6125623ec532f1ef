// What was answered to the questions of a new machine, as quantities; what is needed or doubtful is noted.

import { meant, quantity, read } from "../quantity.js";

export const rounded = (value) => Number(value.toPrecision(12));

export class Answers {
  /** @type {Set<string>} questions whose answers are needed, or not understood */
  wrong = new Set();
  /** @type {Map<string, string>} what else may be meant, by question */
  doubts = new Map();

  /** @param {{ [name: string]: string }} typed */
  constructor(typed) {
    this.typed = typed;
  }

  answered(name) {
    return Boolean(this.typed[name]?.trim());
  }

  /** @returns {any} null where nothing was answered that need not be */
  number(name, unit, { needed = true } = {}) {
    if (!needed && !this.answered(name)) return null;
    return this.#read(name, this.typed[name] ?? "", unit);
  }

  // one value for all, or one for each
  each(name, unit, count) {
    const text = (this.typed[name] ?? "").trim();
    const list = text.split(";").map((part) => part.trim()).filter(Boolean);
    const spaced = text.split(/\s+/);
    if (list.length === 1 && count > 1 && spaced.length === count && spaced.every((part) => /^[\d.,]+$/.test(part))) {
      // 1 575 are two values of two throws, or one thousand and more
      if (Number.isFinite(quantity(read(text, unit), unit))) this.doubts.set(name, `one value of ${spaced.join("")}, or ${count}? Write ${spaced.join("")} or ${spaced.join("; ")}`);
      return spaced.map((part) => this.#read(name, part, unit));
    }
    if (list.length > 1 && list.length !== count) this.wrong.add(name);
    const values = list.map((part) => this.#read(name, part, unit));
    if (!values.length) this.wrong.add(name);
    return Array.from({ length: count }, (_, index) => values[list.length > 1 ? index : 0]);
  }

  list(name, unit) {
    return (this.typed[name] ?? "").split(";").map((part) => part.trim()).filter(Boolean).map((part) => this.#read(name, part, unit));
  }

  #read(name, text, unit) {
    const typed = read(text, unit);
    const value = quantity(typed, unit);
    const other = meant(typed, unit, /pitch|plane/.test(name) ? "position" : name);
    if (other) this.doubts.set(name, `${value} m? Write ${other} if that is meant`);
    if (!Number.isFinite(value)) this.wrong.add(name);
    return rounded(value);
  }
}
