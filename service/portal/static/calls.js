// The call behind what is seen, as curl and as Python.

import { address } from "./api.js";
import { h } from "./dom.js";
import { key } from "./key.js";

const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;

export function curl({ method, path, body }) {
  const lines = [`curl -sS ${method === "POST" ? "" : `-X ${method} `}${quoted(address(path))}`];
  if (key()) lines.push('-H "Authorization: Bearer $COUNTERWEIGHT_KEY"');
  if (body === undefined) return lines.join(" \\\n  ");
  lines.push("-H 'Content-Type: application/json'", "--data-binary @- <<'END'");
  return `${lines.join(" \\\n  ")}\n${JSON.stringify(body, null, 2)}\nEND`;
}

function literal(value, indent = "") {
  const inner = `${indent}    `;
  if (value === null) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  // what JSON writes for numbers and strings is Python too
  if (typeof value !== "object") return JSON.stringify(value);
  const items = Array.isArray(value)
    ? value.map((item) => literal(item, inner))
    : Object.entries(value).map(([name, item]) => `${JSON.stringify(name)}: ${literal(item, inner)}`);
  const [open, close] = Array.isArray(value) ? "[]" : "{}";
  const short = `${open}${items.join(", ")}${close}`;
  if (short.length + indent.length < 100 && !short.includes("\n")) return short;
  return `${open}\n${items.map((item) => `${inner}${item},\n`).join("")}${indent}${close}`;
}

export function python({ method, path, body }) {
  const headers = { ...(body === undefined ? {} : { "Content-Type": "application/json" }) };
  const lines = ["import json", ...(key() ? ["import os"] : []), "import urllib.request", ""];
  if (body !== undefined) lines.push(`body = ${literal(body)}`);
  lines.push("call = urllib.request.Request(", `    ${JSON.stringify(address(path))},`);
  if (body !== undefined) lines.push("    json.dumps(body).encode(),");
  const own = Object.entries(headers).map(([name, value]) => `"${name}": "${value}"`);
  if (key()) own.push('"Authorization": "Bearer " + os.environ["COUNTERWEIGHT_KEY"]');
  lines.push(`    headers={${own.join(", ")}},`, `    method="${method}",`, ")");
  lines.push("with urllib.request.urlopen(call) as reply:", "    answer = json.load(reply)");
  return `${lines.join("\n")}\n`;
}

export function showCall(call) {
  const code = (id, title, text) => {
    const area = h("textarea", { id, rows: 12, readonly: true, spellcheck: "false", value: text });
    const done = h("span", { role: "status" });
    const copy = async () => {
      area.select();
      // without a secure context there is no clipboard; the text is selected then
      const copied = await navigator.clipboard?.writeText(text).then(() => true, () => false);
      done.textContent = copied ? "Copied." : "Selected: copy it with the keyboard.";
    };
    return h("section", {}, h("h3", {}, h("label", { for: id }, title)), area,
      h("div", { class: "buttons" }, h("button", { type: "button", click: copy }, `Copy as ${title}`), done));
  };
  const box = h("dialog", { class: "call", "aria-labelledby": "call-title", close: () => box.remove() },
    h("h2", { id: "call-title" }, `${call.method} /${call.path.replace(/^\//, "")}`),
    code("call-curl", "curl", curl(call)), code("call-python", "Python", python(call)),
    h("form", { method: "dialog" }, h("button", {}, "Close")));
  document.body.append(box);
  box.showModal();
}
