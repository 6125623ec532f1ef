// The machine from the front and along its shaft, side by side.

import { h } from "../dom.js";
import { quantity } from "../quantity.js";
import { front } from "./front.js";
import { carried } from "./outline.js";
import { side } from "./side.js";
import { degrees, metres } from "./view.js";

/** @param {any[]} fitted what a request says is fitted: {web, mass_kg, angle_deg} */
export function pair(machine, counterweights, reference, fitted = []) {
  const unknown = carried(counterweights).some((one) => !one.shape);
  const webs = new Map((machine.webs ?? []).map((web) => [web.name, web]));
  const built = fitted.filter((one) => webs.has(one?.web)).map((one) => ({ ...one, mass_kg: quantity(one.mass_kg, "kg"), angle_deg: degrees(one.angle_deg),
    radius_m: metres(one.radius_m ?? webs.get(one.web).counterweight_radius_m ?? counterweights.find(({ web }) => web === one.web)?.radius_m) }))
    .filter((one) => one.mass_kg > 0 && Number.isFinite(one.angle_deg) && Number.isFinite(one.radius_m));
  return [
    h("figure", {}, front(machine, counterweights, { built }), h("figcaption", {},
      `From the front, to scale, shaft angle 0.${unknown ? " A dashed disc stands for a counterweight of unknown shape about its centre of mass." : ""}${built.length ? " As built: dashed, without a ground." : ""}`)),
    h("figure", {}, side(machine, counterweights, reference, built),
      h("figcaption", {}, "Along the shaft, with a scale of its own; what stands towards you is drawn down and to the left.")),
  ];
}

const objects = (list) => [list ?? []].flat().filter((one) => one !== null && typeof one === "object");
const placed = (list) => objects(list).filter((one) => Number.isFinite(metres(one.position_m)));

const room = (webs) => placed(webs).map((web) => (web.sector && ![web.sector.centre_deg, web.sector.half_angle_deg].every((one) => Number.isFinite(degrees(one)))
  ? { ...web, sector: null } : web));

// the device, where all of it that is drawn is there
function device(guide) {
  const size = guide?.type === "oldham" ? degrees(guide.axis_deg) : metres(guide?.pin_circle_radius_m);
  return Number.isFinite(size) && Number.isFinite(metres(guide.position_m)) ? guide : null;
}

// What can be drawn of a machine while it is typed; null where nothing can.
export function drawable(machine) {
  const webs = room(machine?.webs);
  if (machine?.kind === "scroll") {
    const known = [machine.orbit_radius_m, machine.orbiting_position_m].every((one) => Number.isFinite(metres(one)));
    return known ? { ...machine, webs, anti_rotation: device(machine.anti_rotation) } : null;
  }
  const throws = placed(machine?.throws).filter((one) => Number.isFinite(metres(one.crank_radius_m)) && Number.isFinite(degrees(one.crank_angle_deg)))
    .map((one) => ({ ...one, rows: objects(one.rows).filter((row) => Number.isFinite(degrees(row.axis_deg))) }));
  return throws.length || webs.length ? { ...machine, throws, webs, bearings: placed(machine.bearings) } : null;
}

// the plane of moments that the service takes where none is given
export function plane(machine) {
  const given = metres(machine.reference_plane_m);
  const planes = [machine.throws, machine.webs].find((list) => list?.length) ?? [{ position_m: machine.orbiting_position_m }];
  const places = planes.map((one) => metres(one.position_m));
  return Number.isFinite(given) ? given : (Math.min(...places) + Math.max(...places)) / 2;
}
