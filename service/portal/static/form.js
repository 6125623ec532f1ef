// The form of a request, generated from its schema. Every part knows its JSON pointer.

import { h } from "./dom.js";
import { field } from "./fields.js";
import { label, nameOf, singular } from "./format.js";
import { inTable, tableAt } from "./grid/columns.js";
import { Grid } from "./grid/grid.js";
import { ListSource, RowsSource } from "./grid/sources.js";
import { get, join, parent, set, split } from "./pointer.js";
import { another } from "./schema.js";
import { nearest } from "./words.js";

const NOT_ASKED = new Set(["outputs"]);
const SINGLE = new Set(["number", "text", "boolean", "choice", "numbers"]);
const WIDE = "(min-width: 1000px)";
// longer lists are opened by the reader
const FEW = 40;

export class Form {
  // `changed` is called after every edit, with the pointer of a single value
  constructor(container, schema, model, changed) {
    this.container = container;
    this.schema = schema;
    this.root = schema.model(model);
    this.changed = changed;
    this.request = {};
    this.grids = new Map();
    // optional columns that were asked for
    this.unfolded = new Set();
  }

  show(request) {
    // on narrow screens the results stand below the form
    const lists = ["/machine/throws", "/machine/webs"].filter((list) => !(get(request, list)?.length > FEW));
    this.draw(request, matchMedia(WIDE).matches ? ["/machine", ...lists] : []);
  }

  // `open` from the outside inwards
  draw(request, open) {
    this.request = request;
    this.grids = new Map();
    const { plain, groups } = this.parts(this.root, "");
    this.container.replaceChildren(...plain, ...groups);
    for (const pointer of open) {
      const group = this.group(pointer);
      if (group) Object.assign(group, { open: true }).build();
    }
  }

  // another state of the same work
  restore(request) {
    this.request = request;
    this.refresh({ told: false });
  }

  // the same request after more than one value has changed: what was open stays open, the caret where it was
  refresh({ told = true } = {}) {
    const open = [...this.container.querySelectorAll("details[open][data-pointer]")].map((one) => one.dataset.pointer);
    const place = document.activeElement?.closest("[data-pointer]")?.getAttribute("data-pointer");
    this.draw(this.request, open);
    const input = place && this.container.querySelector(`.field[data-pointer="${CSS.escape(place)}"] :is(input, select)`);
    input?.focus();
    if (told) this.changed();
    return this.grids;
  }

  edit(pointer, value) {
    set(this.request, pointer, value);
    this.told(pointer);
  }

  told(pointer) {
    this.clear(pointer);
    this.headings();
    this.changed(pointer);
  }

  // headings follow names
  headings() {
    for (const one of this.container.querySelectorAll("details.item[data-heading]")) {
      const { pointer, heading } = one.dataset;
      one.firstElementChild.textContent = `${heading} ${nameOf(get(this.request, pointer), Number(pointer.split("/").at(-1)))}`;
    }
  }

  // the optional columns of a table: those that are used, and those that were asked for
  shown(table, source) {
    const used = ([, [first]]) => source.entries().some(({ item }) => {
      const value = item?.[first.split("/")[0]];
      return value !== undefined && value !== null && value !== 0;
    });
    return new Set(Object.entries(table.groups).filter((group) => this.unfolded.has(group[0]) || used(group)).map(([name]) => name));
  }

  // whether a table shows all of what is at a pointer, or could
  covered(at, description) {
    const { table, path } = inTable(at) ?? {};
    if (!table) return false;
    const paths = this.grids.get(table)?.columns.map((column) => column.path) ?? table.columns;
    if (paths.includes(path)) return true;
    const below = paths.filter((one) => one.startsWith(`${path}/`)).map((one) => one.split("/")[1]);
    const absent = get(this.request, at) === undefined || get(this.request, at) === null;
    return below.length > 0 && (absent || Object.keys(description.properties ?? {}).every((name) => below.includes(name)));
  }

  group(pointer) {
    return this.container.querySelector(`details[data-pointer="${CSS.escape(pointer)}"]`);
  }

  // fields first, then groups; what must be given comes before what may be left out
  parts(object, pointer) {
    const plain = [];
    const more = [];
    const groups = [];
    for (const [name, node] of Object.entries(object.properties)) {
      if (pointer === "" && NOT_ASKED.has(name)) continue;
      const description = this.schema.describe(node);
      const at = join(pointer, name);
      const value = get(this.request, at);
      const required = object.required.has(name);
      if (description.kind === "constant" || this.covered(at, description)) continue;
      if (SINGLE.has(description.kind)) {
        const made = field(name, at, description, value, required, (given) => this.edit(at, given));
        (required || value !== undefined || description.longest <= 64 ? plain : more).push(made);
      } else {
        const made = this.part(name, at, description, required);
        if (required) groups.unshift(made); else groups.push(made);
      }
    }
    if (plain.length + more.length <= 4) plain.push(...more.splice(0));
    return {
      plain: [h("div", { class: "fields" }, plain),
        more.length ? h("details", { class: "more" }, h("summary", {}, "More"), h("div", { class: "fields" }, more)) : []].flat(),
      groups,
    };
  }

  part(name, at, description, required) {
    if (description.kind === "list") return this.list(name, at, description);
    if (description.kind === "variants") return this.variants(name, at, description);
    return this.object(name, at, description, required);
  }

  // the insides are made when they are first opened: a machine may have five hundred webs
  fold(attributes, summary, pointer, inside) {
    const error = h("p", { class: "error", id: `error-${pointer}` });
    const body = h("div", { class: "inside" });
    const details = h("details", { ...attributes, dataset: { pointer } }, h("summary", {}, summary), error, body);
    const build = () => {
      if (!body.childElementCount) body.append(...inside());
    };
    details.build = build;
    details.addEventListener("toggle", () => details.open && build());
    return details;
  }

  redraw(details, made, open = true) {
    made.open = open;
    if (open) made.build?.();
    details.replaceWith(made);
    this.changed();
    made.querySelector("summary")?.focus();
  }

  object(name, at, description, required) {
    const value = get(this.request, at);
    const optional = !required && (description.nullable || description.fallback === undefined || value !== undefined);
    if ((value === undefined || value === null) && description.nullable) return this.absent(name, at, description, required);
    const shape = description.kind === "union" ? this.chosen(description, value) : description;
    const details = this.fold({ class: "group" }, label(name), at, () => {
      const { plain, groups } = this.parts(shape, at);
      const remove = () => {
        set(this.request, at, undefined);
        this.redraw(details, this.part(name, at, description, required), false);
      };
      return [
        description.kind === "union" ? this.kind(name, at, description, required, () => details) : [],
        plain, groups,
        optional && description.nullable ? h("button", { type: "button", click: remove }, `Remove ${label(name)}`) : [],
      ].flat(2);
    });
    return details;
  }

  absent(name, at, description, required) {
    const box = h("div", { class: "absent", dataset: { pointer: at } },
      h("button", { type: "button", click: () => {
        set(this.request, at, this.schema.blank(description));
        this.redraw(box, this.part(name, at, description, required));
      } }, `Add ${label(name)}`),
      h("span", { class: "about" }, ` ${description.about}`),
      h("p", { class: "error", id: `error-${at}` }));
    return box;
  }

  chosen({ tag, options }, value) {
    return options.get(value?.[tag]) ?? [...options.values()][0];
  }

  kind(name, at, description, required, details) {
    const { tag, options } = description;
    const now = get(this.request, at)?.[tag];
    const about = { kind: "choice", options: [...options.keys()], about: `${label(name)}: ${tag}`, fallback: now };
    return field(tag, join(at, tag), about, now, true, (chosen) => {
      const known = options.get(chosen).properties;
      const kept = Object.entries(get(this.request, at) ?? {}).filter(([field]) => field in known && field !== tag);
      const fresh = this.schema.filled(options.get(chosen));
      set(this.request, at, { ...fresh, ...Object.fromEntries(kept), [tag]: chosen });
      this.redraw(details(), this.part(name, at, description, required));
    });
  }

  // one row each in a table; below it what has no column
  tabled(name, at, description, table) {
    const source = new ListSource(this, at, description);
    return this.fold({ class: "group tabled" }, `${label(name)} (${source.entries().length})`, at, () => {
      const inner = description.items.properties.rows && this.schema.describe(description.items.properties.rows);
      const rows = inner && new RowsSource(this, at, inner);
      return [
        this.grid(table, source),
        rows ? [h("h3", {}, "Rows"), this.grid(tableAt(`${at}/0/rows`), rows)] : [],
        h("p", { class: "about" }, `${description.about}; everything else of each:`),
        source.entries().map((_, index) => this.item(name, at, index, description, null)),
      ].flat();
    });
  }

  grid(table, source) {
    const made = new Grid(this, table, source, this.shown(table, source));
    this.grids.set(source.pointer + table.item, made);
    this.grids.set(table, made);
    return made.element;
  }

  list(name, at, description) {
    const table = tableAt(at);
    if (table && !inTable(at)) return this.tabled(name, at, description, table);
    // a machine that was pasted may hold anything
    const items = () => [get(this.request, at) ?? []].flat();
    const made = this.fold({ class: "group" }, `${label(name)} (${items().length})`, at, () => [
      ...items().map((_, index) => this.item(name, at, index, description, () => made)),
      h("button", { type: "button", class: "add", click: () => {
        const list = items();
        const item = list.length ? another(list) : this.schema.blank(description.items);
        set(this.request, at, [...list, item]);
        const fresh = this.list(name, at, description);
        this.redraw(made, fresh);
        const added = fresh.querySelector(`:scope > .inside > [data-pointer="${CSS.escape(join(at, list.length))}"]`);
        added?.setAttribute("open", "");
      } }, `Add ${singular(name)}`),
      h("p", { class: "about" }, description.about),
    ]);
    return made;
  }

  item(name, at, index, description, details) {
    const pointer = join(at, index);
    const value = get(this.request, pointer);
    return this.fold({ class: "item", "data-heading": singular(name) }, `${singular(name)} ${nameOf(value, index)}`, pointer, () => {
      const { plain, groups } = this.parts(description.items, pointer);
      const remove = () => {
        set(this.request, pointer, undefined);
        if (details) this.redraw(details(), this.list(name, at, description));
        else this.refresh();
      };
      return [...plain, ...groups, h("button", { type: "button", click: remove }, `Remove ${singular(name)}`)];
    });
  }

  // a number, or a table over the turn
  variants(name, at, description) {
    const value = get(this.request, at);
    const tabled = value !== null && typeof value === "object";
    const switched = (table) => {
      set(this.request, at, table ? this.schema.filled(description.object) : undefined);
      this.redraw(made, this.variants(name, at, description));
    };
    const made = this.fold({ class: "group" }, label(name), at, () => {
      const change = (given) => this.edit(at, given);
      const number = { ...description, kind: "number", text: true };
      const inside = tabled ? this.parts(description.object, at).plain : [field(name, at, number, value, false, change)];
      const other = tabled ? "Give one constant instead" : "Give a table over the turn instead";
      return [...inside, h("button", { type: "button", click: () => switched(!tabled) }, other)];
    });
    return made;
  }

  clear(pointer) {
    const places = pointer === undefined ? this.container.querySelectorAll(".wrong")
      : this.container.querySelectorAll(`.wrong[data-pointer="${CSS.escape(pointer)}"]`);
    for (const place of places) {
      place.classList.remove("wrong");
      place.querySelector(":scope > .error").textContent = "";
      place.querySelector("input, select, textarea")?.removeAttribute("aria-invalid");
    }
  }

  // Messages at their fields, or at the nearest thing around them; returns what has no place in the form.
  blame(errors) {
    this.clear();
    const homeless = [];
    let first = null;
    for (const { pointer, message: said } of errors) {
      const message = this.meant(pointer, said);
      const place = this.place(pointer);
      if (!place) {
        homeless.push({ pointer, message });
        continue;
      }
      const exact = place.dataset.pointer === pointer;
      const error = place.querySelector(":scope > .error");
      const text = exact ? message : `${pointer.slice(place.dataset.pointer.length + 1).replaceAll("/", " ")}: ${message}`;
      error.textContent = error.textContent ? `${error.textContent}; ${text}` : text;
      place.classList.add("wrong");
      const input = place.classList.contains("field") ? place.querySelector("input, select, textarea") : null;
      input?.setAttribute("aria-invalid", "true");
      first ??= input ?? place.querySelector("summary, button");
    }
    first?.focus();
    return homeless;
  }

  // what was meant by a field that the service does not know
  meant(pointer, message) {
    if (message !== "unknown field") return message;
    const parts = split(pointer);
    const near = nearest(parts.at(-1), this.schema.namesAt(this.root, this.request, parts.slice(0, -1)));
    return near ? `${message}; did you mean ${near}?` : message;
  }

  // the part of the form at a pointer, everything around it opened
  place(pointer) {
    if (!pointer) return null;
    const around = this.place(parent(pointer));
    const found = this.container.querySelector(`[data-pointer="${CSS.escape(pointer)}"]`);
    if (!found) return around;
    for (let node = found; node !== this.container; node = node.parentElement) {
      if (node.tagName === "DETAILS") {
        node.open = true;
        node.build?.();
      }
    }
    return found;
  }
}
