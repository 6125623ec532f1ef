// The pins that keep a scroll from turning: their loads over the turn, by their stiffness and clearance, as they are or typed.

import { Problem } from "../api.js";
import { h, table } from "../dom.js";
import { PinPicture } from "../drawing/pins.js";
import { degrees, figure, number } from "../format.js";
import { complaint } from "../naming.js";
import { line, overTurn, places, plot, series } from "../plots.js";
import { quantity, read } from "../quantity.js";
import { scene } from "./dynamics.js";
import { turner } from "./turner.js";

const STEP = { step_deg: 2 };
/** @type {{ name: string, title: string, unit: string, size: number, none: string }[]} what each pin has of its own, in the unit that is typed */
const DATA = [
  { name: "stiffness_N_per_m", title: "stiffness, N/µm", unit: "N/µm", size: 1e6, none: "equal" },
  { name: "clearance_m", title: "clearance, µm", unit: "µm", size: 1e-6, none: "0" },
  { name: "eccentricity_error_m", title: "error of eccentricity, µm", unit: "µm", size: 1e-6, none: "0" },
];

export const pins = {
  id: "pin-loads", output: "pin_loads", title: "Pin loads", kind: "scroll", needs: ["pins"],
  about: "Positive along the eccentric: the pin's small crank in compression. Type stiffness and clearance of the pins to see how they share the load.",
  async draw(body, context) {
    const { request, ask } = context;
    const found = (await ask("v1/analyze", scene(context, ["pin_loads"]))).pin_loads;
    const [node] = places(body, 1);
    const typed = found.pins.map(() => ({}));
    const result = h("div", { "aria-live": "polite" });
    const wrong = h("p", { class: "error", role: "alert" });
    const moving = h("div", { class: "animated" });
    const show = (loads) => {
      moving.replaceChildren(...animated(request.machine, loads));
      result.replaceChildren(...results(loads));
      return plot(node, () => ({
        traces: loads.pins.map((pin, index) => line(loads.angle_deg, pin.load_N, `pin ${pin.index}`, series(index))),
        layout: { height: 360, ...overTurn("load of the pin, N", loads.angle_deg) },
        label: `Pin loads over a revolution; the largest is ${figure(loads.peak_N)} N.`,
      }));
    };
    const again = async () => {
      wrong.textContent = "";
      const alike = typed.every((one) => Object.values(one).every((value) => value === undefined));
      try {
        await show(alike ? found : await ask("v1/scroll/pin-loads", asked(request.machine, found, typed)));
      } catch (error) {
        if (!(error instanceof Problem)) throw error;
        wrong.textContent = [error.message, ...error.errors.map((one) => `${complaint({ pins: found.pins.map(({ index }) => ({ name: String(index) })) }, one)}.`)].join(" ");
      }
    };
    body.replaceChildren(h("div", { class: "pair" }, node, moving), own(found, typed, again), wrong, result);
    await show(found);
  },
};

// the same pins with what was typed of each
function asked({ anti_rotation: guide, orbit_radius_m: orbit, rotation_torque_Nm: torque, tangential_gas_force_N: force, drive_bearing: bearing }, { pins: all }, typed) {
  return {
    pins: all.map((pin, index) => ({ angle_deg: pin.phase_deg, radius_m: guide.pin_circle_radius_m, ...typed[index] })), angles: STEP,
    ...(torque !== undefined && torque !== null ? { rotation_torque_Nm: torque } : { tangential_gas_force_N: force, orbit_radius_m: orbit }),
    ...(bearing ? { drive_bearing: bearing } : {}),
  };
}

function own({ pins: all }, typed, changed) {
  const cell = (index, { name, title, size, none }) => h("td", { class: "cell is-number", "data-head": title }, h("input", {
    type: "text", autocomplete: "off", placeholder: none, "aria-label": `${title}, pin ${all[index].index}`, change: ({ target }) => {
      const value = quantity(read(target.value, ""), "");
      const empty = target.value.trim() === "";
      target.setAttribute("aria-invalid", String(!empty && !Number.isFinite(value)));
      typed[index][name] = empty ? undefined : Number.isFinite(value) ? value * size : target.value;
      changed();
    } }));
  return h("div", { class: "grid" }, h("div", { class: "wide" }, h("table", {}, h("caption", {}, "Pins; dead points are where the small crank lies along its radius"),
    h("thead", {}, h("tr", {}, ["pin", "at, °", "dead points, °", ...DATA.map(({ title }) => title)].map((head) => h("th", { scope: "col" }, head)))),
    h("tbody", {}, all.map((pin, index) => h("tr", {}, h("th", { scope: "row" }, String(pin.index)), h("td", { class: "number", "data-head": "at, °" }, figure(pin.phase_deg)),
      h("td", { class: "number", "data-head": "dead points, °" }, [pin.phase_deg, pin.phase_deg + 180].map((angle) => figure(angle % 360)).join(", ")),
      DATA.map((data) => cell(index, data))))))));
}

function results(found) {
  return [
    ...found.warnings.map((warning) => h("p", { class: "error" }, warning.message)),
    table("Loads", ["pin", "peak load, N", "at shaft angle, °"], found.pins.map((pin) => [String(pin.index), number(pin.peak_N), degrees(pin.peak_angle_deg)])),
    h("p", {}, found.equilibrium.holds ? "The pins hold the scroll at every angle: their moment is that of the torque."
      : `The pins do not hold the scroll at every angle: ${found.equilibrium.reason ?? "see the dead points"}.`),
    isProven(found) ? h("p", {}, "Peaks are proven for every angle, not at the samples alone.") : "",
    found.half_turn_mechanism_peak_N === null || found.half_turn_mechanism_peak_N === undefined ? ""
      : h("p", {}, `A mechanism whose members bear for half a revolution only would carry ${figure(found.half_turn_mechanism_peak_N)} N.`),
  ];
}

// Beside dead points nothing bounds the loads; a warning says where brackets stayed wide.
function isProven(found) {
  return Boolean(found.peak_bracket_N) && found.warnings.every((warning) => warning.code !== "peaks_not_certified");
}

function animated(machine, found) {
  const picture = new PinPicture(machine, found);
  const seen = () => picture.element.isConnected && picture.element.checkVisibility();
  return [picture.element, turner("pin-angle", found.angle_deg, (step) => picture.at(step), seen)];
}
