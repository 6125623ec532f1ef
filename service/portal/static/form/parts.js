// The parts of a form, generated from the schema of a request. Every part knows its JSON pointer.

import { h } from "../dom.js";
import { hint, label, nameOf, singular } from "../format.js";
import { gasPart } from "../gas/part.js";
import { inTable, tableAt } from "../grid/columns.js";
import { Grid } from "../grid/grid.js";
import { ListSource, RowsSource } from "../grid/sources.js";
import { get, join } from "../pointer.js";
import { another } from "../schema.js";
import { field } from "./fields.js";
import { fieldsAt, shared, SIZES, titled } from "./sizes.js";

const NOT_ASKED = new Set(["outputs"]);
const SINGLE = new Set(["number", "text", "boolean", "choice", "numbers"]);

export class Parts {
  constructor(form) {
    this.form = form;
  }

  // the optional columns of a table: those that are used, and those that were asked for
  shown(table, source) {
    const used = ([, [first]]) => source.entries().some(({ item }) => {
      const value = item?.[first.split("/")[0]];
      return value !== undefined && value !== null && value !== 0;
    });
    return new Set(Object.entries(table.groups).filter((group) => this.form.unfolded.has(group[0]) || used(group)).map(([name]) => name));
  }

  // whether a table shows all of what is at a pointer, or could
  covered(at, description) {
    const { table, path } = inTable(at) ?? {};
    if (!table) return false;
    const paths = this.form.grids.get(table)?.columns.map((column) => column.path) ?? table.columns;
    if (paths.includes(path)) return true;
    const below = paths.filter((one) => one.startsWith(`${path}/`)).map((one) => one.split("/")[1]);
    const absent = get(this.form.request, at) === undefined || get(this.form.request, at) === null;
    return below.length > 0 && (absent || Object.keys(description.properties ?? {}).every((name) => below.includes(name)));
  }

  // fields and groups under the headings that the schema gives them, in its order
  inside(object, pointer) {
    /** @type {Map<string, { plain: any[], more: any[], groups: any[] }>} */
    const sections = new Map();
    const chosen = Boolean(get(this.form.request, SIZES));
    for (const [name, at, node] of fieldsAt(pointer, object.properties, this.form.schema, chosen)) {
      if (pointer === "" && NOT_ASKED.has(name)) continue;
      const described = titled(at, this.form.schema.describe(node));
      // the pieces stand among the sizes without a heading of their own
      const description = pointer === SIZES ? { ...described, group: "" } : described;
      const value = get(this.form.request, at);
      const required = object.required.has(name);
      if (description.kind === "constant" || this.covered(at, description)) continue;
      const heading = description.group ?? "";
      const section = sections.get(heading) ?? { plain: [], more: [], groups: [] };
      sections.set(heading, section);
      if (SINGLE.has(description.kind)) {
        const made = field(name, at, description, value, required, (given) => this.form.edit(at, given));
        (required || value !== undefined || description.longest <= 64 || pointer === SIZES ? section.plain : section.more).push(made);
      } else section.groups.push(this.part(name, at, description, required));
    }
    return [...sections].flatMap(([heading, section]) => this.section(sections.size > 1 ? heading : "", section));
  }

  // fields first, those that may be left out folded where they are many; what has a title of its own needs no heading
  section(heading, { plain, more, groups }) {
    if (plain.length + more.length <= 4) plain.push(...more.splice(0));
    const nodes = [
      plain.length ? h("div", { class: "fields" }, plain) : [],
      more.length ? h("details", { class: "more" }, h("summary", {}, "More"), h("div", { class: "fields" }, more)) : [],
      groups,
    ].flat();
    return heading && nodes.length > Number(groups.length === 1) ? [h("fieldset", {}, h("legend", {}, heading), nodes)] : nodes;
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
    this.form.tell();
    made.querySelector("summary")?.focus();
  }

  object(name, at, description, required) {
    const value = get(this.form.request, at);
    const optional = !required && (description.nullable || description.fallback === undefined || value !== undefined);
    if ((value === undefined || value === null) && description.nullable) return this.absent(name, at, description, required);
    const shape = description.kind === "union" ? description.options.get(value?.[description.tag]) : description;
    const details = this.fold({ class: "group" }, description.title, at, () => {
      const remove = () => {
        this.form.put(at, undefined);
        if (shared(at)) this.form.refresh();
        else this.redraw(details, this.part(name, at, description, required), false);
      };
      return [
        description.kind === "union" ? this.kind(name, at, description, required, () => details) : [],
        shape ? this.inside(shape, at) : [],
        optional && description.nullable ? h("button", { type: "button", click: remove }, `Remove ${titled(at, {}).title?.toLowerCase() ?? label(name)}`) : [],
      ].flat(2);
    });
    return details;
  }

  absent(name, at, description, required) {
    const box = h("div", { class: "absent", dataset: { pointer: at } },
      h("button", { type: "button", click: () => {
        this.form.put(at, this.form.schema.blank(description));
        if (shared(at)) {
          this.form.refresh();
          this.form.opened(at)?.querySelector("summary")?.focus();
        } else this.redraw(box, this.part(name, at, description, required));
      } }, `Add ${titled(at, {}).title?.toLowerCase() ?? label(name)}`),
      h("span", { class: "about" }, ` ${hint(description.about)}`),
      h("p", { class: "error", id: `error-${at}` }));
    return box;
  }

  kind(name, at, description, required, details) {
    const { tag, options } = description;
    const now = get(this.form.request, at)?.[tag];
    const about = { kind: "choice", options: [...options.keys()], about: `${label(name)}: ${tag}` };
    return field(tag, join(at, tag), about, now, true, (chosen) => {
      if (!chosen) return;
      const known = options.get(chosen).properties;
      const kept = Object.entries(get(this.form.request, at) ?? {}).filter(([field]) => field in known && field !== tag);
      const fresh = this.form.schema.filled(options.get(chosen));
      this.form.put(at, { ...fresh, ...Object.fromEntries(kept), [tag]: chosen });
      this.redraw(details(), this.part(name, at, description, required));
    });
  }

  // one row each in a table; below it what has no column
  tabled(name, at, description, table) {
    const source = new ListSource(this.form, at, description);
    const more = Object.keys(description.items.properties).some((field) => !table.columns.includes(field));
    return this.fold({ class: "group tabled" }, `${description.title} (${source.entries().length})`, at, () => {
      const inner = description.items.properties.rows && this.form.schema.describe(description.items.properties.rows);
      const rows = inner && new RowsSource(this.form, at, inner);
      return [
        this.grid(table, source),
        rows ? [h("h3", {}, "Rows"), this.grid(tableAt(`${at}/0/rows`), rows), this.gas()] : [],
        h("p", { class: "about" }, `${hint(description.about)}${more ? "; everything else of each:" : "."}`),
        more ? source.entries().map((_, index) => this.item(name, at, index, description, null)) : [],
      ].flat();
    });
  }

  gas() {
    return this.fold({ class: "group gas" }, "Indicated pressure and firing order", "/machine/throws/gas", () => gasPart(this.form));
  }

  grid(table, source) {
    const made = new Grid(this.form, table, source, this.shown(table, source));
    this.form.grids.set(source.pointer + table.item, made);
    this.form.grids.set(table, made);
    return made.element;
  }

  list(name, at, description) {
    const table = tableAt(at);
    if (table && !inTable(at)) return this.tabled(name, at, description, table);
    // a machine that was pasted may hold anything
    const items = () => [get(this.form.request, at) ?? []].flat();
    const made = this.fold({ class: "group" }, `${description.title} (${items().length})`, at, () => [
      ...items().map((_, index) => this.item(name, at, index, description, () => made)),
      h("button", { type: "button", class: "add", click: () => {
        const list = items();
        const item = list.length ? another(list) : this.form.schema.blank(description.items);
        this.form.put(at, [...list, item]);
        const fresh = this.list(name, at, description);
        this.redraw(made, fresh);
        const added = fresh.querySelector(`:scope > .inside > [data-pointer="${CSS.escape(join(at, list.length))}"]`);
        added?.setAttribute("open", "");
      } }, `Add ${singular(name)}`),
      h("p", { class: "about" }, hint(description.about)),
    ]);
    return made;
  }

  item(name, at, index, description, details) {
    const pointer = join(at, index);
    const value = get(this.form.request, pointer);
    return this.fold({ class: "item", "data-heading": singular(name) }, `${singular(name)} ${nameOf(value, index)}`, pointer, () => {
      const remove = () => {
        this.form.put(pointer, undefined);
        if (details) this.redraw(details(), this.list(name, at, description));
        else this.form.refresh();
      };
      return [...this.inside(description.items, pointer), h("button", { type: "button", click: remove }, `Remove ${singular(name)}`)];
    });
  }

  // a number, or a table over the turn
  variants(name, at, description) {
    const value = get(this.form.request, at);
    const tabled = value !== null && typeof value === "object";
    const switched = (table) => {
      this.form.put(at, table ? this.form.schema.filled(description.object) : undefined);
      this.redraw(made, this.variants(name, at, description));
    };
    const made = this.fold({ class: "group" }, description.title, at, () => {
      const change = (given) => this.form.edit(at, given);
      const number = { ...description, kind: "number", text: true };
      const inside = tabled ? this.inside(description.object, at) : [field(name, at, number, value, false, change)];
      const other = tabled ? "Give one constant instead" : "Give a table over a revolution instead";
      return [...inside, h("button", { type: "button", click: () => switched(!tabled) }, other)];
    });
    return made;
  }
}
