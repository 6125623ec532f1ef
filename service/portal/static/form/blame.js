// What is wrong with a request, said at its fields.

import { complaint } from "../naming.js";
import { get, split } from "../pointer.js";
import { nearest } from "../words.js";

export class Blame {
  constructor(form) {
    this.form = form;
  }

  clear(pointer) {
    const places = pointer === undefined ? this.form.container.querySelectorAll(".wrong")
      : this.form.container.querySelectorAll(`.wrong[data-pointer="${CSS.escape(pointer)}"]`);
    for (const place of places) {
      place.classList.remove("wrong");
      place.querySelector(":scope > .error").textContent = "";
      place.querySelector("input, select, textarea")?.removeAttribute("aria-invalid");
    }
  }

  // Messages at their fields, or at the nearest thing around them; returns what has no place in the form.
  say(errors) {
    this.clear();
    const homeless = [];
    let first = null;
    for (const { pointer, message: said } of errors) {
      const message = this.meant(pointer, said);
      const place = this.form.opened(pointer);
      if (!place) {
        homeless.push({ pointer, message });
        continue;
      }
      const exact = place.dataset.pointer === pointer;
      const error = place.querySelector(":scope > .error");
      const text = exact ? message : complaint(get(this.form.request, place.dataset.pointer), { pointer: pointer.slice(place.dataset.pointer.length), message });
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
    const near = nearest(parts.at(-1), this.form.schema.namesAt(this.form.root, this.form.request, parts.slice(0, -1)));
    return near ? `${message}; did you mean ${near}?` : message;
  }
}
