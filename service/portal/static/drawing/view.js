// From the machine to the picture: metres and degrees to the drawing's own units.

import { s } from "../dom.js";
import { quantity } from "../quantity.js";

export const WIDTH = 400;

export const metres = (value) => quantity(value, "m");
export const degrees = (value) => quantity(value, "deg");
export const radians = (angle) => (degrees(angle) * Math.PI) / 180;

export const polar = (centre, radius, angle) => [
  centre[0] + radius * Math.cos(radians(angle)), centre[1] - radius * Math.sin(radians(angle)),
];
export const points = (list) => list.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

export function arc(centre, radius, from, to) {
  const steps = Math.max(2, Math.ceil(Math.abs(to - from) / 4));
  return Array.from({ length: steps + 1 }, (_, index) => polar(centre, radius, from + ((to - from) * index) / steps));
}

export const text = (x, y, content, attributes) => s("text", { x: x.toFixed(1), y: y.toFixed(1), ...attributes }, content);
export const line = (from, to, attributes) => s("line", {
  x1: from[0].toFixed(2), y1: from[1].toFixed(2), x2: to[0].toFixed(2), y2: to[1].toFixed(2), ...attributes,
});
export const circle = (centre, radius, attributes) => s("circle", {
  cx: centre[0].toFixed(2), cy: centre[1].toFixed(2), r: radius.toFixed(2), ...attributes,
});

// An arrow along an arc, in the sense of rotation.
export function sense(centre, radius, rotation) {
  const [from, to] = rotation === "cw" ? [75, 45] : [45, 75];
  const tip = polar(centre, radius, to);
  const back = to + (rotation === "cw" ? 4 : -4);
  return s("g", { class: "sense" },
    s("polyline", { points: points(arc(centre, radius, from, to)) }),
    s("polyline", { points: points([polar(centre, radius + 6, back), tip, polar(centre, radius - 6, back)]) }),
    s("title", {}, `turns ${rotation === "cw" ? "clockwise" : "counter-clockwise"}`));
}

// the radius to which a counterweight reaches, that of its centre of mass where no more is known
export const reachOf = (web) => metres(web.envelope?.outer_radius_m ?? web.fixed?.radius_m ?? web.counterweight_radius_m);

export const radiiOf = (machine) => [
  ...(machine.throws ?? []).map((each) => 1.25 * metres(each.crank_radius_m)),
  ...(machine.webs ?? []).map((web) => 1.22 * reachOf(web)),
  ...(machine.kind === "scroll" ? [1.5 * metres(machine.orbit_radius_m)] : []),
  ...(machine.anti_rotation?.type === "crank_pins" ? [1.1 * metres(machine.anti_rotation.pin_circle_radius_m)] : []),
].filter(Number.isFinite);
