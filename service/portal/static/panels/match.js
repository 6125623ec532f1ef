// Which weighed part goes on which row: typed or pasted, certified, with what remains before and after.

import { post, Problem } from "../api.js";
import { h, table } from "../dom.js";
import { figure, number, share } from "../format.js";
import { complaint } from "../naming.js";
import { Parts } from "../match/parts.js";
import { isNut, question, rowsOf, toWeigh } from "../match/question.js";

const FIELDS = ["kind", "name", "mass", "rows"];

// what a link kept; it may hold anything
function remembered(text) {
  try {
    const { lines, included, weights } = JSON.parse(text);
    return { lines: lines.map((line) => Object.fromEntries(FIELDS.map((name) => [name, String(line?.[name] ?? "")]))), included, weights };
  } catch {
    return {};
  }
}

export const match = {
  id: "match", title: "Weighed parts: which goes on which row", kind: "reciprocating",
  about: "Crossheads, pistons and piston rods that were weighed, and balance nuts: each is used once, a nut at most once.",
  draw(body, { request, answer, told, keep, kept }) {
    const before = remembered(kept.match);
    const lines = before.lines ?? toWeigh(request.machine);
    const said = h("p", { class: "error", role: "alert" });
    const result = h("div", { class: "result" });
    const options = () => ({ included: included.checked, weights: weights.value });
    const changed = () => {
      result.replaceChildren();
      keep("match", JSON.stringify({ lines, ...options() }));
    };
    const parts = new Parts(lines, changed);
    const included = h("input", { type: "checkbox", id: "match-included", checked: before.included ?? true, change: changed });
    const weights = h("select", { id: "match-weights", change: changed },
      h("option", { value: "answer" }, "those of the answer"), h("option", { value: "chosen" }, "chosen together with the parts"),
      h("option", { value: "none" }, "none"));
    if (["chosen", "none"].includes(before.weights)) weights.value = before.weights;
    const run = async () => {
      said.textContent = "";
      result.replaceChildren();
      const { body: asked, wrong, place } = question(request, answer, lines, options());
      parts.blame(wrong);
      if (wrong.length) return;
      told({ method: "POST", path: "v1/match", body: asked });
      start.disabled = true;
      try {
        result.replaceChildren(...shown(request.machine, await post("v1/match", asked), lines));
      } catch (error) {
        if (!(error instanceof Problem)) throw error;
        const placed = error.errors.map((one) => ({ ...place(one.pointer), ...one }));
        parts.blame(placed.filter((one) => one.field !== undefined));
        const homeless = placed.filter((one) => one.field === undefined).map((one) => `${complaint(asked, one)}.`);
        said.textContent = [error.errors.length ? "" : error.message, ...homeless].join(" ").trim();
      } finally {
        start.disabled = false;
      }
    };
    const start = h("button", { type: "button", class: "primary", click: run }, "Match the parts");
    body.replaceChildren(parts.element,
      h("div", { class: "controls" },
        h("label", {}, included, " the machine's reciprocating masses hold these parts already (their mean is taken off)"),
        h("div", { class: "choose" }, h("label", { for: "match-weights" }, "counterweights"), weights), start),
      h("p", { class: "about" }, "Weighed as in the objective, of the first order, without ceilings."), said, result);
  },
};

function shown(machine, found, lines) {
  const rows = rowsOf(machine);
  const on = (row, kind) => found.assignments.filter((one) => one.throw === row.throw && one.row === row.row && one.class === kind);
  const named = ({ class: kind, part, mass_kg: mass }) => `${kind === "balance_nut" ? nutName(lines, part) : part} (${figure(mass)} kg)`;
  const kinds = [...new Set(found.assignments.map((one) => one.class))];
  const weighs = (row) => found.rows.find((one) => one.throw === row.throw && one.row === row.row).reciprocating_mass_kg;
  const { before, after } = found.residual;
  const change = (now, was) => (was > 0 ? `${now <= was ? "−" : "+"}${share(Math.abs(1 - now / was))}` : "±0 %");
  const line = (name, of) => [name, number(of(before)), number(of(after)), change(of(after), of(before))];
  return [
    h("p", { class: `proof ${found.status}` }, certified(found)),
    table("Parts on rows", ["row", ...kinds.map((kind) => kind.replace("_", " ")), "reciprocating mass, kg"],
      rows.map((row) => [row.label, ...kinds.map((kind) => on(row, kind).map(named).join(", ") || "–"), number(weighs(row), 6)])),
    found.spares.length ? h("p", {}, `Left over: ${found.spares.map(named).join(", ")}.`) : "",
    table("What remains, of the first order", ["", "as listed", "as matched", "change"],
      [line("peak force, N", (one) => one.force.peak_N), line("peak moment, N m", (one) => one.moment.peak_Nm)]),
  ];
}

function certified({ status, status_reason: reason, certificate: { relative_gap: gap, method } }) {
  if (gap === null) return `Nothing is proven of this assignment. ${reason}`;
  const how = method === "exhaustion" ? "every assignment was counted" : "sorting the masses bounds every assignment";
  const best = gap > 0 ? `within ${share(gap)} of the best assignment` : "no other assignment is better";
  return `${status === "optimal" ? "Certified" : "Proven only so far"}: ${best} (${how}).`;
}

// nuts have numbers in the answer; those who typed a name see it
function nutName(lines, part) {
  return lines.filter(isNut)[Number(part) - 1]?.name.trim() || `nut ${part}`;
}
