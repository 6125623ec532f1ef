// What a machine answers, without counterweights and with them: every response that was weighed or limited.

import { figure, share } from "./format.js";
import { scales } from "./scales.js";

// what is below this share of what there was is rounding: a moment is found to a millionth of the force times the span
const DUST = 1e-5;

// a component along an axis that grows by more than a hundredth, and is more than a thousandth of all, is told
const [GROWN, SEEN] = [1.01, 1e-3];

const largest = (values) => (values.every((value) => typeof value === "number") ? Math.max(...values) : null);
const set = (value) => value !== undefined && value !== null && value !== 0;

/**
 * `after` is null where nothing was found; `grown`: components along an axis that grow come along.
 * @param {any} request @param {any} answer @param {{ grown?: boolean }} [which]
 * @returns {{ name: string, unit: string, before: number, after: number | null }[]}
 */
export function responses({ machine, objective = {} }, answer, which = {}) {
  const { residual, main_bearings: shaft, roll } = answer;
  const { before, after } = residual;
  const scale = scales(machine, answer);
  const turn = residual.turn;
  const ofBearings = (of) => (when) => (shaft.bearings.every((one) => one[when]) ? largest(shaft.bearings.map((one) => one[when][of])) : null);
  const row = (name, unit, of, size = 0) => {
    const [was, now] = [of("before"), of("after")];
    // a residue of rounding is nothing
    return { name, unit, before: was, after: now !== null && Math.abs(now) < DUST * Math.max(was, size) ? 0 : now };
  };
  const state = { before, after };
  const along = (part, axis, unit) => (when) => state[when]?.[part][`peak_${axis}_${unit}`] ?? null;
  // what is limited, and what grows although the whole does not
  const grown = (one) => (one.after ?? 0) > GROWN * one.before && one.after > SEEN * (one.unit === "N" ? scale.force : scale.moment);
  const axes = ["x", "y"].flatMap((axis) => [
    { ceiling: `force_ceiling_${axis}_N`, one: row(`force along ${axis}`, "N", along("force", axis, "N"), scale.force) },
    { ceiling: `moment_ceiling_${axis}_Nm`, one: row(`couple of the ${axis} forces`, "N m", along("moment", axis, "Nm"), scale.moment) }])
    .map(({ ceiling, one }) => (objective[ceiling] !== undefined || (which.grown && one.before !== null && grown(one)) ? one : null));
  return /** @type {any[]} */ ([
    row("force", "N", (when) => state[when]?.force.peak_N ?? null, scale.force),
    row("moment", "N m", (when) => state[when]?.moment.peak_Nm ?? null, scale.moment),
    ...axes,
    objective.orders === "all" && turn ? row("force of all orders", "N", (when) => turn[when]?.force_peak_N ?? null, scale.force) : null,
    objective.orders === "all" && turn ? row("moment of all orders", "N m", (when) => turn[when]?.moment_peak_Nm ?? null, scale.moment) : null,
    ...(residual.responses ?? []).flatMap((one) => [row(one.label, one.unit, (when) => one[when]),
      one.turn_before === null ? null : row(`${one.label} of all orders`, one.unit, (when) => one[`turn_${when}`])]),
    shaft ? row("bearing load", "N", ofBearings("peak_N")) : null,
    shaft && objective.bearing_measure === "rms" ? row("root mean square of a bearing load", "N", ofBearings("rms_N")) : null,
    shaft && (objective.bearing_measure === "specific" || set(objective.specific_load_ceiling_Pa)) ? row("specific bearing load", "Pa", ofBearings("specific_load_Pa")) : null,
    shaft ? row("bending moment", "N m", (when) => (shaft.bending[`${when}_Nm`] ? largest(shaft.bending[`${when}_Nm`]) : null)) : null,
    roll && set(objective.roll_weight) ? row("roll moment", "N m", (when) => roll[when]?.peak_Nm ?? null) : null,
  ]).filter((one) => one !== null && one.before !== null);
}

// how a response has changed, in words; "" where it has not
export function change({ name, unit, before, after }) {
  if (after === null || Math.abs(after - before) <= 5e-5 * before || (after === 0 && before === 0)) return "";
  if (before < DUST * after) return `${name} ${figure(before < 1e-9 * after ? 0 : before)} → ${figure(after)} ${unit}`;
  return `${name} ${after > before ? "+" : "−"}${share(Math.abs(after / before - 1))}`;
}
