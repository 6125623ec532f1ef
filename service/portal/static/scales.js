// How large force and moment are on a machine: what is a billionth of that is rounding.

import { metres } from "./drawing/view.js";
import { quantity } from "./quantity.js";

// {force, moment} [N, N m]: the larger of what there was before and what the counterweights do one by one
export function scales(machine, answer) {
  const { force, moment } = answer.residual.before;
  const omega = (quantity(machine.speed_rpm, "rpm") * Math.PI) / 30;
  const places = new Map((machine.webs ?? []).map((web) => [web.name, metres(web.position_m) - answer.reference_plane_m]));
  const forces = answer.counterweights.map((one) => ({ size: one.mass_radius_kg_m * omega * omega, arm: Math.abs(places.get(one.web)) }));
  return {
    force: Math.max(force.peak_N, ...forces.map(({ size }) => size).filter(Number.isFinite)),
    moment: Math.max(moment.peak_Nm, ...forces.map(({ size, arm }) => size * arm).filter(Number.isFinite)),
  };
}

// The range of an axis on which rounding does not look like a result; none where there is something to see.
export const calm = (peak, scale) => (peak > 1e-5 * scale || !(scale > 0) ? {} : { range: [-scale, scale] });
