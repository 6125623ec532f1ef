// What was asked to be small, and what came of it where that is more than force and moment of the first order.

import { figure } from "./format.js";

const GOALS = { external: "force and moment", bearings: "the largest bearing load", bending: "the largest bending moment" };
// goals that are no part of the objective: what the counterweights cost
export const COSTS = ["mass", "pieces", "sizes"];
const MEASURES = { rms: "the largest root mean square of a bearing load", specific: "the largest specific bearing load" };

export const CEILINGS = {
  force_ceiling_N: "force", force_ceiling_x_N: "force along x", force_ceiling_y_N: "force along y",
  moment_ceiling_Nm: "moment", moment_ceiling_x_Nm: "couple of the x forces", moment_ceiling_y_Nm: "couple of the y forces", bearing_ceiling_N: "bearing loads",
  specific_load_ceiling_Pa: "specific bearing loads", bending_ceiling_Nm: "bending moment",
};

// what a ceiling is of; an answer names the responses that count beside force and moment
export const limited = (field, others = []) => CEILINGS[field] ?? others.find(({ response }) => field.startsWith(`${response}_ceiling`))?.label ?? field;

// the objective of the certificate in words
export function weighed(objective = {}, others = []) {
  const { combine, orders, force_weight: force = 1, moment_weight: moment = null, bearing_measure: measure,
    bearing_weight: bearing = 0, bending_weight: bending = 0, roll_weight: roll = 0, priorities = [] } = objective;
  const all = orders === "all" ? " of all orders" : "";
  const bearings = MEASURES[measure] ?? GOALS.bearings;
  const goals = priorities.map(({ goal }) => goal).filter((goal) => !COSTS.includes(goal));
  if (goals.length) {
    const words = goals.map((goal) => (goal === "external" ? `the weighted peaks of force${roll ? ", moment and roll" : " and moment"}${all}` : goal === "bearings" ? bearings : GOALS[goal]));
    return words.length > 1 ? `${words.at(-1)}, after ${words.slice(0, -1).join(" and ")},` : words[0];
  }
  const parts = [...(force === 0 ? [] : ["peak force"]), ...(moment === 0 ? [] : ["peak moment"])].map((part) => `${part}${all}`);
  const more = others.filter(({ response }) => objective[`${response}_weight`]).map(({ label }) => `peak ${label}${all}`);
  parts.push(...more);
  if (roll) parts.push("the roll moment");
  if (bearing) parts.push(bearings);
  if (bending) parts.push(GOALS.bending);
  if (!bearing && !bending && !roll && !more.length && parts.length === 2 && !all) {
    return combine === "max" ? "the larger of the weighted peaks" : "the weighted sum of peak force and peak moment";
  }
  if (parts.length === 1) return parts[0].replace(/^peak/, "the peak");
  const listed = `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}`;
  return combine === "max" ? `the largest, weighted, of ${listed}` : `the weighted sum of ${listed}`;
}

// [[name, before, after, floor]]: largest bearing load and bending moment, where the answer has them
export function ofTheShaft({ main_bearings: found }) {
  if (!found) return [];
  const { bearings, bending } = found;
  const largest = (numbers) => (numbers ? Math.max(...numbers) : null);
  const after = bearings.every((one) => one.after) ? bearings.map((one) => one.after.peak_N) : null;
  return [
    ["bearing load", "N", largest(bearings.map((one) => one.before.peak_N)), largest(after), largest(bearings.map((one) => one.before.floor_N))],
    ["bending moment", "N m", largest(bending.before_Nm), largest(bending.after_Nm), bending.floor_Nm],
  ];
}

// which ceilings cannot be met, and how far what is limited can come down
export function refusal({ objective, scenarios, tolerances }, { conflict, smallest, smallest_force_N: force, smallest_moment_Nm: moment, closest }) {
  const { force: nearForce, moment: nearMoment } = closest.first_order;
  const names = conflict.map((field) => limited(field, closest.responses));
  const [mostForce, mostMoment] = [objective?.force_ceiling_N, objective?.moment_ceiling_Nm];
  const asked = [mostForce == null ? null : `${written(mostForce, "N")} of force`, mostMoment == null ? null : `${written(mostMoment, "N m")} of moment`].filter(Boolean);
  // of the compromise the answer has the first order of the unchanged machine, which may be below them
  const worst = scenarios?.length || Object.values(tolerances ?? {}).some((off) => off) ? "in the worst case " : "";
  const every = objective?.orders === "all" ? " of all orders" : "";
  // what has no ceiling is not computed
  const reach = [force == null ? null : `the peak force${every} can ${worst}come down to ${figure(force)} N`,
    moment == null ? null : `the peak moment${every} can ${worst}come down to ${figure(moment)} N m`].filter(Boolean);
  return [
    names.length > 1 ? `The ceilings of ${names.join(" and ")} cannot be met, alone or together.` : `The ceiling of the ${names[0]} cannot be met.`,
    ...(asked.length && reach.length ? [`Within these limits ${reach.join(" and ")} (all else left free); ${asked.length > 1 ? "the ceilings ask" : "the ceiling asks"} for ${asked.join(" and ")}.`] : []),
    ...(smallest ?? []).map((one) => {
      // a specific load is told as the load of its bearing
      const unit = one.ceiling_field.endsWith("_Nm") ? "N m" : "N";
      return `By itself the ${one.response.replace(":", " ")} can ${worst}come down to ${figure(one.smallest)} ${unit}; the ceiling of the ${limited(one.ceiling_field, closest.responses)} asks for ${figure(one.ceiling)} ${unit}.`;
    }),
    `Drawn is the closest compromise: ${figure(nearForce.peak_N)} N and ${figure(nearMoment.peak_Nm)} N m of first order${worst ? " on the unchanged machine" : ""}.`,
  ];
}

// a number as asked, or the text with its unit
const written = (value, unit) => (typeof value === "number" ? `${figure(value)} ${unit}` : value);
