// The panels: opened and closed by the reader, drawn when they are open, each from calls of its own.

import { Problem, post } from "../api.js";
import { showCall } from "../calls.js";
import { h } from "../dom.js";
import { painted } from "../later.js";
import { complaint } from "../naming.js";

const everyRow = (machine, ...names) => {
  // asked before the service has looked at the machine, which may hold anything
  const rows = [machine.throws ?? []].flat().flatMap((each) => each?.rows ?? []);
  return rows.length > 0 && rows.every((row) => names.some((name) => [row?.[name] ?? []].flat().length > 0));
};
// what a panel may need of the machine, and how to say that it is missing
const NEEDS = {
  rods: { met: (machine) => machine.kind === "scroll" || everyRow(machine, "connecting_rod"), words: "a connecting rod on every row" },
  cylinders: { met: (machine) => everyRow(machine, "cylinder", "cylinders"), words: "a cylinder on every row" },
  flywheel: { met: (machine) => Boolean(machine.flywheel), words: "the flywheel" },
  balance_shafts: { met: (machine) => (machine.balance_shafts ?? []).length > 0, words: "a balance shaft" },
  bearings: { met: (machine) => (machine.bearings ?? []).length > 1, words: "the main bearings" },
  pins: { met: (machine) => machine.anti_rotation?.type === "crank_pins" && (machine.rotation_torque_Nm ?? machine.tangential_gas_force_N ?? null) !== null,
    words: "crank pins and the torque that turns the scroll" },
};

export const missing = (panel, machine) => (panel.needs ?? []).filter((need) => !NEEDS[need].met(machine)).map((need) => NEEDS[need].words);
export const offered = (panel, machine) => !panel.kind || panel.kind === machine.kind;

// of many panels the service is asked for one at a time
function oneByOne() {
  /** @type {Promise<any>} */
  let last = Promise.resolve();
  return (work) => {
    const mine = last.then(work);
    last = mine.catch(() => null);
    return mine;
  };
}

export class Panels {
  // `toggled` hears of opening and closing, `blamed` of errors at fields
  constructor(container, panels, { toggled, blamed }) {
    this.container = container;
    this.panels = panels;
    this.toggled = toggled;
    this.blamed = blamed;
    this.wanted = new Set(panels.filter((panel) => panel.open).map((panel) => panel.id));
    this.context = null;
    this.parts = new Map();
  }

  open(ids) {
    this.wanted = new Set(ids);
  }

  // Draw what is open; resolves when all of it stands.
  async show(context) {
    this.abort?.abort();
    this.abort = new AbortController();
    this.context = { ...context, signal: this.abort.signal };
    const shown = this.panels.filter((panel) => offered(panel, context.request.machine));
    const ready = shown.filter((panel) => !missing(panel, context.request.machine).length);
    const lacking = shown.filter((panel) => !ready.includes(panel));
    for (const panel of ready) if (!this.parts.has(panel.id)) this.parts.set(panel.id, this.part(panel));
    this.place(ready.map((panel) => this.parts.get(panel.id).details), lacking.length
      ? h("p", { class: "about" }, "Not drawn for this machine: ",
        lacking.map((panel) => `${panel.title.toLowerCase()} (needs ${missing(panel, context.request.machine).join(" and ")})`).join(", "), ".") : "");
    for (const panel of ready) {
      const part = this.parts.get(panel.id);
      part.drawnFor = null;
      part.details.open = this.wanted.has(panel.id);
    }
    const now = this.context;
    await painted();
    const turn = oneByOne();
    if (now === this.context) await Promise.all(ready.filter((panel) => this.wanted.has(panel.id)).map((panel) => this.draw(panel, turn)));
  }

  // what stands there already stays: to put it there again costs a layout of all of it
  place(details, note) {
    const there = this.container.querySelectorAll(":scope > details");
    if (details.length !== there.length || details.some((one, index) => one !== there[index])) this.container.replaceChildren(...details, note);
    else {
      for (const other of [...this.container.childNodes]) if (!details.includes(other)) other.remove();
      this.container.append(note);
    }
  }

  part(panel) {
    const body = h("div", { class: "body" });
    const copy = h("button", { type: "button", class: "small", click: () => showCall(part.call ?? this.context.call) }, "Copy as curl or Python");
    const wait = h("p", { class: "wait", role: "status" });
    const details = h("details", { class: "panel", id: `panel-${panel.id}` }, h("summary", {}, h("h2", {}, panel.title)),
      h("div", { class: "top" }, panel.about ? h("p", { class: "about" }, panel.about) : h("span"), copy), wait, body);
    const part = { details, body, wait, call: null, drawnFor: null };
    details.addEventListener("toggle", () => {
      if (details.open === this.wanted.has(panel.id)) return;
      if (details.open) this.wanted.add(panel.id);
      else this.wanted.delete(panel.id);
      this.toggled();
      if (details.open) this.draw(panel);
    });
    return part;
  }

  // `turn` says when its questions may be asked
  async draw(panel, turn = (work) => work()) {
    const part = this.parts.get(panel.id);
    const { context } = this;
    if (!context || part.drawnFor === context) return;
    part.drawnFor = context;
    delete part.details.dataset.drawn;
    part.call = null;
    const ask = (path, body) => {
      part.call = { method: "POST", path, body };
      part.wait.textContent = "Computing …";
      const asked = () => post(path, body, { signal: context.signal, waiting: (why) => { part.wait.textContent = why; } });
      return turn(asked).finally(() => { if (context === this.context) part.wait.textContent = ""; });
    };
    try {
      await panel.draw(part.body, { ...context, ask, told: (call) => { part.call = call; } });
      if (context === this.context) part.details.dataset.drawn = context.number;
    } catch (error) {
      if (error.name === "AbortError" || context !== this.context) return;
      if (!(error instanceof Problem)) console.error(error);
      part.body.replaceChildren(h("p", { class: "error", role: "alert" }, error.message,
        (error.errors ?? []).map((one) => ` ${complaint(context.request, one)}.`)));
      if (error.errors?.length) this.blamed(error.errors);
    } finally {
      if (context === this.context) part.wait.textContent = "";
    }
  }
}
