// What stands in the tables of throws, rows, webs, bearings and fitted weights: paths from the item, in the order of a spreadsheet.

import { label } from "../format.js";

const THROWS = { item: "throw", title: "throws", columns: ["name", "position_m", "crank_radius_m", "crank_angle_deg", "rotating_mass_kg"], groups: {} };
const ROWS = {
  item: "row", title: "rows",
  groups: {
    offsets: ["offset_m"],
    cylinders: ["bore_m", "piston_rod_diameter_m", "acting", "suction_pressure_Pa", "discharge_pressure_Pa", "relative_clearance", "expansion_exponent", "compression_exponent", "ambient_pressure_Pa"].map((name) => `cylinder/${name}`),
  },
  columns: ["name", "axis_deg", "reciprocating_mass_kg", "connecting_rod/length_m", "connecting_rod/mass_kg", "connecting_rod/reciprocating_share"],
};
const WEBS = {
  item: "web", title: "webs", columns: ["name", "position_m", "counterweight_radius_m", "max_mass_kg"],
  groups: {
    sectors: ["sector/centre_deg", "sector/half_angle_deg"],
    envelopes: ["envelope/shape", "envelope/inner_radius_m", "envelope/outer_radius_m", "envelope/thickness_m", "envelope/max_half_angle_deg"],
  },
};
const BEARINGS = { item: "bearing", title: "main bearings", columns: ["name", "position_m", "diameter_m", "length_m"], groups: {} };
const FITTED = { item: "weight", title: "fitted counterweights", columns: ["web", "mass_kg", "angle_deg"], groups: {} };
/** @type {[RegExp, { item: string, title: string, columns: string[], groups: { [name: string]: string[] } }][]} */
const TABLES = [
  [/^\/machine\/throws\/\d+\/rows$/, ROWS], [/^\/machine\/throws$/, THROWS],
  [/^\/machine(?:\/balance_shafts\/\d+)?\/webs$/, WEBS],
  [/^\/machine\/bearings$/, BEARINGS], [/^\/fitted$/, FITTED],
];
const ITEM = /^(.*)\/(\d+)\/([^\d].*)$/;

// the table of a list, null where it has none
export const tableAt = (pointer) => TABLES.find(([pattern]) => pattern.test(pointer))?.[1] ?? null;

// [list, path from its item] of a pointer below the item of a table
export function inTable(pointer) {
  const [, list, , path] = ITEM.exec(pointer) ?? [];
  const found = list && tableAt(list);
  return found ? { table: found, path } : null;
}

// the columns of a table with what the schema says of each; groups only where they are used
export function columnsOf(schema, object, table, shown) {
  const paths = [...table.columns, ...Object.entries(table.groups).filter(([name]) => shown.has(name)).flatMap(([, group]) => group)];
  return paths.map((path) => ({ path, ...described(schema, object, path.split("/")) }));
}

/** @returns {any} */
function described(schema, object, path, before = []) {
  const [first, ...rest] = path;
  const description = schema.describe(object.properties[first]);
  const around = [...before, first];
  if (rest.length) return described(schema, description, rest, around);
  const head = [...around.slice(0, -1).map((name) => name.replace("connecting_rod", "rod")).filter((name) => name !== "cylinder"), label(first)].join(" ");
  return { ...description, name: first, head, optional: before.length > 0, mandatory: object.required.has(first) };
}
