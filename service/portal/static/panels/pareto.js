// The trade-off of any two or three responses, or of numbers: every point is a set of counterweights.

import { h, table } from "../dom.js";
import { view, Views } from "../drawing/views.js";
import { carried, wholeMass } from "../fitted.js";
import { figure, number, share } from "../format.js";
import { complaint } from "../naming.js";
import { colours, plot } from "../plots.js";
import { chosenFrom, counted } from "./counts.js";
import { counterweightTable } from "./counterweights.js";
import { missing } from "./panels.js";

const POINTS = 21;
// over the whole turn a point takes several programs
const POINTS_OVER_THE_TURN = 11;
// as many as lie on a triangle of four to a side
const POINTS_OF_THREE = 10;
const USUAL = ["force", "moment"];
// what the front of the first order does not take
const PLAIN = /^(orders|bearing_measure|(bearing|specific_load|bending)_ceiling_.*)$/;
const WORDS = { force: "peak force", moment: "peak moment", bearings: "largest bearing load", bending: "largest bending moment", mass: "total mass", objective: "objective", roll: "roll moment" };
const NEEDS = { bearings: ["rods", "bearings"], bending: ["rods", "bearings"], roll: ["rods", "balance_shafts"] };
const WHY = {
  reached_together: "Both are smallest at the same counterweights: there is nothing to trade.",
  resolution: "Points that rounding could not separate were left out.",
  undecided: "The ceilings are on the very boundary of what can be reached.",
  complete: "These are all: no set that can be chosen is better.",
  time: "The time limit ended the search: there may be more points between these.",
};

export const pareto = {
  id: "pareto", title: "Trade-off of any two or three responses",
  about: "Points that no other counterweights beat in all that is traded. Choose one to see its counterweights.",
  async draw(body, context) {
    const { request, ask, keep, kept } = context;
    const again = (name, value) => {
      delete kept.point;
      keep(name, value);
      return pareto.draw(body, context);
    };
    const { choice, ends, found: answered } = chosenFrom(request.machine) ? counted(context, again) : await traded(context, again);
    body.replaceChildren(choice);
    const { angles: _angles, fidelity: _fidelity, fitted: _fitted, ...rest } = request;
    let found;
    try {
      found = await answered(rest, ask);
    } catch (error) {
      if (error.name === "AbortError") throw error;
      // the choice stays: another one may have an answer
      body.append(h("p", { class: "error", role: "alert" }, [error.message, ...(error.errors ?? []).map((one) => `${complaint(request, one)}.`)].join(" ")));
      return;
    }
    if (!found.points.length) {
      body.append(h("p", {}, "No counterweights satisfy the ceilings: there is no front."));
      return;
    }
    const node = h("div");
    const picked = h("div", { class: "picked", "aria-live": "polite" });
    const drawing = h("div", {});
    const views = new Views((one) => drawing.replaceChildren(view(one.front, "front")), (why) => drawing.replaceChildren(h("p", { class: "about" }, why)));
    const slider = h("input", { id: "pareto-point", type: "range", min: 0, max: found.points.length - 1, step: 1,
      input: () => pick(Number(slider.value)) });
    let chosen = 0;
    const draw = () => plot(node, () => picture(found, chosen, (point) => point.data.meta === "front" && pick(point.pointIndex)));
    const choose = (index) => {
      chosen = index;
      slider.value = index;
      show(picked, drawing, found, index);
      return Promise.all([draw(), views.ask(request, carried(found.points[index]))]);
    };
    const pick = (index) => {
      keep("point", index + 1);
      return choose(index);
    };
    body.replaceChildren(...[choice, node,
      h("div", { class: "slide" }, h("label", { for: "pareto-point" }, `Point${ends ? `, from ${ends}` : ""}`), slider),
      found.reason || found.about ? h("p", { class: "about" }, WHY[found.reason] ?? found.about) : null, picked].filter(Boolean));
    const before = Number(kept.point) - 1;
    await choose(found.points[before] ? before : found.knee ?? 0);
  },
};

// {choice, ends, found}: two or three responses, and the front of them
async function traded({ request, kept, schema }, again) {
  const names = (await schema).options("ParetoRequest", "responses").filter((name) => !missing({ needs: NEEDS[name] }, request.machine).length);
  const asked = kept.trade?.split(",") ?? USUAL;
  const traded = [2, 3].includes(new Set(asked).size) && new Set(asked).size === asked.length && asked.every((name) => names.includes(name)) ? asked : USUAL;
  return {
    choice: axes(names, traded, (chosen) => again("trade", chosen.join(","))),
    ends: traded.length === 2 ? `least ${traded[0]} to least ${traded[1]}` : "",
    found: (rest, ask) => frontOf(traded, rest, ask),
  };
}

// the objective is made of the others, and stands beside the mass alone
function beside(made, name) {
  if (name === "objective") return made[0] === name ? [name, "mass"] : ["mass", name];
  if (!made.includes("objective") || (made.length === 2 && made.includes("mass"))) return made;
  const other = [...USUAL, "mass"].find((one) => !made.includes(one));
  return made.map((one) => (one === "objective" ? other : one));
}

// which is traded for which; the one that is chosen twice makes the other give way
function axes(names, traded, chosen) {
  const put = (place, name) => {
    const made = [...traded];
    const other = traded.indexOf(name);
    if (other >= 0) made[other] = traded[place];
    made[place] = name;
    return chosen(beside(made.filter(Boolean), name));
  };
  const select = (place, id, title) => h("div", { class: "choose" }, h("label", { for: id }, title),
    h("select", { id, change: (event) => put(place, event.target.value) }, place === 2 ? h("option", { value: "" }, "nothing else") : null,
      names.map((name) => h("option", { value: name, selected: name === traded[place] }, WORDS[name] ?? name))));
  return h("div", { class: "controls" }, select(0, "trade-x", "Trade"), select(1, "trade-y", "for"), select(2, "trade-z", "and"));
}

// {points: [{values, total_mass_kg, counterweights, gap}], titles, bare, reason, knee}
async function frontOf(traded, request, ask) {
  // weights and the order of goals play no part in a front
  const { bearing_weight: _bearing, bending_weight: _bending, roll_weight: _roll, priorities: _priorities, ...limits } = request.objective ?? {};
  const objective = Object.fromEntries(Object.entries(limits).filter(([, value]) => value !== null));
  const asked = { ...request, ...(request.objective ? { objective } : {}) };
  if (traded.join() === USUAL.join() && !Object.keys(objective).some((name) => PLAIN.test(name))) {
    const answer = await ask("v1/pareto", { ...asked, points: POINTS });
    const [found] = answer.fronts;
    const bare = answer.without_counterweights;
    // where something may be off, the worst case is traded
    const peaks = found.points.map((point) => point.worst_case ?? point);
    const where = found.points.some((point) => point.worst_case) ? " in the worst case" : "";
    return { ...found, titles: [`peak force${where}, N`, `peak moment${where}, N m`], bare: [bare.force.peak_N, bare.moment.peak_Nm],
      points: found.points.map((point, n) => ({ ...point, values: [peaks[n].force_peak_N, peaks[n].moment_peak_Nm] })) };
  }
  const [found] = (await ask("v1/pareto", { ...asked, points: traded.length > 2 ? POINTS_OF_THREE : POINTS_OVER_THE_TURN, responses: traded })).trades;
  // of what is off every value but the mass is the worst
  const worst = found.points.some((point) => point.nominal_values) ? " in the worst case" : "";
  const where = (name) => (name === "mass" ? "" : worst);
  return { ...found, titles: found.responses.map((one) => `${WORDS[one.response] ?? one.response}${where(one.response)}, ${one.unit}`), bare: found.responses.map((one) => one.without_counterweights) };
}

function picture({ points, titles, bare, whole }, chosen, click) {
  const { before, after, mark } = colours();
  const third = titles[2];
  const here = points[chosen].values;
  const of = (axis) => points.map(({ values }) => values[axis]);
  return {
    click,
    traces: [
      { x: of(0), y: of(1), mode: third ? "markers" : "lines+markers", name: "front", meta: "front", line: { color: after },
        marker: third ? { size: 12, color: of(2), colorscale: "Viridis", colorbar: { title: { text: third, side: "right" } } } : { size: 9, color: after },
        customdata: third ? of(2) : points.map(wholeMass),
        hovertemplate: `%{x:.5~s}, %{y:.5~s}, %{customdata:.5~s} ${third ? third.split(", ").at(-1) : "kg"}<extra></extra>` },
      { x: [here[0]], y: [here[1]], mode: "markers", name: "chosen", hoverinfo: "skip",
        marker: { size: 17, symbol: "circle-open", color: mark, line: { width: 3 } } },
      ...bare ? [{ x: [bare[0]], y: [bare[1]], mode: "markers", name: "without counterweights",
        marker: { size: 10, symbol: "x", color: before }, visible: "legendonly" }] : [],
    ],
    layout: { height: 340, xaxis: { title: titles[0], ...whole ? { tickvals: of(0) } : {} }, yaxis: { title: titles[1] } },
    label: `Front of ${points.length} points; chosen: ${titles.map((title, axis) => `${title} ${figure(here[axis])}`).join(" and ")}.`,
  };
}

function show(place, drawing, { points, titles }, index) {
  const point = points[index];
  const weighed = titles.some((title) => title.startsWith(WORDS.mass));
  place.replaceChildren(
    h("h3", {}, `Point ${index + 1} of ${points.length}`),
    table("The chosen point", [...titles, ...(weighed ? [] : ["all counterweights, kg"]), "gap"],
      [[figure(point.values[0]), ...point.values.slice(1).map((value) => number(value)), ...(weighed ? [] : [number(wholeMass(point))]),
        { number: true, text: point.certificate.relative_gap === null ? "none" : share(Math.max(0, point.certificate.relative_gap)) }]]),
    h("div", { class: "beside" }, drawing, fitted(point)));
}

// what is fitted, shaft by shaft
function fitted({ counterweights, balance_shafts: shafts = [] }) {
  if (!shafts.length) return counterweightTable(counterweights);
  return h("div", {}, counterweights.length ? counterweightTable(counterweights) : null,
    shafts.map((shaft) => [h("p", {}, `Balance shaft ${shaft.name}: ${shaft.gearing}`), counterweightTable(shaft.counterweights)]));
}
