// From the machine to the moving pictures: metres and degrees to the drawing's own units.

import { s } from "../dom.js";
import { quantity } from "../quantity.js";

// of the front view that the service draws too
export const WIDTH = 400;

export const metres = (value) => quantity(value, "m");
export const degrees = (value) => quantity(value, "deg");
const radians = (angle) => (degrees(angle) * Math.PI) / 180;

export const polar = (centre, radius, angle) => [
  centre[0] + radius * Math.cos(radians(angle)), centre[1] - radius * Math.sin(radians(angle)),
];
export const points = (list) => list.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

export const line = (from, to, attributes) => s("line", {
  x1: from[0].toFixed(2), y1: from[1].toFixed(2), x2: to[0].toFixed(2), y2: to[1].toFixed(2), ...attributes,
});
export const circle = (centre, radius, attributes) => s("circle", {
  cx: centre[0].toFixed(2), cy: centre[1].toFixed(2), r: radius.toFixed(2), ...attributes,
});
