// What is pasted into a table of the form: cells go where their heads say, or where the caret is; what belongs elsewhere is refused.

import { h } from "../dom.js";
import { isTrace, TOO_MANY } from "../gas/trace.js";
import { get } from "../pointer.js";
import { columnsOf, tableAt } from "./columns.js";
import { elsewhere, moved } from "./home.js";
import { knownHeads, placed, withUnit } from "./paste.js";
import { blankOf } from "./sources.js";

export class Pasting {
  /** @param {any} grid */
  constructor(grid) {
    this.grid = grid;
  }

  pasted(event) {
    const text = event.clipboardData?.getData("text/plain") ?? "";
    const cell = event.target.closest("td");
    // one value goes where the caret is; several tables are no table
    if ((!/[\t\n]/.test(text.trim()) && cell) || /\n[\t; \r]*\n\s*\S/.test(text)) return;
    event.preventDefault();
    if (isTrace(text, TOO_MANY)) {
      const there = () => {
        this.grid.form.gas.text = text;
        this.grid.form.refresh();
        this.grid.form.opened("/machine/throws/gas");
      };
      this.grid.said.replaceChildren(h("p", { class: "error" }, "This is a pressure over the angle: nothing was pasted here. ", h("button", { type: "button", class: "small", click: there }, "Paste it into the indicated pressure")));
      return;
    }
    const other = elsewhere(this.grid, text);
    if (other) {
      this.grid.said.replaceChildren(h("p", { class: "error" }, `This is a table of ${other.table.title}: nothing was pasted here. `,
        h("button", { type: "button", class: "small", click: () => moved(other, text) }, `Paste it into the ${other.table.title}`)));
      return;
    }
    const first = this.grid.source.owners ? 2 : 1;
    const start = cell ? [...cell.parentElement.children].indexOf(cell) - first : this.grid.source.owners ? -1 : 0;
    this.fill(text, cell ? [...this.grid.body.children].indexOf(cell.parentElement) : 0, start, {});
  }

  fill(text, row, start, accepted) {
    const columns = this.pasteable();
    const { rows, places, unknown, empty } = placed(text, columns, start + (this.grid.source.owners ? 1 : 0), accepted);
    if (row + rows.length > this.grid.source.most) {
      this.grid.said.replaceChildren(h("p", { class: "error" }, `${rows.length} lines are more than the ${this.grid.source.most} ${this.grid.table.title} that a machine may have: nothing was pasted.`));
      return 0;
    }
    rows.forEach((cells, index) => {
      while (this.grid.source.entries().length <= row + index) this.grid.source.add();
      const before = this.grid.source.entries()[row + index];
      const to = places.findIndex((place) => columns[place?.index]?.kind === "owner");
      if (to >= 0) this.give(before, cells[to]);
      // a row that goes to another throw keeps what it is, not its number
      const { pointer } = this.grid.source.entries().find((one) => one.item === before.item) ?? before;
      cells.forEach((cell, at) => {
        const column = columns[places[at]?.index];
        if (!column || column.kind === "owner") return;
        if (column.row && !get(this.grid.form.request, `${pointer}/rows`)?.length) this.grid.form.put(`${pointer}/rows`, [blankOf(this.grid.form.schema, column.row)]);
        this.grid.put(`${pointer}/${column.path}`, column, withUnit(cell, places[at].unit, column.unit));
      });
    });
    const fresh = this.grid.form.refresh().get(this.grid.source.pointer + this.grid.table.item);
    fresh?.pasting.unknown(unknown, (more) => fresh.pasting.fill(text, row, start, { ...accepted, ...more }));
    if (empty.length) fresh?.said.append(h("p", {}, `Nothing stands under ${empty.map((head) => `“${head}”`).join(", ")}: what was there is kept.`));
    fresh?.mark(row);
    return rows.length;
  }

  // Columns that a paste may fill: an owner, those that are seen, those that are not, and those of the one row that
  // a throw has in most machines.
  pasteable() {
    const { form: { schema }, source } = this.grid;
    const row = source.items.properties.rows ? schema.describe(source.items.properties.rows).items : null;
    const rows = row ? columnsOf(schema, row, tableAt(`${source.pointer}/0/rows`), new Set()).filter(({ path }) => path !== "name") : [];
    const own = [...this.grid.columns, ...this.grid.hidden].map((column) => (column.path === "name" ? { ...column, also: this.grid.table.item } : column));
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
    const owner = this.grid.source.owners().indexOf(name);
    const known = owner >= 0 ? owner : Number(name) - 1;
    if (known >= 0 && known < this.grid.source.owners().length && known !== entry.owner) this.grid.source.give(entry, known);
  }

  unknown(heads, again) {
    this.grid.said.append(...heads.map(({ head, near }) => h("p", {}, `“${head}” is no column here${near ? `: did you mean ${near}? ` : ", and was left out."}`,
      near ? h("button", { type: "button", class: "small", click: () => again({ [head]: near }) }, `Yes, ${near}`) : null)));
  }
}
