// Files for the reader to keep.

import { ask } from "./api.js";
import { h } from "./dom.js";

const KEPT_MS = 10_000;

export function save(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}

// a name that every system takes for a file
export const fileName = (name, ending) => `${String(name ?? "").replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^-+|-+$/g, "").slice(0, 80) || "machine"}.${ending}`;

export const saveJson = (content, name) => save(new Blob([`${JSON.stringify(content, null, 2)}\n`], { type: "application/json" }), name);

// the name that the service gives a file
export function named(answer) {
  const said = answer.headers.get("content-disposition") ?? "";
  const coded = /filename\*=UTF-8''([^;]+)/.exec(said);
  return coded ? decodeURIComponent(coded[1]) : /filename="([^"]*)"/.exec(said)?.[1];
}

const REPORTS = { html: "text/html", pdf: "application/pdf" };

// Buttons for the report on a request, with everything that the machine has data for.
export function reports(request, outputs) {
  const said = h("span", { role: "status" });
  const write = async (event, format) => {
    const button = event.currentTarget;
    button.disabled = true;
    said.textContent = "Writing …";
    try {
      const body = { ...request, outputs };
      const answer = await ask("POST", "v1/report", { body, headers: { Accept: REPORTS[format] } });
      save(await answer.blob(), named(answer) ?? `counterweights.${format}`);
      said.textContent = "";
    } catch (error) {
      said.textContent = error.message;
    } finally {
      button.disabled = false;
    }
  };
  return h("div", { class: "buttons" }, h("span", {}, "Report for the design file:"),
    Object.keys(REPORTS).map((format) => h("button", { type: "button", class: "small", click: (event) => write(event, format) }, format.toUpperCase())), said);
}
