// Drawings of the report, made by the service: what the page shows of them is what the document shows.

import { h } from "../dom.js";

const picture = (name, panel) => ({
  id: `picture-${name}`, ...panel,
  async draw(body, { ask, request }) {
    const svg = await ask(`v1/pictures/${name}`, request);
    const said = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement.getAttribute("aria-label");
    body.replaceChildren(h("img", { class: "picture", alt: said ?? panel.title, src: `data:image/svg+xml,${encodeURIComponent(svg)}` }));
  },
});

export const stageScheme = picture("stages", { title: "Balancing stages", needs: ["rods"] });
export const orderHodographs = picture("orders", { title: "Hodographs of every order", needs: ["rods"] });
export const bearingCurves = picture("bearings", { title: "Curves of all bearings, with their smallest circles", kind: "reciprocating", needs: ["rods", "bearings"] });
export const indicator = picture("indicator", { title: "Indicator diagrams", kind: "reciprocating", needs: ["rods", "cylinders"] });
