// A machine of one's own from a few questions, or a blank one. Nothing in it comes from an example.

import { h, s } from "./dom.js";
import { meant, quantity, read } from "./quantity.js";

// directions of the rows on one throw, and the usual angles of the cranks
const evenly = (count) => Array.from({ length: count }, (_, index) => (360 * index) / count);
// opposed throws come in pairs
const paired = (count) => Array.from({ length: count }, (_, index) => {
  const pairs = Math.max(1, count / 2);
  return Math.floor(index / 2) * ((pairs % 2 ? 360 : 180) / pairs) + 180 * (index % 2);
});
const single = (count) => (count === 4 ? [0, 90, 270, 180] : evenly(count));
/** @type {{ [name: string]: { title: string, drawn: number[], axes: (throw_: number) => number[], cranks: (count: number) => number[] } }} */
const ARRANGEMENTS = {
  vertical: { title: "in line, vertical", drawn: [90], axes: () => [90], cranks: single },
  horizontal: { title: "in line, horizontal", drawn: [0], axes: () => [0], cranks: single },
  opposed: { title: "opposed, in turn", drawn: [0, 180], axes: (index) => [index % 2 ? 180 : 0], cranks: paired },
  v: { title: "V of 90°", drawn: [45, 135], axes: () => [45, 135], cranks: evenly },
  w: { title: "W of 60°", drawn: [30, 90, 150], axes: () => [30, 90, 150], cranks: evenly },
};

function picture(axes) {
  const end = (angle, length) => [24 + length * Math.cos((angle * Math.PI) / 180), 24 - length * Math.sin((angle * Math.PI) / 180)];
  return s("svg", { viewBox: "0 0 48 48", class: "arrangement", "aria-hidden": "true" },
    axes.map((angle) => {
      const [[x1, y1], [x2, y2]] = [end(angle, 5), end(angle, 20)];
      return s("line", { x1, y1, x2, y2 });
    }), s("circle", { cx: 24, cy: 24, r: 5 }));
}

const QUESTIONS = [
  ["throws", "Throws", "4", ""], ["cranks", "Crank angles", "", "deg"], ["pitch", "Distance of the throws", "", "m"], ["stroke", "Stroke", "", "m"],
  ["speed", "Speed", "", "rpm"], ["reciprocating", "Reciprocating mass of a row", "", "kg"], ["rotating", "Rotating mass of a throw", "", "kg"],
  ["rod", "Length of the rods, if known", "", "m"],
];
const RULES = [["two", "two to a throw, beside it"], ["ends", "two, outside the outermost throws"], ["none", "none yet"]];
const LIMITS = [["radius", "Radius of the counterweights", "m"], ["most", "Largest mass of one", "kg"]];
const ENVELOPE = [["inner", "Hub radius", "m"], ["outer", "Radius that is free", "m"], ["thickness", "Thickness", "m"]];

export const blank = () => ({ machine: { kind: "reciprocating", throws: [], webs: [] } });

// Opens the questions; `begin` gets the request, and "" with the empty one.
export function starter(begin) {
  const given = {};
  const ask = (question) => {
    const [name, title, value, unit] = question;
    const input = h("input", { type: "text", id: `start-${name}`, value: value ?? "", autocomplete: "off", required: name !== "rod" && name !== "cranks" });
    given[name] = input;
    return h("div", { class: "field" }, h("label", { for: input.id }, title, unit ? h("span", { class: "unit" }, ` ${unit}`) : null), input);
  };
  const shapes = h("fieldset", { class: "arrangements" }, h("legend", {}, "Arrangement"),
    Object.entries(ARRANGEMENTS).map(([name, { title, drawn }], index) => h("label", {},
      h("input", { type: "radio", name: "arrangement", value: name, checked: index === 0, change: () => usual() }), picture(drawn), title)));
  const rule = h("select", { id: "start-rule", change: () => limits.hidden = rule.value === "none" }, RULES.map(([name, title]) => h("option", { value: name }, title)));
  const plates = h("input", { type: "checkbox", id: "start-plates", change: () => {
    mass.hidden = plates.checked;
    plate.hidden = !plates.checked;
  } });
  const mass = h("div", { class: "fields" }, LIMITS.map(([name, title, unit]) => ask([name, title, "", unit])));
  const plate = h("div", { class: "fields", hidden: true }, ENVELOPE.map(([name, title, unit]) => ask([name, title, "", unit])));
  const limits = h("div", {}, h("p", {}, plates, h("label", { for: "start-plates" }, " cut from plates within an envelope")), mass, plate);
  const questions = h("div", { class: "fields" }, QUESTIONS.map(ask));
  const chosen = () => ARRANGEMENTS[box.querySelector("input[name=arrangement]:checked").value];
  const usual = () => { given.cranks.placeholder = chosen().cranks(Number(given.throws.value) || 1).map((angle) => Math.round(angle % 360)).join(" "); };
  const error = h("p", { class: "error", role: "alert" });
  const box = h("dialog", { class: "starter", "aria-labelledby": "starter-title", close: () => box.remove() },
    h("form", { method: "dialog", submit: (event) => {
      const answers = Object.fromEntries(Object.entries(given).map(([name, input]) => [name, input.closest("[hidden]") ? "" : input.value]));
      const { request, wrong, doubts } = made(chosen(), answers, rule.value, plates.checked);
      if (event.submitter?.value === "blank") return begin(blank(), "");
      if (!wrong.length && !doubts.length) return begin(request);
      event.preventDefault();
      const titled = (name) => box.querySelector(`label[for=start-${name}]`).textContent;
      error.textContent = [...(wrong.length ? [`Needed, or not understood: ${wrong.map(titled).join(", ")}.`] : []),
        ...doubts.map(({ name, value, other }) => `${titled(name)}: ${value} m? Write ${other} if that is meant.`)].join(" ");
      given[[...wrong, ...doubts.map(({ name }) => name)][0]].focus();
      return undefined;
    } },
    h("h2", { id: "starter-title" }, "A machine of your own"), h("p", { class: "about" }, "From a few questions, or paste its tables here."), shapes, questions,
    h("div", { class: "field" }, h("label", { for: "start-rule" }, "Webs for counterweights"), rule), limits, error,
    h("div", { class: "buttons" }, h("button", { class: "primary", value: "begin" }, "Begin"),
      h("button", { value: "blank", formnovalidate: true }, "Begin with an empty machine"),
      h("button", { type: "button", click: () => box.close() }, "Cancel"))));
  box.firstElementChild.noValidate = true;
  given.throws.addEventListener("input", usual);
  document.body.append(box);
  usual();
  box.showModal();
}

/** The request from the answers, and the questions whose answers it cannot be made from. */
function made({ axes, cranks }, answers, rule, plates) {
  const wrong = [];
  const doubts = [];
  const number = (name, unit, needed = true) => {
    const typed = read(answers[name], unit);
    const value = quantity(typed, unit);
    const other = meant(typed, unit, name === "pitch" ? "position" : name);
    if (other) doubts.push({ name, value, other });
    if (!Number.isFinite(value) && (needed || answers[name].trim())) wrong.push(name);
    return Number(value.toPrecision(12));
  };
  const count = number("throws", "");
  if (!(Number.isInteger(count) && count >= 1 && count <= 60)) wrong.push("throws");
  const angles = answers.cranks.trim() ? answers.cranks.trim().split(/[\s;]+/).map((one) => quantity(read(one, "deg"), "deg")) : cranks(count || 1);
  if (angles.length !== count || !angles.every(Number.isFinite)) wrong.push("cranks");
  const [pitch, stroke, speed] = [number("pitch", "m"), number("stroke", "m"), number("speed", "rpm")];
  const [reciprocating, rotating, rod] = [number("reciprocating", "kg"), number("rotating", "kg"), number("rod", "m", false)];
  const rounded = (value) => Number(value.toPrecision(12));
  const place = (index) => rounded((index - (count - 1) / 2) * pitch);
  const room = plates ? { envelope: { shape: "segment", inner_radius_m: number("inner", "m", rule !== "none"), outer_radius_m: number("outer", "m", rule !== "none"), thickness_m: number("thickness", "m", rule !== "none") } }
    : { counterweight_radius_m: number("radius", "m", rule !== "none"), max_mass_kg: number("most", "kg", rule !== "none") };
  const throws = Array.from({ length: Math.max(0, count) || 0 }, (_, index) => ({
    name: String(index + 1), position_m: place(index), crank_radius_m: rounded(stroke / 2), crank_angle_deg: ((angles[index] % 360) + 360) % 360, rotating_mass_kg: rotating,
    rows: axes(index).map((axis_deg) => ({ axis_deg, reciprocating_mass_kg: reciprocating, ...(rod ? { connecting_rod: { length_m: rod } } : {}) })),
  }));
  const beside = (position_m, name) => ({ name, position_m: rounded(position_m), ...room });
  /** @type {{ [rule: string]: () => any[] }} */
  const webs = {
    two: () => throws.flatMap((each) => [beside(each.position_m - pitch / 4, `${each.name}a`), beside(each.position_m + pitch / 4, `${each.name}b`)]),
    ends: () => [beside(place(0) - pitch / 4, "front"), beside(place(count - 1) + pitch / 4, "rear")],
    none: () => [],
  };
  return { wrong: [...new Set(wrong)], doubts, request: { machine: { kind: "reciprocating", speed_rpm: speed, throws, webs: webs[rule]() } } };
}
