// The machine from the front and along its shaft, side by side.

import { h } from "../dom.js";
import { front } from "./front.js";
import { carried } from "./outline.js";
import { side } from "./side.js";
import { degrees, metres } from "./view.js";

export function pair(machine, counterweights, reference) {
  const unknown = carried(counterweights).some((one) => !one.shape);
  return [
    h("figure", {}, front(machine, counterweights), h("figcaption", {},
      `From the front, to scale, shaft angle 0.${unknown ? " A dashed disc stands for a counterweight of unknown shape about its centre of mass." : ""}`)),
    h("figure", {}, side(machine, counterweights, reference),
      h("figcaption", {}, "Along the shaft, with a scale of its own; what stands towards you is drawn down and to the left.")),
  ];
}

const objects = (list) => [list ?? []].flat().filter((one) => one !== null && typeof one === "object");
const placed = (list) => objects(list).filter((one) => Number.isFinite(metres(one.position_m)));

// What can be drawn of a machine while it is typed; null where nothing can.
export function drawable(machine) {
  if (machine?.kind === "scroll") {
    const known = [machine.orbit_radius_m, machine.orbiting_position_m, machine.anti_rotation?.position_m].every((one) => Number.isFinite(metres(one)));
    return known ? { ...machine, webs: placed(machine.webs) } : null;
  }
  const throws = placed(machine?.throws).filter((one) => Number.isFinite(metres(one.crank_radius_m)) && Number.isFinite(degrees(one.crank_angle_deg)))
    .map((one) => ({ ...one, rows: objects(one.rows).filter((row) => Number.isFinite(degrees(row.axis_deg))) }));
  const webs = placed(machine?.webs).map((web) => (web.sector && ![web.sector.centre_deg, web.sector.half_angle_deg].every((one) => Number.isFinite(degrees(one)))
    ? { ...web, sector: null } : web));
  return throws.length || webs.length ? { ...machine, throws, webs, bearings: placed(machine.bearings) } : null;
}

// the plane of moments that the service takes where none is given
export function plane(machine) {
  const given = metres(machine.reference_plane_m);
  const places = (machine.throws?.length ? machine.throws : machine.webs).map((one) => metres(one.position_m));
  return Number.isFinite(given) ? given : (Math.min(...places) + Math.max(...places)) / 2;
}
