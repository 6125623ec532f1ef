// Many designs of this machine: pick fields and ranges, watch, look, take away.

import { ask as send, events, get, post, Problem } from "../api.js";
import { h } from "../dom.js";
import { figure } from "../format.js";
import { complaint } from "../naming.js";
import { Axes } from "../sweep/axes.js";
import { areLoads, overSpeed, showLoads, speeds } from "../sweep/bearings.js";
import { numbersOf } from "../sweep/numbers.js";
import { downloads, rowsOf, showRows } from "../sweep/results.js";

// what was chosen outlives the panel being drawn again
let lastAxes = null;

export const sweep = {
  id: "sweep", title: "Sweep: many designs of this machine",
  about: "Choose fields and ranges; every design gets its own certified counterweights.",
  async draw(body, context) {
    const { request, told, schema, model, keep, kept } = context;
    const numbers = numbersOf(request, await schema, model);
    const known = lastAxes?.filter((axis) => numbers.some(({ pointer }) => pointer === axis.path)) ?? [];
    const axes = new Axes(numbers, known.length ? known : Axes.usual(numbers));
    lastAxes = axes.axes;
    const design = h("select", { id: "sweep-design", change: () => { samples.parentElement.hidden = design.value === "grid"; } },
      h("option", { value: "grid" }, "every combination"), h("option", { value: "latin_hypercube" }, "Latin hypercube"));
    const samples = h("input", { id: "sweep-samples", type: "text", inputmode: "numeric", value: "500" });
    const start = h("button", { type: "button", class: "primary", click: () => run(asked()) }, "Start the sweep");
    const loads = h("button", { type: "button", click: () => run(speeds(context)) }, "Bearing loads over the speed");
    const cancel = h("button", { type: "button", hidden: true }, "Cancel");
    const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the sweep" });
    const status = h("p", { role: "status" });
    const trouble = h("p", { class: "error", role: "alert" });
    const result = h("div", { class: "result" });
    body.replaceChildren(axes.element,
      h("div", { class: "controls" },
        h("div", { class: "choose" }, h("label", { for: "sweep-design" }, "designs"), design),
        h("div", { class: "choose", hidden: true }, h("label", { for: "sweep-samples" }, "how many"), samples), start, overSpeed(request.machine) ? loads : null, cancel),
      bar, status, trouble, result);

    const asked = () => {
      const { outputs: _outputs, ...base } = request;
      const grid = design.value === "grid";
      return { base, axes: axes.value(grid), design: design.value, ...(grid ? {} : { samples: Number(samples.value) }) };
    };

    async function run(question) {
      told({ method: "POST", path: "v1/sweeps", body: question });
      clear(body);
      await busy(async () => {
        const { id } = await post("v1/sweeps", question);
        keep("sweep", id);
        await follow(id);
      });
    }

    async function busy(work) {
      trouble.textContent = "";
      result.replaceChildren();
      start.disabled = true;
      loads.disabled = true;
      try {
        await work();
      } catch (error) {
        blame(body, trouble, error, request);
      } finally {
        start.disabled = false;
        loads.disabled = false;
        cancel.hidden = true;
        bar.hidden = true;
      }
    }

    // a sweep goes on without its page, and is found again by its link
    async function follow(id) {
      const planned = (await get(`v1/sweeps/${id}/metadata`)).request;
      const titles = planned.axes.map(({ path }) => {
        const { name, unit } = numbers.find(({ pointer }) => pointer === path) ?? { name: path };
        return { path, title: `${name}${unit ? `, ${unit}` : ""}` };
      });
      const end = await watch(id);
      if (!end.done) return;
      const drawn = h("div");
      result.replaceChildren(drawn, downloads(id));
      const rows = await rowsOf(id);
      await (areLoads(planned, rows) ? showLoads(drawn, rows) : showRows(drawn, rows, titles, planned.design === "grid", end.total));
      body.closest("details").dataset.swept = id;
    }

    async function watch(id) {
      const stop = () => send("DELETE", `v1/sweeps/${id}`).catch((error) => { trouble.textContent = error.message; });
      cancel.onclick = stop;
      cancel.hidden = false;
      bar.hidden = false;
      for await (const { name, data } of events(`v1/sweeps/${id}/events`)) {
        tell(data, bar, status);
        if (name === "end") return data;
      }
      // the stream may end early: the state does not
      return get(`v1/sweeps/${id}`);
    }

    if (kept.sweep) busy(() => follow(encodeURIComponent(kept.sweep)));
  },
};

const STATES = { queued: "Waiting", running: "Computing", done: "Done", failed: "Failed", cancelled: "Cancelled" };

function tell({ state, done, total, failed, invalid, infeasible, eta_s: eta, created_at: begun, message }, bar, status) {
  bar.value = total ? done / total : 0;
  status.textContent = [`${STATES[state] ?? state}: ${figure(done)} of ${figure(total)} designs`,
    infeasible ? `${figure(infeasible)} proven infeasible` : null,
    failed > infeasible ? `${figure(failed - infeasible)} without a certified answer` : null,
    invalid ? `${figure(invalid)} invalid` : null,
    `asked for at ${new Date(begun).toLocaleTimeString()}`,
    eta ? `about ${Math.ceil(eta)} s left` : null, message].filter(Boolean).join(", ");
}

function clear(body) {
  for (const place of body.querySelectorAll(".wrong")) {
    place.classList.remove("wrong");
    place.querySelector(":scope > .error").textContent = "";
  }
}

// errors at the fields of the axes; what belongs to the machine is said as it is
function blame(body, trouble, error, request) {
  if (!(error instanceof Problem)) throw error;
  const homeless = [];
  for (const { pointer, message } of error.errors) {
    const place = body.querySelector(`[data-pointer="${CSS.escape(pointer)}"]`);
    const said = place?.querySelector(":scope > .error");
    if (!said) homeless.push(complaint(request, { pointer: pointer.replace(/^\/base/, ""), message }));
    else {
      said.textContent = message;
      place.classList.add("wrong");
      place.querySelector("input, select")?.setAttribute("aria-invalid", "true");
    }
  }
  trouble.textContent = [error.errors.length ? null : error.message, ...homeless].filter(Boolean).join(" ");
}
