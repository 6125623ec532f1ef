// What stands beside the answer: what goals came to in their order, and what happens where things are off.

import { table } from "./dom.js";
import { figure, number, share } from "./format.js";

const GOALS = { external: "force and moment", bearings: "bearing loads", bending: "bending moment", mass: "total mass, kg", pieces: "counterweights", sizes: "different masses" };
const LEAST = { mass: "least mass", pieces: "fewest counterweights", sizes: "fewest different masses" };

// the best choice and the cheaper ones, each with what it gives up of the objective
function decision({ alternatives, certificate, counterweights, total_mass_kg: own, balance_shafts_mass_kg: onShafts }) {
  const best = certificate.objective;
  const masses = counterweights.filter((one) => one.mass_kg > 0 && !one.fixed).map((one) => one.mass_kg);
  const counted = (value) => ({ number: true, text: String(value) });
  const rows = alternatives.map((one) => {
    const own = { mass: one.total_mass_kg, pieces: one.pieces, sizes: one.sizes }[one.minimised];
    const proven = one.lower_bound !== null && one.lower_bound >= own * (1 - 1e-9) ? "proven least" : one.lower_bound === null ? "nothing proven"
      : `found; none is below ${figure(one.lower_bound)}`;
    return [`${LEAST[one.minimised]} within ${share(one.allowance)}`, number(one.objective),
      { number: true, text: best > 0 ? share(Math.max(one.objective / best - 1, 0)) : "–" }, number(one.total_mass_kg), counted(one.pieces), counted(one.sizes), proven];
  });
  return table("The best choice, and cheaper ones", ["option", "objective", "rises by", "mass, kg", "pieces", "sizes", "cost"],
    [["best objective", number(best), { number: true, text: "–" }, number(own + (onShafts ?? 0)), counted(masses.length), counted(new Set(masses).size), "–"], ...rows]);
}

export function beside(answer) {
  const { certificate, worst_case: worst, price_of_robustness: price, sensitivity } = answer;
  const found = answer.alternatives?.length ? [decision(answer)] : [];
  if (certificate?.goals?.length) {
    found.push(table("Goals in their order", ["goal", "value", "lower bound", "allowance", "kept below"],
      certificate.goals.map((one) => [GOALS[one.goal], number(one.value), number(one.lower_bound), number(one.limit - one.value), number(one.limit)])));
  }
  if (worst) {
    const rows = [["peak force, N", worst.force_peak_N], ["peak moment, N m", worst.moment_peak_Nm], ...(worst.responses ?? []).map((one) => [`peak ${one.label}, ${one.unit}`, one.peak]),
      ["largest bearing load, N", worst.bearing_peak_N], ["objective", worst.objective], ["best for the unchanged machine, there", price?.nominal_optimum_worst_case]];
    found.push(table("In the worst of all cases", ["what", "at most"], rows.filter(([, value]) => value !== null && value !== undefined).map(([name, value]) => [name, number(value)])));
  }
  if (sensitivity) {
    found.push(table("If all counterweights are off together, whichever way is worst", ["by", "the objective rises by at most"], [
      ["one degree", { number: true, text: figure(sensitivity.objective_rise_per_deg) }],
      ["one per cent of their mass", { number: true, text: figure(sensitivity.objective_rise_per_percent) }]]));
  }
  return found;
}
