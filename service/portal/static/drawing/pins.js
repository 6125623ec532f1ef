// Orbiting scroll and anti-rotation pins at one shaft angle, with the force of every pin on the scroll.

import { s } from "../dom.js";
import { figure } from "../format.js";
import { circle, line, metres, points, polar, WIDTH } from "./view.js";

const MIDDLE = [WIDTH / 2, WIDTH / 2];
const CIRCLE = 118;
// the orbit is small beside the pin circle and is drawn larger
const ORBIT = 26;
const LONGEST = 58;

export class PinPicture {
  constructor(machine, found) {
    this.found = found;
    this.sense = machine.rotation === "cw" ? -1 : 1;
    this.largest = found.peak_N || Math.max(...found.pins.flatMap((pin) => pin.load_N.map(Math.abs)), 1e-300);
    this.moving = s("g", {});
    const guide = machine.anti_rotation;
    const ratio = guide?.pin_circle_radius_m ? metres(guide.pin_circle_radius_m) / metres(machine.orbit_radius_m) : null;
    this.element = s("svg", { viewBox: `0 0 ${WIDTH} ${WIDTH}`, class: "drawing pins", role: "img",
      "aria-label": "Moving picture of the scroll and the forces of its pins" },
    found.pins.map((pin) => this.frame(pin)), circle(MIDDLE, ORBIT, { class: "orbit" }), this.moving,
    ratio ? s("text", { x: 8, y: WIDTH - 8, class: "name faint" }, `orbit drawn ${figure((ORBIT / CIRCLE) * ratio, 2)} times as large`) : null);
  }

  place(pin) {
    return polar(MIDDLE, CIRCLE, this.sense * pin.phase_deg);
  }

  frame(pin) {
    const centre = this.place(pin);
    return s("g", {}, circle(centre, ORBIT, { class: "orbit" }), circle(centre, 3, { class: "shaft" }));
  }

  at(step) {
    const turned = this.sense * this.found.angle_deg[step];
    const eccentric = polar(MIDDLE, ORBIT, turned);
    const arms = this.found.pins.map((pin) => {
      const from = this.place(pin);
      const to = polar(from, ORBIT, turned);
      const load = pin.load_N[step];
      return s("g", {}, line(from, to, { class: "arm" }), circle(to, 6, { class: "pin" }), load === null ? null : this.arrow(to, load, turned, pin));
    });
    this.moving.replaceChildren(circle(eccentric, CIRCLE, { class: "scroll" }), ...arms,
      s("g", { class: "throw" }, line(MIDDLE, eccentric), circle(eccentric, 5)));
  }

  arrow(from, load, turned, pin) {
    const length = (LONGEST * Math.abs(load)) / this.largest;
    if (length < 1) return null;
    const direction = turned + (load > 0 ? 0 : 180);
    const tip = polar(from, length, direction);
    const head = [polar(tip, 9, direction + 155), tip, polar(tip, 9, direction - 155)];
    return s("g", { class: load > 0 ? "push" : "pull" }, line(from, tip), s("polyline", { points: points(head) }),
      s("title", {}, `pin ${pin.index}: ${figure(load)} N`));
  }
}
