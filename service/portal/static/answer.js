// The answer in one view: what was reached, the proof in plain words, the drawing.

import { beside as tables } from "./beside.js";
import { h, table } from "./dom.js";
import { wholeMass } from "./fitted.js";
import { beside, figure, number, share } from "./format.js";
import { COSTS, ofTheShaft, refusal, weighed } from "./objective.js";
import { order } from "./order.js";
import { reports } from "./report.js";
import { change, responses } from "./responses.js";
import { scales } from "./scales.js";

export function showAnswer(place, request, answer, outputs, drawings) {
  const { counterweights: fitted, balance_shafts: shafts } = found(answer);
  // what keeps no ceilings is nothing to fit
  const title = answer.infeasibility ? "The closest compromise, which does not keep the ceilings" : undefined;
  place.replaceChildren(
    h("h2", { class: `status ${answer.status}` }, headline(request, answer)),
    ...(fitted.length ? [order(fitted, null, title)] : []),
    ...(shafts ?? []).map((shaft) => order(shaft.counterweights, shaft.name, title)),
    drawings,
    h("div", { class: "proof" }, proof(request, answer).map((sentence) => h("p", {}, sentence))),
    h("div", { class: "cautions" }, (answer.warnings ?? []).map((warning) => h("p", {}, warning.message))),
    ...comparison(request, answer),
    ...tables(answer),
    reports(request, outputs));
}

// what was found, or the closest compromise where the ceilings cannot be met
export const found = (answer) => (answer.counterweights.length ? answer : answer.infeasibility?.closest ?? answer);

// what got worse is said as what got better is
function headline(request, answer) {
  const { status } = answer;
  if (status === "infeasible") return "No counterweights meet these ceilings";
  const changes = responses(request, answer, { grown: true }).map(change).filter(Boolean).join(", ");
  return `${figure(wholeMass(answer))} kg of counterweights: ${changes || "nothing changes"}`;
}

// An engineer's sentences, from the certificate.
function proof(request, answer) {
  const { status, certificate, infeasibility, floor, timing, residual } = answer;
  if (infeasibility) return refusal(request, infeasibility);
  const { objective, lower_bound: bound, relative_gap: gap, objective_without_counterweights: bare } = certificate;
  const how = weighed(request.objective, residual.responses);
  const small = 1e-6 * bare;
  const sentences = [];
  if (bare === 0) sentences.push("Nothing of first order is out of balance: no counterweights are needed.");
  else if (objective <= small) sentences.push(`These counterweights cancel ${how} completely. It was ${figure(bare)} without them.`);
  else if (bound === null) sentences.push(`Nothing is proven of these counterweights: ${figure(objective, 8)}, without any ${figure(bare, 8)}.`);
  else {
    sentences.push(`No counterweights within these limits can bring ${how} below ${figure(bound, 8)}; `
      + `these come to ${figure(objective, 8)}. The gap is ${gap === null ? "not known" : share(Math.max(0, gap))}. Without counterweights it is ${figure(bare, 8)}.`);
  }
  const costs = (certificate.goals ?? []).filter((one) => COSTS.includes(one.goal));
  if (costs.length) sentences.push("The gap holds what the goals before leave to those after them; the table below says what is proven of each.");
  if (status === "inaccurate" && costs.length) sentences.push("One of the goals is not proven as closely as was asked.");
  else if (status === "inaccurate") sentences.push("That gap is wider than was asked for: take the figure as it stands, not as the optimum.");
  if (certificate.mass_lower_bound_kg > 0) {
    sentences.push(`Of all that are as good, none weighs less than ${figure(certificate.mass_lower_bound_kg, 7)} kg; these weigh ${figure(wholeMass(answer), 7)} kg.`);
  }
  const { force, moment } = residual.before;
  const rest = [floor.force_N > 1e-9 * force.peak_N ? `${figure(floor.force_N)} N of force` : null,
    floor.moment_Nm > 1e-9 * moment.peak_Nm ? `${figure(floor.moment_Nm)} N m of moment` : null].filter(Boolean);
  if (rest.length) sentences.push(`${rest.join(" and ")} turn${rest.length > 1 ? "" : "s"} against the shaft, which no counterweight on it can lower.`);
  sentences.push(`Computed in ${figure(timing.total_ms, 3)} ms (${certificate.method}).`);
  return sentences;
}

function comparison(request, answer) {
  const { residual, floor, infeasibility } = answer;
  const { before } = residual;
  const after = residual.after ?? infeasibility?.closest.first_order;
  const scale = scales(request.machine, answer);
  const cells = (name, part, unit, least) => [name,
    ...[before[part][unit], after[part][unit], least].map((value) => ({ number: true, text: beside(value, scale[part]) }))];
  const heads = ["", "before", "after", "floor"];
  const shaft = ofTheShaft(answer).map(([what, unit, ...values]) => [`largest ${what}, ${unit}`, ...values.map((value) => number(value))]);
  return [
    table("First order, over a revolution of the shaft", heads, [
      cells("peak force, N", "force", "peak_N", floor.force_N),
      cells("peak moment, N m", "moment", "peak_Nm", floor.moment_Nm),
    ]),
    ...(shaft.length ? [table("All orders with gas and friction, over a revolution of the shaft", heads, shaft)] : []),
  ];
}
