// When the cylinders fire: the outer dead centres from which their pressures count, from an order.

import { nameOf } from "../format.js";
import { quantity } from "../quantity.js";

const TURN = 360;
const wrapped = (angle, cycle) => Number((((angle % cycle) + cycle) % cycle).toPrecision(10));

/** All rows in the order of the tables, each with the shaft angle of its first outer dead centre. */
export function cylindersOf(machine) {
  const sense = machine.rotation === "cw" ? -1 : 1;
  return [machine.throws ?? []].flat().flatMap((each, t) => [each?.rows ?? []].flat().map((row, r, rows) => ({
    pointer: `/machine/throws/${t}/rows/${r}`, row,
    name: rows.length > 1 ? `${nameOf(each, t)} ${nameOf(row, r)}` : nameOf(each, t),
    first: wrapped(sense * (quantity(row?.axis_deg, "deg") - quantity(each?.crank_angle_deg, "deg")), TURN),
  })));
}

// indices of cylinders from an order such as 1-5-3-6-2-4, or why there are none
/** @returns {{ places?: number[], wrong: string }} */
function orderOf(text, cylinders) {
  const count = cylinders.length;
  const words = text.trim().split(/[\s,;–-]+/).filter(Boolean);
  const single = words.length === 1 && words[0].length === count && count < 10 ? [...words[0]] : words;
  const places = single.map((word) => (/^\d+$/.test(word) ? Number(word) - 1 : cylinders.findIndex(({ name }) => name.toLowerCase() === word.toLowerCase())));
  const unknown = single.filter((_, index) => !cylinders[places[index]]);
  if (unknown.length) return { wrong: `There is no cylinder ${unknown.join(", ")}: they are counted from 1 to ${count}, throw by throw.` };
  const twice = single.filter((_, index) => places.indexOf(places[index]) !== index);
  if (twice.length) return { wrong: `Cylinder ${twice.join(", ")} fires twice in this order.` };
  const left = cylinders.map((_, index) => index).filter((index) => !places.includes(index)).map((index) => index + 1);
  return left.length ? { wrong: `Cylinder ${left.join(", ")} is not in this order.` } : { places, wrong: "" };
}

/**
 * Dead centres of all cylinders, degrees: each fires at its next outer dead centre after the one before it.
 * @returns {{ centres?: number[], wrong: string }}
 */
export function firing(order, cylinders, turns) {
  const cycle = TURN * turns;
  if (!cylinders.every(({ first }) => Number.isFinite(first))) return { wrong: "Give the crank angles and the axes of the rows first." };
  if (turns === 1) return { centres: cylinders.map(({ first }) => first), wrong: "" };
  if (!order.trim()) return { wrong: "Give the firing order: each cylinder has two outer dead centres in two revolutions." };
  const { places, wrong } = orderOf(order, cylinders);
  if (!places) return { wrong };
  /** @type {number[]} */
  const centres = [];
  let last = -Infinity;
  for (const place of places) {
    const { first } = cylinders[place];
    const next = last === -Infinity ? first : first + TURN * Math.max(0, Math.floor((last - first) / TURN + 1e-9) + 1);
    if (next - cylinders[places[0]].first >= cycle - 1e-6) return { wrong: `In this order cylinder ${place + 1} would fire after more than two revolutions: its crank does not allow it.` };
    centres[place] = wrapped(next, cycle);
    last = next;
  }
  return { centres, wrong: "" };
}

// offsets as they were typed, one for each cylinder
export function offsets(text, cylinders) {
  const words = text.trim().split(text.includes(";") ? /;/ : /[\s,;]+/).map((word) => Number(word.trim().replace(",", ".")));
  return words.length === cylinders.length && words.every(Number.isFinite) ? { centres: words, wrong: "" }
    : { wrong: `Give ${cylinders.length} angles, one for each cylinder in the order of the rows.` };
}
