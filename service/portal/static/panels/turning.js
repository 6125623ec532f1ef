// The machine as it turns, with the force and the moment that it shakes its foundation with: the answer's own figures.

import { h, s } from "../dom.js";
import { circle, degrees, line, metres, points, polar, WIDTH } from "../drawing/view.js";
import { question, view } from "../drawing/views.js";
import { carried } from "../fitted.js";
import { figure } from "../format.js";
import { turner } from "./turner.js";

const MIDDLE = [WIDTH / 2, WIDTH / 2];
const LONGEST = 0.4 * WIDTH;
const PARTS = [
  { name: "force", unit: "N", x: "force_x_N", y: "force_y_N" },
  { name: "moment", unit: "N m", x: "moment_x_Nm", y: "moment_y_Nm" },
];

export const turning = {
  id: "turning", title: "The turning crank, with force and moment",
  about: "First order: dashed without counterweights, solid with them. Arrows and curves of one picture have one scale.",
  async draw(body, { answer, request, ask }) {
    const { hodograph } = answer;
    const sense = request.machine.rotation === "cw" ? -1 : 1;
    const machine = view((await ask("v1/layout", question(request.machine, carried(answer)))).front, "front");
    machine.setAttribute("aria-label", "The machine from the front, as it turns.");
    const moving = machine.querySelectorAll(".counterweight:not(.balancer *), .throw");
    const balancers = [...machine.querySelectorAll(".balancer")].map((element, k) => balancer(element, request.machine.balance_shafts[k]));
    const sliders = rows(request.machine, sense);
    machine.append(...sliders.map(({ element }) => element));
    const vectors = PARTS.map((part) => new Vectors(part, hodograph));
    const show = (step) => {
      const angle = hodograph.angle_deg[step];
      for (const one of moving) one.setAttribute("transform", `rotate(${-sense * angle} ${MIDDLE[0]} ${MIDDLE[1]})`);
      for (const one of balancers) one.at(sense * angle);
      for (const one of sliders) one.at(angle);
      for (const one of vectors) one.at(step);
    };
    const seen = () => machine.isConnected && machine.checkVisibility();
    body.replaceChildren(
      h("div", { class: "turning" }, h("figure", {}, machine, h("figcaption", {}, "From the front")), vectors.map(({ figure: one }) => one)),
      turner("turning-angle", hodograph.angle_deg, show, seen));
  },
};

// what is on a balance shaft turns about its axis, which is the first circle of its group
function balancer(element, { speed_ratio: ratio }) {
  const axis = element.querySelector("circle");
  const [x, y] = ["cx", "cy"].map((name) => axis.getAttribute(name));
  return { at: (angle) => element.setAttribute("transform", `rotate(${-ratio * angle} ${x} ${y})`) };
}

// the crosshead of every row whose rod is known, on its axis as the crank drives it
function rows(machine, sense) {
  const all = (machine.throws ?? []).flatMap((each) => (each.rows ?? []).map((row) => ({ each, row, rod: metres(row.connecting_rod?.length_m) })));
  const known = all.filter(({ rod }) => Number.isFinite(rod));
  const reach = Math.max(...known.map(({ each, rod }) => metres(each.crank_radius_m) + rod), 1e-12);
  return known.map(({ each, row, rod }) => {
    const [axis, radius] = [degrees(row.axis_deg), metres(each.crank_radius_m)];
    const element = s("g", { class: "slider" });
    return { element, at: (angle) => {
      const turned = ((degrees(each.crank_angle_deg) + sense * angle - axis) * Math.PI) / 180;
      const along = radius * Math.cos(turned) + Math.sqrt(Math.max(0, rod * rod - (radius * Math.sin(turned)) ** 2));
      element.replaceChildren(circle(polar(MIDDLE, (0.46 * WIDTH * along) / reach, axis), 5, {}));
    } };
  });
}

// what turns and what remains as arrows from the middle, over the curves that their ends run along
class Vectors {
  constructor(part, hodograph) {
    this.part = part;
    this.curves = [["before", hodograph.before], ["after", hodograph.after]].filter(([, curve]) => curve);
    const sizes = this.curves.flatMap(([, curve]) => curve[part.x].map((x, step) => Math.hypot(x, curve[part.y][step])));
    this.scale = LONGEST / Math.max(...sizes, 1e-300);
    this.moving = s("g", {});
    const outlines = this.curves.map(([name, curve]) => s("polygon", { class: `curve ${name}`, points: points(curve[part.x].map((_, step) => this.end(curve, step))) }));
    const drawing = s("svg", { viewBox: `0 0 ${WIDTH} ${WIDTH}`, class: "drawing vectors", role: "img",
      "aria-label": `The ${part.name} over a revolution, at most ${figure(Math.max(...sizes))} ${part.unit}.` }, outlines, circle(MIDDLE, 3, { class: "shaft" }), this.moving);
    this.said = h("figcaption", {});
    this.figure = h("figure", {}, drawing, this.said);
  }

  end(curve, step) {
    return [MIDDLE[0] + this.scale * curve[this.part.x][step], MIDDLE[1] - this.scale * curve[this.part.y][step]];
  }

  at(step) {
    const { name: what, unit, x, y } = this.part;
    this.moving.replaceChildren(...this.curves.map(([name, curve]) => arrow(this.end(curve, step), name)));
    const sizes = this.curves.map(([name, curve]) => `${name} ${figure(Math.hypot(curve[x][step], curve[y][step]), 4)} ${unit}`);
    this.said.textContent = `${what}: ${sizes.join(", ")}`;
  }
}

function arrow(tip, name) {
  const direction = (Math.atan2(MIDDLE[1] - tip[1], tip[0] - MIDDLE[0]) * 180) / Math.PI;
  const head = Math.hypot(tip[0] - MIDDLE[0], tip[1] - MIDDLE[1]) < 12 ? [] : [polar(tip, 12, direction + 155), tip, polar(tip, 12, direction - 155)];
  return s("g", { class: `vector ${name}` }, line(MIDDLE, tip), s("polyline", { points: points(head) }));
}
