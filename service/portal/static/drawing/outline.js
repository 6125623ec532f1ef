// The outline of a counterweight in the plane of its web, in metres about the shaft, as far as it is known.

import { metres, radians } from "./view.js";

// what rounding leaves of nothing is not drawn
const DUST = 1e-6;
const STEPS = 24;
// the disc that stands for the heaviest counterweight of unknown shape, as a share of the radius of its centre of mass
const DISC = 0.34;

export function carried(counterweights) {
  const heaviest = Math.max(0, ...counterweights.map((one) => one.mass_kg));
  return counterweights.filter((one) => one.mass_kg > DUST * heaviest);
}

const bow = (radius, from, to) => Array.from({ length: STEPS + 1 }, (_, index) => {
  const angle = from + ((to - from) * index) / STEPS;
  return [radius * Math.cos(angle), radius * Math.sin(angle)];
});

// [[along, across], ...] about the direction of the counterweight; null where no shape is known
export function outline({ shape }, web) {
  if (!shape) return null;
  const [inner, outer, half] = [metres(web.envelope?.inner_radius_m ?? 0), shape.outer_radius_m, radians(shape.half_angle_deg)];
  if (shape.chord_height_m === null) return [...bow(outer, -half, half), ...bow(inner, half, -half)];
  // a chord that meets the hub goes around it
  const around = shape.chord_height_m < inner ? bow(inner, Math.acos(shape.chord_height_m / inner), -Math.acos(shape.chord_height_m / inner)) : [];
  return [...bow(outer, -half, half), ...around];
}

// [nearest, farthest] from the shaft along the direction of the counterweight [m]
export function extent({ shape }, web) {
  if (!shape) return null;
  const inner = metres(web.envelope?.inner_radius_m ?? 0);
  return [Math.max(inner, shape.chord_height_m ?? inner), shape.outer_radius_m];
}

// the radius of the disc that stands for a counterweight of which only mass and centre are known: its area is as its mass
export function disc(one, all) {
  const heaviest = all.reduce((most, other) => (other.mass_kg > most.mass_kg ? other : most));
  return DISC * heaviest.radius_m * Math.sqrt(one.mass_kg / heaviest.mass_kg);
}
