// Gas, friction and inertia over the turn: torque, rod loads, flywheel, main bearings.

import { h, table } from "../dom.js";
import { degrees, figure, nameOf, number } from "../format.js";
import { closed, colours, line, overTurn, places, plot, series } from "../plots.js";

const CASES = { running: "running", no_load: "no load", sudden_stop: "sudden stop" };
const DRIVEN = { needs: ["rods"], kind: "reciprocating" };

// the machine as it stands, with the counterweights that were found
export function scene({ request, answer }, outputs, step = 2) {
  const { machine, fidelity } = request;
  const counterweights = answer.counterweights.map(({ web, mass_kg, angle_deg }) => ({ web, mass_kg, angle_deg }));
  return { machine, counterweights, outputs, angles: { step_deg: step }, ...(fidelity ? { fidelity } : {}) };
}

const rowName = (row) => `throw ${row.throw + 1}, row ${nameOf(row, row.row)}`;

export const torque = {
  ...DRIVEN, id: "torque", output: "torque", title: "Torque",
  async draw(body, context) {
    const found = (await context.ask("v1/analyze", scene(context, ["torque"]))).torque;
    const [node] = places(body, 1);
    body.replaceChildren(node, table("Over one cycle", ["mean torque, N m", "indicated power, W", "friction power, W", "shaft power, W", "fluctuation energy, J"],
      [[figure(found.mean_torque_Nm), number(found.indicated_power_W), number(found.friction_power_W), number(found.shaft_power_W), number(found.fluctuation_energy_J)]]));
    await plot(node, () => ({
      traces: [
        ...found.rows.map((row, index) => line(found.angle_deg, row.torque_Nm, rowName(row), { ...series(index + 1), width: 1.5 })),
        line(found.angle_deg, found.torque_Nm, "machine", { color: colours().after, width: 3 }),
        line(found.angle_deg, found.angle_deg.map(() => found.mean_torque_Nm), "mean", { color: colours().floor, dash: "dot", width: 1.5 }),
      ],
      layout: { height: 340, ...overTurn("torque against rotation, N m", found.angle_deg) },
      label: `Torque over the cycle, mean ${figure(found.mean_torque_Nm)} N m.`,
    }));
  },
};

export const rodLoads = {
  ...DRIVEN, id: "rod-loads", output: "rod_loads", title: "Rod loads",
  async draw(body, context) {
    const found = (await context.ask("v1/analyze", scene(context, ["rod_loads"]))).rod_loads;
    const nodes = [["rod_N", "rod force, N (tension positive)"], ["side_N", "force on the guide, N"]]
      .map(([name, title], index) => ({ name, title, node: places(body, 2)[index] }));
    body.replaceChildren(h("div", { class: "pair" }, nodes.map((each) => each.node)),
      table("Load cases; forces in the rod, N", ["row", "case", "tension", "at, °", "compression", "at, °", "governs"],
        found.rows.flatMap((row) => row.cases.map((one) => [rowName(row), CASES[one.case], number(one.tension_N), degrees(one.tension_deg),
          number(one.compression_N), degrees(one.compression_deg), one.case === row.governing_case ? "yes" : ""]))));
    await Promise.all(nodes.map(({ name, title, node }) => plot(node, () => ({
      traces: found.rows.map((row, index) => line(found.angle_deg, row[name], rowName(row), series(index))),
      layout: overTurn(title, found.angle_deg), label: `${title} over the cycle; largest rod force ${figure(found.governing_load_N)} N.`,
    }))));
  },
};

export const flywheel = {
  ...DRIVEN, id: "flywheel", output: "flywheel", title: "Flywheel", needs: ["rods", "flywheel"],
  async draw(body, context) {
    const answer = await context.ask("v1/analyze", scene(context, ["torque", "flywheel"]));
    const { torque: turned, flywheel: found } = answer;
    const [node] = places(body, 1);
    body.replaceChildren(node, table("Flywheel", ["irregularity", "inertia J, kg m²", "MD² = 4 J, kg m²", "energy to hold, J"],
      [[figure(found.irregularity), number(found.inertia_J_kg_m2), number(found.inertia_MD2_kg_m2), number(found.fluctuation_energy_J)]]));
    await plot(node, () => {
      const excess = turned.torque_Nm.map((value) => turned.mean_torque_Nm - value);
      const { after, before } = colours();
      const part = (sign, name, color, pattern) => ({
        ...line(turned.angle_deg, excess.map((value) => (sign * value > 0 ? value : 0)), name, { color }), fill: "tozeroy",
        fillpattern: { shape: pattern, fgcolor: color } });
      return {
        traces: [part(1, "the shaft gains speed", after, ""), part(-1, "it loses speed", before, "/")],
        layout: overTurn("mean torque less torque, N m", turned.angle_deg),
        label: `What the flywheel takes up and gives back: ${figure(found.fluctuation_energy_J)} J, with J = ${figure(found.inertia_J_kg_m2)} kg m².`,
      };
    });
  },
};

export const mainBearings = {
  ...DRIVEN, id: "main-bearings", output: "main_bearings", title: "Main bearings", needs: ["rods", "bearings"],
  async draw(body, context) {
    const found = (await context.ask("v1/analyze", scene(context, ["main_bearings"]))).main_bearings;
    const [seen, locus, size, bending] = places(body, 4);
    const pick = h("select", { id: "bearing", change: () => draw(Number(pick.value)) },
      found.bearings.map((one, index) => h("option", { value: index }, one.name)));
    body.replaceChildren(h("div", { class: "choose" }, h("label", { for: "bearing" }, "Bearing"), pick),
      h("div", { class: "pair" }, seen, locus),
      h("p", { class: "about" }, "Seen from the shaft, counterweights move the load and the smallest circle around it together. "
        + "The peak is the distance of the farthest point from the middle of the shaft. It is never below the radius."),
      h("div", { class: "pair" }, size, bending),
      table("Peak loads, N", ["bearing", "plane, m", "before", "at, °", "after", "at, °"], found.bearings.map((one) => [one.name, number(one.position_m),
        number(one.before.peak_N), degrees(one.before.peak_angle_deg), number(one.after?.peak_N), degrees(one.after?.peak_angle_deg)])));
    const draw = (index) => Promise.all([
      plot(seen, () => seenFromTheShaft(found, found.bearings[index], context.request.machine)),
      plot(locus, () => polarPlot(found.bearings[index])),
      plot(size, () => overTurnPlot(found, found.bearings[index])),
    ]);
    await Promise.all([draw(0), plot(bending, () => {
      const { before, after, floor } = colours();
      const curve = (values, name, style) => ({ x: found.bending.position_m, y: values, name, mode: "lines+markers", line: style });
      const traces = [curve(found.bending.before_Nm, "before", { color: before, dash: "dash" })];
      if (found.bending.after_Nm) traces.push(curve(found.bending.after_Nm, "after", { color: after }));
      traces.push({ ...curve(found.bending.position_m.map(() => found.bending.floor_Nm), "floor of the largest", { color: floor, dash: "dot", width: 1.5 }), mode: "lines" });
      return { traces, layout: { xaxis: { title: "plane along the shaft, m" }, yaxis: { title: "largest bending moment, N m", rangemode: "tozero" } },
        label: `Largest bending moment inside the shaft over the cycle, along the shaft: ${figure(found.bending.peak_Nm)} N m at ${figure(found.bending.peak_position_m)} m, `
          + `never below ${figure(found.bending.floor_Nm)} N m.` };
    })]);
  },
};

const loads = (one) => [["before", one.before, "dash"], ["after", one.after, "solid"]].filter(([, load]) => load);

// the load in a frame that turns with the shaft, and the smallest circle around it
function seenFromTheShaft(found, one, machine) {
  const sense = machine.rotation === "cw" ? -1 : 1;
  const turned = (load, part) => load.force_x_N.map((x, step) => {
    const angle = (-sense * found.angle_deg[step] * Math.PI) / 180;
    const [cos, sin, y] = [Math.cos(angle), Math.sin(angle), load.force_y_N[step]];
    return part === "x" ? x * cos - y * sin : x * sin + y * cos;
  });
  const round = Array.from({ length: 91 }, (_, step) => (step * Math.PI) / 45);
  const traces = loads(one).flatMap(([name, load, dash]) => {
    const color = colours()[name];
    return [
      { x: closed(turned(load, "x")), y: closed(turned(load, "y")), name, mode: "lines", line: { color, dash, width: 2 },
        hovertemplate: "%{x:.5~s}, %{y:.5~s}<extra></extra>" },
      { x: round.map((angle) => load.circle_x_N + load.floor_N * Math.cos(angle)), y: round.map((angle) => load.circle_y_N + load.floor_N * Math.sin(angle)),
        name: `circle ${name}`, mode: "lines", line: { color, dash: "dot", width: 1.2 }, hoverinfo: "name", showlegend: false },
    ];
  });
  const far = loads(one).map(([name, load]) => `${name} ${figure(Math.hypot(load.circle_x_N, load.circle_y_N))} N from the middle, peak ${figure(load.peak_N)} N`);
  return {
    traces: [...traces, { x: [0], y: [0], mode: "markers", name: "middle of the shaft", marker: { color: colours().floor, size: 8, symbol: "cross" }, hoverinfo: "name" }],
    layout: { height: 340, xaxis: { title: "as the shaft sees it: x, N" }, yaxis: { title: "y, N", scaleanchor: "x" } },
    label: `Load of bearing ${one.name} as the shaft sees it. Smallest circle of radius ${figure(one.before.floor_N)} N, its centre ${far.join("; ")}.`,
  };
}

function polarPlot(one) {
  return {
    traces: loads(one).map(([name, load, dash]) => ({ x: closed(load.force_x_N), y: closed(load.force_y_N), name, mode: "lines",
      line: { color: colours()[name], dash, width: 2 }, hovertemplate: "%{x:.5~s}, %{y:.5~s}<extra></extra>" })),
    layout: { height: 340, xaxis: { title: "force x, N" }, yaxis: { title: "force y, N", scaleanchor: "x" } },
    label: `Locus of the force on bearing ${one.name}.`,
  };
}

function overTurnPlot(found, one) {
  return {
    traces: loads(one).map(([name, load, dash]) => line(found.angle_deg,
      load.force_x_N.map((x, step) => Math.hypot(x, load.force_y_N[step])), name, { color: colours()[name], dash })),
    layout: { height: 340, ...overTurn("force on the bearing, N", found.angle_deg) },
    label: `Load of bearing ${one.name} over the cycle, peak ${figure((one.after ?? one.before).peak_N)} N.`,
  };
}
