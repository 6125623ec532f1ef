// The machine from the front: seen from +z at shaft angle 0, to scale.

import { s } from "../dom.js";
import { figure, nameOf } from "../format.js";
import { labels } from "./labels.js";
import { carried, disc, outline } from "./outline.js";
import { arc, circle, degrees, line, metres, points, polar, radians, radiiOf, reachOf, sense, text, WIDTH } from "./view.js";

const MIDDLE = [WIDTH / 2, WIDTH / 2];
const MOST_NAMES = 16;
const PIN = 7;

// names stand where things are at angle 0
/** @param {{ named?: boolean, built?: any[] }} [how] `built`: what is fitted in place of them */
export function front(machine, counterweights, how = {}) {
  const { named = true, built = [] } = how;
  const reach = Math.max(...radiiOf(machine), 1e-12);
  const scale = (0.36 * WIDTH) / reach;
  const fitted = carried(counterweights);
  const webs = new Map((machine.webs ?? []).map((web) => [web.name, web]));
  const names = fitted.map((one) => `${one.web} ${figure(one.mass_kg, 3)} kg at ${figure(one.angle_deg, 4)}°`);
  return s("svg", {
    viewBox: `0 0 ${WIDTH} ${WIDTH}`, class: `drawing front${(machine.throws?.length ?? 0) > MOST_NAMES ? " many" : ""}`, role: "img",
    "aria-label": `From the front, at shaft angle 0. Counterweights: ${names.join(", ") || "none"}.`,
  },
  axes(),
  (machine.throws ?? []).flatMap((each) => rows(each)),
  (machine.webs ?? []).map((web) => allowed(web, scale)),
  shapes(webs, fitted, scale),
  built.map((one) => s("g", { class: "counterweight built" }, circle(centre(one, scale), round(one, [...fitted, ...built], scale), {}), asBuilt(one))),
  machine.kind === "scroll" ? scroll(machine, scale) : cranks(machine, scale),
  circle(MIDDLE, 5, { class: "shaft" }),
  sense(MIDDLE, 0.47 * WIDTH, machine.rotation),
  named ? labels([...cranksNamed(machine, scale), ...websNamed(webs, fitted, scale)], [WIDTH, WIDTH],
    [...fitted.map((one) => placed(one, webs, scale) ?? arc(centre(one, scale), round(one, fitted, scale), 0, 360)),
      ...placesOf(machine).map(({ each }) => arc(pinOf(each, scale), PIN, 0, 360))]) : null);
}

function axes() {
  const [x, y] = [14, WIDTH - 14];
  return s("g", { class: "axes" }, line([x, y], [x + 26, y]), line([x, y], [x, y - 26]),
    text(x + 30, y + 4, "x"), text(x - 4, y - 31, "y"));
}

function rows(each) {
  return (each.rows ?? []).map((row, index) => {
    const end = polar(MIDDLE, 0.43 * WIDTH, row.axis_deg);
    return s("g", { class: "row" }, line(MIDDLE, end), circle(end, 3),
      s("title", {}, `axis of row ${nameOf(row, index)}, ${figure(degrees(row.axis_deg))}°`));
  });
}

// where a counterweight may sit, if not anywhere
function allowed(web, scale) {
  if (!web.sector) return null;
  const radius = scale * reachOf(web);
  const half = degrees(web.sector.half_angle_deg);
  const centre = degrees(web.sector.centre_deg);
  return s("polygon", { class: "sector", points: points([MIDDLE, ...arc(MIDDLE, 1.2 * radius, centre - half, centre + half)]) },
    s("title", {}, `${web.name} may carry its counterweight here`));
}

// true to shape where the shape is known; else a disc about the centre of mass. The largest lie below the smaller.
function shapes(webs, fitted, scale) {
  return [...fitted].sort((one, other) => other.mass_kg - one.mass_kg).map((one) => {
    const title = s("title", {}, `${one.web}: ${figure(one.mass_kg)} kg at ${figure(one.angle_deg)}°, radius ${figure(one.radius_m)} m`);
    const known = placed(one, webs, scale);
    const attributes = { class: `counterweight${one.fixed ? " fixed" : ""}${known ? "" : " unknown"}` };
    const drawn = known ? s("polygon", { points: points(known) }) : circle(centre(one, scale), round(one, fitted, scale), {});
    return s("g", attributes, drawn, title);
  });
}

export const asBuilt = (one) => s("title", {}, `${one.web} as built: ${figure(one.mass_kg)} kg at ${figure(one.angle_deg)}°`);
const centre = (one, scale) => polar(MIDDLE, scale * one.radius_m, one.angle_deg);
const round = (one, fitted, scale) => Math.max(3, scale * disc(one, fitted));

function placed(one, webs, scale) {
  const direction = radians(one.angle_deg);
  const known = outline(one, webs.get(one.web) ?? {});
  return known && known.map(([along, across]) => [
    MIDDLE[0] + scale * (along * Math.cos(direction) - across * Math.sin(direction)),
    MIDDLE[1] - scale * (along * Math.sin(direction) + across * Math.cos(direction))]);
}

const together = (names, many) => (names.length > 4 ? `${names.length} ${many}` : names.join(", "));

// those in the same place have one label: beyond the shape; above it where that is beside it, for there run the axes of rows
function websNamed(webs, fitted, scale) {
  const places = new Map();
  for (const one of fitted) {
    const place = `${Math.round(one.angle_deg)} ${one.radius_m.toPrecision(2)}`;
    places.set(place, [...(places.get(place) ?? []), one]);
  }
  return places.size > MOST_NAMES ? [] : [...places.values()].map((group) => {
    const [first] = group;
    const content = together(group.map((one) => one.web), "webs");
    if (Math.abs(Math.cos(radians(first.angle_deg))) > Math.SQRT1_2) {
      return { x: centre(first, scale)[0], y: Math.min(...group.map((one) => top(one, webs, fitted, scale))) - 10, content, class: "web" };
    }
    const [x, y] = polar(MIDDLE, scale * (first.shape?.outer_radius_m ?? first.radius_m + disc(first, fitted)) + 14, first.angle_deg);
    // beside a shape the name begins where the shape ends
    return { x: x + 3.5 * content.length * Math.cos(radians(first.angle_deg)), y, content, class: "web" };
  });
}

function top(one, webs, fitted, scale) {
  const known = placed(one, webs, scale);
  return known ? Math.min(...known.map(([, y]) => y)) : centre(one, scale)[1] - round(one, fitted, scale);
}

function placesOf(machine) {
  const places = new Map();
  (machine.throws ?? []).forEach((each, index) => {
    const place = `${degrees(each.crank_angle_deg)} ${metres(each.crank_radius_m)}`;
    places.set(place, { each, names: [...(places.get(place)?.names ?? []), nameOf(each, index)] });
  });
  return [...places.values()];
}

const pinOf = (each, scale) => polar(MIDDLE, scale * metres(each.crank_radius_m), each.crank_angle_deg);

function cranks(machine, scale) {
  return placesOf(machine).map(({ each, names }) => {
    const pin = pinOf(each, scale);
    return s("g", { class: "throw" }, line(MIDDLE, pin), circle(pin, PIN),
      s("title", {}, `throw ${names.join(", ")} at ${figure(degrees(each.crank_angle_deg))}°`));
  });
}

function cranksNamed(machine, scale) {
  const places = placesOf(machine);
  return places.length > MOST_NAMES ? [] : places.map(({ each, names }) => {
    const [x, y] = pinOf(each, scale);
    // never on the crank itself
    return { x, y: y > MIDDLE[1] + 1 ? y + 17 : y - 17, content: together(names, "throws") };
  });
}

function scroll(machine, scale) {
  const orbit = scale * metres(machine.orbit_radius_m);
  const eccentric = polar(MIDDLE, orbit, 0);
  const guide = machine.anti_rotation;
  const parts = [circle(MIDDLE, orbit, { class: "orbit" }), s("g", { class: "throw" }, line(MIDDLE, eccentric), circle(eccentric, 4))];
  if (guide?.type === "oldham") {
    const [from, to] = [0, 180].map((turn) => polar(MIDDLE, 0.4 * WIDTH, degrees(guide.axis_deg) + turn));
    parts.push(s("g", { class: "row" }, line(from, to), s("title", {}, "the Oldham ring slides along this line")));
  } else if (guide) {
    const circleRadius = scale * metres(guide.pin_circle_radius_m);
    parts.push(circle(MIDDLE, circleRadius, { class: "orbit" }));
    for (let index = 0; index < Math.min(guide.count, 60); index += 1) {
      parts.push(circle(polar(MIDDLE, circleRadius, (360 * index) / guide.count), 4, { class: "pin" }));
    }
  }
  return parts;
}
