// The table of weighed parts: typed, or pasted from a spreadsheet; what is wrong stands in its cell.

import { h } from "../dom.js";
import { placed, withUnit } from "../grid/paste.js";
import { blank } from "./question.js";

/** @type {{ path: string, name: string, head: string, list?: string }[]} */
const COLUMNS = [
  { path: "kind", name: "class", head: "kind", list: "match-kinds" },
  { path: "name", name: "part", head: "name" },
  { path: "mass", name: "mass_kg", head: "mass" },
  { path: "rows", name: "row", head: "only on rows" },
];
const KINDS = ["crosshead", "piston", "piston rod", "balance nut"];
const EMPTY = { kind: "", name: "", mass: "", rows: "" };

export class Parts {
  /** @param {import("./question.js").Line[]} lines @param {() => void} changed */
  constructor(lines, changed) {
    this.lines = lines;
    this.changed = changed;
    this.body = h("tbody", {});
    this.element = h("div", {},
      h("datalist", { id: "match-kinds" }, KINDS.map((value) => h("option", { value }))),
      h("table", { class: "cards weighed" }, h("caption", {}, "Weighed parts, each to be used once"),
        h("thead", {}, h("tr", {}, COLUMNS.map(({ head }) => h("th", { scope: "col" }, head === "mass" ? "mass, kg" : head)))), this.body));
    this.draw();
  }

  draw() {
    // a line to type the next part into
    if (!this.lines.length || !blank(this.lines.at(-1))) this.lines.push({ ...EMPTY });
    this.body.replaceChildren(...this.lines.map((line, index) => h("tr", {}, COLUMNS.map((column) => this.cell(line, index, column)))));
  }

  /** @param {any} line @param {number} index @param {{ path: string, head: string, list?: string }} column */
  cell(line, index, { path, head, list }) {
    const id = `match-${path}-${index}`;
    const input = h("input", { type: "text", id, list, value: line[path], autocomplete: "off", spellcheck: "false",
      "aria-label": `${head} of part ${index + 1}`, "aria-describedby": `${id}-error`,
      input: () => {
        line[path] = input.value;
        this.clear(input);
        if (index === this.lines.length - 1 && !blank(line)) this.append();
        this.changed();
      },
      paste: (event) => this.paste(event, index, COLUMNS.findIndex((one) => one.path === path)) });
    return h("td", { "data-head": head === "mass" ? "mass, kg" : head }, h("div", {}, input, h("p", { class: "error", id: `${id}-error` })));
  }

  append() {
    this.lines.push({ ...EMPTY });
    this.body.append(h("tr", {}, COLUMNS.map((column) => this.cell(this.lines.at(-1), this.lines.length - 1, column))));
  }

  paste(event, index, start) {
    const text = event.clipboardData?.getData("text/plain") ?? "";
    if (!/[\t\n]/.test(text.trim())) return;
    event.preventDefault();
    const { rows, places } = placed(text, COLUMNS, start);
    rows.forEach((cells, k) => {
      const line = (this.lines[index + k] ??= { ...EMPTY });
      cells.forEach((cell, at) => {
        const column = COLUMNS[places[at]?.index];
        if (column) line[column.path] = column.path === "mass" ? withUnit(cell, places[at].unit, "kg") : cell;
      });
    });
    this.draw();
    this.changed();
    this.body.querySelector(`#match-mass-${index + rows.length - 1}`)?.focus();
  }

  clear(input) {
    input.removeAttribute("aria-invalid");
    this.body.querySelector(`#${input.id}-error`).textContent = "";
  }

  // messages at their cells, the first of them in view
  blame(troubles) {
    for (const input of this.body.querySelectorAll("input")) this.clear(input);
    for (const { index, field, message } of troubles) {
      const input = this.body.querySelector(`#match-${field}-${index}`);
      const error = this.body.querySelector(`#match-${field}-${index}-error`);
      input.setAttribute("aria-invalid", "true");
      error.textContent = [error.textContent, message].filter(Boolean).join("; ");
    }
    this.body.querySelector("[aria-invalid]")?.focus();
  }
}
