// First order: hodographs with the floor, force and moment over the turn, orders.

import { h, table } from "../dom.js";
import { figure, number } from "../format.js";
import { closed, colours, line, overTurn, places, plot } from "../plots.js";
import { calm, scales } from "../scales.js";

const PARTS = [
  { name: "force", unit: "N", x: "force_x_N", y: "force_y_N", axes: ["force x", "force y"], floor: "force_N", peak: "peak_N" },
  { name: "moment", unit: "N m", x: "moment_x_Nm", y: "moment_y_Nm", axes: ["couple of the x forces", "couple of the y forces"], floor: "moment_Nm", peak: "peak_Nm" },
];

// the largest that is drawn, before and after
const largest = ({ residual }, part) => Math.max(...[residual.before, residual.after].map((each) => each?.[part.name][part.peak] ?? 0));

const pair = (body) => {
  const nodes = places(body, PARTS.length);
  body.replaceChildren(h("div", { class: "pair" }, nodes));
  return nodes;
};

const peaks = ({ residual }, part) => {
  const [before, after] = [residual.before, residual.after].map((each) => each?.[part.name][part.peak]);
  return `Peak ${part.name} before ${figure(before)} ${part.unit}${after === undefined ? "" : `, after ${figure(after)} ${part.unit}`}.`;
};

// the weights that a request says are fitted leave what is computed of them
const asBuilt = ({ ask, request }) => (request.fitted?.length
  ? ask("v1/analyze", { machine: request.machine, counterweights: request.fitted, outputs: ["hodograph", "residual"], angles: { step_deg: 2 } }) : null);

export const hodographs = {
  id: "hodographs", output: "hodograph", title: "Hodographs of force and moment", open: true,
  async draw(body, context) {
    const { answer, request } = context;
    const built = await asBuilt(context);
    const nodes = pair(body);
    await Promise.all(PARTS.map((part, index) => {
      const scale = scales(request.machine, answer)[part.name];
      const range = calm(largest(answer, part), scale);
      return plot(nodes[index], () => {
        const { before, after, floor, series } = colours();
        const { hodograph } = answer;
        const curve = (each, name, style) => ({ x: closed(each[part.x]), y: closed(each[part.y]), name, mode: "lines", line: style,
          hovertemplate: "%{x:.5~s}, %{y:.5~s}<extra></extra>" });
        const radius = answer.floor[part.floor];
        const turn = Array.from({ length: 91 }, (_, step) => (step * Math.PI) / 45);
        /** @type {object[]} */
        const traces = [curve(hodograph.before, "before", { color: before, width: 2, dash: "dash" })];
        if (hodograph.after) traces.push(curve(hodograph.after, "after", { color: after, width: 3 }));
        if (built) traces.push(curve(built.hodograph.after, "as built", { color: series[3], width: 2, dash: "dashdot" }));
        // what is cancelled is a point, and would not be seen
        if (answer.residual.after?.[part.name][part.peak] < 1e-3 * scale) {
          traces.push({ x: [0], y: [0], mode: "markers", marker: { color: after, size: 9 }, name: "cancelled", hoverinfo: "name" });
        }
        if (radius > 0) traces.push({ x: turn.map((angle) => radius * Math.cos(angle)), y: turn.map((angle) => radius * Math.sin(angle)),
          name: "floor", mode: "lines", line: { color: floor, width: 1.5, dash: "dot" }, hoverinfo: "name" });
        return { traces, layout: { height: 360, xaxis: { title: `${part.axes[0]}, ${part.unit}`, ...range },
          yaxis: { title: `${part.axes[1]}, ${part.unit}`, scaleanchor: "x", ...range } },
        label: `Hodograph of the ${part.name}. ${peaks(answer, part)}${built ? ` As built ${figure(built.residual.after[part.name][part.peak])} ${part.unit}.` : ""} Floor ${figure(radius)} ${part.unit}.` };
      });
    }));
  },
};

export const overAngle = {
  id: "over-angle", title: "Force and moment over the shaft angle", open: true,
  async draw(body, { answer, request }) {
    const nodes = pair(body);
    await Promise.all(PARTS.map((part, index) => {
      const range = calm(largest(answer, part), scales(request.machine, answer)[part.name]);
      return plot(nodes[index], () => {
        const { before, after, series } = colours();
        const { hodograph } = answer;
        const angles = hodograph.angle_deg;
        const size = (each) => each[part.x].map((x, step) => Math.hypot(x, each[part.y][step]));
        const last = hodograph.after ?? hodograph.before;
        const traces = [line(angles, size(hodograph.before), "before", { color: before, dash: "dash" })];
        if (hodograph.after) traces.push(line(angles, size(hodograph.after), "after", { color: after, width: 3 }));
        traces.push(line(angles, last[part.x], part.axes[0], { color: series[2], dash: "dot", width: 1.5 }),
          line(angles, last[part.y], part.axes[1], { color: series[3], dash: "dashdot", width: 1.5 }));
        return { traces, layout: overTurn(`${part.name}, ${part.unit}`, angles, range),
          label: `First-order ${part.name} over the shaft angle. ${peaks(answer, part)}` };
      });
    }));
  },
};

// what shakes once and what shakes twice a revolution
function firstAndSecond({ before, after }) {
  const [was, left] = [before, after ?? [null, null]];
  return table("Orders 1 and 2", ["order", "force before, N", "after, N", "moment before, N m", "after, N m"],
    ["1, once a revolution", "2, twice a revolution"].map((name, place) => [name, ...PARTS.flatMap((part) =>
      [was[place], left[place]].map((one) => number(one?.[part.name][part.peak])))]));
}

export const orders = {
  id: "orders", output: "orders", title: "Orders", open: true, needs: ["rods"],
  async draw(body, { answer }) {
    const nodes = pair(body);
    const found = answer.orders;
    body.prepend(firstAndSecond(answer.residual.orders));
    await Promise.all(PARTS.map((part, index) => {
      return plot(nodes[index], () => {
        const { before, after } = colours();
        const bars = (each, name, marker) => ({ type: "bar", name, marker, x: each.map((one) => String(one.order)),
          y: each.map((one) => one[part.name][part.peak]), hovertemplate: "order %{x}: %{y:.5~s}<extra></extra>" });
        const traces = [bars(found.before, "before", { color: before, pattern: { shape: "/", fgcolor: before, fgopacity: 1, bgcolor: "transparent" } })];
        if (found.after) traces.push(bars(found.after, "after", { color: after }));
        const said = (found.after ?? found.before).map((one) => `order ${one.order}: ${figure(one[part.name][part.peak])} ${part.unit}`);
        return { traces, layout: { barmode: "group", xaxis: { title: "order, multiple of the shaft speed", type: "category" },
          yaxis: { title: `peak ${part.name}, ${part.unit}`, rangemode: "tozero" } },
        label: `Peak ${part.name} by order, with counterweights: ${said.join(", ")}.` };
      });
    }));
  },
};
