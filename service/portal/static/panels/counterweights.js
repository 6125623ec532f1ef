// The counterweights, the limits that hold them back, and what a little more of each limit would be worth.

import { h, table } from "../dom.js";
import { degrees, figure, number } from "../format.js";
import { limited } from "../objective.js";

const LIMITS = {
  max_mass: "mass", envelope: "envelope", max_centrifugal_force: "centrifugal force", sector: "sector", max_total_mass: "limit of the total mass",
  force_ceiling: "ceiling of the force", moment_ceiling: "ceiling of the moment",
  force_ceiling_x: "ceiling of the force along x", force_ceiling_y: "ceiling of the force along y",
  moment_ceiling_x: "ceiling of the couple of the x forces", moment_ceiling_y: "ceiling of the couple of the y forces",
  bearing_ceiling: "ceiling of the bearing loads", specific_load_ceiling: "ceiling of the specific bearing loads",
  bending_ceiling: "ceiling of the bending moment",
};
const worth = ({ value, unit }) => `${figure(value, 4)} ${unit}`;

export function counterweightTable(counterweights, prices = []) {
  const of = (web) => prices.filter((price) => price.web === web);
  const priced = prices.some((price) => price.web);
  return table("Counterweights, angles as drawn at shaft angle 0",
    ["web", "mass, kg", "angle, °", "from its crank, °", "mass × radius, kg m", "at the limit of", ...(priced ? ["shadow price"] : [])],
    counterweights.map((one) => [
      one.web,
      ...(one.mass_kg > 0
        ? [number(one.mass_kg), degrees(one.angle_deg), degrees(one.angle_from_crank_deg), number(one.mass_radius_kg_m)]
        : [{ number: true, text: "none" }, number(null), number(null), number(null)]),
      one.fixed ? "fixed" : one.active_limits.map((limit) => LIMITS[limit] ?? limit).join(", ") || "–",
      ...(priced ? [{ number: true, text: of(one.web).map(worth).join(", ") || "–" }] : []),
    ]));
}

export const counterweights = {
  id: "counterweights", title: "Counterweights, their limits and what these cost", open: true,
  draw(body, { answer }) {
    const prices = answer.shadow_prices ?? [];
    const whole = prices.filter((price) => !price.web);
    const active = answer.active_limits ?? [];
    const named = (limit) => LIMITS[limit] ?? (limit.endsWith("_ceiling") ? `ceiling of the ${limited(limit, answer.residual.responses)}` : limit);
    const fitted = answer.counterweights.length ? answer.counterweights : answer.infeasibility?.closest.counterweights ?? [];
    const shafts = answer.infeasibility?.closest.balance_shafts ?? answer.balance_shafts ?? [];
    body.replaceChildren(...[
      fitted.length ? counterweightTable(fitted, prices)
        : shafts.length ? null : h("p", {}, "This machine has no webs: add one to carry a counterweight."),
      ...shafts.flatMap((shaft) => [
        h("p", {}, `Balance shaft ${shaft.name}: ${shaft.gearing}`), counterweightTable(shaft.counterweights, prices),
      ]),
      active.length || whole.length ? h("ul", {}, active.map((limit) => {
        const price = whole.find((one) => one.limit === limit);
        return h("li", {}, `The ${named(limit)} is reached${price ? `; shadow price ${worth(price)}` : ""}.`);
      })) : null,
      prices.length ? h("p", { class: "about" },
        "A shadow price is by how much the objective would fall for each unit more of a limit, as long as the change is small.") : null,
    ].filter(Boolean));
  },
};
