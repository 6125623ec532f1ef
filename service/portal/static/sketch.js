// The machine as it is typed, drawn without counterweights.

import { byId, h } from "./dom.js";
import { drawable, pair, plane } from "./drawing/pair.js";
import { Later } from "./later.js";

/** @param {() => any} request what is there when the page has time to draw */
export const sketching = (request) => new Later(() => {
  const machine = drawable(request().machine);
  if (!machine) return;
  if (!byId("drawings")) byId("answer").append(h("div", { class: "drawings", id: "drawings" }));
  byId("drawings").replaceChildren(...pair(machine, [], plane(machine)));
});
