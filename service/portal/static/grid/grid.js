// A table to type into: one row each for throws, rows of cylinders, webs, bearings or fitted weights.

import { h } from "../dom.js";
import { label, nameOf, written } from "../format.js";
import { get, join } from "../pointer.js";
import { meant, quantity, read } from "../quantity.js";
import { columnsOf, tableAt } from "./columns.js";
import { copied } from "./copied.js";
import { elsewhere, moved } from "./home.js";
import { knownHeads, placed, withUnit } from "./paste.js";
import { blankOf } from "./sources.js";

export class Grid {
  constructor(form, table, source, shown) {
    this.form = form;
    this.table = table;
    this.source = source;
    this.shown = shown;
    this.current = 0;
    this.columns = columnsOf(form.schema, source.items, table, shown);
    this.hidden = columnsOf(form.schema, source.items, table, new Set(Object.keys(table.groups))).filter(({ path }) => !this.columns.some((one) => one.path === path));
    this.said = h("div", { class: "said", role: "status" });
    this.body = h("tbody", {}, source.entries().map((entry, row) => this.line(entry, row)));
    this.element = h("div", { class: `grid grid-${table.item}` },
      h("div", { class: "wide", tabindex: 0, role: "region", "aria-label": `Table of ${table.item}s: paste from a spreadsheet here`, paste: (event) => this.pasted(event) },
        h("table", {}, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "#"), source.owners ? h("th", { scope: "col" }, "throw") : null,
          this.columns.map((column) => h("th", { scope: "col", title: column.about }, column.head, column.unit ? h("span", { class: "unit" }, ` ${column.unit}`) : null)))),
        this.body)),
      this.body.childElementCount ? null : h("p", { class: "about" }, `No ${table.item} yet: add one, or paste a table from a spreadsheet.`),
      this.said, this.tools());
    this.mark(0);
    for (const column of this.columns) {
      column.doubts = new Map();
      for (const { pointer } of source.entries()) this.doubt(below(pointer, column.path), column);
    }
    this.ask();
  }

  line(entry, row) {
    const cells = this.columns.map((column) => this.cell(column, entry, row));
    return h("tr", { focusin: () => this.mark(row), keydown: (event) => this.key(event, row) }, h("th", { scope: "row" }, String(row + 1)),
      this.source.owners ? h("td", { class: "cell", "data-head": "throw" }, this.owner(entry, row)) : null, cells);
  }

  owner(entry, row) {
    const names = this.source.owners();
    const select = h("select", { "aria-label": `throw of row ${row + 1}`, change: () => {
      this.source.give(entry, Number(select.value));
      this.form.refresh();
    } }, names.map((name, index) => h("option", { value: index }, name)));
    select.value = entry.owner;
    return select;
  }

  cell(column, entry, row) {
    const at = `${entry.pointer}/${column.path}`;
    const value = get(this.form.request, at);
    const attributes = { "aria-label": `${column.head}${column.unit ? `, ${column.unit}` : ""}, ${this.table.item} ${row + 1}`, "aria-describedby": `error-${at}` };
    const input = column.kind === "choice"
      ? h("select", { ...attributes, change: () => this.typed(at, column, input.value) }, h("option", { value: "" }, "–"), column.options.map((one) => h("option", {}, one)))
      : h("input", { ...attributes, type: "text", autocomplete: "off", spellcheck: "false", class: column.kind, placeholder: placeholder(column),
        input: () => this.typed(at, column, input.value) });
    input.value = written(value);
    return h("td", { class: `field cell is-${column.kind}`, dataset: { pointer: at, head: `${column.head}${column.unit ? `, ${column.unit}` : ""}` } }, input, h("p", { class: "error", id: `error-${at}` }));
  }

  typed(at, column, text) {
    const whole = this.put(at, column, text);
    this.doubt(at, column);
    this.ask();
    if (whole) this.form.refresh();
    else this.form.told(at);
  }

  // whether more than this cell has changed
  put(at, column, text) {
    const empty = column.mandatory && column.nullable && !column.optional ? null : undefined;
    const value = text.trim() ? (column.kind === "number" ? read(text, column.unit) : text.trim()) : empty;
    const [around, item] = column.optional ? [at.slice(0, at.lastIndexOf("/")), at.slice(0, -column.path.length - 1)] : [null, null];
    if (around === null) {
      this.form.put(at, value);
      return false;
    }
    const before = get(this.form.request, around);
    if (value === undefined && (before === null || before === undefined)) return false;
    this.form.put(at, value);
    const part = column.path.split("/")[0];
    if ([...this.columns, ...this.hidden].every(({ path, kind }) => !path.startsWith(`${part}/`) || kind === "choice" || get(this.form.request, below(item, path)) === undefined)) this.form.put(around, undefined);
    else if ((before === null || before === undefined) && part === "envelope") {
      // radius and mass follow from what is cut
      if (column.kind !== "choice") this.form.put(join(around, "shape"), "segment");
      for (const name of ["counterweight_radius_m", "max_mass_kg"]) this.form.put(join(item, name), undefined);
      return true;
    }
    return false;
  }

  mark(row) {
    this.body.children[this.current]?.classList.remove("current");
    this.current = Math.min(row, Math.max(0, this.body.childElementCount - 1));
    this.body.children[this.current]?.classList.add("current");
    for (const button of this.element.querySelectorAll("[data-of]")) {
      button.setAttribute("aria-label", `${button.textContent} ${this.table.item} ${this.name(this.current)}`);
    }
  }

  name(row) {
    const entry = this.source.entries()[row];
    return entry ? nameOf(entry.item, row) : "";
  }

  key(event, row) {
    const { key, target } = event;
    const by = key === "ArrowDown" || key === "Enter" ? 1 : key === "ArrowUp" ? -1 : 0;
    if (!by || event.ctrlKey || event.metaKey || (target.tagName === "SELECT" && key !== "Enter")) return;
    event.preventDefault();
    const column = [...target.closest("tr").children].indexOf(target.closest("td"));
    if (key === "Enter" && row === this.body.childElementCount - 1) this.add(column);
    else this.focus(row + by, column);
  }

  focus(row, column) {
    const input = this.body.children[row]?.children[column]?.querySelector("input, select");
    input?.focus();
    input?.select?.();
  }

  // the grid that has taken the place of this one
  again(row, column = 1) {
    const fresh = this.form.refresh().get(this.source.pointer + this.table.item);
    fresh?.mark(row);
    fresh?.focus(row, column);
  }

  add(column) {
    this.source.add();
    const last = this.body.childElementCount;
    this.again(last, column);
  }

  tools() {
    const entry = () => this.source.entries()[this.current];
    const button = (text, click, more) => h("button", { type: "button", class: "small", click, ...more }, text);
    const of = (text, click) => button(text, () => entry() && click(), { dataset: { of: "" } });
    const move = (by) => {
      const to = this.source.move(entry(), by);
      if (to !== null) this.again(to);
    };
    const about = h("input", { type: "text", value: "0", "aria-label": "plane of the mirror, m", class: "plane" });
    const mirror = () => {
      this.source.mirror(quantity(read(about.value, "m"), "m"), (item) => quantity(item?.position_m, "m"));
      this.again(0);
    };
    return h("div", { class: "buttons tools" },
      button(`Add ${this.table.item}`, () => this.add(), { class: "small add" }),
      of("Duplicate", () => { this.source.add(this.current, entry().index); this.again(this.current + 1); }),
      of("Up", () => move(-1)), of("Down", () => move(1)),
      of("Remove", () => { this.source.remove(entry()); this.again(Math.max(0, this.current - 1)); }),
      this.source.items.properties.position_m ? h("span", { class: "mirror" }, button("Mirror about", mirror), about, " m") : null,
      this.table.item === "web" && this.form.request.machine?.throws ? button("Sectors opposite their cranks", () => this.opposite()) : null,
      button("Copy table", () => copied(this.text(), this.said)),
      Object.keys(this.table.groups).map((name) => button(label(name), () => this.toggle(name), { "aria-pressed": String(this.shown.has(name)) })));
  }

  toggle(name) {
    if (!this.form.unfolded.delete(name)) this.form.unfolded.add(name);
    this.form.refresh({ told: false });
  }

  // every web's sector about the direction against its crank
  opposite() {
    const { machine } = this.form.request;
    const place = (thing) => quantity(thing?.position_m, "m");
    for (const { pointer, item } of this.source.entries()) {
      const near = [...machine.throws].sort((one, other) => Math.abs(place(one) - place(item)) - Math.abs(place(other) - place(item)))[0];
      const crank = quantity((machine.throws[item?.throw] ?? near)?.crank_angle_deg, "deg");
      if (!Number.isFinite(crank) || item?.fixed) continue;
      const centre = Number(((((crank + 180) % 360) + 360) % 360).toPrecision(12));
      this.form.put(join(pointer, "sector"), { half_angle_deg: 30, ...item.sector, centre_deg: centre });
    }
    this.again(this.current);
  }

  // what this tab took from a spreadsheet comes back as it was
  text() {
    const lines = this.source.entries().map(({ pointer, owner }) => [...(this.source.owners ? [this.source.owners()[owner]] : []),
      ...this.columns.map(({ path }) => get(this.form.request, below(pointer, path)) ?? "")]);
    return [[...(this.source.owners ? ["throw"] : []), ...this.columns.map(({ path }) => path)], ...lines].map((line) => line.join("\t")).join("\n");
  }

  pasted(event) {
    const text = event.clipboardData?.getData("text/plain") ?? "";
    const cell = event.target.closest("td");
    // one value goes where the caret is; several tables are no table
    if ((!/[\t\n]/.test(text.trim()) && cell) || /\n[\t; \r]*\n\s*\S/.test(text)) return;
    event.preventDefault();
    const other = elsewhere(this, text);
    if (other) {
      this.said.replaceChildren(h("p", { class: "error" }, `This is a table of ${other.table.title}: nothing was pasted here. `,
        h("button", { type: "button", class: "small", click: () => moved(other, text) }, `Paste it into the ${other.table.title}`)));
      return;
    }
    const first = this.source.owners ? 2 : 1;
    const start = cell ? [...cell.parentElement.children].indexOf(cell) - first : this.source.owners ? -1 : 0;
    this.fill(text, cell ? [...this.body.children].indexOf(cell.parentElement) : 0, start, {});
  }

  fill(text, row, start, accepted) {
    const columns = this.pasteable();
    const { rows, places, unknown } = placed(text, columns, start + (this.source.owners ? 1 : 0), accepted);
    if (row + rows.length > this.source.most) {
      this.said.replaceChildren(h("p", { class: "error" }, `${rows.length} lines are more than the ${this.source.most} ${this.table.title} that a machine may have: nothing was pasted.`));
      return 0;
    }
    rows.forEach((cells, index) => {
      while (this.source.entries().length <= row + index) this.source.add();
      const before = this.source.entries()[row + index];
      const to = places.findIndex((place) => columns[place?.index]?.kind === "owner");
      if (to >= 0) this.give(before, cells[to]);
      // a row that goes to another throw keeps what it is, not its number
      const { pointer } = this.source.entries().find((one) => one.item === before.item) ?? before;
      cells.forEach((cell, at) => {
        const column = columns[places[at]?.index];
        if (!column || column.kind === "owner") return;
        if (column.row && !get(this.form.request, `${pointer}/rows`)?.length) this.form.put(`${pointer}/rows`, [blankOf(this.form.schema, column.row)]);
        this.put(below(pointer, column.path), column, withUnit(cell, places[at].unit, column.unit));
      });
    });
    const fresh = this.form.refresh().get(this.source.pointer + this.table.item);
    fresh?.unknown(unknown, (more) => fresh.fill(text, row, start, { ...accepted, ...more }));
    fresh?.mark(row);
    return rows.length;
  }

  // Columns that a paste may fill: an owner, those that are seen, those that are not, and those of the one row that
  // a throw has in most machines.
  pasteable() {
    const { form: { schema }, source } = this;
    const row = source.items.properties.rows ? schema.describe(source.items.properties.rows).items : null;
    const rows = row ? columnsOf(schema, row, tableAt(`${source.pointer}/0/rows`), new Set()).filter(({ path }) => path !== "name") : [];
    const own = [...this.columns, ...this.hidden].map((column) => (column.path === "name" ? { ...column, also: this.table.item } : column));
    return [...(source.owners ? [{ path: "throw", name: "throw", head: "throw", kind: "owner" }] : []), ...own,
      ...rows.map((column) => ({ ...column, path: `rows/0/${column.path}`, row }))];
  }

  // how many columns here some heads name, those of rows beside those of throws, and how many that must be given they miss
  fit(cells) {
    const all = this.pasteable();
    const own = knownHeads(cells, all.filter((column) => !column.row));
    return {
      heads: own.size > 1 ? knownHeads(cells, all).size : own.size,
      missing: all.filter(({ mandatory, nullable, row, path }, index) => mandatory && !nullable && !row && path !== "name" && !own.has(index)).length,
    };
  }

  give(entry, name) {
    const owner = this.source.owners().indexOf(name);
    const known = owner >= 0 ? owner : Number(name) - 1;
    if (known >= 0 && known < this.source.owners().length && known !== entry.owner) this.source.give(entry, known);
  }

  unknown(heads, again) {
    this.said.append(...heads.map(({ head, near }) => h("p", {}, `“${head}” is no column here${near ? `: did you mean ${near}? ` : ", and was left out."}`,
      near ? h("button", { type: "button", class: "small", click: () => again({ [head]: near }) }, `Yes, ${near}`) : null)));
  }

  doubt(at, column) {
    const value = get(this.form.request, at);
    const other = meant(value, column.unit, column.name);
    if (other) column.doubts.set(at, { value, other });
    else column.doubts.delete(at);
  }

  // one question a column, answered for all of it
  ask() {
    this.said.replaceChildren(...this.columns.filter(({ doubts }) => doubts.size).map(({ head, doubts }) => {
      const [first] = doubts.values();
      const yes = () => {
        for (const [at, { other }] of doubts) this.form.put(at, other);
        this.form.refresh();
      };
      return h("p", { class: "question" }, `${head}: ${first.value} m? `, h("button", { type: "button", class: "small", click: yes }, `${first.other} meant`));
    }));
  }
}

// a path of a column holds no characters that a pointer writes otherwise
const below = (pointer, path) => `${pointer}/${path}`;

function placeholder({ kind, fallback, nullable, optional, about }) {
  if (typeof fallback === "number") return String(Number(fallback.toPrecision(4)));
  return kind === "number" && nullable && !optional ? /null is ([^;,.(]+)/.exec(about)?.[1] ?? "" : "";
}
