// The number of counterweights, of part numbers, or their mass, against what so few come to: of machines that choose from what there is.

import { h } from "../dom.js";

// with none at all, and up to as many as are of use
const POINTS = 12;
const OF = { weights: "counterweights", part_numbers: "part numbers", mass: "kilograms" };
const LEAST = { objective: "least objective", mass: "minimum total mass, kg" };

export const chosenFrom = (machine) => (machine.catalogue ?? machine.max_counterweights ?? null) !== null
  || (machine.webs ?? []).some((web) => web.catalogue_masses_kg || web.hole_angles_deg);

// {choice, titles, ends, ask}: what is counted, and what is least at every number
export function counted(context, again) {
  const { request, kept } = context;
  // without a ceiling the least mass is none
  const limited = Object.entries(request.objective ?? {}).some(([name, value]) => name.includes("_ceiling_") && value !== null);
  const [of, least] = kept.count?.split(",") ?? [];
  const count = OF[of] ? of : "weights";
  const both = limited && count !== "mass";
  const lessened = both && LEAST[least] ? least : "objective";
  const select = (id, title, words, value, chosen) => h("div", { class: "choose" }, h("label", { for: id }, title),
    h("select", { id, change: (event) => chosen(event.target.value) },
      Object.entries(words).map(([name, text]) => h("option", { value: name, selected: name === value }, text))));
  const choice = h("div", { class: "controls" },
    select("count-of", "At most so many", OF, count, (name) => again("count", `${name},${lessened}`)),
    select("count-least", "for", both ? LEAST : { objective: LEAST.objective }, lessened, (name) => again("count", `${count},${name}`)));
  return count === "mass" ? { choice, ends: "lightest to best", found: weighed }
    : { choice, ends: "fewest to most", found: (rest, ask) => front(count, lessened, rest, ask) };
}

// the objective against the mass
async function weighed(request, ask) {
  const [found] = (await ask("v1/pareto", { ...request, points: POINTS, responses: ["mass", "objective"] })).trades;
  return {
    titles: ["total mass, kg", LEAST.objective], bare: null,
    about: found.status === "inaccurate" ? "The time ended some searches before the asked gap: each says its own." : "",
    points: found.points,
  };
}

async function front(of, least, request, ask) {
  const [found] = (await ask("v1/pareto", { ...request, points: POINTS, counts: { of, least } })).counts;
  const kept = found.points.filter((one) => one.value !== null);
  const none = found.points.filter((one) => one.value === null).map((one) => one.at_most);
  return {
    titles: [`at most so many ${OF[of]}`, LEAST[least]], bare: null, whole: true,
    about: [none.length ? `No set of ${none.join(", ")} keeps the ceilings.` : "", found.status === "inaccurate" ? "The time ended some searches before the asked gap: each says its own." : ""].filter(Boolean).join(" "),
    points: kept.map((one) => ({ ...one, values: [one.at_most, one.value], certificate: { relative_gap: one.relative_gap } })),
  };
}
