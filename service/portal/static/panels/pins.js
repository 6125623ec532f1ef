// The pins that keep a scroll from turning: their loads over the turn, as curves and as a moving picture.

import { h, table } from "../dom.js";
import { PinPicture } from "../drawing/pins.js";
import { figure, number } from "../format.js";
import { line, overTurn, places, plot, series } from "../plots.js";
import { scene } from "./dynamics.js";
import { turner } from "./turner.js";

export const pins = {
  id: "pin-loads", output: "pin_loads", title: "Pin loads", kind: "scroll", needs: ["pins"],
  about: "Positive along the eccentric: the pin's small crank in compression.",
  async draw(body, context) {
    const found = (await context.ask("v1/analyze", scene(context, ["pin_loads"]))).pin_loads;
    const [node] = places(body, 1);
    body.replaceChildren(
      found.warnings.map((warning) => h("p", { class: "error" }, warning.message)).at(0) ?? "",
      h("div", { class: "pair" }, node, animated(context.request.machine, found)),
      table("Pins", ["pin", "at, °", "peak load, N", "at shaft angle, °"],
        found.pins.map((pin) => [String(pin.index), number(pin.phase_deg), number(pin.peak_N), number(pin.peak_angle_deg)])),
      h("p", {}, found.equilibrium.holds
        ? `The pins hold the scroll at every angle; their moment differs from the torque by at most ${figure(found.equilibrium.max_moment_error_Nm, 2)} N m.`
        : `The pins do not hold the scroll at every angle: ${found.equilibrium.reason ?? "see the dead points"}.`),
      h("p", {}, `A mechanism whose members bear for half a revolution only would carry ${figure(found.half_turn_mechanism_peak_N)} N.`));
    await plot(node, () => ({
      traces: found.pins.map((pin, index) => line(found.angle_deg, pin.load_N, `pin ${pin.index}`, series(index))),
      layout: { height: 360, ...overTurn("load of the pin, N", found.angle_deg) },
      label: `Pin loads over a revolution; the largest is ${figure(found.peak_N)} N.`,
    }));
  },
};

function animated(machine, found) {
  const picture = new PinPicture(machine, found);
  const seen = () => picture.element.isConnected && picture.element.checkVisibility();
  return h("div", { class: "animated" }, picture.element, turner("pin-angle", found.angle_deg, (step) => picture.at(step), seen));
}
