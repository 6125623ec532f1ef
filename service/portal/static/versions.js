// Versions of machines under names, kept in this browser: what was asked and what came of it.

import { carried, wholeMass } from "./fitted.js";
import { responses } from "./responses.js";

const PLACE = "counterweight-versions";
const FIELDS = ["name", "at", "request", "result"];

export function versions() {
  try {
    const found = JSON.parse(localStorage.getItem(PLACE) ?? "[]");
    return Array.isArray(found) ? found.filter((one) => one && FIELDS.every((field) => field in one)) : [];
  } catch {
    return [];
  }
}

// whether there was room
export function keepVersions(list) {
  try {
    localStorage.setItem(PLACE, JSON.stringify(list));
    return true;
  } catch {
    return false;
  }
}

export const resultOf = (request, answer) => ({
  status: answer.status, total_mass_kg: wholeMass(answer),
  responses: responses(request, answer).map(({ name, unit, after }) => ({ name, unit, value: after })),
  counterweights: carried(answer).map(({ web, mass_kg, angle_deg }) => ({ web, mass_kg, angle_deg })),
});

// what came of a version; those that were kept before there were responses have two peaks
export const responsesOf = ({ responses: kept, force_peak_N: force, moment_peak_Nm: moment }) => kept
  ?? [{ name: "force", unit: "N", value: force }, { name: "moment", unit: "N m", value: moment }];

// [[pointer, value of each], ...] where requests differ
export function differences(requests) {
  const flat = requests.map((request) => new Map(leaves(request, "")));
  const pointers = [...new Set(flat.flatMap((one) => [...one.keys()]))];
  return pointers.map((pointer) => [pointer, flat.map((one) => one.get(pointer))])
    .filter(([, values]) => values.some((value) => value !== values[0]));
}

function leaves(value, pointer) {
  if (value === null || typeof value !== "object") return [[pointer, value]];
  return Object.entries(value).flatMap(([name, inner]) => leaves(inner, `${pointer}/${name}`));
}
