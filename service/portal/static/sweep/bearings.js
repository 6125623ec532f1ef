// Bearing loads over the speed, of the machine with the counterweights that were found: one click.

import { figure } from "../format.js";
import { scene } from "../panels/dynamics.js";
import { quantity } from "../quantity.js";
import { line, plot, series } from "../plots.js";

const COUNT = 31;
// from a fifth of the speed to what the machine may reach, or a fifth above
const [SLOWEST, FASTEST] = [0.2, 1.2];
const COLUMN = "bearing_peak_N.";
const SPEED = "/machine/speed_rpm";

export const overSpeed = (machine) => machine.kind === "reciprocating" && (machine.bearings ?? []).length > 1;

/** The question: the machine as it stands at so many speeds. */
export function speeds(context) {
  const { machine } = context.request;
  const speed = quantity(machine.speed_rpm, "rpm");
  const most = Math.max(quantity(machine.overspeed_rpm ?? 0, "rpm") || 0, FASTEST * speed);
  const { angles: _angles, ...base } = scene(context, ["main_bearings"]);
  return { task: "analyze", base, axes: [{ path: SPEED, start: Number((SLOWEST * speed).toPrecision(6)), stop: Number(most.toPrecision(6)), count: COUNT }], design: "grid" };
}

// whether some rows are of this question
export const areLoads = (planned, rows) => planned.task === "analyze" && rows.some((row) => Object.keys(row).some((name) => name.startsWith(COLUMN)));

export function showLoads(place, rows) {
  const names = Object.keys(rows[0]).filter((name) => name.startsWith(COLUMN)).map((name) => name.slice(COLUMN.length));
  const at = rows.map((row) => row[SPEED]);
  const most = Math.max(...names.flatMap((name) => rows.map((row) => row[COLUMN + name] ?? 0)));
  return plot(place, () => ({
    traces: names.map((name, index) => line(at, rows.map((row) => row[COLUMN + name] ?? null), `bearing ${name}`, series(index))),
    layout: { height: 380, xaxis: { title: "speed, rpm" }, yaxis: { title: "largest bearing load, N", rangemode: "tozero" } },
    label: `Largest load of each main bearing from ${figure(at[0])} to ${figure(at.at(-1))} rpm, up to ${figure(most)} N.`,
  }));
}
