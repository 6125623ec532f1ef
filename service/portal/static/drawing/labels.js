// Names in a drawing: above everything else, and none over another.

import { line, text } from "./view.js";

const [CHARACTER, HEIGHT] = [7.6, 16];
const FARTHEST = 12;

// each {x, y, content, class}: at its place, or at the nearest place above or below that is free, with a thin line back
export function labels(wanted, [width, height]) {
  const taken = [];
  const free = (box) => taken.every((other) => box[2] <= other[0] || box[0] >= other[2] || box[3] <= other[1] || box[1] >= other[3]);
  return wanted.map(({ x, y, content, ...attributes }) => {
    const half = (CHARACTER * content.length) / 2 + 2;
    const across = Math.min(Math.max(x, half), width - half);
    const steps = Array.from({ length: 2 * FARTHEST + 1 }, (_, index) => (index % 2 ? -1 : 1) * Math.ceil(index / 2));
    const boxAt = (step) => [across - half, y - HEIGHT / 2 + step * HEIGHT, across + half, y + HEIGHT / 2 + step * HEIGHT];
    const found = steps.map(boxAt).find((box) => box[1] >= 0 && box[3] <= height && free(box));
    if (!found) return null;
    taken.push(found);
    const middle = (found[1] + found[3]) / 2;
    return [Math.abs(middle - y) > HEIGHT ? line([x, y], [across, middle], { class: "leader" }) : null,
      text(across, middle + 4.5, content, { ...attributes, class: `name centred ${attributes.class ?? ""}` })];
  });
}
