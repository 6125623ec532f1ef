// A table to type into: one row each for throws, rows of cylinders, webs, bearings or fitted weights.

import { h } from "../dom.js";
import { label, nameOf, written } from "../format.js";
import { get, join } from "../pointer.js";
import { doubt, quantity, read } from "../quantity.js";
import { columnsOf } from "./columns.js";
import { copied } from "./copied.js";
import { Pasting } from "./pasting.js";
import { Selection } from "./selection.js";

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
    this.pasting = new Pasting(this);
    this.selection = new Selection(this.body, source.owners ? 2 : 1);
    this.element = h("div", { class: `grid grid-${table.item}` },
      h("div", { class: "wide", tabindex: 0, role: "region", "aria-label": `Table of ${table.item}s: paste from a spreadsheet here`, paste: (event) => this.pasting.pasted(event) },
        h("table", {}, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "#"), source.owners ? h("th", { scope: "col" }, "throw") : null,
          this.columns.map((column, index) => h("th", { scope: "col", title: `${column.about}${column.name === "name" ? "" : ". Click to edit all of the column; Shift and arrow keys choose some, Ctrl+D fills down"}`, click: () => this.whole(index) },
            column.head, column.unit ? h("span", { class: "unit" }, ` ${column.unit}`) : null)))),
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
    input.addEventListener("focus", () => this.selection.holds(row, this.columns.indexOf(column)) || this.selection.clear());
    return h("td", { class: `field cell is-${column.kind}`, dataset: { pointer: at, head: `${column.head}${column.unit ? `, ${column.unit}` : ""}` } }, input, h("p", { class: "error", id: `error-${at}` }));
  }

  // into a cell, and into those that are chosen with it
  typed(at, column, text) {
    const entries = this.source.entries();
    const index = this.columns.indexOf(column);
    const others = this.selection.others(entries.findIndex(({ pointer }) => below(pointer, column.path) === at), index);
    let whole = false;
    for (const one of [at, ...others.map((row) => below(entries[row].pointer, column.path))]) {
      whole = this.put(one, column, text) || whole;
      this.doubt(one, column);
      this.form.errors.clear(one);
    }
    for (const row of others) this.input(row, index).value = text;
    this.ask();
    if (!whole) this.form.told(at);
    else {
      const { anchor, end } = this.selection;
      const fresh = this.form.refresh().get(this.source.pointer + this.table.item);
      if (others.length) fresh?.selection.choose(index, anchor, end);
    }
  }

  input(row, index) {
    return this.body.children[row]?.children[index + this.selection.ahead]?.querySelector("input, select");
  }

  // all of a column under edit, from its first cell; a name belongs to one row
  whole(index) {
    const last = this.body.childElementCount - 1;
    if (last < 0 || this.columns[index].name === "name") return;
    this.selection.choose(index, 0, last);
    this.input(0, index).focus();
    this.input(0, index).select?.();
  }

  // the value of a cell into those below it, or into those that are chosen
  down(row, index) {
    const column = this.columns[index];
    if (!column || column.name === "name") return;
    if (!this.selection.others(row, index).length) this.selection.choose(index, row, this.body.childElementCount - 1);
    this.typed(below(this.source.entries()[row].pointer, column.path), column, this.input(row, index).value);
  }

  // whether more than this cell has changed
  put(at, column, text) {
    const empty = column.mandatory && column.nullable && !column.optional ? null : undefined;
    const value = text.trim() ? (column.kind === "number" ? read(text, column.unit) : text.trim()) : empty;
    this.form.texts.set(at, { text, value });
    const [around, item] = column.optional ? [at.slice(0, at.lastIndexOf("/")), at.slice(0, -column.path.length - 1)] : [null, null];
    if (around === null) {
      this.form.put(at, value);
      return false;
    }
    const before = get(this.form.request, around);
    if (value === undefined && (before === null || before === undefined)) return false;
    this.form.put(at, value);
    const part = column.path.split("/")[0];
    const choices = [...this.columns, ...this.hidden].filter(({ path, kind }) => kind === "choice" && path.startsWith(`${part}/`)).map(({ name }) => name);
    // what nobody gives any more is gone, with the choices that belong to it
    if (value === undefined && Object.keys(get(this.form.request, around) ?? {}).every((name) => choices.includes(name))) this.form.put(around, undefined);
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
    const at = [...target.closest("tr").children].indexOf(target.closest("td"));
    const index = at - this.selection.ahead;
    if (key.toLowerCase() === "d" && (event.ctrlKey || event.metaKey) && !event.shiftKey) {
      event.preventDefault();
      this.down(row, index);
      return;
    }
    if (key === "Escape") this.selection.clear();
    const by = key === "ArrowDown" || key === "Enter" ? 1 : key === "ArrowUp" ? -1 : 0;
    if (!by || event.ctrlKey || event.metaKey || (target.tagName === "SELECT" && key !== "Enter")) return;
    event.preventDefault();
    if (event.shiftKey && key !== "Enter" && this.columns[index]?.name !== "name") this.selection.extend(row, index, by);
    else if (key === "Enter" && row === this.body.childElementCount - 1) this.add(at);
    else this.focus(row + by, at);
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

  // a number that may be meant otherwise, as it was typed
  doubt(at, column) {
    const value = get(this.form.request, at);
    const typed = this.form.texts.get(at);
    const found = column.kind === "number" ? doubt(value, column.unit, column.name, typed && typed.value === value ? typed.text : "") : null;
    if (found) column.doubts.set(at, found);
    else column.doubts.delete(at);
  }

  // one question a column, answered for all of it
  ask() {
    this.said.replaceChildren(...this.columns.filter(({ doubts }) => doubts.size).map((column) => {
      const { head, doubts } = column;
      const [first] = doubts.values();
      const yes = () => {
        for (const [at, { other }] of doubts) this.put(at, column, other);
        this.form.refresh();
      };
      return h("p", { class: "question" }, `${head}: ${first.words} `, h("button", { type: "button", class: "small", click: yes }, `${first.other} meant`));
    }));
  }
}

// a path of a column holds no characters that a pointer writes otherwise
const below = (pointer, path) => `${pointer}/${path}`;

function placeholder({ kind, fallback, nullable, optional, about }) {
  if (typeof fallback === "number") return String(Number(fallback.toPrecision(4)));
  return kind === "number" && nullable && !optional ? /null is ([^;,.(]+)/.exec(about)?.[1] ?? "" : "";
}
