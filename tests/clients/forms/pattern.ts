// What a client in TypeScript makes of the schema: a quantity is a number or a text, and nothing is unknown.

import type { components } from "./service.ts";

type Schemas = components["schemas"];
type Same<One, Other> = (<T>() => T extends One ? 1 : 2) extends (<T>() => T extends Other ? 1 : 2) ? true : false;

/** Whatever the service takes as a quantity: 0.09, or "90 mm". */
export type Quantity = number | string;

export const quantity: Same<Schemas["Throw"]["crank_radius_m"], Quantity> = true;
export const orNull: Same<Schemas["Bearing"]["diameter_m"], Quantity | null | undefined> = true;
export const list: Same<Schemas["Parts"]["masses_kg"], Quantity[]> = true;
export const answered: Same<Schemas["OptimizeAnswer"]["total_mass_kg"], number | null> = true;

export const machine: Schemas["ReciprocatingMachine"] = {
  kind: "reciprocating",
  speed_rpm: "500 rpm",
  throws: [{ position_m: 0, crank_radius_m: "140 mm", crank_angle_deg: 0, rows: [{ axis_deg: 0, reciprocating_mass_kg: 100 }] }],
  webs: [{ name: "1a", position_m: 0.1, counterweight_radius_m: "9 in", max_mass_kg: null }],
};

// @ts-expect-error a radius is neither true nor false
export const wrong: Schemas["Throw"]["crank_radius_m"] = true;
// @ts-expect-error rows have types of their own
export const unknown: Schemas["Row"] = { axis: 0 };
