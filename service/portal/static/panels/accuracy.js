// What accuracy costs in time on this machine.

import { h, table } from "../dom.js";
import { figure, label, number } from "../format.js";
import { places, plot, series } from "../plots.js";

const SYMBOLS = ["star", "circle", "square", "diamond", "triangle-up", "cross", "x", "hexagon2", "bowtie"];
const WORDS = {
  infeasible: "No counterweights satisfy the ceilings: there is nothing to measure.",
  contradicted: "A bound is above a value that was found, a fault of the service: nothing is measured from it.",
  nothing_to_choose: "There is nothing to choose on this machine: no web can carry anything, or nothing is out of balance.",
};

const HEADS = ["method", "setting", "time, ms", "relative error", "proved gap"];

// A line breaks at a hyphen, not at a minus.
const setting = (row) => row.setting.replace(/(\d)e-(\d)/, "$1e−$2");

function cells(row) {
  return [label(row.method), setting(row), number(row.time_ms, 3), number(row.relative_error, 2), number(row.certified_gap, 2)];
}

// Counterweights as a workshop makes them: what the time buys is seen in kilograms and pieces too.
function made(row) {
  return [...cells(row), number(row.total_mass_kg, 4), number(row.pieces), number(row.sizes), breaks(row) ? "limits broken" : ""];
}

const KEPT = 1e-9; // as the service counts it
const breaks = (row) => (row.excess ?? 0) > KEPT || row.limits_kept === false;
const claimed = (row) => [...cells(row), number(row.claim_error, 2)];
const excess = (row) => breaks(row) ? figure(row.excess, 2) : "";

// What breaks limits may well be below the optimum: that is no accuracy.
const off = (row) => breaks(row) ? Math.max(Math.abs(row.relative_error), row.excess ?? 0) : row.relative_error;

// Decades alone would leave a narrow axis one figure or none: there 1, 2 and 5 of each have one. Times of nearly equal
// methods may lie between these: there figures are at equal steps, as the drawing chooses them by itself.
function ticks(times) {
  const [least, most] = [Math.log10(Math.min(...times)), Math.log10(Math.max(...times))];
  if (most - least > 2) return { dtick: 1 };
  if (most - least < 0.7) return {};
  const tickvals = [];
  for (let decade = Math.floor(least); decade <= Math.ceil(most); decade += 1) {
    tickvals.push(...[1, 2, 5].map((digit) => Number(`${digit}e${decade}`)));
  }
  return { tickvals, ticktext: tickvals.map(String) };
}

export const accuracy = {
  id: "accuracy", title: "Accuracy against time",
  about: "Every method and setting, timed on this machine just now; down and to the left is better.",
  async draw(body, { request, ask }) {
    const { angles: _angles, ...rest } = request;
    const answer = await ask("v1/accuracy", { ...rest, repeats: 3 });
    if (answer.status !== "measured") {
      body.replaceChildren(h("p", {}, WORDS[answer.status] ?? answer.status));
      return;
    }
    const [node] = places(body, 1);
    const choices = answer.choices_ladder.length > 0;
    const rows = (choices ? answer.choices_ladder : answer.ladder).filter((row) => row.time_ms !== null);
    // an error that cannot be told from nothing is drawn at the resolution
    const least = Math.max(answer.reference.resolution, 1e-16);
    const methods = [...new Set(rows.map((row) => row.method))];
    body.replaceChildren(node, h("details", {}, h("summary", {}, "As a table"), choices
      ? table("Time, gap, mass and pieces", [...HEADS, "mass, kg", "pieces", "sizes", "limits"], rows.map(made))
      : rows.some(breaks)
      ? table("Methods and settings", [...HEADS, "claim", "limits broken by"], rows.map((row) => [...claimed(row), excess(row)]))
      : table("Methods and settings", [...HEADS, "claim"], rows.map(claimed))));
    if (answer.reference.goals?.length) {
      node.before(h("p", {}, "The objective is the last goal, under the limits of the goals before it."));
    }
    if (rows.some(breaks)) {
      node.after(h("p", { class: "about" }, "Hollow marks break limits. They stand where their error or their excess is, whichever is larger."));
    }
    await plot(node, () => ({
      traces: methods.map((method, index) => {
        const own = rows.filter((row) => row.method === method && row.relative_error !== null);
        return { name: label(method), mode: "lines+markers", x: own.map((row) => row.time_ms),
          y: own.map((row) => Math.max(off(row), least)), text: own.map((row) => breaks(row) ? `${setting(row)}, limits broken` : setting(row)),
          line: { ...series(index), width: 1 }, marker: {
            size: method === "service" ? 14 : 8, color: series(index).color,
            symbol: own.map((row) => SYMBOLS[index % SYMBOLS.length] + (breaks(row) ? "-open" : "")),
          },
          hovertemplate: "%{text}: %{x:.3~s} ms, error %{y:.2e}<extra></extra>" };
      }),
      // the names of the methods take their room from narrow plots
      layout: { height: node.clientWidth < 500 ? 520 : 380, xaxis: { title: "time, ms", type: "log", ...ticks(rows.map((row) => row.time_ms)) }, yaxis: { title: "relative error", type: "log", exponentformat: "power", dtick: 2 } },
      label: `Error against time: ${methods.map((method) => {
        const best = rows.filter((row) => row.method === method).sort((one, other) => Number(breaks(one)) - Number(breaks(other)) || off(one) - off(other))[0];
        return `${label(method)} ${figure(off(best), 2)} in ${figure(best.time_ms, 3)} ms${breaks(best) ? ", limits broken" : ""}`;
      }).join("; ")}.`,
    }));
  },
};
