// Loads on the foundation by order: forces and couples along two axes, before, after and as built, and as a file.

import { h, table } from "../dom.js";
import { fileName, save } from "../files.js";
import { figure, number } from "../format.js";
import { scales } from "../scales.js";

const SETS = { before: "before", after: "after", as_built: "as built" };
const LOADS = [
  { name: "force_x", head: "force x", words: "force along x", unit: "N" },
  { name: "force_y", head: "force y", words: "force along y", unit: "N" },
  { name: "couple_of_x_forces", head: "horizontal couple", words: "horizontal couple, of the x forces", unit: "N m" },
  { name: "couple_of_y_forces", head: "vertical couple", words: "vertical couple, of the y forces", unit: "N m" },
];
/** @type {{ [unit: string]: number }} */
const UNITS = { N: 1, kN: 1000 };
// what is below this share of the largest is told in a sentence, as in the report
const SMALL = 1e-3;
const DUST = 1e-9;

const amplitude = (load) => load.amplitude_N ?? load.amplitude_Nm;
const setsOf = (found) => Object.keys(SETS).filter((name) => found.some((one) => one[name]));

// The table as it is filed, in N and N m and in full: a line for each order and load.
export function foundationCsv(found) {
  const sets = setsOf(found);
  const heads = ["order", "load", "unit", ...sets.flatMap((name) => [name, `${name}_phase_deg`])];
  const lines = found.flatMap((one) => LOADS.map(({ name, words, unit }) => [one.order, `"${words}"`, unit,
    ...sets.flatMap((set) => (one[set] ? [amplitude(one[set][name]), one[set][name].phase_deg] : ["", ""]))]));
  return `${[heads, ...lines].map((line) => line.join(",")).join("\r\n")}\r\n`;
}

export const foundation = {
  id: "foundation", output: "foundation_loads", title: "Foundation loads", open: true, needs: ["rods"],
  draw(body, { answer, request, kept, keep }) {
    const found = answer.foundation_loads;
    const place = h("div");
    const unit = h("select", { id: "foundation-unit", change: () => {
      keep("unit", unit.value);
      show();
    } }, Object.keys(UNITS).map((name) => h("option", { value: name, selected: name === kept.unit }, `${name} and ${name} m`)));
    const show = () => place.replaceChildren(shown(found, unit.value, scales(request.machine, answer)));
    const file = () => save(new Blob([foundationCsv(found)], { type: "text/csv" }), fileName(`${request.machine.name ?? "machine"}-foundation-loads`, "csv"));
    body.replaceChildren(
      h("div", { class: "controls" }, h("div", { class: "choose" }, h("label", { for: "foundation-unit" }, "Unit"), unit),
        h("button", { type: "button", class: "small", click: file }, "CSV")),
      place, h("p", { class: "about" }, convention(found[0].dead_centre_deg)));
    show();
  },
};

// what a sign and a phase mean
const convention = (centre) => `A load is A cos(k ψ − phase): k is the order, ψ the revolution since the outer dead centre of throw 1, first row `
  + `(shaft angle ${figure(centre)}°), in the sense of rotation. Forces act on the frame. A couple is the sum of force times distance from the reference plane. `
  + "The horizontal couple is that of the x forces and turns about y; the vertical couple is that of the y forces and turns about x. The words hold where x is level and y upright.";

function shown(found, unit, scale) {
  const sets = setsOf(found);
  const forces = LOADS.filter((load) => load.unit === "N");
  const couples = LOADS.filter((load) => load.unit !== "N");
  const largest = (one, loads) => Math.max(...sets.flatMap((set) => loads.map(({ name }) => (one[set] ? amplitude(one[set][name]) : 0))));
  const most = [forces, couples].map((loads) => Math.max(...found.map((one) => largest(one, loads))));
  const small = (one) => [forces, couples].every((loads, kind) => largest(one, loads) <= SMALL * most[kind]);
  // a residue of rounding beside what the counterweights do is nothing, and has no phase
  const cells = (load) => LOADS.flatMap(({ name, unit: own }) => {
    const given = amplitude(load[name]);
    const size = given > DUST * (own === "N" ? scale.force : scale.moment) ? given : 0;
    return [number(size / UNITS[unit]), number(size ? load[name].phase_deg : null, 4)];
  });
  const heads = ["order", ...LOADS.flatMap((load) => [`${load.head}, ${load.unit.replace("N", unit)}`, "phase, °"])];
  const rows = found.filter((one) => !small(one)).flatMap((one) => sets.filter((set) => one[set]).map((set) => [`${one.order},\u00a0${SETS[set]}`, ...cells(one[set])]));
  const quiet = found.filter((one) => small(one) && largest(one, LOADS) === 0).map((one) => one.order);
  const slight = found.filter((one) => small(one) && largest(one, LOADS) > 0);
  return h("div", { class: "foundation" }, rows.length ? table("Amplitude and phase by order", heads, rows) : null,
    slight.length ? h("p", {}, `Of order ${slight.map((one) => one.order).join(", ")} forces are at most ${figure(Math.max(...slight.map((one) => largest(one, forces))) / UNITS[unit])} ${unit}, `
      + `couples ${figure(Math.max(...slight.map((one) => largest(one, couples))) / UNITS[unit])} ${unit} m; the CSV has them.`) : null,
    quiet.length ? h("p", {}, `Nothing of order ${quiet.join(", ")} loads the foundation.`) : null);
}
