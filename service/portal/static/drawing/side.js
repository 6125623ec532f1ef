// The machine from the side: planes along the shaft, z to the right, drawn obliquely so that no throw hides.

import { s } from "../dom.js";
import { figure, nameOf } from "../format.js";
import { asBuilt } from "./front.js";
import { carried, extent } from "./outline.js";
import { circle, line, metres, points, radians, radiiOf, text } from "./view.js";

const WIDTH = 560;
const BOTTOM = 260;
const LINE = 15;
const MIDDLE = 142;
// what stands towards the viewer is drawn down and to the left, shortened
const DEPTH = [-0.32, 0.26];
const MOST_NAMES = 24;

export function side(machine, counterweights, reference, built = []) {
  const planes = planesOf(machine);
  const all = [...planes.map((plane) => plane.z), reference].filter(Number.isFinite);
  const [low, high] = [Math.min(...all), Math.max(...all)];
  const room = high > low ? 0 : 0.5;
  const z = (place) => 62 + ((place - low + room) / (high - low + 2 * room)) * (WIDTH - 118);
  const across = 100 / Math.max(...radiiOf(machine), 1e-12);
  const up = radians(machine.throws?.[0]?.crank_angle_deg ?? 0);
  const at = (place, radius, angle) => {
    const [height, depth] = [Math.cos(angle - up), -Math.sin(angle - up)].map((part) => part * radius * across);
    return [z(place) + DEPTH[0] * depth, MIDDLE - height + DEPTH[1] * depth];
  };
  const late = z(reference) > WIDTH - 150;
  const named = names(planes, z);
  const height = BOTTOM + 32 + LINE * Math.max(2, named.lines);
  return s("svg", {
    viewBox: `0 0 ${WIDTH} ${height}`, class: `drawing side${planes.length > MOST_NAMES ? " many" : ""}`, role: "img",
    "aria-label": `From the side: ${planes.map((plane) => `${plane.name} at ${figure(plane.z)} m`).join(", ")}.`,
  },
  line([z(reference), 14], [z(reference), BOTTOM - 2], { class: "reference" }),
  text(z(reference) + (late ? -4 : 4), 20, "reference plane", { class: `name faint${late ? " end" : ""}` }),
  weights(machine, counterweights, at, z),
  asFitted(machine, built, at),
  line([24, MIDDLE], [WIDTH - 24, MIDDLE], { class: "shaft" }),
  machine.kind === "scroll" ? scroll(machine, at) : throws(machine, at),
  bearings(machine, z),
  named.drawn);
}

function planesOf(machine) {
  const throwsAt = (machine.throws ?? []).map((each, index) => ({ name: `throw ${nameOf(each, index)}`, z: metres(each.position_m) }));
  const websAt = (machine.webs ?? []).map((web) => ({ name: web.name, z: metres(web.position_m), web: true }));
  const bearingsAt = (machine.bearings ?? []).map((one) => ({ name: `bearing ${one.name}`, z: metres(one.position_m) }));
  const scrollAt = machine.kind !== "scroll" ? [] : [
    { name: "scroll", z: metres(machine.orbiting_position_m) },
    { name: machine.anti_rotation?.type === "oldham" ? "ring" : "pins", z: metres(machine.anti_rotation?.position_m) },
  ];
  return [...throwsAt, ...scrollAt, ...websAt, ...bearingsAt].filter((plane) => Number.isFinite(plane.z));
}

function throws(machine, at) {
  return machine.throws.map((each, index) => {
    const radius = metres(each.crank_radius_m);
    const [place, angle] = [metres(each.position_m), radians(each.crank_angle_deg)];
    const pin = at(place, radius, angle);
    return s("g", { class: "throw" }, line(at(place, 0, 0), pin), circle(pin, 6),
      (each.rows ?? []).map((row) => circle(at(place + metres(row.offset_m ?? 0), radius, angle), 2.5, { class: "row" })),
      s("title", {}, `throw ${nameOf(each, index)}, plane ${figure(place)} m`));
  });
}

// a plate from its inner to its outer radius and as thick as it is; where no shape is known, one about the centre of
// mass, as wide as its mass asks for; a short line where there is nothing
function weights(machine, counterweights, at, z) {
  const fitted = carried(counterweights);
  const masses = new Map(fitted.map((one) => [one.web, one]));
  const heaviest = Math.max(...fitted.map((one) => one.mass_kg), 1e-300);
  return (machine.webs ?? []).filter((web) => Number.isFinite(metres(web.position_m))).map((web) => {
    const one = masses.get(web.name);
    const place = metres(web.position_m);
    if (!one) return s("g", { class: "free" }, line([z(place), MIDDLE - 7], [z(place), MIDDLE + 7]), s("title", {}, `${web.name}: nothing`));
    const angle = radians(one.angle_deg);
    const known = extent(one, web);
    const half = known ? (z(place + metres(web.envelope?.thickness_m ?? 0)) - z(place)) / 2 : 3 + 9 * (one.mass_kg / heaviest);
    const [inner, outer] = (known ?? [0.82 * one.radius_m, 1.18 * one.radius_m]).map((radius) => at(place, radius, angle));
    const plate = [[inner[0] - half, inner[1]], [inner[0] + half, inner[1]], [outer[0] + half, outer[1]], [outer[0] - half, outer[1]]];
    return s("g", { class: `counterweight${one.fixed ? " fixed" : ""}${known ? "" : " unknown"}` }, line(at(place, 0, 0), inner, { class: "arm" }),
      s("polygon", { points: points(plate) }),
      s("title", {}, `${one.web}: ${figure(one.mass_kg)} kg at ${figure(one.angle_deg)}°, plane ${figure(place)} m`));
  });
}

// what is fitted, about its centre of mass and as wide as its mass asks for
function asFitted(machine, built, at) {
  const places = new Map((machine.webs ?? []).map((web) => [web.name, metres(web.position_m)]));
  const heaviest = Math.max(...built.map((one) => one.mass_kg), 1e-300);
  return built.map((one) => {
    const half = 3 + 9 * (one.mass_kg / heaviest);
    const [inner, outer] = [0.82, 1.18].map((share) => at(places.get(one.web), share * one.radius_m, radians(one.angle_deg)));
    return s("g", { class: "counterweight built" }, s("polygon", { points: points([[inner[0] - half, inner[1]], [inner[0] + half, inner[1]], [outer[0] + half, outer[1]], [outer[0] - half, outer[1]]]) }), asBuilt(one));
  });
}

function scroll(machine, at) {
  const place = metres(machine.orbiting_position_m);
  const pin = at(place, metres(machine.orbit_radius_m), 0);
  return s("g", { class: "throw" }, line([pin[0], pin[1] - 55], [pin[0], pin[1] + 55]), circle(pin, 4), s("title", {}, "orbiting scroll"));
}

function bearings(machine, z) {
  return (machine.bearings ?? []).map((one) => {
    const x = z(metres(one.position_m));
    return s("g", { class: "bearing" }, s("polygon", { points: points([[x, MIDDLE + 3], [x - 8, MIDDLE + 17], [x + 8, MIDDLE + 17]]) }),
      s("title", {}, `bearing ${one.name}`));
  });
}

// names stand below their planes, each on the first line where there is room
function names(planes, z) {
  if (planes.length > MOST_NAMES) return { lines: 0, drawn: null };
  /** @type {number[]} */
  const lines = [];
  const drawn = [...planes].sort((one, other) => one.z - other.z).map((plane) => {
    const half = 4.3 * plane.name.length + 3;
    const x = Math.min(Math.max(z(plane.z), half), WIDTH - half);
    const free = lines.findIndex((end) => end < x - half);
    const row = free < 0 ? lines.length : free;
    lines[row] = x + half;
    return [line([z(plane.z), BOTTOM], [z(plane.z), BOTTOM + 6], { class: "tick" }),
      text(x, BOTTOM + 21 + LINE * row, plane.name, { class: `name centred${plane.web ? " web" : ""}` })];
  });
  return { lines: lines.length, drawn };
}
