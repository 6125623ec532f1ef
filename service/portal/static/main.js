// One page: choose or paste a machine, edit it, optimise, look.

import { get, post, Problem } from "./api.js";
import { showAnswer } from "./answer.js";
import { byId, h } from "./dom.js";
import { drawable, pair, plane } from "./drawing/pair.js";
import { Edits } from "./edits.js";
import { Embedding } from "./embed.js";
import { fileName, saveJson } from "./files.js";
import { Form } from "./form.js";
import { accuracy } from "./panels/accuracy.js";
import { counterweights } from "./panels/counterweights.js";
import { cranks } from "./panels/cranks.js";
import { flywheel, mainBearings, rodLoads, torque } from "./panels/dynamics.js";
import { hodographs, orders, overAngle } from "./panels/first_order.js";
import { missing, offered, Panels } from "./panels/panels.js";
import { pareto } from "./panels/pareto.js";
import { indicator, orderHodographs, stageScheme } from "./panels/pictures.js";
import { pins } from "./panels/pins.js";
import { sweep } from "./panels/sweep.js";
import { versions } from "./panels/versions.js";
import { whatIf } from "./panels/what_if.js";
import { load as loadPlots } from "./plots.js";
import { Schema } from "./schema.js";
import { forget, keepSession, last, ofTab, session } from "./session.js";
import { starter } from "./starter.js";
import { readLink, writeLink } from "./state.js";
import { theme } from "./theme.js";
import { workbooks } from "./workbook.js";

const MODEL = "OptimizeRequest";
const FIRST = "2d12";
/** @type {{ id: string, title: string, output?: string, [more: string]: any }[]} */
const PANELS = [counterweights, whatIf, versions, cranks, hodographs, overAngle, orders, orderHodographs, stageScheme, pareto, accuracy, indicator, torque, rodLoads, flywheel, mainBearings, pins, sweep];
const STEP = { step_deg: 2 };
const LINK_LATER_MS = 400;

const schema = get("openapi.json").then((document) => new Schema(document));
/** @type {{ request: any, example: string | null, kept: { [name: string]: any } }} */
const state = { request: null, example: null, kept: {} };
const edits = new Edits();
let form = null;
let runs = 0;
let running = null;
// edited since the last answer or file
let unsaved = false;
let changes = 0;

const panels = new Panels(byId("panels"), PANELS, {
  toggled: () => keepLink(), blamed: (errors) => form?.blame(errors),
});

const embedding = new Embedding({ take: (request) => take(request, null), request: () => state.request });

function edited(pointer = null) {
  state.example = null;
  edits.record(state.request, null, pointer);
  changed();
}

// the answer is no longer that of the machine
function changed(why = "Edited: press Optimise.") {
  unsaved = true;
  changes += 1;
  embedding.edited();
  // a sweep goes on and is still to be found; the points of the front are no longer the same
  delete state.kept.point;
  byId("example").value = state.example ?? "";
  byId("results").classList.add("stale");
  byId("progress").textContent = why;
  tools();
  keepLater();
  sketch();
}

function tools() {
  byId("undo").disabled = !edits.undoable;
  byId("redo").disabled = !edits.redoable;
}

function restore(found, why) {
  if (!found) return;
  Object.assign(state, found);
  form.restore(state.request);
  changed(why);
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

let links = 0;
let linking = 0;
let pushing = false;

// our own change of the fragment is no navigation; of several that are packed at once the last one counts
async function keepLink(push = false) {
  clearTimeout(linking);
  linking = 0;
  pushing ||= push;
  const number = (links += 1);
  const link = await writeLink({ ...state, open: [...panels.wanted] });
  if (number !== links) return;
  if (link !== location.hash) history[pushing ? "pushState" : "replaceState"](null, "", link);
  pushing = false;
  keepSession();
}

function keepLater() {
  clearTimeout(linking);
  linking = setTimeout(keepLink, LINK_LATER_MS);
  keepSession();
}

function keep(name, value) {
  state.kept[name] = value;
  keepLink();
}

// `push`: Back leads to what was there before; `ask`: it is whole, and can be optimised
async function take(request, example, kept = {}, { push = true, ask = true } = {}) {
  if (linking) await keepLink();
  Object.assign(state, { request, example, kept });
  edits.record(request, example);
  byId("example").value = example ?? "";
  tools();
  keepLink(push && runs > 0 && parent === self);
  const ran = ask ? run() : begin();
  await schema.then((known) => {
    form ??= new Form(byId("form"), known, MODEL, edited);
    form.show(state.request);
  });
  await ran;
}

// a machine of which there is nothing to show yet
function begin() {
  runs += 1;
  running?.abort();
  byId("problem").replaceChildren();
  byId("trouble").textContent = "";
  byId("answer").replaceChildren();
  byId("results").classList.add("stale", "empty");
  byId("progress").textContent = "A new machine: type it, then press Optimise.";
}

// what an answer on this machine can hold, of all panels or of some
function outputs(machine, of = PANELS) {
  return ["residual", ...of.filter((panel) => panel.output && offered(panel, machine) && !missing(panel, machine).length).map((panel) => panel.output)];
}

async function run() {
  const started = performance.now();
  const number = (runs += 1);
  const asked = changes;
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
    byId("trouble").textContent = "";
    showAnswer(byId("answer"), request, answer, outputs(request.machine));
    results.classList.remove("empty");
    // what was typed meanwhile is not answered
    results.classList.toggle("stale", changes !== asked);
    if (changes === asked) {
      unsaved = false;
      progress.textContent = `Answered in ${Math.round(performance.now() - started)} ms.`;
    } else sketch();
    keepLink();
    embedding.say("answer", { request, answer });
    await panels.show({ request, answer, number, schema, model: MODEL, keep, kept: state.kept, adopt: (other) => take(other, null), call: { method: "POST", path: "v1/optimize", body } });
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
  const errors = error.errors ?? [];
  const homeless = form ? form.blame(errors) : errors;
  // where the eye is after the button: above it, and beside it
  const [first] = errors;
  byId("trouble").textContent = first ? `${first.pointer.slice(1).replaceAll("/", " ")}: ${form ? form.meant(first.pointer, first.message) : first.message}` : error.message;
  byId("progress").textContent = errors.length > 1 ? `Not computed: ${errors.length} fields are wrong.` : "Not computed.";
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

async function choose(name, kept, how) {
  try {
    await take(await get(`v1/examples/${encodeURIComponent(name)}`), name, kept, how);
  } catch (error) {
    await complain(error);
  }
}

async function follow(fragment) {
  const link = await readLink(fragment).catch(() => null);
  const how = { push: false };
  if (link?.open) panels.open(link.open);
  // what was typed after the link was last written
  const typed = runs === 0 ? ofTab() : null;
  if (typed) await take(typed.request, typed.example, link?.kept, how);
  else if (link?.request && typeof link.request === "object") await take(link.request, null, link.kept, how);
  else {
    if (runs === 0) offer(last());
    await choose(link?.example ?? FIRST, link?.kept, how);
  }
}

// what was left unfinished in another tab, or before the browser was closed
function offer(found) {
  const place = byId("recover");
  place.hidden = !found;
  if (!found) return;
  const done = (work) => () => {
    place.hidden = true;
    work();
  };
  place.replaceChildren(`Last edited ${new Date(found.at).toLocaleString()}: ${found.request?.machine?.name ?? "a machine without a name"}. `,
    h("button", { type: "button", class: "small", click: done(() => take(found.request, null)) }, "Go on with it"), " ",
    h("button", { type: "button", class: "small", click: done(forget) }, "Forget it"));
}

// Ctrl+Z in the form undoes what was done to the machine, whatever it was
function keys(event) {
  if (!(event.ctrlKey || event.metaKey) || event.target.closest("dialog, #paste, #results")) return;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return;
  event.preventDefault();
  if (key === "y" || event.shiftKey) redo(); else undo();
}

const undo = () => restore(edits.undo(), "Undone: press Optimise.");
const redo = () => restore(edits.redo(), "Done again: press Optimise.");

function write() {
  saveJson(state.request, fileName(state.request.machine?.name ?? state.example, "machine.json"));
  unsaved = false;
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
  workbooks(() => state.example);
  byId("new").addEventListener("click", () => starter((request) => take(request, null, {}, { ask: request.machine.throws.length > 0 })));
  byId("undo").addEventListener("click", undo);
  byId("redo").addEventListener("click", redo);
  byId("save").addEventListener("click", write);
  document.addEventListener("keydown", keys);
  addEventListener("beforeunload", (event) => unsaved && parent === self && event.preventDefault());
  session(() => (state.request ? { request: state.request, example: state.example } : null));
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
