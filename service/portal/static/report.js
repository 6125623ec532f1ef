// The report on a request, for the design file: what its head says, the versions that it compares, and the file.

import { ask } from "./api.js";
import { h } from "./dom.js";
import { named, save } from "./files.js";
import { complaint } from "./naming.js";
import { versions } from "./versions.js";

const REPORTS = { html: "text/html", pdf: "application/pdf" };
const PLACE = "counterweight-document";
const HEAD = { company: "Company", customer: "Customer", project: "Project", number: "Number", revision: "Revision", date: "Date", author: "Author", checker: "Checked by",
  approver: "Approved by", drawing: "Drawing", revisions: "Revisions, a line each: B; 2026-11-23; what changed; who", notes: "Notes" };
const LINES = { revisions: 3, notes: 2 };
// what a line of the table of revisions holds
const REVISION = ["revision", "date", "change", "author"];
const LOGO = "logo";

// of this tab: another machine is a step away, and what its report would say stands beside the buttons
const head = remembered();
const compared = new Set();
let open = false;

function remembered() {
  try {
    const found = JSON.parse(sessionStorage.getItem(PLACE) ?? "{}");
    return Object.fromEntries([...Object.keys(HEAD), LOGO].filter((name) => typeof found?.[name] === "string").map((name) => [name, found[name]]));
  } catch {
    return {};
  }
}

// the day where the office is
function today() {
  const now = new Date();
  return [now.getFullYear(), now.getMonth() + 1, now.getDate()].map((part) => String(part).padStart(2, "0")).join("-");
}

const table = (text) => text.split("\n").filter((line) => line.trim()).map((line) => Object.fromEntries(
  line.split(/[;\t]/).map((cell, index) => [REVISION[index], cell.trim()]).filter(([name, cell]) => name && cell)));

// what a report of this request asks for
function asked(request, outputs) {
  const { revisions, ...texts } = Object.fromEntries(Object.entries(head).map(([name, text]) => [name, text.trim()]).filter(([, text]) => text));
  const document = { date: today(), ...texts, ...(revisions ? { revisions: table(revisions) } : {}) };
  const others = versions().filter((one) => compared.has(one.name))
    .map((one) => ({ name: one.name, machine: one.request.machine, ...(one.request.objective ? { objective: one.request.objective } : {}) }));
  // every report draws the hodographs of the first order: of their samples nobody reads
  return { ...request, outputs: outputs.filter((one) => one !== "hodograph"), document, ...(others.length ? { versions: others } : {}) };
}

// Buttons for the report, with everything that the machine has data for.
export function reports(request, outputs) {
  const said = h("span", { role: "status" });
  const write = async (event, format) => {
    const button = event.currentTarget;
    button.disabled = true;
    said.textContent = "Writing …";
    try {
      const answer = await ask("POST", "v1/report", { body: asked(request, outputs), headers: { Accept: REPORTS[format] } });
      save(await answer.blob(), named(answer) ?? `counterweights.${format}`);
      said.textContent = "";
    } catch (error) {
      said.textContent = [error.message, ...(error.errors ?? []).map((one) => `${complaint(request, one)}.`)].join(" ");
    } finally {
      button.disabled = false;
    }
  };
  return h("div", { class: "report" },
    h("div", { class: "buttons" }, h("span", {}, "Report for the design file:"),
      Object.keys(REPORTS).map((format) => h("button", { type: "button", class: "small", click: (event) => write(event, format) }, format.toUpperCase())), said),
    details());
}

function details() {
  const summary = h("summary", {});
  const choice = h("div", {});
  const told = () => {
    const names = [head.project, head.number, head.revision && `revision ${head.revision}`].filter(Boolean);
    summary.textContent = [`Head of the report: ${names.join(", ") || "empty"}`, compared.size ? `compared with ${[...compared].join(", ")}` : ""].filter(Boolean).join("; ");
  };
  const typed = (name) => (event) => {
    head[name] = event.target.value;
    sessionStorage.setItem(PLACE, JSON.stringify(head));
    told();
  };
  const field = ([name, title]) => {
    const given = { id: `document-${name}`, value: head[name] ?? "", input: typed(name), placeholder: name === "date" ? today() : null };
    return h("div", { class: "field" }, h("label", { for: given.id }, title),
      LINES[name] ? h("textarea", { ...given, rows: LINES[name] }) : h("input", { ...given, type: "text", autocomplete: "off", maxlength: 120 }));
  };
  const logo = h("input", { id: "document-logo", type: "file", accept: "image/png", change: () => {
    const [file] = logo.files;
    if (!file) return;
    const reader = new FileReader();
    reader.onload = () => {
      head[LOGO] = String(reader.result);
      sessionStorage.setItem(PLACE, JSON.stringify(head));
      picked.textContent = file.name;
    };
    reader.readAsDataURL(file);
  } });
  const picked = h("span", {}, head[LOGO] ? "a logo" : "");
  // versions come and go in their panel meanwhile
  const list = () => {
    const all = versions();
    for (const name of compared) if (!all.some((one) => one.name === name)) compared.delete(name);
    choice.replaceChildren(all.length ? h("fieldset", {}, h("legend", {}, "Compared with"), all.map(({ name }) => {
      const box = h("input", { type: "checkbox", checked: compared.has(name), change: () => {
        if (box.checked) compared.add(name); else compared.delete(name);
        told();
      } });
      return h("label", {}, box, ` ${name}`);
    })) : h("p", { class: "about" }, "Versions that are kept (below) can be compared with this one."));
    told();
  };
  list();
  return h("details", { class: "document", open, toggle: (event) => {
    open = event.target.open;
    if (open) list();
  } }, summary, h("div", { class: "fields" }, Object.entries(HEAD).map(field)),
  h("p", {}, h("label", { class: "button", for: "document-logo" }, "Logo (PNG)", logo), " ", picked), choice);
}
