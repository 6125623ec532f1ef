// The machine from the front: seen from +z at shaft angle 0, to scale.

import { s } from "../dom.js";
import { figure, nameOf } from "../format.js";
import { arc, circle, degrees, line, metres, points, polar, radiiOf, reachOf, sense, text, WIDTH } from "./view.js";

const MIDDLE = [WIDTH / 2, WIDTH / 2];
const WIDEST = 55;
const THICK = 0.36;
const MOST_NAMES = 16;

export function front(machine, counterweights) {
  const reach = Math.max(...radiiOf(machine), 1e-12);
  const scale = (0.36 * WIDTH) / reach;
  const fitted = counterweights.filter((one) => one.mass_kg > 0);
  const names = fitted.map((one) => `${one.web} ${figure(one.mass_kg, 3)} kg at ${figure(one.angle_deg, 4)}°`);
  return s("svg", {
    viewBox: `0 0 ${WIDTH} ${WIDTH}`, class: `drawing front${(machine.throws?.length ?? 0) > MOST_NAMES ? " many" : ""}`, role: "img",
    "aria-label": `From the front, at shaft angle 0. Counterweights: ${names.join(", ") || "none"}.`,
  },
  axes(),
  (machine.throws ?? []).flatMap((each) => rows(each)),
  (machine.webs ?? []).map((web) => allowed(web, scale)),
  grouped(machine, fitted).map((group) => counterweight(group, fitted, scale)),
  machine.kind === "scroll" ? scroll(machine, scale) : cranks(machine, scale),
  circle(MIDDLE, 5, { class: "shaft" }),
  sense(MIDDLE, 0.47 * WIDTH, machine.rotation));
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

// those that hide each other are drawn as one with all names
function grouped(machine, fitted) {
  const reach = new Map((machine.webs ?? []).map((web) => [web.name, reachOf(web)]));
  const groups = new Map();
  for (const one of fitted) {
    const radius = one.radius_m ?? reach.get(one.web);
    const place = `${Math.round(one.angle_deg)} ${radius}`;
    groups.set(place, [...(groups.get(place) ?? []), { ...one, radius }]);
  }
  return [...groups.values()];
}

function counterweight(group, fitted, scale) {
  const heaviest = Math.max(...fitted.map((one) => one.mass_kg));
  const [first] = group;
  const radius = scale * first.radius;
  const [inner, outer] = [radius * (1 - THICK / 2), radius * (1 + THICK / 2)];
  const shapes = group.map((one) => {
    const half = Math.max(2, (WIDEST * one.mass_kg) / heaviest);
    const outline = [...arc(MIDDLE, outer, one.angle_deg - half, one.angle_deg + half),
      ...arc(MIDDLE, inner, one.angle_deg + half, one.angle_deg - half)];
    return s("polygon", { class: "counterweight", points: points(outline) },
      s("title", {}, `${one.web}: ${figure(one.mass_kg)} kg at ${figure(one.angle_deg)}°`));
  });
  const [x, y] = polar(MIDDLE, radius, first.angle_deg);
  const names = group.length > 4 ? `${group.length} webs` : group.map((one) => one.web).join(", ");
  return s("g", {}, shapes, fitted.length <= MOST_NAMES ? text(x, y + 4, names, { class: "name centred" }) : null);
}

function cranks(machine, scale) {
  const places = new Map();
  machine.throws.forEach((each, index) => {
    const place = `${degrees(each.crank_angle_deg)} ${metres(each.crank_radius_m)}`;
    places.set(place, { each, names: [...(places.get(place)?.names ?? []), nameOf(each, index)] });
  });
  return [...places.values()].map(({ each, names }) => {
    const pin = polar(MIDDLE, scale * metres(each.crank_radius_m), each.crank_angle_deg);
    const label = polar(MIDDLE, scale * metres(each.crank_radius_m) + 19, each.crank_angle_deg);
    return s("g", { class: "throw" }, line(MIDDLE, pin), circle(pin, 7),
      places.size <= MOST_NAMES
        ? text(label[0], label[1] + 4, names.length > 4 ? `${names.length} throws` : names.join(", "), { class: "name centred" }) : null,
      s("title", {}, `throw ${names.join(", ")} at ${figure(degrees(each.crank_angle_deg))}°`));
  });
}

function scroll(machine, scale) {
  const orbit = scale * metres(machine.orbit_radius_m);
  const eccentric = polar(MIDDLE, orbit, 0);
  const guide = machine.anti_rotation;
  const parts = [circle(MIDDLE, orbit, { class: "orbit" }), s("g", { class: "throw" }, line(MIDDLE, eccentric), circle(eccentric, 4))];
  if (guide.type === "oldham") {
    const [from, to] = [0, 180].map((turn) => polar(MIDDLE, 0.4 * WIDTH, degrees(guide.axis_deg) + turn));
    parts.push(s("g", { class: "row" }, line(from, to), s("title", {}, "the Oldham ring slides along this line")));
  } else {
    const circleRadius = scale * metres(guide.pin_circle_radius_m);
    parts.push(circle(MIDDLE, circleRadius, { class: "orbit" }));
    for (let index = 0; index < Math.min(guide.count, 60); index += 1) {
      parts.push(circle(polar(MIDDLE, circleRadius, (360 * index) / guide.count), 4, { class: "pin" }));
    }
  }
  return parts;
}
