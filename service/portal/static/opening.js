// Where a machine comes from: the link, this tab, an example, a text, a file, what was left unfinished.

import { get } from "./api.js";
import { byId, h } from "./dom.js";
import { readLink } from "./link.js";
import { forget, last, ofTab } from "./session.js";

const FIRST = "2d12";

export class Opening {
  /** @param {any} page {take, complain, open, fresh} */
  constructor(page) {
    this.page = page;
  }

  async example(name, kept, how) {
    try {
      await this.page.take(await get(`v1/examples/${encodeURIComponent(name)}`), name, kept, how);
    } catch (error) {
      await this.page.complain(error);
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

  async link(fragment) {
    const { take, open, fresh } = this.page;
    const link = await readLink(fragment).catch(() => null);
    const how = { push: false };
    if (link?.open) open(link.open);
    // what was typed after the link was last written
    const typed = fresh() ? ofTab() : null;
    if (typed) await take(typed.request, typed.example, link?.kept, how);
    else if (link?.request && typeof link.request === "object") await take(link.request, null, link.kept, how);
    else {
      if (fresh()) this.offer(last());
      await this.example(link?.example ?? FIRST, link?.kept, how);
    }
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

/** @param {string | null} chosen */
export async function listExamples(chosen) {
  const { examples } = await get("v1/examples");
  byId("example").replaceChildren(h("option", { value: "" }, "(your own machine)"),
    ...examples.map(({ name, title, description }) => h("option", { value: name, title: description }, title === name ? name : `${name}: ${title}`)));
  byId("example").value = chosen ?? "";
}
