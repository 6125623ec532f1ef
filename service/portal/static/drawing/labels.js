// Names in a drawing: above everything else, none over another, and none on a shape where there is room beside it.

import { line, text } from "./view.js";

const [CHARACTER, HEIGHT] = [7.6, 16];
const FARTHEST = 12;

/**
 * Each at its place, or at the nearest place above or below that is free, with a thin line back.
 * @param {{ x: number, y: number, content: string, class?: string }[]} wanted
 * @param {number[]} size of the drawing
 * @param {number[][][]} shapes closed lines of points on which names are hard to read
 */
export function labels(wanted, [width, height], shapes) {
  const taken = [];
  const apart = (box) => taken.every((other) => box[2] <= other[0] || box[0] >= other[2] || box[3] <= other[1] || box[1] >= other[3]);
  const clear = (box) => apart(box) && !shapes.some((shape) => meet(box, shape));
  return wanted.map(({ x, y, content, ...attributes }) => {
    const half = (CHARACTER * content.length) / 2 + 2;
    const across = Math.min(Math.max(x, half), width - half);
    const steps = Array.from({ length: 2 * FARTHEST + 1 }, (_, index) => (index % 2 ? -1 : 1) * Math.ceil(index / 2));
    const boxes = steps.map((step) => [across - half, y - HEIGHT / 2 + step * HEIGHT, across + half, y + HEIGHT / 2 + step * HEIGHT])
      .filter((box) => box[1] >= 0 && box[3] <= height);
    const found = boxes.find(clear) ?? boxes.find(apart);
    if (!found) return null;
    taken.push(found);
    const middle = (found[1] + found[3]) / 2;
    return [Math.abs(middle - y) > HEIGHT ? line([x, y], [across, middle > y ? found[1] : found[3]], { class: "leader" }) : null,
      text(across, middle + 4.5, content, { ...attributes, class: `name centred ${attributes.class ?? ""}` })];
  });
}

// a corner of one in the other, or the middle of the box in the shape
/** @param {number[]} box @param {number[][]} shape */
function meet([left, up, right, down], shape) {
  const middle = [(left + right) / 2, (up + down) / 2];
  return shape.some(([x, y]) => x > left && x < right && y > up && y < down)
    || [[left, up], [right, up], [left, down], [right, down], middle].some((point) => within(point, shape));
}

/** @param {number[]} point @param {number[][]} shape */
// whether a line from the point to the right crosses the outline an odd number of times
function within([x, y], shape) {
  let inside = false;
  shape.forEach(([x1, y1], index) => {
    const [x2, y2] = shape.at(index - 1) ?? [x1, y1];
    if ((y1 > y) !== (y2 > y) && x < x1 + ((y - y1) / (y2 - y1)) * (x2 - x1)) inside = !inside;
  });
  return inside;
}
