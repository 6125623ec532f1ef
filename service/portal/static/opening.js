// Where a machine comes from: the link, this tab, an example, a text, a file, what was left unfinished.

import { get } from "./api.js";
import { byId, h } from "./dom.js";
import { Sheet } from "./grid/sheet.js";
import { readLink } from "./link.js";
import { forget, last, ofTab } from "./session.js";
import { blank } from "./starter.js";
import { requestIn, told } from "./workbook.js";

export class Opening {
  #asked = 0;

  /** @param {any} page {take, complain, open, fresh, work, form} */
  constructor(page) {
    this.page = page;
  }

  // whether nothing was asked for since: what comes late is neither shown nor written into another place
  #last() {
    const number = (this.#asked += 1);
    return () => number === this.#asked;
  }

  async example(name, kept, how, wanted = this.#last()) {
    try {
      const request = await get(`v1/examples/${encodeURIComponent(name)}`);
      if (wanted()) await this.page.take(request, name, kept, how);
    } catch (error) {
      if (wanted()) await this.page.complain(error);
    }
  }

  // a machine alone is as good as a whole request
  text(text) {
    const said = byId("json-error");
    said.textContent = "";
    try {
      const given = JSON.parse(text);
      if (given === null || typeof given !== "object" || Array.isArray(given)) throw new SyntaxError("this is no object");
      this.page.take("machine" in given ? given : { machine: given }, null);
      byId("paste").open = false;
    } catch (error) {
      said.textContent = `This is not a machine in JSON: ${error.message}.`;
    }
  }

  // a workbook, tables, or a text
  async file(file) {
    const wanted = this.#last();
    if (/\.(csv|tsv|txt)$/i.test(file.name)) {
      const text = await file.text();
      if (wanted()) await this.sheet(text);
      return;
    }
    if (!/\.xlsx$/i.test(file.name)) {
      const text = await file.text();
      if (wanted()) this.text(byId("json").value = text);
      return;
    }
    const said = byId("json-error");
    said.textContent = "";
    const request = await requestIn(file).catch((error) => { said.textContent = told(error); });
    if (!request || !wanted()) return;
    this.page.take(request, null);
    byId("paste").open = false;
  }

  async link(fragment) {
    const { take, open, fresh } = this.page;
    const wanted = this.#last();
    /** @type {any} */
    const link = await readLink(fragment).catch(() => ({ broken: true }));
    // the reader went on meanwhile
    if (!wanted()) return;
    const how = { push: false };
    if (link.open) open(link.open);
    // what was typed after the link was last written
    const typed = fresh() ? ofTab() : null;
    if (typed) await take(typed.request, typed.example, link.kept, how);
    else if (link.request && typeof link.request === "object") await take(link.request, null, link.kept, how);
    else {
      if (fresh()) this.offer(last());
      // nobody begins with a machine that he has not chosen
      if (link.example) await this.example(link.example, link.kept, how, wanted);
      else await this.blank(how);
      if (link.broken) byId("trouble").textContent = "The machine in this link cannot be read.";
    }
  }

  blank(how = {}) {
    return this.page.take(blank(), "", {}, how);
  }

  // Tables from a spreadsheet. Throws are a machine of their own, unless there is none yet; all else goes into what is there.
  async sheet(text) {
    const { work, form } = this.page;
    if (!work.request || work.request.machine?.kind === "scroll") await this.blank();
    if (work.request.machine?.throws?.length && new Sheet(form(), text).has("throw")) await this.blank();
    byId("progress").textContent = `${new Sheet(form(), text).fill()} Press Optimise.`;
  }

  // what is pasted where nobody types: a machine as text, or tables; in a field, tables alone
  pasted(event) {
    const text = event.clipboardData?.getData("text/plain") ?? "";
    if (event.defaultPrevented || event.target.closest("textarea, #results input")) return;
    const typing = event.target.matches("input[type=text]");
    const machine = !typing && text.trimStart().startsWith("{");
    if (!machine && !Sheet.like(text)) return;
    event.preventDefault();
    document.querySelector("dialog.starter")?.remove();
    if (machine) this.text(text); else this.sheet(text);
  }

  // what was left unfinished in another tab, or before the browser was closed
  offer(found) {
    const place = byId("recover");
    place.hidden = !found;
    if (!found) return;
    const done = (work) => () => {
      place.hidden = true;
      work();
    };
    place.replaceChildren(`Last edited ${new Date(found.at).toLocaleString()}: ${found.request?.machine?.name ?? "a machine without a name"}. `,
      h("button", { type: "button", class: "small", click: done(() => this.page.take(found.request, null)) }, "Go on with it"), " ",
      h("button", { type: "button", class: "small", click: done(forget) }, "Forget it"));
  }
}
