// The trade-off between force and moment: every point is a set of counterweights.

import { h, table } from "../dom.js";
import { front } from "../drawing/front.js";
import { figure, number, share } from "../format.js";
import { colours, plot } from "../plots.js";
import { counterweightTable } from "./counterweights.js";

const POINTS = 21;
const WHY = {
  reached_together: "Force and moment are smallest at the same counterweights: there is nothing to trade.",
  resolution: "Points that rounding could not tell apart were left out.",
  undecided: "The ceilings are on the very boundary of what can be reached.",
};

export const pareto = {
  id: "pareto", title: "Trade-off of force, moment and mass",
  about: "Points that no other counterweights beat in both peaks. Choose one to see its counterweights.",
  async draw(body, { request, ask, keep, kept }) {
    const { angles: _angles, fidelity: _fidelity, ...rest } = request;
    const answer = await ask("v1/pareto", { ...rest, points: POINTS });
    const [found] = answer.fronts;
    if (!found.points.length) {
      body.replaceChildren(h("p", {}, "No counterweights satisfy the ceilings: there is no front."));
      return;
    }
    const node = h("div");
    const picked = h("div", { class: "picked", "aria-live": "polite" });
    const slider = h("input", { id: "pareto-point", type: "range", min: 0, max: found.points.length - 1, step: 1,
      input: () => pick(Number(slider.value)) });
    let chosen = 0;
    const draw = () => plot(node, () => picture(found, answer, chosen, (point) => point.data.meta === "front" && pick(point.pointIndex)));
    const choose = (index) => {
      chosen = index;
      slider.value = index;
      show(picked, request.machine, found.points[index], index, found.points.length);
      return draw();
    };
    const pick = (index) => {
      keep("point", index + 1);
      return choose(index);
    };
    body.replaceChildren(...[node,
      h("div", { class: "slide" }, h("label", { for: "pareto-point" }, "Point, from least force to least moment"), slider),
      found.reason ? h("p", { class: "about" }, WHY[found.reason]) : null, picked].filter(Boolean));
    const before = Number(kept.point) - 1;
    await choose(found.points[before] ? before : found.knee ?? 0);
  },
};

function picture(found, answer, chosen, click) {
  const { before, after, mark } = colours();
  const of = (name) => found.points.map((point) => point[name]);
  const bare = answer.without_counterweights;
  const here = found.points[chosen];
  return {
    click,
    traces: [
      { x: of("force_peak_N"), y: of("moment_peak_Nm"), mode: "lines+markers", name: "front", meta: "front", line: { color: after },
        marker: { size: 9, color: after }, customdata: of("total_mass_kg"),
        hovertemplate: "%{x:.5~s} N, %{y:.5~s} N m, %{customdata:.5~s} kg<extra></extra>" },
      { x: [here.force_peak_N], y: [here.moment_peak_Nm], mode: "markers", name: "chosen", hoverinfo: "skip",
        marker: { size: 17, symbol: "circle-open", color: mark, line: { width: 3 } } },
      { x: [bare.force.peak_N], y: [bare.moment.peak_Nm], mode: "markers", name: "without counterweights",
        marker: { size: 10, symbol: "x", color: before }, visible: "legendonly" },
    ],
    layout: { height: 340, xaxis: { title: "peak force, N" }, yaxis: { title: "peak moment, N m" } },
    label: `Front of ${found.points.length} points; chosen: ${figure(here.force_peak_N)} N and ${figure(here.moment_peak_Nm)} N m.`,
  };
}

function show(place, machine, point, index, count) {
  place.replaceChildren(
    h("h3", {}, `Point ${index + 1} of ${count}`),
    table("The chosen point", ["peak force, N", "peak moment, N m", "total mass, kg", "proved to within"],
      [[figure(point.force_peak_N), number(point.moment_peak_Nm), number(point.total_mass_kg),
        { number: true, text: point.certificate.relative_gap === null ? "none" : share(point.certificate.relative_gap) }]]),
    h("div", { class: "beside" }, front(machine, point.counterweights), counterweightTable(point.counterweights)));
}
