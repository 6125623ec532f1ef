// The machine from the front and along its shaft, side by side.

import { h } from "../dom.js";
import { front } from "./front.js";
import { carried } from "./outline.js";
import { side } from "./side.js";

export function pair(machine, counterweights, reference) {
  const unknown = carried(counterweights).some((one) => !one.shape);
  return [
    h("figure", {}, front(machine, counterweights), h("figcaption", {},
      `From the front, to scale, shaft angle 0.${unknown ? " A dashed disc stands for a counterweight of unknown shape about its centre of mass." : ""}`)),
    h("figure", {}, side(machine, counterweights, reference),
      h("figcaption", {}, "Along the shaft, with a scale of its own; what stands towards you is drawn down and to the left.")),
  ];
}
