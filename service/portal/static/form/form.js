// The form of a request: what is typed goes into the request, and is told; where more than a value changes it is drawn anew.

import { nameOf } from "../format.js";
import { nothing } from "../gas/part.js";
import { get, parent, put } from "../pointer.js";
import { Blame } from "./blame.js";
import { Parts } from "./parts.js";

const WIDE = "(min-width: 1000px)";
// longer lists are opened by the reader
const FEW = 40;

export class Form {
  // `changed` is called after every edit, with the request and the pointer of a single value
  constructor(container, schema, model, changed) {
    this.container = container;
    this.schema = schema;
    this.root = schema.model(model);
    this.changed = changed;
    this.request = {};
    this.grids = new Map();
    // what was typed into cells, where it may be meant otherwise
    this.texts = new Map();
    // the pressure of all cylinders that is being put together
    this.gas = nothing();
    // optional columns that were asked for
    this.unfolded = new Set();
    this.parts = new Parts(this);
    this.errors = new Blame(this);
  }

  show(request) {
    this.texts.clear();
    this.gas = nothing();
    // on narrow screens the results stand below the form
    const lists = ["/machine/throws", "/machine/webs"].filter((list) => !(get(request, list)?.length > FEW));
    this.draw(request, matchMedia(WIDE).matches ? ["/machine", ...lists] : []);
  }

  // `open` from the outside inwards
  draw(request, open) {
    this.request = request;
    this.grids = new Map();
    this.container.replaceChildren(...this.parts.inside(this.root, ""));
    for (const pointer of open) {
      const group = this.group(pointer);
      if (group) Object.assign(group, { open: true }).build();
    }
  }

  // another state of the same work
  restore(request) {
    this.request = request;
    this.refresh({ told: false });
  }

  // the same request after more than one value has changed: what was open stays open, the caret where it was
  refresh({ told = true } = {}) {
    const open = [...this.container.querySelectorAll("details[open][data-pointer]")].map((one) => one.dataset.pointer);
    const place = document.activeElement?.closest("[data-pointer]")?.getAttribute("data-pointer");
    this.draw(this.request, open);
    const input = place && this.container.querySelector(`.field[data-pointer="${CSS.escape(place)}"] :is(input, select)`);
    input?.focus();
    if (told) this.tell();
    return this.grids;
  }

  // the request with another value; what it was before stays as it is
  put(pointer, value) {
    this.request = put(this.request, pointer, value);
  }

  edit(pointer, value) {
    this.put(pointer, value);
    this.told(pointer);
  }

  told(pointer) {
    this.errors.clear(pointer);
    this.heading(pointer);
    this.tell(pointer);
  }

  tell(pointer = null) {
    this.changed(this.request, pointer);
  }

  // headings follow names
  heading(pointer) {
    if (!pointer.endsWith("/name")) return;
    const item = pointer.slice(0, -"/name".length);
    const details = this.group(item);
    if (!details?.dataset.heading) return;
    details.firstElementChild.textContent = `${details.dataset.heading} ${nameOf(get(this.request, item), Number(item.split("/").at(-1)))}`;
  }

  // the part of the form at a pointer, everything around it opened; what is not there yet is what is around it
  opened(pointer) {
    if (!pointer) return null;
    const around = this.opened(parent(pointer));
    const found = this.container.querySelector(`[data-pointer="${CSS.escape(pointer)}"]`);
    if (!found) return around;
    for (let node = found; node !== this.container; node = node.parentElement) {
      if (node.tagName === "DETAILS") {
        node.open = true;
        node.build?.();
      }
    }
    return found;
  }

  gridsOf(list) {
    return [...new Set(this.grids.values())].filter((grid) => grid.source.pointer === list);
  }

  group(pointer) {
    return this.container.querySelector(`details[data-pointer="${CSS.escape(pointer)}"]`);
  }
}
