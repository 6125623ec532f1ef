// What is asked about weighed parts: lines of a table become classes of parts and nuts, and pointers lead back to lines.

import { quantity, read } from "../quantity.js";

/** @typedef {{ kind: string, name: string, mass: string, rows: string }} Line a part as it is typed */
/** @typedef {{ index: number, field: keyof Line, message: string }} Trouble */

const NUT = /^(balance\s+)?nuts?$/i;
const WEIGHED = ["combine", "force_weight", "moment_weight", "direction_weights"];
// what is chosen for a web, which counterweights that are on the machine need no more
const CHOICES = ["catalogue", "max_counterweights", "web_groups", "max_total_mass_kg"];

/** @param {Line} [line] */
export const blank = (line) => !line || !(line.kind.trim() || line.name.trim() || line.mass.trim());
/** @param {Line} line */
export const isNut = (line) => NUT.test(line.kind.trim());
const listed = (text) => text.split(",").map((one) => one.trim()).filter(Boolean);

// every row of the machine, as people call it
export function rowsOf(machine) {
  return [machine.throws ?? []].flat().flatMap((each, t) => [each?.rows ?? []].flat()
    .map((one, r) => ({ throw: t, row: r, label: `${each.name ?? t + 1} ${one?.name ?? r + 1}` })));
}

// as many parts as there are rows, to be weighed
export function toWeigh(machine) {
  return rowsOf(machine).map((_, k) => ({ kind: "crosshead", name: `K${k + 1}`, mass: "", rows: "" }));
}

/**
 * The body of /v1/match, and what is wrong before it is sent.
 * @param {any} request of the page
 * @param {any} answer to it
 * @param {Line[]} lines
 * @param {{ included: boolean, weights: string }} how whether the machine's masses hold the parts; which counterweights
 * @returns {{ body: any, wrong: Trouble[], place: (pointer: string) => { index: number, field: keyof Line } | null }}
 */
export function question(request, answer, lines, how) {
  const machine = structuredClone(request.machine);
  const all = rowsOf(machine);
  /** @type {Trouble[]} */
  const wrong = [];
  const mass = (index) => read(lines[index].mass, "kg");
  const used = lines.map((_, index) => index).filter((index) => !blank(lines[index]));
  for (const index of used) if (!lines[index].mass.trim()) wrong.push({ index, field: "mass", message: "weigh it" });
  const nuts = used.filter((index) => isNut(lines[index]));
  /** @type {Map<string, number[]>} */
  const classes = new Map();
  for (const index of used.filter((one) => !nuts.includes(one))) {
    const kind = lines[index].kind.trim();
    classes.set(kind, [...(classes.get(kind) ?? []), index]);
  }
  const groups = [...classes].map(([kind, indices]) => ({ kind, indices, places: placesOf(indices, lines, all, wrong) }));
  if (how.included) {
    for (const { indices, places } of groups) takeOff(machine, places ?? all, indices.map((index) => quantity(mass(index), "kg")), indices[0], wrong);
  }
  const parts = groups.map(({ kind, indices, places }) => ({
    class: kind, names: indices.map((index) => lines[index].name.trim()), masses_kg: indices.map(mass),
    ...(places ? { rows: places.map((one) => ({ throw: one.throw, row: one.row })) } : {}),
  }));
  const objective = Object.fromEntries(WEIGHED.filter((name) => request.objective?.[name] !== undefined).map((name) => [name, request.objective[name]]));
  const onShafts = (answer.balance_shafts ?? []).flatMap((shaft) => shaft.counterweights);
  const fitted = how.weights === "answer" ? [...answer.counterweights, ...onShafts].filter((one) => one.mass_kg > 0) : [];
  if (how.weights !== "chosen") asTheyAre(machine, answer);
  const body = {
    machine, parts, balance_nuts_kg: nuts.map(mass), objective,
    ...(how.weights === "chosen" ? { choose_counterweights: true }
      : { counterweights: fitted.filter((one) => !one.fixed).map(({ web, mass_kg, angle_deg }) => ({ web, mass_kg, angle_deg })) }),
  };
  return { body, wrong, place: (pointer) => placeOf(pointer, groups, nuts) };
}

// the rows that a class is for: those that some line of it names, null where none does
function placesOf(indices, lines, all, wrong) {
  const named = new Set();
  for (const index of indices) {
    for (const label of listed(lines[index].rows)) {
      const found = all.find((one) => one.label.toLowerCase() === label.toLowerCase());
      if (found) named.add(found);
      else wrong.push({ index, field: "rows", message: `no row is called ${label}; there are ${all.map((one) => one.label).join(", ")}` });
    }
  }
  return named.size ? all.filter((one) => named.has(one)) : null;
}

// the machine without these parts: what a class weighs on average comes off each of its rows
function takeOff(machine, places, masses, index, wrong) {
  const mean = masses.reduce((sum, one) => sum + one, 0) / masses.length;
  if (!Number.isFinite(mean)) return;
  for (const { throw: t, row: r, label } of places) {
    const row = machine.throws[t].rows[r];
    const left = quantity(row.reciprocating_mass_kg, "kg") - mean;
    if (Number.isNaN(left)) wrong.push({ index, field: "kind", message: `row ${label} has no reciprocating mass to take them off` });
    else if (left < 0) wrong.push({ index, field: "mass", message: `they weigh more than the reciprocating mass of row ${label}` });
    else row.reciprocating_mass_kg = left;
  }
}

// webs with the counterweights of the answer, or without any: nothing is chosen for them
function asTheyAre(machine, answer) {
  for (const name of CHOICES) delete machine[name];
  machine.webs = [machine.webs ?? []].flat().map((web) => {
    const found = answer.counterweights.find((one) => one.web === web.name);
    if (web.fixed || !found) return web;
    const { name, position_m, throw: own } = web;
    const radius = found.radius_m ?? web.counterweight_radius_m;
    return { name, position_m, ...(own === undefined ? {} : { throw: own }), counterweight_radius_m: radius, max_mass_kg: null };
  });
}

/** @returns {{ index: number, field: keyof Line } | null} */
function placeOf(pointer, groups, nuts) {
  const [, list, at, name, k] = pointer.split("/");
  if (list === "balance_nuts_kg" && nuts[Number(at)] !== undefined) return { index: nuts[Number(at)], field: "mass" };
  const group = list === "parts" ? groups[Number(at)] : undefined;
  if (!group) return null;
  const index = group.indices[Number(k ?? 0)] ?? group.indices[0];
  if (name === "masses_kg") return { index, field: "mass" };
  if (name === "rows") return { index: group.indices[0], field: "rows" };
  return { index, field: name === "class" ? "kind" : "name" };
}
