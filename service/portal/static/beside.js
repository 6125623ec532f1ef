// What stands beside the answer: what goals came to in their order, and what happens where things are off.

import { table } from "./dom.js";
import { figure, number } from "./format.js";

const GOALS = { external: "force and moment", bearings: "bearing loads", bending: "bending moment" };

export function beside({ certificate, worst_case: worst, price_of_robustness: price, sensitivity }) {
  const found = [];
  if (certificate?.goals?.length) {
    found.push(table("Goals in their order, before the last", ["goal", "value", "lower bound", "allowance", "kept below"],
      certificate.goals.map((one) => [GOALS[one.goal], number(one.value), number(one.lower_bound), number(one.limit - one.value), number(one.limit)])));
  }
  if (worst) {
    const rows = [["peak force, N", worst.force_peak_N], ["peak moment, N m", worst.moment_peak_Nm], ["largest bearing load, N", worst.bearing_peak_N],
      ["objective", worst.objective], ["best for the machine as given, there", price?.nominal_optimum_worst_case]];
    found.push(table("In the worst of all cases", ["what", "at most"], rows.filter(([, value]) => value !== null && value !== undefined).map(([name, value]) => [name, number(value)])));
  }
  if (sensitivity) {
    found.push(table("If all counterweights are off together, whichever way is worst", ["by", "the objective rises by at most"], [
      ["one degree", { number: true, text: figure(sensitivity.objective_rise_per_deg) }],
      ["one per cent of their mass", { number: true, text: figure(sensitivity.objective_rise_per_percent) }]]));
  }
  return found;
}
