// A sheet as it was copied: tables with their heads one below the other, an empty line between them, and single values
// of the machine beside their names.

import { isTrace } from "../gas/trace.js";
import { read } from "../quantity.js";
import { nearest } from "../words.js";
import { home, moved } from "./home.js";
import { cellsOf, headOf, numeric, withUnit } from "./paste.js";

export class Sheet {
  // whether a text is tables at all
  static like = (text) => text.trim().includes("\n") && (/[\t;]/.test(text) || cellsOf(text)[0].length > 1);

  constructor(form, text) {
    this.form = form;
    /** @type {{ grid: any, text: string }[]} */
    this.tables = [];
    /** @type {string[][]} */
    this.values = [];
    /** @type {string[]} pressures over the angle */
    this.traces = [];
    /** @type {string[]} why a table has no place */
    this.refusals = [];
    for (const block of blocksOf(text)) this.sort(block);
  }

  // values first; the table whose heads it has takes the rest
  sort(block) {
    if (isTrace(block)) {
      this.traces.push(block);
      return;
    }
    const lines = block.split("\n");
    const cells = cellsOf(block);
    const first = cells.findIndex((line) => !named(line));
    this.values.push(...cells.slice(0, first < 0 ? undefined : first));
    if (first < 0) return;
    // a line of one word above the heads is a title
    const start = cells[first].filter(Boolean).length === 1 && lines.length > first + 1 ? first + 1 : first;
    const grid = home(this.form, cells[start], start > first ? lines[first] : "");
    if (grid && this.has(grid.table.item)) this.refusals.push(`There are two tables of ${grid.table.title}: paste one machine at a time.`);
    else if (grid) this.tables.push({ grid, text: lines.slice(start).join("\n") });
    else this.values.push(...cells.slice(start));
  }

  has(item) {
    return this.tables.some(({ grid }) => grid.table.item === item);
  }

  // what was done, in words
  fill() {
    const unknown = this.values.filter((line) => !this.value(line)).map(([name]) => name);
    const order = ["throw", "row", "web", "bearing", "weight"];
    const done = [...this.tables].sort((one, other) => order.indexOf(one.grid.table.item) - order.indexOf(other.grid.table.item)).map(({ grid, text }) => {
      const count = moved(grid, text);
      return `${count} ${grid.table.item}${count === 1 ? "" : "s"}`;
    });
    for (const text of this.traces) {
      this.form.gas.text = text;
      done.push("a pressure over the angle, below the rows");
    }
    if (this.values.length || this.traces.length) this.form.refresh();
    if (this.traces.length) this.form.opened("/machine/throws/gas")?.scrollIntoView({ block: "nearest" });
    return `${this.refusals.map((one) => `${one} `).join("")}Pasted: ${[...done, ...this.values.filter(([name]) => !unknown.includes(name)).map(([name]) => name)].join(", ") || "nothing"}.`
      + `${unknown.length ? ` Not understood: ${unknown.join(", ")}.` : ""}`;
  }

  // a number of the machine under its name; whether it has one
  /** @param {string[]} line */
  value(line) {
    const { form } = this;
    const [name, text = ""] = line;
    const [word, unit] = headOf(name);
    const found = nearest(word, form.schema.namesAt(form.root, form.request, ["machine"]));
    const description = found && form.schema.at(form.root, form.request, ["machine", found]);
    if (description?.kind !== "number") return false;
    form.put(`/machine/${found}`, read(withUnit(text, unit, description.unit), description.unit));
    return true;
  }
}

const named = ([name, value, ...rest]) => name && !numeric(name) && value && numeric(value) && !rest.some(Boolean);

function blocksOf(text) {
  return text.replace(/\r/g, "").split(/\n(?:[\t;, ]*\n)+/).map((block) => block.replace(/^\n+|\n+$/g, "")).filter((block) => block.trim());
}
