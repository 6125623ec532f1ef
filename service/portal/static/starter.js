// A machine of one's own from a few questions, or a blank one. Nothing in it comes from an example.

import { h, s } from "./dom.js";
import { Answers } from "./start/answers.js";
import { ARRANGEMENTS, SCROLL } from "./start/arrangements.js";
import { reciprocating } from "./start/reciprocating.js";
import { scroll } from "./start/scroll.js";

function picture(axes) {
  const end = (angle, length) => [24 + length * Math.cos((angle * Math.PI) / 180), 24 - length * Math.sin((angle * Math.PI) / 180)];
  return s("svg", { viewBox: "0 0 48 48", class: "arrangement", "aria-hidden": "true" },
    axes.map((angle) => {
      const [[x1, y1], [x2, y2]] = [end(angle, 5), end(angle, 20)];
      return s("line", { x1, y1, x2, y2 });
    }), s("circle", { cx: 24, cy: 24, r: 5 }), axes.length ? null : s("circle", { cx: 28, cy: 24, r: 15, class: "orbiting" }));
}

// [name, title, unit, what an empty answer stands for]
const ROWS = [
  ["throws", "Throws"], ["angle", "Angle of the V", "deg", "90"], ["split", "Split of the pins, second row later", "deg", "none"], ["offset", "Distance of the rods on a pin", "m", "0"],
  ["cranks", "Crank angles", "deg", ""], ["pitch", "Distance of the throws", "m"], ["stroke", "Stroke", "m"], ["speed", "Speed", "rpm"],
  ["reciprocating", "Reciprocating mass of a row", "kg", null, "one value, or one for each: 31; 30; 30; 31"], ["rotating", "Rotating mass of a throw", "kg", null, "one value, or one for each"],
  ["rod", "Length of the rods", "m", "not known"],
];
const ORBIT = [["scrollSpeed", "Speed", "rpm"], ["orbit", "Orbit radius", "m"], ["orbiting", "Orbiting mass", "kg"], ["plane", "Plane of the orbiting scroll", "m"]];
const DEVICES = {
  crank_pins: [["pins", "Number of pins"], ["circle", "Radius of the pin circle", "m"], ["eccentric", "Eccentric mass of a pin", "kg", "0"], ["torque", "Torque that turns the scroll", "N m", "none"]],
  oldham: [["ring", "Mass of the ring", "kg"], ["axis", "Direction in which it slides", "deg"]],
};
const BALANCE = [["planes", "Planes of the counterweights", "m", "none yet", "one or more: -110 mm; 50 mm"], ["scrollRadius", "Their radius", "m"], ["scrollMost", "Largest mass of one", "kg", "no limit"]];
const RULES = [["two", "two to a throw, beside it"], ["ends", "two, outside the outermost throws"], ["none", "none yet"]];
const LIMITS = [["radius", "Radius of the counterweights", "m"], ["most", "Largest mass of one", "kg", "no limit"]];
const ENVELOPE = [["inner", "Hub radius", "m"], ["outer", "Radius that is free", "m"], ["thickness", "Thickness", "m"]];
const SHAFTS = [["", "none"], ["counter", "one, against the crankshaft at its speed"], ["double", "two, at twice its speed (Lanchester)"]];
const ON_SHAFTS = [["shaftRadius", "Radius on the balance shafts", "m"], ["shaftMost", "Largest mass there", "kg", "no limit"]];

export const blank = () => ({ machine: { kind: "reciprocating", throws: [], webs: [] } });

// The questions, those that the choices leave open in view.
class Questions {
  /** @type {{ [name: string]: any }} inputs and selects by name */
  given = {};

  constructor() {
    const fields = (questions, more) => h("div", { class: "fields", ...more }, questions.map((one) => this.ask(one)));
    this.shapes = h("fieldset", { class: "arrangements" }, h("legend", {}, "Arrangement"),
      Object.entries({ ...ARRANGEMENTS, [SCROLL]: { title: "scroll", drawn: [] } }).map(([name, { title, drawn }], index) => h("label", {},
        h("input", { type: "radio", name: "arrangement", value: name, checked: index === 0, change: () => this.show() }), picture(drawn), title)));
    this.plates = h("input", { type: "checkbox", id: "start-plates", change: () => this.show() });
    this.bearings = h("input", { type: "checkbox", id: "start-bearings" });
    this.mass = fields(LIMITS);
    this.plate = fields(ENVELOPE);
    this.limits = h("div", {}, h("p", {}, this.plates, h("label", { for: "start-plates" }, " cut from plates within an envelope")), this.mass, this.plate);
    this.shafts = h("div", {}, this.choice("shafts", "Balance shafts", SHAFTS));
    this.onShafts = fields(ON_SHAFTS);
    this.reciprocating = h("div", {}, fields(ROWS), this.choice("rule", "Webs for counterweights", RULES), this.limits,
      h("p", {}, this.bearings, h("label", { for: "start-bearings" }, " main bearings between the throws and at both ends")), this.shafts, this.onShafts);
    this.device = this.choice("device", "What keeps it from turning", [["", "choose"], ["crank_pins", "crank pins"], ["oldham", "Oldham ring"]]);
    this.devices = Object.entries(DEVICES).map(([name, questions]) => fields(questions, { dataset: { device: name } }));
    this.scroll = h("div", {}, fields(ORBIT), this.device, this.devices, fields([["devicePlane", "Plane of that device", "m", "of the scroll"]]), fields(BALANCE));
    this.element = h("div", {}, this.shapes, this.reciprocating, this.scroll);
    this.given.throws.addEventListener("input", () => this.usual());
    this.show();
  }

  ask([name, title, unit, empty, hint]) {
    const input = h("input", { type: "text", id: `start-${name}`, autocomplete: "off", placeholder: empty || null, title: hint ?? null, "aria-required": empty === undefined || empty === null ? "true" : null });
    this.given[name] = input;
    return h("div", { class: "field" }, h("label", { for: input.id }, title, unit ? h("span", { class: "unit" }, ` ${unit}`) : null), input);
  }

  choice(name, title, options) {
    const select = h("select", { id: `start-${name}`, change: () => this.show() }, options.map(([value, words]) => h("option", { value }, words)));
    this.given[name] = select;
    return h("div", { class: "field" }, h("label", { for: select.id }, title), select);
  }

  get arrangement() {
    return this.shapes.querySelector("input:checked").value;
  }

  show() {
    const { arrangement, given } = this;
    const asks = ARRANGEMENTS[arrangement]?.asks ?? [];
    this.reciprocating.hidden = arrangement === SCROLL;
    this.scroll.hidden = arrangement !== SCROLL;
    for (const name of ["angle", "split", "offset"]) given[name].parentElement.hidden = !asks.includes(name);
    this.limits.hidden = given.rule.value === "none";
    this.mass.hidden = this.plates.checked;
    this.plate.hidden = !this.plates.checked;
    this.shafts.hidden = !asks.includes("shafts");
    this.onShafts.hidden = this.shafts.hidden || !given.shafts.value;
    for (const box of this.devices) box.hidden = box.dataset.device !== given.device.value;
    this.usual();
  }

  // the usual cranks stand for an empty answer
  usual() {
    const angles = ARRANGEMENTS[this.arrangement]?.cranks(Number(this.given.throws.value) || 1) ?? [];
    this.given.cranks.placeholder = angles.map((angle) => Math.round(angle % 360)).join(" ");
  }

  // the request, and what it cannot be made from
  made() {
    const typed = Object.fromEntries(Object.entries(this.given).map(([name, input]) => [name, input.closest("[hidden]") ? "" : input.value]));
    const answers = new Answers(typed);
    const request = this.arrangement === SCROLL ? scroll(answers, typed.device)
      : reciprocating(ARRANGEMENTS[this.arrangement], answers, { rule: typed.rule, plates: this.plates.checked, bearings: this.bearings.checked, shafts: typed.shafts });
    // in the order of the questions
    return { request, wrong: [...this.element.querySelectorAll("[id^=start-]")].map(({ id }) => id.slice("start-".length)).filter((name) => answers.wrong.has(name)), doubts: [...answers.doubts].filter(([name]) => !answers.wrong.has(name)) };
  }
}

// Opens the questions; `begin` gets the request, and "" with the empty one.
export function starter(begin) {
  const questions = new Questions();
  const error = h("p", { class: "error", role: "alert" });
  const titled = (name) => box.querySelector(`label[for=start-${name}]`).textContent;
  const submit = (event) => {
    if (event.submitter?.value === "blank") return begin(blank(), "");
    const { request, wrong, doubts } = questions.made();
    if (!wrong.length && !doubts.length) return begin(request);
    event.preventDefault();
    error.textContent = [...(wrong.length ? [`Needed, or not understood: ${wrong.map(titled).join(", ")}.`] : []),
      ...doubts.map(([name, text]) => `${titled(name)}: ${text}.`)].join(" ");
    questions.given[[...wrong, ...doubts.map(([name]) => name)][0]].focus();
    return undefined;
  };
  const box = h("dialog", { class: "starter", "aria-labelledby": "starter-title", close: () => box.remove() },
    h("form", { method: "dialog", novalidate: true, submit }, h("h2", { id: "starter-title" }, "A machine of your own"),
      h("p", { class: "about" }, "From a few questions, or paste its tables here."), questions.element,
      h("div", { class: "buttons" }, error, h("button", { class: "primary", value: "begin" }, "Begin"),
        h("button", { value: "blank" }, "Begin with an empty machine"),
        h("button", { type: "button", click: () => box.close() }, "Cancel"))));
  document.body.append(box);
  box.showModal();
}
