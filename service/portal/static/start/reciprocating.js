// A reciprocating machine from the answers to a few questions. Nothing in it comes from an example.

import { quantity, read } from "../quantity.js";
import { rounded } from "./answers.js";

const MOST_THROWS = 60;

/**
 * The request; what it lacks is noted in the answers.
 * @param {any} arrangement @param {import("./answers.js").Answers} answers
 * @param {{ rule: string, plates: boolean, bearings: boolean, shafts: string }} chosen
 */
export function reciprocating(arrangement, answers, chosen) {
  const asked = answers.number("throws", "");
  const good = Number.isInteger(asked) && asked >= 1 && asked <= MOST_THROWS;
  if (!good) answers.wrong.add("throws");
  const count = good ? asked : 0;
  const speed = answers.number("speed", "rpm");
  const pitch = answers.number("pitch", "m");
  const place = (index) => rounded((index - (count - 1) / 2) * pitch);
  const throws = throwsOf(arrangement, answers, count, place);
  const webs = websOf(answers, chosen, count, place, pitch);
  const bearings = Array.from({ length: chosen.bearings && count ? count + 1 : 0 }, (_, index) => ({ name: String(index + 1), position_m: place(index - 0.5) }));
  const shafts = shaftsOf(answers, chosen.shafts, count, place);
  const machine = { kind: "reciprocating", speed_rpm: speed, throws, webs, ...(bearings.length ? { bearings } : {}), ...(shafts.length ? { balance_shafts: shafts } : {}) };
  // what turns at twice the speed has no part in the first order
  return { machine, ...(chosen.shafts === "double" ? { objective: { orders: "all" } } : {}) };
}

function throwsOf({ axes, cranks }, answers, count, place) {
  const typed = answers.typed.cranks?.trim();
  const angles = typed ? typed.split(/[\s;]+/).map((one) => quantity(read(one, "deg"), "deg")) : cranks(count || 1);
  if (count && (angles.length !== count || !angles.every(Number.isFinite))) answers.wrong.add("cranks");
  const radius = rounded(answers.number("stroke", "m") / 2);
  const directions = Array.from({ length: count }, (_, index) => axes(index, answers.number("angle", "deg", { needed: false }) ?? 90));
  const total = directions.flat().length;
  const masses = answers.each("reciprocating", "kg", total);
  const rotating = answers.each("rotating", "kg", count);
  const rod = answers.number("rod", "m", { needed: false });
  const split = answers.number("split", "deg", { needed: false });
  const apart = answers.number("offset", "m", { needed: false });
  const turned = (angle) => (((angle % 360) + 360) % 360);
  let row = 0;
  return directions.flatMap((own, index) => {
    const rows = own.map((axis_deg, side) => ({
      axis_deg, ...(apart && split === null ? { offset_m: rounded((side - (own.length - 1) / 2) * apart) } : {}),
      reciprocating_mass_kg: masses[row++], ...(rod === null ? {} : { connecting_rod: { length_m: rod } }),
    }));
    const made = (name, shift, angle, share, some) => ({ name, position_m: rounded(place(index) + shift), crank_radius_m: radius,
      crank_angle_deg: turned(angle), rotating_mass_kg: rounded(rotating[index] / share), rows: some });
    if (split === null) return [made(String(index + 1), 0, angles[index], 1, rows)];
    // a pin for each row: the second stands behind the first, so that its row comes later
    return rows.map((one, side) => made(`${index + 1}.${side + 1}`, (side - (rows.length - 1) / 2) * (apart ?? 0), angles[index] - side * split, rows.length, [one]));
  });
}

function websOf(answers, { rule, plates }, count, place, pitch) {
  if (rule === "none" || !count) return [];
  const room = plates ? { envelope: { shape: "segment", inner_radius_m: answers.number("inner", "m"), outer_radius_m: answers.number("outer", "m"), thickness_m: answers.number("thickness", "m") } }
    : { counterweight_radius_m: answers.number("radius", "m"), max_mass_kg: answers.number("most", "kg", { needed: false }) };
  const beside = (position, name) => ({ name, position_m: rounded(position), ...room });
  if (rule === "ends") return [beside(place(0) - pitch / 4, "front"), beside(place(count - 1) + pitch / 4, "rear")];
  return Array.from({ length: count }, (_, index) => [beside(place(index) - pitch / 4, `${index + 1}a`), beside(place(index) + pitch / 4, `${index + 1}b`)]).flat();
}

// one that turns against the crankshaft, or a pair at twice its speed
function shaftsOf(answers, which, count, place) {
  if (!which || !count) return [];
  const room = { counterweight_radius_m: answers.number("shaftRadius", "m"), max_mass_kg: answers.number("shaftMost", "kg", { needed: false }) };
  const shaft = (name, speed_ratio, planes) => ({ name, speed_ratio, webs: planes.map((position_m, index) => ({ name: planes.length > 1 ? `${name} ${index + 1}` : name, position_m, ...room })) });
  if (which === "double") return [shaft("with it", 2, [place((count - 1) / 2)]), shaft("against it", -2, [place((count - 1) / 2)])];
  return [shaft("against it", -1, count > 1 ? [place(0), place(count - 1)] : [place(0)])];
}
