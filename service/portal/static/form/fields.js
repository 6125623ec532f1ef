// Inputs for single values: numbers with their unit, choices, texts, lists of numbers.

import { h } from "../dom.js";
import { hint, label, written } from "../format.js";
import { doubt as doubted, read } from "../quantity.js";

let last = 0;
const freshId = () => `field-${(last += 1)}`;

// Label, input, unit, hint and a place for the error. `change` gets the new value, undefined where there is none.
export function field(name, pointer, description, value, required, change) {
  const id = freshId();
  const question = h("p", { class: "question", role: "status" });
  const input = make(description, value, required, (given) => {
    change(given);
    doubt(given);
  });
  // metres that are hardly metres, a comma that may group
  const doubt = (given) => {
    const found = description.kind === "number" ? doubted(given, description.unit, name, input.value) : null;
    const yes = () => {
      input.value = found?.other;
      input.dispatchEvent(new Event("input"));
      input.focus();
    };
    question.replaceChildren(...(found ? [`${found.words} `, h("button", { type: "button", class: "small", click: yes }, `${found.other} meant`)] : []));
    if (Array.isArray(given) && given.length > 1 && input.value.includes(",")) question.replaceChildren(`Read as ${given.length} values: ${given.join("; ")}`);
  };
  const text = description.text ? ` A number${description.unit ? ` in ${description.unit}` : ""}, or with its unit.` : "";
  input.id = id;
  input.setAttribute("aria-describedby", `${id}-hint ${id}-error`);
  if (required && !description.nullable) input.setAttribute("aria-required", "true");
  return h("div", { class: `field is-${description.kind}`, dataset: { pointer } },
    h("label", { for: id }, description.title ?? label(name), description.unit && h("span", { class: "unit" }, ` ${description.unit}`)),
    input, question,
    h("p", { class: "hint", id: `${id}-hint` }, `${hint(description.about)}.${text}`),
    h("p", { class: "error", id: `${id}-error` }));
}

function make(description, value, required, change) {
  const { kind } = description;
  if (kind === "choice") return choice(description, value, required, change);
  if (kind === "boolean") return boolean(description, value, change);
  if (kind === "numbers") return numbers(description, value, change);
  const long = kind === "text" && description.longest > 200;
  const mandatory = required && !description.nullable;
  const placeholder = mandatory ? undefined : written(description.fallback) || meaning(description);
  const given = () => (kind === "text" ? input.value : read(input.value, description.unit));
  const input = h(long ? "textarea" : "input", {
    value: written(value), placeholder, autocomplete: "off", spellcheck: "false",
    ...(long ? { rows: 3 } : { type: "text" }),
    // a letter may follow a number here: its unit
    ...(kind === "number" && !description.text ? { inputmode: "decimal" } : {}),
    // what must be given may be given as nothing
    input: () => change(input.value.trim() ? given() : required && description.nullable ? null : undefined),
  });
  return input;
}

// What an empty field stands for; a field that it names has its label.
const meaning = ({ about }) => (/null is ([^;,.]+)/.exec(about)?.[1] ?? "none").replace(/\b\w+_\w+\b/g, label);

// nothing is chosen for the reader
function choice(description, value, _required, change) {
  const { options, fallback, nullable } = description;
  const open = !nullable && (value ?? fallback ?? null) === null;
  const select = h("select", { change: () => change(select.value || undefined) },
    nullable || open ? h("option", { value: "" }, open ? "choose" : meaning(description)) : null,
    options.map((option) => h("option", { value: option }, label(String(option)))));
  select.value = written(value ?? fallback ?? "");
  return select;
}

function boolean({ fallback }, value, change) {
  const box = h("input", { type: "checkbox", change: () => change(box.checked) });
  box.checked = value ?? fallback ?? false;
  return box;
}

// between semicolons, tabs and commas with a space a comma is decimal
const parts = (text) => (/[;\t]/.test(text) ? text.split(/[;\t]/) : /,\s/.test(text) ? text.split(/,\s+/) : text.split(/[\s,]+/)).map((part) => part.trim()).filter(Boolean);

function numbers(description, value, change) {
  const line = (values) => values.map(written).join(", ");
  const input = h("input", {
    type: "text", value: Array.isArray(value) ? line(value) : written(value), placeholder: line(description.fallback ?? []) || meaning(description), autocomplete: "off",
    input: () => change(input.value.trim() ? parts(input.value.trim()).map((part) => read(part)) : undefined),
  });
  return input;
}
