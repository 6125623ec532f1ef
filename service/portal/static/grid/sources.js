// Where the rows of a table are kept in the request: a list, or the rows of all throws together.

import { nameOf } from "../format.js";
import { get, join } from "../pointer.js";
import { another } from "../schema.js";

// a machine that was pasted may hold anything
const listed = (request, pointer) => [get(request, pointer) ?? []].flat();

// with nothing that anybody has not typed: what must be given as nothing is no limit
export function blankOf(schema, { properties, required }) {
  const empty = Object.keys(properties).filter((name) => required.has(name) && schema.describe(properties[name]).nullable);
  return { ..."name" in properties ? { name: "1" } : {}, ...Object.fromEntries(empty.filter((name) => name.startsWith("max_")).map((name) => [name, null])) };
}

export class ListSource {
  constructor(form, pointer, description) {
    this.form = form;
    this.pointer = pointer;
    this.items = description.items;
    this.most = description.most;
  }

  entries() {
    return listed(this.form.request, this.pointer).map((item, index) => ({ pointer: join(this.pointer, index), list: this.pointer, index, item }));
  }

  blank() {
    return blankOf(this.form.schema, this.items);
  }

  // like `from`, or like the last one; the first one is blank
  add(from = null, after = null) {
    const list = listed(this.form.request, this.pointer);
    const fresh = list.length ? this.next(list, from) : this.blank();
    list.splice(after === null ? list.length : after + 1, 0, fresh);
    this.form.put(this.pointer, list);
  }

  next(list, from) {
    const made = another(from === null ? list : [...list.filter((_, index) => index !== from), list[from]]);
    // a shaft goes on as it began
    const [last, before] = [list.at(-1)?.position_m, list.at(-2)?.position_m];
    if (from === null && typeof last === "number" && typeof before === "number") made.position_m = Number((2 * last - before).toPrecision(12));
    return made;
  }

  remove({ list, index }) {
    this.form.put(join(list, index), undefined);
  }

  move({ list, index }, by) {
    const items = listed(this.form.request, list);
    const to = index + by;
    if (to < 0 || to >= items.length) return null;
    [items[index], items[to]] = [items[to], items[index]];
    this.form.put(list, items);
    return to;
  }

  // the mirror image of all, about a plane; what stands on it stays alone
  mirror(about, place) {
    const list = listed(this.form.request, this.pointer);
    const images = list.filter((item) => Math.abs(place(item) - about) > 1e-9).reverse();
    for (const item of images) {
      const made = another([...list, structuredClone(item)]);
      made.position_m = Number((2 * about - place(item)).toPrecision(12));
      list.push(made);
    }
    this.form.put(this.pointer, list);
  }
}

export class RowsSource extends ListSource {
  constructor(form, pointer, description) {
    super(form, pointer, description);
    this.most = description.most * this.lists().length;
  }

  lists() {
    return listed(this.form.request, this.pointer).map((_, index) => `${this.pointer}/${index}/rows`);
  }

  /** @override */
  entries() {
    return this.lists().flatMap((list, owner) => listed(this.form.request, list).map((item, index) => ({ pointer: join(list, index), list, index, item, owner })));
  }

  owners() {
    return listed(this.form.request, this.pointer).map((item, index) => nameOf(item, index));
  }

  /** For the first throw without a row, else for the last one. @override */
  add(from = null) {
    const all = this.entries();
    const like = from === null ? all.at(-1) : all[from];
    const empty = this.lists().findIndex((list) => listed(this.form.request, list).length === 0);
    const owner = from === null && empty >= 0 ? empty : like?.owner ?? this.lists().length - 1;
    if (owner < 0) return;
    const list = this.lists()[owner];
    const items = listed(this.form.request, list);
    this.form.put(list, [...items, like ? another([...items, like.item]) : this.blank()]);
  }

  /** @override */
  move(entry, by) {
    const to = super.move(entry, by);
    return to === null ? null : this.entries().findIndex(({ list, index }) => list === entry.list && index === to);
  }

  // to another throw
  give({ list, index }, owner) {
    const item = get(this.form.request, join(list, index));
    this.form.put(join(list, index), undefined);
    const to = this.lists()[owner];
    this.form.put(to, [...listed(this.form.request, to), item]);
  }
}
