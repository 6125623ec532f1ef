// One page: choose or paste a machine, edit it, optimise, look.

import { get, post, Problem } from "./api.js";
import { showAnswer } from "./answer.js";
import { byId, h } from "./dom.js";
import { drawable, pair, plane } from "./drawing/pair.js";
import { Embedding } from "./embed.js";
import { Form } from "./form.js";
import { accuracy } from "./panels/accuracy.js";
import { counterweights } from "./panels/counterweights.js";
import { cranks } from "./panels/cranks.js";
import { flywheel, mainBearings, rodLoads, torque } from "./panels/dynamics.js";
import { hodographs, orders, overAngle } from "./panels/first_order.js";
import { missing, offered, Panels } from "./panels/panels.js";
import { pareto } from "./panels/pareto.js";
import { pins } from "./panels/pins.js";
import { sweep } from "./panels/sweep.js";
import { load as loadPlots } from "./plots.js";
import { Schema } from "./schema.js";
import { readLink, writeLink } from "./state.js";
import { theme } from "./theme.js";

const MODEL = "OptimizeRequest";
const FIRST = "2d12";
/** @type {{ id: string, title: string, output?: string, [more: string]: any }[]} */
const PANELS = [counterweights, cranks, hodographs, overAngle, orders, pareto, accuracy, torque, rodLoads, flywheel, mainBearings, pins, sweep];
const STEP = { step_deg: 2 };

const schema = get("openapi.json").then((document) => new Schema(document));
/** @type {{ request: any, example: string | null, kept: { [name: string]: any } }} */
const state = { request: null, example: null, kept: {} };
let form = null;
let runs = 0;
let running = null;

const panels = new Panels(byId("panels"), PANELS, {
  toggled: () => keepLink(), blamed: (errors) => form?.blame(errors),
});

const embedding = new Embedding({ take: (request) => take(request, null), request: () => state.request });

function edited() {
  state.example = null;
  embedding.edited();
  // a sweep goes on and is still to be found; the points of the front are no longer the same
  delete state.kept.point;
  byId("example").value = "";
  byId("results").classList.add("stale");
  byId("progress").textContent = "Edited: press Optimise.";
  sketch();
}

let sketching = 0;

// the machine as it is typed, without counterweights
function sketch() {
  cancelAnimationFrame(sketching);
  sketching = requestAnimationFrame(() => {
    const machine = drawable(state.request.machine);
    if (!machine) return;
    if (!byId("drawings")) byId("answer").append(h("div", { class: "drawings", id: "drawings" }));
    byId("drawings").replaceChildren(...pair(machine, [], plane(machine)));
  });
}

async function keepLink() {
  const link = await writeLink({ ...state, open: [...panels.wanted] });
  // our own change of the fragment is no navigation
  if (link !== location.hash) history.replaceState(null, "", link);
}

function keep(name, value) {
  state.kept[name] = value;
  keepLink();
}

async function take(request, example, kept = {}) {
  Object.assign(state, { request, example, kept });
  byId("example").value = example ?? "";
  const ran = run();
  await schema.then((known) => {
    form ??= new Form(byId("form"), known, MODEL, edited);
    form.show(state.request);
  });
  await ran;
}

// what an answer on this machine can hold, of all panels or of some
function outputs(machine, of = PANELS) {
  return ["residual", ...of.filter((panel) => panel.output && offered(panel, machine) && !missing(panel, machine).length).map((panel) => panel.output)];
}

async function run() {
  const started = performance.now();
  const number = (runs += 1);
  running?.abort();
  running = new AbortController();
  const results = byId("results");
  const progress = byId("progress");
  results.setAttribute("aria-busy", "true");
  progress.textContent = "Computing …";
  const request = structuredClone(state.request);
  const body = { angles: STEP, ...request, outputs: outputs(Object(request.machine), [hodographs, orders]) };
  try {
    const answer = await post("v1/optimize", body, { signal: running.signal, waiting: (why) => { progress.textContent = why; } });
    if (number !== runs) return;
    form?.clear();
    byId("problem").replaceChildren();
    showAnswer(byId("answer"), request, answer, outputs(request.machine));
    results.classList.remove("stale", "empty");
    progress.textContent = `Answered in ${Math.round(performance.now() - started)} ms.`;
    keepLink();
    embedding.say("answer", { request, answer });
    await panels.show({ request, answer, number, schema, model: MODEL, keep, kept: state.kept, call: { method: "POST", path: "v1/optimize", body } });
    if (number === runs) Object.assign(results.dataset, { drawn: number, ms: Math.round(performance.now() - started) });
  } catch (error) {
    if (error.name === "AbortError" || number !== runs) return;
    if (!(error instanceof Problem)) console.error(error);
    progress.textContent = "";
    await complain(error);
  } finally {
    if (number === runs) results.removeAttribute("aria-busy");
  }
}

async function complain(error) {
  embedding.failed(error);
  byId("results").classList.add("stale");
  await schema.catch(() => null);
  const homeless = form ? form.blame(error.errors ?? []) : error.errors ?? [];
  byId("problem").replaceChildren(h("h2", {}, error.title ?? "Something went wrong"), h("p", {}, error.message),
    homeless.length ? h("ul", {}, homeless.map((one) => h("li", {}, `${one.pointer}: ${one.message}`))) : "");
}

// a machine alone is as good as a whole request
function readJson(text) {
  const said = byId("json-error");
  said.textContent = "";
  try {
    const given = JSON.parse(text);
    if (given === null || typeof given !== "object" || Array.isArray(given)) throw new SyntaxError("this is no object");
    take("machine" in given ? given : { machine: given }, null);
    byId("paste").open = false;
  } catch (error) {
    said.textContent = `This is not a machine in JSON: ${error.message}.`;
  }
}

async function choose(name, kept) {
  try {
    await take(await get(`v1/examples/${encodeURIComponent(name)}`), name, kept);
  } catch (error) {
    await complain(error);
  }
}

async function follow(fragment) {
  const link = await readLink(fragment).catch(() => null);
  if (link?.open) panels.open(link.open);
  if (link?.request && typeof link.request === "object") await take(link.request, null, link.kept);
  else await choose(link?.example ?? FIRST, link?.kept);
}

function listen() {
  byId("form").addEventListener("submit", (event) => { event.preventDefault(); run(); });
  byId("example").addEventListener("change", (event) => event.target.value && choose(event.target.value));
  byId("read").addEventListener("click", () => readJson(byId("json").value));
  byId("write").addEventListener("click", () => { byId("json").value = JSON.stringify(state.request, null, 2); });
  byId("file").addEventListener("change", async (event) => {
    const [file] = event.target.files;
    if (file) readJson(byId("json").value = await file.text());
    event.target.value = "";
  });
  addEventListener("hashchange", () => follow(location.hash));
}

async function listExamples() {
  const { examples } = await get("v1/examples");
  byId("example").replaceChildren(h("option", { value: "" }, "(your own machine)"),
    ...examples.map(({ name, title, description }) => h("option", { value: name, title: description }, title === name ? name : `${name}: ${title}`)));
  byId("example").value = state.example ?? "";
}

theme(byId("theme"));
listen();
listExamples().catch(complain);
// while the first answer is computed, and not in its way
loadPlots().catch(() => null);
follow(location.hash);
