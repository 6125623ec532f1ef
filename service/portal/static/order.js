// The counterweights as a workshop makes them: where each sits, how heavy, how large, and at which angle to its own crank.

import { table } from "./dom.js";
import { degrees, figure, number } from "./format.js";

const millimetres = (metres) => number(metres === null || metres === undefined ? null : 1000 * metres);

function shaped({ shape, mass_kg: mass, fixed }) {
  if (!(mass > 0)) return "–";
  if (!shape) return fixed ? "fixed, as it is" : "not given";
  const half = `${figure(shape.half_angle_deg, 4)}° to either side, to R ${figure(1000 * shape.outer_radius_m, 4)}`;
  return shape.chord_height_m === null ? `sector, ${half}` : `segment, chord at ${figure(1000 * shape.chord_height_m, 4)}, ${half}`;
}

export function order(counterweights, shaft = null, title = "Counterweights to fit") {
  return table(`${title}${shaft ? ` to balance shaft ${shaft}` : ""}`,
    ["web", "mass, kg", "plane, mm", "radius, mm", "from own crank, °", "as drawn, °", "shape, mm"],
    counterweights.map((one) => (one.mass_kg > 0
      ? [one.web, number(one.mass_kg), millimetres(one.position_m), millimetres(one.radius_m), degrees(one.angle_from_crank_deg), degrees(one.angle_deg), shaped(one)]
      : [one.web, { number: true, text: "none" }, millimetres(one.position_m), number(null), number(null), number(null), shaped(one)])));
}
